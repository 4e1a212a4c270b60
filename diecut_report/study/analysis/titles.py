"""What people call the columns of a study: the description of the quantity and its mechanism, each title once."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import said, say
from diecut_report.study.storage.description import ResultColumn

MECHANISMS = "mechanisms."
PART = re.compile(r"(.+)\.(\d+)\.\w+")  # of a list of the inputs
LISTED = re.compile(rf"{re.escape(MECHANISMS)}[^.]+\.{PART.pattern}")
UTILISATION, VERDICT_OF = ".utilisation", ".status"  # ends of the columns of a check


def titles(columns: Sequence[ResultColumn]) -> dict[str, str]:
    """Return the titles by name: ``Radius of the bore (cylinder)``; longer where two columns would share one, empty without a description."""
    checks = [column for column in columns if _is_verdict(column)]
    return _titles([column for column in columns if not _is_verdict(column)]) | _titles(checks)


def _titles(columns: Sequence[ResultColumn]) -> dict[str, str]:
    found = {column.name: "" for column in columns}
    open_ = [column for column in columns if column.description and home(column.name)]
    for title in (_short, _whole, _with_name):
        made = {column.name: title(column) for column in open_}
        often = Counter([*made.values(), *found.values()])
        found |= {name: told for name, told in made.items() if often[told] == 1 or title is _with_name}
        open_ = [column for column in open_ if not found[column.name]]
    return found


def home(name: str) -> str:
    """Return the mechanism (or ``press``) of a column; nothing for those of the study itself."""
    first, _, rest = name.removeprefix(MECHANISMS).partition(".")
    return first if rest else ""


def _short(column: ResultColumn) -> str:
    """Without what a closing bracket explains; of a part with its number, whatever else is varied."""
    if LISTED.fullmatch(column.name):
        return _with_name(column)
    return _placed(column, re.sub(r" \([^()]*\)$", "", _told(column)))


def _whole(column: ResultColumn) -> str:
    return _placed(column, _told(column))


def _with_name(column: ResultColumn) -> str:
    name = column.name.removeprefix(MECHANISMS).partition(".")[2]
    listed = PART.fullmatch(name)
    if listed:
        return _placed(
            column,
            say("{quantity}: no. {nth} of {list}", quantity=_told(column), nth=int(listed[2]) + 1, list=listed[1]),
        )
    return _placed(column, f"{_told(column)}, {name}")


def _told(column: ResultColumn) -> str:
    """The description in the language that is spoken; of a check's verdict the check alone."""
    check = column.description.removesuffix(": utilisation")
    if column.name.endswith(UTILISATION) and check != column.description:
        return say("{check}: utilisation", check=phrase(check))
    return said(column.description.removesuffix(": verdict") if _is_verdict(column) else column.description)


def _is_verdict(column: ResultColumn) -> bool:
    return ".checks." in column.name and column.name.endswith(VERDICT_OF)


def _placed(column: ResultColumn, told: str) -> str:
    return f"{told} ({home(column.name)})"
