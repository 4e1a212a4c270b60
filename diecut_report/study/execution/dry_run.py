"""A study tried before it is run: how many variants it has, of what, and what time and room they take.

Sample and constraints are looked at without calculating; time and room are measured on a few variants.
"""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.mechanism.inputs import Quantity
from diecut_report.quantities.units import to_display
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.definition.study_file import Free, Optimise, Study
from diecut_report.study.definition.variables import RangeVariable
from diecut_report.study.execution.refusals import judged_rows
from diecut_report.study.execution.study_run import SMALL, described
from diecut_report.study.execution.worker import Chunk, Done, Values, calculate, judged
from diecut_report.study.storage.description import Description
from diecut_report.study.storage.parts import part_content, schema_of, table_of
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import localised, say, say_counted

LOOKED_AT, WINDOWS = 200_000, 20  # rows of the sample at most; in so many pieces where there are more
FEW, MORE, ENOUGH = 32, 256, 2.0  # variants that are measured, and seconds after which it is not measured further


@dataclass(frozen=True)
class VariedColumn:
    """Hold what a varied input is in the sample: its least and greatest value in the unit that people read, or its texts."""

    path: str
    unit: str
    low: float | None
    high: float | None
    texts: tuple[str, ...]
    first: float | str

    @property
    def values(self) -> str:
        """Return the range, or the texts."""
        return ", ".join(self.texts) if self.low is None else f"{self.low:.6g} … {self.high:.6g}"


@dataclass(frozen=True)
class Measured:
    """Hold what a few variants took: seconds and bytes for each further one and for a part file, and their verdicts."""

    variants: int
    statuses: Mapping[str, int]
    dropped: int  # by constraints on outputs
    seconds: float
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
    varied: tuple[VariedColumn, ...]
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
        """Return how long the variants take together."""
        return self.variants * self.measured.seconds / self.processes

    @property
    def bytes_(self) -> float:
        """Return how large the part files are together."""
        return self.variants * self.measured.bytes_ + self.parts * self.measured.bytes_of_part


def dry_run(study: Study) -> DryRun:
    """Look at a study whose constraints leave a variant, and calculate a few of its variants."""
    known = described(study)
    looked_at, dropped = 0, 0
    by: Counter[str] = Counter()
    columns = {path: _Extent(asked) for path, asked in study.inputs.items()}
    for start, stop in _windows(study.sample.count):
        given = study.sample.rows(start, stop)
        holds = judged(study, given, stop - start).holds
        looked_at, dropped = looked_at + stop - start, dropped + int(np.sum(~holds))
        by.update({each.text: int(np.sum(~each.holds(given))) for each in study.constraints if not each.outputs})
        for path, values in given.items():
            columns[path].see(values)
    searched = study.optimise.variables if study.optimise and not study.is_sampled else ()
    for variable in searched:  # through all of its range, of which the first generation takes some
        columns[variable.path].see(_ends(variable))
    first = _first(study)
    row = study.sample.rows(first, first + 1)
    varied = tuple(extent.column(path, row[path]) for path, extent in columns.items())
    names = [column.name for column in known.columns if column.name not in study.inputs]
    checks = sum(".checks." in name and name.endswith(".status") for name in names)
    quantities = sum(".checks." not in name for name in names)
    measured = _measured(study, known, first)
    return DryRun(
        study, study.sample.count, looked_at, dropped, by, varied, quantities, checks, known.parts, first, measured
    )


def _ends(variable: Free) -> Values:
    """Least and greatest value of a range, or all of a list."""
    if isinstance(variable, RangeVariable):
        return np.array([variable.low, variable.high])
    texts = [value for value in variable.values if isinstance(value, str)]
    return texts or np.array(variable.values)


def _windows(count: int) -> Iterator[tuple[int, int]]:
    """The pieces of a sample that are looked at: all of it, or of a large one some that lie evenly in it."""
    length = LOOKED_AT // WINDOWS
    starts = range(0, count, length) if count <= LOOKED_AT else np.linspace(0, count - length, WINDOWS, dtype=int)
    for start in starts:
        yield int(start), min(int(start) + length, count)


def _first(study: Study) -> int:
    """The number of the first variant that the constraints between inputs leave."""
    start = 0
    for found in judged_rows(study):
        if found.holds.any():
            return start + int(np.argmax(found.holds))
        start += len(found.holds)
    raise ValueError(phrase("the constraints leave no variant"))


