"""The verdict on a machine and its first line: what fails, and what is left open; that all checks pass only where nothing is."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from typing import Literal

from diecut_report.config.plugins import Discovery
from diecut_report.config.source_hashes import plugin_faults
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.mechanism import CurveTable, Profile, Source
from diecut_report.results.checks import applies, checks_of
from diecut_report.results.figure_views import curve_named, guarded
from diecut_report.results.mechanism_record import (
    CheckRecord,
    CountRecord,
    ExportRecord,
    MechanismRecord,
    QuantityRecord,
    SelfTestCountRecord,
    ShownRecord,
    SourceRecord,
)
from diecut_report.results.model import GoverningRecord, OpenRecord, ResultsRecord, SummaryRecord
from diecut_report.results.record import OpenKind, Verdict
from diecut_report.text.phrases import Counted, Phrase, keys_listed, phrase

# The sources of a machine: a plugin's own, but those that only steps and checks name which this machine does not have.


def cited_sources(calc: Calculation) -> list[SourceRecord]:
    """Return the works that the calculation rests on; papers, which are numbered, and what no step names, always."""
    mechanism = calc.mechanism
    every = {step.source for _, step in mechanism.steps} | {check.source for check in mechanism.checks}
    used = {mechanism.summary, *mechanism.assumptions}
    used |= {check.source for check in checks_of(calc) if applies(calc, check)}
    for chapter, step in mechanism.active(calc.given):
        used |= {chapter.text, step.source, step.description, getattr(step, "method", "")}
    return [
        SourceRecord(id=source.id, citation=source.citation)
        for source in mechanism.sources
        if source.id.isdigit() or _is_named(source, used) or not _is_named(source, every)
    ]


def _is_named(source: Source, texts: Collection[str]) -> bool:
    return any(source.id in text for text in texts)


# What is written beside the report: profiles as tables and drawings.


def exports(calc: Calculation) -> list[ExportRecord]:
    """Return the profiles that are written beside the report; one that fails is kept with what went wrong (``error``)."""
    return [_export(calc, p) for p in calc.mechanism.exports if calc.given.issuperset(p.needs)]


def _export(calc: Calculation, profile: Profile) -> ExportRecord:
    is_table, columns = isinstance(profile, CurveTable), list(profile.columns)
    form: Literal["table", "profile"] = "table" if is_table else "profile"
    lost = ExportRecord(id=profile.id, title=profile.title, type=form, abscissa="", columns=columns)

    def made() -> ExportRecord:
        abscissa = curve_named(calc, columns[0])
        if is_table:
            own = [name for name, step in calc.curves.items() if step.output and calc.axis[name] == columns[0]]
            return lost.with_(abscissa=abscissa, columns=own)
        for name in columns:
            curve_named(calc, name, abscissa)
        return lost.with_(abscissa=abscissa)

    return guarded(made, lambda error: lost.with_(error=error), profile.at)


# Numbers that one mechanism hands to another: both show them with the same digits.


Mechanisms = Mapping[str, MechanismRecord]


def shown_alike(results: Mechanisms, mechanisms: Mechanisms) -> dict[str, MechanismRecord]:
    """Return results, each input that refers to a number of one of the mechanisms shown as that number is where it is given."""
    found = {}
    for name, data in results.items():
        shown = {key: _shown(row, mechanisms) for key, row in data.inputs.items()}
        changed = {key: data.inputs[key].with_(display=there) for key, there in shown.items() if there}
        found[name] = data.with_(inputs=data.inputs | changed) if changed else data
    return found


def _shown(row: QuantityRecord, mechanisms: Mechanisms) -> ShownRecord | None:
    """How the number that an input refers to is shown there; None where it is shown so already, or in another unit."""
    home, _, name = row.path.partition(".")
    if row.origin != "reference" or home not in mechanisms:
        return None
    groups = (mechanisms[home].outputs, mechanisms[home].values, mechanisms[home].inputs)
    given = next((group[name] for group in groups if name in group), None)
    if given is None or given.value != row.value or given.display.unit != row.display.unit:
        return None
    return given.display if given.display.text != row.display.text else None


# What is said of results that a plugin of somebody else gave though its formulas have faults.


TOLD = 3  # faults of a plugin that are told


def doubtful_kinds(results: ResultsRecord) -> list[str]:
    """Return the kinds of a report whose foreign plugins have faults in their formulas."""
    return list(dict.fromkeys(each.kind for each in results.calculated.values() if each.is_doubtful))


def doubtful(results: ResultsRecord, discovery: Discovery | None = None) -> list[str]:
    """Return in words which foreign plugins of a report have faults in their formulas, with the first that are known here."""
    found = []
    for kind in doubtful_kinds(results):
        is_known = discovery is not None and kind in discovery.origins
        found += told_faults(kind, plugin_faults(discovery.mechanism(kind) if discovery and is_known else None))
    return found


def told_faults(kind: str, faults: Sequence[str]) -> list[str]:
    """Return what is said of a plugin whose formulas have faults, and below it the first of them with file and line."""
    template = "The formulas of the plugin of {kind} have faults; do not rely on its results."
    lines: list[str] = [Phrase(template, kind=repr(kind)), *(f"  {fault}" for fault in faults[:TOLD])]
    if (more := len(faults) - TOLD) > 0:
        one = "  {n} more fault, which `diecut-report check-plugin {kind}` tells"
        many = "  {n} more faults, which `diecut-report check-plugin {kind}` tells"
        lines.append(Counted(more, one, many, kind=kind))
    return lines


# The verdict as numbers: how many checks pass, fail and are not made, which one governs, and what the whole rests on.


RANK = {"pass": 0, "warn": 1, "fail": 2, "error": 3, "skipped": 3}
COUNTED = ("pass", "warn", "fail", "not_checked")
SELF_TEST = "numerical"


def counts(checks: Sequence[CheckRecord]) -> CountRecord:
    """Return how many checks there are of each status; the self-tests of the calculation stand apart."""
    found = Counter(check.status for check in checks if check.check_class != SELF_TEST)
    own = Counter(check.status == "pass" for check in checks if check.check_class == SELF_TEST)
    return CountRecord(
        passing=found["pass"], warn=found["warn"], fail=found["fail"], not_checked=found["not_checked"],
        numerical=SelfTestCountRecord(passing=own[True], fail=own[False]),
    )  # fmt: skip


def summary(checks: Mapping[str, Sequence[CheckRecord]], assumed: Sequence[str]) -> SummaryRecord:
    """Return the counts of the checks of each mechanism with the paths of assumed inputs; the verdict is added later."""
    named, count = governing(checks), counts([check for each in checks.values() for check in each])
    return SummaryRecord(**dict(count), governing=str(named) if named else None, assumed=list(assumed))


def governing(checks: Mapping[str, Sequence[CheckRecord]]) -> GoverningRecord | None:
    """Return the check that governs: fail before warn before pass, then the greatest utilisation; a failing null is the greatest.

    Self-tests do not govern, nor, unless it fails, what the program sized to its limit or what the calculation presumes.
    """
    known = [(name, check) for name, own in checks.items() for check in own if may_govern(check)]
    if not known:
        return None
    name, check = max(known, key=lambda pair: weight(pair[1]))
    return GoverningRecord(mechanism=name, check=check.id)


def may_govern(check: CheckRecord) -> bool:
    """Return whether a check may govern, see ``governing``."""
    shows_reserve = not (check.sized_to_limit or check.presumed)
    return check.status in RANK and check.check_class != SELF_TEST and (shows_reserve or check.status != "pass")


def weight(check: CheckRecord) -> tuple[int, float]:
    """Return by what checks are ordered: the status, then the utilisation."""
    unknown = math.inf if check.status != "pass" else -math.inf
    return RANK[check.status], unknown if check.utilisation is None else check.utilisation


LEFT: dict[OpenKind, Callable[[int], Counted]] = {
    "warning": lambda n: Counted(n, "{n} check warns", "{n} checks warn"),
    "not_checked": lambda n: Counted(n, "{n} check is not made", "{n} checks are not made"),
    "not_rated": lambda n: Counted(n, "{n} part is not rated", "{n} parts are not rated"),
    "assumed": lambda n: Counted(n, "{n} assumed value is open", "{n} assumed values are open"),
    "default": lambda n: Counted(n, "{n} default value is open", "{n} default values are open"),
}
"""What is open, in the order in which it is listed, as the first line counts it."""


VALUES: tuple[OpenKind, ...] = ("assumed", "default")
"""What is open of inputs, and may be proved harmless."""


def judged(found: SummaryRecord, total: int, lost: int, *, are_compared: bool = False) -> SummaryRecord:
    """Return a summary with its verdict and the first line on the machine, which follow from its counts and from what is open.

    ``total`` counts the mechanisms and comparisons, ``lost`` those of them that were not calculated.
    """
    verdict: Verdict = "pass" if found.passing + found.warn > 0 and not found.open else "conditional"
    verdict = "fail" if found.fail or lost else verdict
    return found.with_(verdict=verdict, conclusion=_conclusion(found, total, lost, are_compared))


def summary_of(results: ResultsRecord) -> SummaryRecord:
    """Return the verdict as numbers; of a file before the three verdicts it follows from its checks and its assumed inputs."""
    return results.summary if results.summary.verdict else rejudged(results)


def rejudged(results: ResultsRecord) -> SummaryRecord:
    """Return the verdict as numbers, judged by what is open; without a list of that by the checks and the assumed inputs."""
    found, owner = results.summary, results.project.prepared_by
    if found.verdict is None:
        why = phrase("it is assumed")
        assumed = [OpenRecord(what="assumed", path=path, owner=owner, why=why) for path in found.assumed]
        checks = {name: data.checks for name, data in results.calculated.items()}
        doubtful = [name for name, data in results.calculated.items() if data.is_doubtful]
        found = found.with_(open=[*unsettled(checks, doubtful, owner), *assumed])
    parts = results.calculated.values()
    lost = sum(bool(each.error) for each in parts)
    return judged(found, len(parts), lost, are_compared=bool(results.comparisons))


def unsettled(checks: Mapping[str, Sequence[CheckRecord]], doubtful: Iterable[str], owner: str) -> list[OpenRecord]:
    """Return the checks that warn or are not made, and the mechanisms whose formulas have faults, as open items."""
    every = [(f"mechanisms.{name}.checks.{check.id}", check) for name, own in checks.items() for check in own]
    faults = phrase("the formulas of its plugin have faults")
    found: list[tuple[OpenKind, str, str]] = [("warning", f"mechanisms.{name}", faults) for name in doubtful]
    warns = [each for each in every if each[1].status == "warn" and each[1].check_class != SELF_TEST]
    found += [("warning", path, check.message) for path, check in warns]
    found += [("not_checked", path, check.message) for path, check in every if check.status == "not_checked"]
    return [OpenRecord(what=what, path=path, owner=owner, why=why) for what, path, why in found]


def _conclusion(found: SummaryRecord, total: int, lost: int, are_compared: bool) -> Phrase:
    """The one sentence that every command, page and file begins with."""
    parts, made = [*_left(found, lost)], found.passing + found.warn + found.fail
    left = keys_listed(parts) if parts else ""
    if found.fail:
        failed = Counted(found.fail, "{n} of {total} checks fails", "{n} of {total} checks fail", total=made)
        return Phrase("{failed}; {left}.", failed=failed, left=left) if left else Phrase("{failed}.", failed=failed)
    if lost:
        template = "{n} of {total} mechanisms were not calculated."
        if are_compared:
            template = "{n} of {total} mechanisms and comparisons were not calculated."
        return Phrase(template, n=lost, total=total)
    if not made:
        return Phrase("Nothing was checked, and {left}.", left=left) if left else phrase("There are no checks.")
    if left:
        return Phrase("No check fails, but {left}.", left=left)
    if accepted := len({each.path for each in found.accepted}) or (found.parts.accepted if found.parts else 0):
        one, many = (
            "All checks pass; {n} part is accepted without a rating.",
            "All checks pass; {n} parts are accepted without a rating.",
        )
        return Counted(accepted, one, many)
    return phrase("All checks pass.")


def _left(found: SummaryRecord, lost: int) -> Iterator[Phrase]:
    """How much of each kind is left open, and how many parts are not calculated."""
    if lost:
        yield Counted(lost, "{n} part is not calculated", "{n} parts are not calculated")
    count = Counter(each.what for each in found.open)
    for what, counted in LEFT.items():
        if what == "not_rated" and count[what]:
            yield from _unrated(found, counted)
        elif count[what]:
            yield counted(count[what])


def _unrated(found: SummaryRecord, counted: Callable[[int], Counted]) -> Iterator[Phrase]:
    """How many parts lack a rating, and how many bodies and joints a method; without parts, mechanisms whose forces nothing takes."""
    paths = [each.path for each in found.open if each.what == "not_rated"]
    if found.parts is None:
        n = len({tuple(path.split(".")[:2]) for path in paths})
        yield Counted(n, "parts of {n} mechanism are not modelled", "parts of {n} mechanisms are not modelled")
        return
    if lost := found.parts.not_rated:
        yield counted(lost)
    if (beyond := len(paths) - lost) > 0:
        yield Counted(beyond, "{n} body or joint has no method", "{n} bodies and joints have no method")
