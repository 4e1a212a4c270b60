"""The module: as given, or the least of the preferred series with which flank and root of both gears hold."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    Formula,
    Vary,
    computed,
    m,
    phrase,
    pick,
    si,
    standard_series,
    value,
)
from diecut_report.plugins.gear_pair import load, rating
from diecut_report.plugins.gear_pair.load import KEYS
from diecut_report.plugins.gear_pair.mesh import GIVEN_DISTANCE, TEETH

MODULES = standard_series("iso_54_modules")
SERIES = np.array([si(value, MODULES.unit) for value in MODULES.values])
SAFETIES = {f"{kind}_safety_{g}": f"required_{kind}_safety" for kind in ("pitting", "root") for g in TEETH}
"""The safeties that the module settles, each with the one that is required."""


CHAPTERS = (
    rating.sizes,
    rating.forces,
    load.dynamic,
    load.face,
    load.transverse,
    rating.pitting,
    rating.root_stress,
)


def _rating() -> tuple[tuple[frozenset[str], Any], ...]:
    """The steps of the rating that the safeties follow from, in their order, each with the inputs that it needs."""
    known = {load.DYNAMIC_KNOWN}
    steps: list[tuple[frozenset[str], Any]] = [
        (frozenset(chapter.needs), step) for chapter in CHAPTERS for step in chapter.steps if hasattr(step, "formula")
    ]
    wanted = set(SAFETIES)
    for _, step in reversed(steps):
        wanted |= set(step.takes()) if step.id in wanted else set()
    return tuple((needs.union(step.needs) - known, step) for needs, step in steps if step.id in wanted)


RATING = _rating()


def _taken() -> tuple[str, ...]:
    """What the rating takes beside the module, of which there is more or less by what is given; the factors where they do not follow from it."""
    names = {name: None for needs, step in RATING for name in (*step.takes(), *needs, *step.lacks)}
    made = {"module", *GIVEN_DISTANCE, *(step.id for _, step in RATING)} - {*KEYS, "transverse_load_root"}
    return (*(name for name in names if name not in made), *dict.fromkeys(SAFETIES.values()))


TAKES = _taken()


def least_module(given: Mapping[str, Any]) -> Any:
    """Least module of the series with which all safeties are reached, shape (variants, 1); 0 where none is enough."""
    known = dict(given) | {"module": SERIES}
    for needs, step in RATING:
        if needs <= given.keys() and not given.keys() & step.lacks:
            known[step.id] = _value(step, known)
    held = np.all([known[name] >= known[required] for name, required in SAFETIES.items()], axis=0)
    held &= known.get("speed_parameter", 0.0) <= load.METHOD_C
    first = SERIES[np.argmax(held, axis=1)]
    return np.where(held.any(axis=1), first, 0.0)[:, None]


def _value(step: Any, known: dict[str, Any]) -> Any:
    assert isinstance(step.formula, Formula), phrase("the rating has no formula that a text chooses")
    return step.formula(*(known[name] for name in step.formula.parameters))


# fmt: off

module = Chapter("Module",
    text="The rating below is evaluated with each module of the preferred series; the smallest one with which flank and root of both gears reach "
        "their required safety factors is selected.")
module.prepared("sufficient_module", least_module, TAKES, for_many=True, lacks=GIVEN_DISTANCE)
module.module_least = (computed(function=lambda found: found, takes=("sufficient_module",),
    method="the safety factors for pitting and tooth root below, with each module of ISO 54, series I, in turn; 0 where none is sufficient",
    lacks=GIVEN_DISTANCE, output=False), "m_min", "mm", "Smallest sufficient preferred module")
module.require("module_exists", m.module_least > 0, key="face_width", lacks=("module",),
    message="is {face_width}, with which no module of ISO 54 carries the torque at a speed for which the dynamic factor is known; better steel, a "
    "smaller torque or a given dynamic_factor helps", advise=(Vary("face_width", "up"),))
module.module = (pick("above", of="module_least", series=MODULES, lacks=("module",)), "m_n", "mm", "Normal module: the smallest sufficient one",
    "ISO 54")
module.module = value(m.inputs.module, needs=("module",)), "m_n", "mm", "Normal module: as given", "input"
