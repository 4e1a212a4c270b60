"""A diagram of lines that the results do not hold: the machine is calculated again with other inputs, no formula stands twice."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Chapter,
    Chart,
    Inputs,
    Mechanism,
    Quantity,
    Shape,
    View,
    chart_panel,
    fill,
    level,
    line,
    m,
    mark,
    vertical,
)  # fmt: skip


class Wedge(Inputs):
    force = Quantity("F", "N", "Force on the wedge", gt=0)
    wedge_angle = Quantity("α", "deg", "Angle of the wedge", gt=0, lt=90)


spread = Chapter("Spreading")
spread.normal = m.force / (2 * np.tan(m.wedge_angle / 2)), "N", "N", "Spreading force"


def panels(view: View) -> list[Shape]:
    """Spreading force over the angle of the wedge, all in SI."""
    angles = np.radians(np.linspace(10, 60, 51))
    forces = view.varied({"wedge_angle": angles}, "normal")["normal"]
    here = view["wedge_angle"]
    return [
        chart_panel(
            "spreading force", "N", "angle of the wedge", "α", "deg",
            lines=[line(angles, forces, "N")],
            fills=[fill(angles, forces, "")],
            marks=[mark(here, view["normal"], "here")],
            levels=[level(view["force"], "F")],
            verticals=[vertical(here, "chosen")],
            range=(0, None),
        )
    ]  # fmt: skip


MECHANISM = Mechanism(
    kind="wedge", version="1.0", title="Wedge", summary="A wedge spreads.", inputs=Wedge, chapters=(spread,),
    figures=(Chart("over_angle", "Spreading force", "It falls with the angle.", build=panels),),
)  # fmt: skip

PRESS = """
mechanisms:
  wedge: {kind: wedge, force: 100 N, wedge_angle: 53.13010235 deg}
"""
GIVES = {"wedge.normal": "100 N"}
