"""A formula that a text input chooses; all of them have the same parameters."""

from __future__ import annotations

from typing import Literal

from diecut_report.api import (
    Annotated,
    Binding,
    Bound,
    ByText,
    Chapter,
    Formula,
    Inputs,
    Mechanism,
    Quantity,
    Text,
    formula,
    pi,
)


@formula
def rectangle(width):
    """Area of a square bar."""
    return width**2


@formula
def disc(width):
    """Area of a round bar."""
    return pi / 4 * width**2


AREAS: dict[str, Formula] = {"square": rectangle, "round": disc}
area: Binding = ByText("section", AREAS, width="size")
first: Bound = area.of("square")
assert first.takes == ("size",)


class Bar(Inputs):
    size: Annotated[float, Quantity("s", "mm", "Size of the section", gt=0)]
    section: Annotated[Literal["square", "round"], Text("Section of the bar")]


areas = Chapter("Area")
areas.area = area, "A", "mm**2", "Area of the section"

MECHANISM = Mechanism(kind="bar", version="1.0", title="Bar", summary="Area of a bar.", inputs=Bar, chapters=(areas,))

PRESS = """
mechanisms:
  one: {kind: bar, size: 10 mm, section: square}
  other: {kind: bar, size: 10 mm, section: round}
"""
GIVES = {"one.area": "100 mm**2", "other.area": "78.54 mm**2"}
