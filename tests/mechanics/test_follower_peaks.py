"""Peaks of a driven link on an elastic drive: the published table, closed solutions, scipy's integration, the equation of motion."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline, make_interp_spline

from diecut_report.api import number, pi
from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula, evaluate, formula
from diecut_report.mechanics import followers as follower
from diecut_report.mechanics.followers import peaks
from diecut_report.mechanics.motion_laws import LAWS, MotionLaw, register
from tests.examples import examples, few
from tests.mechanics.closed_follower import WAVES, Wave, after, response, undamped_cycloidal

HARD = ("modified_trapezoidal", "harmonic", "polynomial_4567")  # most joints, a jump, a long polynomial
BY_LAW = pytest.mark.parametrize("law", LAWS.values(), ids=lambda law: law.name)
JUMPING = ("harmonic", "parabolic")  # in acceleration
TABLE = [  # law, λ, damping ratio, peak during the rise, peak after it
    ("cycloidal", 1.5, 0, 2.8532, 2.4000), ("cycloidal", 1.5, 0.05, 2.4833, 1.7858), ("cycloidal", 1.5, 0.2, 1.8443, 0.8823),
    ("cycloidal", 2.5, 0, 1.6249, 0.9524), ("cycloidal", 2.5, 0.05, 1.5317, 0.6409), ("cycloidal", 2.5, 0.2, 1.3460, 0.3618),
    ("cycloidal", 5, 0, 1.0825, 0.0000), ("cycloidal", 5, 0.05, 1.0426, 0.1530), ("cycloidal", 5, 0.2, 1.0397, 0.1563),
    ("harmonic", 5, 0, 2.0202, 2.0202), ("harmonic", 5, 0.05, 1.8315, 1.2203), ("harmonic", 5, 0.2, 1.5481, 1.0118),
    ("polynomial_345", 2.5, 0, 1.7407, 1.2588), ("polynomial_345", 2.5, 0.05, 1.6306, 0.8484),
    ("polynomial_345", 2.5, 0.2, 1.4120, 0.4605),
]  # fmt: skip


@pytest.mark.parametrize("name, ratio, damping, rise, residual", TABLE)
def test_the_published_table(name: str, ratio: float, damping: float, rise: float, residual: float) -> None:
    found = peaks(LAWS[name], ratio, damping)
    assert found.rise == pytest.approx(rise, abs=5.0001e-5)
    assert found.residual == pytest.approx(residual, abs=5.0001e-5)


@pytest.mark.parametrize("ratio", [0.1, 0.37, 0.5, 0.9, 1, 1.0001, 1.5, 2, 2.5, 3, 4.8, 5, 10, 33.3, 100])
def test_the_undamped_cycloidal_law_in_closed_form(ratio: float) -> None:
    found = peaks(LAWS["cycloidal"], ratio, 0)
    np.testing.assert_allclose(found, undamped_cycloidal(ratio), rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("ratio", [1, 3, 5, 7, 99])
def test_a_parabolic_law_is_worst_at_odd_ratios(ratio: float) -> None:
    """It swings from 0 about A to 2A in the middle, from there about −A to −4A, and ends at 2A with half a period left over."""
    found = peaks(LAWS["parabolic"], ratio, 0)
    np.testing.assert_allclose(found, (4, 4), rtol=1e-11)


RATIOS = np.array([0.1, 0.6, 1.0, 1.7, 3.35, 9.2])
DAMPINGS = np.array([0, 0.03, 0.2, 0.9])


def stretch(law: MotionLaw, moves: bool, low: float, high: float, start: Array, drives: Array) -> tuple[Array, Array]:
    """Peaks of all drives (rows ω, ζ) in one smooth stretch, and the state at its end, by scipy's integration.

    ẍ and its derivative are known at 800 places a natural period: cubic pieces between them are out by (2π/800)⁴/384 = 1e-11.
    """
    omega, damping = drives
    places = np.linspace(low, high, 2 + int(800 * (high - low) * omega.max() / (2 * np.pi)))
    places[[0, -1]] += (1e-13, -1e-13)  # not on a joint

    def driving(k: Array | float) -> Array:
        return np.asarray(law.acceleration(k), float) if moves else np.zeros(np.shape(k))

    def rates(k: float, state: Array) -> Array:
        deflection, speed = state.reshape(2, -1)
        return np.concatenate([speed, -2 * damping * omega * speed - omega**2 * deflection - driving(k)])

    solved = solve_ivp(rates, (places[0], places[-1]), start, "DOP853", places, rtol=1e-12, atol=1e-14,
                       max_step=0.1 / omega.max())  # fmt: skip
    deflection, speed = solved.y.reshape(2, omega.size, -1).transpose(0, 2, 1)
    value = -2 * damping * omega * speed - omega**2 * deflection
    curve = CubicHermiteSpline(
        places, value, -2 * damping * omega * (value - driving(places)[:, None]) - omega**2 * speed
    )
    still = curve.derivative().roots(extrapolate=False)
    inside = [np.abs(curve(k[np.isfinite(k)])[:, drive]).max(initial=0) for drive, k in enumerate(still)]
    return np.maximum(np.abs(value).max(axis=0), inside), solved.y[:, -1]


@pytest.mark.parametrize("law", few(LAWS.values(), keep=lambda law: law.name in HARD), ids=lambda law: law.name)
def test_all_laws_as_scipy_integrates_them(law: MotionLaw) -> None:
    """Broken at the joints; what swings on is followed for the longest half period that there is."""
    ratio, damping = (grid.ravel() for grid in np.meshgrid(RATIOS, DAMPINGS))
    drives = np.array([2 * np.pi * ratio, damping])
    rise, state = np.zeros(ratio.size), np.zeros(2 * ratio.size)
    for low, high in pairwise((0.0, *law.breakpoints, 1.0)):
        top, state = stretch(law, True, low, high, state, drives)
        rise = np.maximum(rise, top)
    residual = np.zeros(ratio.size)
    for each in RATIOS:  # one by one: the slow ones need the time, the quick ones the small steps
        part = ratio == each
        longest = np.pi / np.min(drives[0, part] * np.sqrt(1 - damping[part] ** 2))
        residual[part], _ = stretch(
            law, False, 1.0, 1.0 + longest, state.reshape(2, -1)[:, part].ravel(), drives[:, part]
        )
    found = peaks(law, ratio, damping)
    np.testing.assert_allclose(found.rise, rise / law.A, rtol=1e-9)
    np.testing.assert_allclose(found.residual, residual / law.A, rtol=1e-9, atol=1e-10)


@given(
    name=st.sampled_from(list(WAVES)),
    ratio=st.floats(0.1, 100),
    damping=st.one_of(st.just(0.0), st.floats(0, 0.95)),
)
@examples(150)
def test_no_place_exceeds_the_peak_and_the_best_of_many_comes_near(name: str, ratio: float, damping: float) -> None:
    """The greatest of many places is out by half the square of the step, at the fastest swing that there is."""
    wave = WAVES[name]
    assume(abs(2 * np.pi * ratio / wave.frequency - 1) > 1e-3)  # the closed form holds beside the resonance
    law, k = LAWS[name], np.linspace(0, 1, 20001)
    sample, rate = response(wave, ratio, damping, k)
    period = 1 / (ratio * np.sqrt(1 - damping**2))
    decay = after(law, sample[-1], rate[-1], ratio, damping, k * period)
    found = peaks(law, ratio, damping)
    for peak, values, step in ((found.rise, sample, k[1]), (found.residual, decay, k[1] * period)):
        best = float(np.abs(values).max()) / law.A
        assert best <= peak + 1e-10
        assert peak <= best + (2 * np.pi * max(ratio, 1) * step) ** 2 * max(1, peak)


def test_arrays_give_what_single_numbers_give() -> None:
    ratios, dampings = np.geomspace(0.1, 100, 7)[:, None], np.array([0, 0.05, 0.9])
    for law in LAWS.values():
        together = peaks(law, ratios, dampings)
        single = np.array([[peaks(law, ratio, damping) for damping in dampings] for ratio in ratios[:, 0]])
        assert together.rise.shape == together.residual.shape == (7, 3)
        np.testing.assert_allclose(np.moveaxis(together, 0, -1), single, rtol=1e-11, atol=1e-12)


def test_many_drives_are_taken_in_blocks() -> None:
    """More values at nodes than one block holds give the same as each block alone."""
    ratios = np.linspace(60, 64, 120)
    together = peaks(LAWS["cycloidal"], ratios, 0)
    expected = np.array([undamped_cycloidal(ratio) for ratio in ratios]).T
    np.testing.assert_allclose(together, expected, rtol=1e-10, atol=1e-12)


def test_the_shape_is_that_of_both_together() -> None:
    assert np.shape(peaks(LAWS["cycloidal"], 2, 0.1).rise) == ()
    assert peaks(LAWS["cycloidal"], [2, 3], 0.1).residual.shape == (2,)
    assert peaks(LAWS["cycloidal"], np.ones((4, 1, 1)), np.zeros((3, 1))).rise.shape == (4, 3, 1)
    assert peaks(LAWS["cycloidal"], [], 0).rise.shape == (0,)


@pytest.mark.parametrize(
    "ratio, damping", [(0, 0.1), (-1, 0.1), (np.nan, 0.1), (np.inf, 0.1), (5, 1), (5, -0.1), (5, np.nan)]
)
def test_what_is_no_damped_swing_is_no_number_and_spoils_nothing(ratio: float, damping: float) -> None:
    found = peaks(LAWS["cycloidal"], [ratio, 1.5], [damping, 0])
    assert np.isnan([found.rise[0], found.residual[0]]).all()
    np.testing.assert_allclose([found.rise[1], found.residual[1]], undamped_cycloidal(1.5), rtol=1e-12)


@pytest.mark.parametrize("name", [name for name in LAWS if name not in JUMPING])
@pytest.mark.parametrize("ratio", [50, 99.7])
def test_a_stiff_drive_follows_a_smooth_law(name: str, ratio: float) -> None:
    """Each jump of the jerk leaves a swing of the size jump/ω, of which all together stand beside the rigid motion."""
    law = LAWS[name]
    sides = [(float(law.jerk(k - 1e-12)) if k else 0, float(law.jerk(k + 1e-12)) if k < 1 else 0)
             for k in (0.0, *law.breakpoints, 1.0)]  # fmt: skip
    swing = sum(abs(right - left) for left, right in sides) / (2 * np.pi * ratio * law.A)
    found = peaks(law, ratio, 0)
    assert abs(found.rise - 1) <= swing + 10 / ratio**2
    assert found.residual <= swing + 10 / ratio**2
    damped = peaks(law, ratio, 0.9)
    assert damped.rise == pytest.approx(1, abs=10 / ratio**2 + swing / 5)


@pytest.mark.parametrize("name", WAVES)
def test_a_stiff_drive_of_great_damping_does_not_overflow(name: str) -> None:
    law, k = LAWS[name], np.linspace(0, 1, 400001)
    sample, rate = response(WAVES[name], 100, 0.9, k)
    decay = after(law, sample[-1], rate[-1], 100, 0.9, k / 30)
    found = peaks(law, 100, 0.9)
    assert found.rise == pytest.approx(np.abs(sample).max() / law.A, rel=2e-6)
    assert found.residual == pytest.approx(np.abs(decay).max() / law.A, rel=1e-6)


# --- laws of a user --------------------------------------------------------------------------------------------------


stepping_position = formula(lambda k: k - np.sin(24 * pi * k) / (24 * pi))
stepping_velocity = formula(lambda k: 1 - np.cos(24 * pi * k))
stepping_acceleration = formula(lambda k: 24 * pi * np.sin(24 * pi * k))
stepping_jerk = formula(lambda k: 576 * pi**2 * np.cos(24 * pi * k))
stepping_peak = formula(lambda: 24 * pi)
hasty_position = formula(lambda k: np.where(k < number(3) / 10, k**2 / 0.3, 1 - (1 - k) ** 2 / 0.7))
hasty_velocity = formula(lambda k: np.where(k < number(3) / 10, 2 * k / 0.3, 2 * (1 - k) / 0.7))
hasty_acceleration = formula(lambda k: np.where(k < number(3) / 10, number(2) / 0.3, -number(2) / 0.7))
nothing = formula(lambda k: 0 * k)
hasty_joint = formula(lambda k: k - number(3) / 10)
hasty_peak = formula(lambda: number(2) / 0.3)
two = formula(lambda: 2)


@pytest.fixture
def own_laws() -> Iterator[None]:
    """Two laws of a user, taken back after the test."""
    known = dict(LAWS)
    register(MotionLaw(name="stepping", title="Twelve small steps", position=stepping_position, velocity=stepping_velocity,
                       acceleration=stepping_acceleration, jerk=stepping_jerk, peak_velocity=two,
                       peak_acceleration=stepping_peak))  # fmt: skip
    register(MotionLaw(name="hasty", title="Quick start, slow end", position=hasty_position, velocity=hasty_velocity,
                       acceleration=hasty_acceleration, jerk=nothing, peak_velocity=two, peak_acceleration=hasty_peak,
                       breakpoints=(3 / 10,), joint=hasty_joint))  # fmt: skip
    yield
    LAWS.clear()
    LAWS.update(known)


@pytest.mark.usefixtures("own_laws")
@pytest.mark.parametrize("ratio, damping", [(0.2, 0), (0.9, 0.05), (7, 0.3), (40, 0.01)])
def test_a_law_that_is_quicker_than_the_drive(ratio: float, damping: float) -> None:
    law, k = LAWS["stepping"], np.linspace(0, 1, 200001)
    sample, rate = response(Wave(-24j * np.pi, 24 * np.pi), ratio, damping, k)
    decay = after(law, sample[-1], rate[-1], ratio, damping, k / ratio)
    found = peaks(law, ratio, damping)
    np.testing.assert_allclose(found, [np.abs(part).max() / (24 * np.pi) for part in (sample, decay)], rtol=1e-6)


@pytest.mark.usefixtures("own_laws")
@pytest.mark.parametrize("ratio", [0.3, 1, 2.6, 10])
def test_a_law_with_its_joint_off_the_middle(ratio: float) -> None:
    """Undamped: each step a of the input's acceleration answers a·(1 − cos ω(k − k₀))."""
    k, omega = np.linspace(0, 1, 200001), 2 * np.pi * ratio
    steps = [(0.0, 2 / 0.3), (0.3, -2 / 0.3 - 2 / 0.7), (1.0, 2 / 0.7)]

    def answer(place: Array) -> Array:
        return np.asarray(sum(size * (1 - np.cos(omega * np.maximum(place - start, 0))) for start, size in steps))

    found = peaks(LAWS["hasty"], ratio, 0)
    expected = [np.abs(answer(part)).max() / (2 / 0.3) for part in (k, 1 + k / ratio)]
    np.testing.assert_allclose(found, expected, rtol=1e-7, atol=1e-12)


