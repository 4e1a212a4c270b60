"""A press in a script: loaded from a file, a text, a mapping; its inputs; other values; what is wrong, with its places."""

from __future__ import annotations

import ast
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pint
import pytest

import diecut_report
import diecut_report as dr
from diecut_report.cli.main import main
from tests.configs import EXAMPLE, GOOD, HEAD, SMALL, saved

TEXT = (
    HEAD
    + """\
  a: {kind: lever, force: 2 kN, arm: {value: 90 mm, basis: assumed, note: from the layout}}  # the lever
  b: {kind: lever, force: "${a.moment} / (50 mm)", grade: coarse}
"""
)
Capture = pytest.CaptureFixture[str]


@pytest.fixture
def press(tmp_path: Path) -> dr.LoadedPress:
    return dr.load(saved(tmp_path, TEXT), plugins=[GOOD])


def test_a_file_a_text_and_a_mapping_give_the_same_machine(press: dr.LoadedPress) -> None:
    data = {
        "schema_version": 1, "project": {"title": "Test"}, "press": {"name": "P", "productivity": 6000},
        "mechanisms": {"a": {"kind": "lever", "force": dr.QuantityValue(2000.0, "N"), "arm": pint.Quantity(9, "cm")}},
    }  # fmt: skip
    made = [press.calculate(), dr.loads(TEXT, plugins=[GOOD]).calculate(), dr.load(data, plugins=GOOD).calculate()]
    assert [each["a"].moment.value for each in made] == [180.0] * 3
    assert made[0]["b"].moment.si == pytest.approx(180 / 0.05 * 0.1)


def test_inputs_tell_path_value_unit_range_and_what_they_rest_on(press: dr.LoadedPress) -> None:
    arm, force = press.inputs["a.arm"], press.inputs["b.force"]
    assert (arm.value, arm.typed, arm.unit, arm.allowed) == (
        dr.QuantityValue(0.09, "m"),
        "90 mm",
        "mm",
        "> 0 mm, ≤ 1000 mm",
    )
    assert (arm.basis, arm.note, arm.kind) == ("assumed", "from the layout", "lever")
    assert (force.value, force.typed) == (None, "${a.moment} / (50 mm)")
    assert press.inputs["mechanisms.a.teeth"].value == 20 and not press.inputs["a.teeth"].is_given
    assert press.inputs["a.grade"].allowed == "fine, coarse"
    assert press.inputs["press.sheet.length"].value == dr.QuantityValue(700, "mm")
    assert press.instances == {"a": "lever", "b": "lever"}


@pytest.mark.parametrize(
    "value",
    [
        "0.12 m",
        120,
        120.0,
        np.float64(120),
        np.int64(120),
        dr.QuantityValue(12, "cm"),
        dr.QuantityValue(np.float64(0.12), "m"),  # of a column of a table
        pint.Quantity(12, "cm"),
        pint.Quantity(0.12, "m"),
    ],
)
def test_other_values_give_another_press_and_leave_the_first_as_it_is(press: dr.LoadedPress, value: object) -> None:
    other = press.with_values({"a.arm": value, "b.hard": True, "b.grade": "fine", "project.title": "A: b"})
    assert other.inputs["a.arm"].value == dr.QuantityValue(0.12, "m") and other.title == "A: b"
    assert other.calculate()["a"].moment.value == pytest.approx(240)
    assert press.inputs["a.arm"].value == dr.QuantityValue(0.09, "m") and press.text == TEXT
    assert "# the lever" in other.text and "basis: assumed" in other.text
    assert other.inputs["b.hard"].value is not None and other.inputs["b.hard"].value.value is True


@pytest.mark.parametrize("one", [dr.QuantityValue(3, "m") / dr.QuantityValue(2, "m"), pint.Quantity(1.5, "")])
def test_a_pure_number_with_its_unit_is_none_of_another_kind(press: dr.LoadedPress, one: object) -> None:
    with pytest.raises(dr.ConfigError, match="is a pure number; a length is needed"):
        press.with_values({"a.arm": one})
    assert press.with_values({"a.teeth": dr.QuantityValue(24, "1")}).inputs["a.teeth"].value == 24


