"""The first line on a machine: what fails, and what is left open; that all checks pass only where nothing is."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

from diecut_report.config.plugins import Discovery
from diecut_report.config.source_hashes import plugin_faults
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.figure_views import curve_named, guarded
from diecut_report.mechanism.chapters import Chapter
from diecut_report.mechanism.mechanism import CurveTable, Profile, Source
from diecut_report.mechanism.steps import Step
from diecut_report.results.checks import applies, calculated, checks_of, is_doubtful
from diecut_report.text.phrases import Counted, Phrase, joined, phrase

# The sources of a machine: a plugin's own, but those that only steps and checks name which this machine does not have.


def cited_sources(calc: Calculation) -> list[dict[str, Any]]:
    """Return the works that the calculation rests on; papers, which are numbered, and what no step names, always."""
    mechanism = calc.mechanism
    every = {step.source for _, step in mechanism.steps} | {check.source for check in mechanism.checks}
    used = {text for chapter, step in mechanism.active(calc.given) for text in _texts(chapter, step)}
    used |= {check.source for check in checks_of(calc) if applies(calc, check)} | {
        *mechanism.assumptions,
        mechanism.summary,
    }
    kept = [
        each for each in mechanism.sources if _is_named(each, used) or not _is_named(each, every) or each.id.isdigit()
    ]
    return [{"id": source.id, "citation": source.citation} for source in kept]


def _is_named(source: Source, texts: Collection[str]) -> bool:
    return any(source.id in text for text in texts)


def _texts(chapter: Chapter, step: Step) -> tuple[str, ...]:
    """What is said of a step that may name a source."""
    return chapter.text, step.source, step.description, getattr(step, "method", "")


# What is written beside the report: profiles as tables and drawings.


ExportsData = dict[str, Any]


def exports(calc: Calculation) -> list[ExportsData]:
    """Return the profiles that are written beside the report; one that fails is kept with what went wrong (``error``)."""
    return [_export(calc, p) for p in calc.mechanism.exports if calc.given.issuperset(p.needs)]


def _export(calc: Calculation, profile: Profile) -> ExportsData:
    is_table = isinstance(profile, CurveTable)
    said = {"id": profile.id, "title": profile.title, "type": "table" if is_table else "profile"}
    columns = list(profile.columns)

    def made() -> ExportsData:
        if is_table:
            own = [name for name, step in calc.curves.items() if step.output and calc.axis[name] == columns[0]]
            return said | {"abscissa": curve_named(calc, columns[0]), "columns": own}
        abscissa = curve_named(calc, columns[0])
        for name in columns:
            curve_named(calc, name, abscissa)
        return said | {"abscissa": abscissa, "columns": columns}

    return guarded(made, said | {"abscissa": "", "columns": columns}, profile.at)


# Numbers that one mechanism hands to another: both tell them with the same digits.


GROUPS = ("outputs", "values", "inputs")


def told_alike(results: Mapping[str, ExportsData], mechanisms: Mapping[str, ExportsData]) -> dict[str, ExportsData]:
    """Return results, each input that refers to a number of one of the mechanisms told as that number is where it is given."""
    found = {}
    for name, data in results.items():
        changed = {
            key: row | {"display": told} for key, row in data["inputs"].items() if (told := _told(row, mechanisms))
        }
        found[name] = data | {"inputs": data["inputs"] | changed} if changed else data
    return found


def _told(row: ExportsData, mechanisms: Mapping[str, ExportsData]) -> ExportsData | None:
    """How the number that an input refers to is told there; None where it is told so already, or in another unit."""
    home, _, name = row.get("path", "").partition(".")
    if row.get("origin") != "reference" or home not in mechanisms:
        return None
    given = next((mechanisms[home][group][name] for group in GROUPS if name in mechanisms[home][group]), None)
    own, there = row["display"], (given or {}).get("display", {})
    is_same = given is not None and given["value"] == row["value"] and there["unit"] == own["unit"]
    return dict(there) if is_same and there["text"] != own["text"] else None


# What is said of results that a plugin of somebody else gave though its formulas have faults.


TOLD = 3  # faults of a plugin that are told


def doubtful_kinds(results: Mapping[str, Any]) -> list[str]:
    """Return the kinds of a report whose foreign plugins have faults in their formulas."""
    return list(dict.fromkeys(each["kind"] for each in calculated(results) if is_doubtful(each)))


def doubtful(results: Mapping[str, Any], discovery: Discovery | None = None) -> list[str]:
    """Return in words which foreign plugins of a report have faults in their formulas, with the first that are known here."""
    known = discovery.origins if discovery else {}
    found = {
        kind: discovery.mechanism(kind) if discovery and kind in known else None for kind in doubtful_kinds(results)
    }
    return [line for kind, mechanism in found.items() for line in told_faults(kind, plugin_faults(mechanism))]


def told_faults(kind: str, faults: Sequence[str]) -> list[str]:
    """Return what is said of a plugin whose formulas have faults, and below it the first of them with file and line."""
    words = "The formulas of the plugin of {kind} have faults; do not rely on its results."
    lines: list[str] = [Phrase(words, kind=repr(kind)), *(f"  {fault}" for fault in faults[:TOLD])]
    if (more := len(faults) - TOLD) > 0:
        one = "  {n} more fault, which `diecut-report check-plugin {kind}` tells"
        many = "  {n} more faults, which `diecut-report check-plugin {kind}` tells"
        lines.append(Counted(more, one, many, kind=kind))
    return lines


# The verdict as numbers: how many checks pass, fail and are not made, which one governs, and what the whole rests on.


RANK = {"pass": 0, "warn": 1, "fail": 2, "error": 3, "skipped": 3}
COUNTED = ("pass", "warn", "fail", "not_checked")
SELF_TEST = "numerical"


def counts(checks: Sequence[Mapping[str, Any]]) -> ExportsData:
    """Return how many checks there are of each status; the self-tests of the calculation stand apart."""
    of_machine = [check["status"] for check in checks if check["class"] != SELF_TEST]
    own = [check["status"] == "pass" for check in checks if check["class"] == SELF_TEST]
    return {status: of_machine.count(status) for status in COUNTED} | {
        "numerical": {"pass": own.count(True), "fail": own.count(False)}
    }


def failed_self_tests(checks: Iterable[ExportsData]) -> list[ExportsData]:
    """Return the self-tests of the calculation that do not hold."""
    return [check for check in checks if check["class"] == SELF_TEST and check["status"] != "pass"]


def summary(mechanisms: ExportsData) -> ExportsData:
    """Return the whole's verdict: counts, and the governing check."""
    named = governing(mechanisms)
    return counts([check for data in mechanisms.values() for check in data["checks"]]) | {
        "governing": f"{named['mechanism']}.{named['check']}" if named else None,
    }


def governing(mechanisms: ExportsData) -> ExportsData | None:
    """Return the check that governs: fail before warn before pass, then the greatest utilisation; a failing null is the greatest.

    Self-tests do not govern, nor, unless it fails, what the program sized to its limit or what the calculation presumes.
    """
    checks = [(name, check) for name, data in mechanisms.items() for check in data["checks"] if may_govern(check)]
    if not checks:
        return None
    name, check = max(checks, key=lambda pair: weight(pair[1]))
    return {"mechanism": name, "check": check["id"]}


def may_govern(check: ExportsData) -> bool:
    """Return whether a check may govern, see ``governing``."""
    shows_reserve = not (check.get("sized_to_limit", False) or check.get("presumed", False))
    return check["status"] in RANK and check["class"] != SELF_TEST and (shows_reserve or check["status"] != "pass")


def weight(check: ExportsData) -> tuple[int, float]:
    """Return by what checks are ordered: the status, then the utilisation."""
    unknown = math.inf if check["status"] != "pass" else -math.inf
    return RANK[check["status"]], unknown if check["utilisation"] is None else check["utilisation"]


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
