"""Dampers that the damper's tests calculate."""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.damper import MECHANISM
from diecut_report.results.mechanism_record import CheckRecord
from tests.machines import advised, inputs, statuses


def calculated(keys: dict[str, Any]) -> Calculation:
    """A damper with just these keys."""
    return calculate(MECHANISM, inputs(MECHANISM, keys))


def checks(calc: Calculation) -> dict[str, CheckRecord]:
    """The checks that are made by their ids."""
    return {name: check for name, check in advised(calc).items() if check.status != "not_checked"}


def passing(calc: Calculation) -> set[str]:
    """The ids of the checks that pass."""
    return {name for name, status in statuses(calc).items() if status == "pass"}


def told(calc: Calculation, check: str) -> str:
    """The message of a check that fails."""
    found = checks(calc)[check]
    assert found.status == "fail"
    return str(found.message)
