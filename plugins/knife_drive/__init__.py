"""Folding-knife drives of the second longitudinal fold, compared (004)."""

from __future__ import annotations

from diecut_report.api import Check, Erratum, ExampleBlock, Mechanism, Source, Vary, m
from diecut_report.plugins.knife_drive import comparison, drives, working
from diecut_report.plugins.knife_drive.figures import FIGURES
from diecut_report.plugins.knife_drive.inputs import KnifeDrive
from diecut_report.plugins.knife_drive.working import ALL, DriveKind


def of_drive(drive: DriveKind) -> tuple[Check, ...]:
    """Paper in the working stroke, paper in the grip, depth, time on the table."""
    own, name = drive.key, f"{drive.name[0].upper()}{drive.name[1:]}"
    return (
        Check(f"{own}_paper_acceleration", "function", f"{name}: acceleration of the paper", m[f"{own}_acceleration_peak"],
              m.allowable_paper_acceleration, demand_label="maximum in the working stroke", needs=(own,), source="004, after Fig. 3",
              consequence=f"the knife breaks or tears the paper at the fold; a shorter stroke than {{{own}_stroke}} is gentler.",
              advise=(Vary("cylinder_rate", "down"),)),
        Check(f"{own}_grip_acceleration", "function", f"{name}: acceleration in the grip", m[f"{own}_grip_size"], m.allowable_grip_acceleration,
              demand_label="in the grip of the rollers", needs=(own,), source="004, after Fig. 3",
              consequence="the rollers change the signature's speed too fast and may tear it.",
              advise=("roller_ratio", Vary("cylinder_rate", "down"), Vary("grip_angle", "up"))),
        Check(f"{own}_depth", "function", f"{name}: stroke over working depth", m.working_depth, m[f"{own}_stroke"], needs=(own,),
              demand_label="working depth", limit_label="stroke", source="geometry",
              consequence=f"the edge never rises above the table; {drive.longer} makes the stroke greater.",
              advise=(Vary(f"{own}.{drive.stroke_key}", "up"), Vary("working_depth", "down"))),
        Check(f"{own}_time_budget", "function", f"{name}: time on the table", m[f"{own}_table_time"], m.signature_interval,
              needs=(own, "signature_length"), demand_label="time of a signature on the table", source="004, before Fig. 2",
              consequence="the next signature runs into the one that is still on the table; a shorter working stroke leaves more time.",
              advise=(Vary("roller_ratio", "up"),)),
    )  # fmt: skip


IN_STEP = Check("in_step", "function", "Knife in step with the signatures", m.stroke_error, 0, limit_label="allowed",
    consequence="the knife misses signatures, or comes down onto one that it has folded; give drive_ratio 2.")  # fmt: skip
CHECKS = (*(check for drive in ALL for check in of_drive(drive)), IN_STEP)


EXAMPLE = ExampleBlock(
    "knife",
    {
        "cylinder_rate": "${press.productivity} / 2",
        "working_depth": "40 mm",
        "signature_length": "273 mm",
        "planetary": {"carrier_radius": "65.656 mm"},
        "crank_slider": {"crank_radius": "35 mm", "rod_length": "140 mm"},
        "crank_rocker": {
            "crank": "20 mm",
            "coupler": "110 mm",
            "rocker": "80 mm",
            "frame": "120 mm",
            "knife_arm": "107 mm",
            "lowest_dead_center": "inner",
        },
    },
    press={"productivity": "50000 1/h"},
)


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
              working.of_drive(working.CRANK_SLIDER, drives.CRANK_SLIDER), working.of_drive(working.CRANK_ROCKER, drives.CRANK_ROCKER),
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
