"""The next value of a standard series; the report prints the neighbours that were not taken."""

from __future__ import annotations

from diecut_report.api import (
    Chapter,
    Inputs,
    Mechanism,
    Quantity,
    StandardSeries,
    Text,
    own_series,
    pick,
    standard_series,
    standard_series_by,
)  # fmt: skip

RATINGS: StandardSeries = standard_series("iec_60072_ratings")  # docs/standards.md lists what there is
LENGTHS = standard_series_by("iso_4184_lengths")  # for each section of a V-belt a series
STROKES = own_series(
    title="Strokes of the works", unit="mm", values=(25, 50, 80, 100), sources=("works standard 7",), only_source="it is our own",
)  # fmt: skip


class Cylinder(Inputs):
    power = Quantity("P", "kW", "Power that is needed", gt=0)
    travel = Quantity("s", "mm", "Travel that is needed", gt=0)
    belt = Quantity("L", "mm", "Length of the belt that is needed", gt=0)
    section = Text("Section of the belt", ("SPZ", "SPA"))
    rating_given = Quantity("P_g", "kW", "Rating, where it is not picked", gt=0, optional=True)


sizes = Chapter("Sizes")
sizes.rating = pick("above", of="power", series=RATINGS, given="rating_given"), "P_n", "kW", "Rating of the motor"
sizes.stroke = pick("above", of="travel", series=STROKES), "s_n", "mm", "Stroke of the cylinder"
sizes.length = pick("nearest", of="belt", series=LENGTHS, by="section"), "L_n", "mm", "Length of the belt"

MECHANISM = Mechanism(
    kind="sized_drive",
    version="1.0",
    title="Sized drive",
    summary="Sizes of series.",
    inputs=Cylinder,
    chapters=(sizes,),
)

PRESS = """
mechanisms:
  drive: {kind: sized_drive, power: 1.7 kW, travel: 60 mm, belt: 1210 mm, section: SPZ}
"""
GIVES = {"drive.rating": "2.2 kW", "drive.stroke": "80 mm"}
