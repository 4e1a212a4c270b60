"""Numbers from tables: a row by its name, a value between rows, a standard's table, a file beside the plugin."""

from __future__ import annotations

from diecut_report.api import (
    Chapter,
    Inputs,
    Mechanism,
    Quantity,
    StandardFault,
    StandardTable,
    Text,
    interpolated,
    lookup,
    own_table,
    pick,
    standard_table,
    table_beside,
)  # fmt: skip

BEARINGS: StandardTable = own_table(
    title="Deep-groove ball bearings",
    columns={"bore": "mm", "C": "kN"},
    rows={"6204": (20, 13.5), "6205": (25, 14.8)},
    sources=("one maker's list", "another maker's list"),
)
FACTORS = own_table(
    title="Form factors",
    columns={"teeth": "1", "Y": "1"},
    rows=((12, 0.245), (15, 0.290), (20, 0.320)),
    sources=("one book",),
    only_source="others give other pressure angles",
)
PITCHES = standard_table("iso_606_pitches")  # a table of the program: docs/standards.md lists them

try:
    table_beside(__file__, "no_such_file.yaml")  # a YAML, JSON or CSV file in the plugin's folder
except StandardFault as fault:
    assert "no_such_file.yaml" in str(fault)


class Drive(Inputs):
    bearing = Text("Bearing", ("6204", "6205"))
    chain = Text("Chain", ("08B", "10B"))
    teeth = Quantity("z", "1", "Number of teeth of the pinion", gt=0)
    load = Quantity("C_n", "kN", "Rating that the second bearing needs", gt=0)


tables = Chapter("Tables")
tables.bore = lookup(BEARINGS, by="bearing", column="bore"), "d", "mm", "Bore"
tables.pitch = lookup(PITCHES, by="chain"), "p", "mm", "Pitch"
tables.second_rating = pick("above", of="load", series=BEARINGS.series("C")), "C_2", "kN", "Rating of the second one"
tables.second_bore = lookup(BEARINGS, by="second_rating", sought_in="C", column="bore"), "d_2", "mm", "Its bore"
tables.form_factor = interpolated(FACTORS, of="teeth"), "Y", "1", "Form factor"

MECHANISM = Mechanism(
    kind="tabled_drive", version="1.0", title="Drive", summary="Numbers of tables.", inputs=Drive, chapters=(tables,)
)

PRESS = """
mechanisms:
  drive: {kind: tabled_drive, bearing: "6205", chain: 10B, teeth: 18, load: 14 kN}
"""
GIVES = {"drive.bore": "25 mm", "drive.pitch": "15.875 mm", "drive.form_factor": "0.308", "drive.second_bore": "25 mm"}
