"""The angle is a dimension of formulas: where the radian drops is beside a length, or is said."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pint
import pytest

from diecut_report.api import (
    Chapter,
    Check,
    Formula,
    Inputs,
    Mechanism,
    Quantity,
    Step,
    arccos,
    as_angle,
    as_number,
    formula,
    m,
    number,
    pi,
)
from diecut_report.declaration.formula_checks import (
    ANGLE,
    ANGLE_AT,
    NUMBER,
    Found,
    KindError,
    check_mechanism,
    dimensions,
    forms,
    formulas,
    kind_given,
    units_of,
)
from diecut_report.formulas.formula import evaluate
from diecut_report.formulas.tree import Node, unsaid
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.steps import Abscissa, Accumulated, Derivative, Reduction, Root, SelfTest, Value, Words
from diecut_report.mechanism.steps.interpolated import Between
from diecut_report.quantities.units import DIMENSIONS, unit


class Wheel(Inputs):
    speed = Quantity("ω", "rpm", "Angular speed", gt=0, default=100)
    rate = Quantity("n", "1/min", "Turns", gt=0, default=100)
    angle = Quantity("φ", "deg", "Angle", gt=0, default=30)
    radius = Quantity("r", "mm", "Radius", gt=0, default=40)
    velocity = Quantity("v", "m/s", "Speed", gt=0, default=2)
    torque = Quantity("M", "N*m", "Torque", gt=0, default=5)
    inertia = Quantity("J", "kg*m**2", "Inertia", gt=0, default=3)
    stiffness = Quantity("c", "N*m/rad", "Stiffness", gt=0, default=3)
    mass = Quantity("m", "kg", "Mass", gt=0, default=3)
    share = Quantity("k", "1", "Share", gt=0, default=0.5)
    n_points = Quantity("N", "1", "Samples", ge=36, integer=True, default=36)


def wheel(*steps: Step, checks: tuple[Check, ...] = ()) -> Mechanism:
    """A mechanism of these steps, and of a text that takes all inputs, so that none is without a use."""
    told = Words(id="inputs_told", function=lambda *given: str(given), takes=tuple(Wheel.model_fields))
    chapters = (Chapter("Steps", steps=(*steps, told)),)
    return Mechanism(kind="wheel", version="1", title="Wheel", summary="", inputs=Wheel, chapters=chapters, checks=checks)  # fmt: skip


def value(made: Any, unit: str) -> Value:
    """A step with this formula and unit."""
    return Value(id="x", symbol="x", unit=unit, description="Quantity", formula=made)


@formula
def quotient(above: Any, below: Any) -> Any:
    return above / below


@formula
def quotient_as_angle(above: Any, below: Any) -> Any:
    return as_angle(above / below)


SOUND = {
    "v = ω·r": value(lambda speed, radius: speed * radius, "m/s"),
    "P = M·ω": value(lambda torque, speed: torque * speed, "W"),
    "W = M·φ": value(lambda torque, angle: torque * angle, "J"),
    "M = c·φ": value(lambda stiffness, angle: stiffness * angle, "N*m"),
    "ω said of v/r": value(lambda velocity, radius: as_angle(velocity / radius), "rpm"),
    "ω said of sqrt(c/J)": value(lambda stiffness, inertia: as_angle(np.sqrt(stiffness / inertia)), "rad/s"),
    "n = ω/2π": value(lambda speed: speed / (2 * pi), "Hz"),
    "ω = 2π·n": value(lambda rate: 2 * pi * rate, "rpm"),
    "T = 2π/ω": value(lambda speed: 2 * pi / speed, "s"),
    "π − φ": value(lambda angle: pi - angle, "deg"),
    "φ < 2π": value(lambda angle: angle < 2 * pi, "1"),
    "sin φ": value(lambda angle: np.sin(angle), "1"),
    "arccos k": value(lambda share: arccos(share), "deg"),
    "arctan2": value(lambda share: np.arctan2(share, 1), "deg"),
    "r + r·φ": value(lambda angle, radius: radius + radius * angle, "mm"),
    "rad/s said to be 1/s": value(lambda speed: as_number(speed), "1/s"),
    "1/s said to be rad/s": value(lambda rate: as_angle(rate), "rad/s"),
    "m·ω² said": value(lambda mass, speed: mass * as_number(speed) ** 2, "N/m"),
    "zero as an angle": value(0, "deg"),
}
UNSOUND = {
    "rad/s as Hz": (value(lambda speed: speed, "Hz"), "gives rad/s, declared is 1/s"),
    "rad/s as 1/min": (value(lambda speed: speed, "1/min"), "gives rad/s, declared is 1/s"),
    "1/min as rpm": (value(lambda rate: rate, "rpm"), "gives 1/s, declared is rad/s"),
    "rad as 1": (value(lambda angle: angle, "1"), "gives rad, declared is 1"),
    "ω = v/r": (value(lambda velocity, radius: velocity / radius, "rad/s"),
                "gives 1/s, declared is rad/s; if that counts radians, write as_angle.….$"),
    "ω = sqrt(c/J)": (value(lambda stiffness, inertia: np.sqrt(stiffness / inertia), "rad/s"), "declared is rad/s"),
    "T = 1/ω": (value(lambda speed: 1 / speed, "s"), "gives s/rad, declared is s"),
    "ω/2π as rad/s": (value(lambda speed: speed / (2 * pi), "rad/s"), "gives 1/s, declared is rad/s"),
    "2π·n as Hz": (value(lambda rate: 2 * pi * rate, "Hz"), "gives rad/s, declared is 1/s"),
    "m·ω² as N/m": (value(lambda mass, speed: mass * speed**2, "N/m"), "declared is N/m"),
    "φ < 1": (value(lambda angle: angle < 1, "1"),
              "brings together rad .angle. and a pure number .1.; if that counts radians, write as_angle.1.$"),
    "sin k": (value(lambda share: np.sin(share), "1"),
              "share is a pure number, rad is needed; if that counts radians, write as_angle.share.$"),
    "sin ω": (value(lambda speed: np.sin(speed), "1"), "speed is rad/s, rad is needed$"),
    "arccos φ": (value(lambda angle: arccos(angle), "deg"), "angle is rad, a pure number is needed"),
    "arccos as 1": (value(lambda share: arccos(share), "1"), "gives rad, declared is 1"),
    "max(φ, k)": (value(lambda angle, share: np.maximum(angle, share), "1"), "brings together rad .angle. and a pure number .share."),
    "φ or k": (value(lambda angle, share: np.where(angle > 0, share, angle), "1"), "brings together a pure number .share. and rad .angle."),
    "exp φ": (value(lambda angle: np.exp(angle), "1"),
              "angle is rad, a pure number is needed; if the number of radians is meant, write as_number.angle.$"),
    "(v − ω·r)/r": (value(lambda velocity, radius, speed: (velocity - radius * speed) / radius, "rad/s"), "gives 1/s, declared is rad/s"),
    "a number said to be one": (value(lambda share: as_number(share), "1"), "says that rad drops, but share is a pure number already"),
    "an angle said to be one": (value(lambda speed: as_angle(speed), "rad/s"), "says that rad comes in, but speed is rad/s already"),
}  # fmt: skip


@pytest.mark.parametrize("name", SOUND)
def test_the_radian_drops_beside_a_length_or_where_it_is_said(name: str) -> None:
    check_mechanism(wheel(SOUND[name]))


@pytest.mark.parametrize("name", UNSOUND)
def test_an_angle_is_no_number_elsewhere(name: str) -> None:
    step, words = UNSOUND[name]
    with pytest.raises(AssertionError, match=words):
        check_mechanism(wheel(step))


TURN = Abscissa(id="place", symbol="χ", unit="deg", description="Place", period=2 * np.pi)
RISE = value(lambda share, place: share * place, "deg")
REST: dict[str, Any] = {"symbol": "y", "unit": "1", "description": "Quantity"}


@pytest.mark.parametrize(
    ("made", "unit", "found"),
    [
        (Accumulated(id="y", of="x", **REST), "rad**2", "1"),
        (Reduction(id="y", of="x", operation="integral", **REST), "rad**2", "deg"),
        (Derivative(id="y", of="x", **REST), "1", "rad"),
        (Reduction(id="y", of="x", operation="max", **REST), "rad", "1"),
    ],
)
def test_what_runs_over_an_angle_has_its_unit(made: Step, unit: str, found: str) -> None:
    check_mechanism(wheel(TURN, RISE, replace(made, unit=unit)))
    with pytest.raises(AssertionError, match=r"declared is|is in 1, x in deg"):
        check_mechanism(wheel(TURN, RISE, replace(made, unit=found)))


def test_the_work_of_a_turn_needs_no_word() -> None:
    over = value(lambda torque, place: torque * place, "N*m")
    work = Reduction(id="y", of="x", operation="integral", **REST | {"unit": "J"})
    check_mechanism(wheel(TURN, over, work))


@formula
def beyond(u: Any, share: Any) -> Any:
    return u - share


def test_the_sides_of_a_relation_are_both_angles() -> None:
    root = Root(id="u", equation=beyond, unknown="u", low=0, high=1,
                left=m.u, right=m.angle, **REST)  # fmt: skip
    with pytest.raises(AssertionError, match="the relation equals a pure number with rad"):
        check_mechanism(wheel(root))


def test_a_check_compares_rpm_with_no_frequency() -> None:
    check = Check("c", "strength", "c", "speed", 3.0, unit="1/min", demand_label="", limit_label="", consequence="")  # fmt: skip
    with pytest.raises(AssertionError, match="check c: is in 1/min, speed in rpm"):
        check_mechanism(wheel(value(m.speed, "rpm"), checks=(check,)))


def test_what_is_said_computes_and_prints_nothing() -> None:
    above, below = Node("sym", ("above",)), Node("sym", ("below",))
    assert quotient_as_angle.tree == quotient.tree == Node("/", (above, below))
    assert quotient_as_angle(3.0, 2.0) == 1.5
    angles = np.linspace(0, 1, 5)
    assert as_angle(angles) is angles and as_number(angles) is angles
    said = wheel(value(quotient_as_angle.of(above=m.velocity, below=m.radius), "rpm"))
    assert calculate(said, Wheel().model_dump())["x"][0, 0] == pytest.approx(50)


def test_what_a_called_formula_says_is_heard() -> None:
    @formula
    def outer(velocity: Any, radius: Any) -> Any:
        return 2 * quotient_as_angle(velocity, radius)

    kinds = {"velocity": unit("m/s").kind, "radius": unit("m").kind}
    assert kind_given(outer, kinds) == unit("rad/s").kind


@formula
def raised(base: Any, exponent: Any) -> Any:
    return base**exponent


@formula
def third_root(base: Any) -> Any:
    return base ** (number(1) / 3)


def test_a_power_with_a_unit_needs_a_plain_number_as_exponent() -> None:
    assert kind_given(third_root, {"base": unit("m**3").kind}) == unit("m").kind
    assert kind_given(raised, {"base": NUMBER, "exponent": NUMBER}) == NUMBER
    with pytest.raises(KindError, match="exponent is rad"):
        kind_given(raised, {"base": NUMBER, "exponent": ANGLE})
    with pytest.raises(KindError, match="base is m,"):
        kind_given(raised, {"base": unit("m").kind, "exponent": NUMBER})


# --- all formulas that there are --------------------------------------------------------------------------------------


@cache
def built_in() -> tuple[Mechanism, ...]:
    """All mechanisms of the program and the comparison, in each of their forms."""
    folder = Path(import_module("diecut_report.plugins").__path__[0])
    kinds = [import_module(f"diecut_report.plugins.{p.parent.name}").MECHANISM for p in sorted(folder.glob("*/__init__.py"))]  # fmt: skip
    compared = import_module("diecut_report.plugins.geneva_transport.comparison").COMPARISON
    return tuple(form for mechanism in (*kinds, compared) for form in forms(mechanism))


REGISTRY: Any = pint.LazyRegistry()


def by_pint(rule: Formula, units: dict[str, str]) -> tuple[float, ...] | None:
    """The exponents that pint finds for what a formula gives, which counts no angle; None for a plain zero."""
    known = {name: REGISTRY.Quantity(np.float64(0.6 + 0.01 * i), units[name]) for i, name in enumerate(rule.parameters)}
    known |= {symbol: REGISTRY.Quantity(float(each), each.unit) for symbol, each in rule.constants.items()}
    with np.errstate(all="ignore"):
        result = evaluate(unsaid(rule.full_tree), lambda leaf: known[leaf.args[0]])
    if not isinstance(result, pint.Quantity):
        return None if result == 0 else (0.0,) * ANGLE_AT
    found: Any = result.dimensionality
    return tuple(float(found.get(f"[{name}]", 0)) for name in DIMENSIONS[:ANGLE_AT])


def of_formulas(mechanism: Mechanism) -> Iterator[tuple[str, Formula, Found]]:
    units = units_of(mechanism)
    for step, _, rule in formulas(mechanism):
        yield step.id, rule, kind_given(rule, {name: unit(units[name]).kind for name in rule.parameters})


@pytest.mark.parametrize("each", [12, pytest.param(1, marks=pytest.mark.nightly)])
def test_but_for_the_angle_kinds_are_those_of_pint(each: int) -> None:
    """CI asks for each twelfth formula."""
    seen = 0
    for mechanism in built_in():
        for name, rule, found in islice(of_formulas(mechanism), None, None, each):
            if isinstance(rule, Between):  # takes plain numbers of a table: its kinds have a test of their own
                continue
            expected = by_pint(rule, units_of(mechanism))
            if found is not None and expected is not None:
                seen += 1
                assert found[:ANGLE_AT] == pytest.approx(expected), f"{mechanism.kind}: {name}"
    assert seen > 1000 / each


OTHER_ANGLE = {"rad": "1", "1": "rad", "rad/s": "1/s", "1/s": "rad/s", "rad/s**2": "1/s**2"}


def exchanged(mechanism: Mechanism) -> Iterator[tuple[str, Mechanism]]:
    """The mechanism with one value's unit taken for the same without (or with) rad; conditions and plain zeros apart."""
    plain = {name for name, _, found in of_formulas(mechanism) if found is None}
    for chapter in mechanism.chapters:
        for place, step in enumerate(chapter.steps):
            if (
                isinstance(step, Value)
                and not isinstance(step, SelfTest)  # whose unit is always the same
                and not step.is_condition
                and step.id not in plain
                and unit(step.unit).si in OTHER_ANGLE
            ):
                other = replace(step, unit=OTHER_ANGLE[unit(step.unit).si])
                steps = (*chapter.steps[:place], other, *chapter.steps[place + 1 :])
                chapters = tuple(replace(c, steps=steps) if c is chapter else c for c in mechanism.chapters)
                yield step.id, replace(mechanism, chapters=chapters)  # fmt: skip


@pytest.mark.parametrize("each", [12, pytest.param(1, marks=pytest.mark.nightly)])
def test_no_value_passes_with_the_radian_exchanged(each: int) -> None:
    """CI tries each twelfth."""
    tried = 0
    for mechanism in built_in():
        for name, wrong in islice(exchanged(mechanism), None, None, each):
            tried += 1
            assert any(fault.startswith(f"{name}:") for fault in dimensions(wrong)), f"{mechanism.kind}: {name}"
    assert tried > 300 / each
