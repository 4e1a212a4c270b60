"""Numbers of tables: as given, by a text, by a number, between rows, on logarithmic axes; for one machine, for many and in a report."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from diecut_report.api import (
    BarGroup,
    Bars,
    Block,
    Chapter,
    Chart,
    Inputs,
    Mechanism,
    Polar,
    Quantity,
    Series,
    abscissa,
    chart_panel,
    interpolated,
    level,
    line,
    lookup,
    m,
    own_table,
    parts,
    pick,
    reduction,
    samples,
)
from diecut_report.config.plugins import Discovery
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.formulas.formula import evaluate
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.names import Misdeclared
from diecut_report.press import Press
from diecut_report.quantities.units import unit
from diecut_report.report.figures.labels import Across, ChartLine, Note, PanelData
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows
from tests.configs import HEAD, loaded, saved
from tests.machine.geared import FACTORS, LIFTS, MECHANISM, Geared

TEETH, Y = (column.values for column in FACTORS.columns)


def geared(**inputs: Any) -> Calculation:
    return calculate(MECHANISM, flatten(Geared(**({"bearing": "6204"} | inputs))))


def item(calc: Calculation, name: str) -> dict[str, Any]:
    return next(i for section in section_items(calc) for i in section["items"] if i.get("id") == name)


def test_the_declaration_is_sound() -> None:
    assert faults(MECHANISM) == []
    check_mechanism(MECHANISM)


def test_several_columns_of_one_row_are_taken_one_after_another_and_name_their_sources_once() -> None:
    calc = geared()
    assert (calc["bore"][0, 0], calc["rating"][0, 0]) == (0.02, 13500)
    bore, rating = item(calc, "bore"), item(calc, "rating")
    assert (bore["table"], bore["key"], bore["column"]) == ("Bearings", "6204", "bore") and bore[
        "note"
    ] == "Bearings: List one; List two"
    assert rating["column"] == "C" and "note" not in rating and rating["result"] == {"text": "13.5", "unit": "kN"}


def test_what_is_given_takes_the_tables_place_and_needs_no_text() -> None:
    calc = geared(bearing=None, bore_given="30 mm")
    assert calc["bore"][0, 0] == 0.03
    printed = item(calc, "bore")
    assert (printed["by"], printed["key"], printed["table"]) == ("Bore", "as given", "") and "note" not in printed


def test_each_of_repeated_parts_has_its_own_as_given_or_by_its_text() -> None:
    calc = geared(wheels=[{"count": 15, "grade": "hard"}, {"count": 16, "strength": "222 MPa"}])
    assert calc["wheel_strength"][0] == pytest.approx([300e6, 222e6])
    table = next(
        i for s in section_items(calc) for i in s["items"] if i["type"] == "table" and i["title"] == "Strength taken"
    )
    assert [row[1] for row in table["rows"]] == ["hard", "as given"]
    every = geared(wheels=[{"count": 15, "strength": "111 MPa"}, {"count": 16, "strength": "222 MPa"}])
    assert every["wheel_strength"][0] == pytest.approx([111e6, 222e6])


@pytest.mark.parametrize("teeth", [12, 13.3, 15, 17, 20, 29.999, 30])
def test_a_value_between_rows_is_on_the_straight_line(teeth: float) -> None:
    assert geared(teeth=teeth)["factor"][0, 0] == pytest.approx(np.interp(teeth, TEETH, Y), rel=1e-14)


def test_repeated_parts_have_values_of_their_own() -> None:
    calc = geared(wheels=[{"count": 15}, {"count": 16}, {"count": 30}])
    assert calc["wheel_factor"][0] == pytest.approx(np.interp([15, 16, 30], TEETH, Y))


def test_the_printed_numbers_give_the_printed_result() -> None:
    printed = item(geared(teeth=17), "factor")
    assert printed["table_rows"] == "Rows of the table: z_1 = 15, Y_1 = 0.29; z_2 = 20, Y_2 = 0.32."
    assert (printed["series"], printed["note"]) == ("Factors of teeth", "Factors of teeth: Book one; Book two")
    again = eval_json(printed["substituted"])
    assert again == pytest.approx(0.302) and printed["result"]["text"] == "0.302"
    assert set(symbols(printed["equation"])) == {"Y_1", "Y_2", "z", "z_1", "z_2"}


@pytest.mark.parametrize(("teeth", "factor"), [(12, "0.245"), (20, "0.32"), (30, "0.36")])
def test_a_value_at_a_row_is_printed_as_this_row(teeth: float, factor: str) -> None:
    printed = item(geared(teeth=teeth), "factor")
    assert (printed["type"], printed["table"], printed["key"]) == ("lookup", "Factors of teeth", f"z = {teeth}")
    assert printed["column"] == "Y" and printed["result"] == {"text": factor, "unit": "1"}
    assert printed["note"] == "Factors of teeth: Book one; Book two"


def test_the_numbers_stand_in_the_tables_unit() -> None:
    printed = item(geared(), "lift")
    assert printed["table_rows"] == "Rows of the table: φ_1 = 0°, h_1 = 0 mm; φ_2 = 90°, h_2 = 10 mm."
    assert printed["note"] == "Lifts of a cam: Drawing (one source: measured there)"
    assert {leaf[2] for leaf in leaves(printed["substituted"])} == {"deg", "mm"}
    assert eval_json(printed["substituted"]) == pytest.approx(4e-2 / 9)  # at 40°


def leaves(tree: Any) -> list[Any]:
    return [tree] if tree[0] in ("qty", "sym", "num") else [leaf for part in tree[1:] for leaf in leaves(part)]


def symbols(tree: Any) -> list[str]:
    return [leaf[1] for leaf in leaves(tree) if leaf[0] == "sym"]


def eval_json(tree: Any) -> float:
    from diecut_report.formulas.tree import Node

    def node(part: Any) -> Any:
        return Node(part[0], tuple(node(p) if isinstance(p, list) else p for p in part[1:]))

    found: float = evaluate(node(tree), lambda leaf: float(leaf.args[0]) * unit(leaf.args[1]).factor)
    return found


def test_a_curve_over_the_abscissa_has_its_corners_at_the_rows() -> None:
    calc = geared()
    turn, lift = (np.array(column.values) for column in LIFTS.columns)
    assert calc["lift_max"][0, 0] == pytest.approx(0.01) and calc["lift_max_at"][0, 0] == pytest.approx(np.pi / 2)
    assert calc["lift_mean"][0, 0] == pytest.approx(np.trapezoid(lift, turn) / 360 / 1000, rel=1e-12)


@pytest.mark.parametrize("reach", [1, 4, 5])
def test_a_curve_by_another_curve_has_its_corners_where_that_passes_the_rows(reach: float) -> None:
    calc = geared(reach=reach)
    angles = [np.arcsin((row - 17) / reach) for row in TEETH if abs(row - 17) < reach]
    corners = [place % (2 * np.pi) for angle in angles for place in (angle, np.pi - angle)]
    whole, _ = quad(
        lambda a: float(np.interp(17 + reach * np.sin(a), TEETH, Y)), 0, 2 * np.pi, points=corners or None, epsabs=1e-12
    )
    assert calc["swung_mean"][0, 0] == pytest.approx(whole / (2 * np.pi), rel=1e-10)
    assert calc["swung_max"][0, 0] == pytest.approx(np.interp(17 + reach, TEETH, Y), rel=1e-12)


TOLD = {
    "an input": ({"teeth": 31}, "teeth", "is z = 31, outside of the table “Factors of teeth” for Factor of the teeth (Y), "
                 "which goes from 12 to 30"),
    "hardly": ({"teeth": 30.00001}, "teeth", "is z = 30.00001, outside"),
    "a part": ({"wheels": [{"count": 12}, {"count": 11}]}, "wheels.1.count", "is z_i = 11, outside"),
    "a curve": ({"reach": 6}, "reach", "leads to z_s = 11, outside of the table “Factors of teeth” for Factor at a place (Y_s)"),
}  # fmt: skip


@pytest.mark.parametrize(("inputs", "key", "told"), TOLD.values(), ids=TOLD)
def test_outside_of_the_table_a_machine_is_impossible(inputs: dict[str, Any], key: str, told: str) -> None:
    with pytest.raises(Impossible) as fault:
        geared(**inputs)
    assert fault.value.key == key and fault.value.message.startswith(told)


@pytest.mark.parametrize("count", [3, 12])
def test_many_variants_are_each_alone(count: int) -> None:
    rng = np.random.default_rng(3)
    teeth, reach, bore = rng.uniform(17, 25, count), rng.uniform(1, 4.9, count), rng.uniform(0.01, 0.04, count)
    reach[1] = 14
    many = calculate(
        MECHANISM, flatten(Geared(bearing="6204")) | {"teeth": teeth, "reach": reach, "bore_given": bore}, count
    )
    assert list(many.flaws) == [1] and many.flaws[1][0] == "reach"
    for row in set(range(count)) - {1}:
        alone = calculate(
            MECHANISM,
            flatten(Geared(bearing="6204")) | {"teeth": teeth[row], "reach": reach[row], "bore_given": bore[row]},
        )
        for name in ("factor", "bore", "rating", "lift_mean", "lift_max", "swung_mean", "swung_max", "swung_max_at"):
            assert many[name][row, 0] == pytest.approx(alone[name][0, 0], rel=1e-11), name


def test_what_a_table_gives_can_be_varied() -> None:
    from diecut_report.machine.steps.run import varied

    rerun = partial(varied, geared())
    assert rerun({"teeth": [13.0, 40.0]}, ["factor"])["factor"] == pytest.approx(
        [np.interp(13, TEETH, Y), np.nan], nan_ok=True
    )
    assert rerun({"bore_given": [0.05, 0.06]}, ["bore"])["bore"] == pytest.approx([0.05, 0.06])


def plotted(limits: Any, **inputs: Any) -> FigureRecord:
    panel = replace(MECHANISM.figures[0].panels[0], range=limits)  # type: ignore[attr-defined]
    mechanism = replace(MECHANISM, figures=(replace(MECHANISM.figures[0], panels=(panel,)),))  # type: ignore[call-arg]
    return figures(calculate(mechanism, flatten(Geared(**({"bearing": "6204"} | inputs)))))[0]


def test_a_panel_has_the_range_that_it_declares() -> None:
    assert plotted(None).panels[0].range == []
    assert plotted((0, None)).panels[0].range == [0, None]
    assert plotted((-1, "bore")).panels[0].range == [pytest.approx(-0.001), 0.02]


def figured(figure: Any) -> FigureRecord:
    return figures(calculate(replace(MECHANISM, figures=(figure,)), flatten(Geared(bearing="6204"))))[0]


def round_diagram(limits: Any) -> FigureRecord:
    drawn = (Series("lift", "h"),)
    return figured(Polar("p", "Lift", "", abscissa="turn", unit="mm", series=drawn, range=limits))


def barred(limits: Any) -> FigureRecord:
    group = BarGroup("Bores", "mm", bars=(("one", "bore"), ("less", "-lift_max")), range=limits)
    return figured(Bars("b", "Bars", "", groups=(group,)))


def test_a_polar_diagram_has_the_range_of_its_distances() -> None:
    assert "range" not in round_diagram(None) and "error" not in round_diagram(None)
    assert round_diagram((0, None)).range == [0, None] and round_diagram((None, "bore")).range == [None, 0.02]
    assert "h reaches 10 mm, outside of the range of 'Lift', … to 8 mm; widen it" in round_diagram((None, 8)).error
    assert "'Lift' begins below zero, where no distance from the pole is" in round_diagram((-1, 12)).error


def test_a_group_of_bars_has_a_range() -> None:
    assert barred(None).groups[0].range == []
    assert barred((-15, "bore")).groups[0].range == [-0.015, 0.02]
    assert "less reaches -10 mm, outside of the range of 'Bores', -5 mm to …; widen it" in barred((-5, None)).error


def test_what_leaves_the_range_is_a_fault_of_the_figure_in_words() -> None:
    told = plotted((0, 8)).error
    assert told.startswith("h reaches 10 mm, outside of the range of 'Lift', 0 mm to 8 mm; widen it")
    assert "20 mm to 10 mm, which is none" in plotted(("bore", 10)).error


def test_a_charts_panel_has_a_range_in_its_unit() -> None:
    def chart(limits: Any, **more: Any) -> FigureRecord:
        panel = chart_panel(
            "Lift", "mm", "Turn", "φ", "deg", lines=[line([0, 1], [0.001, np.nan], "h")], range=limits, **more
        )
        drawn = Chart("own", "Own", "", build=lambda view: [panel])
        return figures(calculate(replace(MECHANISM, figures=(drawn,)), flatten(Geared(bearing="6204"))))[0]

    assert chart((0, 2)).panels[0].range == [0, 0.002]
    assert "h reaches 1 mm, outside of the range of 'Lift', … to 0.5 mm" in chart((None, 0.5)).error
    assert "top reaches 3 mm" in chart((0, 2), levels=[level(0.003, "top")]).error


GEARED = "  a: {kind: geared, bearing: '6204', teeth: 17}\n"
AS_GIVEN = "  a: {kind: geared, bore_given: 30 mm, teeth: 17}\n"


@pytest.fixture
def plugins(tmp_path: Path) -> Discovery:
    folder = tmp_path / "plugins"
    folder.mkdir()
    (folder / "geared.py").write_text("from tests.machine.geared import MECHANISM\n", "utf-8")
    return Discovery([folder])


def test_the_report_prints_rows_sources_and_the_line_between(tmp_path: Path, plugins: Discovery) -> None:
    outcome = Press.read(saved(tmp_path, HEAD + GEARED), plugins).calculate().report(tmp_path / "out", ["html"])
    text = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert outcome.broken == ()
    assert text.count("From “Bearings” for 6204<") == 1  # of the bore and of the capacity together
    assert text.count("Bearings: List one; List two") == 1
    plain = re.sub("<[^>]*>", "", text).replace("\u00a0", " ")
    assert "Rows of the table: z1 = 15, Y1 = 0.29; z2 = 20, Y2 = 0.32." in plain
    assert plain.count("Factors of teeth: Book one; Book two") == 1


def test_the_report_says_what_is_as_given(tmp_path: Path, plugins: Discovery) -> None:
    Press.read(saved(tmp_path, HEAD + AS_GIVEN), plugins).calculate().report(tmp_path / "out", ["html"])
    text = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert "Bore: as given" in text and "From “Bearings”" not in text


def test_in_a_study_what_is_outside_of_a_table_is_marked_in_words(tmp_path: Path, plugins: Discovery) -> None:
    base = loaded(tmp_path, HEAD + GEARED, plugins)
    teeth = [12.0, 13.0, 31.0, 30.0]
    rows = calculate_rows(base, {find_input(base, "mechanisms.a.teeth"): np.array(teeth)}, 4)
    assert list(rows.status) == ["pass", "pass", "error", "pass"]
    assert "mechanisms.a.teeth: is z = 31, outside of the table “Factors of teeth”" in rows.errors[2]
    wanted = np.interp(teeth, *(column.values for column in FACTORS.columns))
    assert rows.columns["a.factor"][[0, 1, 3]] == pytest.approx(wanted[[0, 1, 3]])
    assert rows.slow == {}


def test_in_a_study_what_may_be_given_is_given_for_all(tmp_path: Path, plugins: Discovery) -> None:
    base = loaded(tmp_path, HEAD + AS_GIVEN, plugins)
    rows = calculate_rows(base, {find_input(base, "mechanisms.a.bore_given"): np.array([0.01, 0.02])}, 2)
    assert rows.columns["a.bore"] == pytest.approx([0.01, 0.02])


def diagram(
    limits: tuple[float | None, float | None] | None, heights: list[float], *, zero: bool = True
) -> tuple[float, float]:
    line = ChartLine(np.arange(len(heights)), np.array(heights), "v")
    return PanelData(title="v", unit="1", across=Across("t", "t", "s", 0, 1), lines=[line], levels=[Note(0, heights[0], "")],
                 zero=zero, limits=limits).heights  # fmt: skip


def test_a_diagram_has_the_range_that_is_given_and_room_at_a_free_end() -> None:
    assert diagram((0, 2), [0.99, 1.01]) == (0, 2)
    low, high = diagram((0, None), [0.99, 1.01], zero=False)
    assert low == 0 and high == pytest.approx(1.01 * 1.08)
    low, high = diagram((None, None), [0.99, 1.01])
    assert (low, high) == pytest.approx((0.99 - 0.0016, 1.01 + 0.0016))  # tight, where zero would be shown without it
    assert diagram(None, [0.99, 1.01])[0] < 0


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
    speed = Quantity("n", "rpm", "Speed", gt=0)
    swing = Quantity("Δn", "rpm", "Swing of the speed", ge=0)
    n_points = samples(36)


chapter = Chapter("Bearing")
for kind, symbol in KINDS.items():
    name = kind.replace("-", "_")
    chapter[name] = interpolated(LIFE, of="speed", interpolation=kind), f"F_{symbol}", "kN", "Force"  # type: ignore[arg-type]
chapter.turn = abscissa(period=2 * np.pi), "φ", "deg", "Turn"
chapter.here = m.speed + m.swing * np.sin(m.turn), "n_φ", "rpm", "Speed at a place"
chapter.force = interpolated(LIFE, of="here", key="swing", interpolation="log-log"), "F", "kN", "Force there"
chapter.mean = reduction("mean", of="force"), "F_m", "kN", "Mean force"
chapter.greatest = reduction("max", of="force"), "F_max", "kN", "Greatest force"
BEARING = Mechanism(kind="bearing", version="1", title="Bearing", summary="Of a table.", inputs=Bearing, chapters=(chapter,))  # fmt: skip


def forms(speed: float) -> dict[str, float]:
    """What SciPy's and NumPy's own straight lines give on axes of logarithms, kN."""
    x, y, at = np.log10(SPEEDS), np.log10(FORCES), np.log10(speed)
    return {"log_x": np.interp(at, x, FORCES), "log_y": 10 ** np.interp(speed, SPEEDS, y), "log_log": 10 ** np.interp(at, x, y)}  # fmt: skip


def made(speed: float, swing: float = 0.0) -> Calculation:
    return calculate(BEARING, flatten(Bearing(speed=f"{speed!r} rpm", swing=f"{swing!r} rpm")))  # type: ignore[arg-type]


def test_the_declaration_of_logarithmic_tables_is_sound() -> None:
    assert faults(BEARING) == []
    check_mechanism(BEARING)


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
def test_many_variants_of_a_logarithmic_table_are_each_alone(count: int) -> None:
    turns = 2 * np.pi / 60
    speed, swing = np.linspace(120, 600, count), np.linspace(5, 80, count)
    swing[1] = 1000  # below nothing, where no logarithm is
    given = flatten(Bearing(speed="300 rpm", swing="0 rpm"))  # type: ignore[arg-type]
    many = calculate(BEARING, given | {"speed": speed * turns, "swing": swing * turns}, count)
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
        Chapter("Own").own = interpolated(table, of="x", interpolation=kind), "Y", "1", "Own"
    assert told in str(fault.value)


def test_a_column_whose_axis_is_not_logarithmic_may_have_any_numbers() -> None:
    table = own_table(
        title="Own", columns={"x": "1", "y": "1"}, rows=((1, -1), (2, 0)), sources=("A",), only_source="own"
    )
    Chapter("Own").own = interpolated(table, of="x", interpolation="log-x"), "Y", "1", "Own"


RODS = own_table(
    title="Cylinders",
    columns={"bore": "mm", "rod": "mm"},
    rows=((25, 12), (32, 14), (40, 20)),
    sources=("One list", "Another list"),
)
MOTORS = own_table(
    title="Motors",
    columns={"P": "kW", "m": "kg"},
    rows={"a90": (1.5, 14), "a80": (0.75, 9), "a100": (3, 30)},
    sources=("One list", "Another list"),
)


class Column(Block):
    bore = Quantity("D_i", "mm", "Bore of a column", gt=0)


class Lift(Inputs):
    needed = Quantity("D_n", "mm", "Bore that is needed", gt=0, default=30)
    bore_given = Quantity("D_g", "mm", "Bore of another cylinder", gt=0, optional=True)
    power = Quantity("P_n", "kW", "Power that is needed", gt=0, default=1)
    columns = parts(Column, "Columns", optional=True)


sizes = Chapter("Sizes")
sizes.bore = pick("above", of="needed", series=RODS.series("bore")), "D", "mm", "Bore"
sizes.rod = lookup(RODS, by="bore", column="rod"), "d", "mm", "Rod"
sizes.own_rod = lookup(RODS, by="bore_given", column="rod", needs=("bore_given",)), "d_o", "mm", "Rod of another"
sizes.rating = pick("above", of="power", series=MOTORS.series("P")), "P", "kW", "Rating"
sizes.mass = lookup(MOTORS, by="rating", sought_in="P", column="m"), "m", "kg", "Mass of the motor"
several = Chapter("Columns", needs=("columns",), absent="no columns")
several.rods = lookup(RODS, by="columns.bore", column="rod"), "d_i", "mm", "Rods of the columns"

LIFT = Mechanism(kind="lift", version="1", title="Lift", summary="A lift.", inputs=Lift, chapters=(sizes, several))


def lift(**inputs: Any) -> Calculation:
    return calculate(LIFT, flatten(Lift(**inputs)))


def lift_item(calc: Calculation, title: str) -> dict[str, Any]:
    items = [each for section in section_items(calc) for each in section["items"]]
    return next(each for each in items if title in (each.get("description"), each.get("title")))


def test_the_declaration_of_a_lookup_by_number_is_sound() -> None:
    assert faults(LIFT) == []
    check_mechanism(LIFT)


def test_a_picked_number_takes_its_own_row_and_prints_it() -> None:
    calc = lift(needed="30 mm")
    assert calc["rod"][0, 0] == pytest.approx(0.014, rel=1e-15)
    printed = lift_item(calc, "Rod")
    assert (printed["type"], printed["by"], printed["key"]) == ("lookup", "Bore", "D = 32 mm")
    assert (printed["table"], printed["column"]) == ("Cylinders", "rod")
    assert printed["result"] == {"text": "14", "unit": "mm"} and printed["note"] == "Cylinders: One list; Another list"


def test_a_number_is_sought_in_the_column_that_is_named() -> None:
    calc = lift(power="1 kW")
    assert (calc["rating"][0, 0], calc["mass"][0, 0]) == (1500, 14)


def test_each_of_repeated_parts_has_its_row() -> None:
    calc = lift(columns=[{"bore": "40 mm"}, {"bore": "25 mm"}])
    assert calc["rods"][0] == pytest.approx([0.020, 0.012])
    assert lift_item(calc, "Rods of the columns")["rows"] == [["1", "40", "20"], ["2", "25", "12"]]


@pytest.mark.parametrize(
    ("inputs", "key", "told"),
    [
        ({"bore_given": "33 mm"}, "bore_given", "is D_g = 33 mm, which no row of the table “Cylinders” has for Rod of another (d_o)"),
        ({"columns": [{"bore": "25 mm"}, {"bore": "26 mm"}]}, "columns.1.bore", "is D_i = 26 mm, which no row"),
    ],
)  # fmt: skip
def test_a_number_that_no_row_has_is_refused_at_its_input(inputs: dict[str, Any], key: str, told: str) -> None:
    with pytest.raises(Impossible) as refused:
        lift(**inputs)
    assert refused.value.key == key and refused.value.message.startswith(told)
    assert refused.value.message.endswith("the nearest have 25, 32, 40 mm")


def test_many_machines_have_each_its_row_and_those_without_one_are_marked() -> None:
    given = np.array([0.025, 0.033, 0.040, 0.032])
    calc = calculate(LIFT, flatten(Lift()) | {"needed": np.array([0.02, 0.03, 0.026, 0.04]), "bore_given": given}, 4)
    assert calc["rod"][:, 0] == pytest.approx([0.012, 0.014, 0.014, 0.020])
    assert list(calc.flaws) == [1] and calc.flaws[1][0] == "bore_given"
    assert calc["own_rod"][[0, 2, 3], 0] == pytest.approx([0.012, 0.020, 0.014])
