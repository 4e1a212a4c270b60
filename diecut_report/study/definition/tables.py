"""The tables that a study names: read once each, their columns judged by the bounds of the inputs that they vary."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np

from diecut_report.config.validation import ConfigPlace, validate
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.inputs import SI, Quantity
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.definition.form import value_form
from diecut_report.study.sampling.variables import Values
from diecut_report.study.tables.cells import Faults
from diecut_report.study.tables.reading import ReadColumn, TableFile, read_table

DIFFERENT = 100  # wrong texts of a column after which no further ones are judged


class TableReader:
    """Read tables, found by ``find`` by their names in the study; gathers ``problems``, and each one's SHA-256 in ``hashes``."""

    def __init__(self, place: ConfigPlace, find: Callable[[str], Path]) -> None:
        self.place, self.find = place, find
        self.problems: list[Problem] = []
        self.hashes: dict[str, str] = {}
        self._read: dict[str, TableFile | None] = {}

    def table(self, name: str, key: KeyPath) -> TableFile | None:
        """Return the table that the study names at this key, or None where it cannot be read."""
        if name not in self._read:
            self._read[name] = self._opened(name, key)
        return self._read[name]

    def _opened(self, name: str, key: KeyPath) -> TableFile | None:
        path = self.find(name)
        try:
            if not os.path.exists(path):  # false also for a name that can be none
                words = Phrase(
                    "there is no file {path}. The table is sought from the study's folder; check its name.", path=path
                )
                raise UserError(self.place.problem(key, words))
            found = read_table(path)
            self.hashes[name] = found.sha256
        except UserError as error:
            self.problems += error.problems
            return None
        return found

    def column(self, asked: Input, name: str, column: str, key: KeyPath) -> Values | None:
        """Return a column of a table as the values of an input, or None with the problems."""
        table = self.table(name, key)
        try:
            return self.values(asked, table.column(column)) if table else None
        except UserError as error:
            self.problems += error.problems
            return None

    def values(self, asked: Input, column: ReadColumn) -> Values | None:
        """Return a column as the values of an input: SI numbers within its bounds, or texts that it takes."""
        before = len(self.problems)
        try:
            if isinstance(asked.meta, Quantity):
                numbers = column.si(asked.meta.unit)
                self.problems += _outside(asked.meta, column, numbers)
            else:
                numbers = None
                self.problems += self._wrong_texts(asked, column)
        except UserError as error:
            self.problems += error.problems
        if len(self.problems) > before:
            return None
        return column.texts() if numbers is None else numbers

    def _wrong_texts(self, asked: Input, column: ReadColumn) -> Iterator[Problem]:
        form, texts = value_form(asked), column.texts()
        wrong: dict[str, str] = {}
        for text in dict.fromkeys(texts):
            if found := validate(form, {"value": text}, self.place)[1]:
                wrong[text] = found[0].message
            if len(wrong) > DIFFERENT:
                words = Phrase(
                    "more than {different} different texts are none that {path} takes: {wrong}",
                    different=DIFFERENT,
                    path=asked.path,
                    wrong=wrong[text],
                )
                return iter([column.problem(words, column.cells.row(texts.index(text)))])
        places = (place for place, text in enumerate(texts) if text in wrong)
        return column.faulty(Faults.of(places, lambda place: wrong[texts[place]]))


def _outside(meta: Quantity, column: ReadColumn, values: Iterable[float]) -> Iterator[Problem]:
    """Cells that the input's bounds refuse, with the words that a config has for them."""
    numbers = np.asarray(values)
    places = np.flatnonzero(~meta.holds(numbers))
    return column.faulty(Faults.of(places, lambda place: _refusal(meta, float(numbers[place]))))


def _refusal(meta: Quantity, value: float) -> str:
    try:
        meta.validate(SI(value, meta.parsed_unit.si, "the table"))
    except ValueError as fault:
        return str(fault)
    raise AssertionError(f"{value} is refused in a column, but not alone")
