"""A plugin that can be loaded, but whose calculation raises."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, computed


class Fragile(Inputs):
    length = Quantity("l", "mm", "Length", gt=0, default=10)


def breaking(length: Any) -> Any:
    raise RuntimeError("the plugin fell over")


only = Chapter("Only")
only.result = computed(breaking, takes=("length",), method="none"), "r", "mm", "Result"

MECHANISM = Mechanism(
    kind="breaks_in_calculation",
    version="1",
    title="Fragile",
    summary="",
    inputs=Fragile,
    chapters=(only,),
)
