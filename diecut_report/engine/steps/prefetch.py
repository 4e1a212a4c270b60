"""What coming steps will ask of the curves over an abscissa: it is computed together, as it shares most of its terms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import takewhile

from diecut_report.contract.part_steps import Interpolated
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Accumulated, Choice, Crossings, Derivative, Reduction, Step, Value
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.numerics import extrema

Asking = Reduction | Crossings | Accumulated | Derivative
SIGNS = {"max": (1.0,), "min": (-1.0,), "abs_max": (1.0, -1.0), "range": (1.0, -1.0)}


def look(calc: Calculation, first: Asking, steps: Sequence[Step]) -> None:
    """Note, before the first of these steps, the curves that it and the coming ones ask for, and search their extremes together."""
    axis = calc.axis[first.of]
    if first.of not in calc.ahead.get(axis, ()) or isinstance(first, Crossings):
        coming = [step for step in _computable(calc, steps, axis) if isinstance(step, Asking)]
        calc.ahead[axis] = tuple(dict.fromkeys(step.of for step in coming))
    if isinstance(first, Reduction) and first.operation in SIGNS:
        _search(calc, first, steps, axis)


def _search(calc: Calculation, first: Reduction, steps: Sequence[Step], axis: str) -> None:
    """Search the extremes of the coming reductions, up to where the abscissa is cut further: one search costs hardly less than many."""
    edges = calc.domains[axis].edges
    if all(calc.extremes.get((first.of, sign), (None,))[0] is edges for sign in SIGNS[first.operation]):
        return
    uncut = takewhile(lambda step: not _cuts(calc, step, axis), _computable(calc, steps, axis))
    extrema.search(
        calc,
        [
            (step.of, sign)
            for step in uncut
            if isinstance(step, Reduction) and step.operation in SIGNS
            for sign in SIGNS[step.operation]
        ],
    )


def _cuts(calc: Calculation, step: Step, axis: str) -> bool:
    """Whether a step cuts an abscissa into finer pieces; a value between the rows of a table has its corners there."""
    return getattr(step, "abscissa", "") == axis or (isinstance(step, Interpolated) and calc.axis.get(step.id) == axis)


def _computable(calc: Calculation, steps: Sequence[Step], axis: str) -> Iterator[Step]:
    """The coming steps that cut an abscissa, and those that ask for curves over it which need nothing that is not known yet.

    Among variants, numbers that are known already by their formulas are computed at once.
    """
    known = {axis, *calc.inputs, *calc.values, *calc.curves, *(f"inputs.{name}" for name in calc.inputs)}
    for step in steps:
        if _cuts(calc, step, axis):
            yield step
        elif isinstance(step, Value | Choice) and calc.axis.get(step.id) == axis and taken(step) <= known:
            known.add(step.id)
            calc.curves[step.id] = step
        elif isinstance(step, Asking) and step.of in known and calc.axis[step.of] == axis:
            yield step
        elif step.id not in calc.values and not _known_early(calc, step, known):
            known.discard(step.id)  # where an input has the same id, it is not what is meant from here on


def _known_early(calc: Calculation, step: Step, known: set[str]) -> bool:
    is_number = isinstance(step, Value) and calc.count > 1 and step.id not in calc.axis and not step.numbered
    if not is_number or not taken(step) <= known:
        return False
    assert isinstance(step, Value)
    calc.values[step.id] = calc.existing(step, calc.apply(step.formula))
    known.add(step.id)
    return True
