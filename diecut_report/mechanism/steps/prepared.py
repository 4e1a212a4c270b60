"""What plain code makes of inputs once, for several steps; and tables that it makes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple

from diecut_report.mechanism.steps import plain_code
from diecut_report.mechanism.steps.base import Over, SilentStep
from diecut_report.mechanism.steps.protocols import ANY, HELD, Called, Item, Kinds, StepEngine, StepPrinter, TakenName
from diecut_report.text.phrases import Phrase

Cell = float | str | None


class HoldingStep(SilentStep):
    """Declare the base of what plain code makes of a mapping: of those of ``holds`` that there are."""

    function: Callable[..., Any]
    holds: tuple[str, ...]

    is_taken = True

    def takes_ids(self) -> Iterator[TakenName]:
        yield from (TakenName("holds", name, HELD) for name in self.holds)

    @property
    def called(self) -> Called:
        return Called(1)

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("prepared", "")}

    def known(self, calc: StepEngine) -> dict[str, Any]:
        """Return what the function gets of a calculation."""
        there = [name for name in self.holds if name in calc.values or name in calc.inputs]
        return dict(zip(there, plain_code.taken(calc, there), strict=True))


@dataclass(frozen=True, eq=False)
class Prepared(HoldingStep):
    """Declare an object that plain code makes of a machine once (``for_many``: of many at once) of those of ``holds`` that there are.

    With ``again`` it also gets ``known["again"]``, which calculates the same machines with other inputs; ValueError for ``again`` alone.
    """

    function: Callable[..., Any]
    holds: tuple[str, ...]
    for_many: bool = field(default=False, kw_only=True)
    again: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.again and not self.for_many:
            template = "{id} is prepared again=True, which calculates all machines at once: write it for many, with for_many=True"
            raise ValueError(Phrase(template, id=self.id))

    def run(self, calc: StepEngine) -> None:
        known = self.known(calc)
        if self.again:
            known["again"] = calc.again(self)
        alone = calc.count == 1 or self.for_many
        calc.inputs[self.id] = calc.call(self, [known]) if alone else calc.prepared(self, known)


class ListedColumn(NamedTuple):
    """Hold a column of a listing: its id in the results, what it is, its symbol and display unit; texts have no unit.

    ``digits`` are the significant digits of its numbers; 0 leaves them to the unit: to what can be made or measured, all alike. A column
    that is not ``printed``, such as keys beside their words, stands in the results alone.
    """

    id: str
    description: str
    symbol: str = ""
    unit: str = "1"
    digits: int = 0
    printed: bool = True


@dataclass(frozen=True, eq=False)
class Listing(HoldingStep):
    """Declare a table: ``function`` takes one mapping, as that of ``Prepared`` does, and returns rows of texts and numbers (SI; None: none).

    It is made only where results are told, of one machine. ``taken`` is the quantity, a text or a number, that stands in the first column of
    the row that was taken, which is marked.
    """

    description: str = field()
    columns: tuple[ListedColumn, ...]
    function: Callable[..., Iterable[Sequence[Cell]]]
    holds: tuple[str, ...]
    taken: str = ""

    TAKES: ClassVar[dict[str, Kinds]] = {"taken": ANY}
    is_run = False

    def items(self, page: StepPrinter) -> list[Item]:
        return page.listing(self)
