"""A study tried before it is run: how many variants it has, of what, and what time and room they take.

Sample and constraints are looked at without calculating; time and room are measured on a few variants.
"""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.quantities.units import to_display
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.definition.samples import RangeVariable, Values
from diecut_report.study.definition.study_file import Optimise, Study
from diecut_report.study.execution.study_run import SMALL, described
from diecut_report.study.execution.worker import Chunk, Done, calculate, judged, judged_rows
from diecut_report.study.storage.description import JUDGED, Description
from diecut_report.study.storage.store import part_content, schema_of, table_of
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import localised, say, say_counted

LOOKED_AT, WINDOWS = 200_000, 20  # rows of the sample at most; in so many pieces where there are more
FEW, MORE, ENOUGH = 32, 256, 2.0  # variants that are measured, and seconds after which it is not measured further


@dataclass(frozen=True)
class Measured:
    """Hold what a few variants took: seconds and bytes for each further one and for a part file, and their verdicts.

    ``seconds_once`` is what a process takes before it calculates.
    """

    variants: int
    statuses: Mapping[str, int]
    dropped: int  # by constraints on outputs
    seconds: float
    seconds_of_part: float
    seconds_once: float
    bytes_: float
    bytes_of_part: float
    slow: tuple[str, ...]
    broken: Mapping[str, str]


