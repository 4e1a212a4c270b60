"""Phases in the results: their intervals as numbers and as they are printed, and which there are not, and why."""

from __future__ import annotations

from decimal import Decimal
from typing import Any

from diecut_report.contract.phases import PREFIX
from diecut_report.contract.steps import Phase
from diecut_report.engine import Calculation
from diecut_report.engine.phases import intervals, period_of, phases_of, speed_of
from diecut_report.engine.shown_units import declared_unit
from diecut_report.languages.phrases import Phrase, keys_listed
from diecut_report.mechanics.timing.intervals import Interval, composed
from diecut_report.quantities.formatting import place_shown, shown
from diecut_report.quantities.units import unit

Data = dict[str, Any]
MORE = range(3)  # digits beyond those that mean something


def phases(calc: Calculation) -> Data:
    """Return each phase that the machine has: its role, the abscissa it runs over with its period, and its intervals, SI."""
    found: Data = {}
    for name, step in phases_of(calc).items():
        held = intervals(calc, name)
        if held:
            axis = calc.steps[step.abscissa]
            display = declared_unit(calc, axis.id, axis.unit)
            speed = speed_of(calc, step.abscissa)
            more = _more_digits(calc, step.abscissa, display)
            found[name] = {
                "role": step.role,
                "description": step.description,
                "abscissa": step.abscissa,
                "period": period_of(calc, step),
                "unit": unit(axis.unit).si,
                "intervals": [list(interval) for interval in held],
                "display": {
                    "unit": display,
                    "intervals": [_shown(interval, display, more) | _lasts(interval, speed) for interval in held],
                },
            }
    return _with_parts(found)


def _with_parts(phases: Data) -> Data:
    """The phases, those that are nothing but others together with these."""
    sets = {
        name: frozenset((each["role"], each["abscissa"], *ends) for ends in each["intervals"])
        for name, each in phases.items()
    }
    whole = composed(sets)
    return {name: each | ({"parts": list(whole[name])} if name in whole else {}) for name, each in phases.items()}


def _shown(interval: Interval, display: str, more: int) -> dict[str, str]:
    """An interval as texts: both ends and its length in the abscissa's unit."""
    start, end = interval
    texts = {"from": start, "to": end, "length": end - start}
    return {key: place_shown(value, display, more)["text"] for key, value in texts.items()}


def _lasts(interval: Interval, speed: float | None) -> dict[str, str]:
    """The time of an interval in ms, where the speed is known."""
    return {"time": shown((interval[1] - interval[0]) / speed, "ms")["text"]} if speed else {}


def _more_digits(calc: Calculation, abscissa: str, display: str) -> int:
    """With how many more digits all phases over an abscissa are shown, so that the printed ends give the printed lengths."""
    names = [name for name, step in phases_of(calc).items() if step.abscissa == abscissa]
    held = [interval for name in names for interval in intervals(calc, name)]
    return next((more for more in MORE if all(_agree(_shown(each, display, more)) for each in held)), 0)


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
            words = Phrase("{keys} not given", keys=keys_listed(missing)) if missing else words
            found[name] = {"description": step.description, "missing": missing, "text": words}
    return found
