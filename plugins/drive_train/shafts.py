"""Formulas of ratios, speeds, torques and powers along the shafts."""

from __future__ import annotations

from typing import Any

from diecut_report.api import formula


@formula
def mean_torque(driving_mean: Any, braking_mean: Any, ratio: Any, efficiency: Any) -> Any:
    """Mean torque of a shaft from the driving and the braking part at the output, with the losses between."""
    return driving_mean / (ratio * efficiency) - braking_mean * efficiency / ratio