class _Extent:
    """Sees which values an input has in a sample."""

    def __init__(self, asked: Input) -> None:
        self.unit = asked.meta.unit if isinstance(asked.meta, Quantity) else ""
        self.low, self.high = np.inf, -np.inf
        self.texts: dict[str, None] = {}

    def see(self, values: Values) -> None:
        """Take note of values, SI or texts."""
        if isinstance(values, np.ndarray) and self.unit:
            self.low, self.high = min(self.low, float(np.min(values))), max(self.high, float(np.max(values)))
        else:
            self.texts |= dict.fromkeys(map(str, values))

    def column(self, path: str, first: Values) -> VariedColumn:
        """Return what was seen, with the value of the first variant."""
        shown = to_display(float(first[0]), self.unit) if self.unit else str(first[0])
        if not self.unit:
            return VariedColumn(path, "", None, None, tuple(self.texts), shown)
        low, high = to_display(self.low, self.unit), to_display(self.high, self.unit)
        return VariedColumn(path, self.unit, low, high, (), shown)


def _measured(study: Study, known: Description, first: int) -> Measured:
    """Calculate one variant, a few and more of them, so that what they share is told from what each takes."""
    calculate(study, Chunk(0, first, first + 1))  # what is made once for all
    found: list[tuple[int, float, int]] = []
    for wanted in (FEW, MORE):
        stop = min(first + wanted, study.sample.count)
        began = time.process_time()
        done = calculate(study, Chunk(0, first, stop))
        seconds = time.process_time() - began
        kept = int(np.sum(judged(study, study.sample.rows(first, stop), stop - first).holds))
        found.append((kept, seconds, _size(known, done)))
        if seconds > ENOUGH or stop == study.sample.count:
            break
    statuses = Counter(map(str, done.columns["status"]))
    seconds_each, bytes_each, bytes_of_part = _rates(found)
    dropped = kept - len(done.columns["status"])
    return Measured(kept, statuses, dropped, seconds_each, bytes_each, bytes_of_part, tuple(done.slow), done.broken)


def _rates(found: list[tuple[int, float, int]]) -> tuple[float, float, float]:
    """Seconds and bytes of a further variant, and the bytes of a file without one."""
    (few, some_seconds, some_bytes), (many, seconds, size) = found[0], found[-1]
    if many == few:
        return seconds / max(many, 1), size / max(many, 1), 0.0
    slope, each = (seconds - some_seconds) / (many - few), max(size - some_bytes, 0) / (many - few)
    return (slope if slope > 0 else seconds / many), each, max(size - each * many, 0.0)


def _size(known: Description, done: Done) -> int:
    """The bytes of these variants as a part file."""
    columns = {name: values for name, values in done.columns.items() if name != "variant"}
    return len(part_content(table_of(schema_of(known), columns, np.asarray(done.columns["variant"], dtype=np.int64))))


# What is told of a study that is tried before it is run: as lines for people, in the language that is spoken, and as plain data.


VERDICTS = {
    "pass": phrase("{n} pass"),
    "warn": phrase("{n} warn"),
    "fail": phrase("{n} fail"),
    "error": phrase("{n} in error"),
}
SCALES = (
    (86_400, phrase("{n} d")),
    (3600, phrase("{n} h")),
    (60, phrase("{n} min")),
    (1, phrase("{n} s")),
    (1e-3, phrase("{n} ms")),
)
SIZES = ((1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1, "B"))


def lines(found: DryRun) -> Iterator[str]:
    """Yield what is known of a study, a line each; of one that only searches, what is searched for."""
    if found.study.optimise is not None and not found.study.is_sampled:
        yield from search_lines(found, found.study.optimise)
        return
    yield f"{found.study.file}: {_variants(found)}"
    yield from (f"  {line}" for line in _dropped(found))
    yield from (f"  {line}" for line in _varied(found))
    told = {
        "quantities": found.quantities,
        "checks": found.checks,
        "curves": len(found.study.curves),
        "parts": found.parts,
    }
    words = "of each variant: {quantities} quantities, {checks} checks, {curves} curves; part files: {parts}"
    yield "  " + say(words, **told)
    yield from (f"  {line}" for line in _taken(found, found.measured))


def search_lines(found: DryRun, asked: Optimise) -> Iterator[str]:
    """Yield what is known of a search: how far it goes, for what, through what, and how long it takes."""
    words = "a search through {n} machines, {population} in a generation"
    yield f"{found.study.file}: {say(words, n=asked.evaluations, population=asked.population)}"
    goals = [
        say("least {quantity}" if each.minimise else "greatest {quantity}", quantity=each.output)
        for each in asked.objectives
    ]
    yield "  " + say("searched for: {goals}", goals=", ".join(goals))
    if asked.is_passing:
        yield "  " + say("allowed are machines of which no check fails")
    else:
        yield "  " + say("allowed are also machines of which checks fail")
    yield from (f"  {line}" for line in _dropped(found))
    rows = [(each.path, _with_unit(localised(each.values), each)) for each in found.varied]
    width = max(len(path) for path, _ in rows)
    yield from (f"  {path:{width}}  {values}" for path, values in rows)
    told = {"quantities": found.quantities, "checks": found.checks, "curves": len(found.study.curves)}
    yield "  " + say("of each machine: {quantities} quantities, {checks} checks, {curves} curves", **told)
    yield f"  {_calculated(found.measured)}"
    words = "time: {each} a machine, about {whole} on one processor, without page and reports"
    seconds = found.measured.seconds
    yield "  " + say(words, each=_duration(seconds), whole=_duration(asked.evaluations * seconds))


