"""The elastic follower driven by a law: against scipy's integration, closed solutions, energy, other forms of itself.

CI integrates one machine of each law and two dampings of the spectrum; what a law changes beside its motion is in no formula of
the plugin (tests/mechanics/test_follower_peaks.py has all laws), so that of the laws the one with most joints and one that jumps
are enough for the rest. At night: all.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BSpline, make_interp_spline

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics import motion_laws
from diecut_report.plugins.elastic_follower import MECHANISM
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import CurveRecord
from tests.examples import few
from tests.machines import inputs, number
from tests.mechanics.closed_follower import WAVES, after, response, undamped_cycloidal
from tests.plugins.followers import LAWS, SHAFT, at, checks, follower, integrated, law_stretches, verdicts

EACH_LAW = pytest.mark.parametrize("law", LAWS)
HARD_LAWS = pytest.mark.parametrize("law", few(LAWS, keep=lambda law: law in ("modified_trapezoidal", "harmonic")))
SLIDE: dict[str, Any] = {"inertia": None, "mass": "0.8 kg", "stiffness": "5200 N/m", "rise": "1.2 m"}
RATIOS = ("peak_ratio", "residual_ratio", "overshoot", "tuning_ratio", "natural_frequency")


def stiffness(ratio: float, inertia: float = 0.8, rise_time: float = 0.2) -> float:
    """The stiffness that gives so many natural periods within the rise."""
    return float(inertia * (2 * np.pi * ratio / rise_time) ** 2)


# --- against scipy's integration -------------------------------------------------------------------------------------


def compare(law: str, draw: np.random.Generator) -> None:
    """A random machine, all its numbers and curves."""
    ratio, zeta = draw.uniform(0.5, 12), draw.choice([0, draw.uniform(0, 0.9), draw.uniform(0, 0.1)])
    time, rise, body = 10 ** draw.uniform(-2, 1), 10 ** draw.uniform(-2, 1.5), 10 ** draw.uniform(-2, 3)
    share, follow = draw.uniform(0.02, 1), draw.choice([3, draw.uniform(0.1, 8)])
    omega = 2 * np.pi * ratio / time
    clock = ({"rise_time": time}, {"rise_time": share, "cycles_per_hour": 3600 * share / time})[draw.integers(2)]
    link: dict[str, Any] = ({"inertia": body}, {"inertia": None, "mass": body})[draw.integers(2)]
    keys: dict[str, Any] = {
        "stiffness": body * omega**2,
        "damping_ratio": zeta,
        "rise": rise,
        "motion_law": law,
        "dwell_cycles": follow,
    }
    calc = follower(**keys, **clock, **link)
    parts = integrated(law_stretches(law, rise, time), follow * 2 * np.pi / omega, omega, zeta)
    rigid, during, later = LAWS[law].peak * rise / time**2, max(p.peak() for p in parts[:-1]), parts[-1].peak()
    top = max(during, later)
    expected = {
        "natural_frequency": omega / (2 * np.pi), "tuning_ratio": ratio, "acceleration_rigid": rigid, "peak_ratio": during / rigid,
        "acceleration_peak": top, "torque_peak": body * top,
    }  # fmt: skip
    for name, value in expected.items():
        assert number(calc, name) == pytest.approx(value, rel=5e-10), name
    assert number(calc, "residual_ratio") == pytest.approx(later / rigid, abs=5e-10)
    assert number(calc, "overshoot") == pytest.approx(max(p.reach()[1] for p in parts) / rise - 1, abs=1e-9)
    for part in parts:
        place = slice(1, -1, 5)
        t = part.time[place]
        curves = {"input": (part.states[0][place], rise), "response": (part.response[place], rise),
                  "acceleration": (part.swing(t), top), "rigid_acceleration": (part.rigid[place], rigid),
                  "torque": (body * part.swing(t), body * top)}  # fmt: skip
        for name, (values, scale) in curves.items():
            np.testing.assert_allclose(at(calc, name, t), values, atol=1e-9 * scale, err_msg=name)


@EACH_LAW
def test_numbers_and_curves_are_those_that_scipy_integrates(law: str) -> None:
    compare(law, np.random.default_rng(list(LAWS).index(law)))


@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(8))
@EACH_LAW
def test_many_machines_are_those_that_scipy_integrates(law: str, seed: int) -> None:
    compare(law, np.random.default_rng(100 + 10 * seed + list(LAWS).index(law)))


@cache
def spectrum() -> dict[str, CurveRecord]:
    """The curves of the results."""
    return mechanism_results(follower(), {}).curves


@pytest.mark.parametrize("part", few(range(3), keep=lambda part: part == 1))
@pytest.mark.parametrize("place", few(range(5), keep=lambda place: place == 2))
@pytest.mark.nightly
def test_the_spectrum_is_what_scipy_integrates(place: int, part: int) -> None:
    """Each law and damping at three places of the spectrum, in CI at one in its middle; a rise of 1 in 1 s."""
    curves, damping = spectrum(), (0, 0.02, 0.05, 0.1, 0.2)[place]
    ratios = np.array(curves["tuning_ratio"].values)
    assert (ratios[0], ratios[-1]) == (0.5, 10)
    for number_of, (law, known) in enumerate(LAWS.items()):
        found = curves[f"peak_ratio_{law}_damping_{round(100 * damping):02}"].values
        i = (number_of + 3, 20 + 5 * place, -1 - number_of)[part]
        omega = 2 * np.pi * ratios[i]
        parts = integrated(law_stretches(law, 1.0, 1.0), 1e-3, omega, damping, fine=400)
        assert found[i] == pytest.approx(max(p.peak() for p in parts[:-1]) / known.peak, rel=1e-8)


# --- closed solutions ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [0.5, 1, 1.5, 2, 2.5, 4.8, 5, 10, 33.3])
def test_the_undamped_cycloidal_drive_is_the_closed_one(ratio: float) -> None:
    calc = follower(stiffness=stiffness(ratio), damping_ratio=0)
    found = number(calc, "peak_ratio"), number(calc, "residual_ratio")
    np.testing.assert_allclose(found, undamped_cycloidal(ratio), rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("law", WAVES)
@pytest.mark.parametrize("ratio, damping", [(0.7, 0.05), (2.5, 0), (6.3, 0.4), (40, 0.02)])
def test_the_acceleration_is_the_closed_one(law: str, ratio: float, damping: float) -> None:
    calc = follower(motion_law=law, stiffness=stiffness(ratio), damping_ratio=damping)
    k = np.linspace(1e-9, 1 - 1e-9, 1001)
    scale = 1.2 / 0.2**2
    moving, rate = response(WAVES[law], ratio, damping, k)
    end, slope = response(WAVES[law], ratio, damping, np.array([1.0]))
    swinging = after(motion_laws.LAWS[law], end[0], slope[0], ratio, damping, k * 3 / ratio)
    tolerance = 1e-9 * scale * max(np.abs(moving).max(), np.abs(rate).max() / (2 * np.pi * ratio))
    np.testing.assert_allclose(at(calc, "acceleration", 0.2 * k), scale * moving, atol=tolerance)
    np.testing.assert_allclose(at(calc, "acceleration", 0.2 * (1 + k * 3 / ratio)), scale * swinging, atol=tolerance)


def test_a_stiff_drive_carries_the_link_with_the_input() -> None:
    calc = follower(stiffness=stiffness(49), damping_ratio=0.5)
    assert number(calc, "peak_ratio") == pytest.approx(1, abs=1e-3)
    assert number(calc, "overshoot") == pytest.approx(0, abs=1e-5)


# --- mechanics -------------------------------------------------------------------------------------------------------


def spline(calc: Calculation, curve: str, time: Any) -> BSpline:
    """A curve's spline of fifth order within a smooth piece."""
    return make_interp_spline(time, at(calc, curve, time), 5)


