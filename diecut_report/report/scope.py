"""How much of the results a report holds, and of which mechanisms."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from diecut_report.results.conclusion import conclusion
from diecut_report.results.summary import RANK, governing, summary

Data = Mapping[str, Any]
BRIEF, STANDARD, FULL = "brief", "standard", "full"


@dataclass(frozen=True)
class Scope:
    """Hold what is reported, at which detail, under which letters; and what is told of the mechanisms that are left out."""

    results: Data
    detail: str
    letters: Mapping[str, str]
    total: int
    status: str  # of the whole press

    @property
    def is_part(self) -> bool:
        """Whether mechanisms are left out."""
        return len(self.results["mechanisms"]) < self.total


def scope(results: Data) -> Scope:
    """Return what the results ask to be reported (``report``: its detail, and the mechanisms that alone are shown)."""
    asked = results.get("report", {})
    letters = {name: letter(index) for index, (name, _) in enumerate(parts(results))}
    shown = _only(results, asked["only"]) if asked.get("only") else results
    return Scope(shown, asked.get("detail", STANDARD), letters, len(results["mechanisms"]), results["status"])


def parts(results: Data) -> Iterator[tuple[str, Data]]:
    """What the chapters are of, with their names: all mechanisms, then all comparisons between them."""
    yield from results["mechanisms"].items()
    yield from results.get("comparisons", {}).items()


def letter(index: int) -> str:
    """A chapter's letter: A … Z, AA …"""
    return ("" if index < 26 else letter(index // 26 - 1)) + chr(ord("A") + index % 26)


def _only(results: Data, names: list[str]) -> Data:
    """Return the results of some mechanisms, with a verdict of their own; comparisons stay where all their mechanisms do."""
    mechanisms = {name: data for name, data in results["mechanisms"].items() if name in names}
    compared = results.get("comparisons", {})
    comparisons = {name: data for name, data in compared.items() if set(data["between"]) <= mechanisms.keys()}
    found = {**results, "mechanisms": mechanisms, "comparisons": comparisons, "governing": governing(mechanisms)}
    found["status"] = max((data["status"] for data in mechanisms.values()), key=RANK.__getitem__)
    found["summary"] = summary(mechanisms) | _assumed(results.get("summary", {}), mechanisms)
    found["summary"]["conclusion"] = conclusion(found)
    found.pop("comparisons_left_out", None)
    return found


def _assumed(whole: Data, mechanisms: Data) -> dict[str, Any]:
    """Return what is assumed of some mechanisms and of the press, and which of their checks that moves."""

    def is_shown(path: str) -> bool:
        return not path.startswith("mechanisms.") or path.split(".")[1] in mechanisms

    moves = [
        each for each in whole.get("moves", ()) if is_shown(each["path"]) and each["check"].split(".")[0] in mechanisms
    ]
    assumed = [path for path in whole.get("assumed", ()) if is_shown(path)]
    return {"assumed": [*assumed, *_taken(mechanisms, assumed)], "moves": moves}


def _taken(mechanisms: Data, assumed: list[str]) -> Iterator[str]:
    """The inputs that rest on what is assumed of mechanisms that are left out; of an expression, which names no giver, where nothing else is."""
    for name, data in mechanisms.items():
        for key, row in data["inputs"].items():
            path, giver = f"mechanisms.{name}.{key}", (row.get("path") or "").split(".")[0]
            is_left_out = giver not in {"press", *mechanisms} if giver else not assumed
            if row.get("basis") == "assumed" and path not in assumed and is_left_out:
                yield path
