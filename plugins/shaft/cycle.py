"""The loads over one cycle: numbers, curves and extremes made into forces, couples and torques at instants of the cycle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import gcd
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import GRAVITY, Curve, Extremes, Phrase, Refusal, named
from diecut_report.plugins.shaft.body import columns

Array = NDArray[Any]
INSTANTS = 720  # of a cycle of up to two revolutions, beside both limits at each joint of a curve
OF_TURN = INSTANTS // 2  # of each revolution of a longer cycle
MOST_INSTANTS = 8 * INSTANTS  # of the longest: they fall on other places in each of its revolutions
OF_OWN_TURN = 8  # of each revolution of the shaft itself
PHASES = 60  # of a shaft that turns, at least, in which what comes again meets it
COMPONENTS = ("force_y", "force_z", "axial_force", "torque", "couple_xy", "couple_xz")


@dataclass(frozen=True)
class Instants:
    """Loads at instants of some variants: (loads, variants, instants) each, and the shaft's angle (variants, instants)."""

    force_y: Array
    force_z: Array
    axial_force: Array
    torque: Array
    couple_xy: Array
    couple_xz: Array


def side_by_side(parts: Sequence[Instants]) -> Instants:
    """Return the loads of several blocks of variants as those of one."""
    if len(parts) == 1:
        return parts[0]
    return Instants(*(np.concatenate([getattr(each, name) for each in parts], axis=1) for name in COMPONENTS))


@dataclass(frozen=True)
class Gears:
    """The toothings of loads, (loads, variants) each; where there is none the pitch radius is infinite."""

    radius: Array
    pressure: Array
    helix: Array
    mesh: Array

    def forces(self, torque: Array) -> tuple[Array, Array, Array]:
        """Return the forces in x, y and z of torques (loads, variants, instants)."""
        radius, pressure, helix, mesh = (
            each[:, :, None] for each in (self.radius, self.pressure, self.helix, self.mesh)
        )
        tangential = torque / radius
        radial = np.abs(tangential) * np.tan(pressure) / np.cos(helix)
        across = -tangential * np.sin(mesh) - radial * np.cos(mesh), tangential * np.cos(mesh) - radial * np.sin(mesh)
        return tangential * np.tan(helix), *across

    def of(self, rows: Array) -> Gears:
        """Return the toothings of some variants."""
        return Gears(*(each[:, rows] for each in vars(self).values()))

    def levers(self) -> tuple[Array, Array]:
        """Return what an axial force is multiplied by to give the couples xy and xz, (loads, variants, 1)."""
        radius = np.where(np.isfinite(self.radius), self.radius, 0.0)
        return (-radius * np.cos(self.mesh))[:, :, None], (-radius * np.sin(self.mesh))[:, :, None]


class PassingTorque(NamedTuple):
    """A torque (variants,) that passes the shaft from one load to another one, by their indices."""

    enters: int
    leaves: int
    torque: Array

    def of(self, rows: Array) -> PassingTorque:
        """Return the load case of some variants."""
        return self._replace(torque=self.torque[rows])

    def loads(self, run: Instants) -> Instants:
        """Return the loads (loads, variants, 1): those of the run when most torque passes there, which grow with it, and no other torque."""
        passing = np.abs(run.torque[[self.enters, self.leaves]])
        instant = np.argmax(np.sum(passing, axis=0), axis=1)[None, :, None]
        then = {name: np.take_along_axis(each, instant, axis=2) for name, each in vars(run).items()}
        sense = np.where(then["torque"][self.enters] - then["torque"][self.leaves] < 0, -1.0, 1.0)
        case = self.torque[:, None]
        for index, sign in ((self.enters, sense), (self.leaves, -sense)):
            size = np.abs(then["torque"][index])
            growth = np.where(size > 0, case / np.where(size > 0, size, 1), 1)
            for each in then.values():
                each[index] = each[index] * growth
            then["torque"][index] = sign * case
        others = np.ones(len(run.torque), dtype=bool)
        others[[self.enters, self.leaves]] = False
        then["torque"][others] = 0
        return Instants(**then)


