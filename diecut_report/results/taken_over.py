"""What a reference takes over of a calculated mechanism."""

from __future__ import annotations

import math
from typing import Any

from diecut_report.config.targets import Target
from diecut_report.contract.inputs import SI
from diecut_report.contract.phases import PREFIX
from diecut_report.contract.result_names import named
from diecut_report.engine import Calculation, CurveHandle
from diecut_report.engine.mechanism_handle import MechanismHandle
from diecut_report.engine.phases import PhaseHandle
from diecut_report.engine.steps import facts
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.plausible import without_rounding


class Unavailable(LookupError):
    """Stand for a value that a broken or skipped mechanism would have given."""


class Valueless(ValueError):
    """Stand for an expression without a value; the text says why."""


class Absent(LookupError):
    """Stand for a value that this machine does not have; the text says so."""


class Withheld(LookupError):
    """Stand for a value that is not calculated, since the machine does not meet what it stands on; the text says what is not met."""


def require_facts(calc: Calculation, name: str, target: Target) -> None:
    """Raise Withheld where a result stands on a fact that the machine (of several: none of them) does not meet."""
    missed, words = facts.without(calc, name)
    if missed.all():
        raise Withheld(Phrase("{path}, which is {reason}", path=target.path, reason=phrase(words or "not calculated")))


def number(calc: Calculation, name: str) -> Array | None:
    """Return a number or text by its name in the results, shape (variants,); None where there is no such one."""
    if name in calc.values:
        return calc.values[name][:, 0]
    part = named(name, calc.steps)
    row = calc.values.get(part.id) if part and part.role == "part" else None
    return row[:, part.index] if part and row is not None and part.index < row.shape[1] else None


def phase(calc: Calculation, name: str, target: Target) -> PhaseHandle:
    """Return a phase as a reference takes it over. Absent where the (first) machine does not have it."""
    handle = PhaseHandle(calc, name.removeprefix(PREFIX), f"${{{target.path}}}")
    if not handle.intervals():
        raise Absent(phrase("does not apply to this machine."))
    return handle


def output(calc: Calculation, name: str, target: Target) -> Any:
    """Return a result as a reference takes it over: a curve, a number with its SI unit, or a text. Absent where there is none."""
    if target.is_mechanism:
        return MechanismHandle(calc, target.instance)
    require_facts(calc, name, target)
    if target.phase_unit:
        return phase(calc, name, target)
    if calc.axis.get(name) in calc.domains:
        return CurveHandle(calc, name)
    numbers = number(calc, name)
    if numbers is None:
        raise Absent(phrase("does not exist for this machine."))
    value = numbers[0]
    if isinstance(value, str):
        return value
    if math.isnan(value):
        raise Absent(phrase("does not apply to this machine."))
    return SI(float(without_rounding(value, str(target.unit))), str(target.unit), target.path)
