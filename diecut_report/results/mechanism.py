"""From a calculation to plain data: what the results file holds, and all that the report prints."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from diecut_report.config.source_hashes import plugin_code
from diecut_report.contract.chapters import MISSING, Chapter
from diecut_report.contract.input_lists import list_titles
from diecut_report.contract.result_names import ResultName, count_name, named, pattern, place_name, result_names
from diecut_report.contract.steps import SILENT, Crossings, Step
from diecut_report.engine import Calculation, listings
from diecut_report.engine.figure_views import figures
from diecut_report.engine.printing.items import section_items
from diecut_report.engine.shown_units import declared_unit, unit_for
from diecut_report.engine.steps import facts
from diecut_report.languages.phrases import Phrase, keys_listed, phrase
from diecut_report.quantities.formatting import author_digits, place_shown, shown
from diecut_report.quantities.units import unit
from diecut_report.results.checks import applies, check_results, checks_of
from diecut_report.results.cited_sources import cited_sources
from diecut_report.results.curves import curves
from diecut_report.results.exports import exports
from diecut_report.results.phases import phases, phases_absent
from diecut_report.results.stated_inputs import GIVEN, Provenance, inputs
from diecut_report.results.summary import RANK, counts, failed_self_tests
from diecut_report.results.unchecked import missing

Data = dict[str, Any]


class SelfTestFailed(Exception):
    """Report that the calculation contradicts itself, so that none of its numbers may be used; ``checks`` tell where."""

    def __init__(self, checks: list[Data]) -> None:
        told = " ".join(f"{check['title']}: {check['message']}" for check in checks)
        super().__init__(
            Phrase("The calculation contradicts itself, and its numbers must not be used. {told}", told=told)
        )
        self.checks = checks


Of = Callable[[Callable[[Calculation], Any]], Any]  # what a function makes of a calculation


def mechanism_results(calc: Calculation, provenance: Mapping[str, Provenance], of: Of | None = None) -> Data:
    """Return the results of one machine's mechanism, as the contract names them; SelfTestFailed where they contradict themselves.

    ``of`` gives what a function makes of the calculation, where that is remembered.
    """
    mechanism = calc.mechanism
    made: Of = of or (lambda make: make(calc))
    checks = made(check_results)
    require_self_tests(checks)
    return {
        "kind": mechanism.kind,
        "title": mechanism.title,
        "plugin_version": mechanism.version,
        **plugin_code(mechanism),
        "status": worst(check["status"] for check in checks),
        "summary": mechanism.summary,
        "assumptions": list(mechanism.assumptions),
        "sources": cited_sources(calc),
        "inputs": inputs(calc, provenance),
        "lists": list_titles(mechanism.inputs) | {name: calc.steps[name].description for name in calc.part_names},
        **made(numbers),
        **listings.results(calc),
        "curves": made(curves),
        "phases": phases(calc),
        "phases_absent": phases_absent(calc),
        "checks": checks,
        "counts": counts(checks),
        "warnings": [c["message"] for c in checks if c["status"] == "warn"],
        "sections": made(section_items),
        "absent": absent(calc, provenance),
        "figures": made(figures),
        "exports": exports(calc),
        "errata": list(errata(calc)),
    }


def require_self_tests(checks: list[Data]) -> None:
    """Raise SelfTestFailed where the calculation contradicts itself."""
    if failed := failed_self_tests(checks):
        raise SelfTestFailed(failed)


def errata(calc: Calculation) -> Iterator[Data]:
    """Yield the mistakes of the sources that touch this machine: those whose quantities are all absent are left out."""
    for erratum in calc.mechanism.errata:
        touched = [calc.step_or_input(name).description for name in erratum.touches if _is_there(calc, name)]
        if touched or not erratum.touches:
            yield {"source": erratum.source, "text": erratum.text, "touches": touched}


def _is_there(calc: Calculation, name: str) -> bool:
    """Whether this machine has a quantity: a curve, an input, or a number that applies to it."""
    if name not in calc.values:
        return name in calc.curves or name in calc.domains or name in calc.inputs
    return any(isinstance(value, str) or not np.isnan(value) for value in calc.values[name][0])


IDLE = "not checked, though {key} is given: what it limits is not calculated"


def absent(calc: Calculation, provenance: Mapping[str, Provenance]) -> list[Data]:
    """Return what is not calculated, and checks for which a limit is given that nothing can be held against, in words."""
    unmade = [s for s in calc.mechanism.chapters if not calc.given.issuperset(s.needs)]
    left_out = [
        {"title": s.title, "text": words} for s in unmade if (words := facts.unmet(calc, s.needs) or _why(calc, s))
    ]
    checks = checks_of(calc)
    made = {check.id for check in checks if applies(calc, check) or missing(calc, check)}
    used = {check.limit for check in checks if check.id in made}
    idle = [
        {"title": c.title, "text": Phrase(IDLE, key=c.limit)}
        for c in checks
        if _is_limit_given(calc, str(c.limit), provenance) and c.id not in made and c.limit not in used
    ]
    return left_out + idle


def _why(calc: Calculation, chapter: Chapter) -> str:
    """What is said of a chapter that is left out, with the keys that are not given where it names them."""
    if MISSING not in chapter.absent:
        return chapter.absent
    keys = [key for key in chapter.needs if key not in calc.given]
    return Phrase(chapter.absent, missing=keys_listed(keys))


def _is_limit_given(calc: Calculation, name: str, provenance: Mapping[str, Provenance]) -> bool:
    """Whether a limit is an input that is there, and not by its default alone."""
    return name in calc.inputs and name not in calc.values and provenance.get(name, GIVEN).origin != "default"


def worst(statuses: Any) -> str:
    """Return the worst of statuses; pass where there are none. What is not checked changes nothing."""
    return max((status for status in statuses if status in RANK), key=RANK.__getitem__, default="pass")


def numbers(calc: Calculation) -> Data:
    """Return outputs and intermediate values: each step's number, with the place where an extreme occurs."""
    groups: dict[bool, Data] = {True: {}, False: {}}
    for step in calc.steps.values():
        groups[step.output] |= _numbers_of(calc, step)
    return {"outputs": _with_keys(calc, groups[True]), "values": groups[False]}


def key_outputs(calc: Calculation) -> Data:
    """Return of the outputs those that tell most, in their order."""
    asked = {each.id for name in calc.mechanism.key_results if (each := named(name, calc.steps))}
    steps = (step for step in calc.steps.values() if step.id in asked and step.output)
    found = _with_keys(calc, {name: each for step in steps for name, each in _numbers_of(calc, step).items()})
    return {name: each for name, each in found.items() if "key" in each}


def _with_keys(calc: Calculation, outputs: Data) -> Data:
    for name in calc.mechanism.key_results:
        if name in outputs:
            outputs[name]["key"] = True
    return outputs


def _numbers_of(calc: Calculation, step: Step) -> Data:
    """The numbers that a step gives."""
    if step.id not in calc.values or isinstance(step, SILENT):
        return {}
    return _listed(calc, step) if isinstance(step, Crossings) else _rowed(calc, step)


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
    place = place_name(step.id)
    if place in calc.values:
        axis = calc.steps[calc.axis[step.of]]  # type: ignore[attr-defined]
        value = float(calc[place][0, 0])
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
    return (
        {"value": round(value) if step.whole else float(value), "unit": unit(step.unit).si}
        | said
        | {"display": shown(float(value), display, author_digits(float(value), display, step.digits))}
    )
