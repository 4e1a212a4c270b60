"""The line of page 1 on what the calculation rests on that is assumed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import quantity
from diecut_report.results.assumed import ordered

Data = Mapping[str, Any]
TOLD = 6  # paths on page 1


@dataclass(frozen=True)
class AssumedLine:
    """Hold the words, the paths that are told with what each of them moves, and how many more there are."""

    head: str
    paths: list[tuple[str, str]]
    more: str


@dataclass(frozen=True)
class AssumedGroup:
    """Hold the assumed values of the press or of a mechanism: key, value, and the check that it moves, if it moves one."""

    name: str
    values: list[tuple[str, str, str]]

    @property
    def runs(self) -> list[tuple[str, list[tuple[str, str]]]]:
        """The keys with their values by the check that they move, those first that move one."""
        found: dict[str, list[tuple[str, str]]] = {}
        for key, value, check in self.values:
            found.setdefault(check, []).append((key, value))
        return sorted(found.items(), key=lambda run: not run[0])


def assumed_groups(results: Data, words: Catalogue) -> list[AssumedGroup]:
    """Return all assumed values by what they belong to, in the file's order."""
    groups: dict[str, list[tuple[str, str, str]]] = {}
    checks = {each.path: each.check for each in ordered(results)}
    for path in results.get("summary", {}).get("assumed", ()):
        name, key, row = _input(results, path)
        shown = quantity(row["display"]["text"], row["display"]["unit"], words["decimal"]) if row else ""
        groups.setdefault(name, []).append((key, shown, checks[path]))
    return [AssumedGroup(name, values) for name, values in groups.items()]


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
    paths = [(each.path, words.say("moves", check=each.check) if each.check else "") for each in moving[:TOLD]]
    head = words.say("rests_on", n=len(found))
    head += words["moving_first"] if found[0].check and len(found) > 1 else ""
    more = words.say("more_assumed", n=len(found) - len(paths)) if len(found) > len(paths) else ""
    return AssumedLine(head, paths, more)
