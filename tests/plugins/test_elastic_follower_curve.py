"""The elastic follower driven by a curve of another mechanism: against scipy's integration and against the same motion by a law.

In CI each law and each tuning drives it once, at night each law at each tuning.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import pytest

from diecut_report.api import Abscissa, Breakpoints, Chapter, Inputs, Mechanism, Quantity, Value, bind, formula
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.elastic_follower import MECHANISM
from diecut_report.plugins.geneva_transport import MECHANISM as GENEVA
from tests.examples import few
from tests.machines import inputs, number
from tests.plugins.followers import (
    LAWS,
    SHAFT,
    Gear,
    Part,
    Stretch,
    at,
    driven,
    follower,
    gear_stretches,
    geneva_stretches,
    integrated,
    rigid_peak,
)
from tests.plugins.steppers import CONVEYOR, stepper

TUNED = [(0.8, 0.3), (4.277, 0.05), (17, 0)]
BY_GEAR = [(law, *tuned) for law in LAWS for tuned in TUNED]
BY_CROSS = [(slots, *tuned) for slots in (3, 4, 6, 12) for tuned in TUNED]
BY_LAW = [(law, damping) for law in LAWS for damping in (0, 0.3)]
SLIDING: dict[str, Any] = {"inertia": None, "mass": 0.8}


def gear(law: str = "cycloidal", **changes: Any) -> Calculation:
    """The published stepper, whose gear drives the follower."""
    return stepper(motion_law=law, **changes)


# --- against scipy's integration -------------------------------------------------------------------------------------


def assert_numbers(calc: Calculation, parts: list[Part], rigid: float, rise: float) -> None:
    """Peaks and overshoot as integrated; the curve is differentiated twice, which leaves less than 1e-7 of its peak."""
    during, later = max(part.peak() for part in parts[:-1]), parts[-1].peak()
    low, high = min(part.reach()[0] for part in parts), max(part.reach()[1] for part in parts)
    assert number(calc, "rise") == pytest.approx(rise, rel=1e-12)
    assert number(calc, "acceleration_rigid") == pytest.approx(rigid, rel=1e-7)
    assert number(calc, "peak_ratio") == pytest.approx(during / rigid, rel=1e-7)
    assert number(calc, "residual_ratio") == pytest.approx(later / rigid, abs=1e-7)
    assert number(calc, "acceleration_peak") == pytest.approx(max(during, later), rel=5e-9)
    assert number(calc, "torque_peak") == pytest.approx(0.8 * max(during, later), rel=5e-9)
    assert number(calc, "overshoot") == pytest.approx(max(high - rise, -low) / rise, abs=1e-9)


def assert_curves(calc: Calculation, parts: list[Part], rigid: float, rise: float) -> None:
    """The curves over time, from where the input rests before the motion."""
    start, top = at(calc, "input", 0)[0], number(calc, "acceleration_peak")
    for part in parts:
        place = slice(1, -1, 5)
        t = part.time[place]
        for name, values, scale in (
            ("input", start + part.states[0][place], 1e-9 * rise),
            ("response", start + part.response[place], 1e-9 * rise),
            ("acceleration", part.swing(t), 1e-8 * top),
            ("rigid_acceleration", part.rigid[place], 1e-7 * rigid),
        ):
            np.testing.assert_allclose(at(calc, name, t), values, atol=scale, err_msg=name)


def compare(
    source: tuple[Calculation, str], motion: tuple[float, list[Stretch]], rate: float, rise: float, **keys: Any
) -> None:
    """The follower that a curve drives, against the motion integrated; the rest is no longer than the cycle leaves."""
    length, stretches = motion
    ratio, zeta = keys.pop("ratio"), keys.pop("damping")
    omega = 2 * np.pi * ratio / length
    calc = driven(*source, stiffness=0.8 * omega**2, damping_ratio=zeta, cycles_per_hour=3600 * rate, **keys)
    follow = min(3 * 2 * np.pi / omega, 1 / rate - length)
    parts = integrated(stretches, follow, omega, zeta)
    assert number(calc, "tuning_ratio") == pytest.approx(ratio, rel=1e-12)
    assert_numbers(calc, parts, rigid_peak(stretches), rise)
    assert_curves(calc, parts, rigid_peak(stretches), rise)
    times = calc.curve_samples("time")[0]
    assert times[-1] * len(times) / (len(times) - 1) == pytest.approx(length + follow, rel=1e-12)


@pytest.mark.parametrize("law, ratio, damping", few(BY_GEAR, keep=lambda drive: BY_GEAR.index(drive) % 4 == 0))
def test_a_gear_drives_the_link(law: str, ratio: float, damping: float) -> None:
    motion = gear_stretches(Gear(160, 60, 20, law, 6000 / 3600))
    compare((gear(law), "gear_angle"), motion, 6000 / 3600, 2 * np.pi, ratio=ratio, damping=damping)


def test_a_conveyor_drives_a_sliding_link() -> None:
    step = 20 * 0.0254 * 1.5
    motion = gear_stretches(Gear(160, 60, 20, "modified_sine", 6000 / 3600), step / (2 * np.pi))
    source = gear("modified_sine", **CONVEYOR)
    compare((source, "sheet_position"), motion, 6000 / 3600, step, ratio=5.5, damping=0.04, **SLIDING)


@pytest.mark.parametrize("slots, ratio, damping", few(BY_CROSS, keep=lambda drive: BY_CROSS.index(drive) % 4 == 0))
def test_a_geneva_wheel_drives_the_link(slots: int, ratio: float, damping: float) -> None:
    """Its acceleration jumps, and the motion goes on over the period's end."""
    cross = {"slots": slots, "center_distance": "200 mm", "crank_speed": "100 rpm", "roller_radius": "5 mm"}
    source = calculate(GENEVA, inputs(GENEVA, cross))
    rate = 100 / 60
    compare((source, "wheel_angle"), geneva_stretches(slots, rate), rate, 2 * np.pi / slots, ratio=ratio, damping=damping)  # fmt: skip


