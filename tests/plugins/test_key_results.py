"""A designer who reads a key result can set a limit to it: each is judged by a check, or it is said here why it is not."""

from __future__ import annotations

import pytest

from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Choice
from diecut_report.quantities.units import unit
from tests.plugins.cases import OF_KINDS

LIMITED = ("N", "N*m", "MPa", "m/s", "m/s**2", "K", "rad/s**2", "W")
"""Units of what a machine must be limited in: forces, torques, pressures, speeds, accelerations, temperatures, powers."""

ENERGIES = ("J", "kJ")  # of the kind of torques

WITHOUT = {
    "cam_gear_transport": {
        "sheet_velocity_max": "the sheet bears the acceleration or does not, at whatever speed",
        "gear_acceleration_peak": "judged as acceleration of the sheet, to which it is in proportion",
    },
    "circular_knife": {
        "cut_speed_max": "no limit of the cut is known that depends on it; the board's rate follows from the press"
    },
    "clutch": {
        "pressing_force": "judged as pressure of the lining",
        "release_force": "judged by whether the clutch releases by itself",
    },
    "cyclogram": dict.fromkeys(
        ("torque_mean", "torque_peak", "torque_rms", "power_peak"),
        "a demand on flywheel and motor, judged in the drive train and by the consistency of the press",
    ),
    "cylinder_drive": {
        "velocity_max": "follows from stroke and rate; the acceleration is judged",
        "cutting_moment": "a load, judged within the torque at the crank",
        "crank_torque_mean": "a demand on the motor, judged in the drive train",
        "crank_torque_rms": "a demand on the motor, judged in the drive train",
        "power_mean": "a demand on the motor, judged in the drive train",
        "power_peak": "a demand on the motor, judged in the drive train",
    },
    "damper": {"rebound_velocity": "what is left of the energy is taken up by the drive"},
    "drive_train": {},
    "elastic_follower": {
        "acceleration_peak": "judged as its ratio to the rigid one",
        "acceleration_rigid": "what the ratio is taken to",
    },
    "gear_pair": {"tangential_force": "judged as stress of flank and root"},
    "geneva_transport": {
        "sheet_velocity_max": "the sheet bears the acceleration or does not, at whatever speed",
        "roller_force_peak": "judged as pressure of the roller",
    },
    "knife_drive": {
        "roller_velocity": "follows from the rollers' diameter and rate; the grip's acceleration is judged"
    },
    "parallel_key": {"key_force": "judged as pressure and shear"},
    "platen_press": {
        "velocity_at_contact": "the cut bears any speed of a platen; its force is a load",
        "torque_max_source": "the greatest torque by the formula of the source, beside this one",
        "torque_dead_center": "judged within the greatest torque",
        "inertia_force_max": "judged where it matters, at the dead centre",
        "power_mean": "a demand on the motor",
    },
    "roller_chain": {
        "tension_peak": "judged as safety against breaking and as pressure of the joints",
        "velocity": "follows from teeth and speed; the pressure that a maker allows falls with it",
    },
    "shaft": {
        "bending_moment_max": "judged as stress, with the notches",
        "reaction_a_max": "a load of the bearing",
        "reaction_b_max": "a load of the bearing",
    },
}


def needing(mechanism: Mechanism) -> set[str]:
    """The key results in units of what a machine must be limited in."""
    steps = [step for _, step in mechanism.steps if hasattr(step, "unit")]
    texts = {step.id for step in steps if isinstance(step, Choice) and isinstance(step.cases[0].value, str)}
    declared = {step.id: step.unit for step in steps if step.unit not in ENERGIES and step.id not in texts}
    kinds = {unit(each).kind for each in LIMITED}
    return {name for name in mechanism.key_results if name in declared and unit(declared[name]).kind in kinds}


@pytest.mark.parametrize("kind", OF_KINDS)
def test_each_key_result_that_must_be_limited_has_a_check_or_a_reason(kind: str) -> None:
    mechanism = OF_KINDS[kind]
    judged = {name for check in mechanism.checks for name in check.named}
    assert needing(mechanism) - judged == set(WITHOUT.get(kind, {}))


@pytest.mark.parametrize("kind", OF_KINDS)
def test_each_check_has_a_class_and_self_tests_are_balances_alone(kind: str) -> None:
    classes = {check.id: check.check_class for check in OF_KINDS[kind].checks}
    assert set(classes.values()) <= {"function", "strength", "practice", "numerical"}
    own = {name for name, found in classes.items() if found == "numerical"}
    assert own <= {"energy_balance", "power_balance", "gear_turn", "energy", "critical_bounds", "mean_bounds"}
