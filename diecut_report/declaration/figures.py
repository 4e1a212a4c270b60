"""Figures: what each draws is there whenever the figure is made, runs over its abscissa and has its unit."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.contract.figures import Bars, Figure, Panel, Plot, Polar
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.order import lacking
from diecut_report.declaration.words import KINDS, Fault, kinds_told
from diecut_report.declaration.world import When
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.units import unit

NUMBER, CURVE = frozenset({"number", "row"}), frozenset({"curve"})


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the figures, as far as they are data."""
    spectra = {spectrum.id: spectrum for spectrum in mechanism.spectra}
    for figure in mechanism.figures:
        of_spectrum = isinstance(figure, Plot) and figure.abscissa in spectra
        for text in () if of_spectrum else _wrong(figure, names):
            yield Fault(figure.at, Phrase("figure {id}", id=figure.id), text)


def _wrong(figure: Figure, names: DeclaredNames) -> Iterator[str]:
    match figure:
        case Plot(abscissa=axis, panels=panels):
            yield from _axis(figure, names, axis)
            for panel in panels:
                yield from _panel(figure, names, axis, panel)
        case Polar(abscissa=axis, unit=own, series=series):
            yield from _axis(figure, names, axis)
            for one in series:
                yield from _drawn(figure, names, one.curve, own, CURVE, axis)
            yield from _range(figure, names, figure.range, own, "")
            if isinstance(figure.range, tuple) and isinstance(figure.range[0], int | float) and figure.range[0] < 0:
                yield Phrase(
                    "has the range {range}, but no distance from the pole is below zero", range=repr(figure.range)
                )
        case Bars(groups=groups):
            for group in groups:
                for _, name in group.bars:
                    yield from _drawn(figure, names, name.removeprefix("-"), group.unit, NUMBER)
                yield from _range(
                    figure, names, group.range, group.unit, Phrase(" in the group {label}", label=repr(group.label))
                )


def _axis(figure: Figure, names: DeclaredNames, axis: str) -> Iterator[str]:
    absent = lacking(names, axis, When(frozenset(figure.needs)))
    if absent:
        yield Phrase("the abscissa is {absent}", absent=absent)
    elif "abscissa" not in names.kinds(axis):
        yield Phrase("the abscissa is {axis}, which is not an Abscissa", axis=axis)


def _panel(figure: Figure, names: DeclaredNames, axis: str, panel: Panel) -> Iterator[str]:
    across = next((each for giver in names.givers(axis) for each in giver.units_when(figure.needs)), "1")
    for series in panel.series:
        yield from _drawn(figure, names, series.curve, panel.unit, CURVE, axis)
    yield from _range(figure, names, panel.range, panel.unit, Phrase(" in the panel {title}", title=repr(panel.title)))
    for level in panel.levels:
        yield from _drawn(figure, names, level.value, panel.unit, NUMBER)
    for mark in panel.marks:
        yield from _drawn(figure, names, mark.x, across, NUMBER)
        yield from _drawn(figure, names, mark.y, panel.unit, NUMBER)
    for span in panel.spans:
        yield from _drawn(figure, names, span.start, across, NUMBER)
        yield from _drawn(figure, names, span.end, across, NUMBER)


def _range(figure: Figure, names: DeclaredNames, ends: object, wanted: str, where: str) -> Iterator[str]:
    """What is wrong with the range of an axis: two ends, each a number, an id or None."""
    if ends is None:
        return
    if not isinstance(ends, tuple) or len(ends) != 2 or not all(isinstance(e, str | int | float | None) for e in ends):
        yield Phrase(
            "has the range {ends}{where}; write its two ends, (0, None), each a number, an id or None",
            ends=repr(ends),
            where=where,
        )
        return
    for end in ends:
        if isinstance(end, str):
            yield from _drawn(figure, names, end, wanted, NUMBER)
    low, high = ends
    if not isinstance(low, str | None) and not isinstance(high, str | None) and not low < high:
        yield Phrase("has the range {ends}{where}, whose ends do not ascend", ends=repr(ends), where=where)


def _drawn(
    figure: Figure, names: DeclaredNames, name: str, wanted: str, allowed: frozenset[str], axis: str = ""
) -> Iterator[str]:
    absent = lacking(names, name, When(frozenset(figure.needs)))
    givers = names.givers(name)
    if absent:
        yield Phrase("draws {absent}", absent=absent)
    elif not names.kinds(name) & allowed:
        yield Phrase(
            "draws {name}, which is {kinds}; {wanted} is wanted there",
            name=name,
            kinds=kinds_told(names.kinds(name)),
            wanted=KINDS["curve" if allowed is CURVE else "number"],
        )
    elif axis and axis not in names.axes(name):
        yield Phrase(
            "draws {name}, which runs over {axes}, over {axis}", name=name, axes=", ".join(names.axes(name)), axis=axis
        )
    else:
        units = {each for giver in givers if giver.kind in allowed for each in giver.units_when(figure.needs)}
        if all(unit(each).kind != unit(wanted).kind for each in units):
            yield Phrase(
                "draws {name}, in {units}, on an axis in {wanted}",
                name=name,
                units=", ".join(sorted(units)) or phrase("no unit"),
                wanted=wanted,
            )