def test_the_gears_own_law_as_one_rise_would_understate_its_peak() -> None:
    """The gear moves by half a law, a law, half a law, which takes 2.7 times the acceleration of one law of the same rise."""
    by_gear = driven(gear(), "gear_angle", cycles_per_hour=6000)
    by_law = follower(rise=2 * np.pi, rise_time=number(by_gear, "rise_duration"))
    assert number(by_gear, "rise_duration") == pytest.approx(0.6 * 200 / 360, rel=1e-12)
    back, rise = 0.6 * 7 / 27, np.radians(80) * 160 / 60
    assert number(by_gear, "acceleration_rigid") == pytest.approx(2 * np.pi * rise / back**2, rel=1e-7)
    times = number(by_gear, "acceleration_rigid") / number(by_law, "acceleration_rigid")
    assert times == pytest.approx(2.7, abs=0.05)


# --- the same motion by a law and as a curve -------------------------------------------------------------------------


def assert_same(curve: Calculation, law: Calculation) -> None:
    """All numbers that both have."""
    names = set(curve.values) & set(law.values)
    assert {"acceleration_peak", "overshoot", "residual_ratio", "recommended_law", "tuning_ratio"} <= names
    for name in names:
        if law[name].dtype == object:
            assert curve[name][0, 0] == law[name][0, 0]
        elif not name.endswith("_at"):
            np.testing.assert_allclose(curve[name], law[name], rtol=1e-8, atol=1e-9, err_msg=name)


@pytest.mark.parametrize("law, damping", few(BY_LAW, keep=lambda drive: BY_LAW.index(drive) % 4 == 0))
def test_the_input_of_another_follower_is_the_law_itself(law: str, damping: float) -> None:
    by_law = follower(motion_law=law, damping_ratio=damping)
    assert_same(driven(by_law, "input", damping_ratio=damping), by_law)


class Moved(Inputs):
    """When the toy moves."""

    begin: Annotated[float, Quantity("b", "1", "Share at which the motion begins", ge=0, lt=1)] = 0.3
    lasts: Annotated[float, Quantity("d", "1", "Share that it takes", gt=0, lt=1)] = 0.4
    n_points: Annotated[int, Quantity("N", "1", "Samples", ge=36, integer=True)] = 90


@formula
def begins(begin: Any) -> Any:
    return 2 * np.pi * begin


@formula
def ends(begin: Any, lasts: Any) -> Any:
    return 2 * np.pi * (begin + lasts)


@formula
def same(angle: Any) -> Any:
    return angle


@formula
def moved(angle: Any, middle: Any, begin: Any, lasts: Any) -> Any:
    """One cycloidal rise of 1.2 a turn, that may go on over the turn's end."""
    late = np.where(middle < 2 * np.pi * (begin + lasts - 1), 1, 0)
    k = np.clip((angle / (2 * np.pi) + late - begin) / lasts, 0, 1)
    return 1.2 * (k - np.sin(2 * np.pi * k) / (2 * np.pi) - late)


