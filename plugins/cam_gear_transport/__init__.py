"""Sheet transport by a cam-gear stepper (003)."""

from __future__ import annotations

from diecut_report.api import Check, Erratum, ExampleBlock, Mechanism, Profile, Source, Vary, m
from diecut_report.plugins.cam_gear_transport import cams, steps
from diecut_report.plugins.cam_gear_transport.cams import LOADED
from diecut_report.plugins.cam_gear_transport.figures import FIGURES
from diecut_report.plugins.cam_gear_transport.inputs import CAMS, GRIPPED, MODULES, SHEET, CamGearTransport

SHORTER = (Vary("dwell_angle", "down"), Vary("sector_stop_sweep", "down"))
SLOWER = (Vary("cycles_per_hour", "down"),)

CHECKS = (
    Check("return_time", "practice", "Time of the sector's return", m.min_return_time, m.time_return, demand_label="required fraction",
        limit_label="available fraction, T₄", source="practice", consequence="the sector and the conveyor are thrown in too short a time.",
        advise=SHORTER),
    Check("gear_turn", "numerical", "One revolution of the gear per cycle", m.gear_rotation_error, 1e-6,
        consequence="the law of motion contradicts itself: its velocity is not the rate of its position; correct the law."),
    Check("tooth_undercut", "practice", "Minimum number of teeth of the gear", 17.0, m.gear_teeth, severity="warn", needs=("module",),
        demand_label="teeth without undercut", limit_label="teeth of the gear", source="involute teeth of 20°",
        consequence="the gear's teeth are undercut at their roots, unless the profile is shifted.", advise=(Vary("module", "down", MODULES),)),
    Check("pressure_angle", "practice", "Pressure angle of the cams", m.pressure_angle_max, m.max_pressure_angle,
        demand_label="maximum pressure angle", limit_label="accepted", source="practice", needs=CAMS,
        consequence="the roller presses on its pivot more than it turns the arm (cam 1 has {cam_1_pressure_angle_max}, cam 2 "
            "{cam_2_pressure_angle_max}); {arms_that_fit}."),
    Check("curvature", "function", "No undercut of the cams", m.roller_radius, m.curvature_min, operator="<", demand_label="roller radius",
        limit_label="minimum radius of pitch curves", needs=CAMS,
        consequence="a profile ends in a point and its roller leaves the wanted path there; {arms_that_fit}.",
        advise=(Vary("roller_radius", "down"),)),
    Check("profile_turns", "function", "Cams enclose the shaft", m.roller_radius, m.tangent_distance_min, operator="<", demand_label="roller radius",
        limit_label="minimum tangent distance", needs=CAMS,
        consequence="a roller runs back around O₁ or its profile crosses itself; {arms_that_fit}.", advise=(Vary("roller_radius", "down"),)),
    Check("contact_pressure", "strength", "Contact pressure of rollers", m.contact_pressure, m.allowable_contact_pressure,
        demand_label="maximum contact pressure", needs=(*CAMS, *LOADED, "allowable_contact_pressure"),
        consequence="rollers and cams wear and pit; a lighter conveyor presses less.", advise=(Vary("roller_width", "up"), *SLOWER)),
    Check("sheet_acceleration", "function", "Acceleration of the sheet", m.sheet_acceleration_max, m.allowable_sheet_acceleration,
        demand_label="maximum acceleration", source="input", needs=(*SHEET, "allowable_sheet_acceleration"),
        consequence="the sheet slips from the grippers or tears.", advise=("sector_stop_sweep", *SLOWER, Vary("dwell_angle", "down"))),
    Check("grippers", "function", "Holding force of the grippers", m.sheet_force, m.gripper_force, demand_label="force of the sheet on the grippers",
        limit_label="holding force of the grippers", needs=(*GRIPPED, "gripper_force"),
        consequence="the sheet slips out of the grippers, and the register is lost.", advise=SLOWER),
    Check("torque", "strength", "Torque at the disc's shaft", m.torque_peak, m.allowable_torque, demand_label="maximum torque", source="input",
        consequence="the shaft and what drives it are overloaded; a lighter conveyor needs less.", advise=SLOWER),
)  # fmt: skip


