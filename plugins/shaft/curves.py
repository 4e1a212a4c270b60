"""Curves of the shaft: reactions over the cycle; moments, torque, stress and deflection along it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.mechanics import beams
from diecut_report.plugins.shaft import formulas
from diecut_report.plugins.shaft.statics import Statics, greatest_size, resultant
from diecut_report.plugins.shaft.under_load import UnderLoad

Array = NDArray[Any]
Curve = Callable[[UnderLoad, Array, Array, Array | None], Array]
BEARINGS = {"a": 0, "b": 1}


def reaction(bearing: str) -> Curve:
    """Return the size of a bearing's reaction over the cycle."""

    def curve(under: UnderLoad, angle: Array, middle: Array, rows: Array | None) -> Array:
        found: Array = np.hypot(*under.reactions(angle, middle, rows)[BEARINGS[bearing]])
        return found

    return curve


def reaction_in(bearing: str, plane: int) -> Curve:
    """Return a bearing's reaction in y (0) or z (1) over the cycle."""

    def curve(under: UnderLoad, angle: Array, middle: Array, rows: Array | None) -> Array:
        found: Array = under.reactions(angle, middle, rows)[BEARINGS[bearing]][plane]
        return found

    return curve


def axial_reaction(under: UnderLoad, angle: Array, middle: Array, rows: Array | None) -> Array:
    """Return the size of the axial force on the locating bearing over the cycle."""
    return under.axial_reaction(angle, middle, rows)


def shaft_angle(under: UnderLoad, angle: Array, middle: Array, rows: Array | None) -> Array:
    """Return the angle of the shaft over the cycle."""
    found: Array = under.cycle.turned(angle / (2 * np.pi), middle / (2 * np.pi), rows)
    return found


def along(of: Callable[[Statics, Array, Array], Array]) -> Curve:
    """Return a curve along the shaft: ``of`` the shaft, its places (places, 1) and the side, 0 or 1, of each."""

    def curve(under: UnderLoad, x: Array, middle: Array, rows: Array | None) -> Array:
        return np.stack([of(statics, places, side) for statics, places, side in under.along(x, middle, rows)])

    return curve


def _on_side(values: Array, side: Array) -> Array:
    """Values (2, places, 1, instants) on the side of each place, (places, instants)."""
    found: Array = values[side, np.arange(values.shape[1]), 0]
    return found


@along
def bending_moment(statics: Statics, places: Array, side: Array) -> Array:
    """The greatest bending moment over the cycle."""
    found: Array = np.max(_on_side(resultant(*statics.moments(places)), side), axis=1)
    return found


@along
def torque(statics: Statics, places: Array, side: Array) -> Array:
    """The greatest size of the torque over the cycle."""
    found: Array = np.max(_on_side(greatest_size(*statics.torques(places)), side), axis=1)
    return found


def moment_in(plane: int) -> Curve:
    """Return the moment in a plane, x-y (0) or x-z (1), at the instant of the greatest moment."""

    def at(statics: Statics, places: Array, side: Array) -> Array:
        still = statics.at_instant(statics.instant_of_moment)
        return _on_side(still.moments(places)[plane], side)[:, 0]

    return along(at)


@along
def deflection(statics: Statics, places: Array, _: Array) -> Array:
    """The deflection at the instant of its greatest value."""
    still = statics.at_instant(statics.greatest_deflection[1])
    lines = still.bent(np.sort(np.concatenate([statics.x, places]), axis=0))
    found: Array = np.hypot(*(line.at(places)[0] for line in lines))[:, 0, 0]
    return found


def _of_section(values: Array, statics: Statics, places: Array, side: Array) -> Array:
    """What the section has in which each place is, (places,); at a step on its side."""
    sections = [statics.body.section_of(places, behind=each)[:, 0] for each in (False, True)]
    found: Array = values[np.where(side, sections[1], sections[0]), 0]
    return found


@along
def diameter(statics: Statics, places: Array, side: Array) -> Array:
    """The shaft's diameter."""
    return _of_section(statics.body.diameter, statics, places, side)


@along
def nominal_stress(statics: Statics, places: Array, side: Array) -> Array:
    """The greatest nominal stress over the cycle."""
    size, bore = (
        _of_section(each, statics, places, side)[:, None] for each in (statics.body.diameter, statics.body.bore)
    )
    sides = statics.sides(places)
    forces = (_on_side(each, side) for each in (sides.axial_size, sides.bending, sides.torque_size))
    modulus = 2 * beams.second_moment(size, bore) / size
    stress = formulas.yield_stress(*forces, beams.circle_area(size, bore), modulus, 1.0, 1.0)
    found: Array = np.max(stress, axis=1)
    return found
