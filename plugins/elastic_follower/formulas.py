"""Formulas of the elastic drive: times, the motion of the input, ratios of peaks."""

from __future__ import annotations

from typing import Any

from diecut_report.api import formula


@formula
def law_acceleration(rise: Any, rise_duration: Any, acceleration: Any) -> Any:
    """Acceleration of a rise by a law, of the law's acceleration."""
    return rise / rise_duration**2 * acceleration
