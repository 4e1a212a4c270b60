"""Units that depend on which other input is given: in inputs, outputs, references, messages, schema and contract test."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from diecut_report.api import Block, FromPress, Inputs, Mechanism, Quantity, SpectrumLine, Step, block
from diecut_report.config.plugins import Discovery
from diecut_report.config.schema import config_schema, kind_schema
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.errors import UserError
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.chapters import form_keys, in_all_units, in_form, in_unit
from diecut_report.mechanism.inputs import flatten, meta_of
from diecut_report.mechanism.steps import Derivative
from diecut_report.press import Press
from diecut_report.report.equations import Equations
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import ItemRecord, PlaceRecord
from tests.configs import problems, saved
from tests.machine.swing import MECHANISM, RATIOS, SPECTRUM, Swing
from tests.testing.test_calculate import mechanism as of_steps

HEAD = "schema_version: 1\nproject: {title: T}\npress: {name: P}\nmechanisms:\n"
TURNS = HEAD + "  a: {kind: swing, inertia: 1, lift: 1 rad}\n"
SLIDES = HEAD + "  a: {kind: swing, mass: 1, lift: 20, stiffness: 3 N/mm}\n"


@pytest.fixture
def plugins(tmp_path: Path) -> Discovery:
    """The swing and the loop as plugins of a folder."""
    folder = tmp_path / "plugins"
    folder.mkdir()
    for kind in ("swing", "loop"):
        (folder / f"{kind}.py").write_text(f"from tests.machine.{kind} import MECHANISM\n", "utf-8")
    return Discovery([folder])


def found(tmp_path: Path, text: str, plugins: Discovery, name: str = "a") -> dict[str, Any]:
    """The results of one mechanism of a config."""
    made = Press.read(saved(tmp_path, text), plugins).calculate()
    assert not made.broken
    return dict(json.loads(made.text)["mechanisms"][name])


def shown(result: dict[str, Any]) -> tuple[float, str, str]:
    return result["value"], result["unit"], result["display"]["unit"]


# --- inputs and results ----------------------------------------------------------------------------------------------


def test_inputs_and_results_of_a_turning_link_are_in_angles(tmp_path: Path, plugins: Discovery) -> None:
    results = found(tmp_path, TURNS, plugins)
    assert shown(results["inputs"]["stiffness"]) == (100, "N*m/rad", "N*m/rad")
    assert shown(results["inputs"]["lift"]) == (1, "rad", "deg")
    assert shown(results["outputs"]["force_top"]) == (100, "N*m", "N*m")
    assert [results["curves"][n]["unit"] for n in ("position", "speed", "acceleration")] == ["rad", "rad/s", "rad/s**2"]


def test_inputs_and_results_of_a_sliding_link_are_in_lengths(tmp_path: Path, plugins: Discovery) -> None:
    results = found(tmp_path, SLIDES, plugins)
    assert shown(results["inputs"]["stiffness"]) == (3000, "N/m", "N/m")
    assert shown(results["inputs"]["lift"]) == (0.02, "m", "mm")
    assert shown(results["outputs"]["force_top"]) == (60, "N", "N")
    assert [results["curves"][n]["display_unit"] for n in ("position", "speed", "area")] == ["mm", "m/s", "m*s"]
    assert results["curves"]["position"]["left"][0] == pytest.approx(0.02)


def test_a_default_counts_in_the_unit_that_holds(tmp_path: Path, plugins: Discovery) -> None:
    results = found(tmp_path, SLIDES.replace(", stiffness: 3 N/mm", ""), plugins)
    assert shown(results["inputs"]["stiffness"]) == (100, "N/m", "N/m")


def test_an_empty_key_does_not_change_units(tmp_path: Path, plugins: Discovery) -> None:
    results = found(tmp_path, TURNS.replace("inertia: 1", "inertia: 1, mass: null"), plugins)
    assert results["inputs"]["lift"]["unit"] == "rad"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (TURNS.replace("lift: 1 rad", "lift: 5 mm"), ["5:38: mechanisms.a.lift", "mm", "deg"]),
        (SLIDES.replace("lift: 20", "lift: 1 rad"), ["mechanisms.a.lift", "rad", "mm"]),
        (SLIDES.replace("3 N/mm", "3 N*m/rad"), ["mechanisms.a.stiffness", "N*m/rad", "N/m"]),
        (SLIDES.replace("lift: 20", "lift: 500"), ["500 mm is out of range; allowed: > 0 mm, ≤ 400 mm"]),
        (TURNS.replace("1 rad", "500"), ["500 ° is out of range; allowed: > 0 °, ≤ 400 °"]),
        (TURNS.replace("lift: 1 rad", "motion: [1, 2, 3, 4]"), ["a reference to a curve in deg is needed"]),
        (SLIDES.replace("lift: 20", "motion: 3 mm"), ["is '3 mm'; a reference to a curve in mm is needed"]),
    ],
)
def test_a_wrong_quantity_is_told_in_the_unit_that_holds(
    tmp_path: Path, plugins: Discovery, text: str, words: list[str]
) -> None:
    (problem,) = problems(tmp_path, text, plugins)
    assert all(word in problem for word in words)


def test_a_message_prints_the_unit_that_holds(tmp_path: Path, plugins: Discovery) -> None:
    for text, words in ((TURNS, "57.30° turns back too often with 100 N·m/rad"), (SLIDES, "20 mm turns back too often with 3000 N/m")):  # fmt: skip
        outcome = problems_of_machine(tmp_path, text.replace("lift:", "ripple: 0.001, lift:"), plugins)
        assert words in outcome


def problems_of_machine(tmp_path: Path, text: str, plugins: Discovery) -> str:
    with pytest.raises(UserError) as refused:
        Press.read(saved(tmp_path, text), plugins).calculate()
    return str(refused.value.problems[0])


# --- references ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("mass: 1, lift: '${a.lift}'", "${a.lift} is in rad; a quantity in mm is needed here"),
        ("mass: 1, lift: 1, stiffness: '${a.stiffness}'", "${a.stiffness} is in N*m/rad; a quantity in N/m is needed here"),
        ("mass: 1, motion: '${a.position}'", "${a.position} is not a curve in mm"),
        ("inertia: 1, motion: '${a.speed}'", "${a.speed} is not a curve in deg"),
        ("inertia: 1, motion: '${a.lift}'", "${a.lift} is not a curve in deg"),
    ],
)  # fmt: skip
def test_references_between_unlike_forms_are_refused(tmp_path: Path, plugins: Discovery, keys: str, words: str) -> None:
    (problem,) = problems(tmp_path, TURNS + f"  b: {{kind: swing, {keys}}}\n", plugins)
    assert words in problem


@pytest.mark.parametrize("text", [TURNS, SLIDES])
def test_references_between_like_forms_hold(tmp_path: Path, plugins: Discovery, text: str) -> None:
    key = "inertia" if text == TURNS else "mass"
    text += f"  b: {{kind: swing, {key}: 1, lift: '${{a.lift}}', stiffness: '${{a.stiffness}}'}}\n"
    text += f"  c: {{kind: swing, {key}: 1, motion: '${{b.position}}'}}\n  d: {{kind: swing, {key}: 2, motion: '${{c.motion}}'}}\n"
    first, last = found(tmp_path, text, plugins), found(tmp_path, text, plugins, "d")
    assert last["curves"]["position"]["values"] == pytest.approx(first["curves"]["position"]["values"], abs=1e-15)
    assert last["curves"]["position"]["unit"] == first["curves"]["position"]["unit"]


def test_the_period_of_a_curve_over_an_angle_is_asked_for_at_its_key(tmp_path: Path, plugins: Discovery) -> None:
    text = HEAD + "  a: {kind: loop, pull: 1}\n  b: {kind: swing, mass: 1, motion: '${a.height}'}\n"
    told = problems_of_machine(tmp_path, text, plugins)
    assert "6:37: mechanisms.b.motion" in told and "runs over turn, in °; give rate" in told


# --- schema ----------------------------------------------------------------------------------------------------------


def test_the_schema_tells_each_unit_and_its_key() -> None:
    keys = kind_schema(MECHANISM)["properties"]
    assert keys["stiffness"]["description"] == (
        "Stiffness. Unit: N·m/rad (with mass: N/m). Allowed: > 0 N·m/rad (with mass: > 0 N/m). "
        "Plausible: 0.001 N·m/rad to 1e+12 N·m/rad (with mass: 0.001 N/m to 1000000 MN/m). "
        "Default: 100 N·m/rad (with mass: 100 N/m)."
    )
    assert keys["motion"]["description"] == "Motion by reference. Unit: ° (with mass: mm). A reference to a curve."
    assert (
        keys["duration"]["description"]
        == "Time that is calculated. Unit: s. Allowed: > 0 s. Plausible: 1 µs to 1000000 h. Default: 2 s."
    )


@pytest.mark.parametrize(("given", "fits"), [("${a.position}", True), ([1, 2, 3, 4], False), ("3 mm", False)])
def test_a_referred_curve_takes_no_list(given: Any, fits: bool) -> None:
    schema = config_schema({"swing": MECHANISM}, {})
    config = {"schema_version": 1, "project": {"title": "T"}, "press": {"name": "P"},
              "mechanisms": {"a": {"kind": "swing", "mass": 1, "motion": given}}}  # fmt: skip
    assert jsonschema.Draft202012Validator(schema).is_valid(config) is fits


# --- print -----------------------------------------------------------------------------------------------------------


def item(key: str, name: str) -> ItemRecord:
    """What is printed of a step of a link with this key."""
    given = {key: 1.0, "lift": "1 rad" if key == "inertia" else "1 m", "duration": 2} | {"n_points": 80}
    if key == "mass":
        given["lift"] = "400 mm"
    results = mechanism_results(calculate(MECHANISM, flatten(in_form(Swing, given).model_validate(given))), {})
    return next(i for section in results.sections for i in section.items if i.id == name)


def equation(of: dict[str, Any]) -> tuple[str, str]:
    typeset = Equations(Catalogue("en"), lambda latex: 0.0).of(of)
    assert typeset is not None
    return typeset.latex, typeset.text


def test_a_derivative_is_printed_with_its_place_and_proof() -> None:
    printed = item("inertia", "speed")
    assert (printed.type, printed.operation, printed.of) == ("reduction", "derivative", "y")
    assert printed.at == PlaceRecord(symbol="t", text="0.25", unit="s")
    assert float(printed.result.text) == pytest.approx(192 * 0.125**2 / 2) and printed.result.unit == "rad/s"
    assert "Chebyshev series" in printed.method and float(printed.residual.text) < 1e-12
    latex, text = equation(printed)
    assert text == "v = dy/dt = 1.5 rad/s at t = 0.25 s"
    assert r"\frac{\mathrm{d}y}{\mathrm{d}t}" in latex


def test_a_found_value_is_printed_with_its_method_and_without_a_relation() -> None:
    printed = item("mass", "work")
    assert (printed.type, printed.relation) == ("found", None)
    assert printed.method == "half of stiffness times lift squared"
    assert equation(printed)[1] == "W = 8 J"
    assert item("mass", "speed").result.unit == "m/s"


def test_a_form_is_the_model_with_other_units() -> None:
    form = in_form(Swing, {"mass", "lift"})
    assert form_keys(Swing) == {"mass"} and issubclass(form, Swing) and form is in_form(Swing, ["mass"])
    assert in_form(Swing, {"inertia"}) is Swing
    assert [meta.unit for n in ("lift", "duration") if isinstance(meta := meta_of(form, n), Quantity)] == ["mm", "s"]
    assert list(form.model_fields) == list(Swing.model_fields) and form.one_of is Swing.one_of


def test_of_several_keys_the_first_decides() -> None:
    both = Quantity("t", "s", "Time", units=(("rate", "1"), ("mass", "mm")))
    assert in_unit(both, {"mass", "rate"}).unit == "1" and in_unit(both, {"mass"}).unit == "mm"
    assert in_unit(both, {"other"}) is both
    assert in_all_units(both, lambda form: form.unit) == "s (with rate: 1; with mass: mm)"


def with_step(name: str, **changes: Any) -> Mechanism:
    """The swing with one of its steps changed."""

    def changed(step: Step) -> Step:
        return replace(step, **changes) if step.id == name else step

    return replace(MECHANISM, chapters=tuple(replace(s, steps=tuple(map(changed, s.steps))) for s in MECHANISM.chapters))  # fmt: skip


def test_a_sound_mechanism_of_two_forms_passes() -> None:
    check_mechanism(MECHANISM)


@pytest.mark.parametrize(
    ("name", "changes", "words"),
    [
        ("force", {"unit": "N"}, "force: its formula gives"),
        ("force", {"units": (("mass", "N*m"),)}, "declared is N*m"),
        ("force", {"units": ()}, "force: its formula gives"),
        ("position", {"units": ()}, "position: it rises gives"),
        ("speed", {"unit": "rad"}, "speed: the derivative of position gives rad/s"),
        ("speed", {"units": (("mass", "m"),)}, "speed: the derivative of position gives m/s, declared is m"),
        ("area", {"units": (("mass", "m"),)}, "area: the integral of position gives m*s"),
        ("speed_top", {"units": (("mass", "m"),)}, "speed_top: speed gives"),
        ("grown", {"units": ()}, "grown: motion gives m, declared is rad"),
        ("grown", {"lasts": "share"}, "grown: share gives"),
        ("grown", {"start": "cycle"}, "grown: cycle gives s,"),
        ("time", {"period": "share"}, "time: share gives"),
        ("joints", {"every": "stiffness"}, "joints: stiffness gives"),
        ("joints", {"places": ("share",)}, "joints: share gives"),
        ("joints", {"every": "ripples"}, "step joints: takes ripples, which nothing gives"),
        ("grown", {"start": "begin"}, "step grown: takes begin, which nothing gives"),
        ("force", {"units": (("weight", "N"),)}, "step force: has units beside weight, which is not an input"),
        ("force", {"units": (("duration", "N"),)}, "step force: has units beside duration, which is not an optional input"),
        ("quarter", {"lacks": ("mass",)}, "step joints: takes quarter, which nothing gives"),
    ],
)  # fmt: skip
def test_the_contract_test_finds_what_is_wrong_in_either_form(name: str, changes: Any, words: str) -> None:
    with pytest.raises(AssertionError) as refused:
        check_mechanism(with_step(name, **changes))
    assert words in str(refused.value)


class Part(Block):
    size = Quantity("b", "m", "Size", units=(("mass", "s"),))


class Nested(Inputs):
    mass = Quantity("m", "kg", "Mass", optional=True)
    part = block(Part, "Part", optional=True)


class OfPress(Inputs):
    rate = Quantity("n", "1/h", "Rate", press=FromPress("press.productivity", optional=True), optional=True)
    time = Quantity("t", "s", "Time", units=(("rate", "1"),))


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        (Nested, "input part.size: has other units within a block, where none hold"),
        (OfPress, "input time: has units beside rate, which is not an optional input without a default"),
    ],
)
def test_units_that_could_not_hold_are_refused(inputs: type[Inputs], words: str) -> None:
    with pytest.raises(AssertionError, match=words):
        check_mechanism(replace(of_steps(), inputs=inputs))


def test_a_derivative_is_of_a_curve() -> None:
    step = Derivative(id="d", symbol="d", unit="1", description="Derivative", of="force")
    with pytest.raises(KeyError, match="force"):
        of_steps(step).axes(frozenset())


def line(**changes: Any) -> SpectrumLine:
    return SpectrumLine(**{"id": "q", "symbol": "q", "description": "Line", "values": RATIOS} | changes)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"id": "position"}, "curve position: of a spectrum has the id of another curve"),
        ({"id": "ratio"}, "curve ratio: of a spectrum has the id of another curve"),
        ({"values": RATIOS[1:]}, "curve q: does not have one number for each of ratio"),
        ({"values": RATIOS * float("nan")}, "curve q: does not have one number for each of ratio"),
        ({"symbol": ""}, "curve q: has no symbol or no description"),
    ],
)
def test_a_spectrum_that_is_none_is_refused(changes: Any, words: str) -> None:
    spectrum = replace(SPECTRUM, lines=lambda: [line(**changes)])
    with pytest.raises(AssertionError, match=words):
        check_mechanism(replace(MECHANISM, spectra=(spectrum,)))
