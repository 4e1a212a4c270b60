"""Platen presses that the tests calculate."""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.platen_press import MECHANISM
from diecut_report.plugins.platen_press.steps import JOINTS
from tests.machines import inputs

GUIDED: dict[str, Any] = {"guide_length": "400 mm", "offset_force": "5 mm", "offset_weight": "20 mm"}
FRICTIONS: dict[str, Any] = {"friction": [0.15, 0.12, 0.08, 0.1]}


def platen(**changes: Any) -> Calculation:
    """The machine of 001 with changes; a list of frictions stands for the single ones."""
    if isinstance(changes.get("friction"), list):
        changes |= dict(zip(JOINTS, changes.pop("friction"), strict=True))
    return calculate(MECHANISM, inputs(MECHANISM, changes))
