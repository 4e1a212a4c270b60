"""Dampers that the damper's tests calculate."""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.damper import MECHANISM
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import CheckRecord
from tests.machines import inputs


def calculated(keys: dict[str, Any]) -> Calculation:
    """A damper with just these keys."""
    return calculate(MECHANISM, inputs(MECHANISM, keys))


def checks(calc: Calculation) -> dict[str, CheckRecord]:
    """The checks that are made by their ids."""
    found = {check.id: check for check in mechanism_results(calc, {}).checks}
    return {name: check for name, check in found.items() if check.status != "not_checked"}


def passing(calc: Calculation) -> set[str]:
    """The ids of the checks that pass."""
    return {name for name, check in checks(calc).items() if check.status == "pass"}


def told(calc: Calculation, check: str) -> str:
    """The message of a check that fails."""
    found = checks(calc)[check]
    assert found.status == "fail"
    return str(found.message)
