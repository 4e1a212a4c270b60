"""Formulas as functions: with intermediate terms, with a name in print, of other quantities; numbers as written; constants."""

from __future__ import annotations

from diecut_report.api import (
    GRAVITY,
    Chapter,
    Constant,
    Formula,
    Inputs,
    Mechanism,
    Quantity,
    arccos,
    as_number,
    formula,
    m,
    number,
    pi,
)  # fmt: skip

DENSITY = Constant(7850, "ρ", "kg/m**3")


@formula
def triangle_angle(a, b, c):
    """Angle opposite to ``a`` by the law of cosines; ``arccos`` forgives what rounding carries beyond 1."""
    cosine = (b**2 + c**2 - a**2) / (2 * b * c)
    return arccos(cosine)


@formula(printed_as="A")
def ring(outer, inner):
    """It prints as A(d_1, d_2), with its definition below; π is here a mere number, not an angle."""
    return as_number(pi) / 4 * (outer**2 - inner**2)


class Link(Inputs):
    arm = Quantity("a", "mm", "Arm", gt=0)
    rod = Quantity("b", "mm", "Rod", gt=0)
    base = Quantity("c", "mm", "Base", gt=0)
    outer = Quantity("d_1", "mm", "Outer diameter of the rod", gt=0)
    inner = Quantity("d_2", "mm", "Inner diameter of the rod", ge=0)


angles = Chapter("Angles and weight")
angles.swing = triangle_angle.of(a=m.rod, b=m.arm, c=m.base), "ψ", "deg", "Angle between arm and base"
third = number(1) / 3  # printed as it is written: 1 / 3 is 0.3333…
angles.hub = m.rod * third, "x", "mm", "Distance of the hub"
angles.mass = DENSITY * m.rod * ring(m.outer, m.inner), "m", "kg", "Mass of the rod"
angles.weight = m.mass * GRAVITY, "G", "N", "Weight of the rod"

MECHANISM = Mechanism(
    kind="link", version="1.0", title="Link", summary="A triangle of links.", inputs=Link, chapters=(angles,)
)

assert isinstance(ring, Formula) and ring.parameters == ("outer", "inner")

PRESS = """
mechanisms:
  link: {kind: link, arm: 30 mm, rod: 50 mm, base: 40 mm, outer: 20 mm, inner: 10 mm}
"""
GIVES = {"link.swing": "90 deg", "link.weight": "0.9069 N"}
