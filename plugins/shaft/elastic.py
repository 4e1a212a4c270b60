"""The shaft as an elastic body on its bearings, whatever its loads: what unit loads bend it by, and its critical speed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.mechanics import beams
from diecut_report.mechanics.beams import Bent, Loading, Supports
from diecut_report.mechanics.sections import tube
from diecut_report.plugins.shaft.body import Body

Array = NDArray[Any]
KEPT = 32  # shafts that are remembered: where a press is calculated again, it is mostly with other loads
WITHIN = np.linspace(0, 1, 5)  # of a piece, where the greatest deflection is looked for over the cycle
FINE = np.linspace(0, 1, 101)  # of a piece, where the greatest deflection is looked for at its instant


@dataclass(frozen=True)
class ElasticShaft:
    """Hold some variants of the shaft with the places and masses of their loads (loads, variants); numbers are (variants,)."""

    body: Body
    supports: Supports
    places: Array
    masses: Array
    modulus: Array
    density: Array

    @cached_property
    def x(self) -> Array:
        """Return all places where something begins or acts, ascending, (points, variants)."""
        return np.asarray(np.sort(np.concatenate([self.body.ends[[0, -1]], self.body.x]), axis=0))

    def stiffness_of(self, x: Array) -> Array:
        """Return E I between one place and the next, (places - 1, variants)."""
        diameter, bore = self.section_between(x)
        return np.asarray(self.modulus * tube(diameter, bore).second_moment)

    def section_between(self, x: Array) -> tuple[Array, Array]:
        """Return diameter and bore between one place and the next."""
        index = self.body.section_of((x[:-1] + x[1:]) / 2, behind=True)
        return tuple(np.take_along_axis(each, index, axis=0) for each in (self.body.diameter, self.body.bore))  # type: ignore[return-value]

    @cached_property
    def at_joints(self) -> Bent:
        """Return what unit loads bend at the places where something begins or acts."""
        return self.by_unit_loads(self.x)

    @cached_property
    def within(self) -> Bent:
        """Return what unit loads bend at these places and some between them."""
        return self.by_unit_loads(between(self.x, WITHIN))

    @cached_property
    def closely(self) -> Bent:
        """Return what unit loads bend at these places and many between them."""
        return self.by_unit_loads(between(self.x, FINE))

    def by_unit_loads(self, x: Array) -> Bent:
        """Return the deflection lines at places that hold all others, for a unit force, and for a unit couple, at the place of
        each load (places, variants, loads)."""
        chosen, like = self._unlike
        places, supports = self.places[:, chosen], self._supports_of(chosen)
        unit = np.broadcast_to(np.eye(len(places))[:, None], (*places.shape, len(places)))
        forces, couples = np.concatenate([unit, 0 * unit], axis=2), np.concatenate([0 * unit, unit], axis=2)
        loading = Loading(places, forces, couples).held(supports)
        found = beams.bent(x[:, chosen], self.stiffness_of(x)[:, chosen], loading, supports)
        return Bent(x, found.deflection[:, like], found.slope[:, like])

    @cached_property
    def critical(self) -> beams.Critical:
        """Return the critical speed with its bounds."""
        chosen, like = self._unlike
        given = self.x, self.stiffness_of(self.x), self._weights, self.places, self.masses
        x, stiffness, weights, places, masses = (each[:, chosen] for each in given)
        found = beams.critical(x, stiffness, weights, self._supports_of(chosen), places, masses)
        return beams.Critical(found.speed[like], found.rayleigh[like], found.dunkerley[like])

    def _supports_of(self, chosen: Array) -> Supports:
        return Supports(self.supports.first[chosen], self.supports.second[chosen])

    @cached_property
    def _weights(self) -> Array:
        """The mass between one place and the next, (places - 1, variants)."""
        diameter, bore = self.section_between(self.x)
        return np.asarray(self.density * tube(diameter, bore).area * np.diff(self.x, axis=0))

    @cached_property
    def _unlike(self) -> tuple[Array, Array]:
        """The first variants of each geometry, and for each variant which of them it is like: most studies vary the loads alone."""
        masses = self._weights, self.masses
        own = np.stack([self.supports.first, self.supports.second])
        geometry = np.concatenate([self.x, self.stiffness_of(self.x), *masses, self.places, own])
        _, first, like = np.unique(geometry, axis=1, return_index=True, return_inverse=True)
        return first, like.ravel()


class _Alone(NamedTuple):
    """Hold a single shaft as a key: equal are those that are the same to the last bit."""

    shaft: ElasticShaft
    content: tuple[Any, ...]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Alone) and self.content == other.content

    def __hash__(self) -> int:
        return hash(self.content)


def remembered(shaft: ElasticShaft) -> ElasticShaft:
    """Return a shaft, of a single variant the one that is the same to the last bit and known already, with all that was found of it."""
    if len(shaft.modulus) != 1:
        return shaft
    parts = (*vars(shaft.body).values(), *vars(shaft.supports).values(), *(vars(shaft)[name] for name in NUMBERS))
    return _kept(_Alone(shaft, tuple(map(_content, parts))))


NUMBERS = ("places", "masses", "modulus", "density")


def _content(part: Any) -> Any:
    return (part.shape, part.dtype.str, part.tobytes()) if isinstance(part, np.ndarray) else part


@lru_cache(maxsize=KEPT)
def _kept(alone: _Alone) -> ElasticShaft:
    return alone.shaft


def between(x: Array, shares: Array) -> Array:
    """Return places between each place and the next, with them, ascending."""
    inner = x[:-1, None] + np.diff(x, axis=0)[:, None] * shares[None, :, None]
    return np.asarray(inner.reshape(-1, x.shape[1]))
