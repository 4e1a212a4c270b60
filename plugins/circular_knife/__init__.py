"""Scissor-like cutting with a circular knife: the arrangement of 001 (Uhryn), with formulas of this project's own."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, m
from diecut_report.plugins.circular_knife import steps
from diecut_report.plugins.circular_knife.figures import FIGURES
from diecut_report.plugins.circular_knife.steps import CircularKnife

PLACE = ("front_distance", Vary("cut_length", "down"), "eccentricity", "depth")

CHECKS = (
    Check("reach", "function", "Edge reaches the end of the cut", m.cut_end, m.reach_greatest, operator="<",
        demand_label="end of the cut from the axis", limit_label="maximum reach of the edge",
        consequence="the edge does not get to the end of the cut.", advise=PLACE),
    Check("shear_angle", "practice", "Shear angle between 2° and 20°", m.shear_demand, m.shear_limit,
        demand_label="maximum shear angle (or required minimum)", limit_label="allowed (or actual minimum)", source="practice",
        consequence="beyond 20° the travel is long and the board is pushed forward; below 2° the edge cuts nearly like a guillotine, with a high "
            "force.", advise=PLACE),
    Check("expulsion", "function", "Board is not pushed out", m.shear_angle_max, m.expulsion_angle, operator="<", demand_label="maximum shear angle",
        limit_label="twice the angle of friction", source="statics",
        consequence="edge and counter-knife push the board forward instead of cutting it, unless it is clamped.",
        advise=(*PLACE, Vary("friction", "up"))),
    Check("monotonic", "function", "Edge never reverses in the board", m.used_sweep, m.usable_sweep, demand_label="rotation up to the end of the cut",
        limit_label="rotation without reversal", source="geometry",
        consequence="before the cut ends, the edge runs back in the upper part of the board.", advise=PLACE),
    Check("entry", "function", "Edge meets the board from the front", m.depth_least, m.corner_distance, operator="<",
        demand_label="minimum distance of the edge from the axis, R − r", limit_label="board's upper front edge from the axis", source="geometry",
        consequence="over the whole turn this front edge is inside the edge's circle, so that the blade's end comes down on the board from above.",
        advise=("front_distance", "eccentricity", "depth")),
    Check("shear_resistance", "practice", "Shear resistance compared with the force of a rule", m.rule_force, m.guillotine_line_force, presumed=True,
        severity="warn", needs=("rule_force",), demand_label="required by a straight rule", limit_label="by the shear resistance", source="practice",
        consequence="force, torque and work are then calculated too small.", advise=(Vary("shear_resistance", "up"),)),
    Check("force", "strength", "Cutting force", m.force_max, m.allowable_force, demand_label="maximum downward force", source="input",
        consequence="knife or counter-knife bends; a thinner board takes less force.", advise=(Vary("front_distance", "up"), "eccentricity")),
    Check("torque", "strength", "Torque at the knife's shaft", m.torque_max, m.allowable_torque, demand_label="maximum torque", source="input",
        consequence="the knife's shaft and its drive are overloaded; less friction lowers it.", advise=(Vary("eccentricity", "down"),)),
)  # fmt: skip


EXAMPLE = ExampleBlock(
    "circular_knife",
    {
        "eccentricity": "20 mm",
        "edge_radius": "100 mm",
        "depth": "112 mm",
        "front_distance": "26 mm",
        "thickness": "${press.sheet.thickness}",
        "cut_length": "15 mm",
        "sharpening_angle": "20 deg",
        "speed": "1 revolution * ${press.productivity}",  # one cut a turn
        "shear_resistance": "42 N/mm**2",
        "rule_force": "21 N/mm",
    },
    press={"productivity": "3600 1/h", "sheet.thickness": "0.5 mm"},
)


MECHANISM = Mechanism(
    kind="circular_knife",
    version="1.0",
    title="Circular knife: scissor-like cutting",
    summary="A knife whose edge is an arc about a point beside its shaft turns against a straight counter-knife on which the board lies, and "
            "cuts it like scissors, from its front edge along the counter-knife. From the geometry follow the range of the cut, the shear angle, "
            "the speed and sliding of the edge, force, torque and work. The formulas are derived in this project: only the first page of the "
            "source survives, and it gives the geometry alone.",
    inputs=CircularKnife,
    example=EXAMPLE,
    chapters=(steps.reach, steps.shear_range, steps.edge, steps.motion, steps.forces, steps.guillotine),
    key_results=("angle_start", "angle_end", "cut_time", "shear_angle_min", "shear_angle_max", "cut_speed_max", "sliding_ratio_max",
                 "effective_sharpening_angle_min", "force_max", "torque_max", "work", "guillotine_force_ratio"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The formulas are derived here from the geometry on the source's surviving page and have not been compared with measurements.",
        "The default shear resistance of 10 N/mm² is assumed and has no source; force, torque and work are proportional to it. The press of 000 "
        "cuts board of 0.6 mm with 25 N/mm of straight rule, which is 42 N/mm² of the thickness: give the resistance of your board.",
        "The knife turns at constant speed; knife, counter-knife and shaft are rigid, and the edges meet without clearance.",
        "The board does not move or bend; the force that spreads the cut sides apart is not included.",
        "The sharpening angle does not affect force and torque; only the effective angle follows from it.",
        "Force, torque and work are taken from φ_1 on, where the cutting point is at the board's front edge. Before, from φ_e on, the edge "
        "enters the board: F_v and the friction are smaller there, and the work of entering is not in W; the torque of cutting alone, and F_w, "
        "may be greater there than at φ_1, which raises the maximum torque only where the friction is below about 0.1.",
    ),
    sources=(
        Source("000", "Topolnytskyi P. V., Shustykevych A. I., Kolomiiets A. B., Vatuliak Yu. V. Research of the drive parameters "
               "of the pressure cylinder of a flat-bed type die-cutting machine. 2024. "
               "doi: 10.32403/1998-6912-2024-2-69-140-150."),
        Source("001", "Uhryn Ya. M. Analytical study of the process of cutting board with a circular knife. Naukovi zapysky (Scientific Papers) "
               "1999, No. 1, section of printing machine building, UDC 686.12 (in Ukrainian; only the first page survives)."),
    ),
)  # fmt: skip
