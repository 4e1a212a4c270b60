"""What the stepper's messages advise is put in as printed: the check then passes.

CI tries a machine of each way in which arms, sweeps or laws fail; the others, whose messages are made by the same code from
other numbers, are tried at night.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from diecut_report.machine.calculation import Impossible
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.plugins.cam_gear_transport import arms
from tests.examples import few
from tests.machines import number
from tests.plugins.steppers import CAMS, checks, stepper

NAMED = r"an? (arm_length|arm_angle_[12]|sector_dwell_sweep|sector_stop_sweep) of (-?[\d.]+)( mm|°)"
CAM_CHECKS = ("pressure_angle", "curvature", "profile_turns", "return_time")


def told(message: str) -> dict[str, float]:
    """Arms and sweeps that a message names."""
    return {key: float(value) for key, value, _ in re.findall(NAMED, message)}


MACHINES: list[dict[str, Any]] = [
     {"motion_law": "harmonic"}, {"motion_law": "harmonic", "arm_angle_2": "236 deg"}, {"dwell_angle": "194.3 deg"},
     {"dwell_angle": "194.3 deg", "arm_length": "5 mm", "roller_radius": "3 mm"}, {"max_pressure_angle": "44 deg"},
     {"max_pressure_angle": "30 deg"}, {"max_pressure_angle": "30 deg", "module": "2.5 mm"}, {"max_pressure_angle": "41 deg"},
     {"arm_angle_1": "40 deg", "arm_angle_2": "-150 deg"}, {"arm_angle_1": "250 deg", "arm_angle_2": "40 deg"},
     {"roller_radius": "100 mm", "arm_length": "140 mm"}, {"arm_length": "240 mm", "dwell_angle": "185 deg"},
]  # fmt: skip


@pytest.mark.parametrize("changes", few(MACHINES, keep=lambda changes: MACHINES.index(changes) in (1, 3, 6, 8, 10, 11)))
def test_the_named_arms_pass_all_checks_of_the_cams(changes: dict[str, Any]) -> None:
    machine = CAMS | changes
    failing = [
        check for check in checks(stepper(**machine)).values() if check.status == "fail" and check.id in CAM_CHECKS
    ]
    assert failing
    for check in failing:
        advised = told(check.message)
        assert advised
        again = checks(stepper(**machine | advised))
        assert {again[name].status for name in CAM_CHECKS} == {"pass"}, advised


@pytest.mark.parametrize("law", few(LAWS, keep=lambda law: law in ("modified_trapezoidal", "parabolic")))
def test_arms_are_named_for_each_law(law: str) -> None:
    machine = CAMS | {"motion_law": law, "max_pressure_angle": "42 deg", "arm_angle_1": "85 deg"}
    advised = told(checks(stepper(**machine))["pressure_angle"].message)
    again = checks(stepper(**machine | advised))
    assert {again[name].status for name in CAM_CHECKS} == {"pass"}


@pytest.mark.parametrize(
    "changes", [{"arm_length": "9000 mm"}, {"max_pressure_angle": "30 deg"}, {"motion_law": "harmonic"}]
)
def test_a_search_that_is_spared_would_have_found_nothing(
    changes: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = stepper(**CAMS | changes | {"n_points": 36})
    rocker = [number(machine, name) for name in arms.TAKES]
    found = arms.arms_that_fit.__wrapped__(*rocker)
    monkeypatch.setattr(arms, "FACTORS", arms.FACTORS[::6])
    thin = arms.arms_that_fit.__wrapped__(*rocker)
    monkeypatch.setattr(arms, "_ends_allow", lambda *_: True)
    assert arms.arms_that_fit.__wrapped__(*rocker) == thin and found


def test_arms_that_are_far_too_long_are_judged_without_a_search(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = stepper(**CAMS | {"arm_length": "9000 mm", "n_points": 36})
    rocker = [number(machine, name) for name in arms.TAKES]
    tried: list[float] = []
    searched = arms.pressure_angles
    monkeypatch.setattr(arms, "pressure_angles", lambda *of: tried.append(of[2]) or searched(*of))
    assert arms.arms_that_fit.__wrapped__(*rocker) == "no arms pass with this dwell; take a shorter dwell_angle"
    assert len(tried) <= 400  # the arm as it is, for each length and each sweep; 7200 with the search


def test_where_narrower_sweeps_are_advised_no_arms_pass_as_the_sweeps_are() -> None:
    machine = CAMS | {"max_pressure_angle": "38 deg", "n_points": 36}
    message = checks(stepper(**machine))["pressure_angle"].message
    assert "no arms pass with this dwell and these sweeps" in message
    for length in (10, 40, 80, 120):
        for one in range(15, 110, 16):
            tried = stepper(**machine | {"arm_length": length, "roller_radius": 5, "arm_angle_1": one})
            assert np.degrees(number(tried, "cam_1_pressure_angle_max")) > 38


def test_without_a_return_the_arms_wait_for_it() -> None:
    assert "leave the return its time first" in checks(stepper(**CAMS, dwell_angle="212 deg"))["pressure_angle"].message


def test_arms_across_the_line_are_told_where_they_may_stand() -> None:
    with pytest.raises(Impossible) as refused:
        stepper(**CAMS | {"arm_angle_1": "120 deg"})
    best = re.search(r"take ([\d.]+)° and ([\d.]+)°", refused.value.message)
    assert best is not None
    arms = {"arm_angle_1": float(best[1]), "arm_angle_2": float(best[2])}
    assert checks(stepper(**CAMS | arms))["pressure_angle"].status == "pass"
