"""The line of page 1 on what the calculation rests on that is assumed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from diecut_report.report.i18n import Catalogue
from diecut_report.results.assumed import ordered

Data = Mapping[str, Any]
TOLD = 6  # paths on page 1


@dataclass(frozen=True)
class AssumedLine:
    """Hold the words, the paths that are told with what each of them moves, and how many more there are."""

    head: str
    paths: list[tuple[str, str]]
    more: str


def assumed_line(results: Data, words: Catalogue) -> AssumedLine | None:
    """Return the line; None where nothing is assumed."""
    found = ordered(results)
    if not found:
        return None
    moving = [each for each in found if each.check] or found
    paths = [(each.path, words.say("moves", check=each.check) if each.check else "") for each in moving[:TOLD]]
    head = words.say("rests_on" if len(found) > 1 else "rests_on_one", n=len(found))
    head += words["moving_first"] if found[0].check and len(found) > 1 else ""
    more = words.say("more_assumed", n=len(found) - len(paths)) if len(found) > len(paths) else ""
    return AssumedLine(head, paths, more)
