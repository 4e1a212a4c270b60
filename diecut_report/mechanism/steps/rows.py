"""Rows over repeated parts: their total, their neighbours, what runs along them, one of their parts; parts that follow from the inputs; tables."""

from __future__ import annotations

import reprlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

import numpy as np

from diecut_report.mechanism.steps import plain_code
from diecut_report.mechanism.steps.base import Over, QuantityStep, SilentStep
from diecut_report.mechanism.steps.protocols import (
    A_ROW,
    ANY,
    PARTS,
    PLAIN,
    Impossible,
    Item,
    Kinds,
    Names,
    StepEngine,
    StepPrinter,
)
from diecut_report.text.phrases import Counted, Phrase, phrase

NEUTRAL = {"sum": 0.0, "product": 1.0, "min": np.inf, "max": -np.inf}
REDUCE: dict[str, Any] = {"sum": np.sum, "product": np.prod, "min": np.min, "max": np.max}
AMONG = "over the parts with {symbol} > 0"


class RowStep(QuantityStep):
    """Declare the base of what is made of the row ``of`` over repeated parts."""

    of: str

    TAKES: ClassVar[dict[str, Kinds]] = {"of": A_ROW}

    def same_units(self, units: Callable[[str], set[str]], names: Names) -> Iterator[tuple[str, set[str]]]:
        if getattr(self, "operation", "") == "product":
            yield phrase("a product of any number of parts"), {"1"}
        yield self.of, units(self.of)

    def reduced(self, page: StepPrinter, operation: str, method: str) -> list[Item]:
        """Return the number that is made of the row."""
        result = page.result(self, float(page.calc[self.id][0, 0]))
        item = {"type": "reduction", "of": page.calc.step_or_input(self.of).symbol, "result": result}
        return [self.head() | item | {"operation": operation, "method": method}]


class RowAlong(RowStep):
    """Declare the base of a row that is made of a row."""

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return over(self.of) or {("row", "")}

    def runs_over(self, known: Mapping[str, str]) -> str:
        return known[self.of]


@dataclass(frozen=True, eq=False)
class Total(RowStep):
    """Declare the sum, product, least or greatest over repeated parts; with ``among`` (a row) only over the parts where that is above zero."""

    operation: Literal["sum", "product", "min", "max"]
    of: str
    among: str = field(default="", kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"of": A_ROW, "among": A_ROW}

    def run(self, calc: StepEngine) -> None:
        parts = calc[self.of]
        if self.among:
            parts = np.where(calc[self.among] > 0, parts, NEUTRAL[self.operation])
        calc.values[self.id] = REDUCE[self.operation](parts, axis=1, keepdims=True)

    def items(self, page: StepPrinter) -> list[Item]:
        counted = Phrase(AMONG, symbol=page.calc.step_or_input(self.among).symbol) if self.among else ""
        return self.reduced(page, self.operation, counted)


@dataclass(frozen=True, eq=False)
class Neighbour(RowAlong):
    """Declare a row: the value of the next part (``shift`` = 1) or of the one before (-1), the parts standing in a closed loop.

    It is not printed by itself: it stands beside its part in the table of what takes it.
    """

    of: str
    shift: Literal[1, -1] = 1

    def run(self, calc: StepEngine) -> None:
        calc.values[self.id] = np.roll(calc[self.of], -self.shift, axis=1)


@dataclass(frozen=True, eq=False)
class Running(RowAlong):
    """Declare a row: sum or product of a row's parts from the first one up to each."""

    operation: Literal["sum", "product"]
    of: str

    def run(self, calc: StepEngine) -> None:
        cumulate: Any = np.cumsum if self.operation == "sum" else np.cumprod
        calc.values[self.id] = cumulate(calc[self.of], axis=1)

    def items(self, page: StepPrinter) -> list[Item]:
        return [page.table(self, [self.of, self.id])]


@dataclass(frozen=True, eq=False)
class Part(RowStep):
    """Declare the value of one part of a row: the first (``index`` = 0), the last (-1)."""

    of: str
    index: int

    def run(self, calc: StepEngine) -> None:
        count = calc[self.of].shape[1]
        if not -count <= self.index < count:
            number = self.index + 1 if self.index >= 0 else -self.index
            which = Phrase("part {number}" if self.index >= 0 else "part {number} from the last", number=number)
            many = Counted(count, "{n} entry", "{n} entries")
            template = "has {count}, but {description} ({id}) takes {which}; add what is missing"
            filled = Phrase(template, count=many, description=self.description, id=self.id, which=which)
            raise Impossible([(calc.axis[self.of], filled)])
        calc.values[self.id] = calc[self.of][:, [self.index]]

    def items(self, page: StepPrinter) -> list[Item]:
        return self.reduced(page, "last" if self.index < 0 else "first", "")


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
    is_taken = True

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
