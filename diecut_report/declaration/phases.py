"""Phases: each has one form, a role that there is, places of its own abscissa, and holds phases that are there when it is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain
from math import isclose, pi

from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.phases import PREFIX, ROLES
from diecut_report.contract.steps import Abscissa, Phase, Step
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.units import kind_of
from diecut_report.declaration.words import Fault
from diecut_report.declaration.world import When, told
from diecut_report.errors import nearest
from diecut_report.expressions import Constant
from diecut_report.languages.phrases import Phrase, named, phrase

PARTS_OF_A_TURN = 360  # of half of one: periods of half a degree, and of all multiples of it
Known = Mapping[str, list[tuple[int, When, Phase]]]


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with phases, and with the speed of an abscissa."""
    known: dict[str, list[tuple[int, When, Phase]]] = {}
    for number, (_, step) in enumerate(mechanism.steps):
        texts: Iterator[str] = iter(())
        if isinstance(step, Phase):
            known.setdefault(step.id.removeprefix(PREFIX), []).append((number, names.when(number), step))
            texts = _of_phase(step, number, names, known)
        elif isinstance(step, Abscissa):
            texts = chain(_of_period(step), _of_speed(step, names) if step.speed else ())
        yield from (Fault(step.at, _subject(step), text) for text in texts)


def _subject(step: Step) -> str:
    return (
        Phrase("phase {name}", name=step.id.removeprefix(PREFIX))
        if isinstance(step, Phase)
        else Phrase("step {id}", id=step.id)
    )


def _of_phase(step: Phase, number: int, names: DeclaredNames, known: Known) -> Iterator[str]:
    if step.role not in ROLES:
        yield Phrase(
            "has the role {role}{nearest}; there are {roles}",
            role=repr(step.role),
            nearest=nearest(step.role, ROLES),
            roles=", ".join(ROLES),
        )
    if not step.description:
        yield phrase("has no description")
    if [bool(step.spans), bool(step.union), bool(step.rest_of)].count(True) != 1:
        yield phrase("needs one of three forms: places it goes between, (start, end), or union=(…), or rest_of=(…)")
    for each in (*step.union, *step.rest_of):
        yield from _held(step, each, names.when(number), names, known)
    for bare in (end for span in step.spans for end in span if not isinstance(end, str) and end != 0):
        yield Phrase(
            "goes to {place}, a number without a unit; name the input or the step that gives the place, by its id",
            place=f"{bare:g}",
        )
    axis = {giver.unit for giver in names.givers(step.abscissa) if giver.unit}
    for place in (end for span in step.spans for end in span if isinstance(end, str)):
        units = {each for giver in names.givers(place) for each in giver.units_when(step.needs)}
        if units and not any(kind_of(one) == kind_of(other) for one in units for other in axis):
            yield (
                Phrase(
                    "goes to {place}, in {units}; its abscissa {abscissa} is in {axis}",
                    place=place,
                    units=named(sorted(units), " or "),
                    abscissa=step.abscissa,
                    axis=named(sorted(axis), " or "),
                )
            )


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
        yield Phrase(
            "takes the phase {name}, which there is not {where}; give both the same needs", name=name, where=where
        )


def _of_period(step: Abscissa) -> Iterator[str]:
    """A number is a part of a turn, by np.pi, or a constant with its unit: all else could be meant in any unit."""
    given = step.period
    if isinstance(given, str | Constant):
        return
    if kind_of(step.unit) != kind_of("rad"):
        words = "has the period {given}, a number without a unit; name the input or the step that gives it, by its id"
        yield Phrase(words, given=f"{given:g}")
    elif not isclose(parts := PARTS_OF_A_TURN * given / pi, round(parts), rel_tol=1e-12):
        words = "has the period {given}, a number of radians that is not a part of a turn; write 2 * np.pi for a turn, or name what gives it"
        yield Phrase(words, given=f"{given:g}")


def _of_speed(step: Abscissa, names: DeclaredNames) -> Iterator[str]:
    wanted = f"{step.unit}/s"
    units = {each for giver in names.givers(step.speed) for each in giver.units_when(step.needs)}
    if units and not any(kind_of(one) == kind_of(wanted) for one in units):
        yield Phrase(
            "is run through with {speed}, in {units}; a speed in {wanted} is needed",
            speed=step.speed,
            units=named(sorted(units), " or "),
            wanted=wanted,
        )
