"""A small mechanism for tests: every kind of input, an optional output, a curve, a text, a limit that can fail."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Abscissa,
    Block,
    Case,
    Chapter,
    Check,
    Choice,
    CurveInput,
    FromCurve,
    FromPress,
    Inputs,
    Mechanism,
    Quantity,
    Reduction,
    Require,
    Text,
    Total,
    Value,
    block,
    formula,
    m,
    parts,
    pi,
    samples,
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


@formula
def moment(force: Any, arm: Any) -> Any:
    return force * arm


@formula
def quotient(force: Any, width: Any, arm: Any) -> Any:
    return force / (width * arm)


@formula
def wave(angle: Any, moment: Any) -> Any:
    return moment * np.sin(angle)


@formula
def same(length: Any) -> Any:
    return length


@formula
def at_most_hundred(teeth: Any) -> Any:
    return teeth <= 100


@formula
def few(teeth: Any) -> Any:
    return teeth < 17


MECHANISM = Mechanism(
    kind="lever",
    version="0.1",
    title="Lever",
    summary="A force on an arm.",
    inputs=Lever,
    chapters=(
        Chapter(
            "Lever",
            steps=(
                Require(
                    id="teeth_limit", condition=at_most_hundred, key="teeth", message="is {teeth}; a hundred at most"
                ),
                Value(id="moment", symbol="M", unit="N*m", description="Moment", formula=moment),
                Value(id="arm", symbol="a", unit="mm", description="Arm as used", formula=same.of(length=m.inputs.arm)),
                Value(
                    id="pressure", symbol="p", unit="MPa", description="Pressure", formula=quotient, needs=("width",)
                ),
                Choice(
                    unit="1",
                    id="size",
                    symbol="s",
                    description="Size",
                    cases=(Case("small", "z < 17", few), Case("large", "z ≥ 17")),
                ),
            ),
        ),
        Chapter(
            "Turn",
            steps=(
                Abscissa(id="angle", symbol="φ", unit="deg", description="Angle", period=2 * np.pi),
                Value(id="torque", symbol="T", unit="N*m", description="Torque", formula=wave),
                Reduction(
                    id="torque_max", symbol="T_max", unit="N*m", description="Greatest", of="torque", operation="max"
                ),
            ),
        ),
        Chapter(
            "Parts",
            needs=("parts",),
            steps=(
                Total(
                    id="length",
                    symbol="L",
                    unit="mm",
                    description="Length of all parts",
                    of="parts.length",
                    operation="sum",
                ),
            ),
        ),
        Chapter(
            "Load",
            needs=("load",),
            steps=(
                FromCurve(id="taken", symbol="T_l", unit="N*m", description="Load", given="load", abscissa="angle"),
                Reduction(
                    id="taken_max", symbol="T_lm", unit="N*m", description="Greatest load", of="taken", operation="max"
                ),
            ),
        ),
    ),
    checks=(
        Check(
            id="moment",
            check_class="strength",
            title="Moment",
            demand="moment",
            limit="allowable_moment",
            unit="N*m",
            demand_label="moment",
            limit_label="allowed",
            consequence="shorten the arm.",
            needs=("allowable_moment",),
        ),
    ),
)
