"""A results document made by hand that holds every kind of item and figure: the sample of the file, and more."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from diecut_report.results.conclusion import summary
from diecut_report.results.model import ResultsRecord
from tests.records import filled
from tests.report.made_figures import all_figures

Data = dict[str, Any]
SAMPLE = Path(__file__).with_name("sample_results.json")
SOURCE = (
    "Standards of belts, table 441.1 with all sections; a maker's catalogue of wedge belts, edition of 2011, page 57"
)
PULLEYS = 5


def quantity(
    value: float | str, unit: str, printed: str, description: str, symbol: str = "", shown: str = "", **more: Any
) -> Data:
    """An input or output."""
    return {"value": value, "unit": unit, "symbol": symbol, "description": description, "source": "geometry",
            "display": {"text": printed, "unit": shown or unit}} | more  # fmt: skip


def part(family: str, index: int, quantity: str = "", number: int | None = None) -> Data:
    """Return which of repeated parts a quantity is of, as the results tell it."""
    found: Data = {"family": family, "index": index}
    found |= {} if number is None else {"number": number}
    return found | ({"quantity": quantity} if quantity else {})


def inputs() -> Data:
    """Lone inputs, a list of two parts (no table) and one of five, each part with other origins."""
    found = {
        "vbelt.section": quantity("SPA", "1", "SPA", "Section of the V-belt", origin="given", text="SPA"),
        "law": quantity("polynomial_345", "1", "polynomial_345", "Law of motion", origin="default"),
        "speed": quantity(5.2, "rad/s", "50", "Speed", "n", "rpm", origin="reference", path="drive.crank_speed"),
    }
    for k in range(2):
        found[f"gears.{k}.teeth"] = quantity(20.0 + k, "1", str(20 + k), "Teeth", "z", origin="given", text=str(20 + k),
                                             part=part("gears", k, "teeth"))  # fmt: skip
    for k in range(PULLEYS):
        typed = {0: "0.1 m", 1: "${drive.radius}", 2: "100 mm"}.get(k, "100")
        found[f"belt.pulleys.{k}.radius"] = quantity(
            0.1,
            "m",
            "100",
            "Radius of the pulley",
            "r_p",
            "mm",
            origin="given",
            text=typed,
            part=part("belt.pulleys", k, "radius"),
        )
    for k in range(PULLEYS):
        found[f"belt.pulleys.{k}.side"] = quantity(
            "inside", "1", "inside", "Side of the loop", origin="default", part=part("belt.pulleys", k, "side")
        )
    found["belt.pulleys.3.mass"] = quantity(
        2.0, "kg", "2", "Mass", "m", origin="given", text="2 kg", part=part("belt.pulleys", 3, "mass")
    )
    return found


def outputs() -> Data:
    """Lone outputs, rows over five pulleys, numbered shafts of two kinds."""
    found = {"radius": quantity(0.1, "m", "100.0", "Radius", "R", "mm", key=True)}
    for k in range(PULLEYS):
        found[f"wraps.{k}"] = quantity(
            1.0, "rad", f"{57.3 + k}", "Wrap on the pulley", "β", "deg", part=part("belt.pulleys", k, "wraps")
        )
    for k in range(PULLEYS):
        found[f"arcs.{k}"] = quantity(
            0.1, "m", f"{100 + k}", "Arc on the pulley", "b", "mm", part=part("belt.pulleys", k, "arcs")
        )
    for k in range(3, 7):
        found[f"shaft_{k}_speed"] = quantity(
            10.0,
            "rad/s",
            f"{90 + k}.49",
            "Speed of the shaft",
            "ω",
            "rpm",
            source="kinematics",
            part=part("shaft", k - 3, "speed", k),
        )
        found[f"shaft_{k}_torque"] = quantity(
            10.0, "N*m", f"{10 * k}.00", "Torque of the shaft", "M", part=part("shaft", k - 3, "torque", k)
        )
    for k in range(2):
        found[f"ratios.{k}"] = quantity(
            2.0, "1", f"{2 + k}.000", "Ratio of the pair", "i", key=True, part=part("gears", k, "ratios")
        )
    return found


def item(kind: str, symbol: str, description: str, result: str, source: str = "", **more: Any) -> Data:
    """An item of the calculation; its result is a number and a unit."""
    text, unit = result.split()
    return {
        "type": kind,
        "symbol": symbol,
        "description": description,
        "source": source,
        "result": {"text": text, "unit": unit},
    } | more


def looked_up() -> list[Data]:
    """Numbers from tables and a standard series."""
    chosen = {"by": "Section of the V-belt", "key": "SPA", "table": "Least diameters by section"}
    method = "the next standard value at or above 0.93 kW; adjacent values not chosen: 0.75 kW, 1.5 kW"
    return [
        item("lookup", "d_min", "Least diameter", "90 mm", SOURCE, **chosen),
        item("lookup", "ρ", "Density", "7850 kg/m**3", "material", by="Material", key="steel", table=""),
        item(
            "reduction",
            "P_r",
            "Rating",
            "1.100 kW",
            SOURCE,
            operation="pick",
            of="P",
            series="Ratings of motors",
            method=method,
        ),
        item("found", "m_n", "Module", "2 mm", relation=None, method="the least module that is enough", chosen=True),
        item("found", "x_s", "Sum of shifts", "0.2 1", relation=None, method="the sum of all"),
    ]


def taken_of_rows() -> list[Data]:
    """The last of a row, a running integral, a table with a line for each part."""
    place = {"symbol": "φ", "text": "45", "unit": "deg"}
    columns = [{"title": title, "symbol": symbol, "unit": "1"} for title, symbol in (("No.", ""), ("Ratio", "i"))]
    return [
        item("reduction", "n", "Speed of the last shaft", "49.32 rpm", operation="last", of="ω_k", method=""),
        item("reduction", "A", "Energy", "-6.804 J", operation="accumulated", of="M", method="", at=place),
        {"type": "table", "title": "Ratio of the pair", "columns": columns, "rows": [["1", "2.000"], ["2", "3.000"]]},
    ]


def curves(samples: int = 72) -> Data:
    """A profile and its pitch curve over a turn."""
    turn = [2 * math.pi * k / samples for k in range(samples)]
    found: Data = {
        "disc_angle": {
            "unit": "rad",
            "values": turn,
            "symbol": "φ",
            "description": "Disc angle",
            "display_unit": "deg",
            "source": "",
        }
    }
    for name, radius in (("cam_1", 0.05), ("cam_1_pitch", 0.06)):
        reach = [radius + 0.01 * math.sin(t) ** 3 for t in turn]
        for axis, turned in (("x", math.cos), ("y", math.sin)):
            values = [r * turned(t) for r, t in zip(reach, turn, strict=True)]
            found[f"{name}_{axis}"] = {"abscissa": "disc_angle", "unit": "m", "values": values, "symbol": axis, "description": f"{name} {axis}",
                                       "display_unit": "mm", "source": "", "breakpoints": [], "left": [], "right": []}  # fmt: skip
    return found


def export(*columns: str) -> Data:
    """An export of the curves."""
    return {"id": "cam_1", "title": "Cam 1", "type": "profile", "abscissa": "disc_angle", "columns": list(columns)}


def check(name: str) -> Data:
    """A check that passes."""
    shown = {"text": "1", "unit": "N"}
    return {"id": name, "title": "A compared force", "class": "strength", "status": "pass", "demand": 1.0, "limit": 1.0, "operator": "<=",
            "unit": "N", "utilisation": 1.0, "source": "",
            "message": "Force 1 N, limit 1 N.", "demand_label": "force", "limit_label": "limit", "demand_display": shown,
            "limit_display": shown, "margin_display": {"text": "0", "unit": "N"}}  # fmt: skip


def mechanism(title: str, **more: Any) -> Data:
    """The results of a mechanism."""
    empty: Data = {
        key: []
        for key in (
            "assumptions",
            "sources",
            "checks",
            "warnings",
            "sections",
            "absent",
            "figures",
            "exports",
            "errata",
        )
    }
    return empty | {"kind": "made_up", "title": title, "plugin_version": "1.0", "status": "pass", "summary": "Made up.", "inputs": {},
                    "outputs": {}, "values": {}, "curves": {}} | more  # fmt: skip


def train() -> Data:
    """A mechanism with all that lists, tables, standards, exports and new figures bring."""
    profile = export("cam_1_x", "cam_1_y", "cam_1_pitch_x", "cam_1_pitch_y")
    return mechanism("Drive train", inputs=inputs(), outputs=outputs(), curves=curves(), exports=[profile], figures=all_figures(),
                     sections=[{"title": "Standards", "text": "", "items": [*looked_up(), *taken_of_rows()]}])  # fmt: skip


def comparison() -> Data:
    """A comparison between two mechanisms of the sample."""
    return mechanism("Both drives compared", between=["cylinder", "train"], figures=all_figures()[:1], checks=[check("compared")],
                     sources=[{"id": "900", "citation": "A source of the comparison alone."}])  # fmt: skip


def typed(data: Data) -> ResultsRecord:
    """Return the results of a document that lacks what tests do not care for."""
    found = filled(ResultsRecord, data | {"report": {"detail": "standard"} | data.get("report", {})})
    checks = {name: each.checks for name, each in found.calculated.items()}
    return found if "summary" in data else found.with_(summary=summary(checks, []))


def sample() -> Data:
    """The whole document as its file holds it."""
    found: Data = json.loads(SAMPLE.read_text(encoding="utf-8"))
    found["mechanisms"]["train"] = train()
    found["comparisons"] = {"compared-cylinder-train": comparison()}
    found["report"] = {"detail": "full"}
    return found