TOY = Mechanism(
    kind="moved", version="1", title="Moved", summary="A rise in a turn.", inputs=Moved, chapters=(Chapter("Motion", steps=(
        Value(id="start", symbol="s", unit="rad", description="Start", formula=begins),
        Value(id="stop", symbol="e", unit="rad", description="End", formula=ends),
        Abscissa(id="angle", symbol="φ", unit="rad", description="Angle", period=2 * np.pi),
        Breakpoints(id="joints", abscissa="angle", places=("start", "stop")),
        Value(id="middle", symbol="m", unit="rad", description="Middle", per_piece=True, formula=bind(same, angle="angle")),
        Value(id="place", symbol="y", unit="rad", description="Place", formula=moved),
    )),),
)  # fmt: skip


@pytest.mark.parametrize("begin, lasts", [(0, 0.5), (0.3, 0.4), (0.5, 0.5), (0.8, 0.4), (0.1, 0.95), (0.999, 0.3)])
def test_a_motion_anywhere_in_the_cycle_is_the_law(begin: float, lasts: float) -> None:
    source = calculate(TOY, {"begin": begin, "lasts": lasts, "n_points": 90})
    cycle = 0.2 / lasts
    follow = min(3.0, (cycle - 0.2) / (2 * np.pi / np.sqrt(6500)))
    by_curve = driven(source, "place", cycles_per_hour=3600 / cycle)
    assert_same(by_curve, follower(dwell_cycles=follow))


def test_numbers_depend_neither_on_the_samples_here_nor_on_those_of_the_source() -> None:
    first = driven(gear(n_points=36), "gear_angle", cycles_per_hour=6000, n_points=5000)
    second = driven(gear(n_points=5000), "gear_angle", cycles_per_hour=6000, n_points=36)
    for name, value in first.values.items():
        if value.dtype != object and not name.endswith("_at"):
            np.testing.assert_allclose(value, second[name], rtol=1e-8, atol=1e-10, err_msg=name)


# --- variants --------------------------------------------------------------------------------------------------------


def curve_variants(count: int) -> dict[str, Array]:
    """Drives from soft to stiff."""
    draw = np.random.default_rng(11)
    return {
        "stiffness": draw.uniform(1000, 90_000, count),
        "inertia": draw.uniform(0.4, 1.5, count),
        "damping_ratio": draw.uniform(0, 0.5, count),
        "cycles_per_hour": draw.uniform(1, 2, count),  # a second, as the engine takes them
        "dwell_cycles": draw.uniform(0.5, 9, count),
    }


def test_many_variants_with_a_source_for_each_are_single_runs() -> None:
    count = 4
    varied = curve_variants(count)
    one_gear = {"cycles_per_hour": 6000, "n_points": 72, "motion_curve": CurveHandle(gear(), "gear_angle")}
    base = inputs(MECHANISM, {key: SHAFT[key] for key in ("inertia", "stiffness")} | one_gear)
    begin, lasts = np.random.default_rng(2).uniform([[0.0], [0.2]], [[0.99], [0.9]], (2, count))
    each = CurveHandle(calculate(TOY, {"begin": begin, "lasts": lasts, "n_points": 90}, variants=count), "place")
    together = calculate(MECHANISM, base | varied | {"motion_curve": each}, variants=count)
    assert together.flaws == {}
    for i in range(count):
        one = calculate(TOY, {"begin": float(begin[i]), "lasts": float(lasts[i]), "n_points": 90})
        own = {name: float(values[i]) for name, values in varied.items()} | {"motion_curve": CurveHandle(one, "place")}
        alone = calculate(MECHANISM, base | own)
        for name in ("tuning_ratio", "peak_ratio", "residual_ratio", "overshoot", "torque_peak", "acceleration_peak", "rest_time"):  # fmt: skip
            assert together[name][i, 0] == pytest.approx(number(alone, name), rel=1e-9, abs=1e-11), name


def test_a_rate_that_is_not_that_of_the_curve_is_refused() -> None:
    """At half the rate the same motion would have a quarter of its acceleration; a list of values tells no rate."""
    source = gear("modified_sine")
    with pytest.raises(Impossible, match="comes again at"):
        driven(source, "gear_angle", cycles_per_hour=3000)
    assert number(driven(source, "gear_angle", cycles_per_hour=6000), "cycle_time") == pytest.approx(0.6)
