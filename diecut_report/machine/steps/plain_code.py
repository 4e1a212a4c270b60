"""What a plugin's plain code gives back: numbers of the right shape, or a text; all else is told of the step and its function."""

from __future__ import annotations

import reprlib
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from numbers import Real
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.mechanism.checks import by_part
from diecut_report.mechanism.inputs import list_inputs
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.part_steps import ComputedCurve, PartCurves, PartNames
from diecut_report.mechanism.steps import Clash, Computed, Step, Words, part_result, result_names
from diecut_report.text.phrases import Phrase, phrase

# Rows and curves that are called by the names of their parts.


def distinct(calc: Calculation) -> None:
    """Refuse parts of one name, and a part whose check would be called as another one: one of the two would be lost."""
    named_by = {step.named_by for step in calc.steps.values()} | {check.named_by for check in calc.mechanism.checks}
    named_by |= {path for path in list_inputs(calc.mechanism.inputs) if path.endswith(".name")}
    for path in sorted(named_by - {""}):
        names = calc.inputs.get(path) or ()
        for index, name in enumerate(names):
            if name is not None and name in names[:index]:
                home, first = path.rpartition(".")[0], names.index(name) + 1
                words = "is {name}, as is that of part {first} of {home}; give each part a name of its own"
                raise Impossible([(_key(path, index), Phrase(words, name=name, first=first, home=home))])
    _distinct_checks(calc)


def _distinct_checks(calc: Calculation) -> None:
    known: dict[str, tuple[str, str]] = {}
    for check in sorted(calc.mechanism.checks, key=lambda each: bool(each.named_by)):
        for made in by_part([check], calc.inputs.get):
            own = check.id, made.part_name
            if made.index is not None and known.get(made.id, own) != own:
                words = "is {name}, with which its check {id} would be called as another one; take another name"
                raise Impossible([(_key(check.named_by, made.index), Phrase(words, name=made.part_name, id=made.id))])
            known[made.id] = own


def _key(path: str, index: int) -> str:
    home, _, key = path.rpartition(".")
    return f"{home}.{index}.{key}"


def name_row(calc: Calculation, step: Step) -> None:
    """Put the parts of a row under names of their own."""
    if (step.numbered or step.named_by) and step.id in calc.values:
        row, names = calc[step.id], names_of(calc, step)
        made = result_names(step, row.shape[1], names)
        calc.values |= {each.name: row[:, [each.index]] for each in made}
        if step.named_by:
            calc.row_of |= dict.fromkeys((each.name for each in made), step.id)


def curves_of(calc: Calculation, step: ComputedCurve) -> dict[str, ComputedCurve]:
    """Return the curve of each named part by its id; the step itself where it is of no parts."""
    names = names_of(calc, step)
    if names is None:
        return {step.id: step}
    made = (
        replace(step, id=part_result(name, step), description=Phrase("{quantity}: {part}", quantity=phrase(step.description), part=name), named_by="",
                function=partial(step.function, index))
        for index, name in enumerate(names)
    )  # fmt: skip
    return {each.id: each for each in made}


def names_of(calc: Calculation, step: Step) -> tuple[str, ...] | None:
    """Return the names of the parts of a row or curve; Impossible where a result would be called as another one."""
    names: tuple[str, ...] | None = calc.inputs.get(step.named_by)
    for index, name in enumerate(names or ()):
        called = part_result(name, step)
        is_given = called in calc.steps or called in calc.inputs or calc.names.result(called, calc.steps) is not None
        if is_given or calc.row_of.get(called, step.id) != step.id:
            words = Phrase(
                "is {name}, with which its result {called} would be called as another one; take another name",
                name=name,
                called=called,
            )
            raise Impossible([(_key(step.named_by, index), words)])
    return names


def taken(calc: Calculation, names: Iterable[str]) -> list[Any]:
    """Return what plain code takes; arrays are handed out to be read, for a change in place would be of the machine itself."""
    return [_to_read(calc[name]) for name in names]


def _to_read(given: Any) -> Any:
    if not isinstance(given, np.ndarray):
        return given
    own = given.view()
    own.flags.writeable = False
    return own


WIDE = 8  # bytes of a number


def part_names(calc: Calculation, step: PartNames) -> None:
    """Name the parts that rows run over."""
    found = step.function(*taken(calc, step.takes))
    if not found or not all(isinstance(each, str) for each in found):
        raise _told(step, step.function, reprlib.repr(found), phrase("a list of texts"))
    calc.part_names[step.id] = tuple(found)