@dataclass(frozen=True)
class DryRun:
    """Hold what is known of a study before it is run. ``looked_at`` rows of ``rows`` tell what the constraints between inputs drop."""

    study: Study
    rows: int
    looked_at: int
    dropped: int
    dropped_by: Mapping[str, int]
    varied: list[dict[str, Any]]
    quantities: int
    checks: int
    parts: int
    first: int
    measured: Measured

    @property
    def is_exact(self) -> bool:
        """Return whether all rows were looked at."""
        return self.looked_at == self.rows

    @property
    def variants(self) -> int:
        """Return how many variants the constraints between inputs leave; an estimate where not all rows were looked at."""
        return round(self.rows * (1 - self.dropped / max(self.looked_at, 1)))

    @property
    def processes(self) -> int:
        """Return in how many processes a run calculates by itself."""
        return min(os.cpu_count() or 1, self.parts) if self.rows > SMALL else 1

    @property
    def seconds(self) -> float:
        """Return how long the variants take together, with what each process and each part file takes once."""
        found, parts_of_one = self.measured, -(-self.parts // self.processes)
        each = self.variants * found.seconds / self.processes
        return found.seconds_once + parts_of_one * found.seconds_of_part + each

    @property
    def bytes_(self) -> float:
        """Return how large the part files are together."""
        return self.variants * self.measured.bytes_ + self.parts * self.measured.bytes_of_part


def dry_run(study: Study) -> DryRun:
    """Look at a study whose constraints leave a variant, and calculate a few of its variants."""
    known, first = described(study), _first(study)
    looked_at, dropped, by = 0, 0, Counter[str]()
    seen = {path: [values] for path, values in study.sample.rows(first, first + 1).items()}
    for start, stop in _windows(study.sample.count):
        given = study.sample.rows(start, stop)
        holds = judged(study, given, stop - start).holds
        looked_at, dropped = looked_at + stop - start, dropped + int(np.sum(~holds))
        by.update({each.text: int(np.sum(~each.judged(given).holds)) for each in study.constraints if not each.outputs})
        for path, values in given.items():
            seen[path].append(values)
    searched = study.optimise.variables if study.optimise and not study.is_sampled else ()
    for variable in searched:  # through all of its range, of which the first generation takes some
        ends = (variable.low, variable.high) if isinstance(variable, RangeVariable) else variable.values
        seen[variable.path].append(np.array(ends))
    names = [column.name for column in known.columns if column.name not in study.inputs]
    checks = sum(".checks." in name and name.endswith(".status") for name in names)
    quantities = sum(".checks." not in name and name != JUDGED.name for name in names)
    varied = [_varied_data(asked, seen[path]) for path, asked in study.inputs.items()]
    return DryRun(study, study.sample.count, looked_at, dropped, by, varied, quantities, checks, known.parts, first,
                  _measured(study, known, first))  # fmt: skip


def _varied_data(asked: Input, seen: Sequence[Values]) -> dict[str, Any]:
    """Return what an input is in the sample: its least and greatest value, or its texts; and that of the first variant, seen first."""
    (first, *_), *given = seen
    unit = asked.display
    if not unit:
        texts = list(dict.fromkeys(str(value) for values in given for value in values))
        return {"path": asked.path, "unit": unit, "texts": texts, "low": None, "high": None, "first": str(first)}
    numbers = {"low": min(map(np.min, given)), "high": max(map(np.max, given)), "first": first}
    shown = {name: to_display(float(value), unit) for name, value in numbers.items()}
    return {"path": asked.path, "unit": unit, "texts": [], **shown}


def _windows(count: int) -> Iterator[tuple[int, int]]:
    """Yield the pieces of a sample that are looked at: all of it, or of a large one some that lie evenly in it."""
    length = LOOKED_AT // WINDOWS
    starts = range(0, count, length) if count <= LOOKED_AT else np.linspace(0, count - length, WINDOWS, dtype=int)
    for start in starts:
        yield int(start), min(int(start) + length, count)


def _first(study: Study) -> int:
    start = 0
    for found in judged_rows(study):
        if found.holds.any():
            return start + int(np.argmax(found.holds))
        start += len(found.holds)
    raise ValueError(phrase("no variant satisfies the constraints"))


def _measured(study: Study, known: Description, first: int) -> Measured:
    """Calculate one variant, a few and more of them, so that what they share is told from what each takes.

    None is calculated twice where there are enough: a second time takes less.
    """
    calculate(study, Chunk(0, first, first + 1))  # what is made once for all
    once, start = time.process_time(), first
    found, windows = list[tuple[int, float, int]](), list[tuple[int, Done]]()
    for wanted in (FEW, MORE):
        start = start if start + wanted <= study.sample.count else first
        stop = min(start + wanted, study.sample.count)
        began = time.process_time()
        done = calculate(study, Chunk(0, start, stop))
        seconds = time.process_time() - began
        kept = int(np.sum(judged(study, study.sample.rows(start, stop), stop - start).holds))
        table = table_of(schema_of(known), done.columns, len(done.columns["variant"]))
        found.append((kept, seconds, len(part_content(table))))
        windows = [*windows, (kept, done)] if start > first else [(kept, done)]
        if seconds > ENOUGH or stop == study.sample.count:
            break
        start = stop
    kept = sum(own for own, _ in windows)
    statuses = Counter(str(each) for _, done in windows for each in done.columns["status"])
    slow = dict.fromkeys(name for _, done in windows for name in done.slow)
    broken = {name: why for _, done in windows for name, why in done.broken.items()}
    return Measured(kept, statuses, kept - statuses.total(), *_rates(sorted(found), once), tuple(slow), broken)


def _rates(found: list[tuple[int, float, int]], once: float) -> tuple[float, float, float, float, float]:
    """Return seconds of a further variant, of a part file without one and of a process, bytes of a further variant and of a file."""
    (few, some_seconds, some_bytes), (many, seconds, size) = found[0], found[-1]
    if many == few:
        return seconds / max(many, 1), 0.0, once, size / max(many, 1), 0.0
    slope, each = (seconds - some_seconds) / (many - few), max(size - some_bytes, 0) / (many - few)
    slope = slope if slope > 0 else seconds / many
    return slope, max(seconds - slope * many, 0.0), once, each, max(size - each * many, 0.0)


# --- as lines for people, in the language that is spoken, and as plain data --------------------------------------------

VERDICTS = {
    "pass": phrase("{n} pass"), "warn": phrase("{n} warn"), "fail": phrase("{n} fail"), "error": phrase("{n} in error"),
}  # fmt: skip
DURATIONS = (
    (86_400, phrase("{n} d")), (3600, phrase("{n} h")), (60, phrase("{n} min")), (1, phrase("{n} s")), (1e-3, phrase("{n} ms")),
)  # fmt: skip
SIZES = ((1e9, "{n} GB"), (1e6, "{n} MB"), (1e3, "{n} kB"), (1, "{n} B"))


def lines(found: DryRun) -> Iterator[str]:
    """Yield what is known of a study, a line each; of one that only searches, what is searched for."""
    asked = found.study.optimise
    if asked is not None and not found.study.is_sampled:
        first, *rest = _search_lines(found, asked)
    else:
        first, *rest = _study_lines(found)
    yield f"{found.study.tree.file}: {first}"
    yield from (f"  {line}" for line in rest)


def _study_lines(found: DryRun) -> Iterator[str]:
    if found.variants == found.rows and found.is_exact:
        yield say_counted(found.rows, "{n} variant", "{n} variants")
    else:
        exact = "{rows} variants, {n} of which satisfy the constraints"
        about = "{rows} variants, about {n} of which satisfy the constraints"
        yield say(exact if found.is_exact else about, rows=found.rows, n=found.variants)
    yield from _dropped(found)
    yield from _varied(found, say("variant {number}: ", number=found.first))
    template = "of each variant: {quantities} quantities, {checks} checks, {curves} curves; part files: {parts}"
    counts = {"quantities": found.quantities, "checks": found.checks, "curves": len(found.study.curves)}
    yield say(template, **counts, parts=found.parts)
    yield _calculated(found.measured)
    one = "time: {each} per variant, about {whole} in {n} process, excluding summary and reports"
    many = "time: {each} per variant, about {whole} in {n} processes, excluding summary and reports"
    each, whole = _scaled(found.measured.seconds, DURATIONS), _scaled(found.seconds, DURATIONS)
    yield say_counted(found.processes, one, many, each=each, whole=whole)
    yield say("disk: about {size}", size=_scaled(found.bytes_, SIZES))
    if found.study.optimise is not None:
        tried = found.study.optimise.evaluations
        template = "optimise tries {n} machines, which take one processor about {whole}"
        yield say(template, n=tried, whole=_scaled(tried * found.measured.seconds, DURATIONS))
    if found.measured.slow:
        yield say("calculated variant by variant, which is slow: {kinds}", kinds=", ".join(found.measured.slow))


def _search_lines(found: DryRun, asked: Optimise) -> Iterator[str]:
    template = "a search over {n} machines, {population} per generation"
    yield say(template, n=asked.evaluations, population=asked.population)
    ways = {True: "{quantity} minimised", False: "{quantity} maximised"}
    goals = (say(ways[each.minimise], quantity=each.output) for each in asked.objectives)
    yield say("searched for: {goals}", goals=", ".join(goals))
    passing = "feasible: machines with no failing check"
    failing = "feasible: also machines with failing checks"
    yield say(passing if asked.is_passing else failing)
    yield from _dropped(found)
    yield from _varied(found, "")
    template = "of each machine: {quantities} quantities, {checks} checks, {curves} curves"
    yield say(template, quantities=found.quantities, checks=found.checks, curves=len(found.study.curves))
    yield _calculated(found.measured)
    template = "time: {each} per machine, about {whole} on one processor, excluding page and reports"
    seconds = found.measured.seconds
    yield say(template, each=_scaled(seconds, DURATIONS), whole=_scaled(asked.evaluations * seconds, DURATIONS))


def _dropped(found: DryRun) -> Iterator[str]:
    """Yield how much each constraint drops by itself; one on results is judged when variants are calculated."""
    for constraint in found.study.constraints:
        if constraint.outputs:
            yield say("{constraint}: evaluated on the results", constraint=constraint.text)
        else:
            share = localised(f"{100 * found.dropped_by[constraint.text] / max(found.looked_at, 1):.3g}")
            yield say("{constraint}: excludes {share} % on its own", constraint=constraint.text, share=share)


def _varied(found: DryRun, head: str) -> Iterator[str]:
    rows = []
    for each in found.varied:
        unit = "" if each["unit"] in ("", "1") else f" {each['unit']}"
        values = ", ".join(each["texts"]) if each["low"] is None else f"{each['low']:.6g} … {each['high']:.6g}"
        first = localised(f"{each['first']:.6g}") if each["unit"] else each["first"]
        rows.append((each["path"], f"{localised(values)}{unit}", f"{head}{first}{unit}" if head else ""))
    widths = [max(len(row[place]) for row in rows) for place in (0, 1)]
    for path, text, shown in rows:
        yield f"{path:{widths[0]}}  {text:{widths[1]}}  {shown}".rstrip()


def _calculated(measured: Measured) -> str:
    counts = [say(words, n=count) for status, words in VERDICTS.items() if (count := measured.statuses.get(status))]
    if measured.dropped:
        counts.append(say("{n} excluded by their results", n=measured.dropped))
    return say("calculated {n} to measure: {counts}", n=measured.variants, counts=", ".join(counts))


def _scaled(value: float, scales: tuple[tuple[float, str], ...]) -> str:
    scale, words = next((each for each in scales if value >= each[0]), scales[-1])
    number = value / scale
    return say(words, n=localised(f"{number:.2g}" if number < 10 else f"{number:.0f}"))


def data(found: DryRun) -> dict[str, Any]:
    measured, asked = found.measured, found.study.optimise
    made: dict[str, Any] = {
        "rows": found.rows, "variants": found.variants, "exact": found.is_exact, "dropped_by": dict(found.dropped_by),
        "varied": found.varied, "quantities": found.quantities, "checks": found.checks, "curves": list(found.study.curves),
        "parts": found.parts,
    }  # fmt: skip
    if asked is not None:
        objectives = [{"minimise" if each.minimise else "maximise": each.output} for each in asked.objectives]
        made["optimise"] = {"evaluations": asked.evaluations, "population": asked.population, "objectives": objectives,
                            "passing": asked.is_passing}  # fmt: skip
    made["measured"] = {
        "variants": measured.variants, "statuses": dict(measured.statuses), "dropped": measured.dropped,
        "seconds_each": measured.seconds, "slow": list(measured.slow), "processes": found.processes,
        "seconds": found.seconds, "bytes": round(found.bytes_),
    }  # fmt: skip
    return made
