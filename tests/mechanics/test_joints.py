"""Strength of joints and struts against integrals of their loads, and buckling against a strut that is cut into pieces."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import eigh_tridiagonal

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, m
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.mechanics import joints, sections

STEEL, YIELD = 210e9, 235e6


def test_the_pressure_of_a_pin_adds_up_to_its_force() -> None:
    """The mean pressure over half the circumference, across the force."""
    pressure, diameter, length = joints.pin_pressure(-12e3, 0.02, 0.03), 0.02, 0.03
    across = quad(lambda angle: pressure * np.cos(angle) * diameter / 2 * length, -np.pi / 2, np.pi / 2)[0]
    assert across == pytest.approx(12e3, rel=1e-12)


@pytest.mark.parametrize("planes", [1, 2])
def test_the_shear_of_a_pin_adds_up_to_its_force(planes: int) -> None:
    """Jourawski's distribution over the circle, of which the mean is given, has its greatest value in the middle: 4/3 of it."""
    mean, radius = joints.pin_shear(9e3, 0.016, planes), 0.008

    def slice_force(height: float) -> float:
        return float(4 / 3 * mean * (1 - (height / radius) ** 2) * 2 * np.sqrt(radius**2 - height**2))

    assert planes * quad(slice_force, -radius, radius)[0] == pytest.approx(9e3, rel=1e-9)


def test_the_moment_of_a_pin_is_that_of_its_loads() -> None:
    force, eye, cheek = 5e3, 0.03, 0.014
    outer = quad(lambda x: force / (2 * cheek) * x, eye / 2, eye / 2 + cheek)[0]
    inner = quad(lambda x: force / eye * x, 0, eye / 2)[0]
    assert joints.pin_moment(force, eye, cheek) == pytest.approx(outer - inner, rel=1e-12)


def test_the_edge_of_a_bar_bears_tension_and_bending() -> None:
    """The linear stress over a rectangle has the force and the moment."""
    width, height, force, moment = 0.02, 0.05, -8e3, 120.0
    section = sections.rectangle(width, height)
    edge = joints.edge_stress(force, section.area, moment, section.modulus)
    middle = abs(force) / (width * height)

    def stress(z: float) -> float:
        return float(middle + (edge - middle) * z / (height / 2))

    assert quad(lambda z: width * stress(z), -height / 2, height / 2)[0] == pytest.approx(abs(force))
    assert quad(lambda z: width * stress(z) * z, -height / 2, height / 2)[0] == pytest.approx(moment)


def test_the_equivalent_stress_has_the_energy_of_distortion() -> None:
    tensor = np.array([[100e6, 40e6, 0], [40e6, 0, 0], [0, 0, 0]])
    deviator = tensor - np.trace(tensor) / 3 * np.eye(3)
    assert joints.equivalent_stress(100e6, 40e6) == pytest.approx(np.sqrt(1.5 * np.sum(deviator**2)))


def test_a_slender_strut_buckles_as_one_that_is_cut_into_pieces() -> None:
    """The least force with −E·I·y″ = F·y between hinges, by differences."""
    length, pieces = 1.5, 2000
    section = sections.tube(0.03, 0.02)
    step = length / pieces
    least = eigh_tridiagonal(np.full(pieces - 1, 2.0), np.full(pieces - 2, -1.0), select="i", select_range=(0, 0))[0][0]
    force = STEEL * float(section.second_moment_min) * least / step**2
    stress = joints.buckling_stress(length / section.gyration_radius, STEEL, YIELD)
    assert stress * section.area == pytest.approx(force, rel=1e-6)


def test_the_parabola_begins_at_the_yield_strength_and_touches_the_hyperbola() -> None:
    limit = float(joints.limiting_slenderness(STEEL, YIELD))
    below, at, above = (
        float(joints.buckling_stress(limit * share, STEEL, YIELD)) for share in (1 - 1e-5, 1.0, 1 + 1e-5)
    )
    assert limit == pytest.approx(132.8, abs=0.05)
    assert at == pytest.approx(YIELD / 2, rel=1e-12)
    assert at - below == pytest.approx(above - at, rel=1e-4)
    assert joints.buckling_stress(1e-9, STEEL, YIELD) == YIELD


def test_many_are_each_alone() -> None:
    slenderness = np.array([20.0, 100.0, 132.7, 132.9, 300.0])
    together = joints.buckling_stress(slenderness, STEEL, YIELD)
    assert list(together) == [joints.buckling_stress(each, STEEL, YIELD) for each in slenderness]


class Rod(Inputs):
    force = Quantity("F", "kN", "Force")
    moment = Quantity("M", "N*m", "Moment")
    diameter = Quantity("d", "mm", "Diameter", gt=0)
    eye = Quantity("b", "mm", "Width of the eye", gt=0)
    cheek = Quantity("c", "mm", "Width of a cheek", gt=0)
    length = Quantity("l", "mm", "Length", gt=0)
    modulus = Quantity("E", "GPa", "Modulus", gt=0)
    strength = Quantity("R_e", "MPa", "Yield strength", gt=0)


def test_their_dimensions_balance() -> None:
    section, chapter = sections.round_bar(m.diameter), Chapter("Rod")
    made: dict[str, tuple[Any, str]] = {
        "pressure": (joints.pin_pressure(m.force, m.diameter, m.eye), "MPa"),
        "shear": (joints.pin_shear(m.force, m.diameter, 2), "MPa"),
        "bending": (joints.pin_moment(m.force, m.eye, m.cheek), "N*m"),
        "edge": (joints.edge_stress(m.force, section.area, m.bending + m.moment, section.modulus), "MPa"),
        "together": (joints.equivalent_stress(m.edge, m.shear), "MPa"),
        "slenderness": (m.length / section.gyration_radius, "1"),
        "limiting": (joints.limiting_slenderness(m.modulus, m.strength), "1"),
        "buckling": (joints.buckling_stress(m.slenderness, m.modulus, m.strength), "MPa"),
    }
    for number, (name, (gives, unit)) in enumerate(made.items()):
        chapter[name] = gives, f"q_{number}", unit, name
    check_mechanism(Mechanism(kind="rod", version="1", title="Rod", summary="", inputs=Rod, chapters=(chapter,)))