def test_the_value_of_an_input_may_be_given_again(press: dr.LoadedPress) -> None:
    """Of any kind: numbers with and without a unit, counts, texts and flags."""
    given = {each.path: each.value for each in press.inputs if each.path.startswith("a.")}
    kinds = {type(each.value) for each in given.values() if isinstance(each, dr.QuantityValue)}
    assert {bool, str, float} <= kinds
    again = press.with_values({path: each for path, each in given.items() if each is not None})
    assert {path: again.inputs[path].value for path in given} == given


def test_a_reference_is_written_over_and_may_be_given(press: dr.LoadedPress) -> None:
    other = press.with_values({"b.force": "3 kN", "a.arm": "${press.sheet.length} / 7"})
    assert [other.calculate()[name].moment.value for name in "ab"] == pytest.approx([200, 300])


def test_no_values_are_the_same_press(press: dr.LoadedPress) -> None:
    assert press.with_values({}) is press


@pytest.mark.parametrize("key", [5, None, ("a", "arm")])
def test_a_key_that_is_no_text_is_told(press: dr.LoadedPress, key: object) -> None:
    with pytest.raises(dr.UserError):
        press.with_values({key: 1})  # type: ignore[dict-item]


def test_all_that_is_wrong_with_values_is_told_at_once_with_its_places(press: dr.LoadedPress) -> None:
    with pytest.raises(dr.ConfigError) as caught:
        press.with_values({"a.forc": 1, "a.arm": "2 m", "b.teeth": "20 kg", "a.width": [1, 2], "a.moment": 3})
    told = {problem.path: problem for problem in caught.value.problems}
    assert set(told) == {"a.forc", "a.width", "a.moment", "mechanisms.a.arm.value", "mechanisms.b.teeth"}
    assert "did you mean 'force'?" in told["a.forc"].message and "is an output" in told["a.moment"].message
    arm = told["mechanisms.a.arm.value"]
    assert (arm.line, arm.column, arm.allowed) == (5, 46, "> 0 mm, ≤ 1000 mm") and "out of range" in arm.message
    assert arm.file == press.config.tree.file


def test_an_error_says_what_the_command_says(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, TEXT.replace("2 kN", "2 kg").replace("coarse", "corse"))
    for language in ("en", "uk"):
        main(["validate", str(file), "--plugins", str(GOOD), "--language", language])
        with pytest.raises(dr.ConfigError) as caught:
            dr.load(file, plugins=[GOOD], language=language)
        assert str(caught.value) == capfd.readouterr().err.rstrip("\n")
    first, second = caught.value.problems
    assert (first.allowed, second.allowed, second.line, second.column) == ("> 0 kN", "fine, coarse", 6, 59)


def test_a_mapping_has_no_lines(tmp_path: Path) -> None:
    with pytest.raises(dr.ConfigError) as caught:
        dr.load(
            {
                "schema_version": 1,
                "project": {"title": "T"},
                "press": {"name": "P"},
                "mechanisms": {"a": {"kind": "levr"}},
            },
            plugins=[GOOD],
        )
    (problem,) = caught.value.problems
    assert str(problem).startswith("mechanisms.a.kind: 'levr' is not a known kind (did you mean 'lever'?)")
    assert problem.line is None


def test_an_impossible_machine_is_told_with_its_place(press: dr.LoadedPress) -> None:
    assert press.validate() == ()
    wrong = press.with_values({"a.teeth": 200})
    (problem,) = wrong.validate()
    assert (problem.path, problem.line) == ("mechanisms.a.teeth", 5) and "a hundred at most" in problem.message
    with pytest.raises(dr.ConfigError, match="a hundred at most"):
        wrong.calculate()


def test_a_press_is_saved_as_text(press: dr.LoadedPress, tmp_path: Path) -> None:
    file = press.with_values({"a.arm": "80 mm"}).save(tmp_path / "other" / "press.yaml")
    assert file.read_text("utf-8") == TEXT.replace("90 mm", "80 mm")
    with pytest.raises(dr.UserError, match="a folder has this name"):
        press.save(tmp_path)


