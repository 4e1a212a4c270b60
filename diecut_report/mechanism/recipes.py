"""How a quantity is given, as authors say it: a call for each type of step that gives one.

A formula is an expression of quantities, or ``value(…)`` of it where there is more to say.
"""

from __future__ import annotations

from typing import Unpack

from diecut_report.mechanism.names import Written
from diecut_report.mechanism.steps import (
    Abscissa,
    Accumulated,
    Choice,
    Computed,
    ComputedCurve,
    Crossings,
    CurvePeriod,
    Derivative,
    FromCurve,
    Interpolated,
    Lookup,
    MadeCurve,
    Neighbour,
    Options,
    Part,
    Pick,
    Recipe,
    Reduction,
    Root,
    Running,
    SelfTest,
    Total,
    Value,
)
from diecut_report.mechanism.steps.base import recipe

value = recipe(Value)
choice = recipe(Choice.of)
root = recipe(Root)
abscissa = recipe(Abscissa)
crossings = recipe(Crossings)
reduction = recipe(Reduction)
accumulated = recipe(Accumulated)
derivative = recipe(Derivative)
computed = recipe(Computed)
curve_period = recipe(CurvePeriod)
from_curve = recipe(FromCurve)
made_curve = recipe(MadeCurve)
computed_curve = recipe(ComputedCurve)
total = recipe(Total)
neighbour = recipe(Neighbour)
running = recipe(Running)
part = recipe(Part)
lookup = recipe(Lookup)
interpolated = recipe(Interpolated)
pick = recipe(Pick)
self_test = recipe(SelfTest)


def inner(gives: Written, *, per_piece: bool = False, **options: Unpack[Options]) -> Recipe:
    """Say how a formula gives a quantity that is printed, but is no output in the results file."""
    options["output"] = False
    return value(gives, per_piece=per_piece, **options)
