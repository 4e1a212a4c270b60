"""The cyclogram's curves against those of its lines, its tables against the numbers of the method, and its figures."""

from __future__ import annotations

import json
import math
import re
from math import degrees, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.live.page import Pictures
from diecut_report.live.session import LiveSession
from diecut_report.plugins.cyclogram import torques
from diecut_report.report.profile_files import written
from diecut_report.results.document import document
from diecut_report.results.figure_record import FigureRecord, MovedRecord, PolylineRecord
from diecut_report.results.figure_views import figures
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.press_run import compute
from tests.configs import HEAD, problems, saved
from tests.machines import number
from tests.plugins.test_cyclogram import STATION, base, check_of, example, keys_of, linked, locks, press

ETA = {"drive": 0.97, "cross": 0.95}


def own(line: str, curve: str, main: Any, turns: float, offset: float) -> Any:
    """A curve of a line at main-shaft angles, from its own calculation."""
    calc = base().calculations[line]
    place = ((main - offset) * turns % (2 * pi))[None, :]
    return calc.sample(curve, place, calc.domains["crank_angle"].middle_of(place))[0]


def curves(transport: str = "cross") -> dict[str, Any]:
    """The curves of the results, as arrays."""
    found = mechanism_results(example(transport, "cutting passing"), {}).curves
    return {name: np.array(curve.values) for name, curve in found.items()} | {"described": found}


def test_each_lines_torque_is_its_own_with_the_losses_of_its_way() -> None:
    found, offset = curves(), float(example("cross", "cutting passing")["line_offset"][0, 1])
    main = found["main_angle"]
    for index, (line, turns, at, name) in enumerate(
        (("drive", 0.5, 0.0, "crank_torque"), ("cross", 1.0, offset, "torque")), 1
    ):
        torque = own(line, name, main, turns, at)
        expected = turns * np.where(torque > 0, torque / ETA[line], torque * ETA[line])
        assert found[f"line_torque_{index}"] == pytest.approx(expected, abs=1e-7)
        assert found["described"][f"line_torque_{index}"].description == f"Torque of the line at the main shaft: {line}"
    assert found["main_shaft_torque"] == pytest.approx(found["line_torque_1"] + found["line_torque_2"], abs=1e-9)
    assert found["greatest_torque"] == pytest.approx(found["line_torque_1"], abs=1e-9)


def test_the_ways_and_kinetic_energies_are_those_of_the_lines() -> None:
    found, offset = curves(), float(example("cross", "cutting passing")["line_offset"][0, 1])
    main, drive = found["main_angle"], base().calculations["drive"]
    assert found["way_1"] == pytest.approx(own("drive", "displacement", main, 0.5, 0.0), abs=1e-12)
    step = number(base().calculations["cross"], "sheet_step")
    turned = np.floor((main - offset) / (2 * pi))
    assert found["way_2"] == pytest.approx(own("cross", "sheet_position", main, 1.0, offset) + turned * step, abs=1e-9)
    speed, rotation = (own("drive", name, main, 0.5, 0.0) for name in ("cylinder_speed", "cylinder_rotation"))
    swing = 2 * number(drive, "cylinder_radius") * number(drive, "static_unbalance") * np.cos(rotation)
    assert found["kinetic_energy_1"] == pytest.approx(
        (number(drive, "reduced_inertia") + swing) * speed**2 / 2, abs=1e-7
    )
    wheel = own("cross", "wheel_speed", main, 1.0, offset)
    assert found["kinetic_energy_2"] == pytest.approx(3.57 * wheel**2 / 2, abs=1e-7)
    total = found["kinetic_energy_1"] + found["kinetic_energy_2"]
    assert found["kinetic_energy_total"] == pytest.approx(total, abs=1e-9)
    mean = number(example("cross", "cutting passing"), "kinetic_energy_mean")
    assert mean == pytest.approx(total.mean(), rel=1e-4)


def test_the_peak_power_of_the_greatest_consumer_is_that_of_the_method() -> None:
    """The cylinder alone, printed with its sum."""
    assert number(example("cross", "cutting passing"), "greatest_power_peak") == pytest.approx(2667.2, abs=0.1)


