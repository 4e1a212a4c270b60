"""The contract test in each of the units that a mechanism may have; curves, abscissas and spectra in it."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

import pytest

from diecut_report.api import Block, Derivative, FromPress, Inputs, Mechanism, Quantity, SpectrumLine, Step
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.mechanism.chapters import form_keys, in_all_units, in_form, in_unit
from diecut_report.mechanism.inputs import meta_of
from tests.machine.swing import MECHANISM, RATIOS, SPECTRUM, Swing
from tests.testing.test_calculate import mechanism as of_steps


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
        ("force", {"unit": "N"}, "force: force gives"),
        ("force", {"units": (("mass", "N*m"),)}, "declared is N*m"),
        ("force", {"units": ()}, "force: force gives"),
        ("position", {"units": ()}, "position: rising gives"),
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
    size: Annotated[float, Quantity("b", "m", "Size", units=(("mass", "s"),))]


class Nested(Inputs):
    mass: Annotated[float | None, Quantity("m", "kg", "Mass")] = None
    part: Part | None = None


class OfPress(Inputs):
    rate: Annotated[
        float | None, Quantity("n", "1/h", "Rate", press=FromPress("press.productivity", optional=True))
    ] = None
    time: Annotated[float, Quantity("t", "s", "Time", units=(("rate", "1"),))]


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
