"""What people call the columns of a study: the description of the quantity and its mechanism, each title once."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import said, say
from diecut_report.study.storage.description import ResultColumn

MECHANISMS = "mechanisms."
PART = re.compile(r"(.+)\.(\d+)\.\w+")  # of a list of the inputs
LISTED = re.compile(rf"{re.escape(MECHANISMS)}[^.]+\.{PART.pattern}")
UTILISATION, VERDICT_OF = ".utilisation", ".status"  # ends of the columns of a check
ENDS_OF_CHECKS = {
    re.compile("(?P<what>.+): utilisation"): phrase("{quantity}: utilisation"),
    re.compile("(?P<what>.+): verdict"): "",
}
ENDS = {  # as `result_columns` describes one of several results of a step
    re.compile(r"(?P<what>.+): no\. (?P<number>\d+)"): phrase("{quantity}: no. {number}"),
    re.compile("(?P<what>.+): how many in a turn"): phrase("{quantity}: how many in a turn"),
}


def titles(columns: Sequence[ResultColumn], kinds: Mapping[str, str] = MappingProxyType({})) -> dict[str, str]:
    """Return the titles by name: ``Radius of the bore (cylinder)``; longer where two columns would share one, empty without a description.

    They are in the language that is spoken, by the catalogue of the mechanism's kind; ``kinds`` says which each one is of.
    """
    words = _Words(kinds)
    checks = [column for column in columns if _is_verdict(column)]
    return _titles(words, [column for column in columns if not _is_verdict(column)]) | _titles(words, checks)


def _titles(words: _Words, columns: Sequence[ResultColumn]) -> dict[str, str]:
    found = {column.name: "" for column in columns}
    open_ = [column for column in columns if column.description and home(column.name)]
    for title in (words.short, words.whole, words.with_name):
        made = {column.name: title(column) for column in open_}
        often = Counter([*made.values(), *found.values()])
        found |= {name: told for name, told in made.items() if often[told] == 1 or title == words.with_name}
        open_ = [column for column in open_ if not found[column.name]]
    return found


def home(name: str) -> str:
    """Return the mechanism (or ``press``) of a column; nothing for those of the study itself."""
    first, _, rest = name.removeprefix(MECHANISMS).partition(".")
    return first if rest else ""


@dataclass(frozen=True)
class _Words:
    """Say what columns are, by the words of the kinds of their mechanisms."""

    kinds: Mapping[str, str]

    def short(self, column: ResultColumn) -> str:
        """Without what a closing bracket explains; of a part with its number, whatever else is varied."""
        if LISTED.fullmatch(column.name):
            return self.with_name(column)
        return _placed(column, re.sub(r" \([^()]*\)$", "", self._told(column)))

    def whole(self, column: ResultColumn) -> str:
        """With all of its words."""
        return _placed(column, self._told(column))

    def with_name(self, column: ResultColumn) -> str:
        """With the key, or which part of a list it is of."""
        name = column.name.removeprefix(MECHANISMS).partition(".")[2]
        listed = PART.fullmatch(name)
        if listed:
            words = "{quantity}: no. {nth} of {list}"
            return _placed(column, say(words, quantity=self._told(column), nth=int(listed[2]) + 1, list=listed[1]))
        return _placed(column, f"{self._told(column)}, {name}")

    def _told(self, column: ResultColumn) -> str:
        """The description in the language that is spoken; of a check's verdict the check alone."""
        of_check = _is_verdict(column) or column.name.endswith(UTILISATION)
        what, ending, number = _parted(column.description, ENDS_OF_CHECKS if of_check else ENDS)
        if not ending or _is_verdict(column):
            return said(what, self.kinds.get(home(column.name), ""))
        return said(Phrase(ending, quantity=phrase(what), number=number), self.kinds.get(home(column.name), ""))


def _parted(description: str, ends: Mapping[re.Pattern[str], str]) -> tuple[str, str, str]:
    """What a column is of, and the words that say what of it, with its number."""
    for pattern, words in ends.items():
        if found := pattern.fullmatch(description):
            return found["what"], words, found.groupdict().get("number", "")
    return description, "", ""


def _is_verdict(column: ResultColumn) -> bool:
    return ".checks." in column.name and column.name.endswith(VERDICT_OF)


def _placed(column: ResultColumn, told: str) -> str:
    return f"{told} ({home(column.name)})"
