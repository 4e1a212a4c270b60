"""Driven link on an elastic, damped drive (001, first paper)."""

from __future__ import annotations

from diecut_report.api import Erratum, Mechanism, Source
from diecut_report.plugins.elastic_follower import motion, response
from diecut_report.plugins.elastic_follower.checks import CHECKS
from diecut_report.plugins.elastic_follower.example import EXAMPLE
from diecut_report.plugins.elastic_follower.figures import FIGURES
from diecut_report.plugins.elastic_follower.inputs import ElasticFollower
from diecut_report.plugins.elastic_follower.spectrum import SPECTRUM

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
