"""Load factors of gear pairs: the sheet's numbers, ISO 6336-1 written a second time in mm, µm and N, and what holds without grade, speed or slope."""

from __future__ import annotations

from math import cos, degrees, pi, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from pydantic import ValidationError

from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import varied
from tests.examples import examples, few
from tests.machines import number
from tests.plugins.gears import GRADED, HELICAL, SIZED_BY_GRADE, STEEL, checks, pair

MODULES = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 16, 20, 25, 32, 40, 50)  # ISO 54, series I
K_1 = {3: (2.1, 1.9), 4: (3.9, 3.5), 5: (7.5, 6.7), 6: (14.9, 13.3), 7: (26.8, 23.9), 8: (39.1, 34.8), 9: (52.8, 47.0), 10: (76.6, 68.2),
       11: (102.6, 91.4)}  # fmt: skip
FACTORS = ("dynamic_factor", "face_load_factor", "transverse_load_factor")


def test_the_crank_drive_of_the_sheet() -> None:
    calc = pair(GRADED)
    assert number(calc, "dynamic_factor") == pytest.approx(1.111, abs=5e-4)
    assert number(calc, "mesh_stiffness") == pytest.approx(19.0e9, abs=0.05e9)
    assert number(calc, "manufacture") == pytest.approx(28.5e-6, abs=0.06e-6)
    assert number(calc, "bending") == pytest.approx(5.3e-6)
    assert number(calc, "face_load_factor") == pytest.approx(2.68, abs=0.01)
    assert number(calc, "transverse_load_factor") == pytest.approx(1.17, abs=5e-3)
    assert number(calc, "pitting_safety_1") == pytest.approx(0.924, abs=5e-4)
    assumed = pair({key: value for key, value in GRADED.items() if key != "grade"}, transverse_load_factor=1.1)
    assert number(assumed, "pitting_safety_1") == pytest.approx(1.375, abs=1e-3)


def test_crowned_teeth_of_grade_6_of_the_sheet() -> None:
    """The sheet keeps the dynamic factor of grade 8; with that of grade 6 less load makes the misalignment count more."""
    assert number(pair(GRADED, grade=6, crowned=True, dynamic_factor=1.111), "face_load_factor") == pytest.approx(
        1.54, abs=5e-3
    )
    own = pair(GRADED, grade=6, crowned=True)
    assert number(own, "dynamic_factor") == pytest.approx(1.045, abs=5e-4)
    assert number(own, "face_load_factor") == pytest.approx(1.574, abs=1e-3)
    assert number(own, "crowning_height") == pytest.approx((5.3e-6 + number(own, "manufacture")) / 2)


# --- written a second time -------------------------------------------------------------------------------------------


def run_in(
    deviation: float, flanks: str, limit: float, speed: float, through: float, iron: float, hard: float
) -> float:
    """What running in takes away, µm: limits of 80 and 40 µm of the deviation from 5 and 10 m/s on, of hard flanks always 40 µm."""
    share = {"through_hardened": min(through / limit, 1), "grey_iron": iron, "case_hardened": hard}[flanks]
    if flanks == "case_hardened" or speed > 10:
        return share * min(deviation, 40)
    return share * (deviation if speed <= 5 else min(deviation, 80))


