"""Checks of the elastic drive."""

from __future__ import annotations

from diecut_report.api import AdviceWay, Check, Vary, phrase
from diecut_report.plugins.elastic_follower.motion import CURVE, LAW
from diecut_report.plugins.elastic_follower.spectrum import FIRST

# fmt: off

WANTED = 5  # natural periods within the rise
TUNED = (Vary("stiffness", "up"), Vary("rise_time", "up"), "motion_law")
SLOWER = (Vary("stiffness", "up"), Vary("rise_time", "up"))


def _of_peak(id: str, title: str, demand: str, label: str, consequence: str) -> tuple[Check, Check]:
    limit = {"peak_ratio": "allowable_peak_ratio", "residual": "allowable_residual_ratio"}[id]

    def check(needs: tuple[str, ...], words: str, advise: tuple[AdviceWay, ...]) -> Check:
        return Check(id=id, check_class="function", title=title, demand=demand, limit=limit, unit="1", demand_label=label, limit_label="allowed",
                     source="001, first paper", consequence=f"{consequence}; {words}", needs=needs, advise=advise)

    lighter = phrase("a lighter link has more natural periods within the motion, too.")
    by_curve = phrase("a lighter link has more natural periods within the motion, too (see the figure of this motion).")
    return check(LAW, lighter, TUNED), check(CURVE, by_curve, (Vary("stiffness", "up"),))


CHECKS = (
    *_of_peak("peak_ratio", "Peak acceleration during the motion", "peak_ratio", "ratio of the peak to the rigid-drive value",
        "the drive is too soft for this motion, the link swings up"),
    Check(id="tuning_ratio", check_class="practice", title="Natural periods within the motion", demand=WANTED, limit="tuning_ratio", unit="1",
        severity="warn", demand_label="required", limit_label="natural periods within the motion", source="practice",
        consequence="the link cannot follow the input; a lighter one can.", advise=SLOWER),
    *(Check(id="torque_peak", check_class="strength", title="Load on the drive", demand="torque_peak", limit="allowable_torque", unit=unit,
            needs=(body,), demand_label=label, limit_label="allowed", source="input",
            consequence="shaft, chain or rod is overloaded; a gentler motion or a lighter link lowers it.",
            advise=(Vary("rise_time", "up"),))
      for body, unit, label in (("inertia", "N*m", "maximum torque"), ("mass", "N", "maximum force"))),
    *_of_peak("residual", "Vibration after the motion", "residual_ratio", "ratio of the peak after the motion to the rigid-drive value",
        "the link goes on swinging in its rest"),
    Check(id="spectrum_start", check_class="function", title="Within the spectrum: not too soft", demand=FIRST, limit="tuning_ratio", unit="1",
        demand_label="start of the spectrum", limit_label="natural periods within the motion", source="001, first paper",
        consequence="the link stays behind the input, and its peaks are small only for that; the spectrum does not show this drive.", advise=SLOWER),
)
