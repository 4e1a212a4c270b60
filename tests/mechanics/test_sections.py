"""Cross-sections against integrals over their areas, and torsion against Prandtl's stress function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, fields
from typing import Any

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, m
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.mechanics import sections
from diecut_report.mechanics.sections import CrossSection

B, H, T = 0.05, 0.03, 0.004
D, BORE = 0.06, 0.02


def over_rectangle(width: float, height: float, function: Callable[[float, float], float]) -> float:
    return float(dblquad(lambda z, y: function(y, z), -width / 2, width / 2, -height / 2, height / 2)[0])


def over_circle(diameter: float, function: Callable[[float, float], float]) -> float:
    def in_polar(angle: float, radius: float) -> float:
        return radius * function(radius * np.cos(angle), radius * np.sin(angle))

    return float(dblquad(in_polar, 0, diameter / 2, 0, 2 * np.pi)[0])


def over(name: str, function: Callable[[float, float], float]) -> float:
    match name:
        case "round_bar":
            return over_circle(D, function)
        case "tube":
            return over_circle(D, function) - over_circle(BORE, function)
        case "rectangle":
            return over_rectangle(B, H, function)
    return over_rectangle(B, H, function) - over_rectangle(B - 2 * T, H - 2 * T, function)


SIZES = {"round_bar": (D,), "tube": (D, BORE), "rectangle": (B, H), "box": (B, H, T)}


@pytest.mark.parametrize("name", SIZES)
def test_areas_and_second_moments_are_integrals(name: str) -> None:
    section: CrossSection = getattr(sections, name)(*SIZES[name])
    width, height = (B, H) if name in ("rectangle", "box") else (D, D)
    area, about_y, about_z = (over(name, of) for of in (lambda y, z: 1.0, lambda y, z: z**2, lambda y, z: y**2))
    assert section.area == pytest.approx(area, rel=1e-9)
    assert (section.second_moment, section.second_moment_z) == (
        pytest.approx(about_y, rel=1e-9),
        pytest.approx(about_z, rel=1e-9),
    )
    assert section.second_moment_min == pytest.approx(min(about_y, about_z), rel=1e-9)
    assert section.modulus == pytest.approx(about_y / (height / 2), rel=1e-9)
    assert section.modulus_z == pytest.approx(about_z / (width / 2), rel=1e-9)
    assert section.gyration_radius == pytest.approx(np.sqrt(min(about_y, about_z) / area), rel=1e-9)


@pytest.mark.parametrize("name", ["round_bar", "tube"])
def test_a_circle_is_twisted_by_its_polar_second_moment(name: str) -> None:
    section: CrossSection = getattr(sections, name)(*SIZES[name])
    polar = over(name, lambda y, z: y**2 + z**2)
    assert section.torsion_moment == pytest.approx(polar, rel=1e-9)
    assert section.torsion_modulus == pytest.approx(polar / (D / 2), rel=1e-9)


@pytest.mark.parametrize("ratio", [1.0, 1.2, 1.5, 2.0, 4.0, 10.0])
@pytest.mark.parametrize("turned", [False, True])
def test_a_rectangle_is_twisted_as_the_exact_series_says(ratio: float, turned: bool) -> None:
    """Saint-Venant's series for sides 1 and ``ratio``; Roark's formulas are within 0.5 % of it."""
    n = np.arange(1, 39, 2)
    half = n * np.pi * ratio / 2
    moment = ratio * (1 / 3 - 64 / (np.pi**5 * ratio) * np.sum(np.tanh(half) / n**5))
    steepest = 1 - 8 / np.pi**2 * np.sum(1 / n**2 / np.cosh(half))
    section = sections.rectangle(1.0, ratio) if turned else sections.rectangle(ratio, 1.0)
    assert section.torsion_moment == pytest.approx(moment, rel=5e-3)
    assert section.torsion_modulus == pytest.approx(moment / steepest, rel=5e-3)


def test_a_box_carries_its_torque_by_an_even_flow_of_shear() -> None:
    """About any pole the flow q along the middle of the wall has the moment q·∮h ds; its strain energy gives the twist."""
    width, height = B - T, H - T
    flow = 1 / (2 * quad(lambda y: height / 2, 0, width)[0] + 2 * quad(lambda z: width / 2, 0, height)[0])
    section = sections.box(B, H, T)
    assert section.torsion_modulus == pytest.approx(T / flow, rel=1e-12)
    assert section.torsion_moment == pytest.approx(T / (flow**2 * 2 * (width + height)), rel=1e-12)


def test_the_limits_of_a_shape_are_other_shapes() -> None:
    pairs = (
        (sections.tube(D, 0.0), sections.round_bar(D)),
        (sections.box(B, H, H / 2), sections.rectangle(B, H)),
    )
    for limit, full in pairs:
        for name, found in asdict(limit).items():
            if "torsion" not in name or full is pairs[0][1]:  # a thin wall is none
                assert found == pytest.approx(getattr(full, name), rel=1e-12)


@pytest.mark.parametrize("name", SIZES)
def test_many_sections_are_each_alone(name: str) -> None:
    many: CrossSection = getattr(sections, name)(*(size * np.array([1.0, 2.0]) for size in SIZES[name]))
    for row, factor in enumerate((1.0, 2.0)):
        alone: CrossSection = getattr(sections, name)(*(size * factor for size in SIZES[name]))
        assert [getattr(many, each.name)[row] for each in fields(many)] == pytest.approx(
            list(asdict(alone).values()), rel=1e-15
        )


class Bar(Inputs):
    width = Quantity("b", "mm", "Width", gt=0)
    height = Quantity("h", "mm", "Height", gt=0)
    wall = Quantity("t", "mm", "Wall", gt=0)


UNITS = {"area": "mm**2", "modulus": "mm**3", "modulus_z": "mm**3", "torsion_modulus": "mm**3"}


@pytest.mark.parametrize("name", SIZES)
def test_their_dimensions_balance(name: str) -> None:
    sizes: tuple[Any, ...] = (m.width, m.height, m.wall)[: len(SIZES[name])]
    section: CrossSection = getattr(sections, name)(*sizes)
    chapter = Chapter("Section")
    for number, each in enumerate(fields(section)):
        chapter[each.name] = getattr(section, each.name), f"A_{number}", UNITS.get(each.name, "mm**4"), each.name
    chapter.radius = section.gyration_radius, "i", "mm", "Radius of gyration"
    chapter.sum = m.width + m.height + m.wall, "s", "mm", "Sum"
    check_mechanism(Mechanism(kind="bar", version="1", title="Bar", summary="", inputs=Bar, chapters=(chapter,)))