def by_hand(calc: Calculation, keys: dict[str, Any]) -> tuple[float, float, float, float]:
    """K_V, K_Hβ, K_Hα and K_Fα of a pair, with its geometry."""
    alpha, beta, total = (number(calc, name) for name in ("contact_ratio", "overlap_ratio", "contact_ratio_total"))
    d_1, d_2 = (number(calc, f"pitch_diameter_{g}") * 1e3 for g in (1, 2))
    width, grade, module = keys["face_width"], keys["grade"], number(calc, "module") * 1e3
    load = keys["application_factor"] * number(calc, "tangential_force") / width
    speed = keys["speed"] * 2 * pi / 60 * number(calc, "working_diameter_1") / 2
    u, z = keys["teeth_2"] / keys["teeth_1"], keys["teeth_1"]
    x = speed * z / 100 / sqrt(1 + 1 / u**2)
    third = 2.0 if x <= 0.2 else 2.071 - 0.357 * x
    spur, helical = (
        1 + (first / max(load, 100) + second) * x * third
        for first, second in zip(K_1[grade], (0.0193, 0.0087), strict=True)
    )
    k_v = spur + min(beta, 1) * (helical - spur)

    (n_1, n_2), (x_1, x_2) = ([number(calc, f"{name}_{g}") for g in (1, 2)] for name in ("virtual_teeth", "shift"))
    q = (0.04723 + (0.15551 - 0.11654 * x_1) / n_1 + (0.25791 - 0.24188 * x_2) / n_2 + x_1 * (0.00529 * x_1 - 0.00635)
         + x_2 * (0.00182 * x_2 - 0.00193))  # fmt: skip
    rack = (1.6 - keys.get("dedendum", 1.25) / 2) * (0.6 + 0.02 * keys.get("pressure_angle", 20))
    tooth = 0.8 * rack * cos(number(calc, "helix_angle")) / q * min(load / 100, 1) ** 0.25
    stiffness = tooth * (0.75 * alpha + 0.25)

    step = 2 ** (grade / 2 - 2.5)
    helix = [(0.05 * sqrt(d) + 0.35 * sqrt(width) + 4) * step for d in (d_1, d_2)]
    mean, crown = load * k_v, 0.5 if keys.get("crowned") else 1
    f_x = max(
        crown * (1.33 * width * keys["slope"] + sqrt(helix[0] ** 2 + helix[1] ** 2)), 0.005 * mean, max(helix) / 2
    )
    flanks = [(keys.get(f"flanks_{g}", "through_hardened"), keys[f"sigma_h_lim_{g}"], speed) for g in (1, 2)]
    f_y = f_x - sum(run_in(f_x, *each, 320, 0.55, 0.15) for each in flanks) / 2
    r = f_y * 0.85 * stiffness / (2 * mean)
    k_beta = 1 + r if r < 1 else sqrt(4 * r)

    pitch = (0.001 * d_2 + 0.4 * module + 5) * step
    left = pitch - sum(run_in(pitch, *each, 160, 0.275, 0.075) for each in flanks) / 2
    share = 0.4 * stiffness * left / (mean * k_beta)
    k_alpha = total / 2 * (0.9 + share) if total <= 2 else 0.9 + share * sqrt(2 * (total - 1) / total)
    z_epsilon_squared = (4 - alpha) / 3 * (1 - min(beta, 1)) + min(beta, 1) / alpha
    k_h, k_f = (
        max(1, min(k_alpha, limit)) for limit in (total / (alpha * z_epsilon_squared), total / (0.25 * alpha + 0.75))
    )
    return k_v, k_beta, k_h, k_f


@given(
    st.fixed_dictionaries(
        {
            "grade": st.integers(3, 11), "speed": st.floats(1, 2000), "slope": st.floats(0, 2), "torque": st.floats(20, 5000),
            "helix_angle": st.sampled_from([0, 6, 14, 25]), "crowned": st.booleans(), "face_width": st.floats(15, 90), "shift_1": st.floats(0, 0.5),
            "flanks_1": st.sampled_from(["through_hardened", "case_hardened", "grey_iron"]), "sigma_h_lim_1": st.floats(300, 1500),
            "flanks_2": st.sampled_from(["through_hardened", "case_hardened", "grey_iron"]), "sigma_h_lim_2": st.floats(300, 1500),
        }
    )
)  # fmt: skip
@examples(60)
def test_the_factors_are_those_of_a_second_calculation(changes: dict[str, Any]) -> None:
    keys = GRADED | changes
    calc = pair(keys)
    assume("dynamic_factor" in calc.values)  # beyond method C it is asked for, as a test below holds
    found = [number(calc, name) for name in (*FACTORS, "transverse_load_root")]
    assert found == pytest.approx(by_hand(calc, keys), rel=1e-9)


def test_the_second_calculation_has_the_sheets_numbers() -> None:
    assert by_hand(pair(GRADED), GRADED)[:3] == pytest.approx((1.111, 2.68, 1.17), abs=0.01)


