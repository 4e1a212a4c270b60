"""Torque of the platen press from the equilibrium of rod, crank and platen as vectors, solved numerically."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.machine.calculation import Calculation
from tests.machines import number
from tests.plugins.platens import GUIDED, at, platen

R, ROD, RADII = 0.11, 0.635, (0.06, 0.0475, 0.05025)
FRICTION = 0.1


def pins(phi: float, stands: float | None) -> tuple[complex, complex]:
    """Crank pin and platen's pin; the platen stands at a place, or follows rods of their own length."""
    crank = R * np.exp(1j * (np.pi - phi))
    return crank, complex(crank.real + np.sqrt(ROD**2 - crank.imag**2)) if stands is None else complex(stands)


def turned(phi: float, stands: float | None) -> float:
    """Angular speed of the rod to the crank's, by differences; the crank turns clockwise."""
    step = 1e-6
    low, high = (np.angle(b - a) for a, b in (pins(phi - step, stands), pins(phi + step, stands)))
    return float((high - low) / (2 * step))


def balance(phi: float, pull: float, moments: tuple[float, float, float], stands: float | None = None) -> float:
    """Torque of the crank, from nine equations: forces and moments on platen, rod and crank.

    ``pull`` is the force on the platen away from the shaft that the rod must carry along the guides, ``moments`` the size of the
    friction moments at platen's pin, crank pin and journal; each resists the turning of its two parts.
    """
    a, b = pins(phi, stands)
    rod = turned(phi, stands)
    at_b, at_a, at_o = moments
    on_rod_b = -at_b * np.sign(rod)  # the platen does not turn
    on_rod_a = -at_a * np.sign(rod + 1)  # the crank turns with −1
    on_crank_o = at_o  # against its clockwise turning
    # unknowns: force of platen on rod (bx, by), of crank on rod (ax, ay), of guides on platen g, of frame on crank (ox, oy), torque M
    equations = np.zeros((8, 8))
    known = np.zeros(8)
    equations[0, 0], known[0] = -1, -pull  # platen along: pull − bx = 0
    equations[1, [1, 4]] = -1, 1  # platen across
    equations[2, [0, 2]] = 1  # rod along
    equations[3, [1, 3]] = 1  # rod across
    equations[4, [2, 3]] = -(a - b).imag, (a - b).real  # rod about B
    known[4] = -(on_rod_a + on_rod_b)
    equations[5, [2, 5]] = -1, 1
    equations[6, [3, 6]] = -1, 1
    equations[7, [2, 3, 7]] = a.imag, -a.real, 1  # crank about O
    known[7] = -(on_crank_o - on_rod_a)
    return -float(np.linalg.solve(equations, known)[7])  # driving is clockwise


def angles(calc: Calculation) -> list[float]:
    """Crank angles while cutting and in free travel."""
    begin, end = number(calc, "dwell_end_angle"), 2 * np.pi
    return [float(phi) for phi in np.linspace(begin + 1e-3, end - 1e-6, 181)]


@pytest.mark.parametrize("rate, guided", [(1200, {}), (30_000, {}), (1200, GUIDED)])
def test_the_moving_platens_torque_is_that_of_equilibrium(rate: float, guided: dict[str, str]) -> None:
    """The rods carry the guides' friction too; the joints' own friction follows the force without it."""
    calc = platen(cycles_per_hour=rate, **guided)
    for phi in angles(calc):
        force = float(at(calc, "force", phi)[0])
        couple = force * 0.005 - 306 * 9.80665 * 0.02
        slide = -np.sign(np.sin(phi)) * 2 * FRICTION * abs(couple) / 0.4 if guided else 0.0
        tilt = np.arcsin(R / ROD * np.sin(phi))
        size = FRICTION * abs(force)
        moments = (size * RADII[0], size * RADII[1] / np.cos(tilt), size * RADII[2])
        expected = balance(phi, force + slide, moments)
        assert at(calc, "torque", phi)[0] == pytest.approx(expected, rel=1e-7, abs=1e-7 * (abs(force) + abs(slide)) * R)


def test_the_relaxing_rods_torque_is_that_of_equilibrium() -> None:
    """Against the friction of the dead centre, whose arm the relaxing phase keeps: out by the square of a few degrees."""
    calc = platen()
    stands = ROD - R + 4.5e-4
    for phi in np.linspace(1e-4, 0.999, 50) * number(calc, "dwell_end_angle"):
        a, b = pins(float(phi), stands)
        rods = (abs(b - a) - ROD) * 5e5 / 4.5e-4
        along = rods * (b - a).real / abs(b - a)
        frictionless = balance(float(phi), along, (0.0, 0.0, 0.0), stands)
        assert at(calc, "torque_useful", phi)[0] == pytest.approx(frictionless, rel=1e-9, abs=1e-6)
        moments = tuple(FRICTION * rods * radius for radius in RADII)
        expected = balance(float(phi), along, moments, stands)  # type: ignore[arg-type]
        assert at(calc, "torque", phi)[0] == pytest.approx(expected, abs=1e-3 * 5e5 * number(calc, "friction_arm"))


def test_friction_circles_give_the_same_torque_but_for_the_square_of_friction() -> None:
    """Exact joints: the rod's line of force touches the friction circles of both pins; the crank's reaction that of the journal."""
    differences = []
    for friction in (0.1, 0.05):
        calc = platen(friction=friction)
        phi = 2 * np.pi - number(calc, "torque_max_angle")
        a, b = pins(phi, None)
        force = float(at(calc, "force", phi)[0])
        sine = friction / np.sqrt(1 + friction**2)
        at_b, at_a, at_o = (radius * sine for radius in RADII)
        rod = turned(phi, None)
        # the line of force touches the circles of both pins on the sides that resist the turning of rod and crank
        line = np.angle(b - a) + np.arcsin((at_b * np.sign(rod) + at_a * np.sign(rod + 1)) / abs(b - a))
        pull = force / np.cos(line)
        torque = pull * (np.imag(np.conj(a) * np.exp(1j * line)) + at_a * np.sign(rod + 1) + at_o)
        differences.append(abs(torque - number(calc, "torque_max")) / number(calc, "torque_max"))
    assert differences[0] < 0.005
    assert differences[1] / differences[0] == pytest.approx(0.25, abs=0.1)
