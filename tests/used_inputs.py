"""A machine with an input for each use that there is, and some that nothing uses: its file names these nowhere else."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

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
    total,
    value,
)


def number(unit: str = "mm", **more: Any) -> Any:
    return Annotated[float, Quantity("q", unit, "Quantity", **more)]


class Part(Block):
    width: number()  # type: ignore[valid-type]
    depth: number()  # type: ignore[valid-type]


class Many(Inputs):
    spread: ClassVar[Mapping[str, tuple[str, ...]]] = {"several": ("first", "second")}

    taken: number()  # type: ignore[valid-type]
    switch: Annotated[float | None, Quantity("s", "mm", "Switch")] = None
    form: Annotated[float | None, Quantity("f", "mm", "Form")] = None
    formed: number(units=(("form", "N"),))  # type: ignore[valid-type]
    limited: number()  # type: ignore[valid-type]
    said: number()  # type: ignore[valid-type]
    drawn: number()  # type: ignore[valid-type]
    level: number()  # type: ignore[valid-type]
    several: number()  # type: ignore[valid-type]
    first: number()  # type: ignore[valid-type]
    second: number()  # type: ignore[valid-type]
    name: Annotated[str, Text("A name for the reader")] = ""
    parts: Annotated[list[Part], Text("Parts")]
    idle: number()  # type: ignore[valid-type]


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


PLOT = Plot(id="p", title="P", caption="P", abscissa="a",
            panels=(Panel(title="P", unit="mm", series=(), levels=(Level(value="level", label="l"),)),))  # fmt: skip
