"""Repeated parts that follow from the inputs, and tables of rows over parts."""

from __future__ import annotations

import reprlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar

from diecut_report.mechanism.steps import plain_code
from diecut_report.mechanism.steps.base import Over, SilentStep
from diecut_report.mechanism.steps.protocols import A_ROW, ANY, PARTS, PLAIN, Item, Kinds, StepEngine, StepPrinter
from diecut_report.text.phrases import phrase


@dataclass(frozen=True, eq=False)
class PartNames(SilentStep):
    """Declare repeated parts that are no list of the inputs, but follow from them: ``function`` gives their names.

    Rows run over its id. Formulas of them are shown with the numbers of the part ``shown_at`` (the id of its index from 0). ``count`` says
    how many parts there are, of a function that tells the length of a list of the inputs; without it rows have no columns in a study.
    """

    description: str = field()
    function: Callable[..., list[str]]
    takes: tuple[str, ...]
    shown_at: str = field(default="", kw_only=True)
    count: Callable[[Callable[[str], int]], int] | None = field(default=None, kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"takes": PLAIN, "shown_at": ANY}
    is_taken: ClassVar[bool] = True

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("list of parts", "")}

    def run(self, calc: StepEngine) -> None:
        found = self.function(*plain_code.taken(calc, self.takes))
        if not found or not all(isinstance(each, str) for each in found):
            raise plain_code.misgiven(self, reprlib.repr(found), phrase("a list of texts"))
        calc.part_names[self.id] = tuple(found)


@dataclass(frozen=True, eq=False)
class PartTable(SilentStep):
    """Declare a table that is printed here: the rows ``columns`` over the declared ``parts``, a line for each by its name.

    ``parts`` may be a list of the inputs, too: its rows are then printed in such tables alone.
    """

    description: str = field()
    parts: str
    columns: tuple[str, ...]

    TAKES: ClassVar[dict[str, Kinds]] = {"parts": PARTS, "columns": A_ROW}

    def items(self, page: StepPrinter) -> list[Item]:
        return [page.table_of_parts(self, self.parts, self.columns)]
