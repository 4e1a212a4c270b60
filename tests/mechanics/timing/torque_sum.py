"""Another way to what all lines take from the main shaft together: mean, rms, extremes, energy that a flywheel and the lines themselves store.

A torque M at a line's own shaft is i·M·η^(−sgn M) at the main shaft, i turns of the line a turn of the main shaft: losses add
where the shaft gives power, and take away where the line gives it back.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import ceil

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanics.timing.intervals import DrivenLine
from tests.mechanics.timing.bracketed import sign_changes
from tests.mechanics.timing.legendre_pieces import LegendrePieces, split, unique_edges

TURN = 2 * np.pi
WIDEST = np.pi / 8  # of a piece, in the angle of the line that turns fastest

Curve = Callable[
    [Array, Array], Array
]  # of shares of its period and, as many, shares that lie in the same smooth piece


@dataclass(frozen=True, eq=False)
class LineCurve:
    """Hold a curve of a line over ``spans`` of its own turns; ``breakpoints`` are shares of them where it is not smooth.

    ``curve`` takes shares in [0, 1] and the middles of their smooth pieces, both of shape (points,), so that the values at an
    edge are one-sided; it gives that shape, SI.
    """

    curve: Curve
    breakpoints: Array
    line: DrivenLine
    spans: int = 1

    def at(self, angle: Array, middle: Array) -> Array:
        """Return the curve at main-shaft angles, as it is on the line's own shaft."""
        rate = float(self.line.turns) / (TURN * self.spans)
        share, inside = (angle - self.line.offset) * rate, (middle - self.line.offset) * rate
        passed = np.floor(inside)
        return self.curve(share - passed, inside - passed)

    def edges(self, common: Fraction) -> Array:
        """Return the main-shaft angles of its breakpoints over the common period (turns of the main shaft)."""
        own = self.spans / self.line.turns
        start = self.line.offset % (TURN * float(own))
        turns = np.arange(-1, ceil(common / own) + 1)[:, None]
        shares = np.concatenate([[0.0], self.breakpoints])
        found: Array = (start + (turns + shares) * TURN * float(own)).ravel()
        return found


@dataclass(frozen=True, eq=False)
class Consumer:
    """Hold what takes torque from the main shaft: its torque at its own shaft (N·m), and the efficiency of the way there."""

    name: str
    torque: LineCurve
    efficiency: float = 1.0

    def at_main_shaft(self, angle: Array, middle: Array) -> Array:
        """Return its torque at the main shaft (N·m)."""
        return self.carried(self.torque.at(angle, middle))

    def carried(self, own: Array) -> Array:
        """Return what a torque at its own shaft is at the main shaft."""
        return float(self.torque.line.turns) * with_losses(own, self.efficiency)


def friction(name: str, torque: float, line: DrivenLine, efficiency: float = 1.0) -> Consumer:
    """Return a consumer with a constant torque at its own shaft (N·m); a power P is the torque P/(i·ω_main)."""
    return Consumer(name, LineCurve(lambda share, _: np.full(np.shape(share), torque), np.empty(0), line), efficiency)


def with_losses(torque: Array, efficiency: float) -> Array:
    """Return a torque before a way with losses: more where it drives, less where it is given back."""
    return np.where(torque > 0, torque / efficiency, torque * efficiency)


def carried_back(torque: LegendrePieces, ratio: float, efficiency: float) -> LegendrePieces:
    """Return a torque at a shaft that turns ``ratio`` times as fast, before losses that follow the torque's sign."""
    edges = unique_edges(
        np.concatenate([torque.edges, torque.crossings()]), float(torque.edges[0]), float(torque.edges[-1])
    )
    return torque.between(edges, lambda values: with_losses(values, efficiency) / ratio)


@dataclass(frozen=True, eq=False)
class TorqueSum:
    """Hold the torque of each consumer at the main shaft and their total, over the common period, and what follows from the total.

    Torques in N·m over main-shaft angle; ``energy_fluctuation`` is the range of the excess energy ∮(M − mean)dΦ (J).
    """

    parts: dict[str, LegendrePieces]
    total: LegendrePieces
    figures: TorqueFigures = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "figures", figures(self.total))


@dataclass(frozen=True)
class TorqueFigures:
    """Hold mean, rms, extremes (one-sided limits included) with their angles, and the energy fluctuation of a torque."""

    mean: float
    rms: float
    largest: float
    largest_at: float
    least: float
    least_at: float
    energy_fluctuation: float

    @property
    def peak(self) -> float:
        """Return the greatest size of the torque."""
        return max(abs(self.largest), abs(self.least))


def figures(torque: LegendrePieces) -> TorqueFigures:
    """Return the figures of a torque over its period."""
    return TorqueFigures(torque.mean, torque.rms, *torque.largest, *torque.least, energy_fluctuation(torque))


def excess_energy(torque: LegendrePieces) -> Callable[[Array], Array]:
    """Return the energy ∫(M − mean)dΦ taken since the start (J), as a function of the main-shaft angle in one period."""
    running, mean = torque.running(), torque.mean
    return lambda angle: running.at(angle) - mean * (angle - torque.edges[0])


def energy_fluctuation(torque: LegendrePieces) -> float:
    """Return the range of the excess energy (J): its turning points are where the torque crosses its mean, or jumps across it."""
    places = np.concatenate([torque.edges, torque.crossings(torque.mean)])
    return float(np.ptp(excess_energy(torque)(places)))


def torque_sum(consumers: Sequence[Consumer], common: Fraction) -> TorqueSum:
    """Return the sum of all consumers (at least one) at the main shaft, over the common period (turns of the main shaft)."""
    smooth = sum_edges([each.torque for each in consumers], common)
    reversals = [sign_changes(each.torque.at, smooth) for each in consumers]
    edges = unique_edges(np.concatenate([smooth, *reversals]), 0.0, float(smooth[-1]))
    parts = {each.name: LegendrePieces.of(each.at_main_shaft, edges) for each in consumers}
    return TorqueSum(parts, total(list(parts.values())))


def sum_edges(curves: Sequence[LineCurve], common: Fraction) -> Array:
    """Return the edges of the smooth pieces of all curves together over the common period, none wider than π/8 of any line."""
    places = np.concatenate([each.edges(common) for each in curves])
    fastest = max(1.0, *(float(each.line.turns) for each in curves))
    return split(unique_edges(places, 0.0, TURN * float(common)), WIDEST / fastest)


def total(parts: Sequence[LegendrePieces]) -> LegendrePieces:
    """Return the sum of curves on the same edges."""
    return LegendrePieces(parts[0].edges, np.sum([each.coefficients for each in parts], axis=0))


@dataclass(frozen=True, eq=False)
class EnergySum:
    """Hold the kinetic energy of each line over the main-shaft angle (J), their total, and what they lend one another.

    ``exchange`` is Σ range(E_k) − range(ΣE_k) ≥ 0.
    """

    parts: tuple[LegendrePieces, ...]
    total: LegendrePieces
    exchange: float


def energy_exchange(energies: Sequence[LineCurve], common: Fraction) -> EnergySum:
    """Return the sum of the kinetic energies of all lines (at least one), given over their own turns (J)."""
    edges = sum_edges(energies, common)
    parts = tuple(LegendrePieces.of(each.at, edges) for each in energies)
    together = total(parts)
    return EnergySum(parts, together, sum(spread(each) for each in parts) - spread(together))


def spread(curve: LegendrePieces) -> float:
    """Return the greatest less the least value."""
    return curve.largest[0] - curve.least[0]
