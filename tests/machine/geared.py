"""A made-up shaft whose numbers come from tables: a bearing's row, a factor between rows, a stiffness along a turn."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
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
    abscissa,
    interpolated,
    lookup,
    m,
    own_table,
    parts,
    reduction,
    samples,
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
    count = Quantity("z_i", "1", "Teeth of a wheel", gt=0)
    grade = Text("Grade of a wheel", ("soft", "hard"), default="soft")
    strength = Quantity("σ_i", "MPa", "Strength of a wheel", optional=True)


class Geared(Inputs):
    one_of = (OneOf(("bearing",), ("bore_given",)),)

    bearing = Text("Bearing", ("6204", "6205"), optional=True)
    bore_given = Quantity("d_g", "mm", "Bore", gt=0, optional=True)
    teeth = Quantity("z", "1", "Teeth", gt=0, default=17)
    reach = Quantity("r", "1", "Reach of the swing", gt=0, default=4)
    wheels = parts(Wheel, "Wheels", optional=True)
    n_points = samples(36)


shaft = Chapter("Shaft")
shaft.bore = lookup(BEARINGS, by="bearing", column="bore", given="bore_given"), "d", "mm", "Bore of the bearing"
shaft.rating = lookup(BEARINGS, by="bearing", column="C", needs=("bearing",)), "C", "N", "Rating of the bearing"
shaft.factor = interpolated(FACTORS, of="teeth"), "Y", "1", "Factor of the teeth"
wheels = Chapter("Wheels", needs=("wheels",), absent="no wheels")
wheels.wheel_factor = interpolated(FACTORS, of="wheels.count"), "Y_i", "1", "Factor of a wheel"
wheels.wheel_strength = (
    lookup({"soft": 100.0, "hard": 300.0}, by="wheels.grade", given="wheels.strength"),
    "[σ]",
    "MPa",
    "Strength taken",
)
turning = Chapter("Turning")
turning.turn = abscissa(period=2 * np.pi), "φ", "deg", "Turn"
turning.lift = interpolated(LIFTS, of="turn"), "h", "mm", "Lift"
turning.lift_mean = reduction("mean", of="lift"), "h_m", "mm", "Mean lift"
turning.lift_max = reduction("max", of="lift"), "h_max", "mm", "Greatest lift"
turning.swung = 17 + m.reach * np.sin(m.turn), "z_s", "1", "Teeth at a place"
turning.swung_factor = interpolated(FACTORS, of="swung", key="reach"), "Y_s", "1", "Factor at a place"
turning.swung_mean = reduction("mean", of="swung_factor"), "Y_m", "1", "Mean factor"
turning.swung_max = reduction("max", of="swung_factor"), "Y_max", "1", "Greatest factor"

MECHANISM = Mechanism(
    kind="geared",
    version="1",
    title="Geared shaft",
    summary="A shaft whose numbers come from tables.",
    inputs=Geared,
    chapters=(shaft, wheels, turning),
    figures=(
        Plot("lifts", "Lift", "The lift.", abscissa="turn",
             panels=(Panel("Lift", "mm", series=(Series("lift", "h"),)),)),
    ),
)  # fmt: skip
