"""Curves of the shaft: reactions over the cycle; moments, torque, stress and deflection along it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.mechanics.beams import Loading, Supports
from diecut_report.mechanics.sections import tube
from diecut_report.plugins.shaft import formulas, statics
from diecut_report.plugins.shaft.body import Body
from diecut_report.plugins.shaft.cycle import Cycle, Instants, side_by_side
from diecut_report.plugins.shaft.elastic import ElasticShaft, remembered
from diecut_report.plugins.shaft.material_point import worst_points
from diecut_report.plugins.shaft.statics import Sides, Statics, greatest_size, resultant

Array = NDArray[Any]
SAMPLED = 16  # variants whose loads are sampled at once, alike of all shafts: they find what others sampled
VALUES, MOST = 2**19, 4  # of a force in the sections, and blocks of samples, that are known at once


@dataclass(frozen=True)
class UnderLoad:
    """Hold the shaft, its loads and its bearings; inputs are (variants,)."""

    body: Body
    cycle: Cycle
    bearing_a: Array
    bearing_b: Array
    at_a: bool  # the locating bearing
    elastic: Array
    shear: Array
    density: Array

    @property
    def variants(self) -> int:
        """Return how many variants there are."""
        return len(self.bearing_a)

    def blocks(self) -> Iterator[tuple[Array, Statics]]:
        """Yield the variants in blocks, each with the shaft under its loads."""
        for start in range(0, self.variants, self._block):
            rows = np.arange(start, min(start + self._block, self.variants))
            yield rows, self._under(rows, side_by_side([self._sampled(first) for first in rows[::SAMPLED]]))

    @property
    def _block(self) -> int:
        """How many variants are calculated at once: enough that calls cost little, few enough that forces stay near the processor."""
        of_each = 2 * len(self.body.x) * int(self.cycle.share.shape[1])
        return SAMPLED * min(max(1, VALUES // (of_each * SAMPLED)), MOST)

    def _sampled(self, first: int) -> Instants:
        """The loads of a block by its first variant: they are asked for twice, and cost more than what is made of them."""
        if first not in self._loads:
            rows = np.arange(first, min(first + SAMPLED, self.variants))
            self._loads[first] = self.cycle.at(self.cycle.share[rows], self.cycle.middle[rows], rows)
        return self._loads[first]

    @cached_property
    def _loads(self) -> dict[int, Instants]:
        return {}

    def _under(self, rows: Array, loads: Instants) -> Statics:
        body = self.body
        arrays = {name: each[:, rows] for name, each in vars(body).items() if isinstance(each, np.ndarray)}
        supports = Supports(self.bearing_a[rows], self.bearing_b[rows])
        cycle = self.cycle.of(rows)
        elastic = ElasticShaft(
            Body(**vars(body) | arrays), supports, cycle.places, cycle.mass, self.elastic[rows], self.density[rows]
        )
        return Statics(
            remembered(elastic), cycle, loads, supports.first if self.at_a else supports.second, self.shear[rows]
        )

    @cached_property
    def numbers(self) -> dict[str, Array]:
        """Return all numbers but the critical speed, (variants, 1) each."""
        return self._of_blocks(statics.numbers)

    @cached_property
    def critical(self) -> dict[str, Array]:
        """Return the critical speed with its bounds, (variants, 1) each."""
        return self._of_blocks(statics.critical)

    def _of_blocks(self, numbers: Callable[[Statics], dict[str, Array]]) -> dict[str, Array]:
        found = [numbers(block) for _, block in self.blocks()]
        return {name: np.concatenate([each[name] for each in found])[:, None] for name in found[0]}

    @cached_property
    def load_slopes(self) -> Array:
        """Return the greatest slope at each load, (variants, loads)."""
        loads = len(self.cycle.places)
        return np.concatenate([np.max(block.slopes(block.body.x[-loads:]), axis=2).T for _, block in self.blocks()])

    @property
    def is_toothed(self) -> Array:
        """Return 1 for each load with teeth, 0 for others, (variants, loads)."""
        return np.isfinite(self.cycle.gears.radius).T * 1.0

    @cached_property
    def mesh_slopes(self) -> Array:
        """Return the slope of each gear in the direction of the force on its teeth, at its greatest torque, (variants, loads); 0 of other loads."""
        return np.concatenate([block.mesh_slopes(self.cycle.gears.of(rows)) for rows, block in self.blocks()])

    # --- curves over the cycle ---------------------------------------------------------------------------------------------

    @property
    def cycle_joints(self) -> Array:
        """Return the cycle angles where a load jumps or has a corner, (variants, places)."""
        return 2 * np.pi * self.cycle.edges[:, 1:-1]

    def reactions(self, angle: Array, middle: Array, rows: Array | None) -> Array:
        """Return the reactions (bearing, plane, rows, places) at cycle angles (rows, places)."""
        chosen, loads = self._loads_at(angle, middle, rows)
        supports = Supports(self.bearing_a[chosen], self.bearing_b[chosen])
        places = self.cycle.places[:, chosen]
        planes = (loads.force_y, loads.couple_xy), (loads.force_z, loads.couple_xz)
        return np.stack([np.stack(Loading(places, *plane).reactions(supports)) for plane in planes], axis=1)

    def axial_reaction(self, angle: Array, middle: Array, rows: Array | None) -> Array:
        """Return the greatest size of the axial force on the locating bearing (rows, places) at cycle angles (rows, places)."""
        chosen, loads = self._loads_at(angle, middle, rows)
        low, high = self.cycle.of(chosen).bounds("axial_force", np.ones((1, len(self.cycle.places), len(chosen))))
        size = greatest_size(np.sum(loads.axial_force, axis=0), (low[0], high[0]))
        return np.broadcast_to(size, angle.shape)

    def _loads_at(self, angle: Array, middle: Array, rows: Array | None) -> tuple[Array, Instants]:
        """Which variants the rows are, and their loads at cycle angles."""
        own = np.zeros(len(angle), dtype=int) if rows is None and self.variants == 1 else rows
        chosen = np.arange(self.variants) if own is None else own
        return chosen, self.cycle.at(angle / (2 * np.pi), middle / (2 * np.pi), chosen)

    # --- curves along the shaft ---------------------------------------------------------------------------------------------

    @property
    def joints(self) -> Array:
        """Return the places inside the shaft where something begins or acts, (variants, places)."""
        x = np.concatenate([self.body.ends[1:-1], self.cycle.places, self.bearing_a[None], self.bearing_b[None]]).T
        inside = (x > 0) & (x < self.body.length[:, None])
        return np.where(inside, x, np.nan)

    def along(self, x: Array, middle: Array, rows: Array | None) -> Iterator[tuple[Statics, Array, Array]]:
        """Yield for each row of places (rows, places) the shaft, its places (places, 1), and 0 before and 1 behind for each of them."""
        chosen = (
            np.zeros(len(x), dtype=int) if self.variants == 1 else np.arange(self.variants) if rows is None else rows
        )
        inner = np.broadcast_to(middle, x.shape)
        for own, variant, mid in zip(x, chosen, inner, strict=True):
            yield self._alone(int(variant)), own[:, None], (mid > own).astype(int)

    def _alone(self, variant: int) -> Statics:
        """One of the variants; of the last one what was found is kept, since several curves are asked of it."""
        if variant not in self._last:
            row = np.array([variant])
            self._last.clear()
            self._last[variant] = self._under(row, self.cycle.at(self.cycle.share[row], self.cycle.middle[row], row))
        return self._last[variant]

    @cached_property
    def _last(self) -> dict[int, Statics]:
        return {}

    # --- the state of each place --------------------------------------------------------------------------------------------

    def states(self, factors: dict[str, Array]) -> dict[str, Array]:
        """Return the forces and stresses that judge each place (variants, places), with rows of factors of that shape."""
        rows: list[dict[str, Array]] = []
        for variants, block in self.blocks():
            own = {name: each[variants].T for name, each in factors.items()}
            sides = block.sides(block.body.x)
            cases = block.in_cases
            every = [sides] if cases is None else [sides, cases.sides(block.body.x)]
            rows.append(_yielding(every, own) | worst_points(sides, self.cycle.angle(variants), own))
        return {name: np.concatenate([each[name] for each in rows]) for name in rows[0]}


def _yielding(every: list[Sides], own: dict[str, Array]) -> dict[str, Array]:
    """The forces, of the run or a load case, where the stress with the notch is greatest, (variants, places)."""
    (stress, run), *others = (_greatest_in_notch(sides, own) for sides in every)
    for other, case in others:
        run = {name: np.where(other > stress, case[name], each) for name, each in run.items()}
    return run


def _greatest_in_notch(sides: Sides, own: dict[str, Array]) -> tuple[Array, dict[str, Array]]:
    """The greatest stress with the notch, with the forces at its instant and on its side, (variants, places) each."""
    forces = {"yield_axial": sides.axial_size, "yield_moment": sides.bending, "yield_torque": sides.torque_size}
    factors = (own[name][None, :, :, None] for name in ("area", "modulus", "k_f", "k_fs"))
    stress = formulas.yield_stress(*forces.values(), *factors)
    flat = np.moveaxis(stress, 0, 2)
    side, instant = np.unravel_index(np.argmax(flat.reshape(*flat.shape[:2], -1), axis=2), flat.shape[2:])
    place, variant = np.indices(flat.shape[:2])
    at = side, place, variant, instant
    return stress[at].T, {name: np.broadcast_to(each, stress.shape)[at].T for name, each in forces.items()}


Curve = Callable[[UnderLoad, Array, Array, Array | None], Array]
BEARINGS = {"a": 0, "b": 1}


def reaction(bearing: str, plane: int | None = None) -> Curve:
    """Return a bearing's reaction over the cycle, in y (0) or z (1), or its size."""

    def curve(under: UnderLoad, angle: Array, middle: Array, rows: Array | None) -> Array:
        in_planes = under.reactions(angle, middle, rows)[BEARINGS[bearing]]
        return np.asarray(np.hypot(*in_planes) if plane is None else in_planes[plane])

    return curve


