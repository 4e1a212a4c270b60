"""A small mechanism for tests: every kind of input, an optional output, a curve, a text, a limit that can fail."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from diecut_report.api import (
    POINTS,
    Abscissa,
    Annotated,
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
    formula,
    m,
    pi,
)


@formula
def turn_for_each_sheet(productivity: Any) -> Any:
    return 2 * pi * productivity


class Part(Block):
    length: Annotated[float, Quantity("l", "mm", "Length of the part", gt=0)]
    label: Annotated[str | None, Text("Name of the part")] = None


class Spring(Block):
    stiffness: Annotated[float, Quantity("c", "N/mm", "Stiffness", gt=0)]


class Lever(Inputs):
    force: Annotated[float, Quantity("F", "kN", "Force", gt=0)]
    arm: Annotated[float, Quantity("a", "mm", "Arm", gt=0, le=1000)] = 100
    grade: Annotated[Literal["fine", "coarse"], Text("Grade")] = "fine"
    remark: Annotated[str | None, Text("Remark")] = None
    hard: Annotated[bool, Text("Whether it is hardened")] = False
    width: Annotated[float | None, Quantity("b", "mm", "Width; with it the pressure", gt=0)] = None
    speed: Annotated[
        float | None, Quantity("ω", "rpm", "Speed", gt=0, press=FromPress("press.productivity", turn_for_each_sheet))
    ] = None
    teeth: Annotated[int, Quantity("z", "1", "Teeth", ge=12, integer=True)] = 20
    parts: Annotated[list[Part], Text("Parts in a row")] = []  # noqa: RUF012
    spring: Annotated[Spring | None, Text("Spring")] = None
    load: Annotated[Any | None, CurveInput("M_l", "N*m", "Load over a turn")] = None
    allowable_moment: Annotated[float | None, Quantity("[M]", "N*m", "Allowed moment", gt=0)] = None
    n_points: Annotated[int, POINTS] = 36


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