@dataclass(frozen=True)
class Cycle:
    """The loads of all variants: places (loads, variants), what is given of each component, and the instants that are looked at."""

    names: tuple[str, ...]
    places: Array
    offset: Array
    mass: Array
    given: dict[str, tuple[Any, ...]]
    gears: Gears
    rotation: Any
    turns: Array
    share: Array
    middle: Array
    edges: Array
    cases: tuple[PassingTorque, ...] = ()
    downwards: Array | None = None  # (variants,)

    @property
    def count(self) -> int:
        """Return how many loads there are."""
        return len(self.names)

    def at(self, share: Array, middle: Array, rows: Array) -> Instants:
        """Return the loads at shares of the cycle (rows, instants), each in the smooth piece of its middle; rows are variants."""
        own = {name: self._component(name, share, middle, rows) for name in COMPONENTS}
        torque = self._balanced(own["torque"])
        gears = self.gears.of(rows)
        axial, across_y, across_z = gears.forces(torque)
        force_y, force_z = own["force_y"] + across_y, own["force_z"] + across_z
        offset = self.offset[:, rows][:, :, None]
        lever_y, lever_z = gears.levers()
        weight_y, weight_z = self._weights(rows)
        return Instants(
            force_y + weight_y,
            force_z + weight_z,
            own["axial_force"] + axial,
            torque,
            own["couple_xy"] + force_y * offset + lever_y * axial,
            own["couple_xz"] + force_z * offset + lever_z * axial,
        )

    def _weights(self, rows: Array) -> tuple[Array | float, Array | float]:
        """The weights in y and z, (loads, rows, 1): of masses on the shaft's axis, wherever the plane of their other forces is."""
        if self.downwards is None:
            return 0.0, 0.0
        weight, direction = GRAVITY * self.mass[:, rows], self.downwards[rows]
        return (weight * np.cos(direction))[:, :, None], (weight * np.sin(direction))[:, :, None]

    def _component(self, name: str, share: Array, middle: Array, rows: Array) -> Array:
        found = np.empty((len(self.given[name]), *share.shape))
        for row, each in zip(found, self.given[name], strict=True):
            row[...] = _value(each, share, middle, rows, self.places.shape[1])
        return found

    def _balanced(self, torque: Array) -> Array:
        """The torques with that of the load that balances them, which stands as 0."""
        if self.balance is None:
            return torque
        torque[self.balance] = -np.sum(torque, axis=0)
        return torque

    @property
    def balance(self) -> int | None:
        """Return which load balances the torques."""
        return next((i for i, each in enumerate(self.given["torque"]) if isinstance(each, str)), None)

    def angle(self, rows: Array) -> Array:
        """Return the shaft's angle at the instants that are looked at, (rows, instants)."""
        share, middle = self.share[rows], self.middle[rows]
        if isinstance(self.rotation, str):
            if share.shape[1] == 1:  # loads that are constant, beneath which the shaft turns once
                return np.tile(np.arange(INSTANTS) / INSTANTS, (len(rows), 1)) * (
                    2 * np.pi if self.rotation == "turning" else 0.0
                )
            return share * (2 * np.pi * self.turns[rows][:, None] if self.rotation == "turning" else 0.0)
        return np.broadcast_to(_value(self.rotation, share, middle, rows, len(self.turns)), share.shape)

    def turned(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return the shaft's angle at shares of the cycle (rows, places) of variants."""
        own = np.arange(len(share)) % len(self.turns) if rows is None else rows
        if isinstance(self.rotation, str):
            return np.asarray(share * (2 * np.pi * self.turns[own][:, None] if self.rotation == "turning" else 0.0))
        return np.broadcast_to(
            _value(self.rotation, share, np.broadcast_to(middle, share.shape), own, len(self.turns)), share.shape
        )

    def extremes(self, name: str) -> Iterator[tuple[int, Array, Array]]:
        """Yield the loads of which only extremes are given, with these, (variants,) each."""
        for index, each in enumerate(self.given[name]):
            if isinstance(each, Extremes):
                low, high = (
                    np.broadcast_to(np.asarray(end, dtype=float), (self.places.shape[1],))
                    for end in (each.low, each.high)
                )
                yield index, low, high

    def bounds(self, name: str, weights: Array) -> tuple[Array, Array]:
        """Return the least and greatest sum of what is given by extremes, with weights (points, loads, variants): (points, variants, 1)."""
        low, high = np.zeros((2, len(weights), weights.shape[2]))
        for index, least, most in self.extremes(name):
            ends = weights[:, index] * least, weights[:, index] * most
            low, high = low + np.minimum(*ends), high + np.maximum(*ends)
        return low[:, :, None], high[:, :, None]

    def of(self, rows: Array) -> Cycle:
        """Return the cycle of some variants, of which only the extremes and places are asked."""
        return Cycle(
            self.names, self.places[:, rows], self.offset[:, rows], self.mass[:, rows],
            {name: tuple(_extremes_of(each, rows) for each in given) for name, given in self.given.items()},
            self.gears, self.rotation, self.turns[rows], self.share[rows], self.middle[rows], self.edges[rows],
            tuple(case.of(rows) for case in self.cases), None if self.downwards is None else self.downwards[rows],
        )  # fmt: skip


def _extremes_of(given: Any, rows: Array) -> Any:
    if not isinstance(given, Extremes):
        return given
    ends: list[Any] = [given.low, given.high]
    return Extremes(*(end[rows] if np.ndim(end) else end for end in ends))


def _value(given: Any, share: Array, middle: Array, rows: Array, variants: int) -> Array:
    """What is given at instants (rows, instants): a curve or a number; what is known otherwise counts as 0 here."""
    if is_curve(given):
        return np.asarray(given.values(share, middle, rows if variants > 1 else None))
    if given is None or isinstance(given, str | Extremes):
        return np.zeros((1, 1))
    return np.broadcast_to(np.asarray(given, dtype=float).ravel(), (variants,))[rows][:, None]


def is_curve(given: Any) -> bool:
    """Return whether a curve is given."""
    return hasattr(given, "values")


def cycle(
    names: Any, places: Any, force_y: Any, force_z: Any, axial_force: Any, torque: Any, couple_xy: Any, couple_xz: Any, offset: Any,
    mass: Any, pitch_radius: Any, pressure: Any, helix: Any, mesh: Any, rotation: Any, turns: Array,
    case_torques: Any = None, enters: Any = None, leaves: Any = None, downwards: Any = None,
) -> Cycle:  # fmt: skip
    """Return the loads of what is given; Refusal where curves run over other cycles, or torques cannot be told."""
    if names is None:
        raise Refusal("loads", "is empty; give at least one load")
    variants, count = len(turns), len(names)
    parts = (force_y, force_z, axial_force, torque, couple_xy, couple_xz)
    given = {name: _parts(part) for name, part in zip(COMPONENTS, parts, strict=True)}
    curves = _curves(given, rotation)
    _of_one_cycle(curves)
    _telling(names, given, pitch_radius)
    gears = Gears(
        columns(pitch_radius, count, variants, np.inf),
        *(columns(each, count, variants, 0.0) for each in (pressure, helix, mesh)),
    )
    joints = _unlike(np.broadcast_to(curve.joints, (variants, curve.joints.shape[1])) for curve in curves.values())
    revolutions = (
        np.concatenate([np.broadcast_to(each.turns, (variants, 1)) for each in curves.values()], axis=1)
        if curves
        else None
    )
    share, middle, edges = _instants(
        joints, np.ones(variants, dtype=int) if revolutions is None else _counts(revolutions, turns)
    )
    return Cycle(
        tuple(names), columns(places, count, variants), columns(offset, count, variants, 0.0), columns(mass, count, variants, 0.0),
        given, gears, rotation if is_curve(rotation) or isinstance(rotation, str) else "none", turns[:, 0], share, middle, edges,
        tuple(_cases(names, columns(case_torques, len(enters), variants), enters, leaves)) if enters else (),
        None if downwards is None else np.broadcast_to(downwards[:, 0], (variants,)),
    )  # fmt: skip


def _cases(names: Any, torques: Array, enters: Sequence[str], leaves: Sequence[str]) -> Iterator[PassingTorque]:
    """The load cases; Refusal where there is no load of a name, or one with both."""
    for index, (ends, torque) in enumerate(zip(zip(enters, leaves, strict=True), torques, strict=True)):
        for key, name in zip(("enters", "leaves"), ends, strict=True):
            if name not in names:
                template = "is “{name}”, which is not the name of a load; there are {known}"
                raise Refusal(
                    f"load_cases.{index}.{key}", Phrase(template, name=name, known=", ".join(map(str, names)))
                )
        if ends[0] == ends[1]:
            raise Refusal(
                f"load_cases.{index}.leaves",
                "is the load at which the torque enters, so that none passes the shaft; name another load",
            )
        yield PassingTorque(names.index(ends[0]), names.index(ends[1]), torque)


def _unlike(joints: Iterable[Array]) -> list[Array]:
    """The joints of curves without those that are the same: curves of one mechanism have them in common."""
    found: list[Array] = []
    for each in joints:
        if not any(np.array_equal(each, other, equal_nan=True) for other in found):
            found.append(each)
    return found


def _parts(given: Any) -> tuple[Any, ...]:
    """What is given of each load: a column for each where all are numbers."""
    return tuple(given.T) if isinstance(given, np.ndarray) else tuple(given)


def _curves(given: dict[str, tuple[Any, ...]], rotation: Any) -> dict[str, Curve]:
    """The curves with their keys."""
    found = {
        f"loads.{i}.{name}": each for name, parts in given.items() for i, each in enumerate(parts) if is_curve(each)
    }
    return found | ({"rotation": rotation} if is_curve(rotation) else {})


def _of_one_cycle(curves: dict[str, Curve]) -> None:
    if not curves:
        return
    first, one = next(iter(curves.items()))
    for key, other in curves.items():
        if other.cycle != one.cycle:
            raise Refusal(
                key,
                Phrase(
                    "is a curve over {cycle}, but {first} is one over {cycle_2}; all curves of a shaft run over one "
                    "and the same cycle: give one of the two as a number",
                    cycle=other.cycle,
                    first=first,
                    cycle_2=one.cycle,
                ),
            )


def _telling(names: Any, given: dict[str, tuple[Any, ...]], pitch_radius: Any) -> None:
    """Whether the torques can be told: at most one balances, and none with a toothing is known by its extremes alone."""
    balancing = [i for i, each in enumerate(given["torque"]) if isinstance(each, str)]
    if len(balancing) > 1:
        told = named([str(names[i]) for i in balancing], " and ")
        raise Refusal(
            f"loads.{balancing[1]}.torque",
            Phrase("is balance, as that of another load ({told}); only one load can balance the others", told=told),
        )
    bounded = [i for i, each in enumerate(given["torque"]) if isinstance(each, Extremes)]
    unknown = bounded + (balancing if bounded else [])
    for index in unknown:
        if pitch_radius is not None and not isinstance(pitch_radius, np.ndarray) and pitch_radius[index] is None:
            continue
        if pitch_radius is not None:
            template = "has a gear, whose forces need the torque at each instant; give the torque as a number or a curve, or the forces without gear"
            raise Refusal(
                f"loads.{index}.torque",
                Phrase(
                    "is known by its extremes alone, but the load {names} {words}", names=names[index], words=template
                ),
            )


def _counts(revolutions: Array, turns: Array) -> Array:
    """How many even instants the cycle of each variant has, (variants,), by the revolutions of its loads (variants, curves) and of the shaft."""
    # of a variant that cannot be nothing is known, and a part of a revolution is one
    whole = np.maximum(np.nan_to_num(np.concatenate([turns, revolutions], axis=1), nan=1.0).round(), 1).astype(int)
    unlike, which = np.unique(whole, axis=0, return_inverse=True)
    return np.asarray(np.array([_count(*each) for each in unlike.tolist()])[which.reshape(-1)])


def _count(turns: int, *revolutions: int) -> int:
    """How many even instants a cycle has: 360 of each revolution of its loads, up to the most, and some of each of the shaft's own.

    In a long cycle the loads come again many times, and the shaft in as many phases: the number has no divisor in common with either that
    would let the instants fall on few of them, and the shaft turns far from once between two of them.
    """
    count = max(INSTANTS, min(OF_TURN * max(revolutions), MOST_INSTANTS), OF_OWN_TURN * turns)
    while any(count // gcd(count, each) < OF_TURN for each in revolutions) or count // gcd(count, turns) < PHASES:
        count += 1
    return count


def _instants(joints: list[Array], counts: Array) -> tuple[Array, Array, Array]:
    """Shares of the cycle with the middles of their pieces (variants, instants), and the pieces' edges (variants, edges).

    A variant with fewer instants than others has its first ones again, so that it is as it is alone.
    """
    variants = len(counts)
    ends = np.zeros((variants, 1)), np.ones((variants, 1))
    edges = np.sort(np.nan_to_num(np.concatenate([*ends, *joints], axis=1)), axis=1)
    middles = (edges[:, :-1] + edges[:, 1:]) / 2
    even = np.arange(counts.max()) % counts[:, None] / counts[:, None]
    piece = np.minimum(np.sum(edges[:, :, None] <= even[:, None], axis=1) - 1, middles.shape[1] - 1)
    if not joints:
        return even, np.take_along_axis(middles, piece, axis=1), edges
    share = np.concatenate([even, edges[:, :-1], edges[:, 1:]], axis=1)
    return share, np.concatenate([np.take_along_axis(middles, piece, axis=1), middles, middles], axis=1), edges
