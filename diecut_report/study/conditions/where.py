"""Conditions on stored variants: ``drive.crank_torque_peak < '40 N*m' and status = 'pass'`` to SQL with parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from diecut_report.conditions.parts import Name
from diecut_report.conditions.reading import read
from diecut_report.conditions.tree import names
from diecut_report.conditions.words import ConditionError
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.analysis.stored_variants import StoredColumn
from diecut_report.study.conditions.sql_emitter import written

EXAMPLE = "drive.crank_torque_peak < '40 N*m' and status = 'pass'"
SHOWN = 300  # letters of a condition in a message


@dataclass
class Condition:
    """Hold a condition for DuckDB with its parameters, and the columns that it names."""

    sql: str
    parameters: list[Any]
    columns: list[str] = field(default_factory=list)


def condition(given: str, columns: Mapping[str, StoredColumn]) -> Condition:
    """Return the condition that a text says; UserError in words, with the place, for what cannot be asked."""
    try:
        tree = read(given, columns, lambda name: _name(name, columns), EXAMPLE)
    except ConditionError as fault:
        where = "" if fault.place is None else Phrase(", at character {place}", place=fault.place + 1)
        shown = given if len(given) <= SHOWN else given[:SHOWN] + "…"
        raise UserError(
            Problem(Phrase("The condition “{shown}”{where}: {words}", shown=shown, where=where, words=fault.words))
        ) from None
    sql = written(tree, columns)
    return Condition(sql.text, list(sql.given), list(names(tree)))


def column_named(name: str, columns: Mapping[str, StoredColumn]) -> StoredColumn:
    """Return the column of a name; UserError with the nearest where there is none."""
    if name not in columns:
        raise UserError(
            Problem(
                Phrase(
                    "{name} is not a column of these variants{nearest}.",
                    name=repr(name),
                    nearest=nearest(name, columns),
                )
            )
        )
    return columns[name]


def _name(name: str, columns: Mapping[str, StoredColumn]) -> Name:
    if name not in columns:
        near = nearest(name, columns) or phrase("; put texts in quotes")
        raise ConditionError(Phrase("{name} is not a column of these variants{near}.", name=repr(name), near=near))
    column = columns[name]
    if column.is_number:
        return Name(name, "number", column.unit, column.display)
    return Name(name, "truth" if column.kind == "bool" else "text")
