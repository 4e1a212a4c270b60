"""The material point of the least safety against fatigue, sought for many places of many shafts at once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.plugins.shaft import formulas
from diecut_report.plugins.shaft.statics import Sides

Array = NDArray[Any]
DIRECTIONS = np.arange(120) * np.pi / 60  # of the material point that are looked at first
ROUGHLY = 5  # at every so many of them all instants are looked at: their extremes tell those between but for 1 %
NEAR = np.linspace(-1, 1, 21)  # of a step between directions, at each turn of the bounded search
NARROWED = 0.1
TOGETHER = 48  # places at once, so that what is computed stays in the processor's cache
ROUNDING = 1e-12  # share of a stress that is no stress


@dataclass(frozen=True)
class Points:
    """Hold places (one side of one place of one shaft each) with their moments as seen by the turning shaft, (places, 2, instants)."""

    moments: Array
    axial: Array | None
    bounds: Array
    shear: tuple[Array, Array]
    factors: dict[str, Array]

    def at(self, instants: Array) -> Points:
        """Return the places with some of the instants alone, (places or 1, instants)."""
        axial = None if self.axial is None else np.take_along_axis(self.axial, instants, axis=1)
        return replace(self, moments=np.take_along_axis(self.moments, instants[:, None], axis=2), axial=axial)

    def near(self, psi: Array, turn: float) -> Points:
        """Return the places with those instants alone whose stress can be extreme within a turn of directions psi (places, 1)."""
        along, beside = ((_towards(each) @ self.moments)[:, 0] for each in (psi, psi + np.pi / 2))
        stress = along if self.axial is None else along - self.axial
        can = np.zeros(stress.shape, dtype=bool)
        for extreme in (np.argmin(stress, axis=1)[:, None], np.argmax(stress, axis=1)[:, None]):
            gap, ahead, aside = (
                np.abs(each - np.take_along_axis(each, extreme, axis=1)) for each in (stress, along, beside)
            )
            can |= gap < np.sin(turn) * aside + (1 - np.cos(turn)) * ahead
            np.put_along_axis(can, extreme, True, axis=1)
        most = int(np.max(np.sum(can, axis=1)))
        return self.at(np.argsort(~can, axis=1, kind="stable")[:, :most])

    def judged(self, psi: Array) -> tuple[Array, Array, Array]:
        """Return safety, amplitude and mean of the normal stress at directions (places or 1, directions)."""
        across = _towards(psi) @ self.moments
        if self.axial is not None:
            across -= self.axial[:, None]
        upper, lower = (
            -np.min(across, axis=2) + self.bounds[1][:, None],
            -np.max(across, axis=2) + self.bounds[0][:, None],
        )
        normal = (upper - lower) / 2, (upper + lower) / 2
        return formulas.goodman.function(*normal, *(each[:, None] for each in self.shear), *self._factors()), *normal

    def _factors(self) -> tuple[Array, ...]:
        return tuple(self.factors[name][:, None] for name in ("k_f", "k_fs", "endurance", "tensile_strength"))

    @property
    def worst(self) -> tuple[Array, Array, Array]:
        """Return safety, amplitude and mean where the safety is least, (places,) each."""
        is_symmetric = self.axial is None and not np.any(self.bounds)  # opposite points then have opposite stresses
        psi = (DIRECTIONS[: len(DIRECTIONS) // 2] if is_symmetric else DIRECTIONS)[None]
        step = float(DIRECTIONS[1])
        best = self.at(self._extremes(psi[:, ::ROUGHLY]))._least(psi)
        near = self.near(best, step * (1 + NARROWED))
        for _ in range(2):
            best, step = near._least(best + step * NEAR), step * NARROWED
        safety, amplitude, mean = (each[:, 0] for each in near.judged(best))
        is_rounding = np.abs(mean) < ROUNDING * (np.abs(amplitude) + np.abs(mean))
        return safety, amplitude, np.where(is_rounding, 0.0, mean)

    def _extremes(self, psi: Array) -> Array:
        """The instants of least and greatest normal stress at directions (1, directions), (places, 2 directions)."""
        across = _towards(psi) @ self.moments
        if self.axial is not None:
            across -= self.axial[:, None]
        return np.concatenate([np.argmin(across, axis=2), np.argmax(across, axis=2)], axis=1)

    def _least(self, psi: Array) -> Array:
        """Which of the directions (places or 1, directions) has the least safety, (places, 1)."""
        safety = self.judged(psi)[0]
        return np.take_along_axis(np.broadcast_to(psi, safety.shape), np.argmin(safety, axis=1)[:, None], axis=1)


def _towards(psi: Array) -> Array:
    return np.stack([np.cos(psi), np.sin(psi)], axis=2)


def worst_points(sides: Sides, angle: Array, own: dict[str, Array]) -> dict[str, Array]:
    """Return the stresses that judge each place, (variants, places) each, on the side of the lesser safety.

    ``angle`` is the shaft's (variants, instants), ``own`` the factors of the places (places, variants).
    """
    shape = sides.xy.shape[1:3]
    chosen = np.concatenate([np.ones((1, *shape), dtype=bool), _differs(sides)[None]])
    side, place, variant = np.nonzero(chosen)
    torque, turned_by = _torque(sides), (np.cos(angle), np.sin(angle))
    found = [_worst(sides, turned_by, own, torque, *(each[i : i + TOGETHER] for each in (side, place, variant)))
             for i in range(0, len(side), TOGETHER)]  # fmt: skip
    safety, *rest = (np.full((2, *shape), np.inf) for _ in range(3))
    for table, name in zip((safety, *rest), range(3), strict=True):
        table[side, place, variant] = np.concatenate([each[name] for each in found])
    lesser = np.argmin(safety, axis=0)[None]
    tables = {"sigma_a": rest[0], "sigma_m": rest[1], "torque_upper": torque[1], "torque_lower": torque[0]}
    return {name: np.take_along_axis(table, lesser, axis=0)[0].T for name, table in tables.items()}


def _differs(sides: Sides) -> Array:
    """Return whether the forces behind a place are others than before it, (places, variants)."""
    forces = (sides.xy, sides.xz, sides.torque, sides.axial, *sides.torque_bounds, *sides.axial_bounds)
    return np.asarray(np.any([np.any(each[0] != each[1], axis=-1) for each in forces], axis=0))


def _torque(sides: Sides) -> tuple[Array, Array]:
    """Return least and greatest torque over the cycle on both sides of each place, (2, places, variants)."""
    low, high = (each[..., 0] for each in sides.torque_bounds)
    return np.min(sides.torque, axis=3) + low, np.max(sides.torque, axis=3) + high


def _worst(
    sides: Sides,
    turned_by: tuple[Array, Array],
    own: dict[str, Array],
    torque: tuple[Array, Array],
    side: Array,
    place: Array,
    variant: Array,
) -> tuple[Array, Array, Array]:
    at = side, place, variant
    factors = {name: each[place, variant] for name, each in own.items()}
    xy, xz, cosine, sine = sides.xy[at], sides.xz[at], *(each[variant] for each in turned_by)
    turned = np.stack([xy * cosine + xz * sine, xz * cosine - xy * sine], axis=1) / factors["modulus"][:, None, None]
    area = factors["area"][:, None]
    axial = sides.axial[at] / area if np.any(sides.axial) else None
    axial = None if axial is None else np.broadcast_to(axial, (len(side), turned.shape[2]))
    bounds = np.stack([each[at][:, 0] for each in sides.axial_bounds]) / area[:, 0]
    least, most = torque[0][at], torque[1][at]
    shear = tuple(each / (4 * factors["modulus"]) for each in (most - least, most + least))
    return Points(turned, axial, bounds, shear, factors).worst