def test_what_an_editor_saved_meanwhile_is_not_written_over(press: dr.LoadedPress, tmp_path: Path) -> None:
    file = tmp_path / "press.yaml"
    for arm in ("80 mm", "70 mm"):  # of one press, one after the other: the script knows what stands there
        press.with_values({"a.arm": arm}).save(file)
    assert file.read_text("utf-8") == TEXT.replace("90 mm", "70 mm")
    edited = TEXT + "# a note\n"
    file.write_text(edited, "utf-8")
    with pytest.raises(dr.UserError, match="Another program has saved this file meanwhile"):
        press.save(file)
    assert file.read_text("utf-8") == edited
    assert dr.load(file, plugins=[GOOD]).save(file).read_text("utf-8") == edited


@pytest.mark.wheel
def test_the_installed_program_serves_scripts() -> None:
    press = dr.loads(SMALL)
    assert "clutch.torque" in press._repr_html_() and "clutch." in press.calculate()._repr_html_()


def test_an_unknown_name_tells_the_nearest(press: dr.LoadedPress) -> None:
    with pytest.raises(KeyError) as caught:
        press.inputs["a.forze"]
    assert isinstance(caught.value, dr.UnknownName)
    assert str(caught.value) == "there is no input 'a.forze' (did you mean 'a.force'?)."


def test_an_unknown_language_is_refused() -> None:
    with pytest.raises(dr.ConfigError, match="'xx', of which the program has no catalogue; allowed: en, uk"):
        dr.loads(TEXT, language="xx")


def test_a_press_is_shown_by_its_name_and_inputs(press: dr.LoadedPress) -> None:
    assert repr(press).startswith("<press P of ") and repr(press).endswith(": a, b>")
    html = press.with_values({"a.remark": "<script>alert(1)</script>"})._repr_html_()
    assert "a.arm" in html and "90\N{NO-BREAK SPACE}mm" in html and "&lt;script&gt;" in html and "<script" not in html


def test_a_margin_in_milliseconds_is_read_and_given_again_as_it_is() -> None:
    """It read a thousand times too small: an SI number in the unit of the file."""
    press = dr.load(EXAMPLE.with_name("flat_cylinder_press_mended.yaml"))
    name = "timing.interlocks.0.margin"
    value = press.inputs[name].value
    assert (str(value), value.si, value.unit) == ("5 ms", 0.005, "s")
    assert press.with_values({name: value}).inputs[name].value.si == 0.005


# What ``import diecut_report`` offers: loaded when it is asked for, and known to type checkers as what it is.


TREE = ast.parse(Path(diecut_report.__file__).read_text("utf-8"))


def typed() -> dict[str, str]:
    """The names that type checkers see, each with the module that it is imported from."""
    (block,) = (node for node in TREE.body if isinstance(node, ast.If))
    found = [
        (alias.name, node.module) for node in block.body if isinstance(node, ast.ImportFrom) for alias in node.names
    ]
    return {name: str(module) for name, module in found}


