"""Units that are none: nothing that is measured in one can be judged, so that they are told before all else is asked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from diecut_report.contract.figures import Bars, Drawing, Figure, Plot, Polar
from diecut_report.contract.inputs import fields
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.input_places import of_input
from diecut_report.declaration.words import Fault
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import unit


def faults(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield each unit of an input, a step, a check or a figure that nobody knows."""
    for path, meta in fields(mechanism.inputs):
        for text in _unknown([getattr(meta, "unit", "1"), *(own for _, own in getattr(meta, "units", ()))]):
            yield Fault(of_input(mechanism.inputs, path, mechanism.at), Phrase("input {path}", path=path), text)
    for _, step in mechanism.steps:
        for text in _unknown([step.unit, *(own for _, own in step.units)]):
            yield Fault(step.at, Phrase("step {id}", id=step.id), text)
    for check in mechanism.checks:
        yield from (Fault(check.at, Phrase("check {id}", id=check.id), text) for text in _unknown([check.unit]))
    for figure in mechanism.figures:
        for text in _unknown(_drawn(figure)):
            yield Fault(figure.at, Phrase("figure {id}", id=figure.id), text)


def _unknown(units: Iterable[object]) -> Iterator[str]:
    for text in dict.fromkeys(units):
        if not isinstance(text, str):
            yield Phrase('has the unit {text}; write a text, "mm"', text=repr(text))
            continue
        try:
            unit(text)
        except ValueError as unknown:
            yield Phrase("has the unit {text}: {unknown}", text=repr(text), unknown=unknown)


def _drawn(figure: Figure) -> list[str]:
    match figure:
        case Plot(panels=panels):
            return [panel.unit for panel in panels]
        case Bars(groups=groups):
            return [group.unit for group in groups]
        case Polar() | Drawing():
            return [figure.unit]
    return []