def shaft_angle(under: UnderLoad, angle: Array, middle: Array, rows: Array | None) -> Array:
    """Return the angle of the shaft over the cycle."""
    return np.asarray(under.cycle.turned(angle / (2 * np.pi), middle / (2 * np.pi), rows))


def along(of: Callable[[Statics, Array, Array], Array]) -> Curve:
    """Return a curve along the shaft: ``of`` the shaft, its places (places, 1) and the side, 0 or 1, of each."""

    def curve(under: UnderLoad, x: Array, middle: Array, rows: Array | None) -> Array:
        return np.stack([of(statics, places, side) for statics, places, side in under.along(x, middle, rows)])

    return curve


def _on_side(values: Array, side: Array) -> Array:
    """Values (2, places, 1, instants) on the side of each place, (places, instants)."""
    return np.asarray(values[side, np.arange(values.shape[1]), 0])


@along
def bending_moment(statics: Statics, places: Array, side: Array) -> Array:
    """The greatest bending moment over the cycle."""
    return np.asarray(np.max(_on_side(resultant(*statics.moments(places)), side), axis=1))


@along
def torque(statics: Statics, places: Array, side: Array) -> Array:
    """The greatest size of the torque over the cycle."""
    return np.asarray(np.max(_on_side(greatest_size(*statics.torques(places)), side), axis=1))


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
    return np.asarray(np.hypot(*(line.at(places)[0] for line in lines))[:, 0, 0])


def _of_section(values: Array, statics: Statics, places: Array, side: Array) -> Array:
    """What the section has in which each place is, (places,); at a step on its side."""
    sections = [statics.body.section_of(places, behind=each)[:, 0] for each in (False, True)]
    return np.asarray(values[np.where(side, sections[1], sections[0]), 0])


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
    section = tube(size, bore)
    stress = formulas.yield_stress(*forces, section.area, section.modulus, 1.0, 1.0)
    return np.asarray(np.max(stress, axis=1))
