"""Formulas of the motor, the flywheel and the run-up."""

from __future__ import annotations

from typing import Any

from diecut_report.api import formula


@formula
def inertia(energy: Any, speed_fluctuation: Any, speed: Any) -> Any:
    """Moment of inertia that keeps the fluctuation of the speed."""
    return energy / (speed_fluctuation * speed**2)


@formula
def inertia_before(own: Any, behind: Any, ratio: Any, efficiency: Any) -> Any:
    """Inertia that a shaft feels: its own, and what turns slower behind a ratio, with the losses between."""
    return own + behind / (ratio**2 * efficiency)
