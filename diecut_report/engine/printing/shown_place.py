"""Where on its abscissa a curve is shown in print: one place for all formulas over it, and what is taken elsewhere."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.contract.binding import bound
from diecut_report.contract.code_steps import PartNames
from diecut_report.contract.steps import Abscissa, Choice, Value
from diecut_report.engine.calculation import Calculation, CurveSampler
from diecut_report.engine.numerics.domain import Domain
from diecut_report.engine.printing.substitution import Elsewhere
from diecut_report.engine.shown_units import declared_unit
from diecut_report.expressions import Array, Node
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.formatting import place_shown as as_place
from diecut_report.quantities.formatting import with_unit

Item = dict[str, Any]
FIRST = np.zeros(1, dtype=int)  # the variant that is printed


def shown_place(calc: Calculation, axis: str) -> tuple[Array, Array]:
    """Return the place of an abscissa at which formulas are shown, and the middle of its smooth piece, each of shape (1, 1)."""
    step = calc.steps[axis]
    assert isinstance(step, Abscissa)
    domain = calc.domains[axis]
    if step.shown_at in calc.middle:  # of an extreme, which knows the piece that it lies in
        return calc[step.shown_at][:1], calc.middle[step.shown_at][:1]
    asked = np.mod(calc[step.shown_at][:1], domain.period[:1]) if step.shown_at else None
    place = domain.samples[:1, domain.samples.shape[1] // 8][:, None] if asked is None else asked
    return place, domain.middle_of(place, rows=FIRST)


def value_at(calc: Calculation, name: str, axis: str | None, *, flag: bool = False, part: int | None = None) -> float:
    """Return a number, or a curve's value where formulas are shown, or that of a row's part (default: the one that is shown).

    What goes into a flag of smooth pieces is taken at the middle of the piece.
    """
    if axis in calc.domains and calc.axis.get(name) == axis:
        return float(np.ravel(_sampler(calc, str(axis), elsewhere=flag)[name])[0])  # a constant is a curve too
    row = calc[name]
    if row.shape[1] == 1:
        return float(row[0, 0])
    return float(row[0, shown_part(calc, name) if part is None else part])


def _sampler(calc: Calculation, axis: str, *, elsewhere: bool) -> CurveSampler:
    """The curves at the place where formulas are shown, or in the middle of its smooth piece."""

    def places(_: Domain) -> tuple[Array, Array]:
        place, middle = shown_place(calc, axis)
        return middle if elsewhere else place, middle

    return calc.kept(f"shown {elsewhere}", axis, places, FIRST)


def shown_part(calc: Calculation, name: str) -> int:
    """Return which part of a row formulas are shown with, from 0: the asked one, or the first that has all values; 0 of a number too."""
    known = _known_parts(calc, name)
    names = calc.steps.get(calc.axis.get(name, ""))
    if isinstance(names, PartNames) and names.shown_at:
        asked = int(calc[names.shown_at][0, 0])
        if known is None or known[asked]:
            return asked
    return 0 if known is None else int(np.argmax(known))


def _known_parts(calc: Calculation, name: str) -> Array | None:
    """Return for which parts a row and all that it takes have values; None of a text."""
    step = calc.steps.get(name)
    taken = [each for each in step.takes() if isinstance(each, str)] if isinstance(step, Value) else []
    rows = [
        calc.values[each][0]
        for each in (name, *taken)
        if each in calc.values and calc.axis.get(each) == calc.axis.get(name)
    ]
    known = [~np.isnan(row.astype(float)) for row in rows if row.dtype != object]
    return np.asarray(np.all(known, axis=0)) if known else None


def is_elsewhere(calc: Calculation, step: Value | Choice, axis: str | None) -> bool:
    """Return whether a flag has to be shown in the middle of its smooth piece: where curves are shown its formula gives another."""
    if not step.per_piece or axis not in calc.domains:
        return False
    here, there = (
        step if isinstance(step, Value) else step.cases[case_taken(calc, step, axis, flag=f)] for f in (False, True)
    )
    if here is not there:
        return True
    part = here.formula if isinstance(here, Value) else here.value
    assert not isinstance(part, str), "a curve has no texts"
    link = bound(part)
    taken = (value_at(calc, name, axis) if isinstance(name, str) else name for name in link.takes)
    return bool(link.formula(*taken) != value_at(calc, step.id, axis))


def located(calc: Calculation, axis: str, elsewhere: bool) -> Item:
    """Return where a formula over an abscissa is shown, and why where that is not its chapter's place."""
    place = place_shown(calc, axis, elsewhere)
    if not elsewhere:
        return {"at": place}
    told = f"{place['symbol']} = {with_unit(place['text'], place['unit'])}"
    words = "Taken at {place}, in the middle of its smooth piece; it is the same in all of it."
    return {"at": place, "note": Phrase(words, place=told)}


def marks(calc: Calculation, axis: str | None, elsewhere: bool) -> Elsewhere | None:
    """Return how curves are marked that are taken elsewhere than the chapter's."""
    if not elsewhere or axis is None:
        return None
    place = place_shown(calc, axis, True)
    marked = Node("sym", (place["symbol"],)), Node("qty", (place["text"], place["unit"]))

    def of(name: str) -> tuple[Node, Node] | None:
        curve = calc.steps.get(name)
        holds = curve is None or name == axis or getattr(curve, "per_piece", False)
        return None if holds or calc.axis.get(name) != axis else marked

    return of


def place_shown(calc: Calculation, axis: str, elsewhere: bool) -> Item:
    return place_of(calc, axis, float(_sampler(calc, axis, elsewhere=elsewhere).x[0, 0]))


def place_of(calc: Calculation, axis: str, place: float) -> Item:
    step = calc.steps[axis]
    return {"symbol": step.symbol} | as_place(place, declared_unit(calc, axis, step.unit))


def case_taken(calc: Calculation, step: Choice, axis: str | None, *, flag: bool) -> int:
    if axis is None:
        return int(calc.branch[step.id][0, 0])
    for index, case in enumerate(step.cases):
        if case.condition is None:
            return index
        link = bound(case.condition)
        taken = (value_at(calc, n, axis, flag=flag) if isinstance(n, str) else n for n in link.names.values())
        if link.formula(*taken):
            return index
    return len(step.cases) - 1