def test_the_clearance_is_a_curve_with_its_least_value() -> None:
    station = STATION | {"transport": "cross"}
    calc = press("cross", locks("cutting passing", "cross"), "48 deg", station=station, n_points=7200)
    over = np.array(mechanism_results(calc, {}).curves["clearance_over"].values)
    assert over.min() == pytest.approx(0.0289877, abs=2e-6)
    assert over.max() <= number(base().calculations["drive"], "cylinder_radius")


def test_without_a_station_the_height_over_the_carriages_is_not_checked() -> None:
    check = check_of(example("cross", "cutting"), "carriage_height")
    assert (check.status, check.missing) == ("not_checked", ["station"])


TRAIN = {
    "kind": "drive_train", "motor_speed": "1450 rpm", "output_speed": "${timing.main_shaft_speed}", "torque_mean": "${timing.torque_mean}",
    "torque_peak": "${timing.torque_peak}", "torque_curve": "${timing.main_shaft_torque}",
    "vbelt": {"section": "SPA", "driver_diameter": "125 mm", "center_distance": "600 mm"}, "power_per_belt": "3.5 kW",
    "gears": [{"driver_teeth": 20, "driven_teeth": 98}],
}  # fmt: skip


def unlike(**more: Any) -> Any:
    """A press whose transport makes as many steps as before, while the press makes fewer sheets."""
    timing = {"kind": "cyclogram"} | keys_of("cross", locks("cutting", "cross")) | {"productivity": "5000 1/h"}
    return linked({"timing": timing, "train": TRAIN} | more, printed=True)


def test_where_a_line_runs_at_another_rate_the_sum_of_the_torques_is_not_given() -> None:
    run = unlike()
    found = run.results["timing"]
    assert next(each for each in found.checks if each.id == "equal_rates").status == "fail"
    assert not {"torque_mean", "power_peak", "energy_exchange"} & found.outputs.keys()
    assert not {"main_shaft_torque", "way_1"} & found.curves.keys()
    said = {each.title: each.text for each in found.absent}
    assert "a line runs at another rate than the press" in said["Sum of the torques at the main shaft"]
    assert "interlock_cutting" in {each.id for each in found.checks}, "angles hold"


def test_what_refers_to_a_sum_that_is_not_given_is_skipped_with_the_reason() -> None:
    run = unlike()
    results = document(run)
    train = results.mechanisms["train"]
    assert train.status == "skipped"
    assert (
        "timing.main_shaft_torque, which is not calculated: a line runs at another rate than the press" in train.error
    )
    assert results.status == "fail"
    consistency = results.mechanisms["press_consistency"]
    assert consistency.status != "skipped", "what it holds against others it does without"
    unchecked = {each.id for each in consistency.checks if each.status == "not_checked"}
    assert {"actual_rate", "motor_thermal"} <= unchecked


def test_without_any_torque_there_is_no_sum(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torques, "TORQUES", {})
    found = mechanism_results(press("cross", locks("cutting", "cross")), {})
    assert "way_2" in found.curves
    assert "torque_mean" not in found.outputs
    assert "no line has a known torque" in next(each.text for each in found.absent if each.title.startswith("Sum"))


def test_the_curves_over_the_main_shaft_are_written_as_a_table() -> None:
    timing = {"kind": "cyclogram"} | keys_of("cross", locks("cutting", "cross"))
    files, _ = written(document(linked({"timing": timing}, printed=True)))
    heads, *rows = files["timing.main_shaft.csv"].decode().splitlines()
    assert heads.split(",")[0] == '"main_angle [deg]"'
    assert '"line_torque_2 [N*m]"' in heads.split(",")
    assert len(rows) == 720
    assert "timing.main_shaft.dxf" not in files


NEAR = 6e-5


def rows(transport: str, name: str, which: str = "cutting passing") -> list[list[Any]]:
    """The rows of a table."""
    found = mechanism_results(example(transport, which), {}).listings[name]
    assert all(len(row) == len(found.columns) for row in found.rows)
    return list(found.rows)


MARGINS = {
    "feeder": [(-23.8309, -6.8923), (7.0202, -23.8309), (13.7269, 24.7424), (12.6172, 6.8388)],
    "cross": [(19.0583, 30.2185), (49.9093, 13.2799), (12.4370, 29.2308), (11.3273, 11.3273)],
}