def test_each_branch_of_the_second_calculation_is_reached() -> None:
    """Fast and slow teeth, a misalignment that is the least one, and a width that does not carry whole."""
    fast = GRADED | {"speed": 1800, "grade": 11, "helix_angle": 25, "face_width": 80, "slope": 1.5}
    still = GRADED | {"grade": 3, "slope": 0, "crowned": True, "torque": 20000}
    for keys in (fast, still):
        calc = pair(keys)
        assert [number(calc, name) for name in (*FACTORS, "transverse_load_root")] == pytest.approx(
            by_hand(calc, keys), rel=1e-9
        )
    assert number(pair(fast), "pitch_velocity") > 10 and number(pair(fast), "face_load_factor") > 2
    assert number(pair(fast), "contact_ratio_total") > 2
    load = number(pair(still), "mean_line_load") / 1e3
    assert number(pair(still), "misalignment") == pytest.approx(0.005 * load * 1e-6)


# --- what is given, calculated, assumed ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("missing", "assumed"),
    [
        ((), ""),
        (("grade",), " and ".join([", ".join(FACTORS[:2]), FACTORS[2]])),
        (("speed",), "transverse_load_factor"),
        (("slope",), "face_load_factor"),
    ],
)
def test_what_cannot_be_calculated_is_assumed_and_stays_open(missing: tuple[str, ...], assumed: str) -> None:
    calc = pair({key: value for key, value in GRADED.items() if key not in missing})
    check = checks(calc)["k_factors"]
    assert check.status == ("warn" if assumed else "pass")
    assert assumed in check.message
    if missing:
        assert number(calc, "face_load_factor") == 1.3


@pytest.mark.parametrize("key", FACTORS)
def test_a_factor_that_is_given_holds(key: str) -> None:
    calc = pair(GRADED, **{key: 1.23})
    assert number(calc, key) == 1.23
    assert number(calc, "factors_assumed") == 0
    others = [name for name in FACTORS if name != key]
    assert all(number(calc, name) != number(pair(GRADED, **{name: 1.01}), name) for name in others)


def test_the_least_module_is_the_first_with_which_the_calculated_factors_hold() -> None:
    for keys in (SIZED_BY_GRADE, {key: value for key, value in GRADED.items() if key != "module"}):
        trials = [pair(keys, module=module) for module in MODULES]
        held = [
            all(
                number(calc, f"{kind}_safety_{g}") >= least
                for kind, least in (("pitting", 1.0), ("root", 1.4))
                for g in (1, 2)
            )
            for calc in trials
        ]
        assert number(pair(keys), "module") == pytest.approx(MODULES[held.index(True)] * 1e-3)
        assert number(pair(keys), "face_load_factor") == pytest.approx(
            number(trials[held.index(True)], "face_load_factor")
        )


@pytest.mark.parametrize("grade", [2, 12, 7.5, -8, float("nan")])
def test_a_grade_that_the_standard_does_not_have_is_refused(grade: float) -> None:
    with pytest.raises(ValidationError):
        pair(GRADED, grade=grade)


def test_coarse_helical_teeth_rest_on_one_source() -> None:
    coarse = HELICAL | {"grade": 9, "slope": 0.1}
    assert checks(pair(coarse))["grade_confirmed"].status == "warn"
    assert checks(pair(coarse, grade=8))["grade_confirmed"].status == "pass"
    assert checks(pair(GRADED, grade=11))["grade_confirmed"].status == "pass"


def test_method_c_ends_at_a_speed() -> None:
    assert checks(pair(GRADED))["dynamic_range"].status == "pass"
    fast = pair(GRADED, speed=2500)
    assert number(fast, "speed_parameter") > 3 and checks(fast)["dynamic_range"].status == "warn"
    assert number(pair(GRADED, speed=2200), "speed_parameter") == pytest.approx(2.97, abs=0.01)
    assert "dynamic_range" not in checks(
        pair(STEEL | {"module": 4, "teeth_1": 24, "teeth_2": 61, "face_width": 40, "torque": 200})
    )


RATED = ("pitting_1", "pitting_2", "root_1", "root_2")


@pytest.mark.parametrize("speed", few([2500, 6000, 40_000], keep=lambda speed: speed == 6000))
@pytest.mark.nightly
def test_beyond_method_c_the_teeth_are_not_rated_until_the_dynamic_factor_is_given(speed: float) -> None:
    fast = pair(GRADED, speed=speed)
    assert not {*FACTORS, "pitting_safety_1", "root_safety_1"} & fast.values.keys()
    for check in (checks(fast)[name] for name in RATED):
        assert check.status == "not_checked" and "dynamic_factor" in check.message
    known = pair(GRADED, speed=speed, dynamic_factor=1.4)
    assert number(known, "face_load_factor") > 1 and number(known, "transverse_load_factor") >= 1
    assert all(checks(known)[name].status != "not_checked" for name in RATED)


