"""Tables that plain code makes, where what is to be shown is neither a number nor a curve nor a row of an input's parts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Unpack

from diecut_report.contract.options import StepCondition
from diecut_report.contract.phases import StepHolder
from diecut_report.contract.steps import Prepared

Cell = float | str | None


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


@dataclass(frozen=True, kw_only=True, eq=False)
class Listing(Prepared):
    """Declare a table: ``function`` takes one mapping, as that of ``Prepared`` does, and returns rows of texts and numbers (SI; None: none).

    It is made only where results are told, of one machine. ``taken`` is the quantity, a text or a number, that stands in the first column of
    the row that was taken, which is marked.
    """

    heads: tuple[ListedColumn, ...]
    taken: str = ""


class ListingForm:
    """Give chapters the call that declares a listing."""

    def listing(
        self: StepHolder, id: str, description: str, columns: tuple[ListedColumn, ...], function: Callable[..., Iterable[Sequence[Cell]]],
        holds: tuple[str, ...], taken: str = "", **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare a table that plain code makes: see ``Listing``."""
        own: dict[str, Any] = {"heads": columns, "function": function, "holds": holds, "taken": taken}
        self.add(Listing(id=id, description=description, **own, **when))
