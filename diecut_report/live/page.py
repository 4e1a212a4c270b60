"""The live page itself and what it is made of: a template, a style sheet and scripts, all of the program's own folder."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.reading import typed_text
from diecut_report.design.inputs import DesignInput
from diecut_report.design.machines import STATUS, UTILISATION, VariedMachines, downstream, narrowed, varied
from diecut_report.errors import refusal
from diecut_report.live.session import LiveMachine, LiveSession
from diecut_report.mechanism.figures import Drawing
from diecut_report.quantities.plausible import plausible
from diecut_report.quantities.units import unit
from diecut_report.report.chapters.drive_line import DriveLineFigure, drive_line_figures
from diecut_report.report.pages.html import filled_page, folder
from diecut_report.report.reader_data import Shown, figure_readings, moving_readings
from diecut_report.report.text import Catalogue, figure_translated, quantity, tidy, value_in_words
from diecut_report.results.checks import NOT_CHECKED
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import shown_figures
from diecut_report.results.mechanism_record import CheckRecord, QuantityRecord
from diecut_report.results.press_run import Tell
from diecut_report.study.definition.base_inputs import MECHANISMS, is_of_parts
from diecut_report.study.execution.press_batch import untold
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import catalogues_spoken, localised, said, say, spoken_language

# What a live page gets of a session, as plain data: verdict, faults, and of each mechanism its inputs, checks and key numbers.


Data = dict[str, Any]
MAX_FAULTS = 20  # faults that the page shows
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
        "can": {"undo": bool(session.past), "redo": bool(session.future)},
        "states": [_state(name, each, is_kept=name in session.states) for name, each in session.machines.items()],
        "faults": [
            {"text": said(each.message), "line": each.line, "column": each.column, "path": each.path}
            for each in session.faults[:MAX_FAULTS]
        ],
        "more_faults": max(0, len(session.faults) - MAX_FAULTS),
        "machine": None if machine is None or start is None else _machine(machine, start, session.edits),
    }


def _state(name: str, machine: LiveMachine, *, is_kept: bool) -> Data:
    summary = machine.run.summary
    return {
        "name": name,
        "is_kept": is_kept,
        "verdict": summary.verdict,
        "fail": summary.fail,
        "governing": summary.governing or "",
    }


def _machine(machine: LiveMachine, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    run = machine.run
    return {
        "title": str((machine.config.tree.data.get("project") or {}).get("title") or machine.config.tree.name),
        "status": run.status,
        "summary": run.summary.data(),
        "conclusion": said(run.summary.conclusion),
        "start": {"status": start.run.status, "summary": start.run.summary.data()},
        "open": [
            {"path": each.path.removeprefix(f"{MECHANISMS}."), "why": said(each.why), "owner": each.owner}
            for each in run.summary.open
        ],
        "views": [each.title for each in _drive_line(machine)],
        "mechanisms": [
            _mechanism(name, machine, start, edits)
            for name in (PRESS, *(each for each in machine.config.instances if each != PRESS))
        ],
    }


def _driving(machine: LiveMachine) -> tuple[str, int] | None:
    """The figure with which the drawings of other mechanisms move: of which mechanism, and which of its figures."""
    for name, calc in machine.run.calculations.items():
        for index, figure in enumerate(shown_figures(calc)):
            if isinstance(figure, Drawing) and figure.drives:
                return name, index
    return None


def _mechanism(name: str, machine: LiveMachine, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    instance = machine.config.instances[name]
    assert instance is not None, "a machine with a broken plugin is not shown"
    run = machine.run
    mechanism, is_there = instance.mechanism, name in run.calculations
    kind = mechanism.kind if mechanism else ""
    before = {check.id: check for check in start.run.checks.get(name, ())}
    return {
        "name": name,
        "title": said(mechanism.title, kind) if mechanism else said(phrase("Press")),
        "skipped": mechanism is not None and not is_there,
        "inputs": [
            (_input if each.asked.unit is not None else _choice)(each, kind, start, edits)
            | {"is_default": typed_text(machine.tree, each.stands) is None}
            for each in _inputs(name, machine)
        ],
        "checks": [_check(each, kind, before.get(each.id)) for each in run.checks.get(name, ()) if each.check_class != "numerical"],
        "outputs": list(_outputs(name, kind, machine, start)) if is_there else [],
        "figures": _figures(name, kind, machine),
    }  # fmt: skip


def _figures(name: str, kind: str, machine: LiveMachine) -> list[str]:
    """The titles of a mechanism's figures; the press has that in which all move."""
    if name == PRESS:
        return [said(phrase("Press in motion"))] if _driving(machine) else []
    return [_text(title, kind) for title in machine.run.figure_titles(name)] if name in machine.run.calculations else []


