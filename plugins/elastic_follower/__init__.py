"""Driven link on an elastic, damped drive (001, first paper)."""

from __future__ import annotations

from diecut_report.api import AdviceWay, Check, Erratum, ExampleBlock, Mechanism, Source, Vary, Wired, m, phrase
from diecut_report.plugins.elastic_follower import motion, response
from diecut_report.plugins.elastic_follower.figures import FIGURES
from diecut_report.plugins.elastic_follower.inputs import ElasticFollower
from diecut_report.plugins.elastic_follower.motion import CURVE, LAW
from diecut_report.plugins.elastic_follower.response import FIRST, SPECTRUM

# fmt: off

WANTED = 5  # natural periods within the rise
TUNED = (Vary("stiffness", "up"), Vary("rise_time", "up"), "motion_law")
SLOWER = (Vary("stiffness", "up"), Vary("rise_time", "up"))


def _of_peak(id: str, title: str, demand: str, label: str, consequence: str) -> tuple[Check, Check]:
    limit = {"peak_ratio": "allowable_peak_ratio", "residual": "allowable_residual_ratio"}[id]

    def check(needs: tuple[str, ...], words: str, advise: tuple[AdviceWay, ...]) -> Check:
        return Check(id, "function", title, demand, limit, demand_label=label, consequence=f"{consequence}; {words}", needs=needs, advise=advise)

    lighter = phrase("a lighter link has more natural periods within the motion, too.")
    by_curve = phrase("a lighter link has more natural periods within the motion, too (see the figure of this motion).")
    return check(LAW, lighter, TUNED), check(CURVE, by_curve, (Vary("stiffness", "up"),))


CHECKS = (
    *_of_peak("peak_ratio", "Peak acceleration during the motion", "peak_ratio", "ratio of the peak to the rigid-drive value",
        "the drive is too soft for this motion, the link swings up"),
    Check("tuning_ratio", "practice", "Natural periods within the motion", WANTED, m.tuning_ratio, severity="warn", demand_label="required",
        limit_label="natural periods within the motion", source="practice", consequence="the link cannot follow the input; a lighter one can.",
        advise=SLOWER),
    *(Check("torque_peak", "strength", "Load on the drive", m.torque_peak, m.allowable_torque, needs=(body,), demand_label=label, source="input",
            consequence="shaft, chain or rod is overloaded; a gentler motion or a lighter link lowers it.", advise=(Vary("rise_time", "up"),))
      for body, unit, label in (("inertia", "N*m", "maximum torque"), ("mass", "N", "maximum force"))),
    *_of_peak("residual", "Vibration after the motion", "residual_ratio", "ratio of the peak after the motion to the rigid-drive value",
        "the link goes on swinging in its rest"),
    Check("spectrum_start", "function", "Within the spectrum: not too soft", FIRST, m.tuning_ratio, demand_label="start of the spectrum",
        limit_label="natural periods within the motion",
        consequence="the link stays behind the input, and its peaks are small only for that; the spectrum does not show this drive.", advise=SLOWER),
)


EXAMPLE = ExampleBlock(
    "conveyor",
    {
        "inertia": "0.1 kg*m**2",
        "stiffness": "5000 N*m/rad",
        "rise": Wired(None, needs=("cam_gear_transport",), otherwise="1.2 rad"),
        "rise_time": Wired(None, needs=("cam_gear_transport",), otherwise="0.3 s"),
        "motion_curve": Wired("${<cam_gear_transport>.gear_angle}"),
        "cycles_per_hour": Wired("${press.productivity}", needs=("cam_gear_transport",)),
    },
)


MECHANISM = Mechanism(
    kind="elastic_follower",
    version="1.0",
    title="Driven link on an elastic drive",
    summary="A link of given inertia follows an input through an elastic and damped drive: a shaft, a chain, a long rod. While the input moves "
            "from rest to rest, the link oscillates about it. The calculation gives its motion, its peak accelerations during and after the "
            "motion relative to a rigid drive, its overshoot, and the torque of the drive; and which law of motion loads the link least in a "
            "single rise.",
    inputs=ElasticFollower,
    example=EXAMPLE,
    chapters=(motion.drive, motion.times, motion.by_law, motion.by_curve, response.response, response.settling, response.extremes,
              response.compared),
    key_results=("natural_frequency", "tuning_ratio", "peak_ratio", "residual_ratio", "acceleration_peak", "acceleration_rigid", "overshoot",
                 "torque_peak", "recommended_law"),
    checks=CHECKS,
    figures=FIGURES,
    spectra=(SPECTRUM,),
    assumptions=(
        "Drive and link are modelled as one spring, one viscous damper and one inertia; the input follows its law or curve regardless of the "
        "torque.",
        "The link is at rest when the motion begins: residual vibration of the previous motion is not included.",
        "No clearance, no friction, and no load other than the link's own inertia.",
    ),
    sources=(
        Source("001", "Naukovi zapysky (Ukrainian Academy of Printing), 1999, no. 1 (in Ukrainian), first paper, of which only the last page is "
               "known: peaks of the driven link's acceleration over the natural periods within the rise, for several dampings."),
    ),
    errata=(
        Erratum("001", "That at equal λ more damping lowers the peaks does not hold everywhere. After a cycloidal rise of five natural periods the "
                "link rests without damping, and swings with 0.153 of the rigid peak with ζ = 0.05 and 0.156 with ζ = 0.2; in the rise "
                "the peak grows with damping about λ = 0.7 for all laws (cycloidal, λ = 0.68: from 1.197 without damping to 1.243 with ζ = 0.1).",
                ("peak_ratio", "residual_ratio")),
    ),
)  # fmt: skip
