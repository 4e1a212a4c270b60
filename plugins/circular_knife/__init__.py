"""Scissor-like cutting with a circular knife: the arrangement of 001 (Uhryn), with formulas of this project's own."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.circular_knife import cutting, geometry
from diecut_report.plugins.circular_knife.checks import CHECKS
from diecut_report.plugins.circular_knife.example import EXAMPLE
from diecut_report.plugins.circular_knife.figures import FIGURES
from diecut_report.plugins.circular_knife.inputs import CircularKnife

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
    chapters=(geometry.reach, geometry.shear_range, geometry.edge, cutting.motion, cutting.forces, cutting.guillotine),
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
