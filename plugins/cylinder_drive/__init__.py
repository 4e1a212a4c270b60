"""Impression cylinder drive: crank-rocker, sector and pinion (000 eq. 1–12, 18–21)."""

from __future__ import annotations

from diecut_report.api import Check, Erratum, ExampleBlock, Mechanism, Port, Source, Vary, Wired, m
from diecut_report.plugins.cylinder_drive import steps
from diecut_report.plugins.cylinder_drive.figures import FIGURES
from diecut_report.plugins.cylinder_drive.inputs import CylinderDrive

EXAMPLE = ExampleBlock(
    "drive",
    {
        "cylinder_radius": Wired("${<cylinder_sizing>.radius}", otherwise="105.5 mm"),
        "cylinder_length": Wired("${<cylinder_sizing>.generatrix_length}", otherwise="${press.sheet.length}"),
        # the carriages move with the axis
        "cylinder_mass": Wired(
            "${<cylinder_sizing>.mass} + ${<damper>.carriage_mass}",
            otherwise=Wired("${<cylinder_sizing>.mass}", otherwise="104 kg"),
        ),
        "cylinder_inertia": Wired("${<cylinder_sizing>.inertia}", otherwise="0.74 kg*m**2"),
        "static_unbalance": Wired("${<cylinder_sizing>.static_unbalance}", otherwise="2 kg*m"),
        "cutting_arc_fraction": Wired("${<cylinder_sizing>.cutting_arc_fraction}", otherwise=0.71),
        "segment_height": Wired("${<cylinder_sizing>.segment_height}", otherwise="40 mm"),
        "carriage_clearance": "22 mm",
        "crank_length": "100 mm",
        "pinion_radius": "70 mm",
    },
)


