"""Units: what a step takes over as it is has the step's kind of unit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import Lookup, Neighbour, Part, Pick, Running, Total
from diecut_report.contract.steps import Crossings, Reduction, Step
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.languages.phrases import Phrase, named, phrase
from diecut_report.quantities.units import unit
from diecut_report.standards import StandardSeries, StandardTable

AS_IT_IS = ("max", "min", "abs_max", "range", "mean", "rms", "sum")  # operations that leave the unit as it is


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the steps in another kind of unit than what they take over."""
    for number, (_, step) in enumerate(mechanism.steps):
        own = [step.unit, *(other for _, other in step.units)]
        for what, units in _taken(step, names, number):
            if units and not any(kind_of(one) == kind_of(other) for one in own for other in units):
                text = Phrase(
                    "is in {own}, {what} in {units}; give it the unit of what it takes over",
                    own=named(own, " or "),
                    what=what,
                    units=named(sorted(units), " or "),
                )
                yield Fault(step.at, Phrase("step {id}", id=step.id), text)


def _taken(step: Step, names: DeclaredNames, number: int) -> Iterator[tuple[str, set[str]]]:
    """What a step takes over as it is, with the units that it may have."""
    match step:
        case Total(of=of, operation="product") | Running(of=of, operation="product"):
            yield phrase("a product of any number of parts"), {"1"}
            yield of, _units(names, of, step, number)
        case Total(of=of, operation=operation) | Running(of=of, operation=operation) if operation in AS_IT_IS:
            yield of, _units(names, of, step, number)
        case Reduction(of=of, operation=operation) if operation in AS_IT_IS:
            yield of, _units(names, of, step, number)
        case Neighbour(of=of) | Part(of=of):
            yield of, _units(names, of, step, number)
        case Crossings(of=of):
            for axis in sorted(names.axes(of)):
                yield axis, _units(names, axis, step, number)
        case Pick(of=of, series=series):
            yield of, _units(names, of, step, number)
            several = series.values() if isinstance(series, Mapping) else (series,)
            yield from (
                (Phrase("the series {title}", title=one.title), {one.unit})
                for one in several
                if isinstance(one, StandardSeries)
            )
        case Lookup(table=StandardTable() as table, column=column):
            yield (
                Phrase("the table {title}", title=table.title),
                {one.unit for one in table.of_values if len(table.of_values) == 1 or one.name == column},
            )


def kind_of(text: str) -> object:
    """Return the kind of a unit; of one that is unknown, which is told where formulas are, its text."""
    try:
        return unit(text).kind
    except ValueError:
        return text


def _units(names: DeclaredNames, name: str, step: Step, number: int) -> set[str]:
    """The units of what is given before a step."""
    givers = [giver for giver in names.givers(name) if giver.number < number]
    return {each for giver in givers for each in giver.units_when(step.needs)}
