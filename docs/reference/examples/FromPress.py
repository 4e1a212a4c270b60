"""A default that the press gives: the sheet's length, and a rate that follows from the productivity."""

from __future__ import annotations

from diecut_report.api import Chapter, FromPress, Inputs, Mechanism, Quantity, formula, m


@formula
def doubled(rate):
    """Two strokes for each sheet."""
    return 2 * rate


class Feeder(Inputs):
    sheet_length = Quantity(
        "L", "mm", "Length of the sheet", gt=0, press=FromPress("press.sheet.length"), optional=True
    )
    rate = Quantity("k", "1/h", "Strokes", gt=0, press=FromPress("press.productivity", doubled), optional=True)
    share = Quantity("s", "%", "Share of a stroke in which the sheet moves", gt=0, le=100, default=50)


motion = Chapter("Motion")
motion.speed = m.sheet_length * m.rate / m.share, "v", "m/s", "Mean speed of the sheet"

MECHANISM = Mechanism(
    kind="sheet_feeder",
    version="1.0",
    title="Sheet feeder",
    summary="Speed of the sheet.",
    inputs=Feeder,
    chapters=(motion,),
)

PRESS = """
press: {name: Example, productivity: 3600 1/h, sheet: {length: 700 mm, width: 500 mm, thickness: 0.5 mm}}
mechanisms:
  feeder: {kind: sheet_feeder}
"""
GIVES = {"feeder.speed": "2.8 m/s"}
