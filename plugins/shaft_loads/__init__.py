"""Loads of a shaft over one cycle of the machine, from the curves of the mechanisms that it drives or that drive it."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, ExampleBlock, Mechanism, Wired
from diecut_report.plugins.shaft_loads.curves import angle, balance, curves_of, hub, joints, values
from diecut_report.plugins.shaft_loads.inputs import KEYS, ShaftLoads

# fmt: off

OBJECT = "curves"

cycle = Chapter("Loads over the cycle",
    text="The cycle is a whole number of revolutions of the main shaft and of this one. A torque passes a mesh or a chain with its efficiency: more "
        "where it drives, less where it is given back. A torque of an inertia is that inertia times the angular acceleration.")
cycle.prepared(OBJECT, curves_of, KEYS, for_many=True)
cycle.value("cycle_length", "Φ", "deg", "Length of the cycle, as an angle of the main shaft", lambda main_turns: 2 * np.pi * main_turns, output=False)
cycle.abscissa("main_angle", "φ_m", "deg", "Angle of the main shaft", "cycle_length")
cycle.computed_curve("torque", "T", "N*m", "Torque on the shaft", values("torques"), OBJECT, "main_angle",
    "from the curve of the mechanism, at the angle of the main shaft", joints=joints, named_by="torques.name", needs=("torques",))
cycle.computed_curve("balance", "T_0", "N*m", "Torque that balances the others", balance, OBJECT, "main_angle", "the negative sum of the others",
    joints=joints, needs=("torques",), source="statics")
cycle.computed_curve("hub", "T_h", "N*m", "Torque through the joint of the part with the shaft", hub, OBJECT, "main_angle",
    "the torque at its teeth or chain, with that of its own inertia", joints=joints, named_by="hubs.name", needs=("hubs",), source="statics")
cycle.computed_curve("force", "F", "N", "Force on the shaft", values("forces"), OBJECT, "main_angle",
    "from the curve of the mechanism, at the angle of the main shaft", joints=joints, named_by="forces.name", needs=("forces",))
cycle.computed_curve("shaft_angle", "θ", "deg", "Angle of the shaft", angle, OBJECT, "main_angle",
    "from the curve of the mechanism, at the angle of the main shaft", joints=joints, needs=("motion",))

EXAMPLE = ExampleBlock("shaft_loads", {
    "main_turns": 2,
    "torques": [{"name": "wheel", "mechanism": Wired("<cylinder_drive>"), "curve": "crank_torque", "turns_per_sheet": "1/2"}],
})

MECHANISM = Mechanism(
    kind="shaft_loads",
    version="1.0",
    title="Loads of a shaft over one cycle",
    summary="The torques and forces of the parts on a shaft, from the curves of the mechanisms, over a cycle after which shaft and machine are back "
            "at their start.",
    inputs=ShaftLoads,
    example=EXAMPLE,
    chapters=(cycle,),
    assumptions=("Shafts and joins are rigid and without backlash.",),
)
