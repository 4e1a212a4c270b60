"""What the sources tell beside the numbers of their rows: what leaves no return, would buckle, has another form, or follows from a mistake."""

from __future__ import annotations

from math import degrees, pi, radians

import numpy as np
import pytest

from diecut_report.machine.calculation import Impossible
from diecut_report.mechanics import slider_crank
from diecut_report.plugins.gear_pair import formulas as f
from diecut_report.results.mechanism import mechanism_results
from tests.machines import at, number
from tests.plugins.steppers import stepper
from tests.validation.rows_damper import damper
from tests.validation.rows_gear_pair import found
from tests.validation.rows_knife_drive import knife
from tests.validation.rows_platen_press import eq_14, press


def test_the_sources_longest_dwell_leaves_no_return_with_its_sweeps() -> None:
    with pytest.raises(Impossible, match=r"= -0\.04"):
        stepper(dwell_angle="225 deg")


def test_the_block_that_the_formula_alone_gives_would_buckle() -> None:
    checks = {check.id: check for check in mechanism_results(damper(), {}).checks}
    assert checks["slenderness"].status == "fail"
    assert checks["slenderness"].demand == pytest.approx(560 / 30, rel=1e-12)
    assert (checks["strain"].status, checks["stress"].status) == ("pass", "pass")


THETA = {1: radians(48.10260415904784), 2: radians(56.99835389167487)}  # as the code has them


@pytest.mark.parametrize(
    ("gear", "chord", "radius"), [(1, 8.748743355951145, 1.3161477577049423), (2, 9.239504610725831, 1.325999192893118)]
)
def test_the_critical_section_is_that_of_the_code_at_its_own_angle(gear: int, chord: float, radius: float) -> None:
    known = (found("code", f"virtual_teeth_{gear}"), THETA[gear], found("code", f"rounding_height_{gear}"), 0.25)
    assert 4 * f.root_chord(*known) == pytest.approx(chord, rel=1e-12)
    assert 4 * f.fillet_radius(*known) == pytest.approx(radius, rel=1e-12)


@pytest.mark.parametrize(
    ("gear", "angle", "arm", "form", "stress"),
    [(1, 34.561848000666245, 8.174657642839318, 2.246336378902072, 1.9147262565947287),
     (2, 22.738705423178445, 7.834245947926714, 2.1616566798058514, 2.008781657562889)],
)  # fmt: skip
def test_with_the_load_at_the_tip_the_factors_are_those_of_the_code(
    gear: int, angle: float, arm: float, form: float, stress: float
) -> None:
    """DIN 3990 method C lets the load act at the tip: the same formulas with another diameter."""
    teeth = found("code", f"virtual_teeth_{gear}")
    half = found("code", f"tip_half_angle_{gear}")
    load = found("code", f"tip_angle_{gear}") - half
    assert load == pytest.approx(radians(angle), rel=1e-12)
    center = found("code", f"rounding_height_{gear}")
    own_arm = f.load_arm(half, load, teeth + 2 * found("code", f"tip_height_{gear}"), teeth, THETA[gear], center, 0.25)
    assert 4 * own_arm == pytest.approx(arm, rel=1e-12)
    chord, fillet = (g(teeth, THETA[gear], center, 0.25) for g in (f.root_chord, f.fillet_radius))
    assert f.form_factor(own_arm, load, chord, radians(20)) == pytest.approx(form, rel=1e-12)
    assert f.stress_factor(chord, own_arm, chord / (2 * fillet)) == pytest.approx(stress, rel=1e-12)


def test_the_safeties_of_the_code_follow_from_its_stress_numbers() -> None:
    """Its σ_Hdyn by its own K factors, on our nominal stress."""
    stress = f.contact_stress(found("code", "nominal_contact_stress"), found("code", "contact_factor_1"), 1.75, 1.0278576187783273,
                              1.1064272863295082, 1.0)  # fmt: skip
    assert stress == pytest.approx(1241.7875902772687e6, rel=1e-9)
    assert f.pitting_safety(1500e6, 1.0, 1.0, stress) == pytest.approx(1.2079360526264216, rel=1e-9)


PHI = np.linspace(0.05, 6.2, 200)
LAMBDA = 4.0
BETA = np.arcsin(np.sin(PHI) / LAMBDA)


