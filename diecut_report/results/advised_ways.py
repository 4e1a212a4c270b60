"""The changes that a failing check advises: as the results hold them, and in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.results.mechanism_record import KeyChangeRecord
from diecut_report.results.record import Relation
from diecut_report.text.phrases import Phrase, joined, named, phrase

Number = float | int
Value = Number | str | bool | tuple[Number | str | bool, ...]


@dataclass(frozen=True)
class Change:
    """One key of an advice: its relation to a value in a unit, two values for ``between`` and some for ``one_of``."""

    key: str
    relation: Relation
    value: Value
    unit: str = "1"

    @property
    def record(self) -> KeyChangeRecord:
        """Return the change as the results hold it."""
        value = list(self.value) if isinstance(self.value, tuple) else self.value
        return KeyChangeRecord(key=self.key, relation=self.relation, value=value, unit=self.unit)

    @property
    def text(self) -> Phrase:
        """Return the change in words."""
        values = [
            _printed(each, self.unit) for each in (self.value if isinstance(self.value, tuple) else (self.value,))
        ]
        match self.relation:
            case "at_least":
                return Phrase("set {key} to at least {value}", key=self.key, value=values[0])
            case "at_most":
                return Phrase("set {key} to at most {value}", key=self.key, value=values[0])
            case "between":
                return Phrase("set {key} to between {low} and {high}", key=self.key, low=values[0], high=values[1])
            case "one_of":
                return Phrase("set {key} to {values}", key=self.key, values=named(values, " or "))
        return Phrase("set {key} to {value}", key=self.key, value=values[0])


@dataclass(frozen=True)
class Way:
    """Changes that together make a check hold, and how much holds with them (LEVELS); ``broken`` are titles of checks that then fail."""

    changes: tuple[Change, ...]
    level: int
    broken: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """Return the way in words."""
        changes = joined([change.text for change in self.changes], " and ")
        if not self.broken:
            return changes
        titles = joined([Phrase("“{title}”", title=phrase(title)) for title in self.broken], ", ")
        return Phrase("{changes} (this check then fails: {checks})", changes=changes, checks=titles)


def advice_text(ways: Sequence[Way]) -> Phrase:
    """Return the ways as one sentence."""
    return Phrase("{ways:capital}.", {"ways:capital": joined([way.text for way in ways], ", or ")})


def advice_records(ways: Iterable[Way]) -> list[list[KeyChangeRecord]]:
    """Return the ways as the results hold them."""
    return [[change.record for change in way.changes] for way in ways]


def _printed(value: Number | str | bool, unit: str) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else with_unit(number_text(value, 6), unit)
