"""Sheet transport by gripper bars on two endless chains."""

from __future__ import annotations

from diecut_report.api import CurveTable, Erratum, Mechanism, Source
from gripper_chain.checks import CHECKS
from gripper_chain.example import EXAMPLE
from gripper_chain.figures import FIGURES
from gripper_chain.inputs import GripperChain
from gripper_chain.polygon import bars, chain, polygon
from gripper_chain.slack import slack
from gripper_chain.stations import cycle, stations
from gripper_chain.tension import grip, loads, motor, pull, strength

CONTRACT = 2  # the contract of plugins that this one is written for

MECHANISM = Mechanism(
    kind="gripper_chain",
    version="1.0",
    title="Gripper chain",
    summary="Two endless chains on two pairs of equal sprockets carry gripper bars, each with a sheet. Speed, polygon effect, sag, pull and "
    "torque follow from the sheet rate; the grip on the sheet, the register at the stations and the chain itself are checked.",
    inputs=GripperChain,
    chapters=(chain, bars, polygon, slack, loads, pull, strength, grip, stations, cycle, motor),
    key_results=("chain_speed", "bar_count", "sag", "tension_max", "torque_max", "power", "acceleration_max"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The axes are level, both sprockets have the same number of teeth; the upper strand runs in rails and is "
        "straight.",
        "The driving sprocket runs at constant speed. The upper strand is rigid and follows its polygon; the idle sprocket runs freely.",
        "On the sprockets a worn chain still has one pitch per tooth; its excess length is in the slack strand.",
        "Each station exerts drag on one sheet at a time; a sheet passes one station at a time.",
        "The required safety factor of 7 used by default is a manufacturer's rule of thumb; no standard gives one.",
    ),
    sources=(
        Source(
            "ISO 606",
            "ISO 606, Short-pitch transmission precision roller and bush chains, attachments and associated chain sprockets.",
        ),
        Source(
            "Shigley",
            "Budynas R. G., Nisbett J. K. Shigley's Mechanical Engineering Design. McGraw-Hill; section 17-5, roller chain.",
        ),
        Source(
            "Roloff/Matek",
            "Wittel H., Jannasch D., Voßiek J., Spura C. Roloff/Matek Maschinenelemente. Springer Vieweg; chapter on chain drives.",
        ),
        Source("iwis", "iwis, Grundlagen der Kettentechnik: a safety of 7 against the breaking load by rule of thumb."),
    ),
    errata=(
        Erratum(
            "Roloff/Matek",
            "No mistake, but a range: the pull of the slack strand is given there by the parabola, q·g·a²/(8·f). The catenary's horizontal pull is "
            "greater by about q·g·f/6, which matters where the strand hangs deep. This calculation takes the catenary; e_p is the difference.",
            ("catenary", "slack_tension", "parabola_tension", "parabola_error"),
        ),
    ),
    example=EXAMPLE,
    exports=(CurveTable(id="tooth", title="Polygon effect over a tooth", columns=("sprocket_angle",)),),
)
