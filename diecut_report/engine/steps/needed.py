"""Which steps of a mechanism quantities need."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.result_names import named
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import SILENT, Abscissa, Breakpoints, Prepared, Step


def needed(mechanism: Mechanism, given: frozenset[str], names: Sequence[str]) -> set[str]:
    """Return the ids of the steps that quantities need, and of what must hold for them."""
    steps = [step for _, step in mechanism.active(given)]
    own = {step.id: step for step in steps}
    found: set[str] = set()
    pending = list(names)
    while pending:
        name = pending.pop()
        step = _giver(name, own)
        if step is None or step.id in found:
            continue
        found.add(step.id)
        pending += _asked(step) - {getattr(step, "shown_at", "")}  # where formulas are shown matters in print only
        pending += _of_abscissa(steps, step)
    return found | {
        s.id for s in steps if isinstance(s, SILENT) and not isinstance(s, Breakpoints) and _known(s, own, found)
    }


def _asked(step: Step) -> frozenset[str]:
    """Return the ids that a step takes, with those that plain code takes where they are there."""
    return taken(step) | frozenset(step.holds) if isinstance(step, Prepared) else taken(step)


def _of_abscissa(steps: Sequence[Step], step: Step) -> list[str]:
    """What cuts an abscissa into its pieces."""
    if not isinstance(step, Abscissa):
        return []
    return [s.id for s in steps if getattr(s, "abscissa", "") == step.id]


def _giver(name: str, own: Mapping[str, Step]) -> Step | None:
    """Return the step of this id, or that gives this name."""
    found = None if name in own else named(name, own)
    return own[found.id] if found else own.get(name)


def _known(step: Step, own: Mapping[str, Step], found: set[str]) -> bool:
    givers = [_giver(name, own) for name in _asked(step)]
    return all(giver is None or giver.id in found for giver in givers)
