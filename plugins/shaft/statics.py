"""What the loads do to the shaft: forces in its sections, reactions, deflection, twist, over the cycle."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.mechanics import beams
from diecut_report.mechanics.beams import SAME_PLACE, Bent, Loading, Supports
from diecut_report.mechanics.sections import tube
from diecut_report.plugins.shaft import formulas
from diecut_report.plugins.shaft.body import Body
from diecut_report.plugins.shaft.cycle import COMPONENTS, Cycle, Gears, Instants
from diecut_report.plugins.shaft.elastic import ElasticShaft

Array = NDArray[Any]
PROVED = 24  # instants at which the deflection line is proved by its energy


@dataclass(frozen=True)
class Sides:
    """Forces in the sections just before (0) and just behind (1) some places, each (2, places, variants, instants); intervals added apart."""

    xy: Array
    xz: Array
    torque: Array
    axial: Array
    torque_bounds: tuple[Array, Array]
    axial_bounds: tuple[Array, Array]

    @cached_property
    def bending(self) -> Array:
        """Return the resultant bending moment."""
        return resultant(self.xy, self.xz)

    @cached_property
    def torque_size(self) -> Array:
        """Return the greatest size that the torque may have."""
        return greatest_size(self.torque, self.torque_bounds)

    @cached_property
    def axial_size(self) -> Array:
        """Return the greatest size that the axial force may have."""
        return greatest_size(self.axial, self.axial_bounds)


def resultant(in_y: Array, in_z: Array) -> Array:
    """Return the size of what acts in both planes."""
    return np.asarray(np.sqrt(in_y**2 + in_z**2))


def greatest_size(values: Array, bounds: tuple[Array, Array]) -> Array:
    """Return the greatest size of values to which something between bounds is added."""
    low, high = bounds
    return np.asarray(np.maximum(np.abs(values + low), np.abs(values + high)))


@dataclass(frozen=True)
class Statics:
    """Hold some variants of the shaft under their loads; numbers are (variants,)."""

    elastic: ElasticShaft
    cycle: Cycle
    loads: Instants
    locating: Array
    shear: Array

    @property
    def body(self) -> Body:
        """Return the shaft's body."""
        return self.elastic.body

    @property
    def supports(self) -> Supports:
        """Return the places of the bearings."""
        return self.elastic.supports

    @property
    def x(self) -> Array:
        """Return all places where something begins or acts, ascending, (points, variants)."""
        return self.elastic.x

    @cached_property
    def planes(self) -> tuple[Loading, Loading]:
        """Return the loading in both planes, held by the bearings."""
        loads, places = self.loads, self.cycle.places
        planes = (loads.force_y, loads.couple_xy), (loads.force_z, loads.couple_xz)
        return tuple(Loading(places, force, couple).held(self.supports) for force, couple in planes)  # type: ignore[return-value]

    @property
    def reactions(self) -> Array:
        """Return the reactions: (bearing, plane, variants, instants)."""
        return np.stack([plane.forces[-2:] for plane in self.planes], axis=1)

    def sides(self, x: Array) -> Sides:
        """Return the forces in the sections at places (places, variants)."""
        torque, bounds = self.torques(x)
        given = _no_more_than_needed(self.loads.axial_force)
        held = np.concatenate([self.cycle.places, self.locating[None]])
        axial = np.concatenate([given, -np.sum(given, axis=0, keepdims=True)])
        axial = -np.stack(beams.before_and_behind(x, held, axial))
        return Sides(*self.moments(x), torque, axial, bounds, self._both(self._axial_bounds, x))

    def moments(self, x: Array) -> tuple[Array, Array]:
        """Return the moments in both planes just before and just behind places, (2, places, variants, instants) each."""
        return tuple(np.stack(plane.moments(x)) for plane in self.planes)  # type: ignore[return-value]

    def torques(self, x: Array) -> tuple[Array, tuple[Array, Array]]:
        """Return the torque there, and what is added by torques known by their extremes."""
        torque = beams.before_and_behind(x, self.cycle.places, _no_more_than_needed(self.loads.torque))
        return np.stack(torque), self._both(self._torque_bounds, x)

    @cached_property
    def instant_of_moment(self) -> Array:
        """Return at which instant the bending moment is greatest, (variants,)."""
        xy, xz = self.moments(self.x)
        return np.asarray(np.argmax(np.max(xy**2 + xz**2, axis=(0, 1)), axis=1))

    def _both(self, bounds: Callable[[Array], tuple[Array, Array]], x: Array) -> tuple[Array, Array]:
        before, behind = bounds(x - 2 * SAME_PLACE), bounds(x + 2 * SAME_PLACE)
        return np.stack([before[0], behind[0]]), np.stack([before[1], behind[1]])

    def _left_of(self, x: Array, places: Array) -> Array:
        """Which loads stand left of x, (points, loads, variants)."""
        return (places[None] < x[:, None]).astype(float)

    def _torque_bounds(self, x: Array) -> tuple[Array, Array]:
        """What torques known by their extremes may add at x; the load that balances takes them away again."""
        weights = self._left_of(x, self.cycle.places)
        if self.cycle.balance is not None:
            weights = weights - weights[:, [self.cycle.balance]]
        return self.cycle.bounds("torque", weights)

    def _axial_bounds(self, x: Array) -> tuple[Array, Array]:
        weights = self._left_of(x, self.locating[None]) - self._left_of(x, self.cycle.places)
        return self.cycle.bounds("axial_force", weights)

    # --- deflection ----------------------------------------------------------------------------------------------------

    @cached_property
    def lines(self) -> tuple[Bent, Bent]:
        """Return the deflection lines of both planes at all places."""
        return self._bent(self.elastic.at_joints)

    def bent(self, x: Array) -> tuple[Bent, Bent]:
        """Return the deflection lines of both planes at places that hold all others: what each load bends, summed up."""
        return self._bent(self.elastic.by_unit_loads(x))

    def _bent(self, units: Bent) -> tuple[Bent, Bent]:
        across, turned = (np.moveaxis(each, 1, 0) for each in (units.deflection, units.slope))
        return tuple(
            Bent(units.x, *(np.moveaxis(each @ given, 0, 1) for each in (across, turned))) for given in self._given
        )  # type: ignore[return-value]

    @cached_property
    def _given(self) -> tuple[Array, Array]:
        """The forces and couples of both planes, (variants, loads, instants)."""
        loads = self.loads
        planes = (loads.force_y, loads.couple_xy), (loads.force_z, loads.couple_xz)
        return tuple(np.moveaxis(np.concatenate(plane), 1, 0) for plane in planes)  # type: ignore[return-value]

    def deflections_at(self, places: Array) -> Array:
        """Return the resultant deflection at places (places, variants) among all, (places, variants, instants)."""
        return self._resultant(self.elastic.at_joints.at(places)[0])

    def slopes(self, places: Array) -> Array:
        """Return the resultant slope at places (places, variants) among all, (places, variants, instants)."""
        return self._resultant(self.elastic.at_joints.at(places)[1])

    def mesh_slopes(self, gears: Gears) -> Array:
        """Return the slope of each load in the direction of the force on its teeth, when its torque is greatest, (variants, loads)."""
        torque, places = self.loads.torque, self.cycle.places
        instants = np.argmax(np.abs(torque), axis=2)  # (loads, variants)
        _, *across = gears.forces(np.take_along_axis(torque, instants[:, :, None], axis=2))
        force = np.hypot(*across)
        by_units = np.moveaxis(self.elastic.at_joints.at(places)[1], 1, 0)
        found: Array = np.zeros(by_units.shape[:2])
        for direction, given in zip(across, self._given, strict=True):
            then = np.take_along_axis(given, instants.T[:, None], axis=2)
            found += (
                np.sum(by_units * np.swapaxes(then, 1, 2), axis=2)
                * (direction / np.where(force > 0, force, 1))[:, :, 0].T
            )
        return found

    def _resultant(self, of_units: Array) -> Array:
        """The resultant over both planes of what unit loads do (places, variants, loads)."""
        return np.asarray(np.sqrt(np.stack([*self._squares(of_units)], axis=1)))

    def _squares(self, of_units: Array) -> Iterator[Array]:
        """Yield the square of the resultant of each variant (places, instants): one at a time, so that it stays in the processor's cache."""
        for variant, (in_y, in_z) in enumerate(zip(*self._given, strict=True)):
            by_unit = of_units[:, variant]
            yield (by_unit @ in_y) ** 2 + (by_unit @ in_z) ** 2

    @cached_property
    def greatest_deflection(self) -> tuple[Array, Array]:
        """Return the greatest deflection of all (variants,), and at which instant it is, its index."""
        instant = self.instant_of_deflection
        return np.max(self.at_instant(instant)._resultant(self.elastic.closely.deflection), axis=(0, 2)), instant

    @property
    def instant_of_deflection(self) -> Array:
        """Return at which instant the greatest deflection is, its index, as far as places between the joints tell."""
        return np.array([np.argmax(np.max(each, axis=0)) for each in self._squares(self.elastic.within.deflection)])

    def at_instant(self, instant: Array) -> Statics:
        """The same at one instant of each variant."""
        return self.at_instants(instant[:, None])

    def at_instants(self, instants: Array) -> Statics:
        """The same at some instants of each variant, (variants or 1, instants)."""
        picked = {name: np.take_along_axis(each, instants[None], axis=2) for name, each in vars(self.loads).items()}
        return replace(self, loads=Instants(**picked))

    @cached_property
    def twist(self) -> Array:
        """Return the greatest twist between the outermost torques, (variants,)."""
        diameter, bore = self.elastic.section_between(self.x)
        compliance = np.diff(self.x, axis=0) / (2 * self.shear * tube(diameter, bore).second_moment)
        middle = (self.x[:-1] + self.x[1:]) / 2
        torque, _ = beams.before_and_behind(middle, self.cycle.places, self.loads.torque)
        known = np.sum(torque * compliance[:, :, None], axis=0)
        weights = self._left_of(middle, self.cycle.places)
        if self.cycle.balance is not None:
            weights = weights - weights[:, [self.cycle.balance]]
        low, high = self.cycle.bounds("torque", np.sum(weights * compliance[:, None], axis=0)[None])
        return np.asarray(np.max(np.maximum(np.abs(known + low[0]), np.abs(known + high[0])), axis=1))

    @property
    def torque_span(self) -> Array:
        """Return the distance of the outermost torques, (variants,)."""
        acts = np.any(self.loads.torque != 0, axis=2)
        for index, low, high in self.cycle.extremes("torque"):
            acts[index] |= (low != 0) | (high != 0)
        if any(True for _ in self.cycle.extremes("torque")) and self.cycle.balance is not None:
            acts[self.cycle.balance] = True
        places = self.cycle.places
        found: Array = np.max(np.where(acts, places, -np.inf), axis=0) - np.min(np.where(acts, places, np.inf), axis=0)
        return np.where(np.isfinite(found), found, 0.0)

    @property
    def in_cases(self) -> Statics | None:
        """The same in the load cases in place of the instants of the run; None without any."""
        cases = [case.loads(self.loads) for case in self.cycle.cases]
        if not cases:
            return None
        return replace(
            self,
            loads=Instants(
                **{name: np.concatenate([getattr(each, name) for each in cases], axis=2) for name in COMPONENTS}
            ),
        )

    @property
    def energy_difference(self) -> Array:
        """Return the energy of the bent shaft less the work of its loads, beyond rounding, to the energy: the greatest of some instants."""
        count = self.loads.torque.shape[2]
        some = self.at_instants(np.unique(np.linspace(0, count - 1, PROVED).astype(int))[None])
        stiffness = self.elastic.stiffness_of(self.x)
        energy = sum(beams.bending_energy(self.x, stiffness, plane) for plane in some.planes)
        work = sum(beams.work(line, plane) for line, plane in zip(some.lines, some.planes, strict=True))
        rounding = sum(beams.energy_rounding(self.x, stiffness, plane, self.supports) for plane in some.planes)
        beyond = np.max(np.maximum(np.abs(energy - work) - rounding, 0), axis=1)
        greatest = np.max(energy, axis=1)
        return np.asarray(beyond / np.where(greatest > 0, greatest, 1))


