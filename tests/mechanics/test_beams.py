"""Beams on two supports: textbook cases, and finite elements of this test's own, which know nothing of moments."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from diecut_report.mechanics import beams
from diecut_report.mechanics.beams import Loading, Supports

E = 206e9
INERTIA = np.pi * 0.04**4 / 64


def column(*values: float) -> Any:
    """Places of one beam, or its loads in one case."""
    return np.array(values, dtype=float)[:, None]


def bent(x: Any, inertia: Any, loads: list[tuple[float, float, float]], first: float, second: float) -> Any:
    """A beam bent by (place, force, couple)."""
    supports = Supports(np.array([first]), np.array([second]))
    places, forces, couples = (column(*each) for each in zip(*loads, strict=True))
    loading = Loading(places, forces[:, :, None], couples[:, :, None]).held(supports)
    stiffness = E * np.broadcast_to(np.asarray(inertia, dtype=float), (len(x) - 1,))[:, None]
    return beams.bent(column(*x), stiffness, loading, supports), loading, stiffness


def elements(x: Any, inertia: Any, loads: list[tuple[float, float, float]], first: float, second: float) -> Any:
    """Deflections and slopes by Hermite beam elements between places x, the supports among them."""
    count = len(x)
    matrix, load = np.zeros((2 * count, 2 * count)), np.zeros(2 * count)
    for i, length in enumerate(np.diff(x)):
        k = E * np.broadcast_to(inertia, count - 1)[i] / length**3
        own = k * np.array([
            [12, 6 * length, -12, 6 * length],
            [6 * length, 4 * length**2, -6 * length, 2 * length**2],
            [-12, -6 * length, 12, -6 * length],
            [6 * length, 2 * length**2, -6 * length, 4 * length**2],
        ])  # fmt: skip
        matrix[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += own
    for place, force, couple in loads:
        node = int(np.argmin(np.abs(np.asarray(x) - place)))
        load[2 * node : 2 * node + 2] += force, couple
    held = [2 * int(np.argmin(np.abs(np.asarray(x) - place))) for place in (first, second)]
    free = [i for i in range(2 * count) if i not in held]
    found = np.zeros(2 * count)
    found[free] = np.linalg.solve(matrix[np.ix_(free, free)], load[free])
    return found[::2], found[1::2]


@pytest.mark.parametrize(
    ("x", "load", "supports", "place", "deflection"),
    [
        ((0, 0.2, 0.4), (0.2, 1000, 0), (0, 0.4), 1, 1000 * 0.4**3 / (48 * E * INERTIA)),
        ((0, 0.4, 0.5), (0.5, 1000, 0), (0, 0.4), 2, 1000 * 0.1**2 * 0.5 / (3 * E * INERTIA)),
    ],
)
def test_deflections_are_those_of_textbooks(x: Any, load: Any, supports: Any, place: int, deflection: float) -> None:
    line, *_ = bent(x, INERTIA, [load], *supports)
    assert line.deflection[place, 0, 0] == pytest.approx(deflection, rel=1e-12)


def test_a_couple_at_a_support_turns_both_ends() -> None:
    line, *_ = bent((0, 0.4), INERTIA, [(0, 0, 100)], 0, 0.4)
    turned = 100 * 0.4 / (E * INERTIA)
    assert_allclose(line.slope[:, 0, 0], [turned / 3, -turned / 6], rtol=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_stepped_beams_bend_as_finite_elements_do(seed: int) -> None:
    draw = np.random.default_rng(seed)
    x = np.sort(draw.uniform(0, 0.5, 9))
    inertia = INERTIA * draw.uniform(0.3, 4, 8)
    first, second = x[1], x[int(draw.integers(4, 8))]
    loads = [
        (float(place), draw.uniform(-5e3, 5e3), draw.uniform(-300, 300)) for place in draw.choice(x, 4, replace=False)
    ]
    line, loading, stiffness = bent(x, inertia, loads, first, second)
    deflection, slope = elements(x, inertia, loads, first, second)
    assert_allclose(line.deflection[:, 0, 0], deflection, rtol=1e-8, atol=1e-13)
    assert_allclose(line.slope[:, 0, 0], slope, rtol=1e-8, atol=1e-11)
    energy = beams.bending_energy(column(*x), stiffness, loading)
    assert_allclose(energy, beams.work(line, loading), rtol=1e-9)
    bound = beams.energy_rounding(column(*x), stiffness, loading, Supports(np.array([first]), np.array([second])))
    assert (abs(energy - beams.work(line, loading)) <= bound).all() and (bound < 1e-8 * energy).all()


@pytest.mark.parametrize("seed", range(20))
def test_loads_on_the_supports_store_no_energy_but_for_rounding(seed: int) -> None:
    """The forces pass into the supports; which of both sums is greater, rounding decides."""
    draw = np.random.default_rng(seed)
    x = np.sort(draw.uniform(0, 0.5, 7))
    first, second = x[1], x[5]
    loads = [(float(x[1]), draw.uniform(-5e4, 5e4), 0.0), (float(x[5]), draw.uniform(-5e4, 5e4), 0.0)]
    line, loading, stiffness = bent(x, INERTIA, loads, first, second)
    difference = beams.bending_energy(column(*x), stiffness, loading) - beams.work(line, loading)
    bound = beams.energy_rounding(column(*x), stiffness, loading, Supports(np.array([first]), np.array([second])))
    assert (abs(difference) <= bound).all()


def test_the_stepped_shaft_of_the_method_bends_by_virtual_work_as_by_integration() -> None:
    x = (0.0, 0.03, 0.06, 0.15, 0.28, 0.32, 0.36, 0.4, 0.44)
    diameters, bores = (45, 45, 55, 55, 60, 60, 50, 50), (0, 0, 0, 0, 20, 20, 0, 0)
    inertia = [np.pi * ((d / 1e3) ** 4 - (b / 1e3) ** 4) / 64 for d, b in zip(diameters, bores, strict=True)]
    line, *_ = bent(x, inertia, [(0.15, 4117, 0), (0.4, -9994, 0)], 0.03, 0.32)
    assert abs(line.deflection[7, 0, 0]) == pytest.approx(9.185418e-5, rel=1e-6)


def test_moments_have_both_limits_where_a_couple_acts() -> None:
    _, loading, _ = bent((0, 0.2, 0.4), INERTIA, [(0.2, 0, 100)], 0, 0.4)
    before, behind = loading.moments(column(0, 0.2, 0.4))
    assert_allclose(before[:, 0, 0], [0, 50, 0], atol=1e-12)
    assert_allclose(behind[:, 0, 0], [0, -50, 0], atol=1e-12)


def critical(pieces: int, lumps: int, masses: tuple[tuple[float, float], ...] = (), weight: float = 7850.0) -> Any:
    """The critical speed of the uniform shaft of 40 mm on 400 mm."""
    x = np.linspace(0, 0.4, pieces + 1)[:, None]
    own = np.full((pieces, 1), weight * np.pi * 0.04**2 / 4 * 0.4 / pieces)
    places, mass = (column(*each) for each in zip(*masses, strict=True)) if masses else (np.zeros((0, 1)),) * 2
    supports = Supports(np.array([0.0]), np.array([0.4]))
    return beams.critical(x, np.full((pieces, 1), E * INERTIA), own, supports, places, mass, lumps)


def test_a_uniform_shaft_has_the_critical_speed_of_its_closed_form() -> None:
    exact = (np.pi / 0.4) ** 2 * np.sqrt(E * INERTIA / (7850 * np.pi * 0.04**2 / 4))
    found = critical(10, 8)
    assert exact == pytest.approx(3159.938, rel=1e-6)
    assert found.speed[0] == pytest.approx(exact, rel=1e-6)
    coarse = critical(1, 20)
    assert [coarse.dunkerley[0], coarse.rayleigh[0]] == pytest.approx([3037.4, 3162.2], rel=2e-5)
    assert found.dunkerley[0] <= found.speed[0] <= found.rayleigh[0]


def test_one_mass_has_the_critical_speed_of_its_spring() -> None:
    found = critical(2, 8, ((0.2, 5.0),), weight=1e-6)
    assert found.speed[0] == pytest.approx(np.sqrt(48 * E * INERTIA / 0.4**3 / 5.0), rel=1e-6)


def test_pieces_without_length_change_no_critical_speed() -> None:
    supports = Supports(np.array([0.1]), np.array([0.4]))
    stiffness = np.array([1.0, 9.0, 2.0])[:, None] * E * INERTIA
    once = beams.critical(column(0, 0.1, 0.3, 0.5), stiffness, np.ones((3, 1)), supports, column(0.3), column(2))
    twice = beams.critical(
        column(0, 0.1, 0.1, 0.3, 0.3, 0.5), stiffness[[0, 0, 1, 1, 2]], np.array([1, 0, 1, 0, 1.0])[:, None], supports,
        column(0.3), column(2),
    )  # fmt: skip
    assert twice.speed == pytest.approx(once.speed, rel=1e-12)


def test_the_nearest_point_is_the_one_that_a_search_of_all_finds() -> None:
    """Also where points coincide, and where a place is as far from two of them."""
    rng = np.random.default_rng(1)
    for _ in range(300):
        points, variants, count = rng.integers(1, 30), rng.integers(1, 4), rng.integers(1, 20)
        x = np.sort(np.round(rng.random((points, variants)), 2), axis=0)
        places = np.round(rng.random((count, variants)), int(rng.integers(1, 4)))
        least = np.abs(x[None] - places[:, None]).min(axis=1)
        found = np.take_along_axis(x, beams.nearest(x, places), axis=0)
        assert np.allclose(np.abs(found - places), least, atol=1e-15)
