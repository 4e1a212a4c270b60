"""Roller chain after ISO 606, series B: geometry, chordal action, tension, safety, joint pressure, approximate power rating."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.roller_chain import sizing, steps
from diecut_report.plugins.roller_chain.figures import FIGURES
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, DRIVE, RollerChain
from diecut_report.plugins.roller_chain.steps import USUAL_PITCHES

CHAIN = Vary("chain", series=("08B", "10B", "12B", "16B", "20B", "24B"))
STRONGER = (CHAIN, Vary("breaking_load", "up"), Vary("strands", "up"), Vary("teeth_1", "up"))

# fmt: off

CHECKS = (
    Check("safety_dynamic", "strength", "Dynamic safety against breaking", m.required_safety_dynamic, m.safety_dynamic,
        demand_label="required safety factor", limit_label="safety", sized_unless=("chain",), consequence="the plates break by fatigue.",
        advise=STRONGER),
    Check("safety_static", "strength", "Static safety against breaking", m.required_safety_static, m.safety_static,
        demand_label="required safety factor", limit_label="safety", sized_unless=("chain",),
        consequence="too little is left for what is not calculated.", advise=STRONGER),
    Check("bearing_pressure", "strength", "Pressure of the joints", m.bearing_pressure, m.allowable_bearing_pressure, demand_label="pressure",
        source="maker", sized_unless=("chain",), consequence="the joints wear and the chain lengthens.",
        advise=(CHAIN, Vary("bearing_area", "up"), Vary("strands", "up"))),
    Check("links_even", "practice", "Even number of links", m.links_odd, 0.0, severity="warn", limit_label="allowed", source="practice",
        consequence="the chain needs a cranked link, with which a ninth of the breaking load may be used in place of a sixth (Diamond Chain): then "
            "required_safety_dynamic is 9.", advise=("links",)),
    Check("teeth", "practice", "Number of teeth of the smaller sprocket", m.teeth_usual, m.teeth_small, severity="warn", demand_label="usual",
        limit_label="teeth", consequence="the chain runs roughly and wears.", advise=(Vary("teeth_1", "up"), Vary("teeth_2", "up"))),
    Check("speed_unevenness", "practice", "Speed ripple", m.speed_unevenness, 2.0, severity="warn", demand_label="drop in velocity within a tooth",
        limit_label="usual", source="practice", consequence="the strand is shaken at each tooth.", advise=(Vary("teeth_1", "up"),)),
    Check("center_distance", "practice", "Centre distance", m.center_in_pitches, float(USUAL_PITCHES[1]), at_least=float(USUAL_PITCHES[0]),
        severity="warn", needs=(DRIVE,), demand_label="distance in pitches", limit_label="usual", at_least_label="at least", source="practice",
        consequence="short strands wear sooner, long ones whip (beyond 80 pitches they must be carried).", advise=("center_distance", "links")),
    Check("wrap", "practice", "Wrap of the smaller sprocket", 120.0, m.wrap_small, severity="warn", demand_label="required", limit_label="wrap",
        source="practice", consequence="too few teeth share the load.", advise=(Vary("center_distance", "up"), Vary("links", "up"))),
    Check("power_rating", "practice", "Power rating", m.design_power, m.rated_power, severity="warn", needs=(DRIVE, "power_rating"),
        demand_label="power with application factor", limit_label="rated", source="ANSI B29.1",
        consequence="the chain does not last 15 000 h, by its {rating_governing}.", advise=(CHAIN, Vary("strands", "up"), Vary("teeth_1", "up"))),
    Check("slack_side", "practice", "Slack of the returning strand", m.useful_tension, m.slack_tension, severity="warn", needs=(CONVEYOR,),
        demand_label="useful tension when the drive brakes", limit_label="sag and pretension",
        consequence="the returning strand goes slack when the drive brakes; a tensioner avoids it.", advise=(Vary("pretension", "up"),)),
    Check("length_formula", "practice", "Length formula", m.links_residual, 0.01, presumed=True, severity="warn",
        demand_label="difference from exact polygon",
        consequence="sprockets so unlike stand so near that the formula of the catalogues is coarse: let the centre distance be adjustable."),
)


def _of_sheet(name: str, otherwise: str) -> Wired:
    """A curve of the transport that there is."""
    cam_gear = Wired(f"${{<cam_gear_transport>.{name}}}", otherwise=otherwise)
    return Wired(f"${{<geneva_transport>.{name}}}", otherwise=cam_gear)


EXAMPLE = ExampleBlock(
    "gripper_chain",
    {
        "chain": "12B",
        "use": "conveyor",
        "strands": 2,
        "teeth_1": _of_sheet("sprocket_teeth", otherwise="30"),
        "teeth_2": 30,
        "links": 240,
        "acceleration": _of_sheet("sheet_acceleration", otherwise="80 m/s**2"),
        "velocity": _of_sheet("sheet_velocity", otherwise="5.7 m/s"),
        "moving_mass": "9.6 kg",
        "driven_inertia": "0.02 kg*m**2",
        "pretension": "800 N",
    },
)


MECHANISM = Mechanism(
    kind="roller_chain",
    version="1.0",
    title="Roller chain",
    summary="A chain of ISO 606, series B, that drives a shaft or conveys: loop over two sprockets, polygon effect, tension of a strand over the "
            "cycle, safety against breaking, pressure of the joints. If the chain is omitted, the smallest sufficient one is selected.",
    inputs=RollerChain,
    example=EXAMPLE,
    chapters=(steps.cycle, sizing.size, steps.chain, steps.loop, steps.motion, steps.useful, steps.tension, steps.safety, steps.rating,
              steps.limits),
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