EXAMPLE = ExampleBlock(
    "feeder",
    {
        "dwell_angle": "160 deg",
        "center_distance": "300 mm",
        "arm_length": "90 mm",
        "roller_radius": "20 mm",
        "arm_angle_1": "72 deg",
        "arm_angle_2": "232 deg",
        "roller_width": "25 mm",
        "sprocket_teeth": 30,
        "chain_pitch": "19.05 mm",
        "conveyor_mass": "22.6 kg",
    },
)


MECHANISM = Mechanism(
    kind="cam_gear_transport",
    version="1.0",
    title="Sheet transport: cam-gear stepper",
    summary="A disc rotates at constant speed and carries a toothed sector on a pin; the sector's rocker runs with two rollers on fixed cams, "
            "and the sector meshes with the gear of the conveyor's sprocket, which is coaxial with the disc. While the sector rolls off as fast "
            "as the disc turns, gear and conveyor dwell; while it stops, returns and starts again, they make their step. From the required dwell "
            "follow the radii, the phases, the motion of sector, gear and sheet, torque and forces, and the profiles of both cams.",
    inputs=CamGearTransport,
    example=EXAMPLE,
    chapters=(steps.rolling, steps.phases, steps.sector, steps.gear, steps.conveyor, steps.rest, steps.grippers, steps.torques,
              *cams.SECTIONS),
    key_results=("radius_ratio", "gear_radius", "sector_radius", "time_dwell", "time_return", "angle_stop", "angle_start",
                 "gear_speed_ratio_peak", "gear_acceleration_peak", "sheet_step", "sheet_velocity_max", "sheet_acceleration_max",
                 "sheet_force", "torque_peak", "pressure_angle_max", "curvature_min", "contact_pressure"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The disc turns at constant speed; sector, rocker, rollers, cams and shafts are rigid and without clearance.",
        "The motion of the chain over the sprocket is assumed uniform (no polygon effect).",
        "Torque and forces are those of the conveyor's mass, and of the sector's inertia where it is given (without it they are too small), "
        "without friction, losses and preload of the rollers.",
        "Where the acceleration jumps (harmonic and parabolic law), the vibration that the jump excites in sector, chain and sheet is not "
        "included.",
    ),
    sources=(
        Source("003", "Rehei I. I., Uhryn Ya. M., Ternytskyi S. V., Ivaskiv B. R., Mlynko O. I. The synthesis of cam-gear mechanism for "
               "discrete transportation of cardboard blanks by its side bleeds through units of the die-cutting equipment. 2021. "
               "doi: 10.32403/0554-4866-2021-2-82-11-20."),
        Source("Hertz", "Line contact of cylinders, as in Johnson K. L. Contact Mechanics. Cambridge University Press, 1985, chapter 4."),
    ),
    errata=(
        Erratum("003", "The text gives 13.12 first as the sector's maximum speed in its return, then as the gear's. The sector's is 2·80°/0.2593 "
                       "= 10.771 rad per turn; 13.127 = 10.771 + 2.356 is the gear's, referred to the sector (times R₁/R₃). The gear itself "
                       "turns 5.5714 times as fast as the disc.",
                ("sector_speed_return_peak", "gear_speed", "gear_speed_peak", "gear_speed_peak_sector_referred")),
    ),
    exports=tuple(
        Profile(id=f"cam_{n}", title=f"Cam {n}", columns=(f"cam_{n}_x", f"cam_{n}_y", f"cam_{n}_pitch_x", f"cam_{n}_pitch_y"), needs=CAMS)
        for n in "12"
    ),
)  # fmt: skip
