"""What a plugin's plain code gives back: numbers of the right shape, or a text; all else is told of the step and its function."""

from __future__ import annotations

import reprlib
from collections.abc import Callable
from numbers import Real
from typing import Any

import numpy as np

from diecut_report.contract.place import Misdeclared
from diecut_report.contract.refused import Refused
from diecut_report.contract.steps import Clash, Computed, ComputedCurve, PartNames, Prepared, Step, Words
from diecut_report.engine.calculation import Calculation, Impossible
from diecut_report.expressions import Array


def computed(calc: Calculation, step: Computed) -> None:
    """Call the function of a step for its number, its row or its text."""
    taken = _taken(calc, step)
    found = step.function(*taken)
    if calc.count > 1 and np.shape(found)[:1] != (calc.count,) and any(isinstance(each, np.ndarray) for each in taken):
        raise TypeError(f"{step.id} was given {calc.count} machines and has one value for all")
    if step.is_text:
        calc.values[step.id] = np.array([text(step, each) for each in found], dtype=object)[:, None]
    else:
        width = len(calc.part_names[step.parts]) if step.parts else 1
        calc.values[step.id] = calc.existing(step, number(step, found, calc.count, width))


def prepared(calc: Calculation, step: Prepared) -> None:
    """Make an object for other steps; what its function refuses makes the machine impossible."""
    try:
        calc.prepared[step.id] = step.function(*_taken(calc, step))
    except Refused as refused:
        raise Impossible([(refused.key, refused.message)]) from None


def part_names(calc: Calculation, step: PartNames) -> None:
    """Name the parts that rows run over."""
    found = step.function(*_taken(calc, step))
    if not isinstance(found, list) or not found or not all(isinstance(each, str) for each in found):
        raise _told(step, step.function, reprlib.repr(found), "a list of texts")
    calc.part_names[step.id] = tuple(found)


def curve(calc: Calculation, step: ComputedCurve) -> None:
    """Take note of a curve, and cut its abscissa where it has corners."""
    calc.curves[step.id] = step
    if step.joints is not None:
        places = step.joints(calc.prepared[step.of])
        calc.domains[step.abscissa].cut(np.broadcast_to(places, (calc.count, places.shape[1])))


def _taken(calc: Calculation, step: Computed | Prepared | PartNames) -> list[Any]:
    """What a step takes; an object is also made of optional inputs, None where they are not given."""
    optional = isinstance(step, Prepared)

    def one(name: str) -> Any:
        if name in calc.prepared:
            return calc.prepared[name]
        known = name in calc.values or name.removeprefix("inputs.") in calc.inputs
        return None if optional and not known else calc[name]

    return [one(name) for name in step.takes]


def number(step: Computed, found: Any, count: int, width: int = 1) -> Array:
    """Return what a function gives as an array of shape (variants, width); Misdeclared where it is none."""
    wanted = "a number" if width == 1 else f"a row of {width} numbers"
    given = _numbers(step, step.function, found, wanted)
    if given.shape not in ((count, width), (1, width), *(((), (1,)) if width == 1 else ())):
        raise _told(step, step.function, f"an array of shape {given.shape}", f"{wanted}, shape ({count}, {width})")
    return np.broadcast_to(given, (count, width))


def partners(step: Clash, found: Any, shape: tuple[int, ...]) -> Array:
    """Return which part each part clashes with, of the shape of the rows that it takes; Misdeclared where it is none."""
    given = _numbers(step, step.function, found, "an array of indices")
    if given.shape != shape:
        raise _told(step, step.function, f"an array of shape {given.shape}", f"an index for each part, shape {shape}")
    return given


def text(step: Words | Computed, found: Any) -> str:
    """Return the text that a function gives; Misdeclared where it is none."""
    if not isinstance(found, str):
        raise _told(step, step.function, reprlib.repr(found), 'a text, f"…"')
    return found


def _numbers(step: Step, function: Callable[..., Any], found: Any, wanted: str) -> Array:
    try:
        given = np.asarray(found)
    except ValueError:  # a list of lists of unlike lengths
        given = np.array(None)
    if given.dtype == object and all(isinstance(each, Real) for each in given.flat):
        return given.astype(float)
    if given.dtype.kind not in "biuf":
        raise _told(step, function, reprlib.repr(found), wanted)
    return given


def _told(step: Step, function: Callable[..., Any], given: str, wanted: str) -> Misdeclared:
    name = getattr(function, "__name__", repr(function))
    return Misdeclared(f"step {step.id}: its function {name} gives {given}; it must return {wanted}", step.at)
