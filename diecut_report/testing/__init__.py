"""What an author of a plugin tests it with.

``check_mechanism(MECHANISM)`` judges what is declared, ``check_contract(MECHANISM, {…})`` a machine of it too.
``calculate(MECHANISM, {"teeth": 30})`` gives the numbers of one machine, ``compare(calculated, {"force": "189 N"})`` holds them
against printed ones. ``load("hook", "my_plugins")`` finds a mechanism.
"""

from __future__ import annotations

from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.testing.contract import ContractTest, check_contract
from diecut_report.testing.machines import Refused, calculate, load
from diecut_report.testing.values import (
    ComparedValue,
    ComparedValues,
    CurveFound,
    MechanismFound,
    NotGiven,
    PrintedValue,
    QuantityFound,
    compare,
)

__all__ = [
    "ComparedValue", "ComparedValues", "ContractTest", "CurveFound", "MechanismFound", "NotGiven", "PrintedValue", "QuantityFound", "Refused",
    "calculate", "check_contract", "check_mechanism", "compare", "load",
]  # fmt: skip
