"""A made-up shaft whose numbers come from tables: a bearing's row, a factor between rows, a stiffness along a turn."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from diecut_report.api import (
    POINTS,
    Block,
    Chapter,
    Inputs,
    Mechanism,
    OneOf,
    Panel,
    Plot,
    Quantity,
    Series,
    Text,
    own_table,
)

BEARINGS = own_table(
    title="Bearings",
    columns={"bore": "mm", "C": "kN"},
    rows={"6204": (20, 13.5), "6205": (25, 14.8)},
    sources=("List one", "List two"),
)
FACTORS = own_table(
    title="Factors of teeth",
    columns={"teeth": "1", "Y": "1"},
    rows=((12, 0.245), (15, 0.29), (20, 0.32), (30, 0.36)),
    sources=("Book one", "Book two"),
)
LIFTS = own_table(
    title="Lifts of a cam",
    columns={"turn": "deg", "lift": "mm"},
    rows=((0, 0), (90, 10), (200, 4), (360, 0)),
    sources=("Drawing",),
    only_source="measured there",
)


class Wheel(Block):
    count: Annotated[float, Quantity("z_i", "1", "Teeth of a wheel", gt=0)]
    grade: Annotated[Literal["soft", "hard"], Text("Grade of a wheel")] = "soft"
    strength: Annotated[float | None, Quantity("σ_i", "MPa", "Strength of a wheel")] = None


class Geared(Inputs):
    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("bearing",), ("bore_given",)),)

    bearing: Annotated[Literal["6204", "6205"] | None, Text("Bearing")] = None
    bore_given: Annotated[float | None, Quantity("d_g", "mm", "Bore", gt=0)] = None
    teeth: Annotated[float, Quantity("z", "1", "Teeth", gt=0)] = 17
    reach: Annotated[float, Quantity("r", "1", "Reach of the swing", gt=0)] = 4
    wheels: Annotated[list[Wheel], Text("Wheels")] = []  # noqa: RUF012
    n_points: Annotated[int, POINTS] = 36


shaft = Chapter("Shaft")
shaft.lookup("bore", "d", "mm", "Bore of the bearing", BEARINGS, by="bearing", column="bore", given="bore_given")
shaft.lookup("rating", "C", "N", "Rating of the bearing", BEARINGS, by="bearing", column="C", needs=("bearing",))
shaft.interpolated("factor", "Y", "1", "Factor of the teeth", FACTORS, of="teeth")
wheels = Chapter("Wheels", needs=("wheels",), absent="no wheels")
wheels.interpolated("wheel_factor", "Y_i", "1", "Factor of a wheel", FACTORS, of="wheels.count")
wheels.lookup(
    "wheel_strength",
    "[σ]",
    "MPa",
    "Strength taken",
    {"soft": 100.0, "hard": 300.0},
    by="wheels.grade",
    given="wheels.strength",
)
turning = Chapter("Turning")
turning.abscissa("turn", "φ", "deg", "Turn", period=2 * np.pi)
turning.interpolated("lift", "h", "mm", "Lift", LIFTS, of="turn")
turning.reduction("lift_mean", "h_m", "mm", "Mean lift", "mean", of="lift")
turning.reduction("lift_max", "h_max", "mm", "Greatest lift", "max", of="lift")
turning.value("swung", "z_s", "1", "Teeth at a place", lambda turn, reach: 17 + reach * np.sin(turn))
turning.interpolated("swung_factor", "Y_s", "1", "Factor at a place", FACTORS, of="swung", key="reach")
turning.reduction("swung_mean", "Y_m", "1", "Mean factor", "mean", of="swung_factor")
turning.reduction("swung_max", "Y_max", "1", "Greatest factor", "max", of="swung_factor")

MECHANISM = Mechanism(
    kind="geared",
    version="1",
    title="Geared shaft",
    summary="A shaft whose numbers come from tables.",
    inputs=Geared,
    chapters=(shaft, wheels, turning),
    figures=(
        Plot(id="lifts", title="Lift", caption="The lift.", abscissa="turn",
             panels=(Panel(title="Lift", unit="mm", series=(Series(curve="lift", label="h"),)),)),
    ),
)  # fmt: skip
