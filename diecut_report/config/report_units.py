"""The units in which a report shows its quantities: ``report: {units: {length: m, drive.crank_speed: rad/s}}``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.config.instances import Instance
from diecut_report.config.validation import ConfigPlace, told
from diecut_report.contract.inputs import Quantity, fields
from diecut_report.contract.steps import Step
from diecut_report.errors import Problem, nearest
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import UnitError, kind_name, unit

DIMENSIONS = {
    "length": "m", "area": "m**2", "volume": "m**3", "second_moment_of_area": "m**4", "mass": "kg", "density": "kg/m**3",
    "moment_of_inertia": "kg*m**2", "force": "N", "line_force": "N/m", "moment": "N*m", "energy": "J", "stress": "Pa",
    "speed": "m/s", "acceleration": "m/s**2", "angle": "rad", "rotational_speed": "rad/s", "angular_acceleration": "rad/s**2",
    "time": "s", "frequency": "1/s", "power": "W", "temperature_difference": "K",
}  # fmt: skip
"""What a report may choose one unit for, by the SI unit of its quantities."""

UNITS = "units"


def faults(given: Any, instances: Mapping[str, Instance | None], place: ConfigPlace) -> Iterator[Problem]:
    """Yield what is wrong with the chosen units; ``place`` is that of the report's block."""
    if given is None:
        return
    if not isinstance(given, dict):
        words = Phrase(
            "is {given}; keys with units are needed, as in units: {length: mm, rotational_speed: rad/s}",
            given=told(given),
        )
        yield place.problem((UNITS,), words)
        return
    for key, chosen in given.items():
        wanted = wanted_units(key, instances)
        if isinstance(wanted, str):
            yield place.problem((UNITS, key), wanted, at_key=True)
        elif fault := _unit_fault(chosen, wanted):
            yield place.problem((UNITS, key), fault)


def wanted_units(key: Any, instances: Mapping[str, Instance | None]) -> tuple[str, ...] | str:
    """Return the units of what a key names, a dimension or ``MECHANISM.QUANTITY``; in words why it names nothing."""
    if key in DIMENSIONS:
        return (DIMENSIONS[key],)
    name, dot, quantity = str(key).partition(".")
    if not dot:
        near = nearest(name, DIMENSIONS)
        return Phrase(
            "is not a dimension{near}; give MECHANISM.QUANTITY, or one of: {dimensions}",
            near=near,
            dimensions=", ".join(DIMENSIONS),
        )
    instance = instances.get(name)
    if instance is None:
        known = [each for each, found in instances.items() if found is not None]
        return Phrase(
            "names {name}, which is not there{nearest}; known: {known}",
            name=name,
            nearest=nearest(name, known),
            known=", ".join(known),
        )
    units = _units(instance)
    if quantity not in units:
        return Phrase(
            "names {quantity}, which is not a quantity of {name} with a number{nearest}",
            quantity=quantity,
            name=name,
            nearest=nearest(quantity, units),
        )
    return units[quantity]


def _units(instance: Instance) -> dict[str, tuple[str, ...]]:
    """The units of all quantities that a mechanism may have, by their ids."""
    found: dict[str, tuple[str, ...]] = {}
    steps = instance.mechanism.steps if instance.mechanism else ()
    named: list[tuple[str, Quantity | Step]] = [(step.id, step) for _, step in steps]
    named += [(name, meta) for name, meta in fields(instance.model) if isinstance(meta, Quantity)]
    for name, declared in named:
        found[name] = (*found.get(name, ()), declared.unit, *(other for _, other in declared.units))
    return found


def _unit_fault(chosen: Any, wanted: tuple[str, ...]) -> str:
    """Why a unit cannot be that of a quantity; nothing where it can."""
    if not isinstance(chosen, str):
        return Phrase("is {chosen}; a unit is needed, such as {wanted}", chosen=repr(chosen), wanted=wanted[0])
    try:
        found = unit(chosen)
    except UnitError as error:
        return Phrase(
            "{error} Give a unit of {kind_name}, such as {wanted}.",
            error=error,
            kind_name=kind_name(unit(wanted[0])),
            wanted=wanted[0],
        )
    if found.si not in {unit(each).si for each in wanted}:
        return Phrase(
            "is a unit of {kind_name}; one of {kind_name_2} is needed, such as {wanted}",
            kind_name=kind_name(found),
            kind_name_2=kind_name(unit(wanted[0])),
            wanted=wanted[0],
        )
    return ""


def by_si(chosen: Mapping[str, str]) -> dict[str, str]:
    """Return the units that are chosen for all quantities of a dimension, by their SI units."""
    return {DIMENSIONS[key]: unit(text).text for key, text in chosen.items() if key in DIMENSIONS}


def by_id(chosen: Mapping[str, str], name: str) -> dict[str, str]:
    """Return the units that are chosen for single quantities of a mechanism, by their ids."""
    own = {key.partition("."): text for key, text in chosen.items() if key not in DIMENSIONS}
    return {quantity: unit(text).text for (home, _, quantity), text in own.items() if home == name}
