"""A key that may name an entry in the user's own table beside the configuration, which then gives other keys."""

from __future__ import annotations

from diecut_report.api import Chapter, FromTable, Inputs, Mechanism, OneOf, Quantity, Text, m, value


class Sprocket(Inputs):
    one_of = (OneOf(("chain",), ("pitch",)),)
    from_tables = (FromTable("chain", "chains", {"pitch": "pitch"}),)

    chain = Text("Chain, an entry of the table chains", optional=True)
    pitch = Quantity("p", "mm", "Pitch of the chain", gt=0, optional=True)
    teeth = Quantity("z", "1", "Teeth", ge=9, integer=True)


length = Chapter("Length")
length.advance = value(m.pitch * m.teeth, needs=("pitch",)), "s", "mm", "Way of the chain in a turn"

MECHANISM = Mechanism(
    kind="sprocket", version="1.0", title="Sprocket", summary="Way of a chain.", inputs=Sprocket, chapters=(length,)
)

TABLES = """
source: works standard 12
chains:
  long: {pitch: 50 mm}
"""
PRESS = """
materials: tables.yaml
mechanisms:
  sprocket: {kind: sprocket, chain: long, teeth: 12}
"""
GIVES = {"sprocket.advance": "600 mm"}
