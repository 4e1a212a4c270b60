"""A number from a row of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.steps.base import Over
from diecut_report.mechanism.steps.protocols import (
    ANY,
    ROW,
    Item,
    Kinds,
    MachineValues,
    Names,
    StepEngine,
    StepPrinter,
    TakenName,
)
from diecut_report.mechanism.steps.table_steps import (
    AS_GIVEN,
    SAME,
    TableStep,
    as_given,
    column_title,
    given_faults,
    given_of,
    key_faults,
    key_to_change,
    si_values,
    sources,
    unlike_units,
)
from diecut_report.quantities.formatting import MOST_DIGITS, number_text, si, with_unit
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import Column, StandardFault, StandardTable
from diecut_report.text.phrases import Phrase, phrase

SHOWN_NUMBERS = 6  # of those that a table has, the nearest ones
BY_NAME = phrase("a text, as the table's rows have names; for a number name the column that it is sought in, sought_in")


@dataclass(frozen=True, eq=False)
class Lookup(TableStep):
    """Declare a number from a row of a table: the one that a text input names, or the one that has the number ``by``.

    ``by`` is a text for a table whose rows have names, of an input or one that was found (``choice``, ``computed`` with ``is_text``); for one
    whose rows go by numbers it is any number, as one that was picked from it; with ``sought_in``, a column, the number is sought there. It
    is a row where ``by`` is one of repeated parts. ``column`` is the column that is taken, where a table has several. A number that the
    table does not have makes the machine impossible: ``key`` is then the input to change, else ``by``.
    ``given`` is an optional input: where it is given the step has its value.
    """

    table: Mapping[str, float] | StandardTable
    by: str
    column: str = field(default="", kw_only=True)
    sought_in: str = field(default="", kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"given": ANY, "by": ANY}

    @property
    def is_by_number(self) -> bool:
        """Return whether the row is the one that has a number, not the one of a name."""
        return isinstance(self.table, StandardTable) and bool(self.sought_in or not self.table.names)

    @property
    def sought(self) -> Column:
        """Return the column in which the number is sought; StandardFault where there is none of this name."""
        assert isinstance(self.table, StandardTable)
        return self.table.column(self.sought_in) if self.sought_in else self.table.columns[0]

    def rows(self) -> tuple[Mapping[str, float], str]:
        """Return the numbers by the rows' names, and their unit."""
        if isinstance(self.table, StandardTable):
            return self.table.by_name(self.column), self.table.column(self.column).unit
        return self.table, self.unit

    def takes_ids(self) -> Iterator[TakenName]:
        by_name = TakenName("by", self.by, frozenset({"text"}), BY_NAME)
        yield TakenName("by", self.by, ROW) if self.is_by_number else by_name

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("row", axis) for _, axis in over(self.by, of_all=True)} or {("number", "")}

    def runs_over(self, known: Mapping[str, str]) -> str | None:
        return known.get(self.by)

    # Faults.

    def shape_faults(self) -> Iterator[str]:
        yield from super().shape_faults()
        table: Any = self.table
        if isinstance(table, StandardTable):
            return
        if not isinstance(table, Mapping):
            template = 'takes from {table}; give a table, then the text input by which: table, by="…"'
            yield Phrase(template, table=repr(table))
            return
        wrong = [key for key, value in table.items() if isinstance(value, bool) or not isinstance(value, int | float)]
        if wrong:
            told = ", ".join(f"{key} ({table[key]!r})" for key in wrong)
            yield Phrase("has no number in its table for {told}; write numbers in the step's unit", told=told)

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        if not self.is_by_number:
            rows: Mapping[str, Any] = {}
            with suppress(StandardFault):  # which is told below
                rows = self.rows()[0]
            yield from names.incomplete(self.by, rows, names.without(when, self.given), phrase("no row in the table"))
            yield from self._text_faults(names, rows)
        yield from self._column_faults()
        yield from self._sought_faults(names)
        yield from self._idle_rows(names)
        yield from given_faults(self, "by", self.by, names)

    def _text_faults(self, names: Names, rows: Mapping[str, Any]) -> Iterator[str]:
        """A row that is taken by a text of a step: one that a message makes, or a text of a choice without a row."""
        for step in (giver.step for giver in names.givers(self.by) if giver.step is not None):
            if step.is_text and (cases := getattr(step, "cases", ())):
                missing = [each.value for each in cases if isinstance(each.value, str) and each.value not in rows]
                if missing:
                    template = "has no row in the table for {by}={missing}; the rows are {rows}"
                    yield Phrase(template, by=self.by, missing=", ".join(map(str, missing)), rows=", ".join(rows))
            elif step.is_made_late:
                template = (
                    "by is {by}, words that are made where a message asks for them; "
                    "let choice or computed(…, is_text=True) give the row's name"
                )
                yield Phrase(template, by=self.by)

    def _column_faults(self) -> Iterator[str]:
        if not isinstance(self.table, StandardTable):
            if self.column:
                template = "names the column {column}, but its table has none; write it with own_table(…, columns=…)"
                yield Phrase(template, column=self.column)
            return
        try:
            own = self.table.column(self.column)
        except StandardFault as fault:
            yield str(fault).removesuffix(".")
            return
        yield from unlike_units(column_title(own), own.unit, self.all_units, phrase("the step"))

    def _sought_faults(self, names: Names) -> Iterator[str]:
        """What is wrong with the number by which a row is sought."""
        if not self.is_by_number:
            if self.key:
                template = "names the key {key}, but its row is that of a text, which is always there; take key away"
                yield Phrase(template, key=self.key)
            return
        assert isinstance(self.table, StandardTable)
        try:
            own = self.sought
        except StandardFault as fault:
            yield str(fault).removesuffix(".")
            return
        if len(set(own.values)) < len(own.values):
            template = "seeks the row by the column {name} of the table “{title}”, which has a number twice; take another column"
            yield Phrase(template, name=own.name, title=self.table.title)
        yield from unlike_units(column_title(own), own.unit, names.units(self.by), self.by)
        missing = phrase("be a number that the table does not have")
        yield from key_faults(self.key, self.by, names, self._is_picked(names), missing)

    def _is_picked(self, names: Names) -> bool:
        """Whether the number is always one that was picked from a series of numbers that the table has."""
        own, steps = set(self.sought.values), [giver.step for giver in names.givers(self.by)]
        return all(each and not each.instead and each.standard_values and each.standard_values <= own for each in steps)

    def _idle_rows(self, names: Names) -> Iterator[str]:
        """Rows of a step's own table that no text asks for; a published table may have more rows than a mechanism allows."""
        key = names.world.keys.get(self.by)
        if key is None or not key.texts or isinstance(self.table, StandardTable):
            return
        template = "has a row for {row}{nearest}, which {by} can never be; allowed: {texts}; take the row away, or allow its text"
        for row in self.table:
            if row not in key.texts:
                near = nearest(row, key.texts)
                yield Phrase(template, row=repr(row), nearest=near, by=self.by, texts=", ".join(key.texts))

    # Run.

    def run(self, calc: StepEngine) -> None:
        given = given_of(calc, self.given)
        if isinstance(given, np.ndarray):
            calc.values[self.id] = given
            return
        found = self._by_number(calc, given) if self.is_by_number else self._by_text(calc)
        for part, value in enumerate(given or ()):
            if value is not None:
                found[:, part] = value
        calc.values[self.id] = found

    def _text(self, calc: MachineValues) -> Any:
        return calc.values[self.by] if self.by in calc.steps else calc.inputs[self.by]

    def _by_text(self, calc: StepEngine) -> Array:
        numbers, display = self.rows()
        text = self._text(calc)
        if isinstance(text, np.ndarray):
            return self._by_found(calc, text)
        texts = text if isinstance(text, tuple) else (text,)
        found = [np.nan if key is None else si(numbers[key], display) for key in texts]
        return np.tile(np.asarray(found, dtype=float), (calc.count, 1))

    def _by_found(self, calc: StepEngine, texts: Array) -> Array:
        """The numbers of rows whose names were found, NaN without one; Misdeclared where a machine that can be has another name."""
        numbers, display = self.rows()
        found_texts = (text for text in texts[calc.possible].flat if isinstance(text, str))
        if strange := [text for text in found_texts if text not in numbers]:
            template = "step {id}: {by} is {text}, which is not a row of its table; the rows are {rows}"
            filling = {"id": self.id, "by": self.by, "text": repr(strange[0]), "rows": ", ".join(numbers)}
            raise Misdeclared(Phrase(template, filling), calc.steps[self.by].at)
        found = np.array([si(numbers.get(text, np.nan), display) for text in texts.flat], dtype=float)
        return found.reshape(texts.shape)

    def _by_number(self, calc: StepEngine, given: Any) -> Array:
        """The number of the row that has exactly what is sought; a machine for which no row has it is refused, or marked among several."""
        assert isinstance(self.table, StandardTable)
        own, taken, sought = self.sought, self.table.column(self.column), calc[self.by]
        numbers = si_values(own.values, own.unit)
        row = np.abs(sought[..., None] - numbers).argmin(axis=-1)
        missing = np.abs(sought - numbers[row]) > SAME * np.abs(numbers[row])  # not where there is nothing to seek by
        for part, value in enumerate(given or ()):
            missing[:, part] &= value is None
        for variant in np.flatnonzero(missing.any(axis=1)):
            part = int(np.argmax(missing[variant]))
            words = "" if calc.is_partial else self._unknown(calc, float(sought[variant, part]))
            calc.refuse(int(variant), key_to_change(self, self.by, calc, part), words)
        return np.where(missing | np.isnan(sought), np.nan, si_values(taken.values, taken.unit)[row])

    def _unknown(self, calc: StepEngine, value: float) -> Phrase:
        """What no row has, and what the rows next to it have."""
        own, declared = self.sought, calc.step_or_input(self.by)
        number = value / unit(own.unit).factor
        near = sorted(sorted(set(own.values), key=lambda each: abs(each - number))[:SHOWN_NUMBERS])
        filling = {
            "symbol": declared.symbol,
            "value": with_unit(number_text(number), own.unit),
            "table": phrase(getattr(self.table, "title", "")),
            "description": phrase(self.description),
            "taken": self.symbol,
            "rows": with_unit(", ".join(number_text(each, MOST_DIGITS) for each in near), own.unit),
        }
        if self.by in calc.steps or self.key:
            template = "leads to {symbol} = {value}, which no row of the table “{table}” has for {description} ({taken}); the nearest have {rows}"
            return Phrase(template, filling)
        template = "is {symbol} = {value}, which no row of the table “{table}” has for {description} ({taken}); the nearest have {rows}"
        return Phrase(template, filling)

    # Print.

    def items(self, page: StepPrinter) -> list[Item]:
        axis = page.calc.axis.get(self.id)
        if axis is not None:
            return [] if page.has_tables(axis) else [self._table(page)]
        result = {"result": page.result(self, float(page.calc[self.id][0, 0]))}
        is_given = given_of(page.calc, self.given) is not None
        return [self.head() | (as_given(page, self.given) if is_given else self._taken(page)) | result]

    def _taken(self, page: StepPrinter) -> Item:
        by = page.calc.step_or_input(self.by)
        found = self._text(page.calc)
        text = found[0, 0] if isinstance(found, np.ndarray) else found
        return {
            "type": "lookup",
            "by": by.description,
            "key": f"{by.symbol} = {page.printed(self.by)}" if self.is_by_number else str(text),
            "table": self.table.title if isinstance(self.table, StandardTable) else "",
            **({"column": self.column} if self.column else {}),
            **sources(self.table),
        }

    def _table(self, page: StepPrinter) -> Item:
        """The row, beside the texts or numbers by which it was taken."""
        if self.is_by_number:
            return page.table(self, [self.by, self.id])
        found = page.table(self, [self.id])
        found["columns"].insert(1, {"title": page.calc.step_or_input(self.by).description, "symbol": "", "unit": "1"})
        for line, text in zip(found["rows"], self._texts(page.calc), strict=True):
            line.insert(1, str(text))
        return found

    def _texts(self, calc: MachineValues) -> Sequence[str]:
        """By which text each part of a row was looked up, or that its number is given."""
        given, count = given_of(calc, self.given), calc[self.id].shape[1]
        if isinstance(given, np.ndarray):
            return [AS_GIVEN] * count
        found = self._text(calc)
        texts: Sequence[str] = found[0] if isinstance(found, np.ndarray) else found
        pairs = zip(texts, given or (None,) * count, strict=True)
        return [text if value is None else AS_GIVEN for text, value in pairs]
