"""Runs the steps of a mechanism in their order, for one machine or for an array of variants."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible, ImpossibleTogether, Unproven, of_rows
from diecut_report.machine.mechanism import MechanismHandle, PhaseHandle, overlong
from diecut_report.machine.numerics import extremes, roots_integrals
from diecut_report.machine.numerics.curves import SampledCurve
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.printing.substitution import filled
from diecut_report.machine.steps import needed as needs
from diecut_report.machine.steps import soundness
from diecut_report.machine.steps.again import Again
from diecut_report.machine.steps.needed import needed, needed_again
from diecut_report.mechanism.checks import Refusal, by_part
from diecut_report.mechanism.inputs import list_inputs, texts_given
from diecut_report.mechanism.mechanism import Machines, Mechanism, of_machine
from diecut_report.mechanism.steps import Step, part_result, result_names
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, phrase

EMPTY = phrase("is empty; give at least one")
WHOLE = 1e-9  # by which a count may be off a whole number, for rounding


class MachineRun(Calculation):
    """Answer what steps ask of the engine while they are run (``StepEngine``)."""

    SAME_HEIGHT = extremes.SAME_HEIGHT
    root = roots_integrals.root
    proves_nothing = roots_integrals.proves_nothing
    extreme = extremes.extreme
    beyond = extremes.outruns
    fails = soundness.fails
    crossings = roots_integrals.all_crossings
    integral = roots_integrals.integral
    accumulate = roots_integrals.accumulate
    differentiate = roots_integrals.differentiate
    filled = filled

    def open_abscissa(self, step: Step, period: Array, points: int, intervals: int) -> None:
        """Let curves run over a step's abscissa."""
        self.domains[step.id] = Domain(period, np.arange(points) * (period / points), intervals)

    def add_curves(self, curves: Mapping[str, Any], axis: str) -> None:
        """Take note of curves that plain code gives."""
        self.curves |= curves
        self.steps = {**self.steps, **curves}
        self.axis = self.axis | dict.fromkeys(curves, axis)

    def withdraw(self, fact: str) -> None:
        """Let the steps take no part that need a fact which no machine meets."""
        self.given -= {fact}
        known: dict[str, Step] = dict(self.curves)  # those of named parts too, which are not declared one by one
        self.steps = known | {each.id: each for _, each in self.mechanism.active(self.given)}
        self.axis = {name: self.axis[name] for name in known} | self.mechanism.axes(self.given)

    def again(self, step: Step) -> Again:
        """Return what calculates the same machines with other inputs."""
        return Again(self, calculate, step)

    # What is refused of a single machine, and marked among several.

    def mark(self, step: Step, bad: Array, words: str) -> None:
        """Refuse a single machine as not proved; mark these variants among several."""
        if self.count == 1:
            raise Unproven(words, step.at)
        self.flaws |= {int(variant): (step.id, words) for variant in np.flatnonzero(bad)}

    def refuse(self, variant: int, key: str, message: str) -> None:
        """Mark a variant as impossible, with the key to change, unless it is already; a single machine is refused."""
        if variant in self.flaws and self.count > 1:
            return
        self.flaws[variant] = key, message
        if self.count == 1:
            raise Impossible([(key, message)])

    def prove(self, step: Step, residual: Array, tolerance: float = roots_integrals.SAMPLE_TOLERANCE) -> None:
        """Refuse a result whose residual is greater; keep the residual for print."""
        if self.count == 1 and residual[0, 0] <= tolerance:
            self.proof[step.id] = max(float(residual[0, 0]), 0.0)
            return
        unproved = ~(residual[:, 0] <= tolerance) & self.possible
        self.proof[step.id] = float(np.max(residual[self.possible & ~unproved], initial=0.0))
        if unproved.any():
            left = format(np.max(residual[unproved]), ".1e")
            template = "{description}: the proof leaves {residual}, not {tolerance}"
            message = Phrase(template, description=step.description, residual=left, tolerance=format(tolerance, ".0e"))
            self.mark(step, unproved, message + soundness.sharpest(self, step))

    def require_finite(self, step: Step) -> None:
        """Require that no number of a possible machine is NaN or infinite, but for an absent output and the padding of crossings."""
        values = self.values.get(step.id)
        if values is None or values.dtype == object or step.exists is not None or step.is_counted:
            return
        if values.size == 1 and isfinite(values.item()):
            return
        is_finite = np.isfinite(values)
        if is_finite.all():
            return
        bad = ~is_finite.all(axis=1) & self.possible
        if bad.any():
            template = "{description} ({id}) has no value with these inputs"
            self.mark(step, bad, Phrase(template, description=step.description, id=step.id))

    def require_whole(self, step: Step) -> None:
        """Require that what is marked as a count is whole: the results would round it."""
        values = self.values.get(step.id)
        if not step.whole or values is None or values.dtype == object:
            return
        numbers = values / unit(step.unit).factor
        bad = (np.abs(numbers - np.round(numbers)) > WHOLE * np.maximum(np.abs(numbers), 1)).any(axis=1) & self.possible
        if bad.any():
            template = "{description} ({id}, {name}) is {given}, but is marked as a count (whole=True)"
            given = f"{numbers[np.flatnonzero(bad)[0]].ravel()[0]:.6g}"
            message = Phrase(template, description=step.description, id=step.id, name=Path(step.at).name, given=given)
            self.mark(step, bad, Phrase("{words}; round it in its formula, or take whole=True away", words=message))

    def reasons(self, steps: Sequence[Step]) -> Iterator[tuple[str, str]]:
        """Yield why else a machine cannot exist, as far as it can be told from what is known already."""
        known = {*self.inputs, *self.values, *(f"inputs.{name}" for name in self.inputs)}
        for step in steps:
            if step.can_be_judged(known):
                try:
                    step.run(self)
                except Impossible as other:
                    yield from other.reasons

    # Plain code, of one machine or for each of many.

    def call(self, step: Any, taken: Sequence[Any]) -> Any:
        """Call plain code; what it refuses is an impossible machine."""
        try:
            return step.function(*taken)
        except Refusal as refused:
            kind = Impossible if self.count == 1 else ImpossibleTogether
            raise kind([(refused.key, refused.words)]) from None

    def prepared(self, step: Any, known: Mapping[str, Any]) -> Machines:
        """Call plain code that knows one machine, for each of many, with a mapping."""
        for key, value in known.items():
            for each in value if isinstance(value, tuple) else (value,):
                if isinstance(each, MechanismHandle):
                    for row in each.calculation.flaws:
                        self.refuse(row, key, Phrase("is {name}, which cannot be", name=each.name))

        def make(row: int) -> Any:
            return step.function({name: of_machine(value, row, self.count) for name, value in known.items()})

        return Machines(self._each(make))

    def computed(self, step: Any, taken: Sequence[Any]) -> Any:
        """Call plain code, for each of many machines where what it takes knows one alone."""
        if not any(isinstance(each, Machines) for each in taken):
            found = self.call(step, taken)
            # three numbers for three machines, or for the three parts of the first one: those of all have a row each
            dimensions = 1 if step.is_text else 2
            is_of_all = self.count == 1 or (np.ndim(found) == dimensions and len(found) == self.count)
            if is_of_all or not any(map(_tells_of_one, taken)):
                return found

        def make(row: int) -> Any:
            return np.ravel(step.function(*(of_machine(value, row, self.count) for value in taken)))

        rows = self._each(make)
        width = max((len(row) for row in rows if row is not None), default=1)
        return np.stack([np.full(width, np.nan) if row is None else row for row in rows])

    def _each(self, make: Callable[[int], Any]) -> list[Any]:
        found: list[Any] = [None] * self.count
        for row in np.flatnonzero(self.possible):
            try:
                found[row] = make(int(row))
            except Refusal as refused:
                self.refuse(int(row), refused.key, refused.words)
        return found

    # Rows and curves that are called by the names of their parts.

    def require_distinct(self) -> None:
        """Refuse parts of one name, and a part whose check would be called as another one: one of the two would be lost."""
        named_by = {step.named_by for step in self.steps.values()} | {check.named_by for check in self.mechanism.checks}
        named_by |= {path for path in list_inputs(self.mechanism.inputs) if path.endswith(".name")}
        for path in sorted(named_by - {""}):
            names = self.inputs.get(path) or ()
            for index, name in enumerate(names):
                if name is not None and name in names[:index]:
                    home, first = path.rpartition(".")[0], names.index(name) + 1
                    template = "is {name}, as is that of part {first} of {home}; give each part a name of its own"
                    raise _of_part(path, index, Phrase(template, name=name, first=first, home=home))
        self._require_distinct_checks()

    def _require_distinct_checks(self) -> None:
        known: dict[str, tuple[str, str]] = {}
        for check in sorted(self.mechanism.checks, key=lambda each: bool(each.named_by)):
            for made in by_part([check], self.inputs.get):
                own = check.id, made.part_name
                if made.index is not None and known.get(made.id, own) != own:
                    template = "is {name}, with which its check {id} would be called as another one; take another name"
                    raise _of_part(check.named_by, made.index, Phrase(template, name=made.part_name, id=made.id))
                known[made.id] = own

    def name_row(self, step: Step) -> None:
        """Put the parts of a row under names of their own."""
        if (step.numbered or step.named_by) and step.id in self.values:
            row = self[step.id]
            made = result_names(step, row.shape[1], self.names_of_parts(step))
            self.values |= {each.name: row[:, [each.index]] for each in made}
            if step.named_by:
                self.row_of |= dict.fromkeys((each.name for each in made), step.id)

    def names_of_parts(self, step: Step) -> tuple[str, ...] | None:
        """Return the names of the parts of a row or curve; Impossible where a result would be called as another one."""
        names: tuple[str, ...] | None = self.inputs.get(step.named_by)
        for index, name in enumerate(names or ()):
            called = part_result(name, step)
            is_given = called in self.inputs or self.names.result(called, self.steps) is not None
            if is_given or self.row_of.get(called, step.id) != step.id:
                template = "is {name}, with which its result {called} would be called as another one; take another name"
                raise _of_part(step.named_by, index, Phrase(template, name=name, called=called))
        return names


