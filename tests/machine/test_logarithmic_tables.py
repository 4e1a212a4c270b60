"""Values between the rows of a table on logarithmic axes: against their closed forms, printed, in curves and among many."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import pytest
from scipy.integrate import quad

from diecut_report.api import POINTS, Chapter, Inputs, Mechanism, Quantity, own_table
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.names import Misdeclared
from tests.machine.test_tables import eval_json

SPEEDS, FORCES = (10.0, 100.0, 1000.0), (8.0, 2.0, 1.0)  # rpm, kN
LIFE = own_table(
    title="Forces that a bearing carries",
    columns={"speed": "rpm", "force": "kN"},
    rows=tuple(zip(SPEEDS, FORCES, strict=True)),
    sources=("List",),
    only_source="measured",
)
KINDS = {"log-x": "x", "log-y": "y", "log-log": "z"}


class Bearing(Inputs):
    speed: Annotated[float, Quantity("n", "rpm", "Speed", gt=0)]
    swing: Annotated[float, Quantity("Δn", "rpm", "Swing of the speed", ge=0)]
    n_points: Annotated[int, POINTS] = 36


chapter = Chapter("Bearing")
for kind, symbol in KINDS.items():
    name = kind.replace("-", "_")
    chapter.interpolated(name, f"F_{symbol}", "kN", "Force", LIFE, of="speed", interpolation=kind)  # type: ignore[arg-type]
chapter.abscissa("turn", "φ", "deg", "Turn", period=2 * np.pi)
chapter.value("here", "n_φ", "rpm", "Speed at a place", lambda turn, speed, swing: speed + swing * np.sin(turn))
chapter.interpolated("force", "F", "kN", "Force there", LIFE, of="here", key="swing", interpolation="log-log")
chapter.reduction("mean", "F_m", "kN", "Mean force", "mean", of="force")
chapter.reduction("greatest", "F_max", "kN", "Greatest force", "max", of="force")
MECHANISM = Mechanism(kind="bearing", version="1", title="Bearing", summary="Of a table.", inputs=Bearing, chapters=(chapter,))  # fmt: skip


def forms(speed: float) -> dict[str, float]:
    """What SciPy's and NumPy's own straight lines give on axes of logarithms, kN."""
    x, y, at = np.log10(SPEEDS), np.log10(FORCES), np.log10(speed)
    return {"log_x": np.interp(at, x, FORCES), "log_y": 10 ** np.interp(speed, SPEEDS, y), "log_log": 10 ** np.interp(at, x, y)}  # fmt: skip


def made(speed: float, swing: float = 0.0) -> Calculation:
    return calculate(MECHANISM, flatten(Bearing(speed=f"{speed!r} rpm", swing=f"{swing!r} rpm")))  # type: ignore[arg-type]


def test_the_declaration_is_sound() -> None:
    assert faults(MECHANISM) == []
    check_mechanism(MECHANISM)


@pytest.mark.parametrize("speed", [10.0, 17.0, 100.0, 316.2278, 999.9, 1000.0])
def test_a_value_is_on_the_straight_line_of_its_axes(speed: float) -> None:
    calc = made(speed)
    for name, wanted in forms(speed).items():
        assert calc[name][0, 0] / 1000 == pytest.approx(wanted, rel=1e-12), name


def test_what_is_printed_gives_the_result() -> None:
    calc = made(200.0)
    items = {item.get("id"): item for section in section_items(calc) for item in section["items"]}
    for name, wanted in forms(200.0).items():
        assert eval_json(items[name]["substituted"]) == pytest.approx(1000 * wanted, rel=1e-3)
        assert "n_1 = 100 r/min, F_" in items[name]["table_rows"]
    assert items["log_x"]["result"] == {"text": "1.699", "unit": "kN"}  # 2 − lg 2


def test_a_curve_has_its_corners_at_the_rows() -> None:
    calc = made(300.0, 250.0)
    corners = [np.pi + np.arcsin(200 / 250), 2 * np.pi - np.arcsin(200 / 250)]
    whole, _ = quad(lambda a: forms(300 + 250 * np.sin(a))["log_log"], 0, 2 * np.pi, points=corners, epsabs=1e-12)
    assert calc["mean"][0, 0] / 1000 == pytest.approx(whole / (2 * np.pi), rel=1e-10)
    assert calc["greatest"][0, 0] / 1000 == pytest.approx(forms(50)["log_log"], rel=1e-11)


@pytest.mark.parametrize("count", [3, 12])
def test_many_variants_are_each_alone(count: int) -> None:
    turns = 2 * np.pi / 60
    speed, swing = np.linspace(120, 600, count), np.linspace(5, 80, count)
    swing[1] = 1000  # below nothing, where no logarithm is
    given = flatten(Bearing(speed="300 rpm", swing="0 rpm"))  # type: ignore[arg-type]
    many = calculate(MECHANISM, given | {"speed": speed * turns, "swing": swing * turns}, count)
    assert list(many.flaws) == [1]
    for row in set(range(count)) - {1}:
        alone = made(float(speed[row]), float(swing[row]))
        for name in ("log_x", "log_y", "log_log", "mean", "greatest"):
            assert many[name][row, 0] == pytest.approx(alone[name][0, 0], rel=1e-11), name


WRONG: dict[str, tuple[Any, str, str]] = {
    "an unknown one": (((1, 1), (2, 2)), "loglog", "interpolation is 'loglog' (did you mean 'log-log'?); allowed: linear, log-x, log-y, log-log"),
    "a row at zero": (((0, 1), (2, 2)), "log-x", "“Own” has the number 0 in its column x, which has no logarithm"),
    "a value below zero": (((1, 1), (2, -2)), "log-log", "“Own” has the number -2 in its column y, which has no logarithm"),
}  # fmt: skip


@pytest.mark.parametrize(("rows", "kind", "told"), WRONG.values(), ids=WRONG)
def test_what_cannot_be_interpolated_is_told_where_it_is_declared(rows: Any, kind: Any, told: str) -> None:
    table = own_table(title="Own", columns={"x": "1", "y": "1"}, rows=rows, sources=("A",), only_source="own")
    with pytest.raises(Misdeclared) as fault:
        Chapter("Own").interpolated("own", "Y", "1", "Own", table, of="x", interpolation=kind)
    assert told in str(fault.value)


def test_a_column_whose_axis_is_not_logarithmic_may_have_any_numbers() -> None:
    table = own_table(
        title="Own", columns={"x": "1", "y": "1"}, rows=((1, -1), (2, 0)), sources=("A",), only_source="own"
    )
    Chapter("Own").interpolated("own", "Y", "1", "Own", table, of="x", interpolation="log-x")
