"""What the loads do to the shaft over a whole cycle: the greatest forces, stresses and deflections, and the critical speed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.mechanics import beams
from diecut_report.plugins.shaft import formulas
from diecut_report.plugins.shaft.statics import Sides, Statics

Array = NDArray[Any]


def numbers(statics: Statics) -> dict[str, Array]:
    """Return all numbers, (variants,) each."""
    sides, reactions = statics.sides(statics.x), np.hypot(statics.reactions[:, 0], statics.reactions[:, 1])
    low, high = sides.torque_bounds
    slope = statics.slopes(np.stack([statics.supports.first, statics.supports.second]))
    locating = np.sum(statics.loads.axial_force, axis=0)
    bounds = statics.cycle.bounds("axial_force", np.ones((1, *statics.cycle.places.shape)))
    return {
        "reaction_a": np.max(reactions[0], axis=1),
        "reaction_b": np.max(reactions[1], axis=1),
        "axial_reaction": np.max(np.maximum(*(np.abs(locating + each[0]) for each in bounds)), axis=1),
        "bending_moment": np.max(sides.bending, axis=(0, 1, 3)),
        "torque_max": np.max(sides.torque + high, axis=(0, 1, 3)),
        "torque_min": np.min(sides.torque + low, axis=(0, 1, 3)),
        "torque_left": _torque_left(statics),
        "torque_scale": _torque_scale(statics),
        "load_scale": _load_scale(statics),
        "deflection": statics.greatest_deflection[0],
        "deflection_end": np.max(statics.deflections_at(statics.body.ends[[0, -1]]), axis=(0, 2)),
        "slope_a": np.max(slope[0], axis=1),
        "slope_b": np.max(slope[1], axis=1),
        "twist": statics.twist,
        "torque_span": statics.torque_span,
        "energy_difference": statics.energy_difference,
        **_yielding(statics, sides),
    }


def critical(statics: Statics) -> dict[str, Array]:
    """Return the critical speed with its bounds, (variants,) each; it takes longer than all other numbers, and few ask for it."""
    found = statics.elastic.critical
    return {"critical": found.speed, "rayleigh": found.rayleigh, "dunkerley": found.dunkerley}


def _torque_left(statics: Statics) -> Array:
    """Torque balance where none balances them, the greatest over the cycle."""
    if statics.cycle.balance is not None:
        return np.zeros(len(statics.shear))
    low, high = statics.cycle.bounds("torque", np.ones((1, *statics.cycle.places.shape)))
    left = np.sum(statics.loads.torque, axis=0)
    found: Array = np.max(np.maximum(np.abs(left + low[0]), np.abs(left + high[0])), axis=1)
    return found


def _torque_scale(statics: Statics) -> Array:
    sizes = [np.max(np.abs(statics.loads.torque), axis=(0, 2))]
    sizes += [np.maximum(np.abs(low), np.abs(high)) for _, low, high in statics.cycle.extremes("torque")]
    found: Array = np.max(np.stack(sizes), axis=0)
    return found


def _load_scale(statics: Statics) -> Array:
    """The greatest force, across or along; a couple counts as the forces at the bearings that hold it."""
    loads = statics.loads
    forces = (loads.force_y, loads.force_z, loads.axial_force)
    couples = (each / statics.supports.span for each in (loads.couple_xy, loads.couple_xz))
    sizes = [np.max(np.abs(each), axis=(0, 2)) for each in (*forces, *couples)]
    sizes += [np.maximum(np.abs(low), np.abs(high)) for _, low, high in statics.cycle.extremes("axial_force")]
    found: Array = np.max(np.stack(sizes), axis=0)
    return found


def _yielding(statics: Statics, sides: Sides) -> dict[str, Array]:
    """Return where and in which load case, counted from 1, the nominal stress is greatest; 0 is the run."""
    run = _nominal(statics, sides)
    cases = statics.in_cases
    if cases is None:
        return run
    found = _nominal(cases, cases.sides(cases.x))
    found["nominal_case"] += 1
    run["nominal_case"] *= 0
    is_worse = found["nominal_stress"] > run["nominal_stress"]
    return {name: np.where(is_worse, found[name], each) for name, each in run.items()}


def _nominal(statics: Statics, sides: Sides) -> dict[str, Array]:
    """Return where and at which instant the nominal stress is greatest over shaft and cycle, and the forces there, (variants,) each."""
    index = np.stack([statics.body.section_of(statics.x, behind=each) for each in (False, True)])
    diameter, bore = (
        np.take_along_axis(each[None], index, axis=1) for each in (statics.body.diameter, statics.body.bore)
    )
    area, modulus = beams.circle_area(diameter, bore), 2 * beams.second_moment(diameter, bore) / diameter
    forces = sides.axial_size, sides.bending, sides.torque_size
    stress = formulas.nominal_stress(*forces, area[..., None], modulus[..., None])
    found = {"nominal_axial": forces[0], "nominal_moment": forces[1], "nominal_torque": forces[2]}
    found |= {
        "nominal_diameter": diameter[..., None],
        "nominal_bore": bore[..., None],
        "nominal_position": statics.x[None, :, :, None],
        "nominal_stress": stress,
        "nominal_case": np.arange(stress.shape[3]),
    }
    at = _greatest(stress)
    return {name: np.broadcast_to(each, stress.shape)[at] for name, each in found.items()}


def _greatest(values: Array) -> tuple[Array, ...]:
    """Return where values (sides, places, variants, instants) are greatest, the indices of each variant."""
    flat = np.moveaxis(values, 2, 0)
    index = np.argmax(flat.reshape(len(flat), -1), axis=1)
    side, place, instant = np.unravel_index(index, flat.shape[1:])
    return side, place, np.arange(len(flat)), instant
