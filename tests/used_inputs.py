"""A machine with an input for each use that there is, and some that nothing uses: its file names these nowhere else."""

from __future__ import annotations

from typing import Any

from diecut_report.api import (
    Block,
    Chapter,
    Check,
    Inputs,
    Level,
    Mechanism,
    Panel,
    Plot,
    Quantity,
    Text,
    View,
    circle,
    m,
    parts,
    total,
    value,
)


def number(unit: str = "mm", **more: Any) -> Any:
    return Quantity("q", unit, "Quantity", **more)


class Part(Block):
    width = number()
    depth = number()


class Many(Inputs):
    spread = {"several": ("first", "second")}

    taken = number()
    switch = Quantity("s", "mm", "Switch", optional=True)
    form = Quantity("f", "mm", "Form", optional=True)
    formed = number(units=(("form", "N"),))
    limited = number()
    said = number()
    drawn = number()
    level = number()
    several = number()
    first = number()
    second = number()
    name = Text("A name for the reader", default="")
    parts = parts(Part, "Parts")
    idle = number()


def draw(view: View) -> list[Any]:
    return [circle((0.0, 0.0), view["drawn"], "outline")]


def many(*figures: Any) -> Mechanism:
    chapter = Chapter("Chapter")
    chapter.sum = m.taken + m.formed + m.first + m.second, "S", "mm", "Sum"
    chapter.other = value(2 * m.taken, needs=("switch",)), "O", "mm", "Other"
    chapter.widths = total("sum", of="parts.width"), "W", "mm", "Widths"
    check = Check("c", "strength", "C", "sum", "limited", unit="mm", demand_label="is", limit_label="may be",
                  consequence="make it less than {said}")  # fmt: skip
    return Mechanism(kind="many", version="1", title="Many", summary="Many.", inputs=Many, chapters=(chapter,), checks=(check,),
                     figures=figures)  # fmt: skip


PLOT = Plot("p", "P", "P", abscissa="a",
            panels=(Panel("P", "mm", series=(), levels=(Level("level", "l"),)),))  # fmt: skip