@pytest.mark.parametrize("name, damping", [("cycloidal", 0), ("polynomial_345", 0.05), ("polynomial_4567", 0.9)])
def test_the_formulas_satisfy_the_equation_of_motion(name: str, damping: float) -> None:
    """Running integrals by quintic splines, derivatives of the link's place by finite differences; a real shaft in SI."""
    stiffness, inertia, rise, rise_time, law = 5200.0, 0.8, 1.2, 0.09, LAWS[name]
    omega = follower.natural_angular_frequency(stiffness, inertia)
    assert omega == pytest.approx(80.6225774829855)
    assert follower.tuning_ratio(omega, rise_time) == pytest.approx(80.6225774829855 / 6.283185307179586 * 0.09)
    constant = follower.damping_constant(damping, inertia, omega)
    assert constant == pytest.approx(2 * damping * np.sqrt(5200 * 0.8))
    damped = follower.damped_angular_frequency(omega, damping)
    time = np.linspace(0, rise_time, 3001)
    step, k = time[1], time / rise_time
    swing = (follower.decay(time, omega, damping), follower.phase(time, damped))
    input_acceleration = rise / rise_time**2 * law.acceleration(k)
    parts = [part(*swing, input_acceleration) for part in (follower.in_phase_part, follower.quadrature_part)]
    running = [make_interp_spline(time, part, 5).antiderivative()(time) for part in parts]
    z = follower.deflection(*swing, damped, *running)
    rate = follower.deflection_velocity(follower.swing_speed(*swing, *running), omega, damping, z)
    x, v = rise * law.position(k) + z, rise / rise_time * law.velocity(k) + rate
    found = follower.response_acceleration(omega, damping, z, rate)
    torque = follower.drive_torque(stiffness, constant, z, rate)
    scale = rise / rise_time**2 * law.A
    np.testing.assert_allclose(inertia * found, torque, atol=1e-10 * inertia * scale)

    def slope(values: Array) -> Array:
        return (values[:-4] - 8 * values[1:-3] + 8 * values[3:-1] - values[4:]) / (12 * step)

    np.testing.assert_allclose(slope(x), v[2:-2], atol=1e-9 * rise / rise_time)
    np.testing.assert_allclose(slope(v), found[2:-2], atol=1e-8 * scale)
    assert np.abs(found).max() / scale == pytest.approx(peaks(law, omega * rise_time / 6.283185307179586, damping).rise, rel=1e-6)  # fmt: skip


FORMULAS = [part for part in vars(follower).values() if isinstance(part, Formula)]


@pytest.mark.parametrize("part", FORMULAS, ids=lambda part: part.__name__)
def test_what_is_printed_is_what_is_computed(part: Formula) -> None:
    values = {name: 0.1 + 0.13 * place for place, name in enumerate(part.parameters)}
    assert evaluate(part.tree, lambda leaf: values[leaf.args[0]]) == pytest.approx(part(**values), rel=1e-14)
