"""Figures: what each draws is there whenever the figure is made, runs over its abscissa and has its unit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain
from math import isclose, pi

import numpy as np

from diecut_report.declaration.formulas import kind_of, lacking
from diecut_report.declaration.names import KINDS, DeclaredNames, Fault, fault, kinds_told, told
from diecut_report.errors import nearest
from diecut_report.formulas.expression import Constant
from diecut_report.mechanism.figures import Bars, Figure, Panel, Plot, Polar
from diecut_report.mechanism.names import When
from diecut_report.mechanism.steps import PREFIX, ROLES, Abscissa, Phase
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, named, phrase

NUMBER, CURVE = frozenset({"number", "row"}), frozenset({"curve"})


def faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the figures, as far as they are data."""
    spectra = {spectrum.id: spectrum for spectrum in names.mechanism.spectra}
    for figure in names.mechanism.figures:
        of_spectrum = isinstance(figure, Plot) and figure.abscissa in spectra
        for text in () if of_spectrum else _wrong(figure, names):
            yield fault(figure, text)


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
                template = "has the range {range}, but no distance from the pole is below zero"
                yield Phrase(template, range=repr(figure.range))
        case Bars(groups=groups):
            for group in groups:
                for _, name in group.bars:
                    yield from _drawn(figure, names, name.removeprefix("-"), group.unit, NUMBER)
                where = Phrase(" in the group {label}", label=repr(group.label))
                yield from _range(figure, names, group.range, group.unit, where)


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
        template = "has the range {ends}{where}; write its two ends, (0, None), each a number, an id or None"
        yield Phrase(template, ends=repr(ends), where=where)
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
    kinds, axes = names.kinds(name), names.axes(name)
    if absent := lacking(names, name, When(frozenset(figure.needs))):
        yield Phrase("draws {absent}", absent=absent)
    elif not kinds & allowed:
        wanted = KINDS["curve" if allowed is CURVE else "number"]
        template = "draws {name}, which is {kinds}; {wanted} is wanted there"
        yield Phrase(template, name=name, kinds=kinds_told(kinds), wanted=wanted)
    elif axis and axis not in axes:
        yield Phrase("draws {name}, which runs over {axes}, over {axis}", name=name, axes=", ".join(axes), axis=axis)
    else:
        givers = (giver for giver in names.givers(name) if giver.kind in allowed)
        units = {each for giver in givers for each in giver.units_when(figure.needs)}
        if all(unit(each).kind != unit(wanted).kind for each in units):
            own = ", ".join(sorted(units)) or phrase("no unit")
            yield Phrase("draws {name}, in {units}, on an axis in {wanted}", name=name, units=own, wanted=wanted)


# Phases: each has one form, a role that there is, places of its own abscissa, and holds phases that are there when it is.


PARTS_OF_A_TURN = 360  # of half of one: periods of half a degree, and of all multiples of it
Known = Mapping[str, list[tuple[int, When, Phase]]]