@pytest.mark.parametrize("transport", MARGINS)
def test_the_margins_of_each_interval_are_those_of_the_method(transport: str) -> None:
    found = sorted((round(degrees(row[3]), 3), degrees(row[3]), degrees(row[4])) for row in rows(transport, "margins"))
    told = sorted((round(pair[0], 3), *pair) for pair in MARGINS[transport])
    for (_, *own), (_, *wanted) in zip(found, told, strict=True):
        assert own == pytest.approx(wanted, abs=NEAR)
    for row in rows(transport, "margins"):
        assert [1000 * time for time in row[5:]] == pytest.approx([degrees(angle) * 600 / 360 for angle in row[3:5]])


PHASES = {
    "drive.forward": [(37.6086, 406.1661)],
    "drive.cutting": [(117.1747, 307.8979), (508.0258, 684.8365)],
    "drive.contact": [(111.7238, 314.1021), (501.5482, 689.5301)],
    "drive.carriage_window": [(10.6152, 65.6176), (369.5054, 443.5212)],
}
TIMES = {
    "drive.contact": [337.2972, 313.3031],
    "drive.carriage_window": [91.6708, 123.3596],
    "drive.forward": [614.2625],
}


def test_the_phases_on_the_main_shaft_are_those_of_the_method() -> None:
    table = rows("cross", "main_phases")
    for phase, wanted in PHASES.items():
        found = [(degrees(row[3]), degrees(row[4])) for row in table if row[0] == phase]
        assert [edge for each in found for edge in each] == pytest.approx(
            [e for each in wanted for e in each], abs=2e-4
        )
    for phase, times in TIMES.items():
        assert [1000 * row[7] for row in table if row[0] == phase] == pytest.approx(times, abs=2e-4)
    assert {row[2] for row in table if row[0] == "cross.passing"} == {"moving"}


def test_a_phase_is_told_in_words_and_none_twice() -> None:
    table = rows("cross", "main_phases")
    told = {row[0]: row[1] for row in table}
    assert told["drive.cutting"] == "drive: Cutting" and told["cross.passing"] == "cross: passing"
    assert "drive.cutting_forward" not in told and "drive.carriage_window_outer" not in told
    places = [(row[0].split(".")[0], row[2], *row[3:5]) for row in table]
    assert len(places) == len(set(places))


def test_all_offsets_that_leave_the_margins_are_told() -> None:
    (line, *ends), *others = rows("cross", "offsets", "contact passing")
    assert (line, others) == ("cross", [])
    assert [degrees(end) for end in ends] == pytest.approx([29.5301, 49.4437], abs=NEAR)
    assert rows("feeder", "offsets") == []


def test_a_length_is_told_only_where_one_window_holds_an_interlock() -> None:
    outputs = mechanism_results(press("feeder", locks("contact passing", "feeder")), {}).outputs
    assert degrees(outputs["needed_length.0"].value) == pytest.approx(217.8062, abs=NEAR)
    assert "needed_length.1" not in outputs


def drawn(name: str, transport: str = "feeder", which: str = "cutting passing") -> FigureRecord:
    """A figure of the press with this transport."""
    found = {figure.id: figure for figure in figures(example(transport, which))}
    assert "error" not in found[name]
    return found[name]


def shapes(name: str) -> list[dict[str, Any]]:
    """The shapes of a figure of the press with the cam-gear transport."""
    return list(drawn(name).shapes)


def test_lines_at_the_ends_of_the_offsets_say_which_end_they_are() -> None:
    told = str(drawn("ways", "cross", "contact passing"))
    assert re.findall(r"'((?:from|to) [^']*)'", told) == ["from 29.53°", "to 49.44°"]


def test_the_dwell_is_shaded_and_interlocks_are_brackets_with_their_margins() -> None:
    drawn = shapes("cyclogram")
    shades = [shape.points for shape in drawn if getattr(shape, "role", "") == "shade"]
    edges = sorted(90 * points[0][0] for points in shades)  # 720 degrees are 8 wide
    assert edges == pytest.approx([141.0056, 501.0056], abs=1e-3)
    brackets = [shape.points for shape in drawn if getattr(shape, "role", "") == "mark"]
    assert [90 * points[0][0] for points in brackets[:2]] == pytest.approx([117.1747, 508.0258], abs=1e-3)
    texts = {shape.text for shape in drawn if shape.shape == "label"}
    assert {"-23.83°, -6.892°", "12.62°, 6.839°"} <= texts


