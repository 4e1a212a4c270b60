"""Roller chain after ISO 606, series B: geometry, chordal action, tension, safety, joint pressure, approximate power rating."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.roller_chain import geometry, loads, sizing, strength
from diecut_report.plugins.roller_chain.checks import CHECKS
from diecut_report.plugins.roller_chain.example import EXAMPLE
from diecut_report.plugins.roller_chain.figures import FIGURES
from diecut_report.plugins.roller_chain.inputs import RollerChain

MECHANISM = Mechanism(
    kind="roller_chain",
    version="1.0",
    title="Roller chain",
    summary="A chain of ISO 606, series B, that drives a shaft or conveys: loop over two sprockets, polygon effect, tension of a strand over the "
            "cycle, safety against breaking, pressure of the joints. If the chain is omitted, the smallest sufficient one is selected.",
    inputs=RollerChain,
    example=EXAMPLE,
    chapters=(loads.cycle, sizing.size, geometry.chain, geometry.loop, loads.motion, loads.useful, loads.tension, strength.safety, strength.rating,
              strength.limits),
    key_results=("pitch", "links", "center_distance_adjusted", "velocity", "useful_tension", "tension_peak", "safety_dynamic", "safety_static",
                 "bearing_pressure"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The whole mass that a conveyor moves is assumed to hang on one side, which is on the safe side; in a closed loop its weight is "
        "balanced. When the drive brakes, the other side is tight by the same amount.",
        "The absolute value of a torque or an acceleration is used: where it changes its sign, the other strand is the tight one.",
        "Parallel strands share the load evenly.",
        "The default required safety factors, 7 (static) and 6 (dynamic), are manufacturers' rules; no standard gives them.",
        "Tensions use the given centre distance; where the number of links is given, the distance at which they fit.",
        "Not covered: selection charts and wear life of ISO 10823, attachments and bent lugs, friction of guides in curves, stretch and "
        "resonance of the strands, elongation by wear. A cranked link causes a warning, and carries less: required_safety_dynamic is then 9.",
    ),
    sources=(
        Source("ISO 606", "ISO 606, Short-pitch transmission precision roller and bush chains, attachments and associated chain sprockets."),
        Source("Shigley", "Budynas R. G., Nisbett J. K. Shigley's Mechanical Engineering Design. 10th ed. McGraw-Hill, 2015, chapters 6, 7 and 17."),
        Source("iwis", "iwis, Grundlagen der Kettentechnik: Bruchkraft (breaking load): a safety of 7 against it by rule of thumb. iwis.de."),
        Source("Diamond Chain", "Diamond Chain, What is working load, and what role does it play in selecting roller chain? At most a sixth of the "
               "breaking load, a ninth with slip-fit or cranked connecting links. diamondchain.com."),
        Source("ANSI B29.1", "ANSI/ASME B29.1, Precision power transmission roller chains, attachments, and sprockets; power ratings as given by "
               "Shigley, eq. 17-32, 17-33."),
    ),
)  # fmt: skip
