"""What is told of a study that is tried before it is run: as lines for people, in the language that is spoken, and as plain data."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import localised, say, say_counted
from diecut_report.study.definition.optimise import Optimise
from diecut_report.study.execution.dry_run import DryRun, Measured, VariedColumn

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
    rows = [(each.path, _with_unit(localised(each.values), each), _first(each)) for each in found.varied]
    widths = [max(len(row[place]) for row in rows) for place in (0, 1)]
    head = say("variant {number}: ", number=found.first)
    for path, values, first in rows:
        yield f"{path:{widths[0]}}  {values:{widths[1]}}  {head}{first}".rstrip()


def _first(each: VariedColumn) -> str:
    return _with_unit(localised(f"{each.first:.6g}"), each) if isinstance(each.first, float) else each.first


def _with_unit(text: str, each: VariedColumn) -> str:
    return text if each.unit in ("", "1") else f"{text} {each.unit}"


def _taken(found: DryRun, measured: Measured) -> Iterator[str]:
    yield _calculated(measured)
    one = "time: {each} a variant, about {whole} in {n} process, without summary and reports"
    many = "time: {each} a variant, about {whole} in {n} processes, without summary and reports"
    yield say_counted(found.processes, one, many, each=_duration(measured.seconds), whole=_duration(found.seconds))
    yield say("disk: about {size}", size=_size(found.bytes_))
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


def _size(size: float) -> str:
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
