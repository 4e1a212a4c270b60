"""A value that conditions choose."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Unpack

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.names import Written, as_formula, formula_of
from diecut_report.mechanism.steps.base import Options, Over
from diecut_report.mechanism.steps.protocols import ANY, CURVE, Item, Kinds, Names, StepEngine, StepFormula, StepPrinter
from diecut_report.mechanism.steps.value import FormulaStep
from diecut_report.text.phrases import Phrase, phrase


@dataclass(frozen=True, eq=False)
class Case:
    """Declare one branch of a choice: its value (formula or text), why in words, and when it is taken; the last one has no condition."""

    value: Any
    words: str
    condition: Any = None

    def __post_init__(self) -> None:
        if not isinstance(self.value, str):
            object.__setattr__(self, "value", as_formula(self.value, self.words))
        if self.condition is not None:
            named = Phrase("the condition of a case, which stands behind its value and its words,")
            object.__setattr__(
                self, "condition", as_formula(self.condition, named if isinstance(self.condition, str) else self.words)
            )

    def mapped(self, function: Callable[[Any], Any]) -> Case:
        """Return the same with what a function makes of its formulas."""
        value = self.value if isinstance(self.value, str) else function(self.value)
        return replace(self, value=value, condition=self.condition and function(self.condition))

    def formulas(self) -> Iterator[StepFormula]:
        if not isinstance(self.value, str):
            yield StepFormula(phrase("value of a case"), phrase("the value of a case"), self.value, True, CURVE)
        if self.condition is not None:
            yield StepFormula(phrase("condition of a case"), phrase("a condition"), self.condition, False, CURVE, True)


case = Case


@dataclass(frozen=True, eq=False)
class Choice(FormulaStep):
    """Declare a value (number, or text where the cases' values are texts) chosen by conditions; the branch taken is printed."""

    cases: tuple[Case, ...]

    TAKES: ClassVar[dict[str, Kinds]] = {"cases": ANY}

    @classmethod
    def of(
        cls,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        *cases: Case,
        per_piece: bool = False,
        **options: Unpack[Options],
    ) -> Choice:
        """Declare a value (number or text) chosen by conditions; the last case has none. The branch taken is printed."""
        return cls(id, symbol, unit, description, cases, per_piece=per_piece, **options)

    def formulas(self) -> Iterator[StepFormula]:
        for case in self.cases:
            yield from case.formulas()
        yield from super().formulas()

    @property
    def is_text(self) -> bool:
        return bool(self.cases) and isinstance(self.cases[0].value, str)

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        found = super().kinds(over)
        return {("text", axis) for _, axis in found} if self.is_text else found

    def takes_over(self) -> set[str]:
        links = [formula_of(case.value) for case in self.cases if not isinstance(case.value, str)]
        return {name for link in links if link.tree.op == "sym" for name in link.parameters}

    def shape_faults(self) -> Iterator[str]:
        cases: tuple[Any, ...] = self.cases
        if not cases:
            yield phrase("has no cases; give at least one Case")
        if not all(isinstance(each, Case) for each in cases):
            template = 'has cases that are none; give them one after another: case(value, "why", condition), case(value, "why")'
            yield phrase(template)
            return
        for each in cases:
            if not isinstance(each.words, str):
                yield phrase('has a case whose words are not a text; write case(value, "why it is taken", condition)')

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        yield from super().faults(names, when)
        texts = [isinstance(each.value, str) for each in self.cases]
        if any(texts) and not all(texts):
            yield phrase("mixes texts and numbers in its cases; give all cases texts, or all numbers")
        if self.cases and self.cases[-1].condition is not None:
            yield phrase(
                "has a condition in its last case, so that none may hold; take it away, or add a case for all else"
            )
        for number, each in enumerate(self.cases[:-1], 1):
            if each.condition is None:
                template = "has no condition in case {number} of {all}, so that those after it are never taken; add one"
                yield Phrase(template, number=number, all=len(self.cases))

    def values(self, apply: Callable[[Written], Array]) -> Array:
        held = [apply(each.condition) for each in self.cases if each.condition is not None]
        *values, found = (apply(each.value) for each in self.cases if not isinstance(each.value, str))
        for condition, value in zip(reversed(held), reversed(values), strict=True):
            # NumPy's select takes five times as long for the short arrays of one machine
            found = np.where(condition, value, found)
        return np.asarray(found)

    def numbers(self, calc: StepEngine) -> Array:
        held = [calc.apply(each.condition).astype(bool) for each in self.cases if each.condition is not None]
        last = np.full((calc.count, 1), len(held))
        calc.branch[self.id] = np.select(held, [np.full_like(last, i) for i in range(len(held))], last)
        values = (each.value for each in self.cases)
        taken = [np.full(last.shape, v, dtype=object) if isinstance(v, str) else calc.apply(v) for v in values]
        return np.choose(calc.branch[self.id], taken)

    def shown_formula(self, page: StepPrinter, elsewhere: bool) -> Written:
        taken: str | Written = self.cases[page.case_taken(self, elsewhere)].value
        assert not isinstance(taken, str), "a curve has no texts"
        return taken

    def items(self, page: StepPrinter) -> list[Item]:
        calc, axis = page.calc, page.calc.axis.get(self.id)
        elsewhere, place = page.over_axis(self)
        index = page.case_taken(self, elsewhere)
        taken = self.cases[index]
        item = self.head() | {"type": "choice", "words": taken.words}
        held = taken.condition if taken.condition is not None else self.cases[index - 1].condition
        if held is not None:
            symbolic, numeric = page.sides(formula_of(held), taken.condition is not None, axis, elsewhere)
            item |= {"condition": symbolic, "condition_substituted": numeric}
        item |= place
        if isinstance(taken.value, str):
            item |= {"equation": None, "substituted": None, "result": {"text": taken.value, "unit": "1"}}
        else:
            item |= page.formula(self, formula_of(taken.value), elsewhere)
        return [item] if axis is None or axis in calc.domains else [item, page.table(self, [self.id])]
