"""Conditions give yes or no, and choices end with a case that is always taken."""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_args

from diecut_report.contract.binding import Binding, Bound, ByText, bound
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.steps import Choice, Computed, Require, Step, Value
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.units import kind_of
from diecut_report.declaration.words import Fault
from diecut_report.expressions import FormulaError, Node
from diecut_report.languages.phrases import Phrase, phrase

MAY_BE_ABSENT = Value | Choice | Computed
YES_OR_NO = ("cmp", "and", "or", "not")


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield conditions that are numbers, numbers that are conditions, and choices in which no case may hold."""
    for _, step in mechanism.steps:
        for part, condition in _conditions(step):
            for link in condition.options() if isinstance(condition, ByText) else (bound(condition),):
                if not _decides(link, names):
                    text = Phrase(
                        "the {part} gives a number, not yes or no; compare it with something ({formula} > 0)",
                        part=part,
                        formula=link.formula.__name__,
                    )
                    yield Fault(step.at, Phrase("step {id}", id=step.id), text)
                    break
        if step.exists is not None and not isinstance(step, MAY_BE_ABSENT):
            kinds = ", ".join(kind.__name__.lower() for kind in get_args(MAY_BE_ABSENT))
            yield Fault(
                step.at,
                Phrase("step {id}", id=step.id),
                Phrase("has exists, which holds for {kinds} alone; put it on what this step takes", kinds=kinds),
            )
        texts = _cases(step.cases) if isinstance(step, Choice) else _flag(step, names)
        yield from (Fault(step.at, Phrase("step {id}", id=step.id), text) for text in texts)


def _conditions(step: Step) -> Iterator[tuple[str, Binding]]:
    if step.exists is not None:
        yield phrase("condition exists"), step.exists
    if isinstance(step, Require):
        yield phrase("condition"), step.condition
    for case in step.cases if isinstance(step, Choice) else ():
        if case.condition is not None:
            yield phrase("condition of a case"), case.condition


def _decides(link: Bound, names: DeclaredNames, *, unread: bool = True) -> bool:
    """Whether a formula gives yes or no; ``unread`` of one that cannot be read, which is told elsewhere."""
    try:
        return _is_condition(link.formula.tree, link, names, unread)
    except (FormulaError, RecursionError):
        return unread


def _is_condition(node: Node, link: Bound, names: DeclaredNames, unread: bool) -> bool:
    match node:
        case Node("cases", branches):
            return all(_is_condition(branch[0], link, names, unread) for branch in branches)
        case Node("apply", (called, *_)):
            return _is_condition(called.formula.tree, bound(called.formula), names, unread)
        case Node("sym", (parameter,)):
            steps = [giver.step for giver in names.givers(str(link.names.get(parameter)))]
            return bool(steps) and all(isinstance(step, Value) and _decides(bound(step.formula), names, unread=unread) for step in steps)  # fmt: skip
    return node.op in YES_OR_NO


def _flag(step: Step, names: DeclaredNames) -> Iterator[str]:
    """A comparison that stands as a quantity with a unit."""
    if (
        isinstance(step, Value)
        and not isinstance(step.formula, ByText)
        and _decides(bound(step.formula), names, unread=False)
    ):
        wrong = [each for each in (step.unit, *(other for _, other in step.units)) if kind_of(each) != kind_of("1")]
        if wrong:
            yield Phrase("gives yes or no (1 or 0), but has the unit {wrong}; a flag has the unit 1", wrong=wrong[0])


def _cases(cases: tuple[object, ...]) -> Iterator[str]:
    texts = [isinstance(getattr(case, "value", None), str) for case in cases]
    if any(texts) and not all(texts):
        yield phrase("mixes texts and numbers in its cases; give all cases texts, or all numbers")
    if cases and getattr(cases[-1], "condition", None) is not None:
        yield Phrase(
            "has a condition in its last case, so that none may hold; take it away, or add a case for all else"
        )
    for number, case in enumerate(cases[:-1], 1):
        if getattr(case, "condition", None) is None:
            yield Phrase(
                "has no condition in case {number} of {all}, so that those after it are never taken; add one",
                number=number,
                all=len(cases),
            )
