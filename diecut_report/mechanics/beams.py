"""A beam on two supports, piecewise of one stiffness: reactions, moments, deflection, its energy and its critical speed.

Arrays have the shape (variants, cases) for each of the loads and points, which stand in front: (points, variants, cases). A case is
an instant of a cycle, or a unit load. Places have the shape (points, variants). Forces count across the beam, couples from the beam's
axis to that direction; a moment is positive where it bends the beam towards positive deflection.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import GRAVITY

SAME_PLACE = 1e-9  # m, within which two places are one
LUMPS = 8  # of each piece's mass


@dataclass(frozen=True)
class Supports:
    """The places of the two supports, each of shape (variants,)."""

    first: Array
    second: Array

    @property
    def span(self) -> Array:
        """Return their distance, of shape (variants, 1); NaN where there is none."""
        span = (self.second - self.first)[:, None]
        return np.where(span > SAME_PLACE, span, np.nan)


@dataclass(frozen=True)
class Loading:
    """Forces (N) and couples (N m), each (loads, variants, cases), at places (loads, variants)."""

    places: Array
    forces: Array
    couples: Array

    def reactions(self, supports: Supports) -> tuple[Array, Array]:
        """Return what both supports hold against, (variants, cases) each."""
        arms = (self.places - supports.first)[:, :, None]
        second = -(np.sum(self.forces * arms, axis=0) + np.sum(self.couples, axis=0)) / supports.span
        return -np.sum(self.forces, axis=0) - second, second

    def held(self, supports: Supports) -> Loading:
        """Return the loading with the supports' reactions among its forces."""
        reactions = np.stack(self.reactions(supports))
        return Loading(
            np.concatenate([self.places, np.stack([supports.first, supports.second])]),
            np.concatenate([self.forces, reactions]),
            np.concatenate([self.couples, np.zeros_like(reactions)]),
        )

    def moments(self, x: Array) -> tuple[Array, Array]:
        """Return the bending moment just before and just behind places x (points, variants); a couple makes it jump.

        The loading must be held, that is, hold its reactions.
        """
        bending = summed(np.maximum(x[:, None] - self.places, 0), self.forces)
        if not np.any(self.couples):
            return bending, bending
        before, behind = before_and_behind(x, self.places, self.couples)
        return bending - before, bending - behind


def before_and_behind(x: Array, places: Array, values: Array) -> tuple[Array, Array]:
    """Return the running sums of what acts at places, just before and just behind x: a torque, an axial force."""
    before = summed((places < x[:, None] - SAME_PLACE).astype(float), values)
    return before, summed((places <= x[:, None] + SAME_PLACE).astype(float), values)


def summed(weights: Array, values: Array) -> Array:
    """Return the sums of values (loads, variants, cases) with weights (points, loads, variants): (points, variants, cases)."""
    products = np.moveaxis(weights, 2, 0) @ np.moveaxis(values, 1, 0)
    return np.moveaxis(products, 0, 1)


@dataclass(frozen=True)
class Bent:
    """The deflected beam at its points (points, variants): deflection and slope (points, variants, cases)."""

    x: Array
    deflection: Array
    slope: Array

    def at(self, places: Array) -> tuple[Array, Array]:
        """Return deflection and slope (places, variants, cases) at places (places, variants) that are among the points."""
        index = nearest(self.x, places)[:, :, None]
        return tuple(np.take_along_axis(each, index, axis=0) for each in (self.deflection, self.slope))  # type: ignore[return-value]


def nearest(x: Array, places: Array) -> Array:
    """Return which of points x (points, variants; ascending) each place (places, variants) is nearest to, by halving: (places, variants)."""
    low, high = np.zeros(places.shape, int), np.full(places.shape, len(x) - 1)
    for _ in range(len(x).bit_length()):
        middle = (low + high) // 2
        below = np.take_along_axis(x, middle, axis=0) < places
        low, high = np.where(below & (low < high), middle + 1, low), np.where(below, high, middle)
    before = np.maximum(low - 1, 0)
    to_before, to_behind = (np.abs(np.take_along_axis(x, each, axis=0) - places) for each in (before, low))
    return np.where(to_before <= to_behind, before, low)


def bent(x: Array, stiffness: Array, loading: Loading, supports: Supports) -> Bent:
    """Return the deflection line, exact between points x (ascending) that hold all loads, supports and steps.

    ``stiffness`` (points - 1, variants) is E I between one point and the next; the loading must be held.
    """
    before, behind = loading.moments(x)
    step = np.diff(x, axis=0)[:, :, None]
    compliance = 1 / stiffness[:, :, None]
    turned = step * (behind[:-1] + before[1:]) / 2 * compliance
    slope = np.concatenate([np.zeros_like(before[:1]), np.cumsum(turned, axis=0)])
    risen = slope[:-1] * step + step**2 * (2 * behind[:-1] + before[1:]) / 6 * compliance
    deflection = np.concatenate([np.zeros_like(before[:1]), np.cumsum(risen, axis=0)])
    free = Bent(x, deflection, slope)
    (first, second), _ = free.at(np.stack([supports.first, supports.second]))
    tilt = -(second - first) / supports.span
    shift = -first - tilt * supports.first[:, None]
    return Bent(x, deflection + shift + tilt * x[:, :, None], slope + tilt)


