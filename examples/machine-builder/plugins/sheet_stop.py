"""A sprung stop that catches sheets: how far it gives way, and with what force."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, Source, m


class SheetStop(Inputs):
    sheet_mass = Quantity("m", "g", "Mass of a sheet", gt=0)
    stop_mass = Quantity("m_a", "g", "Mass of the stop's bar", gt=0)
    speed = Quantity("v", "m/s", "Speed with which the sheet arrives", gt=0)
    stiffness = Quantity("c", "N/mm", "Stiffness of the stop's springs", gt=0)
    room = Quantity("s", "mm", "Way for which there is room", gt=0)
    allowable_force = Quantity("[F]", "N", "Force that bends no edge", gt=0, optional=True)


impact = Chapter(
    "Impact", text="The sheet and the bar go on together (plastic impact); then the springs take their energy."
)
both = m.sheet_mass + m.stop_mass
impact.speed_after = m.sheet_mass * m.speed / both, "v_1", "m/s", "Speed of both after the impact", "momentum"
impact.way = m.speed_after * np.sqrt(both / m.stiffness), "x", "mm", "Way of the stop", "energy"
impact.force = m.stiffness * m.way, "F", "N", "Force of the springs"

CHECKS = (
    Check("room", "function", "Room behind the stop", m.way, m.room, limit_label="room",
          consequence="the bar strikes the frame; take stiffer springs."),
    Check("edge", "strength", "Edge of the sheet", m.force, m.allowable_force, source="WS 7",
          consequence="the edge of the sheet is bent; take softer springs."),
)  # fmt: skip

MECHANISM = Mechanism(
    kind="sheet_stop",
    version="1.0",
    title="Sheet stop",
    summary="A sprung stop catches a sheet.",
    inputs=SheetStop,
    chapters=(impact,),
    key_results=("way", "force"),
    checks=CHECKS,
    assumptions=("The sheet stays at the stop; friction below it is left out.",),
    sources=(Source("WS 7", "Works standard 7, Sheet stops."),),
)
