"""The first line on a machine: what fails, and what is left open; that all checks pass only where nothing is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.languages.phrases import Counted, Phrase, joined, phrase
from diecut_report.results.plugin_checks import calculated, is_doubtful
from diecut_report.results.summary import counts

Data = Mapping[str, Any]


def conclusion(results: Data) -> Phrase:
    """Return the one sentence that every command, page and file begins with."""
    found, left = _found(results), _listed(list(_left(results)))
    made = found["pass"] + found["warn"] + found["fail"]
    lost = sum("error" in data for data in calculated(results))
    if found["fail"]:
        failed = Counted(found["fail"], "{n} of {total} checks fails", "{n} of {total} checks fail", total=made)
        return Phrase("{failed}; {left}.", failed=failed, left=left) if left else Phrase("{failed}.", failed=failed)
    if lost:
        return _lost(results, lost)
    if not made:
        return Phrase("Nothing was checked, and {left}.", left=left) if found["not_checked"] else phrase("There are no checks.")  # fmt: skip
    return Phrase("No check fails, but {left}.", left=left) if left else phrase("All checks pass.")


def is_open(results: Data) -> bool:
    """Return whether a machine of which no check fails is not proved all the same: it may not carry a tick."""
    return any(True for _ in _left(results))


def _found(results: Data) -> Data:
    """The counts, and what is assumed."""
    return results.get("summary") or counts(
        [c for data in results["mechanisms"].values() for c in data.get("checks", ())]
    )


def _left(results: Data) -> Iterator[Phrase]:
    """What is left open."""
    found = _found(results)
    if lost := sum("error" in data for data in calculated(results)):
        yield Counted(lost, "{n} part is not calculated", "{n} parts are not calculated")
    if found["warn"]:
        yield Counted(found["warn"], "{n} warns", "{n} warn")
    if found["not_checked"]:
        yield Counted(found["not_checked"], "{n} is not checked", "{n} are not checked")
    if count := len(found.get("assumed", ())):
        yield Counted(count, "{n} value is assumed", "{n} values are assumed")
    if any(map(is_doubtful, calculated(results))):
        yield phrase("formulas of a plugin have faults")


def _listed(parts: list[Phrase]) -> str:
    *most, last = parts or [phrase("")]
    return Phrase("{first} and {next}", first=joined(most, ", "), next=last) if most else last


def _lost(results: Data, lost: int) -> Phrase:
    what = (
        "{n} of {total} mechanisms and comparisons were not calculated."
        if "comparisons" in results
        else "{n} of {total} mechanisms were not calculated."
    )
    return Phrase(what, n=lost, total=len(calculated(results)))
