"""Folding-knife drives of the second longitudinal fold, compared (004)."""

from __future__ import annotations

from diecut_report.api import Erratum, Mechanism, Source
from diecut_report.plugins.knife_drive import comparison, drives, rocker, working
from diecut_report.plugins.knife_drive.checks import CHECKS
from diecut_report.plugins.knife_drive.example import EXAMPLE
from diecut_report.plugins.knife_drive.figures import FIGURES
from diecut_report.plugins.knife_drive.inputs import KnifeDrive

MECHANISM = Mechanism(
    kind="knife_drive",
    version="1.0",
    title="Folding knife: planetary, crank-slider and crank-rocker drive",
    summary="The edge of the folding knife meets a signature that lies on the table, accelerates it to its own speed and pushes it between two "
            "folding rollers, which carry it away. Up to three drives of the knife are compared at one speed of the machine and one working "
            "depth: duration of the working stroke, speed at contact, acceleration of the paper by the knife and in the grip of the rollers, "
            "time on the table.",
    inputs=KnifeDrive,
    example=EXAMPLE,
    chapters=(working.speeds, working.of_drive(working.PLANETARY, drives.PLANETARY),
              working.of_drive(working.CRANK_SLIDER, drives.CRANK_SLIDER), working.of_drive(working.CRANK_ROCKER, rocker.CRANK_ROCKER),
              comparison.best, comparison.why, comparison.grip),
    key_results=("verdict", "acceleration_ratio_planetary", "stroke_ratio_planetary", "factor_ratio_planetary", "reason", "grip_verdict",
                 "planetary_acceleration_peak", "crank_slider_acceleration_peak", "crank_rocker_acceleration_peak", "cycle_time",
                 "roller_velocity"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The knife shaft rotates at constant speed; links and joints are rigid and without clearance.",
        "The signature takes the knife's speed instantly as the edge meets it, and follows the edge down to the grip of the rollers. The "
        "acceleration of this impact cannot be calculated: only the speed at contact is given and compared, nothing is checked.",
        "The rollers bring the signature to their speed with constant acceleration while the shaft turns by the grip angle, which ends at the "
        "knife's lowest point.",
        "The planetary drive is the straight-line one: its knife arm is as long as the carrier and turns back at the carrier's speed.",
        "The height of the crank-rocker's edge is counted along its arc. With the lowest point at the inner dead centre the rocker's angle "
        "falls as the edge rises; velocity and acceleration count upwards there, too, so they are −ω₃·R and −ε₃·R.",
    ),
    sources=(
        Source("004", "Didych V. P., Nahorniuk S. O. Comparative analysis of the mechanisms of the knife's drive in folders of the second "
               "longitudinal fold of web printing machines (in Ukrainian). 1996. UDC 681.62.067."),
    ),
    errata=(
        Erratum("004", "Eq. 2 prints y = 1 + λ₁cos φ − λ₁cos β; its derivative is not the printed V. The displacement that fits V and W is "
                "r(1 + λ − cos φ − λcos β).", ("crank_slider_displacement",)),
        Erratum("004", "Eq. 3 prints λ₃ω₂² in ε₃; the closed loop of the links gives λ₂ω₂².",
                ("crank_rocker_acceleration", "crank_rocker_rocker_acceleration_ratio")),
        Erratum("004", "Eq. 3 prints sin(δ − φ) in ω₂ᵢ, where δ is the direction of the coupler; it is sin(γ − φ), with that of the rocker.",
                ("crank_rocker_acceleration", "crank_rocker_coupler_speed_ratio")),
        Erratum("004", "The 3 to 6 times lower accelerations are put down to the kind of drive. At equal stroke the drives differ little "
                "(planetary to crank-slider 1/(1 + r/l)); what lowers them is a stroke 3 to 6 times shorter at the same working depth.",
                ("acceleration_ratio_planetary",)),
        Erratum("004", "The speed of 0.2 m/s 5° before the lowest point, taken from Fig. 3 without a drive's name, is that of a drive with about "
                "200 m/s² at its end. The planetary drive with 1000 m/s² has 0.999 m/s there, and 5983 m/s² in the grip instead of 6800 m/s².",
                ("planetary_grip_velocity", "planetary_grip_acceleration")),
    ),
)  # fmt: skip