def phases_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with phases, and with the speed of an abscissa."""
    known: dict[str, list[tuple[int, When, Phase]]] = {}
    for number, (step, when) in enumerate(names.steps):
        texts: Iterator[str] = iter(())
        if isinstance(step, Phase):
            known.setdefault(step.id.removeprefix(PREFIX), []).append((number, when, step))
            texts = _of_phase(step, when, names, known)
        elif isinstance(step, Abscissa):
            texts = chain(_of_period(step), _of_speed(step, names) if step.speed else ())
        yield from (fault(step, text) for text in texts)


def _of_phase(step: Phase, when: When, names: DeclaredNames, known: Known) -> Iterator[str]:
    if step.role not in ROLES:
        near, roles = nearest(step.role, ROLES), ", ".join(ROLES)
        yield Phrase("has the role {role}{nearest}; there are {roles}", role=repr(step.role), nearest=near, roles=roles)
    if not step.description:
        yield phrase("has no description")
    if [bool(step.spans), bool(step.union), bool(step.rest_of)].count(True) != 1:
        yield phrase("needs one of three forms: places it goes between, (start, end), or union=(…), or rest_of=(…)")
    for each in (*step.union, *step.rest_of):
        yield from _held(step, each, when, names, known)
    for bare in (end for span in step.spans for end in span if not isinstance(end, str) and end != 0):
        template = (
            "goes to {place}, a number without a unit; name the input or the step that gives the place, by its id"
        )
        yield Phrase(template, place=f"{bare:g}")
    axis = {giver.unit for giver in names.givers(step.abscissa) if giver.unit}
    end = phrase("goes to {place}, in {units}; its abscissa {abscissa} is in {axis}")
    places = [(end, each) for span in step.spans for each in span if isinstance(each, str)]
    period = phrase("has the period {place}, in {units}; its abscissa {abscissa} is in {axis}")
    for template, place in (*places, (period, step.period)):
        units = names.units(place, step.needs)
        if units and not any(kind_of(one) == kind_of(other) for one in units for other in axis):
            filling = {"units": named(sorted(units), " or "), "axis": named(sorted(axis), " or ")}
            yield Phrase(template, filling, place=place, abscissa=step.abscissa)


def _held(step: Phase, name: str, when: When, names: DeclaredNames, known: Known) -> Iterator[str]:
    """What is wrong with a phase that another one holds together or leaves out."""
    own = step.id.removeprefix(PREFIX)
    others = [each for each in known.get(name, ()) if name != own]
    if not others:
        near = nearest(name, [each for each in known if each != own])
        yield Phrase("takes the phase {name}, which is not declared above it{near}", name=name, near=near)
        return
    if any(other.abscissa != step.abscissa for _, _, other in others):
        yield Phrase("takes the phase {name}, which runs over another abscissa", name=name)
    given = names.world.example(when, [other for _, other, _ in others])
    if given is not None:
        where = told(given, set().union(*(part for each in (when, *(w for _, w, _ in others)) for part in each)))
        template = "takes the phase {name}, which there is not {where}; give both the same needs"
        yield Phrase(template, name=name, where=where)


def _of_period(step: Abscissa) -> Iterator[str]:
    """A number is a part of a turn, by np.pi, or a constant with its unit: all else could be meant in any unit."""
    given = step.period
    if isinstance(given, str | Constant):
        return
    if kind_of(step.unit) != kind_of("rad"):
        template = (
            "has the period {given}, a number without a unit; name the input or the step that gives it, by its id"
        )
        yield Phrase(template, given=f"{given:g}")
    elif not isclose(parts := PARTS_OF_A_TURN * given / pi, round(parts), rel_tol=1e-12):
        template = "has the period {given}, a number of radians that is not a part of a turn; write 2 * np.pi for a turn, or name what gives it"
        yield Phrase(template, given=f"{given:g}")


def _of_speed(step: Abscissa, names: DeclaredNames) -> Iterator[str]:
    wanted = f"{step.unit}/s"
    units = names.units(step.speed, step.needs)
    if units and not any(kind_of(one) == kind_of(wanted) for one in units):
        template = "is run through with {speed}, in {units}; a speed in {wanted} is needed"
        yield Phrase(template, speed=step.speed, units=named(sorted(units), " or "), wanted=wanted)


# Spectra: curves over a range of their own have ids of their own, and a number for each place of the range.


def spectra_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the spectra."""
    known = {name for name in names.known if names.kinds(name) & {"curve", "abscissa"}}
    for spectrum in names.mechanism.spectra:
        for curve in (spectrum, *spectrum.lines()):
            subject = Phrase("curve {id}", id=curve.id)
            if curve.id in known:
                yield Fault(curve.at, subject, phrase("of a spectrum has the id of another curve; name it otherwise"))
            if np.shape(curve.values) != (len(spectrum.values),) or not np.isfinite(curve.values).all():
                yield Fault(curve.at, subject, Phrase("does not have one number for each of {id}", id=spectrum.id))
            if not (curve.symbol and curve.description):
                yield Fault(curve.at, subject, phrase("has no symbol or no description"))
            known.add(curve.id)
