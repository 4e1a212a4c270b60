"""Formulas of the motor, the flywheel and the run-up."""

from __future__ import annotations

from typing import Any

from diecut_report.api import as_number, formula


@formula
def inertia_before(own: Any, behind: Any, ratio: Any, efficiency: Any) -> Any:
    """Inertia that a shaft feels: its own, and what turns slower behind a ratio, with the losses between."""
    return own + behind / (ratio**2 * efficiency)


@formula
def run_up_time(run_up_inertia: Any, shaft_1_speed: Any, accelerating_torque: Any) -> Any:
    """Time in which a torque brings an inertia to its speed."""
    return run_up_inertia * as_number(shaft_1_speed) / accelerating_torque
