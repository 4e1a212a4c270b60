"""Results in a script: numbers, checks, curves, phases and figures as the results file has them; the file and the report of the commands."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import diecut_report as dr
from diecut_report.cli.main import main
from diecut_report.mechanism.steps import SilentStep
from tests.configs import BROKEN, DISCOVERY, EXAMPLE, GOOD, HEAD, saved

KNIFE = EXAMPLE.with_name("circular_knife.yaml")
LEVERS = (
    HEAD
    + """\
  a: {kind: lever, force: 2 kN, allowable_moment: 190 N*m}
  b: {kind: lever, force: "${a.moment} / (1 m)", remark: "<b>bold</b>"}
"""
)
Capture = pytest.CaptureFixture[str]


@pytest.fixture(scope="module")
def knife() -> dr.Results:
    return dr.load(KNIFE).calculate()


@pytest.fixture(scope="module")
def levers() -> dr.Results:
    return dr.loads(LEVERS, plugins=[GOOD]).calculate()


def test_outputs_are_attributes_in_si_with_what_a_report_says_of_them(knife: dr.Results) -> None:
    data = json.loads(knife.to_json())["mechanisms"]["knife"]
    torque = knife["knife"].torque_max
    told = data["outputs"]["torque_max"]
    assert (torque.value, torque.unit, torque.symbol, torque.source) == tuple(
        told[key] for key in ("value", "unit", "symbol", "source")
    )
    assert str(torque) == "2.074 N·m" and torque.to("N*mm").value == pytest.approx(1000 * told["value"])
    assert list(knife["knife"]) == list(data["outputs"]) and list(knife["knife"].intermediate) == list(data["values"])
    assert {"torque_max", "checks", "curves"} <= set(dir(knife["knife"]))
    assert knife["knife"].inputs["depth"].basis == "assumed"
    assert knife["knife"].inputs["thickness"].path == "press.sheet.thickness"


def test_the_file_is_that_of_the_command(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, LEVERS)
    assert main(["calc", str(file), "--quiet", "--plugins", str(GOOD)]) == 1
    results = dr.load(file, plugins=[GOOD]).calculate()
    assert results.to_json() == capfd.readouterr().out
    again = dr.load_results(results.save(tmp_path / "results.json"))
    assert again.to_json() == results.to_json()
    assert again["a"].moment == results["a"].moment
    assert again.data == results.data


def test_the_report_is_that_of_the_command(tmp_path: Path) -> None:
    file = saved(tmp_path, LEVERS.replace("force: 2 kN", "force: {value: 2 kN, basis: assumed}"))
    assert (
        main(
            [
                "report",
                str(file),
                "-o",
                str(tmp_path / "made"),
                "--format",
                "html",
                "--plugins",
                str(GOOD),
                "--detail",
                "brief",
                "--quiet",
            ]
        )
        == 1
    )
    made = dr.load(file, plugins=[GOOD]).calculate().report(tmp_path / "own" / "x.html", detail="brief")
    assert made.read_bytes() == (tmp_path / "made" / "press.html").read_bytes()


def test_checks_are_found_by_name_and_are_a_table(knife: dr.Results, levers: dr.Results) -> None:
    reach = knife.checks["knife.reach"]
    assert (reach, knife["knife"].checks["reach"], knife.governing) == (reach,) * 3
    assert reach.demand is not None and reach.limit is not None and reach.margin is not None
    assert reach.margin.si == pytest.approx(reach.limit.si - reach.demand.si)
    assert reach.utilisation == pytest.approx(reach.demand.si / reach.limit.si)
    assert knife.checks["force"].missing == ["allowable_force"] and knife.checks["force"].margin is None
    assert [check.name for check in levers.checks.failing()] == ["a.moment"] and levers.status == "fail"
    table = knife.checks.to_arrow()
    assert table.column("status").to_pylist() == [check.status for check in knife.checks]
    with pytest.raises(dr.UnknownName, match=r"several checks are called 'moment': a\.moment, b\.moment\."):
        levers.checks["moment"]
    with pytest.raises(dr.UnknownName, match=r"there is no check 'reech' \(did you mean 'reach'"):
        knife.checks["reech"]


def test_a_curve_draws_itself_in_the_units_of_a_report(knife: dr.Results) -> None:
    curves = knife["knife"].curves
    axes = curves["torque"].plot(color="red")
    x, y = axes.lines[0].get_data()
    assert x[-1] == pytest.approx(360) and y.max() == pytest.approx(knife["knife"].torque_max.m_as("N*m"))
    starts, ends = (knife["knife"][f"angle_{side}"].m_as("deg") for side in ("start", "end"))
    assert [np.isclose(x, place).sum() for place in (starts, ends)] == [2, 2], "upright where it jumps"
    assert axes.get_xlabel().endswith(", °") and axes.get_ylabel().endswith(", N·m")
    assert curves["knife_angle"].plot(axes) is axes and len(axes.lines) == 2


def test_curves_are_arrays_over_their_abscissa(knife: dr.Results) -> None:
    torque = knife["knife"].curves["torque"]
    assert torque.abscissa is knife["knife"].curves["knife_angle"] and len(torque) == len(torque.abscissa) == 720
    assert torque.to("N*mm") == pytest.approx(1000 * np.asarray(torque)) and not torque.values.flags.writeable
    assert torque.values.max() <= knife["knife"].torque_max.magnitude * (1 + 1e-12)
    with pytest.raises(dr.ConfigError, match="mm is a length"):
        torque.to("mm")


def test_phases_have_their_intervals(knife: dr.Results) -> None:
    (interval,) = knife["knife"].phases["cutting"].intervals
    assert interval == (knife["knife"].angle_start, knife["knife"].angle_end)
    assert repr(knife["knife"].phases["cutting"]) == "<phase cutting: 38.85° … 55.69°>"


def test_figures_are_drawings_as_in_a_report(knife: dr.Results, tmp_path: Path) -> None:
    figure = knife["knife"].figure("load")
    assert figure.title == knife["knife"].figures["load"]
    assert figure.svg.startswith("<svg")
    assert "<script" not in figure._repr_html_()
    assert figure.save(tmp_path / "load.svg").read_text("utf-8") == figure.svg
    with pytest.raises(dr.UnknownName, match=r"knife has no figure 'laod' \(did you mean 'load'"):
        knife["knife"].figure("laod")


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda r: r["clutch"], "there is no mechanism 'clutch'; there are a, b."),
        (lambda r: r["a"]["momend"], "a gives no 'momend' (did you mean 'moment'?)."),
        (lambda r: r["a"].momend, "a gives no 'momend' (did you mean 'moment'?)."),
        (lambda r: r["a"].outputs["momend"], "a has no output 'momend' (did you mean 'moment'?)."),
        (lambda r: r["a"].inputs["forze"], "a has no input 'forze' (did you mean 'force'?)."),
        (lambda r: r["a"].curves["x"], "a has no curve 'x'; there are angle, torque."),
        (lambda r: r["a"].phases["rest"], "a has no phase 'rest'."),
        (lambda r: r["a"].figures["rest"], "a has no figure 'rest'."),
        (lambda r: r.comparisons["rest"], "there is no comparison 'rest'."),
        (lambda r: r.report("x.odt"), "x.odt: '.odt' is not a format of a report; known: html, pdf, docx, xlsx."),
        (lambda r: r.report("x.html", detail="fill"), "detail: 'fill' is not a detail (did you mean 'full'?); known: brief, standard, full."),
        (lambda r: r.report("x.html", only=["c"]), "there is no mechanism 'c'; there are a, b."),
        (lambda r: r.checks.to_pandas(), "pandas is not installed; install it (pip install pandas), or take the table of pyarrow by to_arrow()."),
    ],
)  # fmt: skip
def test_what_is_asked_wrongly_is_told_in_words(
    levers: dr.Results, ask: object, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    levers.checks.to_arrow()  # pyarrow looks for pandas once
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    with pytest.raises(dr.UserError) as caught:
        ask(levers)  # type: ignore[operator]
    assert str(caught.value) == words


def test_an_unknown_attribute_is_no_attribute(levers: dr.Results) -> None:
    assert not hasattr(levers["a"], "momend") and not hasattr(levers["a"], "_repr_png_") and "momend" not in levers["a"]
    assert levers.get("clutch") is None


def test_a_broken_plugin_is_told_and_the_other_results_stand() -> None:
    text = HEAD + "  a: {kind: lever, force: 2 kN}\n  b: {kind: breaks_in_calculation}\n"
    results = dr.loads(text, plugins=[GOOD, BROKEN]).calculate()
    assert results.status == "error" and [error.instance for error in results.errors] == ["b"]
    assert results["a"].moment.value == 200 and results["b"].error
    with pytest.raises(dr.UnknownName, match="b gives no results: "):
        results["b"].moment  # noqa: B018


def test_no_output_of_a_kind_is_hidden_by_what_all_mechanisms_have() -> None:
    common = {name for name in dir(dr.MechanismResults) if not name.startswith("__")}
    outputs = {
        step.id
        for kind in DISCOVERY.origins
        for _, step in DISCOVERY.mechanism(kind).steps
        if not isinstance(step, SilentStep)
    }
    assert len(outputs) > 500 and outputs & common == set()


def test_a_notebook_shows_verdict_checks_and_formulas(levers: dr.Results) -> None:
    shown = levers._repr_html_()
    assert all(text in shown for text in ("1 of 1 checks fails", "a.moment")) and "<script" not in shown
    chapter = levers["b"]._repr_html_()
    assert "<math" in chapter and "Parts in a row" not in chapter
    assert "href=" not in chapter and " id=" not in chapter and "<script" not in chapter
    assert "a.moment" in levers["a"].checks._repr_html_()


def test_a_notebook_speaks_the_language_that_is_asked_for() -> None:
    results = dr.loads(LEVERS, plugins=[GOOD], language="uk").calculate()
    line = (
        "Не виконано 1 перевірку із 1; 1 перевірку не проведено, деталі 2 механізмів не змодельовано "
        "і 4 значення за замовчуванням не підтверджено."
    )
    assert line in results._repr_html_()
    with pytest.raises(dr.UnknownName, match="немає механізму 'c'; наявні: a, b"):
        results["c"]
