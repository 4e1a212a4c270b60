"""A driven link on an elastic, damped drive: the inertia I follows the input y through the stiffness K and the damping C.

I·ẍ = K·(y − x) + C·(ẏ − ẋ) with x = y and ẋ = ẏ = 0 at the start, 0 ≤ ζ < 1. The deflection of the drive z = x − y then obeys
z̈ + 2ζω·ż + ω²·z = −ÿ, solved by Duhamel's integral; it is taken apart into two running integrals from the start to the time t,
of ``in_phase_part`` and of ``quadrature_part``, from which ``deflection`` and ``deflection_velocity`` follow. They hold
e^(ζωt), which a number can hold up to ζωt = 700: ``follower_peaks`` goes further, and needs no running integrals.

Formulas take numbers or arrays, and hold as well for a straight movement: the inertia is a mass then, the torque a force.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import legendre

from diecut_report.formulas import Array
from diecut_report.formulas.expression import as_angle, as_number, pi
from diecut_report.formulas.formula import formula
from diecut_report.mechanics.motion_laws import MotionLaw


@formula
def natural_angular_frequency(stiffness: Any, inertia: Any) -> Any:
    """ω, angular frequency at which the link would swing without damping."""
    return as_angle(np.sqrt(stiffness / inertia))


@formula
def damped_angular_frequency(angular_frequency: Any, damping_ratio: Any) -> Any:
    """ω_d, angular frequency at which the damped link swings."""
    return angular_frequency * np.sqrt(1 - damping_ratio**2)


@formula
def damping_constant(damping_ratio: Any, inertia: Any, angular_frequency: Any) -> Any:
    """C, torque of the damping for each unit of the speed of deflection."""
    return 2 * damping_ratio * inertia * as_number(angular_frequency)


@formula
def tuning_ratio(angular_frequency: Any, rise_time: Any) -> Any:
    """λ, number of natural periods within the rise."""
    return angular_frequency * rise_time / (2 * pi)


@formula
def decay(time: Any, angular_frequency: Any, damping_ratio: Any) -> Any:
    """E, share of a vibration that is left after a time."""
    return np.exp(-damping_ratio * as_number(angular_frequency) * time)


@formula
def phase(time: Any, damped_frequency: Any) -> Any:
    """ψ, phase of the damped vibration."""
    return damped_frequency * time


@formula
def in_phase_part(decay: Any, phase: Any, input_acceleration: Any) -> Any:
    """What the running integral C(t) adds up."""
    return np.cos(phase) * input_acceleration / decay


@formula
def quadrature_part(decay: Any, phase: Any, input_acceleration: Any) -> Any:
    """What the running integral S(t) adds up, a quarter period behind C(t)."""
    return np.sin(phase) * input_acceleration / decay


@formula
def deflection(decay: Any, phase: Any, damped_frequency: Any, in_phase: Any, quadrature: Any) -> Any:
    """z = x − y, by which the link is ahead of the input."""
    return decay / as_number(damped_frequency) * (np.cos(phase) * quadrature - np.sin(phase) * in_phase)


@formula
def swing_amplitude(decay: Any, damped_frequency: Any, in_phase: Any, quadrature: Any) -> Any:
    """Amplitude of the vibration that is left once the input rests; it falls by the decay alone."""
    return decay / as_number(damped_frequency) * np.sqrt(in_phase**2 + quadrature**2)


@formula
def time_to_fall(swing: Any, tolerance: Any, angular_frequency: Any, damping_ratio: Any) -> Any:
    """Time in which the amplitude of a free vibration falls to a tolerance."""
    return np.log(swing / tolerance) / (damping_ratio * as_number(angular_frequency))


@formula
def swing_speed(decay: Any, phase: Any, in_phase: Any, quadrature: Any) -> Any:
    """The part of the deflection's speed that the phase's growth gives."""
    return -decay * (np.cos(phase) * in_phase + np.sin(phase) * quadrature)


@formula
def deflection_velocity(swing_speed: Any, angular_frequency: Any, damping_ratio: Any, deflection: Any) -> Any:
    """ż, speed at which the deflection grows."""
    return swing_speed - damping_ratio * as_number(angular_frequency) * deflection


@formula
def response_acceleration(angular_frequency: Any, damping_ratio: Any, deflection: Any, deflection_velocity: Any) -> Any:
    """ẍ, acceleration of the driven link."""
    omega = as_number(angular_frequency)
    return -2 * damping_ratio * omega * deflection_velocity - omega**2 * deflection


@formula
def drive_torque(stiffness: Any, damping_constant: Any, deflection: Any, deflection_velocity: Any) -> Any:
    """Torque of the elastic drive on the link, which speeds it up."""
    return -stiffness * deflection - damping_constant * deflection_velocity


# Peaks of the acceleration of a driven link on an elastic, damped drive (see ``linear_follower``), for many drives at once.
#
# The rise is 1 in the time 1, so that ω = 2πλ. With p = −ζω + iω_d and the complex state V of V̇ = p·V − p²/ω_d·ÿ, V(0) = 0,
# the link's acceleration is ẍ = Im V: V is the two running integrals of Duhamel's solution, turned and scaled so that no power
# of e grows with the rise. The rise is cut at the law's joints and then into cells so short that within each
# one the law is a polynomial to rounding and the link swings through an eighth of its natural period at most; V goes from
# cell to cell by e^(ph) and a Gauss–Legendre quadrature of the convolution, so that no error of a time step arises. Within a
# cell ẍ is the polynomial through its values at the nodes, whose greatest value Newton's method finds.


ORDER = 12  # nodes in a cell
CELLS_A_PERIOD = 8  # at least, of the natural period
RESOLVED = 1e-12  # of the rigid peak: what the two highest orders of the law's series in a cell may reach
HALVINGS = 10  # of a smooth piece, at most, to resolve the law
REACH = 0.05  # of the greatest value at the nodes, by which a cell's own may stay below it and yet hold the peak
BLOCK = 600_000  # values at nodes that are held at a time

PLACES, WEIGHTS = legendre.leggauss(ORDER)  # in [−1, 1] of a cell
NODES = (PLACES + 1) / 2  # the same in [0, 1]
BASIS = legendre.legvander(PLACES, ORDER - 1)
FIT = (np.arange(ORDER) + 0.5)[:, None] * BASIS.T * WEIGHTS  # values at the nodes to Legendre coefficients
# values at the nodes to the running integrals from the cell's start to each node
RUNNING = np.array([legendre.legval(PLACES, legendre.legint(column, lbnd=-1)) for column in FIT.T]).T / 2
GRID = np.linspace(-1, 1, 65)  # from which the search for a cell's peak starts
ON_GRID = legendre.legvander(GRID, ORDER - 1)


class Peaks(NamedTuple):
    """Greatest acceleration of the driven link during the rise and after it, to the rigid link's greatest one."""

    rise: Array
    residual: Array


