"""Sheet transport by a Geneva drive, the Maltese cross of 000, and its comparison with a cam-gear stepper."""

from __future__ import annotations

from diecut_report.api import Mechanism, Port, Source
from diecut_report.plugins.geneva_transport import forces, motion
from diecut_report.plugins.geneva_transport.checks import CHECKS
from diecut_report.plugins.geneva_transport.comparison import COMPARED
from diecut_report.plugins.geneva_transport.example import EXAMPLE
from diecut_report.plugins.geneva_transport.figures import FIGURES
from diecut_report.plugins.geneva_transport.inputs import GenevaTransport

MECHANISM = Mechanism(
    kind="geneva_transport",
    version="1.0",
    title="Sheet transport: Geneva drive",
    summary="A crank on the main shaft carries a roller that enters a slot of the Maltese cross once per revolution and turns it by one step; a "
            "gear, sprocket and chain transmit the step to the conveyor. For the rest of the revolution the locking disc holds the wheel and the "
            "sheet dwells. From the number of slots and the centre distance follow the wheel's size, dwell, motion, torque, roller force and "
            "locking.",
    inputs=GenevaTransport,
    example=EXAMPLE,
    chapters=(motion.geometry, motion.dwell, motion.motion, motion.conveyor, motion.rest, motion.grippers, forces.torque,
              forces.hertz, forces.locking),
    key_results=("crank_radius", "wheel_radius", "step_angle", "dwell_fraction", "time_dwell", "sheet_step", "sheet_velocity_max",
                 "sheet_acceleration_max", "sheet_force", "torque_peak", "roller_force_peak", "contact_pressure", "arm_tip", "sheet_play"),
    ports=(
        Port(name="crank", torque="torque", forces=("crank_force_x", "crank_force_y"), speed="crank_speed", radius=("crank_radius",)),
        Port(name="wheel", torque="wheel_acceleration", forces=("crank_force_x", "crank_force_y"), opposite=True, angle="wheel_angle",
             backwards=True, acceleration="wheel_acceleration", advance="slots", radius=("wheel_radius",),
             fills={"gear_ratio": "ratio", "sprocket_teeth": "teeth", "chain_pitch": "pitch", "driven_inertia": "inertia",
                    "own_inertia": "own_inertia", "efficiency": "efficiency"}),
    ),
    checks=CHECKS,
    figures=FIGURES,
    comparisons=(COMPARED,),
    assumptions=(
        "The crank turns at constant speed; crank, roller, slots and shafts are rigid; the slots are as wide as the roller.",
        "Torque and roller force move the driven inertia, with the losses of the gear behind the wheel: friction of roller, bearings and conveyor "
        "is not included.",
        "The wheel's acceleration jumps at entry and exit; the vibration that the jump excites in shaft, chain and sheet is not included.",
    ),
    sources=(
        Source("000", "Topolnytskyi P. V., Shustykevych A. I., Kolomiiets A. B., Vatuliak Yu. V. Research of the drive parameters "
               "of the pressure cylinder of a flat-bed type die-cutting machine. 2024. "
               "doi: 10.32403/1998-6912-2024-2-69-140-150."),
        Source("Hertz", "Line contact of cylinders, as in Johnson K. L. Contact Mechanics. Cambridge University Press, 1985, chapter 4."),
    ),
)  # fmt: skip
