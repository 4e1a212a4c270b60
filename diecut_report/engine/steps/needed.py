"""Which steps of a mechanism quantities need."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache, lru_cache, partial
from typing import NamedTuple

from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.result_names import named
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import SILENT, Abscissa, Breakpoints, Prepared, Step


def needed(mechanism: Mechanism, given: frozenset[str], names: Iterable[str]) -> set[str]:
    """Return the ids of the steps that quantities need, and of what must hold for them."""
    known = _asking(mechanism, given)
    found: set[str] = set()
    pending = [_giver(name, known.own) for name in names]
    while pending:
        giver = pending.pop()
        if giver and giver not in found:
            found.add(giver)
            pending += known.asks[giver]
    return found | {id for id, asked in known.silent if asked <= found}


class _Asking(NamedTuple):
    """Hold the steps of a mechanism by id, which steps each asks for, and those that give nothing, with what they ask for."""

    own: Mapping[str, Step]
    asks: Mapping[str, frozenset[str]]
    silent: Sequence[tuple[str, frozenset[str]]]


@lru_cache(maxsize=256)
def _asking(mechanism: Mechanism, given: frozenset[str]) -> _Asking:
    steps = [step for _, step in mechanism.active(given)]
    own = {step.id: step for step in steps}
    giver = cache(partial(_giver, own=own))

    def givers(names: Iterable[str]) -> frozenset[str]:
        return frozenset(filter(None, map(giver, names)))

    asks = {}
    for id, step in own.items():
        asked = _asked(step) - {getattr(step, "shown_at", "")}  # where formulas are shown matters in print only
        asks[id] = givers([*asked, *_of_abscissa(steps, step)])
    silent = [(s.id, givers(_asked(s))) for s in steps if isinstance(s, SILENT) and not isinstance(s, Breakpoints)]
    return _Asking(own, asks, silent)


def _asked(step: Step) -> frozenset[str]:
    """Return the ids that a step takes, with those that plain code takes where they are there."""
    return taken(step) | frozenset(step.holds) if isinstance(step, Prepared) else taken(step)


def _of_abscissa(steps: Sequence[Step], step: Step) -> list[str]:
    """What cuts an abscissa into its pieces."""
    if not isinstance(step, Abscissa):
        return []
    return [s.id for s in steps if getattr(s, "abscissa", "") == step.id]


def _giver(name: str, own: Mapping[str, Step]) -> str:
    """Return the id of the step of this id, or that gives this name; nothing where none does."""
    if name in own:
        return name
    found = named(name, own)
    return found.id if found else _of_named_part(name, own)


def _of_named_part(name: str, own: Mapping[str, Step]) -> str:
    """Return the id of the row that gives a part by the part's own name, ``NAME_ID``; nothing where none does."""
    rows = (id for id, step in own.items() if getattr(step, "named_by", "") and name.endswith(f"_{id}"))
    return max(rows, key=len, default="")
