"""What plain code finds: a number, a row or a text; and texts for messages."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from diecut_report.mechanism.steps import plain_code
from diecut_report.mechanism.steps.base import Over, QuantityStep, SilentStep
from diecut_report.mechanism.steps.protocols import PLAIN, SAID, Item, Kinds, StepEngine, StepPrinter
from diecut_report.mechanism.steps.value import answer


@dataclass(frozen=True, eq=False)
class Computed(QuantityStep):
    """Declare a number found by plain code where no closed formula tells it; ``method`` says in words how.

    ``function`` takes the quantities ``takes`` by position: numbers as arrays of shape (variants, 1), texts, the handles of curve inputs (``Curve``).
    It gives an array of shape (variants, 1), SI; (variants, parts) for a row over the list ``over``, or over what ``PartNames`` declares; or with
    ``is_text`` a text for each variant. Truth values are printed as yes and no. One that takes a mechanism or a phase, of which it is told what is of
    one machine, is called for each of many, unless it gives a value for each.
    """

    function: Callable[..., Any]
    takes: tuple[str, ...]
    method: str
    over: str = field(default="", kw_only=True)
    is_text: bool = field(default=False, kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"takes": PLAIN}
    may_be_absent = True

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("text", "")} if self.is_text else {("row", self.over)} if self.over else {("number", "")}

    def runs_over(self, known: Mapping[str, str]) -> str | None:
        return self.over or None

    def run(self, calc: StepEngine) -> None:
        taken = plain_code.taken(calc, self.takes)
        found = calc.computed(self, taken)
        if (
            calc.count > 1
            and np.shape(found)[:1] != (calc.count,)
            and any(isinstance(each, np.ndarray) for each in taken)
        ):
            raise TypeError(f"{self.id} was given {calc.count} machines and has one value for all")
        if self.is_text:
            calc.values[self.id] = plain_code.texts(self, found, calc.count)
            return
        give = plain_code.row if self.over else plain_code.number
        calc.values[self.id] = calc.existing(self, give(self, found, calc))

    def items(self, page: StepPrinter) -> list[Item]:
        calc, axis = page.calc, page.calc.axis.get(self.id)
        if page.is_index(self.id):
            return []  # from 0, of the part that the formulas are shown for, which is told by its name
        if axis is not None:
            return [] if page.has_tables(axis) else [page.table(self, [self.id])]
        if calc[self.id].dtype == bool:
            return [self.head() | answer(held=bool(calc[self.id][0, 0]))]
        result = (
            {"text": calc[self.id][0, 0], "unit": "1"}
            if self.is_text
            else page.result(self, page.value_at(self.id, None))
        )
        chosen = {"chosen": True} if self.lacks else {}  # in the place of an input that may be given
        return [self.head() | {"type": "found", "relation": None, "method": self.method, "result": result} | chosen]


@dataclass(frozen=True, eq=False)
class Words(SilentStep):
    """Declare a text made by plain code, for messages (``{id}``): ``function`` takes the numbers (SI) and texts ``takes`` of one machine.

    It is made only where a message or a drawing asks for it. With ``each_part`` the function gives a tuple: a text for each part of a row.
    """

    function: Callable[..., str | tuple[str, ...]]
    takes: tuple[str, ...]
    each_part: bool = field(default=False, kw_only=True)
    output: bool = field(default=True, kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"takes": SAID}
    is_taken = True
    is_run = False
    is_made_late = True

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("text", "")}
