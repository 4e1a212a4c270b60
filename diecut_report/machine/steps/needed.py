"""Which steps quantities need, and what coming steps will ask of the curves over an abscissa."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache, partial
from itertools import chain, takewhile
from typing import NamedTuple

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.numerics import extremes
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import SilentStep, Step, named

# What coming steps will ask of the curves over an abscissa: it is computed together, as it shares most of its terms.


def look(calc: Calculation, first: Step, steps: Sequence[Step]) -> None:
    """Note, before the first of these steps, the curves that it and the coming ones ask for, and search their extremes together."""
    axis = calc.axis[first.asked_curve]
    if first.asked_curve not in calc.ahead.get(axis, ()) or first.is_counted:
        coming = (step.asked_curve for step in _computable(calc, steps, axis))
        calc.ahead[axis] = tuple(dict.fromkeys(filter(None, coming)))
    if first.signs:
        _search(calc, first, steps, axis)


def _search(calc: Calculation, first: Step, steps: Sequence[Step], axis: str) -> None:
    """Search the extremes of the coming reductions, up to where the abscissa is cut further: one search costs hardly less than many."""
    edges = calc.domains[axis].edges
    if all(calc.extremes.get((first.asked_curve, sign), (None,))[0] is edges for sign in first.signs):
        return
    uncut = takewhile(lambda step: not step.cuts(axis, calc.axis), _computable(calc, steps, axis))
    extremes.search(calc, [(step.asked_curve, sign) for step in uncut for sign in step.signs])


def _computable(calc: Calculation, steps: Sequence[Step], axis: str) -> Iterator[Step]:
    """The coming steps that cut an abscissa, and those that ask for curves over it which need nothing that is not known yet.

    Among variants, numbers that are known already by their formulas are computed at once.
    """
    known = {axis, *calc.inputs, *calc.values, *calc.curves, *(f"inputs.{name}" for name in calc.inputs)}
    for step in steps:
        if step.cuts(axis, calc.axis):
            yield step
        elif step.is_formula and calc.axis.get(step.id) == axis and taken(step) <= known:
            known.add(step.id)
            calc.curves[step.id] = step
        elif step.asked_curve in known and calc.axis[step.asked_curve] == axis:
            yield step
        elif step.id not in calc.values and not _known_early(calc, step, known):
            known.discard(step.id)  # where an input has the same id, it is not what is meant from here on


def _known_early(calc: Calculation, step: Step, known: set[str]) -> bool:
    formula = getattr(step, "formula", None)
    is_early = calc.count > 1 and step.id not in calc.axis and not step.numbered and taken(step) <= known
    if formula is None or not is_early:
        return False
    calc.values[step.id] = calc.existing(step, calc.apply(formula))
    known.add(step.id)
    return True


# Which steps of a mechanism quantities need.


def needed(mechanism: Mechanism, given: frozenset[str], names: Iterable[str]) -> set[str]:
    """Return the ids of the steps that quantities need, and of what must hold for them."""
    known = _asking(mechanism, given)
    found = _reached(known, (giver_of(name, known.own) for name in names))
    return found | {id for id, asked in known.silent if asked <= found}


def _reached(known: _Asking, givers: Iterable[str], made: Container[str] = ()) -> set[str]:
    """The steps that others need, up to those that are made already."""
    found: set[str] = set()
    pending = [*givers]
    while pending:
        giver = pending.pop()
        if giver and giver not in found and giver not in made:
            found.add(giver)
            pending += known.asks[giver]
    return found


@lru_cache(maxsize=1024)
def needed_again(
    mechanism: Mechanism, given: frozenset[str], names: tuple[str, ...], changed: frozenset[str], numbers: frozenset[str]
) -> tuple[frozenset[str], frozenset[str]]:  # fmt: skip
    """Return what is ``needed`` where some inputs have changed, and which of the ``numbers`` that are known already stay as they are."""
    known = _asking(mechanism, given)
    moved = {
        id for id, step in known.own.items() if any(name.removeprefix("inputs.") in changed for name in _asked(step))
    }
    while more := {id for id, asked in known.asks.items() if id not in moved and not asked.isdisjoint(moved)}:
        moved |= more
    givers = {name: giver_of(name, known.own) for name in numbers}
    # a part of a row has a name of its own, and a count of crossings cuts an abscissa
    stays = {
        name: id for name, id in givers.items() if id in numbers and id not in moved and not known.own[id].is_counted
    }
    whole = _reached(known, (giver_of(name, known.own) for name in names))
    silent = {id: asked for id, asked in known.silent if asked <= whole and id in moved}
    found = _reached(
        known, [*(giver_of(name, known.own) for name in names), *chain(*silent.values())], set(stays.values())
    )
    return frozenset(found | silent.keys()), frozenset(stays)


class _Asking(NamedTuple):
    """Hold the steps of a mechanism by id, which steps each asks for, and those that give nothing, with what they ask for."""

    own: Mapping[str, Step]
    asks: Mapping[str, frozenset[str]]
    silent: Sequence[tuple[str, frozenset[str]]]


@lru_cache(maxsize=256)
def _asking(mechanism: Mechanism, given: frozenset[str]) -> _Asking:
    steps = [step for _, step in mechanism.active(given)]
    own = {step.id: step for step in steps}
    giver = cache(partial(giver_of, own=own))

    def givers(names: Iterable[str]) -> frozenset[str]:
        return frozenset(filter(None, map(giver, names)))

    cutting: dict[str, list[str]] = {}
    for step in steps:
        cutting.setdefault(getattr(step, "abscissa", ""), []).append(step.id)
    asks = {}
    for id, step in own.items():
        asked = _asked(step) - {getattr(step, "shown_at", "")}  # where formulas are shown matters in print only
        asks[id] = givers([*asked, *cutting.get(id, ())])
    return _Asking(own, asks, [(step.id, givers(_asked(step))) for step in steps if isinstance(step, SilentStep)])


def _asked(step: Step) -> frozenset[str]:
    return taken(step).union(getattr(step, "holds", ()))


def giver_of(name: str, own: Mapping[str, Step]) -> str:
    """Return the id of the step of this id, or that gives this name; nothing where none does."""
    if name in own:
        return name
    if found := named(name, own):
        return found.id
    rows = (id for id, step in own.items() if step.named_by and name.endswith(f"_{id}"))
    return max(rows, key=len, default="")
