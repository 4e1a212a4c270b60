"""Sheet transport by a Geneva drive, the Maltese cross of 000, and its comparison with a cam-gear stepper."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Port, Source, Vary, Wired, m
from diecut_report.plugins.geneva_transport import steps
from diecut_report.plugins.geneva_transport.comparison import COMPARED
from diecut_report.plugins.geneva_transport.figures import FIGURES
from diecut_report.plugins.geneva_transport.inputs import GRIPPED, GenevaTransport
from diecut_report.plugins.geneva_transport.steps import CONVEYOR_NEEDS

LOCKING = ("locking_radius", Vary("roller_radius", "down"), Vary("locking_clearance", "down"))

CHECKS = (
    Check("roller_clearance", "function", "Wall between two slots", m.slot_width, m.slot_spacing, operator="<",
        limit_label="distance of their inner ends",
        consequence="neighbouring slots run into each other at their inner ends, the wall between them is {roller_clearance}.",
        advise=(Vary("roller_radius", "down"), Vary("center_distance", "up"))),
    Check("arm_thickness", "function", "Arm between locking arc and slot", m.locking_radius, m.flank_distance, operator="<",
        demand_label="radius of the locking arc", limit_label="distance of the slot's flank", source="geometry",
        consequence="the locking arc cuts into the slots, the tips of the wheel's arms would be {arm_tip} thick.", advise=LOCKING[:2]),
    Check("locking_reach", "function", "Locking disc reaches the wheel", m.rim_distance, m.disc_radius, operator="<",
        demand_label="distance of the wheel's rim", consequence="the disc turns clear of the wheel, nothing holds it in the dwell.", advise=LOCKING),
    Check("cutout", "function", "Arm tips clear the locking disc", m.cutout_overlap, 0.01, demand_label="overlap",
        consequence="in the engagement the tips of the arms meet the disc beside its cut-out, unless they are rounded off.", advise=LOCKING),
    Check("sheet_acceleration", "function", "Acceleration of the sheet", m.sheet_acceleration_max, m.allowable_sheet_acceleration,
        demand_label="maximum acceleration", source="input", needs=(*CONVEYOR_NEEDS, "allowable_sheet_acceleration"),
        consequence="the sheet slips from the grippers or tears; a shorter step lowers it, too.",
        advise=(Vary("crank_speed", "down"), Vary("slots", "up"))),
    Check("grippers", "function", "Holding force of the grippers", m.sheet_force, m.gripper_force, demand_label="force of the sheet on the grippers",
        limit_label="holding force of the grippers", needs=(*GRIPPED, "gripper_force"),
        consequence="the sheet slips out of the grippers, and the register is lost.", advise=(Vary("crank_speed", "down"),)),
    Check("contact_pressure", "strength", "Contact pressure of the roller", m.contact_pressure, m.allowable_contact_pressure,
        demand_label="contact pressure", needs=("driven_inertia", "roller_width", "allowable_contact_pressure"),
        consequence="roller and slot wear and pit; a smaller inertia lowers it, too.",
        advise=(Vary("roller_width", "up"), Vary("center_distance", "up"), Vary("slots", "up"))),
    Check("torque", "strength", "Torque at the crank", m.torque_peak, m.allowable_torque, demand_label="maximum torque", source="input",
        consequence="the crank's shaft and what drives it are overloaded; a smaller inertia lowers it, too.",
        advise=(Vary("crank_speed", "down"), Vary("slots", "up"))),
    Check("sheet_play", "function", "Play of the sheet in the dwell", m.sheet_play, m.allowable_sheet_play, demand_label="play", source="input",
        consequence="the sheets lie out of register, unless an index pin holds the wheel.", advise=(Vary("locking_clearance", "down"),)),
)  # fmt: skip


EXAMPLE = ExampleBlock(
    "cross",
    {
        "slots": 6,
        "center_distance": "240 mm",
        "roller_radius": "16 mm",
        "roller_width": "25 mm",
        "gear_ratio": "${<geneva_transport>.slots}",  # the sprocket turns once a step
        "sprocket_teeth": Wired("${<cam_gear_transport>.sprocket_teeth}", otherwise=30),
        "chain_pitch": Wired("${<cam_gear_transport>.chain_pitch}", otherwise="19.05 mm"),
        # the conveyor on the sprocket's pitch circle, referred to the wheel
        "driven_inertia": Wired(
            "${<cam_gear_transport>.conveyor_mass} * (${<geneva_transport>.sprocket_teeth} * ${<geneva_transport>.chain_pitch}"
            " / 1 revolution)**2 * ${<geneva_transport>.gear_ratio}**2",
            otherwise="6.7 kg*m**2",
        ),
    },
)


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
    chapters=(steps.geometry, steps.dwell, steps.motion, steps.conveyor, steps.rest, steps.grippers, steps.torque,
              steps.hertz, steps.locking),
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
