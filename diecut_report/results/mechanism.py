"""From a calculation to plain data: what the results file holds, and all that the report prints."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from decimal import Decimal
from typing import Any, get_args

import numpy as np

from diecut_report.config.source_hashes import plugin_code
from diecut_report.machine import mechanism as listings
from diecut_report.machine.calculation import Calculation, Unproven, declared_unit, unit_for
from diecut_report.machine.mechanism import intervals, period_of, phases_of, speed_of
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps import soundness
from diecut_report.machine.steps.soundness import NO_VALUE, require_whole
from diecut_report.mechanics.timing.intervals import Interval, composed
from diecut_report.mechanism.chapters import MISSING, Chapter
from diecut_report.mechanism.figures import Spectrum, SpectrumLine
from diecut_report.mechanism.inputs import list_titles
from diecut_report.mechanism.steps import (
    PREFIX,
    Crossings,
    Phase,
    Reduction,
    ResultName,
    SilentStep,
    Step,
    count_name,
    named,
    pattern,
    place_name,
    result_names,
)
from diecut_report.quantities.formatting import author_digits, place_shown, shown
from diecut_report.quantities.units import unit
from diecut_report.results.checks import applies, check_results, checks_of, missing_checks
from diecut_report.results.conclusion import RANK, SELF_TEST, cited_sources, counts, exports
from diecut_report.results.figure_views import figures
from diecut_report.results.mechanism_record import (
    AbsentPhaseRecord,
    AbsentRecord,
    CheckRecord,
    CurveRecord,
    ErratumRecord,
    MechanismRecord,
    PhaseRecord,
    QuantityRecord,
    SectionRecord,
    ShownIntervalRecord,
    ShownPhaseRecord,
)
from diecut_report.results.origins import GIVEN, Provenance, inputs
from diecut_report.results.record import Status
from diecut_report.text.phrases import Phrase, keys_listed, phrase

# Curves and spectra of a calculation.


Data = dict[str, Any]
Quantities = dict[str, QuantityRecord]


def curves(calc: Calculation) -> dict[str, CurveRecord]:
    """Return each curve at the samples of its abscissa, with its one-sided values at the breakpoints."""
    found: Data = {}
    for name, domain in calc.domains.items():
        step = calc.steps[name]
        found[name] = _curve(step, domain.samples[0], declared_unit(calc, name, step.unit))
        edges = np.unique(domain.joints[0])[1:-1]
        if len(edges):
            found[name]["breakpoints"] = edges.tolist()
    asked = {getattr(step, "of", "") for step in calc.steps.values()}
    for name, curve in calc.curves.items():
        if curve.output or name in asked:
            require_whole(calc, name)
        if curve.output:
            values = calc.curve_samples(name)[0]
            shown = _curve(curve, values, unit_for(calc, name, curve.unit, values))
            found[name] = shown | _limits(calc, name)
    for spectrum in calc.mechanism.spectra:
        found |= _spectrum(spectrum)
    return {name: CurveRecord(**each) for name, each in found.items()}


def _spectrum(spectrum: Spectrum) -> Data:
    own = {spectrum.id: _curve(spectrum, spectrum.values, spectrum.unit) | {"is_spectrum": True}}
    for line in spectrum.lines():
        own[line.id] = _curve(line, line.values, line.unit) | {"abscissa": spectrum.id, "is_spectrum": True}
    return own


def _curve(step: Step | SpectrumLine, values: Any, display: str) -> Data:
    if not np.isfinite(np.asarray(values, dtype=float)).all():
        raise Unproven(Phrase(NO_VALUE, description=step.description, id=step.id), step.at)
    return {"unit": unit(step.unit).si, "values": np.asarray(values, dtype=float).tolist(), "symbol": step.symbol,
            "description": step.description, "display_unit": display, "source": step.source,
            **({"source_symbol": step.source_symbol} if isinstance(step, Step) and step.source_symbol else {})}  # fmt: skip


def _limits(calc: Calculation, name: str) -> Data:
    """The values of a curve before and after each place between the smooth pieces of its abscissa at which it may jump."""
    axis, first = calc.axis[name], np.zeros(1, dtype=int)
    domain = calc.domains[axis]
    wide = domain.widths[0] > 1e-12 * domain.period[0, 0]
    starts, ends, middles = domain.edges[:1, :-1][:, wide], domain.edges[:1, 1:][:, wide], domain.middles[:1, wide]
    joint = (domain.is_joint(starts[:, 1:]) | domain.is_joint(ends[:, :-1]))[0]
    after = calc.kept("starts", axis, lambda _: (starts, middles), first)[name]
    before = calc.kept("ends", axis, lambda _: (ends, middles), first)[name]
    after, before = (np.broadcast_to(limits, starts.shape)[0] for limits in (after, before))
    return {"abscissa": axis, "breakpoints": starts[0, 1:][joint].tolist(), "left": before[:-1][joint].tolist(),
            "right": after[1:][joint].tolist()}  # fmt: skip


# Phases in the results: their intervals as numbers and as they are printed, and which there are not, and why.


MORE = range(3)  # digits beyond those that mean something


def phases(calc: Calculation) -> dict[str, PhaseRecord]:
    """Return each phase that the machine has: its role, the abscissa it runs over with its period, and its intervals, SI."""
    found: dict[str, PhaseRecord] = {}
    for name, step in phases_of(calc).items():
        held = intervals(calc, name)
        if held:
            axis = calc.steps[step.abscissa]
            display, more = declared_unit(calc, axis.id, axis.unit), _more_digits(calc, step.abscissa)
            speed = speed_of(calc, step.abscissa)
            times = [{"time": shown((end - start) / speed, "ms")["text"]} if speed else {} for start, end in held]
            texts = [
                ShownIntervalRecord(**_shown(each, display, more), **time)
                for each, time in zip(held, times, strict=True)
            ]
            found[name] = PhaseRecord(
                role=step.role, description=step.description, abscissa=step.abscissa, period=period_of(calc, step),
                unit=unit(axis.unit).si, intervals=[list(interval) for interval in held],
                display=ShownPhaseRecord(unit=display, intervals=texts),
            )  # fmt: skip
    sets = {
        name: frozenset((each.role, each.abscissa, *ends) for ends in each.intervals) for name, each in found.items()
    }
    whole = composed(sets)  # what is nothing but others together
    return {name: each.with_(parts=list(whole[name])) if name in whole else each for name, each in found.items()}


def _shown(interval: Interval, display: str, more: int) -> dict[str, str]:
    """An interval as texts: both ends and its length in the abscissa's unit."""
    start, end = interval
    texts = {"begin": start, "to": end, "length": end - start}
    return {key: place_shown(value, display, more)["text"] for key, value in texts.items()}


