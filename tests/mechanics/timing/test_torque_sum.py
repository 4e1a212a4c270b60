"""The sum at the main shaft, against the printed numbers and dense samples."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from diecut_report.formulas import Array
from diecut_report.mechanics.timing.intervals import DrivenLine
from tests.mechanics.timing import torque_sum
from tests.mechanics.timing.example_press import COMMON, CRANK, PERIOD, SHAFT, SPEED, TURN, line_curve, of
from tests.mechanics.timing.torque_sum import Consumer, LineCurve


def cylinder() -> Consumer:
    return Consumer("drive", line_curve("drive", "crank_torque", CRANK), 0.97)


def cam() -> Consumer:
    return Consumer("cam", line_curve("feeder", "drive_torque", SHAFT, 141.0056), 0.95)


def geneva() -> Consumer:
    return Consumer("geneva", line_curve("cross", "torque", SHAFT, 38.1164), 0.95)


def friction() -> Consumer:
    return torque_sum.friction("friction", 5.0, DrivenLine(SHAFT))


ROWS = [
    ([cylinder], 68.1960, 117.6007, 254.6962, -158.7909, 289.7135, 2.6672),
    ([cylinder, cam], 70.9560, 149.9328, 363.1615, -332.8959, 277.0757, 3.8030),
    ([cylinder, cam, friction], 75.9560, 152.3628, 368.1615, -327.8959, 277.0757, 3.8554),
    ([cylinder, geneva], 71.3934, 155.6199, 379.1602, -355.4616, 277.8589, 3.9706),
]


@pytest.mark.parametrize("makers, mean, rms, largest, least, energy, power", ROWS)
def test_the_sums_of_the_example_press_are_the_printed_ones(
    makers: list[Any], mean: float, rms: float, largest: float, least: float, energy: float, power: float
) -> None:
    found = torque_sum.torque_sum([make() for make in makers], COMMON).figures
    expected = (mean, rms, largest, least, energy)
    assert (found.mean, found.rms, found.largest, found.least, found.energy_fluctuation) == pytest.approx(
        expected, abs=1e-4
    )
    assert found.peak * SPEED / 1e3 == pytest.approx(power, abs=1e-4)


@pytest.mark.parametrize("makers", [row[0] for row in ROWS])
def test_the_sums_are_those_of_dense_samples(makers: list[Any]) -> None:
    consumers = [make() for make in makers]
    found = torque_sum.torque_sum(consumers, COMMON)
    count = 20_000
    angle = (np.arange(count) + 0.5) * PERIOD / count  # in the middle of short pieces: none at an edge
    samples = sum(each.at_main_shaft(angle, angle) for each in consumers)
    assert isinstance(samples, np.ndarray)
    assert found.total.at(angle) == pytest.approx(samples, abs=1e-6)
    figures = found.figures
    assert figures.mean == pytest.approx(samples.mean(), abs=0.01)
    assert figures.rms == pytest.approx(np.sqrt((samples**2).mean()), rel=1e-4)
    assert figures.largest == pytest.approx(samples.max(), rel=1e-4)
    assert figures.least == pytest.approx(samples.min(), rel=1e-4)
    assert figures.largest >= samples.max() - 1e-9
    assert figures.least <= samples.min() + 1e-9
    excess = cumulative_trapezoid(samples - samples.mean(), angle, initial=0)
    assert figures.energy_fluctuation == pytest.approx(np.ptp(excess), abs=0.1)
    run = torque_sum.excess_energy(found.total)(angle)
    assert run - run[0] == pytest.approx(excess, abs=0.1)
    assert (
        found.total.at(np.array([figures.largest_at, figures.least_at]))
        == pytest.approx([figures.largest, figures.least], abs=1e-3)
        or figures.largest_at in found.total.edges
    )


def kinetic_energies(transport: str) -> list[LineCurve]:
    """Kinetic energies of the cylinder and of a transport, from their speeds."""
    motion, shape = line_curve("drive", "cylinder_speed", CRANK), line_curve("drive", "cylinder_rotation", CRANK)
    rolling = (
        of("drive", "inputs.cylinder_inertia")
        + of("drive", "inputs.cylinder_mass") * of("drive", "inputs.cylinder_radius") ** 2
    )
    swinging = 2 * of("drive", "inputs.cylinder_radius") * of("drive", "inputs.static_unbalance")

    def cylinder_energy(share: Array, middle: Array) -> Array:
        inertia = rolling + swinging * np.cos(shape.curve(share, middle))
        return inertia * motion.curve(share, middle) ** 2 / 2

    mechanism, offset = ("feeder", 141.0056) if transport == "cam" else ("cross", 38.1164)
    speed = line_curve(mechanism, "sheet_velocity" if transport == "cam" else "wheel_speed", SHAFT, offset)
    inertia = of("feeder", "inputs.conveyor_mass") if transport == "cam" else of("cross", "inputs.driven_inertia")
    carried = LineCurve(lambda s, m: inertia * speed.curve(s, m) ** 2 / 2, speed.breakpoints, speed.line)
    return [LineCurve(cylinder_energy, motion.breakpoints, motion.line), carried]


@pytest.mark.parametrize("transport, own, expected", [("cam", 169, 191.087), ("geneva", 196, 218.014)])
def test_what_the_mechanisms_lend_one_another_is_the_printed_energy(
    transport: str, own: float, expected: float
) -> None:
    energies = kinetic_energies(transport)
    found = torque_sum.energy_exchange(energies, COMMON)
    assert torque_sum.spread(found.parts[1]) == pytest.approx(own, abs=0.5)
    assert found.exchange == pytest.approx(expected, abs=2e-3)
    angle = (np.arange(20_000) + 0.5) * PERIOD / 20_000
    samples = [each.at(angle, angle) for each in energies]
    assert found.exchange == pytest.approx(sum(map(np.ptp, samples)) - np.ptp(sum(samples)), abs=1e-3)


def square(share: Array, middle: Array) -> Array:
    """A torque that jumps from 3 to −1 in the middle of its turn."""
    return np.where(middle < 0.5, 3.0, -1.0)


def test_jumps_losses_and_turns_of_a_line_are_counted_in_closed_form() -> None:
    line = DrivenLine(Fraction(3, 2), 1.0)
    found = torque_sum.torque_sum([Consumer("square", LineCurve(square, np.array([0.5]), line), 0.8)], Fraction(2))
    high, low = 1.5 * 3 / 0.8, -1.5 * 0.8
    figures = found.figures
    assert (figures.mean, figures.largest, figures.least) == pytest.approx(((high + low) / 2, high, low))
    assert figures.rms == pytest.approx(np.sqrt((high**2 + low**2) / 2))
    assert figures.energy_fluctuation == pytest.approx((high - low) / 2 * TURN / 1.5 / 2)
    assert figures.peak == pytest.approx(high)


def test_a_kink_where_a_torque_changes_its_sign_is_found() -> None:
    def wave(share: Array, _: Array) -> Array:
        return np.sin(TURN * share + 0.3)

    found = torque_sum.torque_sum(
        [Consumer("wave", LineCurve(wave, np.empty(0), DrivenLine(SHAFT)), 0.5)], Fraction(1)
    ).figures
    assert found.mean == pytest.approx((2 - 0.5) / np.pi, rel=1e-9)
    assert found.rms == pytest.approx(np.sqrt((4 + 0.25) / 4), rel=1e-9)
    assert (found.largest, found.least) == pytest.approx((2, -0.5), rel=1e-12)


def test_a_shaft_behind_gears_takes_the_losses_by_the_sign_of_the_sum() -> None:
    total = torque_sum.torque_sum([cylinder(), cam()], COMMON).total
    found = torque_sum.carried_back(total, 4.9, 0.97)
    angle = np.linspace(0.001, PERIOD - 0.001, 20_001)
    samples = total.at(angle)
    assert found.at(angle) == pytest.approx(np.where(samples > 0, samples / 0.97, samples * 0.97) / 4.9, abs=1e-6)
    assert found.mean == pytest.approx(15.2893, abs=1e-4)
    assert torque_sum.energy_fluctuation(found) * 4.9 == pytest.approx(279.63, abs=0.01)


def test_a_constant_torque_has_no_fluctuation() -> None:
    found = torque_sum.torque_sum([friction()], Fraction(1)).figures
    assert (found.mean, found.rms, found.largest, found.least) == pytest.approx((5, 5, 5, 5))
    assert found.energy_fluctuation == pytest.approx(0, abs=1e-12)
