"""Gear pairs beside their printed numbers: what a source prints in another form, or from an angle that it found coarsely."""

from __future__ import annotations

from math import radians

import pytest

from diecut_report.plugins.gear_pair import formulas as f
from tests.validation.rows_gear_pair import found

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