def _more_digits(calc: Calculation, abscissa: str) -> int:
    """With how many more digits all phases over an abscissa are shown, so that the printed ends give the printed lengths."""
    display = declared_unit(calc, abscissa, calc.steps[abscissa].unit)
    names = [name for name, step in phases_of(calc).items() if step.abscissa == abscissa]
    held = [interval for name in names for interval in intervals(calc, name)]

    def agree(told: dict[str, str]) -> bool:
        return Decimal(told["to"]) - Decimal(told["begin"]) == Decimal(told["length"])

    return next((more for more in MORE if all(agree(_shown(each, display, more)) for each in held)), 0)


def phases_absent(calc: Calculation) -> dict[str, AbsentPhaseRecord]:
    """Return each declared phase that the machine does not have: the keys that are missing, and the reason in words."""
    there = phases(calc)
    found: dict[str, AbsentPhaseRecord] = {}
    for chapter, step in calc.mechanism.steps:
        name = step.id.removeprefix(PREFIX)
        if not isinstance(step, Phase) or name in there:
            continue
        missing = [key for key in (*chapter.needs, *step.needs) if key not in calc.given]
        if name not in found or len(missing) < len(found[name].missing):
            words = "does not apply to this machine"
            words = Phrase("{keys} not given", keys=keys_listed(missing)) if missing else words
            found[name] = AbsentPhaseRecord(description=step.description, missing=missing, text=words)
    return found


class SelfTestFailed(Exception):
    """Report that the calculation contradicts itself, so that none of its numbers may be used; ``checks`` tell where."""

    def __init__(self, checks: list[CheckRecord]) -> None:
        told = " ".join(f"{check.title}: {check.message}" for check in checks)
        template = "The calculation contradicts itself, and its numbers must not be used. {told}"
        super().__init__(Phrase(template, told=told))
        self.checks = checks


Of = Callable[[Callable[[Calculation], Any]], Any]  # what a function makes of a calculation


