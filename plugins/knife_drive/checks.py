"""Checks of the folding knife's drives, the same for each."""

from __future__ import annotations

from diecut_report.api import Check, Vary
from diecut_report.plugins.knife_drive.working import ALL, DriveKind


def of_drive(drive: DriveKind) -> tuple[Check, ...]:
    """Paper in the working stroke, paper in the grip, depth, time on the table."""
    own, name = drive.key, f"{drive.name[0].upper()}{drive.name[1:]}"
    return (
        Check(id=f"{own}_paper_acceleration", check_class="function", title=f"{name}: acceleration of the paper", demand=f"{own}_acceleration_peak",
              limit="allowable_paper_acceleration", unit="m/s**2", demand_label="maximum in the working stroke", limit_label="allowed",
              needs=(own,), source="004, after Fig. 3",
              consequence=f"the knife breaks or tears the paper at the fold; a shorter stroke than {{{own}_stroke}} is gentler.",
              advise=(Vary("cylinder_rate", "down"),)),
        Check(id=f"{own}_grip_acceleration", check_class="function", title=f"{name}: acceleration in the grip", demand=f"{own}_grip_size",
              limit="allowable_grip_acceleration", unit="m/s**2", demand_label="in the grip of the rollers", limit_label="allowed",
              needs=(own,), source="004, after Fig. 3",
              consequence="the rollers change the signature's speed too fast and may tear it.",
              advise=("roller_ratio", Vary("cylinder_rate", "down"), Vary("grip_angle", "up"))),
        Check(id=f"{own}_depth", check_class="function", title=f"{name}: stroke over working depth",
              demand="working_depth", limit=f"{own}_stroke", unit="mm",
              needs=(own,), demand_label="working depth", limit_label="stroke", source="geometry",
              consequence=f"the edge never rises above the table; {drive.longer} makes the stroke greater.",
              advise=(Vary(f"{own}.{drive.stroke_key}", "up"), Vary("working_depth", "down"))),
        Check(id=f"{own}_time_budget", check_class="function", title=f"{name}: time on the table",
              demand=f"{own}_table_time", limit="signature_interval", unit="ms",
              needs=(own, "signature_length"), demand_label="time of a signature on the table", limit_label="time between two signatures",
              source="004, before Fig. 2",
              consequence="the next signature runs into the one that is still on the table; a shorter working stroke leaves more time.",
              advise=(Vary("roller_ratio", "up"),)),
    )  # fmt: skip


IN_STEP = Check(id="in_step", check_class="function", title="Knife in step with the signatures", demand="stroke_error", limit=0, unit="1",
    demand_label="deviation from one stroke per signature", limit_label="allowed", source="kinematics",
    consequence="the knife misses signatures, or comes down onto one that it has folded; give drive_ratio 2.")  # fmt: skip
CHECKS = (*(check for drive in ALL for check in of_drive(drive)), IN_STEP)
