"""A value between two rows of a table as it is printed: the line through them, in symbols and with its numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from diecut_report.contract.binding import bound
from diecut_report.contract.part_steps import Interpolated
from diecut_report.engine.printing.substitution import MOST_DIGITS, Elsewhere, Substitution
from diecut_report.expressions import Node
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import shortest, with_unit
from diecut_report.standards import sources_told

if TYPE_CHECKING:
    from diecut_report.engine.calculation import Calculation


class BetweenRows(Substitution):
    """Describe the line through the two rows on either side of a quantity; its numbers stand in the table's units."""

    def __init__(
        self,
        calc: Calculation,
        step: Interpolated,
        value_of: Callable[[str], float],
        elsewhere: Elsewhere | None = None,
    ) -> None:
        super().__init__(calc, bound(step.formula), value_of, elsewhere)
        self.step = step
        row = int(step.between.piece(value_of(step.of)))
        self.rows = [
            [(own, shortest(own.values[k], MOST_DIGITS)) for own in step.between.columns] for k in (row, row + 1)
        ]

    def symbolic(self) -> Node:
        """Return the line in symbols, those of the rows with 1 and 2."""
        rows = [Node("sym", (symbol,)) for number in (1, 2) for symbol in self._symbols(number)]
        return self.step.between.through(self._marked(self.step.of), *rows)

    def told(self) -> dict[str, str]:
        """Return in words the two rows, and the table with where it comes from."""
        rows = (
            ", ".join(
                f"{symbol} = {with_unit(text, own.unit)}"
                for symbol, (own, text) in zip(self._symbols(number), row, strict=True)
            )
            for number, row in enumerate(self.rows, 1)
        )
        told = Phrase("Rows of the table: {rows}.", rows="; ".join(rows))
        return {"table_rows": told, "series": phrase(self.step.table.title), "note": sources_told(self.step.table)}

    def unit_of(self, declared: str, *, angle: bool) -> str:
        """Return the table's unit."""
        return self.step.between.columns[0].unit

    def _at(self, digits: int) -> Node:
        rows = [Node("qty", (text, own.unit)) for row in self.rows for own, text in row]
        return self._with_numbers(self.step.between.through(Node("sym", ("x",)), *rows), digits, angle=False)

    def _symbols(self, number: int) -> tuple[str, str]:
        """The symbols of a row: those of the quantities with its number."""
        own = self.calc.step_or_input(self.step.of).symbol, self.step.symbol
        first, second = (f"{symbol}{',' if '_' in symbol else '_'}{number}" for symbol in own)
        return first, second
