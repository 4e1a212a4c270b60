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
from diecut_report.plugins.cam_gear_transport.advice import smaller_roller
from tests.examples import few
from tests.machines import number
from tests.plugins.steppers import CAMS, CONVEYOR, LOADED, checks, stepper

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
SWEEPS = [
    (law, sweep, share)
    for law in ("cycloidal", "harmonic", "modified_sine")
    for sweep, share in ((20, 0.9), (2, 0.15), (5, 0.5), (0.5, 0.05), (20, 0.3), (40, 0.8))
]


@pytest.mark.parametrize("changes", few(MACHINES, keep=lambda changes: MACHINES.index(changes) in (1, 3, 6, 8, 10, 11)))
def test_the_named_arms_pass_all_checks_of_the_cams(changes: dict[str, Any]) -> None:
    machine = CAMS | changes
    failing = [
        check
        for check in checks(stepper(**machine)).values()
        if check["status"] == "fail" and check["id"] in CAM_CHECKS
    ]
    assert failing
    for check in failing:
        advised = told(check["message"])
        assert advised
        again = checks(stepper(**machine | advised))
        assert {again[name]["status"] for name in CAM_CHECKS} == {"pass"}, advised


@pytest.mark.parametrize("law", few(LAWS, keep=lambda law: law in ("modified_trapezoidal", "parabolic")))
def test_arms_are_named_for_each_law(law: str) -> None:
    machine = CAMS | {"motion_law": law, "max_pressure_angle": "42 deg", "arm_angle_1": "85 deg"}
    advised = told(checks(stepper(**machine))["pressure_angle"]["message"])
    again = checks(stepper(**machine | advised))
    assert {again[name]["status"] for name in CAM_CHECKS} == {"pass"}


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
    message = checks(stepper(**machine))["pressure_angle"]["message"]
    assert "no arms pass with this dwell and these sweeps" in message
    for length in (10, 40, 80, 120):
        for one in range(15, 110, 16):
            tried = stepper(**machine | {"arm_length": length, "roller_radius": 5, "arm_angle_1": one})
            assert np.degrees(number(tried, "cam_1_pressure_angle_max")) > 38


def test_without_a_return_the_arms_wait_for_it() -> None:
    assert (
        "leave the return its time first" in checks(stepper(**CAMS, dwell_angle="212 deg"))["pressure_angle"]["message"]
    )


def test_arms_across_the_line_are_told_where_they_may_stand() -> None:
    with pytest.raises(Impossible) as refused:
        stepper(**CAMS | {"arm_angle_1": "120 deg"})
    best = re.search(r"take ([\d.]+)° and ([\d.]+)°", refused.value.message)
    assert best is not None
    arms = {"arm_angle_1": float(best[1]), "arm_angle_2": float(best[2])}
    assert checks(stepper(**CAMS | arms))["pressure_angle"]["status"] == "pass"


def test_a_smaller_roller_as_told_neither_undercuts_nor_crosses() -> None:
    big = CAMS | {"roller_radius": "160 mm"}
    message = checks(stepper(**big))["curvature"]["message"]
    roller = re.search(r"roller_radius of at most ([\d.]+) mm", message)
    assert roller is not None
    again = checks(stepper(**big | {"roller_radius": float(roller[1])}))
    assert (again["curvature"]["status"], again["profile_turns"]["status"]) == ("pass", "pass")
    assert smaller_roller(0.05, -0.01) == "no roller passes with these arms"
    assert smaller_roller(0.05, 0.04) == "take a roller_radius of at most 39.99 mm"


def passes(machine: dict[str, Any]) -> bool:
    """Whether a machine keeps the sheet's acceleration and leaves the return its time."""
    try:
        found = checks(stepper(**machine))
    except Impossible:
        return False
    return {found[name]["status"] for name in ("sheet_acceleration", "return_time")} == {"pass"}


@pytest.mark.parametrize("law, sweep, share", few(SWEEPS, keep=lambda one: SWEEPS.index(one) % 5 == 0))
def test_the_named_sweeps_and_cycles_keep_the_sheets_acceleration(law: str, sweep: float, share: float) -> None:
    machine: dict[str, Any] = CONVEYOR | {
        "motion_law": law,
        "sector_stop_sweep": sweep,
        "dwell_angle": 120,
        "n_points": 36,
    }
    machine["allowable_sheet_acceleration"] = round(share * number(stepper(**machine), "sheet_acceleration_max"), 1)
    check = checks(stepper(**machine))["sheet_acceleration"]
    assert check["status"] == "fail"
    bounds = re.search(r"sector_stop_sweep from ([\d.]+)° to ([\d.]+)°", check["message"])
    cycles = re.search(r"cycles_per_hour of at most ([\d.]+)", check["message"])
    assert cycles is not None
    ways: list[dict[str, float]] = [{"cycles_per_hour": float(cycles[1])}]
    if bounds:
        ways += [{"sector_stop_sweep": float(bound)} for bound in bounds.groups()]
        for angle in (0.98 * float(bounds[1]), 1.02 * float(bounds[2])):
            assert not passes(machine | {"sector_stop_sweep": angle})
    else:
        for angle in np.geomspace(0.5, 60, 13):
            assert not passes(machine | {"sector_stop_sweep": angle})
    for way in ways:
        assert passes(machine | way), way


def test_the_named_width_and_cycles_keep_the_contact_pressure() -> None:
    machine = LOADED | {"allowable_contact_pressure": 700, "n_points": 36}
    message = checks(stepper(**machine))["contact_pressure"]["message"]
    width, cycles = (
        re.search(rf"{key} of at least ([\d.]+)|{key} of at most ([\d.]+)", message)
        for key in ("roller_width", "cycles_per_hour")
    )
    assert width is not None and cycles is not None
    for way in ({"roller_width": float(width[1])}, {"cycles_per_hour": float(cycles[2])}):
        assert checks(stepper(**machine | way))["contact_pressure"]["status"] == "pass"


@pytest.mark.parametrize("dwell", [218, 230, 260])
@pytest.mark.parametrize("module", [{}, {"module": "5 mm"}, {"module": "8 mm"}])
def test_a_dwell_without_a_return_is_refused_with_one_that_leaves_it_its_time(
    dwell: float, module: dict[str, Any]
) -> None:
    with pytest.raises(Impossible) as refused:
        stepper(dwell_angle=dwell, **module)
    message = refused.value.message
    assert message.count("with these teeth") == (1 if module else 0)
    (angle,) = re.findall(r"dwell_angle of at most ([\d.]+)°", message)
    assert checks(stepper(dwell_angle=float(angle), **module))["return_time"]["status"] == "pass"