def search_data(asked: Optimise) -> dict[str, Any]:
    """Return what is searched for as plain data."""
    return {
        "evaluations": asked.evaluations,
        "population": asked.population,
        "objectives": [{"minimise" if each.minimise else "maximise": each.output} for each in asked.objectives],
        "passing": asked.is_passing,
    }


def _variants(found: DryRun) -> str:
    if found.variants == found.rows and found.is_exact:
        return say_counted(found.rows, "{n} variant", "{n} variants")
    words = (
        "{rows} variants, of which the constraints leave {n}"
        if found.is_exact
        else "{rows} variants, of which the constraints leave about {n}"
    )
    return say(words, rows=found.rows, n=found.variants)


def _dropped(found: DryRun) -> Iterator[str]:
    """How much each constraint drops by itself; one on results is judged when variants are calculated."""
    for constraint in found.study.constraints:
        if constraint.outputs:
            yield say("{constraint}: judged by the results", constraint=constraint.text)
        else:
            share = localised(f"{100 * found.dropped_by[constraint.text] / max(found.looked_at, 1):.3g}")
            yield say("{constraint}: alone drops {share} %", constraint=constraint.text, share=share)


def _varied(found: DryRun) -> Iterator[str]:
    rows = [(each.path, _with_unit(localised(each.values), each), _dry_run_text_first(each)) for each in found.varied]
    widths = [max(len(row[place]) for row in rows) for place in (0, 1)]
    head = say("variant {number}: ", number=found.first)
    for path, values, first in rows:
        yield f"{path:{widths[0]}}  {values:{widths[1]}}  {head}{first}".rstrip()


def _dry_run_text_first(each: VariedColumn) -> str:
    return _with_unit(localised(f"{each.first:.6g}"), each) if isinstance(each.first, float) else each.first


def _with_unit(text: str, each: VariedColumn) -> str:
    return text if each.unit in ("", "1") else f"{text} {each.unit}"


def _taken(found: DryRun, measured: Measured) -> Iterator[str]:
    yield _calculated(measured)
    one = "time: {each} a variant, about {whole} in {n} process, without summary and reports"
    many = "time: {each} a variant, about {whole} in {n} processes, without summary and reports"
    yield say_counted(found.processes, one, many, each=_duration(measured.seconds), whole=_duration(found.seconds))
    yield say("disk: about {size}", size=_dry_run_text_size(found.bytes_))
    if found.study.optimise is not None:
        tried = found.study.optimise.evaluations
        words = "optimise tries {n} machines, which take one processor about {whole}"
        yield say(words, n=tried, whole=_duration(tried * measured.seconds))
    if measured.slow:
        yield say("calculated variant by variant, which is slow: {kinds}", kinds=", ".join(measured.slow))


def _calculated(measured: Measured) -> str:
    counts = [
        say(words, n=measured.statuses[status]) for status, words in VERDICTS.items() if measured.statuses.get(status)
    ]
    if measured.dropped:
        counts.append(say("{n} dropped by their results", n=measured.dropped))
    return say("calculated {n} to measure: {counts}", n=measured.variants, counts=", ".join(counts))


def _duration(seconds: float) -> str:
    scale, words = next(((scale, words) for scale, words in SCALES if seconds >= scale), SCALES[-1])
    return say(words, n=_rounded(seconds / scale))


def _dry_run_text_size(size: float) -> str:
    scale, name = next(((scale, name) for scale, name in SIZES if size >= scale), SIZES[-1])
    return f"{_rounded(size / scale)} {name}"


def _rounded(number: float) -> str:
    """Two digits: it is an estimate."""
    return localised(f"{number:.2g}" if number < 10 else f"{number:.0f}")


def data(found: DryRun) -> dict[str, Any]:
    """Return it as plain data."""
    varied = [
        {
            "path": each.path,
            "unit": each.unit,
            "low": each.low,
            "high": each.high,
            "texts": list(each.texts),
            "first": each.first,
        }
        for each in found.varied
    ]
    told: dict[str, Any] = {
        "rows": found.rows, "variants": found.variants, "exact": found.is_exact, "dropped_by": dict(found.dropped_by), "varied": varied,
        "quantities": found.quantities, "checks": found.checks, "curves": list(found.study.curves), "parts": found.parts,
    }  # fmt: skip
    taken = {
        "variants": found.measured.variants, "statuses": dict(found.measured.statuses), "dropped": found.measured.dropped,
        "seconds_each": found.measured.seconds, "slow": list(found.measured.slow), "processes": found.processes,
        "seconds": found.seconds, "bytes": round(found.bytes_),
    }  # fmt: skip
    if found.study.optimise is not None:
        told["optimise"] = search_data(found.study.optimise)
    return told | {"measured": taken}