MECHANISM = Mechanism(
    kind="cylinder_drive",
    version="1.0",
    title="Impression cylinder drive: crank-rocker, sector and pinion",
    summary="A crank-rocker swings a toothed sector; the sector turns a pinion on a fixed shaft, and a chain moves the carriages in which the "
            "cylinder rolls over the die and back. One revolution of the crank gives two working strokes with a pause at each end, hence two "
            "sheets. The calculation gives the motion of the cylinder, the moments on it, and torque, power and forces over a revolution of the "
            "crank.",
    inputs=CylinderDrive,
    example=EXAMPLE,
    chapters=(steps.linkage, steps.stroke, steps.cutting, steps.kinematics, steps.moments, steps.torque, steps.energy,
              steps.contact, steps.clearance, steps.phases, steps.teeth, steps.joints),
    key_results=("swing_angle", "sector_ratio", "stroke", "velocity_max", "acceleration_max", "cutting_moment", "crank_torque_peak",
                 "crank_torque_mean", "crank_torque_rms", "power_mean", "power_peak", "clearance_outer_time", "clearance_inner_time",
                 "tooth_force_max", "joint_force_max"),
    ports=(
        Port(name="crank", torque="crank_torque", forces=("crank_bearing_force_x", "crank_bearing_force_y"), speed="crank_speed",
             joint=("coupler_force", ""), radius=("crank_length",)),
        Port(name="rocker", torque="rocker_torque", forces=("crank_bearing_force_x", "crank_bearing_force_y"), opposite=True, angle="rocker_angle",
             acceleration="rocker_acceleration", joint=("coupler_force", "transmission_angle"), radius=("rocker_ratio", "crank_length"),
             fills={"sector_ratio": "ratio", "pinion_radius": "pinion_radius", "pinion_inertia": "driven_inertia", "rocker_inertia": "own_inertia",
                    "efficiency_sector": "efficiency"}),
    ),
    checks=(
        Check("grashof", "function", "Crank-rocker (Grashof)", m.grashof_demand, m.grashof_limit, operator="<",
              demand_label="shortest and longest link", limit_label="the other two", source="Grashof",
              consequence="the crank cannot turn fully; change the ratios."),
        Check("transmission_angle", "practice", "Transmission angle", m.min_transmission_angle, m.transmission_angle_worst, demand_label="required",
              limit_label="worst position", source="practice", consequence="the coupler pushes the rocker's joint more than it turns the rocker.",
              advise=(Vary("rocker_ratio", "up"), Vary("frame_ratio", "up"))),
        Check("stroke", "function", "Full revolution of the cylinder over the stroke", m.stroke_error, 0.5,
              demand_label="deviation from one revolution", source="000, Fig. 1",
              consequence="the flat stands tilted at an end of the stroke, unless the sector ratio is 2π/δ_max.", advise=("sector_ratio",)),
        Check("unbalance", "function", "Centre of mass inside the cylinder", m.static_unbalance, m.greatest_unbalance, operator="<",
            demand_label="static unbalance", limit_label="with the centre of mass at the surface", source="statics",
            consequence="no body has its centre of mass outside itself like that; look at static_unbalance and cylinder_mass."),
        Check("crank_torque", "strength", "Torque at the crank", m.crank_torque_peak, m.allowable_torque, demand_label="maximum torque",
              source="input", consequence="the crank's shaft and what drives it are overloaded; a lighter cylinder lowers it.",
              advise=(Vary("crank_speed", "down"),)),
        Check("acceleration", "function", "Acceleration of the cylinder", m.acceleration_max, m.allowable_acceleration,
              demand_label="maximum acceleration", source="input", consequence="the cylinder slips on the board or its drive knocks.",
              advise=(Vary("crank_speed", "down"),)),
        Check("tooth_force", "strength", "Force of the sector's teeth", m.tooth_force_max, m.allowable_tooth_force, source="input",
              consequence="the teeth wear and break.", advise=(Vary("pinion_radius", "up"),)),
        Check("joint_force", "strength", "Force in the joints", m.joint_force_max, m.allowable_joint_force, demand_label="maximum force",
              source="input", consequence="pins and bearings are overloaded.", advise=(Vary("crank_length", "up"),)),
    ),
    figures=FIGURES,
    assumptions=(
        "The crank turns at constant speed; links, joints and teeth are rigid and without clearance; the cylinder rolls without slip.",
        "The technological moment is constant over the cutting part of the stroke, counted in rolled length, and resists the motion "
        "on both strokes.",
        "One efficiency per transmission, the same in both directions of power.",
        "Mass and inertia of the links are not included, those of the shafts of pinion and rocker where they are given: their contribution to "
        "torque and forces is additional.",
    ),
    sources=(
        Source("000", "Topolnytskyi P. V., Shustykevych A. I., Kolomiiets A. B., Vatuliak Yu. V. Research of the drive parameters "
               "of the pressure cylinder of a flat-bed type die-cutting machine. 2024. "
               "doi: 10.32403/1998-6912-2024-2-69-140-150."),
    ),
    errata=(
        Erratum("000", "Eq. 3 and 4 print √(1 + λ₁² − 2λ₁cos φ) where its square belongs.", ("pin_angle", "transmission_angle")),
        Erratum("000", "Eq. 2 gives the direction of the diagonal by arccos, right only for 0 ≤ φ ≤ 180°; over the other half of the "
                "turn it mirrors the linkage. Here the direction is taken by arctan2.", ("diagonal_direction",)),
        Erratum("000", "b = √(2·105·0.6 − 0.6²) is 11.21 mm, not the printed 10.8 mm; so k = 3.363 mm and M_m = 70.6 N·m instead of "
                "3.23 mm and 67.8 N·m. 0.3·10.8 is 3.24, not 3.23.", ("cutting_length", "rolling_arm", "cutting_moment")),
        Erratum("000", "The conditions M_in > 0 and M_Σ > 0 choose the side of the efficiency rightly only on the forward stroke; power "
                "decides. θ₃ holds η_z and η_v, which θ₂ and θ₁ apply again; η_v is not defined, η_zp not used.", ("crank_torque",)),
        Erratum("000", "M_m is added without the sign of the motion (eq. 11, 20), so on the return stroke it helps instead of "
                "resisting. Its moment also acts over the flat.", ("total_moment", "cylinder_moment", "crank_torque")),
        Erratum("000", "The abstract's “6000 cycles per minute” are per hour (100 rpm if a cycle is a turn of the crank, 50 rpm if it is "
                "a sheet).", ("crank_torque_peak",)),
        Erratum("000", "The printed peak of 3.4 kN·m at the main shaft cannot be reproduced, as the paper prints neither efficiencies nor the "
                "ratio u. With its mass, inertia and radius, at 100 rpm of the crank and without losses, the crank's torque reaches 1536 N·m. "
                "At 50 rpm, where a turn of the crank makes two sheets, moments of masses are a quarter of that; and the main shaft, "
                "which turns twice as fast, takes half the crank's torque.", ("crank_torque_peak",)),
    ),
)  # fmt: skip