@given(st.floats(1, 1e5), st.integers(3, 11), st.sampled_from([0, 6, 25]), st.floats(1, 5000))
@examples(40)
def test_a_calculated_dynamic_factor_is_never_below_1(speed: float, grade: int, helix: float, torque: float) -> None:
    calc = pair(GRADED, speed=speed, grade=grade, helix_angle=helix, torque=torque)
    assert ("dynamic_factor" in calc.values) == (number(calc, "speed_parameter") <= 3)
    assert "dynamic_factor" not in calc.values or number(calc, "dynamic_factor") >= 1


def test_a_module_is_not_chosen_for_which_the_dynamic_factor_is_unknown() -> None:
    keys = {key: value for key, value in GRADED.items() if key != "module"} | {"torque": 5000, "speed": 3000}
    with pytest.raises(Impossible, match="dynamic_factor"):
        pair(keys)
    assert number(pair(keys, dynamic_factor=1.3), "module") > 0


def test_other_modules_with_which_the_teeth_are_too_fast_have_no_safety() -> None:
    slow = pair(GRADED, speed=1500)
    module = np.array([4e-3, 5e-3, 8e-3, 20e-3])
    found = varied(slow, {"module": module}, ["pitting_safety_1", "root_safety_2"])
    for safeties in found.values():
        assert list(np.isfinite(safeties)) == [True, True, False, False]
    assert np.isnan(varied(slow, {"module": module[2:]}, ["pitting_safety_1"])["pitting_safety_1"]).all()


def test_a_slope_to_either_side_opens_the_teeth_alike() -> None:
    assert number(pair(GRADED, slope=-0.106), "face_load_factor") == number(pair(GRADED), "face_load_factor")
    assert degrees(number(pair(GRADED), "slope")) == pytest.approx(0.106e-3 * 180 / pi)


# --- load cases ------------------------------------------------------------------------------------------------------

ASSUMED: dict[str, Any] = {key: value for key, value in GRADED.items() if key != "grade"} | {
    "transverse_load_factor": 1.1
}


def engaged(torque: float, cycles: float, keys: dict[str, Any] = ASSUMED) -> Calculation:
    """A pair whose clutch engages with a torque on the wheel."""
    return pair(keys, load_cases=[{"name": "engage", "torque": torque / 2, "cycles": cycles}])


def test_an_engagement_that_is_frequent_pits_as_the_sheet_says() -> None:
    assert number(engaged(752.3, 1.2e6), "pitting_safety_1") == pytest.approx(1.123, abs=5e-4)
    with_curve = engaged(752.3, 1.2e6, GRADED)
    torque = number(with_curve, "torque_peak")
    assert torque == pytest.approx(752.3 / 2)
    scaled = pair(GRADED | {"torque": 752.3, "slope": 0.106 * 752.3 / 501.53})  # the shafts bend as much more
    for name in (*FACTORS, "pitting_safety_1", "root_safety_2"):
        assert number(with_curve, name) == pytest.approx(number(scaled, name)), name


def test_one_that_is_rare_counts_for_the_root_alone() -> None:
    run, rare = pair(ASSUMED), engaged(752.3, 1e5)
    assert number(rare, "pitting_safety_1") == number(run, "pitting_safety_1")
    assert number(rare, "root_safety_1") == pytest.approx(number(run, "root_safety_1") * 501.53 / 752.3)
    assert (rare["pitting_case"][0, 0], rare["root_case"][0, 0]) == ("run", "engagement of the clutch")


def test_a_load_case_below_the_run_changes_nothing() -> None:
    for name in ("pitting_safety_1", "root_safety_1", "torque_root"):
        assert number(engaged(300, 1e7), name) == number(pair(ASSUMED), name)


def test_a_check_that_fails_names_the_load_case() -> None:
    found = checks(engaged(2000, 1.2e6))
    assert "governing load case: engagement of the clutch" in found["pitting_1"].message


@pytest.mark.parametrize("change", [{"cycles": -1}, {"torque": -5}, {"name": "brake"}, {"cycles": None}])
def test_a_load_case_that_is_none_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        pair(ASSUMED, load_cases=[{"name": "engage", "torque": 300, "cycles": 1e6} | change])
