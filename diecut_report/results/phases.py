"""Phases in the results: their intervals as numbers and as they are printed, and which there are not, and why."""

from __future__ import annotations

from decimal import Decimal
from typing import Any

from diecut_report.contract.phases import PREFIX
from diecut_report.contract.steps import Phase
from diecut_report.engine import Calculation
from diecut_report.engine.phases import intervals, period_of, phases_of, speed_of
from diecut_report.engine.shown_units import declared_unit
from diecut_report.languages.phrases import Phrase, named
from diecut_report.mechanics.timing.intervals import Interval
from diecut_report.quantities.formatting import place_shown, shown
from diecut_report.quantities.units import unit

Data = dict[str, Any]


def phases(calc: Calculation) -> Data:
    """Return each phase that the machine has: its role, the abscissa it runs over with its period, and its intervals, SI."""
    found: Data = {}
    for name, step in phases_of(calc).items():
        held = intervals(calc, name)
        if held:
            axis = calc.steps[step.abscissa]
            display = declared_unit(calc, axis.id, axis.unit)
            found[name] = {
                "role": step.role,
                "description": step.description,
                "abscissa": step.abscissa,
                "period": period_of(calc, step),
                "unit": unit(axis.unit).si,
                "intervals": [list(interval) for interval in held],
                "display": {
                    "unit": display,
                    "intervals": [_shown(interval, display, speed_of(calc, step.abscissa)) for interval in held],
                },
            }
    return found


def _shown(interval: Interval, display: str, speed: float | None) -> dict[str, str]:
    """An interval as texts: both ends and its length in the abscissa's unit, and its time in ms where the speed is known."""
    start, end = interval
    texts = {"from": start, "to": end, "length": end - start}
    tried = [{key: place_shown(value, display, more)["text"] for key, value in texts.items()} for more in range(3)]
    told = next(filter(_agree, tried), tried[0])
    return told | ({"time": shown((end - start) / speed, "ms")["text"]} if speed else {})


def _agree(told: dict[str, str]) -> bool:
    """Whether the printed ends give the printed length."""
    return Decimal(told["to"]) - Decimal(told["from"]) == Decimal(told["length"])


def phases_absent(calc: Calculation) -> Data:
    """Return each declared phase that the machine does not have: the keys that are missing, and the reason in words."""
    there = phases(calc)
    found: Data = {}
    for chapter, step in calc.mechanism.steps:
        name = step.id.removeprefix(PREFIX)
        if not isinstance(step, Phase) or name in there:
            continue
        missing = [key for key in (*chapter.needs, *step.needs) if key not in calc.given]
        if name not in found or len(missing) < len(found[name]["missing"]):
            words = "does not apply to this machine"
            words = Phrase("{keys} not given", keys=named(missing, " and ")) if missing else words
            found[name] = {"description": step.description, "missing": missing, "text": words}
    return found