def bending_energy(x: Array, stiffness: Array, loading: Loading) -> Array:
    """Return the energy of the bent beam (variants, cases), the integral of M²/(2 E I); the loading must be held."""
    before, behind = loading.moments(x)
    start, end = behind[:-1], before[1:]
    pieces = np.diff(x, axis=0)[:, :, None] * (start**2 + start * end + end**2) / (6 * stiffness[:, :, None])
    energy: Array = np.sum(pieces, axis=0)
    return energy


def work(line: Bent, loading: Loading) -> Array:
    """Return the work of loads that grow slowly to their size (variants, cases), which is the energy of the bent beam."""
    deflection, slope = line.at(loading.places)
    done: Array = np.sum(loading.forces * deflection + loading.couples * slope, axis=0) / 2
    return done


def energy_rounding(x: Array, stiffness: Array, loading: Loading, supports: Supports) -> Array:
    """Return by how much rounding may set the energy of a held loading and its work apart, (variants, cases).

    Where loads stand on the supports both are next to nothing, and what is left of either is rounding. Its bound is that of an energy
    in which nothing cancels. Each of n forces F acts at an arm of at most the length l, and errs in a support's reaction by l to the
    span more: M = (Σ|F|·l + Σ|C|)·l / span bounds every sum of moments, and M²·Σ dx/(2 E I) every term of the energy and, as no way
    is longer than (l²/span)·∫M/(E I) dx, of the work. A moment and a reaction add up n terms, an energy p pieces, a way p pieces twice:
    no relative error is above 4·(n + p + 4)·ε.
    """
    length = (x[-1] - x[0])[:, None]
    greatest = np.sum(np.abs(loading.forces) * length + np.abs(loading.couples), axis=0) * length / supports.span
    energy = greatest**2 * np.sum(np.diff(x, axis=0) / stiffness, axis=0)[:, None] / 2
    terms = len(loading.places) + len(x) + 4
    found: Array = 4 * terms * np.finfo(float).eps * energy
    return found


@dataclass(frozen=True)
class Critical:
    """The lowest critical speed (rad/s, shape (variants,)) of masses on a beam without mass, with its two bounds."""

    speed: Array
    rayleigh: Array
    dunkerley: Array


def piece_of(x: Array, places: Array) -> Array:
    """Return in which piece between points x (points, variants) places (places, variants) lie; where two meet the one behind."""
    found: Array = np.clip(np.sum(x[None] <= places[:, None], axis=1) - 1, 0, len(x) - 2)
    return found


def influence(x: Array, stiffness: Array, places: Array, supports: Supports) -> Array:
    """Return the deflections (variants, i, j) at places i for unit forces at places j; all places are among the points x."""
    count, variants = places.shape
    unit = np.broadcast_to(np.eye(count)[:, None], (count, variants, count))
    loading = Loading(places, unit, np.zeros_like(unit)).held(supports)
    deflection, _ = bent(x, stiffness, loading, supports).at(places)
    return np.swapaxes(deflection, 0, 1)


def critical(
    x: Array, stiffness: Array, weights: Array, supports: Supports, places: Array, masses: Array, lumps: int = LUMPS
) -> Critical:
    """Return the critical speed of a beam with masses (masses, variants) at places, and its own ``weights`` (points - 1, variants, kg).

    Each piece's own mass stands in lumps at the middles of its parts.
    """
    shares = (np.arange(lumps) + 0.5) / lumps
    middles = (x[:-1, None] + np.diff(x, axis=0)[:, None] * shares[:, None]).reshape(-1, x.shape[1])
    own = np.repeat(weights / lumps, lumps, axis=0)
    at, mass = np.concatenate([places, middles]), np.concatenate([masses, own])
    fine = np.sort(np.concatenate([x, middles]), axis=0)
    along = np.take_along_axis(stiffness, piece_of(x, (fine[:-1] + fine[1:]) / 2), axis=0)
    # forces that bend the beam into its first form: upwards between the supports, downwards on overhangs
    signs = np.where((at < supports.first) | (at > supports.second), -1.0, 1.0)
    return _critical(influence(fine, along, at, supports), mass.T, signs.T)


def _critical(influences: Array, mass: Array, sign: Array) -> Critical:
    """Of influences (variants, i, j), and of masses and the signs of their forces (variants, i)."""
    root = np.sqrt(mass)
    matrix = np.nan_to_num(root[:, :, None] * influences * root[:, None, :])
    force = sign * mass * GRAVITY
    bent_by = np.einsum("vij,vj->vi", influences, force)
    return Critical(
        1 / np.sqrt(_greatest((matrix + np.swapaxes(matrix, 1, 2)) / 2)),
        np.sqrt(np.sum(force * bent_by, axis=1) / np.sum(mass * bent_by**2, axis=1)),
        1 / np.sqrt(np.einsum("vi,vii->v", mass, influences)),
    )


def _greatest(matrices: Array) -> Array:
    """The greatest eigenvalue of each symmetric matrix (variants, i, j), by Lanczos' method: a twentieth of the time that all of them take."""
    from scipy.sparse.linalg import eigsh

    start = np.ones(matrices.shape[1])
    found = [
        eigsh(each, 1, which="LA", v0=start, return_eigenvectors=False) if each.any() else [0.0] for each in matrices
    ]
    return np.array(found)[:, 0]