@pytest.mark.parametrize("law", ["cycloidal", "polynomial_345", "polynomial_4567"])
@pytest.mark.parametrize("damping", [0, 0.05, 0.6])
def test_the_work_of_the_input_is_in_motion_strain_and_heat(law: str, damping: float) -> None:
    """At the end of the rise and of the rest: ∫Mẏ dt = Iẋ²/2 + Kz²/2 + ∫Cż² dt."""
    calc = follower(motion_law=law, damping_ratio=damping)
    constant = 2 * damping * np.sqrt(5200 * 0.8)
    work = heat = np.zeros(())
    for low, high in pairwise((0.0, 0.2, 0.2 + 3 * number(calc, "natural_period"))):
        time = np.linspace(low, high - 1e-12, 4001)
        y, x, torque = (spline(calc, name, time) for name in ("input", "response", "torque"))
        z, speed = at(calc, "response", time) - at(calc, "input", time), (x.derivative()(time) - y.derivative()(time))
        work = work + make_interp_spline(time, torque(time) * y.derivative()(time), 5).integrate(low, high - 1e-12)
        heat = heat + make_interp_spline(time, constant * speed**2, 5).integrate(low, high - 1e-12)
        held = 0.8 * x.derivative()(time[-1]) ** 2 / 2 + 5200 * z[-1] ** 2 / 2
        assert float(work) == pytest.approx(float(held + heat), abs=1e-8 * number(calc, "torque_peak") * 1.2)
    assert (float(heat) > 0.01) is (damping > 0)