def test_a_ring_stands_for_each_line() -> None:
    drawn = shapes("rings")
    assert sum(shape.shape == "circle" for shape in drawn) == 2
    rests = [shape.end - shape.start for shape in drawn if getattr(shape, "role", "") == "outline"]
    assert rests.count(pytest.approx(math.radians(160 / 2))) >= 2  # the dwell of either sheet: two are once round


PLUGIN = """
import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, abscissa, m, pi, samples


class Feeder(Inputs):
    end = Quantity("φ_e", "deg", "End of the carrying", default=120)
    rate = Quantity("n", "1/h", "Turns", default=6000)
    n_points = samples(36)


chapter = Chapter("Motion")
chapter.speed = 2 * pi * m.rate, "ω", "rad/s", "Speed"
chapter.start = m.end / 4, "φ_0", "deg", "Start of the carrying"
chapter.angle = abscissa(2 * np.pi, speed="speed"), "φ", "deg", "Angle"
chapter.phase("carrying", "working", "A sheet is carried", "angle", ("start", "end"))
chapter.phase("returning", "moving", "Back without a sheet", "angle", rest_of=("carrying",))
chapter.load = 2 + np.sin(m.angle), "F", "N", "Load"

MECHANISM = Mechanism(kind="small_feeder", version="1.0", title="Feeder", summary="Carries", inputs=Feeder, chapters=(chapter,))
"""
LINES = """\
  feeder: {kind: small_feeder}
  cyc:
    kind: cyclogram
    lines: [{mechanism: feeder}]
    interlocks: [{name: returns_free, phase: feeder.returning, apart_from: feeder.carrying}]
"""


