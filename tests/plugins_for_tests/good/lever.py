"""A small mechanism for tests: every kind of input, an optional output, a curve, a text, a limit that can fail."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Block,
    Chapter,
    Check,
    CurveInput,
    FromPress,
    Inputs,
    Mechanism,
    Quantity,
    Text,
    abscissa,
    block,
    case,
    choice,
    formula,
    from_curve,
    m,
    parts,
    pi,
    reduction,
    samples,
    total,
    value,
)


@formula
def turn_for_each_sheet(productivity: Any) -> Any:
    return 2 * pi * productivity


class Part(Block):
    length = Quantity("l", "mm", "Length of the part", gt=0)
    label = Text("Name of the part", optional=True)


class Spring(Block):
    stiffness = Quantity("c", "N/mm", "Stiffness", gt=0)


class Lever(Inputs):
    force = Quantity("F", "kN", "Force", gt=0)
    arm = Quantity("a", "mm", "Arm", gt=0, le=1000, default=100)
    grade = Text("Grade", ("fine", "coarse"), default="fine")
    remark = Text("Remark", optional=True)
    hard = Text("Whether it is hardened", default=False)
    width = Quantity("b", "mm", "Width; with it the pressure", gt=0, optional=True)
    speed = Quantity(
        "ω", "rpm", "Speed", gt=0, press=FromPress("press.productivity", turn_for_each_sheet), optional=True
    )
    teeth = Quantity("z", "1", "Teeth", ge=12, integer=True, default=20)
    parts = parts(Part, "Parts in a row", optional=True)
    spring = block(Spring, "Spring", optional=True)
    load = CurveInput("M_l", "N*m", "Load over a turn", optional=True)
    allowable_moment = Quantity("[M]", "N*m", "Allowed moment", gt=0, optional=True)
    n_points = samples(36)


lever = Chapter("Lever")
lever.require("teeth_limit", m.teeth <= 100, key="teeth", message="is {teeth}; a hundred at most")
lever.moment = m.force * m.arm, "M", "N*m", "Moment"
lever.arm = m.inputs.arm, "a", "mm", "Arm as used"
lever.pressure = value(m.force / (m.width * m.arm), needs=("width",)), "p", "MPa", "Pressure"
lever.size = choice(case("small", "z < 17", m.teeth < 17), case("large", "z ≥ 17")), "s", "1", "Size"

turn = Chapter("Turn")
turn.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
turn.torque = m.moment * np.sin(m.angle), "T", "N*m", "Torque"
turn.torque_max = reduction("max", of="torque"), "T_max", "N*m", "Greatest"

row = Chapter("Parts", needs=("parts",))
row.length = total("sum", of="parts.length"), "L", "mm", "Length of all parts"

load = Chapter("Load", needs=("load",))
load.taken = from_curve("load", abscissa="angle"), "T_l", "N*m", "Load"
load.taken_max = reduction("max", of="taken"), "T_lm", "N*m", "Greatest load"

MECHANISM = Mechanism(
    kind="lever",
    version="0.1",
    title="Lever",
    summary="A force on an arm.",
    inputs=Lever,
    chapters=(lever, turn, row, load),
    checks=(
        Check(
            "moment",
            "strength",
            "Moment",
            m.moment,
            m.allowable_moment,
            consequence="shorten the arm.",
            needs=("allowable_moment",),
        ),
    ),
)