def mechanism_results(calc: Calculation, provenance: Mapping[str, Provenance], of: Of | None = None) -> MechanismRecord:
    """Return the results of one machine's mechanism, as the contract names them; SelfTestFailed where they contradict themselves.

    ``of`` gives what a function makes of the calculation, where that is remembered.
    """
    mechanism = calc.mechanism
    made: Of = of or (lambda make: make(calc))
    checks = made(check_results)
    require_self_tests(checks)
    code: dict[str, Any] = plugin_code(mechanism)
    return MechanismRecord(
        kind=mechanism.kind,
        title=mechanism.title,
        plugin_version=mechanism.version,
        **code,
        status=worst(check.status for check in checks),
        summary=mechanism.summary,
        assumptions=list(mechanism.assumptions),
        sources=cited_sources(calc),
        inputs=inputs(calc, provenance),
        lists=list_titles(mechanism.inputs) | {name: calc.steps[name].description for name in calc.part_names},
        **made(numbers),
        listings=listings.results(calc),
        curves=made(curves),
        phases=phases(calc),
        phases_absent=phases_absent(calc),
        checks=checks,
        counts=counts(checks),
        warnings=[check.message for check in checks if check.status == "warn"],
        sections=made(sections),
        absent=absent(calc, provenance),
        figures=made(figures),
        exports=exports(calc),
        errata=list(errata(calc)),
    )


def sections(calc: Calculation) -> list[SectionRecord]:
    """Return the printed calculation."""
    return [SectionRecord(**each) for each in section_items(calc)]


def require_self_tests(checks: list[CheckRecord]) -> None:
    """Raise SelfTestFailed where the calculation contradicts itself."""
    if failed := [check for check in checks if check.check_class == SELF_TEST and check.status != "pass"]:
        raise SelfTestFailed(failed)


def errata(calc: Calculation) -> Iterator[ErratumRecord]:
    """Yield the mistakes of the sources that touch this machine: those whose quantities are all absent are left out."""
    for erratum in calc.mechanism.errata:
        touched = [calc.step_or_input(name).description for name in erratum.touches if _is_there(calc, name)]
        if touched or not erratum.touches:
            yield ErratumRecord(source=erratum.source, text=erratum.text, touches=touched)


def _is_there(calc: Calculation, name: str) -> bool:
    """Whether this machine has a quantity: a curve, an input, or a number that applies to it."""
    if name not in calc.values:
        return name in calc.curves or name in calc.domains or name in calc.inputs
    return any(isinstance(value, str) or not np.isnan(value) for value in calc.values[name][0])


IDLE = "not checked although {key} is given: the quantity it limits is not calculated"


def absent(calc: Calculation, provenance: Mapping[str, Provenance]) -> list[AbsentRecord]:
    """Return what is not calculated, and checks for which a limit is given that nothing can be held against, in words."""
    unmade = [s for s in calc.mechanism.chapters if not calc.given.issuperset(s.needs)]
    reasons = [(s.title, soundness.unmet(calc, s.needs) or _why(calc, s)) for s in unmade]
    checks = checks_of(calc)
    made = {check.id for check in checks if applies(calc, check) or missing_checks(calc, check)}
    used = {check.limit for check in checks if check.id in made}
    for check in checks:
        limit = str(check.limit)  # is it an input that is there, and not by its default alone?
        is_given = (
            limit in calc.inputs and limit not in calc.values and provenance.get(limit, GIVEN).origin != "default"
        )
        if is_given and check.id not in made and check.limit not in used:
            reasons.append((check.title, Phrase(IDLE, key=check.limit)))
    return [AbsentRecord(title=title, text=words) for title, words in reasons if words]


def _why(calc: Calculation, chapter: Chapter) -> str:
    """What is said of a chapter that is left out, with the keys that are not given where it names them."""
    if MISSING not in chapter.absent:
        return chapter.absent
    keys = [key for key in chapter.needs if key not in calc.given]
    return Phrase(chapter.absent, missing=keys_listed(keys))


def worst(statuses: Iterable[str]) -> Status:
    """Return the worst of statuses; pass where there are none. What is not checked changes nothing."""
    known = set(statuses) & RANK.keys()
    return max((status for status in get_args(Status) if status in known), key=RANK.__getitem__, default="pass")