def _no_more_than_needed(values: Array) -> Array:
    """Values (loads, variants, instants), of a single instant where all are zero: a pin has no torque, most shafts no axial force."""
    return values if np.any(values) else values[:, :, :1]


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
    return np.asarray(np.max(np.maximum(np.abs(left + low[0]), np.abs(left + high[0])), axis=1))


def _torque_scale(statics: Statics) -> Array:
    sizes = [np.max(np.abs(statics.loads.torque), axis=(0, 2))]
    sizes += [np.maximum(np.abs(low), np.abs(high)) for _, low, high in statics.cycle.extremes("torque")]
    return np.asarray(np.max(np.stack(sizes), axis=0))


def _load_scale(statics: Statics) -> Array:
    """The greatest force, across or along; a couple counts as the forces at the bearings that hold it."""
    loads = statics.loads
    forces = (loads.force_y, loads.force_z, loads.axial_force)
    couples = (each / statics.supports.span for each in (loads.couple_xy, loads.couple_xz))
    sizes = [np.max(np.abs(each), axis=(0, 2)) for each in (*forces, *couples)]
    sizes += [np.maximum(np.abs(low), np.abs(high)) for _, low, high in statics.cycle.extremes("axial_force")]
    return np.asarray(np.max(np.stack(sizes), axis=0))


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
    section = tube(diameter, bore)
    forces = sides.axial_size, sides.bending, sides.torque_size
    stress = formulas.nominal_stress(*forces, section.area[..., None], section.modulus[..., None])
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