def curve(calc: Calculation, step: ComputedCurve) -> None:
    """Take note of a curve, or of those of named parts, and cut its abscissa where they have corners."""
    made = curves_of(calc, step)
    calc.curves |= made
    calc.steps |= made
    calc.axis = calc.axis | dict.fromkeys(made, step.abscissa)
    if step.joints is not None:
        places = step.joints(calc.inputs[step.of])
        calc.domains[step.abscissa].cut(np.broadcast_to(places, (calc.count, places.shape[1])))


def part_curves(calc: Calculation, step: PartCurves) -> None:
    """Take note of the curves of all parts, and cut their abscissa where they have corners."""
    made = {each.id: each for each in step.curves(calc.inputs[step.of])}
    calc.curves |= made
    calc.steps = {**calc.steps, **made}
    calc.axis = {**calc.axis, **dict.fromkeys(made, step.abscissa)}
    if step.joints is not None and made:
        calc.domains[step.abscissa].cut(step.joints(calc.inputs[step.of]))


def number(step: Computed, found: Any, count: int) -> Array:
    """Return what a function gives as an array of shape (variants, 1); Misdeclared where it is none."""
    given = _numbers(step, step.function, found, phrase("a number"))
    if given.dtype == bool and step.unit != "1":
        raise _told(step, step.function, reprlib.repr(found), Phrase("a number in SI of {unit}", unit=step.unit))
    if given.shape not in ((), (1,), (1, 1), (count, 1)):
        raise _told(
            step,
            step.function,
            Phrase("an array of shape {shape}", shape=given.shape),
            Phrase("a number, shape ({count}, 1)", count=count),
        )
    return np.broadcast_to(given, (count, 1))


def row(step: Computed, found: Any, count: int) -> Array:
    """Return what a function gives for the parts of a list, shape (variants, parts); Misdeclared where it is no such row."""
    given = _numbers(step, step.function, found, phrase("an array of numbers, one for each part"))
    if given.ndim > 2:
        raise _told(
            step,
            step.function,
            Phrase("an array of shape {shape}", shape=given.shape),
            phrase("a row of numbers for each machine"),
        )
    whole = np.broadcast_to(np.atleast_2d(given), (count, given.shape[-1]))
    return whole if given.dtype == bool else whole.astype(float)


def texts(step: Computed, found: Any, count: int) -> Array:
    """Return the texts that a function gives for all variants, shape (variants, 1), one alone that of all; Misdeclared for another number."""
    given = [found] * count if isinstance(found, str) else list(found.flat if isinstance(found, np.ndarray) else found)
    if len(given) != count:
        words = Phrase("{n} values", n=len(given)), Phrase("a text for each machine, {count}", count=count)
        raise _told(step, step.function, *words)
    plain = (str(each) if isinstance(each, np.str_) else each for each in given)
    return np.array([text(step, each) for each in plain], dtype=object)[:, None]


def partners(step: Clash, found: Any, shape: tuple[int, ...]) -> Array:
    """Return which part each part clashes with, of the shape of the rows that it takes; Misdeclared where it is none."""
    given = _numbers(step, step.function, found, phrase("an array of indices"))
    if given.shape != shape:
        raise _told(
            step,
            step.function,
            Phrase("an array of shape {shape}", shape=given.shape),
            Phrase("an index for each part, shape {shape}", shape=shape),
        )
    return given


def text(step: Words | Computed, found: Any, part: int = 0) -> str:
    """Return the text that a function gives, of one for each part that of a part; Misdeclared where it is none."""
    if isinstance(step, Words) and step.each_part:
        if not (isinstance(found, tuple) and all(isinstance(each, str) for each in found)):
            raise _told(step, step.function, reprlib.repr(found), phrase("a tuple of texts, one for each part"))
        return str(found[part])
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
    if given.dtype.kind not in "biuf" or np.ma.is_masked(found):
        raise _told(step, function, reprlib.repr(found), wanted)
    if given.dtype.kind in "iuf" and given.dtype.itemsize < WIDE:
        raise _told(
            step, function, reprlib.repr(found), phrase("numbers of 64 bits, for shorter ones overflow or round")
        )
    return given


def _told(step: Step, function: Callable[..., Any], given: str, wanted: str) -> Misdeclared:
    name = getattr(function, "__name__", repr(function))
    return Misdeclared(
        Phrase(
            "step {id}: its function {name} gives {given}; it must return {wanted}",
            id=step.id,
            name=name,
            given=given,
            wanted=wanted,
        ),
        step.at,
    )
