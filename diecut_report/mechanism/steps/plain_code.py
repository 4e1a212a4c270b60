"""What a plugin's plain code gets and gives back: numbers of the right shape, or a text; all else is told of the step and its function."""

from __future__ import annotations

import reprlib
from collections.abc import Iterable
from numbers import Real
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.steps.protocols import StepEngine
from diecut_report.text.phrases import Phrase, phrase

WIDE = 8  # bytes of a number


def taken(calc: StepEngine, names: Iterable[str]) -> list[Any]:
    """Return what plain code takes; arrays are handed out to be read, for a change in place would be of the machine itself."""
    given = [calc[name].view() if isinstance(calc[name], np.ndarray) else calc[name] for name in names]
    for each in given:
        if isinstance(each, np.ndarray):
            each.flags.writeable = False
    return given


def number(step: Any, found: Any, calc: StepEngine) -> Array:
    """Return what a function gives as an array of shape (variants, 1); Misdeclared where it is none."""
    given = _numbers(step, found, phrase("a number"))
    if given.dtype == bool and step.unit != "1":
        raise misgiven(step, reprlib.repr(found), Phrase("a number in SI of {unit}", unit=step.unit))
    if given.shape not in ((), (1,), (1, 1), (calc.count, 1)):
        raise misgiven(step, _array(given), Phrase("a number, shape ({count}, 1)", count=calc.count))
    return np.broadcast_to(given, (calc.count, 1))


def row(step: Any, found: Any, calc: StepEngine) -> Array:
    """Return what a function gives for the parts of a list, shape (variants, parts); Misdeclared where it is not such a row."""
    given = _numbers(step, found, phrase("an array of numbers, one for each part"))
    if given.ndim > 2:
        raise misgiven(step, _array(given), phrase("a row of numbers for each machine"))
    parts = calc.part_count(step.over)
    if parts is not None and given.shape[-1:] != (parts,):  # a part that it leaves out would be judged by nothing
        template = "a number for each of the {count} parts of {parts}"
        raise misgiven(step, _array(given), Phrase(template, count=parts, parts=step.over))
    whole = np.broadcast_to(np.atleast_2d(given), (calc.count, given.shape[-1]))
    return whole if given.dtype == bool else whole.astype(float)


def texts(step: Any, found: Any, count: int) -> Array:
    """Return the texts that a function gives for all variants, shape (variants, 1), one alone that of all; Misdeclared for another number."""
    given = [found] * count if isinstance(found, str) else list(found.flat if isinstance(found, np.ndarray) else found)
    if len(given) != count:
        wanted = Phrase("a text for each machine, {count}", count=count)
        raise misgiven(step, Phrase("{n} values", n=len(given)), wanted)
    plain = (str(each) if isinstance(each, np.str_) else each for each in given)
    return np.array([text(step, each) for each in plain], dtype=object)[:, None]


def partners(step: Any, found: Any, shape: tuple[int, ...]) -> Array:
    """Return which part each part clashes with, of the shape of the rows that it takes; Misdeclared where it is none."""
    given = _numbers(step, found, phrase("an array of indices"))
    if given.shape != shape:
        raise misgiven(step, _array(given), Phrase("an index for each part, shape {shape}", shape=shape))
    return given


def text(step: Any, found: Any, part: int = 0) -> str:
    """Return the text that a function gives, of one for each part that of a part; Misdeclared where it is none."""
    if getattr(step, "each_part", False):
        if not (isinstance(found, tuple) and all(isinstance(each, str) for each in found)):
            raise misgiven(step, reprlib.repr(found), phrase("a tuple of texts, one for each part"))
        return str(found[part])
    if not isinstance(found, str):
        raise misgiven(step, reprlib.repr(found), 'a text, f"…"')
    return found


def _array(given: Array) -> Phrase:
    return Phrase("an array of shape {shape}", shape=given.shape)


def _numbers(step: Any, found: Any, wanted: str) -> Array:
    try:
        given = np.asarray(found)
    except ValueError:  # a list of lists of unlike lengths
        given = np.array(None)
    if given.dtype == object and all(isinstance(each, Real) for each in given.flat):
        try:
            return given.astype(float)
        except OverflowError:
            raise misgiven(step, phrase("a number too large to calculate with"), wanted) from None
    if given.dtype.kind not in "biuf" or np.ma.is_masked(found):
        raise misgiven(step, reprlib.repr(found), wanted)
    if given.dtype.kind in "iuf" and given.dtype.itemsize < WIDE:
        raise misgiven(step, reprlib.repr(found), phrase("numbers of 64 bits, for shorter ones overflow or round"))
    return given


def misgiven(step: Any, given: str, wanted: str) -> Misdeclared:
    """Return that a step's function gives something else than it must."""
    name = getattr(step.function, "__name__", repr(step.function))
    template = "step {id}: its function {name} gives {given}; it must return {wanted}"
    return Misdeclared(Phrase(template, id=step.id, name=name, given=given, wanted=wanted), step.at)