class _Cells(NamedTuple):
    """The cells of a rise in time's order: their widths, and the law's acceleration at the nodes of each."""

    width: Array
    acceleration: Array


def peaks(law: MotionLaw, tuning_ratio: Any, damping_ratio: Any) -> Peaks:
    """Peaks for λ natural periods within the rise and the damping ratio ζ, in the shape that the two have together.

    Exact to 1e-9 for λ up to 100; NaN where λ is not above zero or ζ not in [0, 1).
    """
    ratio, damping = np.broadcast_arrays(np.asarray(tuning_ratio, float), np.asarray(damping_ratio, float))
    found = np.full((2, ratio.size), np.nan)
    known = np.isfinite(ratio) & (ratio > 0) & (damping >= 0) & (damping < 1)
    for few, cells in _groups(law, ratio.ravel(), np.flatnonzero(known)):
        found[:, few] = _extremes(cells, 2 * np.pi * ratio.ravel()[few], damping.ravel()[few])
    rise, residual = (found / law.A).reshape(2, *ratio.shape)
    return Peaks(rise, residual)


def _groups(law: MotionLaw, ratio: Array, known: Array) -> Iterator[tuple[Array, _Cells]]:
    """Drives of like λ (within an octave), no more than fit into a block, with cells that suit them all."""
    periods = np.maximum(ratio[known], 1)
    octave = np.ceil(np.log2(periods))
    for level in np.unique(octave):
        alike = known[octave == level]
        cells = _cells(law, float(periods[octave == level].max()))
        blocks = -(-alike.size * cells.width.size * ORDER // BLOCK)
        for few in np.array_split(alike, min(blocks, alike.size)):
            yield few, cells


def _sampled(law: MotionLaw, start: Array, width: Array) -> Array:
    """The law's acceleration at the nodes of cells, which are never on a joint."""
    k = start[:, None] + width[:, None] * NODES
    return np.broadcast_to(np.asarray(law.acceleration(k), float), k.shape)


def _cells(law: MotionLaw, periods: float) -> _Cells:
    """Cells that resolve the law, and as many natural periods as there are in the rise."""
    edges = np.array([0.0, *law.breakpoints, 1.0])
    start, width = edges[:-1], np.diff(edges)
    for _ in range(HALVINGS):
        rough = np.abs(_sampled(law, start, width) @ FIT[-2:].T).max(axis=1) > RESOLVED * law.A
        half = width[rough] / 2
        start = np.concatenate([start[~rough], start[rough], start[rough] + half])
        width = np.concatenate([width[~rough], half, half])
    order = np.argsort(start)
    start, width = start[order], width[order]
    parts = np.ceil(CELLS_A_PERIOD * periods * width).astype(int)
    number = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    width = np.repeat(width / parts, parts)
    return _Cells(width, _sampled(law, np.repeat(start, parts) + number * width, width))


def _extremes(cells: _Cells, omega: Array, damping: Array) -> tuple[Array, Array]:
    """Greatest |ẍ| during the rise and after it for drives of natural angular frequency ω and damping ratio ζ."""
    pole = omega * (-damping + 1j * np.sqrt(1 - damping**2))
    states = _states(cells, pole)
    end = states[-1]
    swing = (-np.angle(pole * end) % np.pi) / pole.imag  # until the first time after the end at which ẍ stands still
    residual = np.maximum(np.abs(end.imag), np.abs((end * np.exp(pole * swing)).imag))
    values = _at_nodes(cells, pole, states[:-1])
    return np.maximum(_greatest(values), np.abs(states.imag).max(axis=0)), residual


def _widths(cells: _Cells) -> Iterator[tuple[float, Array]]:
    """Each width that cells have, with the numbers of those cells."""
    width, which = np.unique(cells.width, return_inverse=True)
    for index, value in enumerate(width):
        yield float(value), np.flatnonzero(which == index)


def _states(cells: _Cells, pole: Array) -> Array:
    """V at the start of each cell (first axis) and at the end of the rise, for each drive."""
    grown = np.empty((cells.width.size, pole.size), complex)
    added = np.empty_like(grown)
    for width, some in _widths(cells):
        kernel = np.exp(pole * width * (1 - NODES[:, None])) * (width / 2 * WEIGHTS[:, None])
        grown[some] = np.exp(pole * width)
        added[some] = cells.acceleration[some] @ kernel * (-(pole**2) / pole.imag)
    states = np.zeros((cells.width.size + 1, pole.size), complex)
    for index, (factor, force) in enumerate(zip(grown, added, strict=True)):
        states[index + 1] = factor * states[index] + force
    return states


def _at_nodes(cells: _Cells, pole: Array, states: Array) -> Array:
    """The link's acceleration at the nodes (last axis) of each cell (first axis), for each drive."""
    values = np.empty((*states.shape, ORDER))
    for width, some in _widths(cells):
        growth = np.exp(pole[:, None] * width * NODES)
        scale = -(pole**2) / pole.imag * width
        kernel = ((scale[:, None] * growth)[:, :, None] * RUNNING / growth[:, None, :]).imag
        forced = cells.acceleration[some] @ kernel.reshape(-1, ORDER).T
        free = states[some].real[:, :, None] * growth.imag + states[some].imag[:, :, None] * growth.real
        values[some] = free + forced.reshape(free.shape)
    return values


def _greatest(values: Array) -> Array:
    """Greatest |ẍ| of each drive by its values at the nodes of all cells, refined in all cells that may hold it."""
    top = np.abs(values).max(axis=2)
    best: Array = top.max(axis=0)
    near = top >= (1 - REACH) * best
    np.maximum.at(best, np.nonzero(near)[1], _refined(values[near] @ FIT.T))
    return best


def _refined(series: Array) -> Array:
    """Greatest size of Legendre series (one a row) in [−1, 1], the ends with it."""
    coarse = np.abs(series @ ON_GRID.T)
    start = GRID[coarse.argmax(axis=1)]
    slope, bend = (legendre.legder(series, order, axis=1).T for order in (1, 2))
    place, spacing = start, GRID[1] - GRID[0]
    for _ in range(3):
        rate, turn = legendre.legval(place, slope, tensor=False), legendre.legval(place, bend, tensor=False)
        step = np.divide(rate, turn, out=np.zeros_like(rate), where=np.abs(turn) * spacing > np.abs(rate))
        place = np.clip(place - step, np.maximum(start - spacing, -1), np.minimum(start + spacing, 1))
    fine: Array = np.abs(legendre.legval(place, series.T, tensor=False))
    best: Array = np.maximum(coarse.max(axis=1), fine)
    return best
