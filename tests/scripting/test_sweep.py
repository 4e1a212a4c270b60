"""Tables of many machines: each row is the machine that its values give alone; what is asked wrongly is told in words."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pint
import pyarrow as pa
import pytest

import diecut_report as dr
from diecut_report.report.figures.style import plotted
from tests.configs import BROKEN, EXAMPLE, GOOD, HEAD

TEXT = (
    HEAD
    + """\
  a: {kind: lever, force: 2 kN, allowable_moment: 250 N*m}
  b: {kind: lever, force: "${a.moment} / (1 m)", arm: 50 mm}
"""
)


@pytest.fixture(scope="module")
def press() -> dr.LoadedPress:
    return dr.loads(TEXT, plugins=[GOOD])


def test_each_row_is_the_machine_of_its_values(press: dr.LoadedPress) -> None:
    table = press.sweep({"a.arm": ["100 mm", 0.12 * 1000], "a.teeth": [20, 16, 200]})
    assert len(table) == 6 and table.counts() == {"error": 2, "pass": 4}
    arms, moments = table["mechanisms.a.arm"], table["a.moment"]
    for row in (0, 1, 3, 4):
        alone = press.with_values({"a.arm": f"{arms[row]} m", "a.teeth": int(table["a.teeth"][row])}).calculate()
        assert alone["a"].moment.value == moments[row] and alone["b"].moment.value == table["b.moment"][row]
        assert alone.status == table["status"][row] and alone["a"]["size"].value == table["a.size"][row]
        assert alone.governing is not None and table["governing"][row] == "a.checks.moment"
        assert alone.governing.utilisation == table["a.checks.moment.utilisation"][row]
    assert np.isnan(moments[[2, 5]]).all() and "a hundred at most" in table["error"][2]


def test_what_the_calculation_presumes_does_not_govern_here_either() -> None:
    knife = dr.load(EXAMPLE.with_name("circular_knife.yaml"))
    table = knife.sweep({"knife.friction": [0.3]}, outputs=["knife.force_max"])
    governing = knife.calculate().governing
    assert governing is not None and table["governing"][0] == f"{governing.mechanism}.checks.{governing.id}"


@pytest.mark.parametrize(
    ("given", "arms"),
    [
        (dr.linspace("80 mm", "0.12 m", 3), [0.08, 0.1, 0.12]),
        (np.linspace(80, 120, 3), [0.08, 0.1, 0.12]),
        (pint.Quantity(np.array([8, 12]), "cm"), [0.08, 0.12]),
        ([dr.QuantityValue(8, "cm"), pint.Quantity(12, "cm")], [0.08, 0.12]),
        ({"from": "10 mm", "to": "1000 mm", "count": 3, "spacing": "log"}, [0.01, 0.1, 1]),
        (("80 mm",), [0.08]),
    ],
)
def test_values_come_in_many_forms(press: dr.LoadedPress, given: Any, arms: list[float]) -> None:
    table = press.sweep({"mechanisms.a.arm": given}, outputs=["a.moment"])
    assert table["mechanisms.a.arm"] == pytest.approx(arms)
    assert table["a.moment"] == pytest.approx(2000 * np.array(arms))


def test_texts_samples_and_constraints_are_those_of_a_study(press: dr.LoadedPress) -> None:
    zipped = press.sweep({"a.grade": ["fine", "coarse"], "a.hard": [True, False]}, method="zip", outputs=["a.moment"])
    assert zipped["a.grade"].tolist() == ["fine", "coarse"] and zipped["a.hard"].tolist() == ["true", "false"]
    drawn = [
        press.sweep(
            {"a.arm": dr.linspace("50 mm", "150 mm", 2) | {"count": None}}, method="latin_hypercube", count=8, seed=seed
        )
        for seed in (1, 1, 2)
    ]
    assert drawn[0].to_arrow().equals(drawn[1].to_arrow())
    assert not drawn[0].to_arrow().equals(drawn[2].to_arrow())
    assert len(drawn[0]) == 8
    kept = press.sweep({"a.arm": [50, 100, 200]}, constraints=["mechanisms.a.arm >= '90 mm'", "a.moment < '300 N*m'"])
    assert kept["mechanisms.a.arm"].tolist() == [0.1] and kept["variant"].tolist() == [1]


def test_a_table_goes_to_arrow_numpy_pandas_and_polars(press: dr.LoadedPress, monkeypatch: pytest.MonkeyPatch) -> None:
    table = press.sweep({"press.productivity": ["6000 1/h", "3000 1/h"]}, outputs=["a.moment", "a.size"])
    arrow, rows = table.to_arrow(), table.to_numpy()
    assert arrow.schema.field("a.moment").metadata == {b"unit": b"N*m", b"symbol": b"M", b"description": b"Moment"}
    assert rows["a.moment"].tolist() == [200, 200] == arrow.column("a.moment").to_pylist()
    assert rows["a.size"].tolist() == ["large"] * 2
    assert table.columns["press.productivity"].unit == "1/s" and repr(table).startswith("<2 machines (2 pass); ")
    monkeypatch.setitem(sys.modules, "polars", None)
    with pytest.raises(dr.ConfigError, match="polars is not installed"):
        table.to_polars()
    taken: list[pa.Table] = []
    monkeypatch.setitem(sys.modules, "polars", made("polars", from_arrow=taken.append))
    table.to_polars()
    table.to_polars(shown=True)
    assert taken[0] == arrow and table.units()["press.productivity"] == "1/s"
    shown = taken[1]
    assert shown.column("press.productivity [1/h]").to_pylist() == [6000, 3000]
    assert shown.column("a.moment [N·m]").to_pylist() == [200, 200] and "status" in shown.column_names
    frame = SimpleNamespace(attrs={})
    monkeypatch.setitem(sys.modules, "pandas", made("pandas"))
    monkeypatch.setattr(
        "diecut_report.scripting.sweeps.SweepTable.to_arrow", lambda _: SimpleNamespace(to_pandas=lambda **_: frame)
    )
    assert table.to_pandas() is frame and frame.attrs["units"]["a.moment"] == "N*m"


def test_columns_are_drawn_in_the_units_of_a_report(press: dr.LoadedPress) -> None:
    table = press.sweep({"press.productivity": ["6000 1/h", "3000 1/h"]}, outputs=["a.moment"])
    axes = table.plot("press.productivity", "a.moment")
    assert axes.lines[0].get_xdata().tolist() == [6000, 3000] and axes.get_xlabel().endswith(", 1/h")
    assert axes.get_ylabel() == "Moment, N·m" and table.plot("press.productivity", "a.moment", axes) is axes


def test_a_long_label_is_set_in_lines_so_that_its_unit_is_seen() -> None:
    label = "Planetary drive: maximum acceleration in the working stroke, m/s²"
    axes = plotted([0, 1], [0, 1], ("Angle, °", label))
    axes.figure.draw_without_rendering()
    extent, page = axes.yaxis.label.get_window_extent(), axes.figure.bbox
    assert page.y0 <= extent.y0 and extent.y1 <= page.y1
    assert axes.get_ylabel().replace("\n", " ") == label


def made(name: str, **parts: Any) -> ModuleType:
    module = ModuleType(name)
    module.__dict__.update(SimpleNamespace(**parts).__dict__)
    return module


def test_a_table_is_shown_with_its_first_machines(press: dr.LoadedPress) -> None:
    html = press.sweep({"b.arm": dr.linspace("10 mm", "90 mm", 40)}, outputs=["b.moment"])._repr_html_()
    assert "40: 40 pass" in html and html.count("<tr>") == 14 and "N·m" in html and "<script" not in html


def test_all_that_is_wrong_with_the_question_is_told_at_once_and_without_lines(press: dr.LoadedPress) -> None:
    with pytest.raises(dr.ConfigError) as caught:
        press.sweep({"a.arm": ["2 kg", "2 m"], "a.forc": [1]}, outputs=["a.momend"], constraints=["a.moment > 3"])
    told = {problem.path: str(problem) for problem in caught.value.problems}
    assert {
        "vary.mechanisms.a.arm.0",
        "vary.mechanisms.a.arm.1",
        "vary.mechanisms.a.forc",
        "outputs.0",
        "constraints.0",
    } == set(told)
    assert (
        told["vary.mechanisms.a.arm.1"]
        == "vary.mechanisms.a.arm.1: 2 m is out of range; allowed: > 0 mm, ≤ 1000 mm. Is 2 mm meant?"
    )


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ({}, "vary: is missing or empty; vary at least one path."),
        (
            {"a.arm": dr.linspace(1, 2, 100_000), "a.teeth": dr.linspace(12, 99, 88)},
            "there are 8800000 machines; a table has at most 1000000.",
        ),
        ({"a.arm": [object()]}, "a.arm.0: is <object object"),
        ({"a.arm": 3}, "vary.mechanisms.a.arm: is 3; a list of values, a range"),
    ],
)
def test_a_question_without_an_answer_is_refused(press: dr.LoadedPress, vary: Any, words: str) -> None:
    with pytest.raises(dr.ConfigError) as caught:
        press.sweep(vary)
    assert words in str(caught.value)


def test_a_column_that_is_not_there_tells_the_nearest(press: dr.LoadedPress) -> None:
    with pytest.raises(KeyError, match=r"the table has no column 'a\.momen'"):
        press.sweep({"b.arm": [50]}, outputs=["a.moment"])["a.momen"]


def test_a_plugin_that_breaks_on_all_machines_is_named() -> None:
    press = dr.loads(HEAD + "  a: {kind: breaks_in_calculation}\n", plugins=[BROKEN])
    with pytest.raises(dr.PluginError, match="the plugin fell over"):
        press.sweep({"a.length": [10, 20]})


def test_plugins_folder_may_be_a_path(tmp_path: Path) -> None:
    assert dr.loads(TEXT, plugins=str(GOOD)).instances == {"a": "lever", "b": "lever"}