def test_the_torque_is_what_accelerates_the_link_and_what_strains_and_damps_the_drive() -> None:
    calc = follower(damping_ratio=0.3)
    time = np.linspace(0, 0.2 - 1e-12, 2001)
    torque = at(calc, "torque", time)
    np.testing.assert_allclose(torque, 0.8 * at(calc, "acceleration", time), atol=1e-11 * np.abs(torque).max())
    ahead = make_interp_spline(time, at(calc, "input", time) - at(calc, "response", time), 5)
    drive = 5200 * ahead(time) + 2 * 0.3 * np.sqrt(5200 * 0.8) * ahead.derivative()(time)
    np.testing.assert_allclose(torque, drive, atol=1e-8 * np.abs(torque).max())
    assert number(calc, "damping_constant") == pytest.approx(0.6 * np.sqrt(4160), rel=1e-14)


def test_what_turns_and_what_slides_have_the_same_numbers() -> None:
    turning, sliding = follower(), follower(**SLIDE)
    names = [name for name, value in turning.values.items() if value.dtype != object]
    assert {"peak_ratio", "overshoot", "torque_peak", "harmonic_acceleration"} <= set(names)
    for name in names:
        np.testing.assert_array_equal(turning[name], sliding[name], err_msg=name)
    for name in ("input", "response", "acceleration", "rigid_acceleration"):
        np.testing.assert_array_equal(turning.curve_samples(name), sliding.curve_samples(name))


def test_equal_tuning_and_damping_are_dynamically_similar() -> None:
    """Ten times the inertia, half the time, another rise: 40 times the stiffness."""
    one, other = follower(), follower(inertia=8, stiffness=5200 * 40, rise_time="0.1 s", rise=0.03)
    for name in ("peak_ratio", "residual_ratio", "overshoot", "tuning_ratio"):
        assert number(one, name) == pytest.approx(number(other, name), rel=1e-11), name
    assert one["recommended_law"][0, 0] == other["recommended_law"][0, 0]


@HARD_LAWS
def test_more_damping_lowers_the_peaks_at_this_tuning(law: str) -> None:
    """λ = 2.57; not everywhere: near 0.7 the peak in the rise grows with a little damping."""
    found = [number(follower(motion_law=law, damping_ratio=zeta), "peak_ratio") for zeta in (0, 0.02, 0.05, 0.1, 0.2)]
    assert found == sorted(found, reverse=True)


# --- the same machine given otherwise --------------------------------------------------------------------------------


@HARD_LAWS
def test_numbers_do_not_depend_on_the_samples(law: str) -> None:
    few, many = (follower(motion_law=law, n_points=count) for count in (36, 5000))
    for name, value in few.values.items():
        if value.dtype != object and not name.endswith("_at"):
            np.testing.assert_allclose(value, many[name], rtol=1e-12, atol=1e-13, err_msg=name)


def test_a_share_of_the_cycle_is_its_time() -> None:
    seconds, share = follower(), follower(rise_time=0.25, cycles_per_hour=4500)
    assert number(share, "cycle_time") == pytest.approx(0.8, rel=1e-15)
    for name in (*RATIOS, "acceleration_peak", "torque_peak"):
        assert number(share, name) == pytest.approx(number(seconds, name), rel=1e-12), name


