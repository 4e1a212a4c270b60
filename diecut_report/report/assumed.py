"""The line of page 1 on what the calculation rests on that is assumed."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import quantity
from diecut_report.results.assumed import Assumed, ordered

Data = Mapping[str, Any]
TOLD = 3  # paths on page 1: all stand in the tables of inputs
_TYPED = re.compile(r"(?<=\d) (?=\S+$)")  # between a number and its unit that were typed as a text


@dataclass(frozen=True)
class AssumedLine:
    """Hold the words, the paths that are told (behind the last of a run what each of it moves), and how many more there are."""

    head: str
    paths: list[tuple[str, str]]
    more: str


@dataclass(frozen=True)
class AssumedGroup:
    """Hold the assumed values of the press or of a mechanism: key, value, and behind the last of a run what each of it moves."""

    name: str
    values: list[tuple[str, str, str]]


def assumed_groups(results: Data, words: Catalogue) -> list[AssumedGroup]:
    """Return all assumed values by what they belong to, in the file's order, those of each that move a check first."""
    groups: dict[str, list[Assumed]] = {}
    found = {each.path: each for each in ordered(results)}
    for path in results.get("summary", {}).get("assumed", ()):
        groups.setdefault(_input(results, path)[0], []).append(found[path])
    return [AssumedGroup(name, _valued(results, words, values)) for name, values in groups.items()]


def _valued(results: Data, words: Catalogue, values: list[Assumed]) -> list[tuple[str, str, str]]:
    """Key and value of each, and what it moves."""
    first = list(dict.fromkeys(each.check for each in values if each.check))
    told = []
    for each, moves in _runs(results, words, sorted(values, key=lambda one: [*first, ""].index(one.check))):
        _, key, row = _input(results, each.path)
        shown = quantity(row["display"]["text"], row["display"]["unit"], words["decimal"]) if row else ""
        told.append((key, _TYPED.sub("\u00a0", shown), moves))
    return told


def _runs(results: Data, words: Catalogue, values: list[Assumed]) -> Iterator[tuple[Assumed, str]]:
    """Each value, behind the last of those that move the same check what they move."""
    for check, run in groupby(values, lambda each: each.check):
        *others, last = run
        yield from ((each, "") for each in others)
        yield last, words.say("move_each" if others else "moves", check=_title(results, check)) if check else ""


def _title(results: Data, check: str) -> str:
    """How the reader knows a check."""
    name, _, own = check.partition(".")
    checks = results["mechanisms"].get(name, {}).get("checks", ())
    return next((str(each["title"]) for each in checks if each["id"] == own), check)


def _input(results: Data, path: str) -> tuple[str, str, Data | None]:
    """Whose input a path names, its key, and its line of the results; None where these do not have it."""
    whose, _, key = path.partition(".")
    if whose == "mechanisms":
        name, _, key = key.partition(".")
        found: Data | None = results["mechanisms"][name]["inputs"].get(key)
        return name, key, found
    return whose, key, next((row for row in results["press"]["fields"] if row["path"] == path), None)


def assumed_line(results: Data, words: Catalogue) -> AssumedLine | None:
    """Return the line; None where nothing is assumed."""
    found = ordered(results)
    if not found:
        return None
    moving = [each for each in found if each.check] or found
    paths = [(each.path, moves) for each, moves in _runs(results, words, moving[:TOLD])]
    head = words.say("rests_on", n=len(found))
    head += words["moving_first"] if found[0].check and len(found) > 1 else ""
    more = words.say("more_assumed", n=len(found) - len(paths)) if len(found) > len(paths) else ""
    return AssumedLine(head, paths, more)
