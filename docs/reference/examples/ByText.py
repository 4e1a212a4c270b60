"""A formula that a text input chooses; all of them take the same quantities."""

from __future__ import annotations

from diecut_report.api import ByText, Chapter, Expression, Inputs, Mechanism, Quantity, Text, m, pi

AREAS: dict[str, Expression] = {"square": m.size**2, "round": pi / 4 * m.size**2}


class Bar(Inputs):
    size = Quantity("s", "mm", "Size of the section", gt=0)
    section = Text("Section of the bar", ("square", "round"))


areas = Chapter("Area")
areas.area = ByText("section", AREAS), "A", "mm**2", "Area of the section"

MECHANISM = Mechanism(kind="bar", version="1.0", title="Bar", summary="Area of a bar.", inputs=Bar, chapters=(areas,))

PRESS = """
mechanisms:
  one: {kind: bar, size: 10 mm, section: square}
  other: {kind: bar, size: 10 mm, section: round}
"""
GIVES = {"one.area": "100 mm**2", "other.area": "78.54 mm**2"}
