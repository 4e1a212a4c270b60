"""A plugin that calculates, but whose comparison with a lever raises."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Chapter, Comparison, Inputs, Mechanism, Quantity, computed, m


class Rod(Inputs):
    length = Quantity("l", "mm", "Length", gt=0, default=10)


class Both(Inputs):
    arm = Quantity("a", "mm", "Arm of the lever")


def breaking(arm: Any) -> Any:
    raise RuntimeError("the comparison fell over")


both = Chapter("Only")
both.ratio = computed(breaking, takes=("arm",), method="none"), "r", "mm", "Ratio"

COMPARISON = Mechanism(
    kind="rod_comparison",
    version="2",
    title="Lever and rod compared",
    summary="",
    inputs=Both,
    chapters=(both,),
)

only = Chapter("Only")
only.result = +m.length, "r", "mm", "Result"

MECHANISM = Mechanism(
    kind="breaks_in_comparison",
    version="1",
    title="Rod",
    summary="",
    inputs=Rod,
    chapters=(only,),
    comparisons=(
        Comparison(kinds=("lever", "breaks_in_comparison"), mechanism=COMPARISON, takes={"arm": ("lever", "arm")}),
    ),
)