def _tells_of_one(value: Any) -> bool:
    """Whether plain code learns of it what is of one machine: of a mechanism or a phase, which tell of the first of many."""
    if isinstance(value, tuple):
        return any(map(_tells_of_one, value))
    return isinstance(value, MechanismHandle | PhaseHandle)


def _of_part(path: str, index: int, words: str) -> Impossible:
    home, _, key = path.rpartition(".")
    return Impossible([(f"{home}.{index}.{key}", words)])


def with_sampled_curves(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return inputs whose curves that are listed as values are curves."""
    listed = {name: SampledCurve(v) for name in mechanism.curve_inputs if isinstance(v := values.get(name), tuple)}
    return {**values, **listed}


def calculate(
    mechanism: Mechanism, values: Mapping[str, Any], variants: int = 1, only: Container[str] | None = None,
    known: Mapping[str, Array] | None = None,
) -> Calculation:  # fmt: skip
    """Calculate a mechanism, or only those of its steps that are named, with what is ``known`` already.

    ``values`` holds the inputs by id in SI: numbers, or arrays of shape (variants,); tuples for the parts of a list;
    texts, flags, ``CurveHandle``. Optional inputs that are not given are left out.
    Raises ``Impossible`` when a single machine cannot exist (among several it is marked in ``flaws``), ``Unproven`` when a
    result does not meet what proves it.
    """
    calc = MachineRun(mechanism, with_sampled_curves(mechanism, values), variants)
    calc.is_partial = only is not None
    calc.values.update(known or {})
    calc.require_distinct()
    with np.errstate(all="ignore"):
        steps = [step for _, step in mechanism.active(calc.given) if only is None or step.id in only]
        for i, step in enumerate(steps):
            if step.id not in calc.steps or not step.is_run:
                continue
            try:
                if step.asked_curve:
                    coming = (each for each in steps[i:] if each.id in calc.steps) if calc.withheld else steps[i:]
                    needs.look(calc, step, list(coming))
                    soundness.require(calc, step.id, step.asked_curve)
                step.run(calc)
            except KeyError as missing:
                asked = str(missing.args[0]).removeprefix("inputs.") if missing.args else ""
                home = list_inputs(mechanism.inputs).get(asked)
                if home is None or home in calc.given:
                    raise
                raise Impossible([(home, EMPTY)]) from None
            except Impossible as first:
                raise type(first)([*first.reasons, *calc.reasons(steps[i + 1 :])]) from None
            calc.require_finite(step)
            calc.require_whole(step)
            calc.name_row(step)
        for stand_in, residual in soundness.searched(calc) if only is None else ():
            calc.prove(stand_in, residual)
        for phase, variant, words in overlong(calc) if only is None else ():
            calc.mark(phase, np.arange(calc.count) == variant, words)
    return calc


# The same machine calculated again with other inputs: only the steps that the asked quantities need.


def varied(calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str]) -> dict[str, Array]:
    """Return numbers for other inputs, each of shape (variants,); NaN where the machine is then impossible, or does not have them."""
    count = max((np.size(value) for value in inputs.values() if not isinstance(value, str)), default=1)
    again = recalculated(calc, _spread(inputs, count), count, names)
    if again is None:
        return {name: np.full(count, np.nan) for name in names}
    known = {name: again.possible & ~soundness.without(again, name)[0] for name in names}
    return {
        name: np.where(known[name], again[name][:, 0], np.nan) if known[name].any() else np.full(count, np.nan)
        for name in names
    }


def _spread(inputs: Mapping[str, Any], count: int) -> dict[str, Any]:
    return {name: value if isinstance(value, str) else np.broadcast_to(np.asarray(value, dtype=float), (count,))
            for name, value in inputs.items()}  # fmt: skip


def varied_curves(
    calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str], points: int
) -> tuple[Array, dict[str, Array]]:
    """Return curves over one abscissa for other inputs, at so many places of the whole of it, ends included.

    NaN where the machine is then impossible.
    """
    again = recalculated(calc, _spread(inputs, 1), 1, names)
    axis = calc.axis[names[0]]
    period = float((again or calc).domains[axis].period[0, 0])
    x = np.linspace(0, period, points)
    if again is None:
        return x, dict.fromkeys(names, np.full(points, np.nan))
    places = np.minimum(x, np.nextafter(period, 0))[None, :]
    curves = again.sampler_of(axis, places, again.domains[axis].middle_of(places), None)
    return x, {name: np.broadcast_to(curves[name], places.shape)[0] for name in names}


def recalculated(
    calc: Calculation, changed: Mapping[str, Any], count: int, names: Sequence[str] | None = None
) -> Calculation | None:
    """Return so many machines that differ from the first of a calculation in the inputs ``changed``; None where all are impossible.

    Only the steps that ``names`` need are run; all of them where it is None.
    """
    first = np.zeros(count, dtype=int)
    inputs = {name: of_rows(value, first, calc.count) for name, value in calc.inputs.items() if name in calc.given}
    inputs |= changed
    only, known = _asked_again(calc, inputs, changed, names)
    try:
        return calculate(
            calc.mechanism, inputs, count, only, {name: np.full((count, 1), calc.values[name][0, 0]) for name in known}
        )
    except (Impossible, Unproven):
        return None


def _asked_again(
    calc: Calculation, inputs: Mapping[str, Any], changed: Mapping[str, Any], names: Sequence[str] | None
) -> tuple[Container[str] | None, Iterable[str]]:
    """The steps that must run again, all where it is None, and the numbers that stay, where the changed inputs switch no step."""
    given = (
        frozenset(inputs) | texts_given(inputs) | calc.mechanism.facts
    )  # which they may meet even if the first machine does not
    if names is None:
        return None, ()
    if calc.count > 1 or calc.is_partial or given != calc.given:
        return needed(calc.mechanism, given, names), ()
    single = (name for name, value in calc.values.items() if value.shape == (1, 1) and value.dtype != object)
    numbers = frozenset(name for name in single if name not in calc.axis)
    return needed_again(calc.mechanism, given, tuple(names), frozenset(changed), numbers)