def _text(text: object, kind: str) -> str:
    return tidy(localised(said(text if isinstance(text, str) else "", kind)))


def _inputs(name: str, machine: LiveMachine) -> list[DesignInput]:
    """Those of the file in its order, then those at default in that of their declaration, where they stay when they are changed."""
    made_with = machine.of_parts.get(name, ())
    own = [each for called, each in machine.inputs.items() if each.asked.instance == name or called in made_with]
    given = [each for each in own if typed_text(machine.tree, each.stands) is not None]
    instance = machine.config.instances[name]
    order = {slot.key: index for index, slot in enumerate(instance.slots if instance else ())}
    rest = sorted((each for each in own if each not in given), key=lambda each: order[each.asked.key])
    return [*sorted(given, key=lambda each: machine.tree.position(each.stands)), *rest]


def _choice(asked: DesignInput, kind: str, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    first = start.inputs.get(asked.name)
    return _named(asked, kind) | {
        "unit": "",
        "typed": edits.get(asked.name) or asked.written,
        "start": first.written if first else "",
        "options": list(asked.options),
    }


def _input(asked: DesignInput, kind: str, start: LiveMachine, edits: Mapping[str, str]) -> Data:
    own, present = unit(asked.unit), asked.present  # none where a word stands for it
    low, high = (None, None) if present is None else (_plain(own.from_si(end)) for end in slider(asked))
    first = start.inputs.get(asked.name)
    return _named(asked, kind) | {
        "unit": "" if asked.unit == "1" else asked.unit,
        "si": own.factor,
        "value": None if present is None else _plain(own.from_si(present)),
        "typed": edits.get(asked.name) or _as_typed(asked),
        "start": _as_typed(first) if first else "",
        "low": low,
        "high": high,
        "whole": asked.is_whole,
    }


def _as_typed(asked: DesignInput) -> str:
    return (asked.written or "") if asked.present is None else asked.typed(asked.present)


def _named(asked: DesignInput, kind: str) -> Data:
    meta = asked.asked.meta
    text = _text(meta.description, kind)
    return {"name": asked.name, "path": asked.asked.path, "text": text, "symbol": meta.symbol}


def slider(asked: DesignInput) -> tuple[float, float]:
    """Return from where to where (SI) a slider moves an input: half its size to each side, within what the input may be."""
    value = asked.present or 0.0
    least, greatest = asked.bounds
    if asked.is_whole:
        return max(value - WHOLE_REACH, least), min(value + WHOLE_REACH, greatest)
    reach = REACH * (abs(value) or math.sqrt(math.prod(plausible(asked.meta.unit).ends)))
    low, high = value - reach, value + reach
    is_open = least == 0 < value  # a length above zero: zero itself is none
    return (max(low, least) if not is_open else max(low, value / 100)), min(high, greatest)


def _plain(number: float) -> float:
    return float(f"{number:.12g}")


def _check(check: CheckRecord, kind: str, before: CheckRecord | None) -> Data:
    ratio = check.utilisation
    return {
        "id": check.id,
        "title": _text(check.title, kind),
        "class": check.check_class,
        "status": check.status,
        "utilisation": ratio,
        "message": _text(check.message, kind),
        "start_status": before.status if before else "",
        "start_utilisation": before.utilisation if before else None,
    }


def advice(machine: LiveMachine, name: str, tell: Tell = untold) -> Data:
    """Return what the failing checks of a mechanism say with their advice, by their ids; UserError where there is no such mechanism."""
    if name not in machine.run.calculations:
        raise refusal("There is no mechanism {name}.", name=repr(name))
    kind = machine.config.kinds.get(name, "")
    checks = machine.run.advised_checks(name, tell)
    return {"mechanism": name, "messages": {each.id: _text(each.message, kind) for each in checks if each.advice}}


def _outputs(name: str, kind: str, machine: LiveMachine, start: LiveMachine) -> Iterator[Data]:
    before = start.run.key_outputs(name) if name in start.run.calculations else {}
    for key, output in machine.run.key_outputs(name).items():
        first = before.get(key)
        yield {
            "id": key,
            "text": _text(output.description, kind),
            "symbol": output.symbol,
            "shown": _shown(output, kind),
            "start": "" if first is None else _shown(first, kind),
            "change": _change(output.value, first and first.value),
        }


def _shown(output: QuantityRecord, kind: str) -> str:
    if isinstance(output.value, str):
        return _text(value_in_words(output), kind)
    return localised(quantity(output.display.text, output.display.unit))


def _change(value: Any, first: Any) -> float | None:
    """By how much a number has changed since the start, as a share; None where that says nothing."""
    numbers = isinstance(value, int | float) and isinstance(first, int | float) and not isinstance(value, bool)
    return (value - first) / abs(first) if numbers and first and value != first and value * first >= 0 else None


def _drive_line(machine: LiveMachine) -> list[DriveLineFigure]:
    """The views of the drive line; a part leads to its calculation on the page."""
    run, kinds = machine.run, machine.config.kinds
    checks = {
        name: [each.with_(title=_text(each.title, kinds.get(name, ""))) for each in own]
        for name, own in run.checks.items()
    }
    return drive_line_figures(
        run.drive_line, checks, {name: f"#{name}" for name in checks}, Catalogue(spoken_language())
    )


# The figures of a live machine: curves as numbers that the page draws itself, drawings as SVG; each made when it is looked at.


class Pictures:
    """Draw the figures of machines; what was drawn of an unchanged mechanism is kept."""

    def __init__(self) -> None:
        self._drawn: dict[tuple[str, int], tuple[list[FigureRecord], Data]] = {}

    @staticmethod
    def view(machine: LiveMachine, index: int) -> Data:
        """Return a view of the drive line as ``svg``; UserError where there is none."""
        from diecut_report.report.figures.by_type import render  # with matplotlib, which takes half a second

        views = _drive_line(machine)
        if not 0 <= index < len(views):
            raise refusal("There is no figure {n} of {name}.", n=index, name=repr("drive line"))
        return {"svg": render(views[index], {}, views[index].words, f"view-{index}").text}

    def figure(self, machine: LiveMachine, mechanism: str, index: int) -> Data:
        """Return a figure: ``plot`` with its panels and rows of numbers, ``moving`` with what moves with it and their rows, or ``svg``.

        UserError where there is none, or it cannot be drawn.
        """
        if mechanism == PRESS and not index and (driving := _driving(machine)):
            mechanism, index = driving
        if mechanism not in machine.run.calculations or not 0 <= index < len(machine.run.figure_titles(mechanism)):
            raise refusal("There is no figure {n} of {name}.", n=index, name=repr(mechanism))
        declared = shown_figures(machine.run.calculations[mechanism])[index]
        # a chart to which this machine gives no panel is not among them, though its title is told
        figure = next((each for each in machine.run.figures(mechanism) if each.id == declared.id), None)
        if figure is None:
            raise refusal("{title}: nothing to show for this machine.", title=declared.title)
        driven = _driven(machine, figure)
        used, known = [figure, *driven.values()], self._drawn.get((mechanism, index))
        if known is None or list(map(id, known[0])) != list(map(id, used)):
            known = used, _drawn(machine, figure, mechanism, index, driven)
            self._drawn[mechanism, index] = known
        return known[1]


def _driven(machine: LiveMachine, figure: FigureRecord) -> dict[str, FigureRecord]:
    """The first moving drawing of each mechanism that moves with a figure."""
    names = {each.mechanism for each in figure.moving.drives} if figure.moving else {}
    moving = (
        (name, each)
        for name in machine.run.calculations
        if name in names
        for each in machine.run.figures(name)
        if each.moving
    )
    return dict(reversed(list(moving)))


def _drawn(
    machine: LiveMachine, figure: FigureRecord, mechanism: str, index: int, driven: Mapping[str, FigureRecord]
) -> Data:
    from diecut_report.report.figures.by_type import render  # with matplotlib, which takes half a second

    words, first = Catalogue(spoken_language()), _said(machine, mechanism, figure)
    _, figure, curves = first
    key = f"{mechanism}-{index}"
    try:
        if figure.moving:
            made = moving_readings(first, [_said(machine, *each) for each in driven.items()])
            has_words = any(shape.shape == "label" for shape in figure.moving.shapes)  # it says what the still one does
            return made if has_words else made | {"svg": render(figure, curves, words, key).text}
        if figure.type in ("plot", "chart") and (readings := figure_readings(mechanism, figure, curves, words)):
            return {"plot": readings}
        return {"svg": render(figure, curves, words, key).text}
    except Exception as cause:  # of any kind: what a plugin gives to be drawn is its own
        raise refusal("This figure cannot be drawn: {reason}", reason=f"{type(cause).__name__}: {cause}") from cause


def _said(machine: LiveMachine, mechanism: str, figure: FigureRecord) -> Shown:
    """A figure and its curves in the language that is spoken."""
    curves = machine.run.curves(mechanism)
    if catalogues := catalogues_spoken():
        kind = machine.run.calculations[mechanism].mechanism.kind
        figure, curves = figure_translated(figure, curves, kind, catalogues)
    return mechanism, figure, curves


# The words that the script of the live page says, by the names that it has for them; they come with the page as data.


WORDS = {
    "verdict_fault": phrase("The file cannot be calculated"),
    "count_pass": phrase("{n} pass"),
    "governing": phrase("governing: {check}"),
    "failed_before": phrase("initially {n} failed"),
    "status_pass": phrase("pass"),
    "status_warn": phrase("warn"),
    "status_fail": phrase("fail"),
    "status_not_checked": phrase("not checked"),
    "more_faults": phrase("and {n} more"),
    "write": phrase("Write to file"),
    "write_n": phrase("Write {n} to file"),
    "written": phrase("Written to {file}."),
    "take_back": phrase("Undo"),
    "take_back_of": phrase("Undo {input}"),
    "at_default": phrase("At default"),
    "open_n": phrase("Open: {n}"),
    "pin": phrase("Keep in view"),
    "pin_of": phrase("Keep {quantity} in view"),
    "compare_of": phrase("Compare {state}"),
    "state_return": phrase("Return to"),
    "state_save": phrase("Save as file"),
    "state_forget": phrase("Remove"),
    "verdict_pass": phrase("pass"),
    "verdict_conditional": phrase("conditional"),
    "verdict_fail": phrase("fail"),
    "slider": phrase("{input}, slider"),
    "before": phrase("initially {value}"),
    "no_inputs": phrase("The file gives no number of its own here; all are taken from elsewhere."),
    "not_found": phrase("No input in the file has this in its key or description."),
    "effect": phrase("Effect"),
    "effect_of": phrase("Effect of {input}"),
    "effect_line": phrase("utilisation from {first} to {last}"),
    "absent_before": phrase("not there"),
    "drawing": phrase("drawing …"),
    "play": phrase("Animate one revolution"),
    "refused": phrase("The program rejected this ({status})."),
    "no_answer": phrase("The program does not respond; is it still running?"),
    "making": phrase("The report is being generated; it opens in a new tab."),
    "lost": phrase("The program does not respond. If it was restarted, open the address that it prints."),
}
"""What is in braces the script fills in."""


def words() -> str:
    """Return the words in the language that is spoken, as JSON."""
    return json.dumps({name: said(text) for name, text in WORDS.items()}, ensure_ascii=False)


FONTS = ("report-sans-regular", "report-sans-bold", "report-sans-italic", "report-symbols")
FILES = {  # place in the folder of the templates: what it is
    "live/live.css": "text/css; charset=utf-8",
    "moving.css": "text/css; charset=utf-8",
    "level_names.js": "text/javascript; charset=utf-8",
    "moving.js": "text/javascript; charset=utf-8",
    "live/live.js": "text/javascript; charset=utf-8",
    "live/plugin.js": "text/javascript; charset=utf-8",
    "uplot/uPlot.min.css": "text/css; charset=utf-8",
    "uplot/uPlot.iife.min.js": "text/javascript; charset=utf-8",
    **{f"fonts/{name}.woff2": "font/woff2" for name in FONTS},
}


class Asset(NamedTuple):
    """Hold a file that the page loads."""

    content: bytes
    media_type: str


@cache
def assets() -> dict[str, Asset]:
    """Return all that the page may load, by name."""
    places = {folder() / place: media_type for place, media_type in FILES.items()}
    return {place.name: Asset(place.read_bytes(), media_type) for place, media_type in places.items()}


def page(file: str) -> bytes:
    """Return the page for a file of this name, in the language that is spoken."""
    return filled_page("live/live.html.j2", file=file, language=spoken_language(), say=say, words=words()).encode()


# What an input does to every check: one vectorised run over the slider's range, of the mechanisms that follow from it.
#
# The checks of all others are those of the machine as it stands.


POINTS = 25  # of a line: fine enough for its size, and quick enough for a hand on a slider
FEW_POINTS = 9  # where the parts of the machine are made anew at each


def effect(machine: LiveMachine, name: str, tell: Tell = untold) -> Data:
    """Return the checks' utilisations and statuses along an input's slider, with the places in the input's unit.

    UserError where the file gives no such number. A place where the machine cannot exist has neither. ``tell`` is called with
    the name of each mechanism before it is calculated; what it raises ends the run.
    """
    asked = machine.inputs.get(name)
    if asked is None or asked.asked.unit is None or asked.present is None:
        raise refusal("{name} is not a number that the file gives.", name=repr(name))
    is_part = is_of_parts(machine.config, asked.asked)
    places = _places(asked, FEW_POINTS if is_part else POINTS)
    moved = machine.config if is_part else narrowed(machine.config, downstream(machine.config, asked.asked.instance))
    found = varied(moved, {asked.asked: places}, len(places), tell=tell)
    own = unit(asked.unit)
    return {
        "input": name,
        "places": [float(f"{own.from_si(float(place)):.6g}") for place in places],
        "exists": found.exists.tolist(),
        "checks": _unmoved(machine, moved, found) | {check: _line(found, check) for check in found.checks},
    }


def _unmoved(machine: LiveMachine, moved: Config, found: VariedMachines) -> Data:
    """The lines of the checks that are not calculated again: today's, where the machine exists."""
    checks = ((name, check) for name, own in machine.run.checks.items() if name not in moved.instances for check in own)
    return {
        f"{name}.{check.id}": {
            "utilisation": [_effects_told(check.utilisation) if there else None for there in found.exists],
            "status": [check.status if there else "" for there in found.exists],
        }
        for name, check in checks
        if check.check_class != "numerical" and check.status != NOT_CHECKED
    }


def _effects_told(ratio: float | None) -> float | None:
    return float(f"{ratio:.4g}") if ratio is not None and math.isfinite(ratio) else None


def _places(asked: DesignInput, count: int) -> np.ndarray:
    low, high = slider(asked)
    if asked.is_whole:
        return np.arange(round(low), round(high) + 1, dtype=float)
    return np.linspace(low, high, count)


def _line(found: VariedMachines, check: str) -> Data:
    ratios, statuses = found.check(check, UTILISATION), found.check(check, STATUS)
    return {
        "utilisation": [_effects_told(ratio) for ratio in ratios.astype(float)],
        "status": [status or "" for status in statuses],
    }
