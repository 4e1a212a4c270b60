"""Numbers of tables: as given or by a text, several columns of a row, between rows; for one machine and for many."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from diecut_report.api import BarGroup, Bars, Chart, Polar, Series, chart_panel, level, line
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.formulas.formula import evaluate
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.quantities.units import unit
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
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
    drawn = (Series(curve="lift", label="h"),)
    return figured(Polar(id="p", title="Lift", caption="", abscissa="turn", unit="mm", series=drawn, range=limits))


def barred(limits: Any) -> FigureRecord:
    group = BarGroup(label="Bores", unit="mm", bars=(("one", "bore"), ("less", "-lift_max")), range=limits)
    return figured(Bars(id="b", title="Bars", caption="", groups=(group,)))


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
        drawn = Chart(id="own", title="Own", caption="", build=lambda view: [panel])
        return figures(calculate(replace(MECHANISM, figures=(drawn,)), flatten(Geared(bearing="6204"))))[0]

    assert chart((0, 2)).panels[0].range == [0, 0.002]
    assert "h reaches 1 mm, outside of the range of 'Lift', … to 0.5 mm" in chart((None, 0.5)).error
    assert "top reaches 3 mm" in chart((0, 2), levels=[level(0.003, "top")]).error
