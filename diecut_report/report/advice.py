"""The line of page 1 on what comes of the advice of all failing checks together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from diecut_report.report.i18n import Catalogue
from diecut_report.report.model import CheckRow
from diecut_report.report.number_format import number


def followed_line(results: Mapping[str, Any], words: Catalogue, rows: Iterable[CheckRow] = ()) -> Iterator[str]:
    """Yield the line, its checks called as these rows call them; nothing where that was not calculated."""
    advice = results.get("summary", {}).get("advice")
    if not advice:
        return
    changes = ", ".join(f"{each['path']} {_local(each['value'], words)}" for each in advice["changes"])
    if advice["error"]:
        yield words.say("advice_impossible", changes=changes)
    elif advice["failing"]:
        titles = {f"{row.mechanism}.{row.id}": f"{row.chapter} · {row.title}" for row in rows}
        left = ", ".join(titles.get(check, check) for check in advice["failing"])
        yield words.say("advice_leaves", changes=changes, checks=left)
    else:
        yield words.say("advice_passes", changes=changes)


def _local(value: str, words: Catalogue) -> str:
    """A value as it is typed, its number in the language's form."""
    text, _, unit = value.partition(" ")
    return " ".join(filter(None, (number(text, words["decimal"]), unit)))
