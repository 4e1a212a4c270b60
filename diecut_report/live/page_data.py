"""What a live page gets of a session, as plain data: verdict, faults, and of each mechanism its inputs, checks and key numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.config.model import PRESS
from diecut_report.design.design_choices import DesignChoice
from diecut_report.design.design_inputs import DesignInput
from diecut_report.errors import Problem
from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import localised, said
from diecut_report.live.session import LiveMachine, LiveSession
from diecut_report.quantities.plausible import plausible
from diecut_report.quantities.units import unit
from diecut_report.report.number_format import quantity, tidy

Data = dict[str, Any]
TOLD = 20  # faults that the page shows
REACH = 0.5  # of its size, to each side of a value: where a slider ends unless the input ends before
WHOLE_REACH = 10  # to each side of a whole number
STEPS = 200  # of a slider


def page_data(session: LiveSession) -> Data:
    """Return all that the page shows but figures and effects."""
    machine, start = session.machine, session.start
    return {
        "serial": session.serial,
        "file": session.file.name,
        "edits": dict(session.edits),
        "faults": [_fault(problem) for problem in session.faults[:TOLD]],
        "more_faults": max(0, len(session.faults) - TOLD),
        "machine": None if machine is None or start is None else _machine(machine, start, session.edits),
    }


def _fault(problem: Problem) -> Data:
    return {"text": said(problem.message), "line": problem.line, "column": problem.column, "path": problem.path}


def _machine(machine: LiveMachine, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    run = machine.run
    return {
        "title": str((machine.config.tree.data.get("project") or {}).get("title") or machine.tree.name),
        "status": run.status,
        "summary": run.summary,
        "conclusion": said(run.summary["conclusion"]),
        "is_open": run.is_open,
        "start": {"status": start.run.status, "summary": start.run.summary},
        "mechanisms": [_mechanism(name, machine, start, edits) for name in _names(machine)],
    }


def _names(machine: LiveMachine) -> Iterator[str]:
    yield PRESS
    yield from (name for name in machine.config.instances if name != PRESS)


def _mechanism(name: str, machine: LiveMachine, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    instance = machine.config.instances[name]
    assert instance is not None, "a machine with a broken plugin is not shown"
    run = machine.run
    kind = instance.mechanism.kind if instance.mechanism else ""
    own = {
        "inputs": [
            _input(each, kind, start, edits) if isinstance(each, DesignInput) else _choice(each, kind, start, edits)
            for each in _inputs(name, machine)
        ]
    }
    if instance.mechanism is None:
        return own | {
            "name": name,
            "title": said(phrase("Press")),
            "checks": [],
            "outputs": [],
            "figures": [],
            "skipped": False,
        }
    is_there = name in run.calculations
    before = {check["id"]: check for check in start.run.checks.get(name, ())}
    return own | {
        "name": name,
        "title": said(instance.mechanism.title, kind),
        "skipped": not is_there,
        "checks": [_check(each, kind, before.get(each["id"])) for each in run.checks.get(name, ()) if each["class"] != "numerical"],
        "outputs": list(_outputs(name, kind, machine, start)) if is_there else [],
        "figures": [_told(title, kind) for title in run.figure_titles(name)] if is_there else [],
    }  # fmt: skip


def _told(text: object, kind: str) -> str:
    """A text of a plugin of this kind as the page shows it."""
    return tidy(localised(said(text if isinstance(text, str) else "", kind)))


def _inputs(name: str, machine: LiveMachine) -> list[DesignInput | DesignChoice]:
    """What may be changed of a mechanism, in the order of the file."""
    every: list[DesignInput | DesignChoice] = [*machine.inputs.values(), *machine.choices.values()]
    own = (each for each in every if each.asked.instance == name)
    return sorted(own, key=lambda each: machine.tree.position(each.stands))


def _choice(asked: DesignChoice, kind: str, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    first = start.choices.get(asked.name)
    return {
        "name": asked.name,
        "path": asked.asked.path,
        "text": _told(asked.asked.meta.description, kind),
        "symbol": asked.asked.meta.symbol,
        "unit": "",
        "typed": edits.get(asked.name) or asked.typed,
        "start": first.typed if first else "",
        "options": list(asked.options),
    }


def _input(asked: DesignInput, kind: str, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    assert asked.today is not None, "a number that the file gives has a value"
    low, high = slider(asked)
    own = unit(asked.unit)
    first = start.inputs.get(asked.name)
    return {
        "name": asked.name,
        "path": asked.asked.path,
        "text": _told(asked.meta.description, kind),
        "symbol": asked.meta.symbol,
        "unit": "" if asked.unit == "1" else asked.unit,
        "value": _plain(own.from_si(asked.today)),
        "typed": edits.get(asked.name) or asked.typed(asked.today),
        "start": first.typed(first.today) if first is not None and first.today is not None else "",
        "low": _plain(own.from_si(low)),
        "high": _plain(own.from_si(high)),
        "whole": asked.is_whole,
    }


def slider(asked: DesignInput) -> tuple[float, float]:
    """Return from where to where (SI) a slider moves an input: half its size to each side, within what the input may be."""
    value = asked.today or 0.0
    least, greatest = asked.bounds
    if asked.is_whole:
        return max(value - WHOLE_REACH, least), min(value + WHOLE_REACH, greatest)
    reach = REACH * abs(value) or REACH * plausible_step(asked)
    low, high = value - reach, value + reach
    is_open = least == 0 < value  # a length above zero: zero itself is none
    return (max(low, least) if not is_open else max(low, value / 100)), min(high, greatest)


def plausible_step(asked: DesignInput) -> float:
    """Return the size (SI) by which an input that is zero now may move."""
    return math.sqrt(math.prod(plausible(asked.meta.unit).ends))


def _plain(number: float) -> float:
    return float(f"{number:.12g}")


def _check(check: Mapping[str, Any], kind: str, before: Mapping[str, Any] | None) -> Data:
    ratio = check.get("utilisation")
    return {
        "id": check["id"],
        "title": _told(check["title"], kind),
        "class": check["class"],
        "status": check["status"],
        "utilisation": ratio if isinstance(ratio, int | float) and math.isfinite(ratio) else None,
        "message": _told(check.get("message"), kind),
        "advice": _told(check.get("advice"), kind),
        "start_status": before["status"] if before else "",
        "start_utilisation": before.get("utilisation") if before else None,
    }


def _outputs(name: str, kind: str, machine: LiveMachine, start: LiveMachine) -> Iterator[Data]:
    before = start.run.key_outputs(name) if name in start.run.calculations else {}
    for key, output in machine.run.key_outputs(name).items():
        first = before.get(key)
        yield {
            "id": key,
            "text": _told(output["description"], kind),
            "symbol": output["symbol"],
            "shown": _shown(output),
            "start": "" if first is None else _shown(first),
            "change": _change(output["value"], first and first["value"]),
        }


def _shown(output: Mapping[str, Any]) -> str:
    display = output.get("display")
    if not display:
        return str(output["value"])
    return localised(quantity(display["text"], display["unit"]))


def _change(value: Any, first: Any) -> float | None:
    """By how much a number has changed since the start, as a share; None where that says nothing."""
    numbers = isinstance(value, int | float) and isinstance(first, int | float) and not isinstance(value, bool)
    return (value - first) / abs(first) if numbers and first and value != first and value * first >= 0 else None
