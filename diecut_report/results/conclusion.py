"""The first line on a machine: what fails, and what is left open; that all checks pass only where nothing is."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

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
from diecut_report.results.model import GoverningRecord, ResultsRecord, SummaryRecord
from diecut_report.text.phrases import Counted, Phrase, joined, phrase

# The sources of a machine: a plugin's own, but those that only steps and checks name which this machine does not have.


def cited_sources(calc: Calculation) -> list[SourceRecord]:
    """Return the works that the calculation rests on; papers, which are numbered, and what no step names, always."""
    mechanism = calc.mechanism
    every = {step.source for _, step in mechanism.steps} | {check.source for check in mechanism.checks}
    used = {mechanism.summary, *mechanism.assumptions}
    used |= {check.source for check in checks_of(calc) if applies(calc, check)}
    for chapter, step in mechanism.active(calc.given):
        used |= {chapter.text, step.source, step.description, getattr(step, "method", "")}

    def is_cited(source: Source) -> bool:
        return source.id.isdigit() or _is_named(source, used) or not _is_named(source, every)

    return [SourceRecord(id=source.id, citation=source.citation) for source in mechanism.sources if is_cited(source)]


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


def failed_self_tests(checks: Iterable[CheckRecord]) -> list[CheckRecord]:
    """Return the self-tests of the calculation that do not hold."""
    return [check for check in checks if check.check_class == SELF_TEST and check.status != "pass"]


def summary(checks: Mapping[str, Sequence[CheckRecord]], assumed: Sequence[str]) -> SummaryRecord:
    """Return the whole's verdict from the checks of each mechanism and the paths of assumed inputs; the first line is added later."""
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


class Open(NamedTuple):
    """Hold what the first line on a machine follows from: its counts, how many parts it has, how many of them were not calculated.

    ``are_compared`` says that some of the parts are comparisons, ``is_doubtful`` that the formulas of a plugin have faults.
    """

    summary: SummaryRecord
    parts: int
    lost: int = 0
    are_compared: bool = False
    is_doubtful: bool = False

    def conclusion(self) -> Phrase:
        """Return the one sentence that every command, page and file begins with."""
        found, left = self.summary, _listed(list(self.left()))
        made = found.passing + found.warn + found.fail
        if found.fail:
            failed = Counted(found.fail, "{n} of {total} checks fails", "{n} of {total} checks fail", total=made)
            return Phrase("{failed}; {left}.", failed=failed, left=left) if left else Phrase("{failed}.", failed=failed)
        if self.lost:
            template = "{n} of {total} mechanisms were not calculated."
            if self.are_compared:
                template = "{n} of {total} mechanisms and comparisons were not calculated."
            return Phrase(template, n=self.lost, total=self.parts)
        if not made:
            return Phrase("Nothing was checked, and {left}.", left=left) if found.not_checked else phrase("There are no checks.")  # fmt: skip
        return Phrase("No check fails, but {left}.", left=left) if left else phrase("All checks pass.")

    def left(self) -> Iterator[Phrase]:
        """Yield what is left open."""
        found = self.summary
        if self.lost:
            yield Counted(self.lost, "{n} part is not calculated", "{n} parts are not calculated")
        if found.warn:
            yield Counted(found.warn, "{n} warns", "{n} warn")
        if found.not_checked:
            yield Counted(found.not_checked, "{n} is not checked", "{n} are not checked")
        if count := len(found.assumed):
            yield Counted(count, "{n} value is assumed", "{n} values are assumed")
        if self.is_doubtful:
            yield phrase("formulas of a plugin have faults")

    @property
    def is_open(self) -> bool:
        """Return whether a machine of which no check fails is not proved all the same: it may not carry a tick."""
        return any(True for _ in self.left())


def open_of(results: ResultsRecord) -> Open:
    """Return what is left open of a machine."""
    parts = results.calculated.values()
    lost, doubtful = sum(bool(each.error) for each in parts), any(each.is_doubtful for each in parts)
    return Open(results.summary, len(parts), lost, bool(results.comparisons), doubtful)


def conclusion(results: ResultsRecord) -> Phrase:
    """Return the one sentence that every command, page and file begins with."""
    return open_of(results).conclusion()


def is_open(results: ResultsRecord) -> bool:
    """Return whether a machine of which no check fails is not proved all the same."""
    return open_of(results).is_open


def _listed(parts: list[Phrase]) -> str:
    *most, last = parts or [phrase("")]
    return Phrase("{first} and {next}", first=joined(most, ", "), next=last) if most else last
