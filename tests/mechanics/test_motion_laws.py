"""The laws of motion against their published peaks, integration, dense search, symmetry; and the registry."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from diecut_report.api import Inputs, Text, formula, number
from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula, evaluate
from diecut_report.mechanics import motion_laws
from diecut_report.mechanics.motion_laws import LAWS, MotionLaw, register

PUBLISHED = {  # peak velocity B, peak acceleration A
    "cycloidal": (2, 2 * np.pi),
    "harmonic": (np.pi / 2, np.pi**2 / 2),
    "parabolic": (2, 4),
    "modified_trapezoidal": (2, 4.8881),
    "modified_sine": (1.7596, 5.5280),
    "polynomial_345": (1.875, 5.7735),
    "polynomial_4567": (2.1875, 7.5132),
}
JUMPS = {"harmonic": (0, 1), "parabolic": (0, 0.5, 1)}  # where the acceleration jumps
CURVES = ("position", "velocity", "acceleration", "jerk")
SHARES = st.floats(0, 1)
BY_LAW = pytest.mark.parametrize("law", LAWS.values(), ids=lambda law: law.name)


def pieces(law: MotionLaw) -> list[tuple[float, float]]:
    return list(pairwise((0.0, *law.breakpoints, 1.0)))


def limit(curve: Formula, place: float, inner: float) -> float:
    """The one-sided limit at the end of a piece, from the side of an inner place."""
    return float(curve(place + 1e-13 * np.sign(inner - place)))


def test_the_seven_laws_are_registered_in_order() -> None:
    assert list(LAWS) == list(PUBLISHED)
    assert [law.name for law in LAWS.values()] == list(PUBLISHED)


@pytest.mark.parametrize("name", PUBLISHED)
def test_the_peaks_are_the_published_ones(name: str) -> None:
    velocity, acceleration = PUBLISHED[name]
    assert abs(LAWS[name].B - velocity) < 5e-5
    assert abs(LAWS[name].A - acceleration) < 5e-5


@BY_LAW
@pytest.mark.parametrize("which, peak", [("velocity", "B"), ("acceleration", "A")])
def test_the_peaks_are_those_of_a_dense_search(law: MotionLaw, which: str, peak: str) -> None:
    curve, top = getattr(law, which), 0.0
    for low, high in pieces(law):
        grid = np.linspace(low, high, 2001)[1:-1]
        best = grid[np.argmax(np.abs(curve(grid)))]
        found = minimize_scalar(lambda k, curve=curve: -abs(curve(k)), method="bounded",
                                bounds=(max(best - 1e-3, low), min(best + 1e-3, high)), options={"xatol": 1e-12})  # fmt: skip
        top = max(top, -found.fun, np.abs(limit(curve, low, high)), np.abs(limit(curve, high, low)))
    assert getattr(law, peak) == pytest.approx(top, rel=1e-9)


@BY_LAW
@pytest.mark.parametrize("lower, higher", list(pairwise(CURVES)))
def test_each_curve_is_the_integral_of_the_next_one(law: MotionLaw, lower: str, higher: str) -> None:
    """Piece by piece, one-sided limits at the joints: the jerk holds no impulses."""
    curve, rate = getattr(law, lower), getattr(law, higher)
    for low, high in pieces(law):
        for share in (0.25, 0.6, 1.0):
            end = low + share * (high - low)
            area, _ = quad(lambda k, rate=rate: float(rate(k)), low, end, epsabs=1e-11)
            assert limit(curve, end, low) - limit(curve, low, high) == pytest.approx(area, abs=1e-10)


@BY_LAW
def test_only_the_acceleration_jumps_and_only_where_it_is_known_to(law: MotionLaw) -> None:
    rest = {"position": (0.0, 1.0), "velocity": (0.0, 0.0), "acceleration": (0.0, 0.0)}
    for which, (before, after) in rest.items():
        curve = getattr(law, which)
        sides = [(0.0, before, limit(curve, 0, 1)), (1.0, limit(curve, 1, 0), after)]
        sides += [(place, limit(curve, place, 0), limit(curve, place, 1)) for place in law.breakpoints]
        jumps = tuple(sorted(place for place, left, right in sides if abs(left - right) > 1e-9))
        assert jumps == (JUMPS.get(law.name, ()) if which == "acceleration" else ())


@BY_LAW
@given(k=SHARES)
def test_the_second_half_mirrors_the_first(law: MotionLaw, k: float) -> None:
    assume(all(min(abs(k - place), abs(1 - k - place)) > 1e-9 for place in (*law.breakpoints, 0.0, 1.0)))
    assert law.position(k) + law.position(1 - k) == pytest.approx(1, abs=1e-12)
    assert law.velocity(k) == pytest.approx(law.velocity(1 - k), abs=1e-12)
    assert law.acceleration(k) == pytest.approx(-law.acceleration(1 - k), abs=1e-11)
    assert law.jerk(k) == pytest.approx(law.jerk(1 - k), abs=1e-9)


def published_sine(k: Array) -> Array:
    peak = 4 * np.pi**2 / (4 + np.pi)
    outside = (k < 1 / 8) | (k > 7 / 8)
    return np.where(outside, peak * np.sin(4 * np.pi * k), peak * np.sin(np.pi / 3 + 4 * np.pi * k / 3))


def published_trapezoidal(k: Array) -> Array:
    peak = 8 * np.pi / (2 + np.pi)
    level = np.ones_like(k)
    parts = [np.sin(4 * np.pi * k), level, np.cos(4 * np.pi * (k - 3 / 8)), -level, -np.cos(4 * np.pi * (k - 7 / 8))]
    return peak * np.select([k < 1 / 8, k < 3 / 8, k < 5 / 8, k < 7 / 8], parts[:-1], parts[-1])


@pytest.mark.parametrize(
    "name, published", [("modified_sine", published_sine), ("modified_trapezoidal", published_trapezoidal)]
)
def test_the_modified_laws_have_the_published_waves(name: str, published: Any) -> None:
    k = np.linspace(0, 1, 4001)
    np.testing.assert_allclose(LAWS[name].acceleration(k), published(k), atol=1e-12)


@BY_LAW
def test_arrays_of_any_shape_give_what_single_numbers_give(law: MotionLaw) -> None:
    k = np.linspace(0, 1, 60).reshape(3, 20)
    for which in (*CURVES, "joint"):
        curve = getattr(law, which)
        together = curve(k)
        assert together.shape == k.shape
        np.testing.assert_allclose(together, [[curve(float(x)) for x in row] for row in k], rtol=1e-13, atol=1e-14)


@BY_LAW
@given(k=SHARES)
def test_what_is_printed_is_what_is_computed(law: MotionLaw, k: float) -> None:
    for which in (*CURVES, "joint"):
        curve: Formula = getattr(law, which)
        assert evaluate(curve.tree, lambda _: k) == pytest.approx(float(curve(k)), abs=1e-12)
    assert evaluate(law.peak_acceleration.tree, lambda _: k) == law.A


@BY_LAW
def test_the_joint_changes_its_sign_at_the_breakpoints_alone(law: MotionLaw) -> None:
    k = np.linspace(0, 1, 9998)
    signs = np.sign(law.joint(k))
    changes = (k[:-1] + k[1:])[signs[:-1] != signs[1:]] / 2
    assert changes == pytest.approx(law.breakpoints, abs=1e-4)


# --- the registry ----------------------------------------------------------------------------------------------------


straight = formula(lambda k: k)
even = formula(lambda k: 1 + 0 * k)
nothing = formula(lambda k: 0 * k)
one = formula(lambda: 1)
shifted = formula(lambda k: k + number(1) / 10)
of_two = formula(lambda k, h: h * k)


def a_law(**changes: Any) -> MotionLaw:
    parts: dict[str, Any] = {"name": "even", "title": "Even motion", "position": straight, "velocity": even, "acceleration": nothing, "jerk": nothing,
             "peak_velocity": one, "peak_acceleration": one}  # fmt: skip
    return MotionLaw(**(parts | changes))


@pytest.fixture
def own_laws() -> Iterator[None]:
    """The known laws, whose additions are taken back after the test."""
    known = dict(LAWS)
    yield
    LAWS.clear()
    LAWS.update(known)


def test_a_registered_law_is_seen_in_all_views_made_before(own_laws: None) -> None:
    views = (motion_laws.POSITION, motion_laws.VELOCITY, motion_laws.ACCELERATION, motion_laws.JERK,
             motion_laws.PEAK_VELOCITY, motion_laws.PEAK_ACCELERATION, motion_laws.JOINT)  # fmt: skip
    assert all("even" not in view for view in views)
    law = register(a_law())
    assert LAWS["even"] is law
    expected = (straight, even, nothing, nothing, one, one, law.joint)
    assert tuple(view["even"] for view in views) == expected
    assert all(list(view) == [*PUBLISHED, "even"] and len(view) == 8 for view in views)
    assert (motion_laws.MIDDLE_POSITION["even"], motion_laws.MIDDLE_VELOCITY["even"]) == (0.5, 1.0)
    assert Chosen(law="even").law == "even"


@pytest.mark.parametrize(
    "changes, words",
    [
        ({"name": "cycloidal"}, "the name cycloidal is taken"),
        ({"position": of_two}, "formulas of k alone"),
        ({"peak_velocity": even}, "formulas without parameters"),
        ({"breakpoints": (0.5, 0.25)}, "in ascending order"),
        ({"breakpoints": (1.0,)}, "between 0 and 1"),
        ({"position": shifted}, "from 0 at k = 0"),
        ({"breakpoints": (0.5,)}, "joint changes its sign"),
        ({"breakpoints": (0.25,), "joint": LAWS["parabolic"].joint}, "joint changes its sign"),
    ],
)
def test_what_is_no_unit_rise_is_not_registered(own_laws: None, changes: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        register(a_law(**changes))
    assert list(LAWS) == list(PUBLISHED)


class Chosen(Inputs):
    law = Text("Law", options=LAWS, default="cycloidal")


def test_an_input_takes_the_name_of_a_law_and_nothing_else() -> None:
    assert Chosen(law="harmonic").law == "harmonic"
    with pytest.raises(
        ValidationError,
        match=r"“cycloid” \(did you mean 'cycloidal'\?\); allowed: cycloidal, harmonic, .*polynomial_4567",
    ):
        Chosen(law="cycloid")
    with pytest.raises(ValidationError) as refused:
        Chosen(law="zzz")
    assert "did you mean" not in str(refused.value)
    with pytest.raises(ValidationError, match="string"):
        Chosen(law=3)