def numbers(calc: Calculation) -> dict[str, Quantities]:
    """Return outputs and intermediate values: each step's number, with the place where an extreme occurs."""
    groups: dict[bool, Quantities] = {True: {}, False: {}}
    for step in calc.steps.values():
        groups[step.output] |= _numbers_of(calc, step)
    return {"outputs": _with_keys(calc, groups[True]), "values": groups[False]}


def key_outputs(calc: Calculation) -> Quantities:
    """Return of the outputs those that tell most, in their order."""
    asked = {each.id for name in calc.mechanism.key_results if (each := named(name, calc.steps))}
    steps = (step for step in calc.steps.values() if step.id in asked and step.output)
    found = _with_keys(calc, {name: each for step in steps for name, each in _numbers_of(calc, step).items()})
    return {name: each for name, each in found.items() if each.key}


def _with_keys(calc: Calculation, outputs: Quantities) -> Quantities:
    return outputs | {name: outputs[name].with_(key=True) for name in calc.mechanism.key_results if name in outputs}


def _numbers_of(calc: Calculation, step: Step) -> Quantities:
    """The numbers that a step gives."""
    if step.id not in calc.values or isinstance(step, SilentStep):
        return {}
    found = _listed(calc, step) if isinstance(step, Crossings) else _rowed(calc, step)
    return {name: QuantityRecord(**each) for name, each in found.items()}


def _rowed(calc: Calculation, step: Step) -> Data:
    row = calc[step.id][0]
    if step.id in calc.axis:
        home = {} if step.numbered else {"list": calc.axis[step.id]}
        names = result_names(step, len(row), calc.inputs.get(step.named_by))
        there = [(each, value) for each, value in zip(names, row, strict=True) if value == value]  # no NaN
        display = _row_unit(calc, step, [value for _, value in there])
        return {each.name: _number(step, value, display) | home | _part(step, each, **home) for each, value in there}
    if not isinstance(row[0], str) and math.isnan(row[0]):
        return {}
    found = _number(step, row[0], _row_unit(calc, step, row[:1]))
    if isinstance(step, Reduction) and step.is_extreme:
        axis = calc.steps[calc.axis[step.of]]
        value = float(calc[place_name(step.id)][0, 0])
        found["at"] = {"symbol": axis.symbol, "value": value}
        found["at"] |= place_shown(value, declared_unit(calc, axis.id, axis.unit))
    return {step.id: found}


def _row_unit(calc: Calculation, step: Step, values: Any) -> str:
    """The unit of a row: that of a table's column, in which its greatest value is easy to read."""
    is_text = any(isinstance(value, str | bool | np.bool_) for value in values)
    return step.unit if is_text else unit_for(calc, step.id, step.unit, values)


def _listed(calc: Calculation, step: Crossings) -> Data:
    places = [x for x in calc[step.id][0] if not math.isnan(x)]
    count = {"value": len(places), "unit": "1", "symbol": "", "description": Phrase("{title}: how many", title=phrase(step.description)),
             "source": step.source, "display": {"text": str(len(places)), "unit": "1"}}  # fmt: skip
    _, *names = result_names(step, len(places))
    display = _row_unit(calc, step, places)
    rows = {each.name: _number(step, places[each.index], display) | _part(step, each) for each in names}
    return {count_name(step.id): count} | rows


def _part(step: Step, each: ResultName, list: str = "") -> Data:
    """Return which of repeated parts a result is of: of a list, or of a family that the names number."""
    if list:
        return {"part": {"family": list, "index": each.index, "quantity": step.id}}
    made = pattern(step)
    part = {"family": made.family, "index": each.index}
    part |= {} if made.is_path else {"number": each.number}
    return {"part": part | ({"quantity": made.quantity} if made.quantity else {})}


def _number(step: Step, value: Any, display: str) -> Data:
    said = {"symbol": step.symbol, "description": step.description, "source": step.source}
    said |= {"source_symbol": step.source_symbol} if step.source_symbol else {}
    if isinstance(value, str):
        return {"value": value, "unit": "1"} | said | {"display": {"text": value, "unit": "1"}}
    if isinstance(value, bool | np.bool_):
        return {"value": bool(value), "unit": "1"} | said | {"display": {"text": "yes" if value else "no", "unit": "1"}}
    digits = author_digits(float(value), display, step.digits)
    text = shown(float(value), display, digits, unit(step.unit).to_si(step.shown_to))
    return (
        {"value": round(value) if step.whole else float(value), "unit": unit(step.unit).si} | said | {"display": text}
    )