def test_the_printed_displacement_of_eq_2_is_no_integral_of_its_velocity() -> None:
    printed_velocity = np.sin(PHI) + np.cos(PHI) * np.tan(BETA)
    step = 1e-5

    def slope(displacement: object) -> np.ndarray:
        assert callable(displacement)
        return np.asarray((displacement(PHI + step) - displacement(PHI - step)) / (2 * step))

    def printed(phi: np.ndarray) -> np.ndarray:
        return np.asarray(1 + LAMBDA * np.cos(phi) - LAMBDA * np.cos(np.arcsin(np.sin(phi) / LAMBDA)))

    def corrected(phi: np.ndarray) -> np.ndarray:
        beta = slider_crank.coupler_angle(phi, LAMBDA)
        return np.asarray(slider_crank.displacement(phi, beta, 1.0, LAMBDA))

    assert np.abs(slope(printed) - printed_velocity).max() > 1
    np.testing.assert_allclose(slope(corrected), printed_velocity, atol=1e-8)


@pytest.mark.parametrize(
    "factor, angle, fits",
    [("coupler", "rocker", True), ("rocker", "rocker", False), ("coupler", "coupler", False)],
    ids=["corrected", "λ₃ω₂² as printed", "sin(δ − φ) in ω₂ as printed"],
)
def test_eq_3_gives_the_rockers_acceleration_only_as_corrected(factor: str, angle: str, fits: bool) -> None:
    """004's letters: δ is the direction of the coupler, γ that of the rocker; λ₂ the coupler, λ₃ the rocker."""
    calc = knife()
    phi = np.linspace(0.1, 6.0, 100)[None, :]
    middle = calc.domains["crank_angle"].middle_of(phi)
    delta, gamma = (calc.sample(f"crank_rocker_{n}_direction", phi, middle)[0] for n in ("coupler", "rocker"))
    turn, two, three = phi[0], 5.5, 4.0
    speed3 = np.sin(delta - turn) / (three * np.sin(delta - gamma))
    speed2 = np.sin({"rocker": gamma, "coupler": delta}[angle] - turn) / (two * np.sin(delta - gamma))
    pull = {"coupler": two, "rocker": three}[factor] * speed2**2
    by_source = (three * np.cos(delta - gamma) * speed3**2 - np.cos(delta - turn) - pull) / (
        three * np.sin(delta - gamma)
    )
    step = 1e-5
    ends = [calc.sample("crank_rocker_rocker_speed_ratio", phi + s, middle)[0] for s in (-step, step)]
    slope = (ends[1] - ends[0]) / (2 * step)
    assert bool(np.abs(by_source - slope).max() < 1e-7) is fits


def test_the_edge_meets_the_signature_faster_than_the_rollers_run_only_with_the_planetary_drive() -> None:
    speeds = {
        drive: number(knife(), f"{drive}_contact_velocity") for drive in ("planetary", "crank_slider", "crank_rocker")
    }
    rollers = number(knife(), "roller_velocity")
    assert [drive for drive, speed in speeds.items() if speed > rollers] == ["planetary"]


def above(curve: str, level: float) -> tuple[float, float]:
    """The first and the last angle (°) before the dead centre at which a curve is above a level."""
    before = np.linspace(1e-4, number(press(), "cutting_start_angle"), 40_001)
    high = before[at(press(), curve, 2 * pi - before) > level]
    return degrees(high[-1]), degrees(high[0])


def test_where_both_formulas_pass_the_printed_torque() -> None:
    """As the report says: eq. 14 is above it from 4.02° to 0.27°, the corrected torque from 5.62° to 0.13°."""
    assert above("torque_source", 5100) == pytest.approx((4.02, 0.27), abs=0.006)
    assert above("torque", 5100) == pytest.approx((5.62, 0.13), abs=0.006)


def test_the_printed_torque_leaves_the_cutting_force_next_to_no_arm() -> None:
    rest = 5100 - number(press(), "torque_relaxing")
    assert rest / 500e3 == pytest.approx(0.21e-3, abs=0.005e-3)
    assert 5100 / number(press(), "torque_relaxing") == pytest.approx(1.02, abs=0.005)
    assert eq_14(0) == 0  # just after the dead centre eq. 14 has no say
    assert eq_14(1e-6) == pytest.approx(number(press(), "torque_dead_center"), rel=1e-6)


def test_a_thicker_board_raises_the_peak_against_conclusion_2() -> None:
    thin, thick = press(), press(material_thickness=1)
    assert [round(number(c, "torque_max")) for c in (thin, thick)] == [6409, 6923]
    assert [round(number(c, "torque_max_source")) for c in (thin, thick)] == [5496, 6102]
    assert number(thick, "cutting_work") == pytest.approx(2 * number(thin, "cutting_work"), rel=1e-14)
