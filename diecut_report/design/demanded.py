"""Which inputs are what a machine must do: those that a check holds against what is calculated, and from which nothing else follows."""

from __future__ import annotations

from functools import cache

from diecut_report.contract.checks import Check
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Require


@cache
def demanded(mechanism: Mechanism) -> frozenset[str]:
    """Return the inputs that are themselves a side of a check, whichever, and that no other check follows from.

    A size of a part that is held against a bound, such as a width, is not one: other checks follow from it.
    """
    own = {side for check in mechanism.checks for side in _sides(check)}
    given = own - {step.id for _, step in mechanism.steps}
    return frozenset(name for name in given if _is_demanded(mechanism, name))


def _is_demanded(mechanism: Mechanism, name: str) -> bool:
    reached = _reached(mechanism, name)
    return all(name in _sides(check) for check in mechanism.checks if reached & _sides(check))


def _sides(check: Check) -> set[str]:
    return {side for side in (check.demand, check.limit, check.at_least) if isinstance(side, str)}


def _reached(mechanism: Mechanism, name: str) -> set[str]:
    """An input with all that is calculated from it; what only must hold gives nothing."""
    found = {name}
    for _, step in mechanism.steps:
        if not isinstance(step, Require) and found & taken(step):
            found.add(step.id)
    return found