def test_the_residual_vibration_is_followed_as_long_as_wanted() -> None:
    """The first peak of what swings on comes within a natural period; before it the ratio is that of the time followed."""
    short, whole, long = (follower(damping_ratio=0, dwell_cycles=count) for count in (0.05, 1, 7))
    time = np.linspace(0.2, 0.2 + 0.05 * 2 * np.pi / np.sqrt(6500) - 1e-12, 2001)
    assert number(short, "residual_ratio") == pytest.approx(
        np.abs(at(whole, "acceleration", time)).max() / number(whole, "acceleration_rigid"), rel=1e-9
    )
    assert number(short, "residual_ratio") < 0.9 * number(whole, "residual_ratio")
    assert number(long, "residual_ratio") == pytest.approx(number(whole, "residual_ratio"), rel=1e-11)
    times = long.curve_samples("time")[0]
    assert len(times) == 720
    assert times[-1] * 720 / 719 == pytest.approx(0.2 + 7 * 2 * np.pi / np.sqrt(6500), rel=1e-12)


def test_a_variant_that_cannot_be_calculated_spoils_no_other() -> None:
    base = inputs(MECHANISM, SHAFT | {"n_points": 72})
    together = calculate(MECHANISM, base | {"stiffness": np.array([1e-3, 5200.0, 1e9])}, variants=3)
    assert {variant: key for variant, (key, _) in together.flaws.items()} == {0: "stiffness", 2: "stiffness"}
    assert together["peak_ratio"][1, 0] == pytest.approx(number(follower(), "peak_ratio"), rel=1e-12)


# --- recommendation and checks ---------------------------------------------------------------------------------------


TUNED = [(0.6, 0.05), (1.5, 0), (2.566, 0.05), (5, 0.02), (7.7, 0.2), (20, 0.1)]


@pytest.mark.parametrize("ratio, damping", few(TUNED, keep=lambda tuned: tuned[0] in (0.6, 2.566)))
def test_the_recommended_law_is_that_of_the_least_peak(ratio: float, damping: float) -> None:
    """Each law's machine is calculated alone; the machine's own law makes no difference."""
    keys = {"stiffness": stiffness(ratio), "damping_ratio": damping}
    calcs = {law: follower(motion_law=law, **keys) for law in LAWS}
    peaks = {law: number(calc, "acceleration_peak") for law, calc in calcs.items()}
    assert {calc["recommended_law"][0, 0] for calc in calcs.values()} == {min(peaks, key=lambda law: peaks[law])}
    for law, peak in peaks.items():
        assert number(calcs["harmonic"], f"{law}_acceleration") == pytest.approx(peak, rel=1e-9)


@pytest.mark.nightly
def test_ratios_are_held_against_their_limits() -> None:
    calc = follower()
    peak, residual = number(calc, "peak_ratio"), number(calc, "residual_ratio")
    found = {name: (check.demand, check.limit) for name, check in checks(calc).items()}
    assert (found["peak_ratio"], found["residual"]) == ((peak, 1.1), (residual, 0.2))
    for share, others, status, other_status in ((1.001, 0.999, "pass", "fail"), (0.999, 1.001, "fail", "pass")):
        allowed = {"allowable_peak_ratio": peak * share, "allowable_residual_ratio": residual * others}
        judged = verdicts(follower(**allowed))
        assert (judged["peak_ratio"], judged["residual"]) == (status, other_status)


@pytest.mark.parametrize("ratio, status", [(4.99, "warn"), (5.01, "pass")])
def test_fewer_than_five_natural_periods_are_a_warning(ratio: float, status: str) -> None:
    assert verdicts(follower(stiffness=stiffness(ratio)))["tuning_ratio"] == status


@pytest.mark.parametrize("law", ["harmonic", "parabolic"])
def test_a_law_that_jumps_never_keeps_the_limit(law: str) -> None:
    for ratio in (1, 3.3, 50):
        calc = follower(motion_law=law, stiffness=stiffness(ratio) * (1 - 1e-12), damping_ratio=0)
        assert verdicts(calc)["peak_ratio"] == "fail"
    assert number(follower(motion_law=law, stiffness=stiffness(5), damping_ratio=0), "peak_ratio") == pytest.approx(
        {"harmonic": 2.02, "parabolic": 4.0}[law], abs=5e-3
    )
