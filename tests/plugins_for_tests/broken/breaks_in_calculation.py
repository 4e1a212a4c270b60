"""A plugin that can be loaded, but whose calculation raises."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Annotated, Chapter, Inputs, Mechanism, Quantity, Value, formula


class Fragile(Inputs):
    length: Annotated[float, Quantity("l", "mm", "Length", gt=0)] = 10


@formula
def breaking(length: Any) -> Any:
    raise RuntimeError("the plugin fell over")


MECHANISM = Mechanism(
    kind="breaks_in_calculation",
    version="1",
    title="Fragile",
    summary="",
    inputs=Fragile,
    chapters=(Chapter("Only", steps=(Value(id="result", unit="mm", description="Result", formula=breaking),)),),
)
