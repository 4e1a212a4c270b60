"""Sheet transport by a cam-gear stepper (003)."""

from __future__ import annotations

from diecut_report.api import Erratum, Mechanism, Profile, Source
from diecut_report.plugins.cam_gear_transport import cams, motion, rolling, sheet
from diecut_report.plugins.cam_gear_transport.checks import CHECKS
from diecut_report.plugins.cam_gear_transport.example import EXAMPLE
from diecut_report.plugins.cam_gear_transport.figures import FIGURES
from diecut_report.plugins.cam_gear_transport.inputs import CAMS, CamGearTransport

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
    chapters=(rolling.rolling, rolling.phases, motion.sector, motion.gear, sheet.conveyor, sheet.rest, sheet.grippers, sheet.torques,
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