def test_a_line_without_a_known_way_is_reported_without_the_figure_of_ways(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    more = ["--plugins", str(tmp_path), "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]
    assert main(["report", str(saved(tmp_path, HEAD + LINES)), *more]) == 0
    page = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert "Circular cyclogram" in page and "Displacements and slack" not in page


def test_a_line_across_all_rows_follows_the_angle_and_the_bars_that_it_passes_are_filled(tmp_path: Path) -> None:
    """The feeder carries from 30° to 120°; of the period of 360° a twelfth and a third."""
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config = load_config(saved(tmp_path, HEAD + LINES), Discovery([tmp_path]))
    [figure] = [each for each in document(compute(config, lambda _: None)).mechanisms["cyc"].figures if each.moving]
    shapes, places = figure.moving.shapes, np.array(figure.moving.places)
    [cursor] = [np.array(shape.moves) for shape in shapes if isinstance(shape, MovedRecord)]
    assert cursor[:, 0] == pytest.approx(places / (2 * np.pi) * 8) and cursor[:, 0] == pytest.approx(cursor[:, 2])
    heights = [y for shape in shapes if isinstance(shape, PolylineRecord) for _, y in shape.points]
    assert set(cursor[:, 1]) == {max(heights)} and set(cursor[:, 3]) == {min(heights)}
    filled = [during for shape in shapes if (during := getattr(shape, "during", None))]
    assert np.degrees(filled) == pytest.approx(np.array([[30, 120], [120, 360], [0, 30]]))
    assert [shape.text for shape in shapes if shape.shape == "label"][5:8] == [
        "feeder:",
        "A sheet is carried",
        "Back without a sheet",
    ]


def test_bars_are_dragged_with_the_offset_of_their_line_and_by_as_much(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")

    def bars(offset: str) -> list[PolylineRecord]:
        text = HEAD + LINES.replace("{mechanism: feeder}", f"{{mechanism: feeder, offset: {offset}}}")
        [figure] = [
            each
            for each in document(compute(load_config(saved(tmp_path, text), Discovery([tmp_path])), lambda _: None))
            .mechanisms["cyc"]
            .figures
            if each.id == "cyclogram"
        ]
        return [each for each in figure.shapes if isinstance(each, PolylineRecord) and each.grip]

    (before, *_), (after, *_) = bars("0 deg"), bars("45 deg")
    assert before.grip is not None and before.grip.input == "lines.0.offset"
    assert (after.points[0][0] - before.points[0][0]) * before.grip.per_metre == pytest.approx(np.pi / 4)


def test_what_can_be_dragged_is_told_to_the_live_page_alone(tmp_path: Path) -> None:
    """A report carries no grips, and is the page that is made of what it carries."""
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config, plugins = saved(tmp_path, HEAD + LINES), ["--plugins", str(tmp_path)]
    assert main(["report", str(config), *plugins, "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]) == 0
    page = tmp_path / "out" / "press.html"
    assert "data-grip" not in page.read_text("utf-8")
    assert main(["verify", str(page), *plugins]) == 0
    session = LiveSession(config, Discovery([tmp_path]))
    assert session.machine is not None
    assert "lines.0.offset" in str(Pictures().figure(session.machine, "cyc", 0)["moving"]["shapes"])
    assert "lines.0.offset" not in page.read_text("utf-8").partition('id="reader-data"')[2]


def test_the_lines_move_with_the_cyclogram_by_their_offsets_and_rates(tmp_path: Path) -> None:
    """A line of two turns a sheet runs through its period in half of one; an offset that is found is the one that is told."""
    saved(tmp_path, PLUGIN, "small_feeder.py")
    lines = "[{mechanism: feeder, turns_per_sheet: 2, offset: 40 deg}, {mechanism: other, turns_per_sheet: 1/2, offset: auto}]"
    text = LINES.replace("[{mechanism: feeder}]", lines).replace(
        "apart_from: feeder.carrying", "apart_from: other.carrying"
    )
    text = "  other: {kind: small_feeder, end: 20 deg, rate: 3000}\n" + text.replace(
        "small_feeder}", "small_feeder, rate: 12000}"
    )
    config = load_config(saved(tmp_path, HEAD + text), Discovery([tmp_path]))
    told = document(compute(config, lambda _: None)).mechanisms["cyc"]
    [moving] = [figure.moving for figure in told.figures if figure.moving]
    drives = [(each.mechanism, each.offset, each.period) for each in moving.drives]
    found = told.outputs["offset_found"].value
    assert found and drives == [
        ("feeder", pytest.approx(np.radians(40)), pytest.approx(np.pi)),
        ("other", found, pytest.approx(4 * np.pi)),
    ]


def test_a_grip_in_a_results_file_is_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config, file = saved(tmp_path, HEAD + LINES), tmp_path / "press.json"
    assert main(["calc", str(config), "--plugins", str(tmp_path), "-o", str(file), "--quiet"]) == 0
    data = json.loads(file.read_text("utf-8"))
    [figure] = [each for each in data["mechanisms"]["cyc"]["figures"] if each["id"] == "cyclogram"]
    next(each for each in figure["shapes"] if each["shape"] == "polyline")["grip"] = {"input": "x", "per_metre": 1.0}
    file.write_text(json.dumps(data), "utf-8")
    assert main(["render", str(file), "--plugins", str(tmp_path), "-o", str(tmp_path / "out")]) == 2
    assert "shapes" in (told := capfd.readouterr().err) and "grip" in told


def test_a_cyclogram_of_lines_at_other_rates_than_the_press_stands_still(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config = load_config(
        saved(tmp_path, HEAD + LINES.replace("small_feeder}", "small_feeder, rate: 5000}")), Discovery([tmp_path])
    )
    figures = document(compute(config, lambda _: None)).mechanisms["cyc"].figures
    assert "cyclogram" in [each.id for each in figures if each.shapes] and not any(each.moving for each in figures)


def test_a_curve_in_place_of_its_name_is_told(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    text = HEAD + LINES.replace("{mechanism: feeder}", "{mechanism: feeder, torque_curve: '${feeder.load}'}")
    [told] = problems(tmp_path, text, Discovery([tmp_path]))
    assert told.endswith(
        "${feeder.load} is a curve in N; a text (Name of a torque curve of the line, such as `torque`, if not the "
        "default of its kind) is needed here"
    )