def test_importing_it_loads_nothing_that_takes_time() -> None:
    code = (
        "import sys, typing; before = set(sys.modules); import diecut_report; assert set(sys.modules) - before == {'diecut_report'}\n"
        "diecut_report.load; assert 'matplotlib' not in sys.modules and 'pyarrow' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("name", sorted(set(diecut_report.__all__) - {"__version__"}))
def test_each_name_is_what_type_checkers_take_it_for(name: str) -> None:
    assert getattr(diecut_report, name).__module__ == typed()[name]


def test_all_names_are_offered_and_completed() -> None:
    assert {*typed(), "__version__"} == set(diecut_report.__all__) == set(dir(diecut_report))


def test_another_name_is_refused_as_of_any_module() -> None:
    with pytest.raises(AttributeError, match="no attribute 'lod'"):
        diecut_report.lod  # noqa: B018


# Quantities: in other units, compared, printed, and to pint and back.


TORQUE = dr.QuantityValue(523.4, "N*m", "crank_torque_peak", "M_max", "Peak torque")


def test_a_quantity_is_told_in_any_unit_of_its_dimension() -> None:
    assert TORQUE.to("kN*mm").value == pytest.approx(523.4) and TORQUE.to("kN*m").value == 0.5234
    assert dr.QuantityValue(2 * math.pi, "rad/s").to("rpm").magnitude == pytest.approx(60)
    assert dr.QuantityValue(90, "deg").si == pytest.approx(math.pi / 2)
    assert TORQUE.to("kN*m").to("N*m") == TORQUE and TORQUE.to("kN*m").description == "Peak torque"


@pytest.mark.parametrize(
    ("other", "words"),
    [("mm", "crank_torque_peak: 523.4 N·m is a moment in N*m; mm is a length."), ("Nn", "is not a known unit")],
)
def test_another_dimension_is_refused_in_words(other: str, words: str) -> None:
    with pytest.raises(dr.ConfigError) as caught:
        TORQUE.to(other)
    assert words in str(caught.value)


def test_quantities_are_compared_by_what_they_are_not_by_their_units() -> None:
    assert dr.QuantityValue(0.5234, "kN*m") == TORQUE and hash(TORQUE) == hash(TORQUE.to("kN*m"))
    assert "500 N*m" < TORQUE <= dr.QuantityValue(1, "kN*m") and TORQUE > 0 and TORQUE != 523.4
    assert dr.QuantityValue(3) == 3 and dr.QuantityValue("steel") == "steel" and {dr.QuantityValue(3): 1}[3] == 1
    assert dr.QuantityValue(523.4, "J/rad") != TORQUE
    with pytest.raises(dr.ConfigError, match="a moment is needed"):
        assert TORQUE < "3 mm"
    with pytest.raises(TypeError, match="cannot be compared with"):
        assert TORQUE < []  # type: ignore[operator]


@pytest.mark.parametrize("number", [523, 523.4, -1, float("inf")])
def test_a_number_without_a_unit_is_not_compared_with_a_quantity(number: float) -> None:
    with pytest.raises(TypeError, match=r"523\.4 N·m has a unit, and .* has none; compare it with a text, such as '"):
        assert number > TORQUE
    assert dr.QuantityValue(0.5, "1") < 1
    with pytest.raises(TypeError, match="has none"):
        assert dr.QuantityValue(2, "%") > 1


def test_a_number_with_a_unit_is_no_plain_number() -> None:
    assert float(dr.QuantityValue(0.25)) == 0.25
    with pytest.raises(TypeError, match=r"523.4 N·m has a unit; take the number of one, as in .to\('N\*m'\).value"):
        float(TORQUE)
    with pytest.raises(dr.ConfigError, match="steel is not a number"):
        dr.QuantityValue("steel").m_as("mm")


def test_a_quantity_prints_as_a_report_does() -> None:
    assert (str(TORQUE), f"{TORQUE:.0f}", repr(TORQUE)) == ("523.4 N·m", "523 N·m", "<crank_torque_peak: 523.4 N·m>")
    assert f"{TORQUE.to('kN*m')}" == "0.5234 kN·m" and str(dr.QuantityValue(True)) == "yes"
    assert TORQUE._repr_html_() == "<i class=sy>M</i><sub>max</sub> = 523.4\N{NO-BREAK SPACE}N·m"
    assert TORQUE._repr_latex_() == r"$M_{\mathrm{max}} = 523.4\,\mathrm{N}{\cdot}\mathrm{m}$"
    assert "<script>" not in dr.QuantityValue("<script>")._repr_html_()


def test_a_quantity_goes_to_pint() -> None:
    registry = pint.UnitRegistry()
    assert TORQUE.to_pint().to("kN*m").magnitude == pytest.approx(0.5234)
    assert TORQUE.to_pint(registry) == registry.Quantity(523.4, "N*m") and dr.QuantityValue(3).to_pint().dimensionless


def test_quantities_are_reckoned_with_by_pint() -> None:
    arm = dr.QuantityValue(200, "mm")
    assert (TORQUE / arm).m_as("kN") == pytest.approx(2.617) and str((TORQUE / arm).to("kN")) == "2.617 kN"
    assert (2 * TORQUE + TORQUE * 1 - TORQUE / 2).m_as("N*m") == pytest.approx(2.5 * 523.4)
    assert (arm**2).m_as("m**2") == pytest.approx(0.04) and (-arm).m_as("m") == -0.2 == -abs(-arm).m_as("m")
    assert (1 / arm).m_as("1/m") == pytest.approx(5)
    assert (arm - dr.QuantityValue(1, "m")).m_as("mm") == pytest.approx(-800)
    assert float(arm / arm) == 1 and TORQUE / arm / arm * arm * arm > "523 N*m"
    with pytest.raises(pint.DimensionalityError):
        TORQUE + arm
    with pytest.raises(dr.ConfigError, match="is not a number"):
        dr.QuantityValue("steel") * 2
