"""A plugin that calculates, but whose comparison with a lever raises."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Chapter, Comparison, Computed, Inputs, Mechanism, Quantity, Value, formula, m


class Rod(Inputs):
    length = Quantity("l", "mm", "Length", gt=0, default=10)


class Both(Inputs):
    arm = Quantity("a", "mm", "Arm of the lever")


@formula
def same(length: Any) -> Any:
    return length


def breaking(arm: Any) -> Any:
    raise RuntimeError("the comparison fell over")


COMPARISON = Mechanism(
    kind="rod_comparison",
    version="2",
    title="Lever and rod compared",
    summary="",
    inputs=Both,
    chapters=(
        Chapter(
            "Only",
            steps=(
                Computed(
                    id="ratio",
                    symbol="r",
                    unit="mm",
                    description="Ratio",
                    function=breaking,
                    takes=("arm",),
                    method="none",
                ),
            ),
        ),
    ),
)
LENGTH = Value(id="result", symbol="r", unit="mm", description="Result", formula=same.of(length=m.length))
MECHANISM = Mechanism(
    kind="breaks_in_comparison",
    version="1",
    title="Rod",
    summary="",
    inputs=Rod,
    chapters=(Chapter("Only", steps=(LENGTH,)),),
    comparisons=(
        Comparison(kinds=("lever", "breaks_in_comparison"), mechanism=COMPARISON, takes={"arm": ("lever", "arm")}),
    ),
)
