"""Inputs that vary over a cycle, as the results tell them."""

from __future__ import annotations

from typing import Any

from diecut_report.contract.varying import Extremes, Varying
from diecut_report.quantities.formatting import shortest
from diecut_report.quantities.units import unit


def varying(meta: Varying, value: Any, display: str) -> dict[str, Any]:
    """Return what is given in place of a number: extremes, a text, a curve."""
    text = value if isinstance(value, str) else "a curve"
    if isinstance(value, Extremes):
        text = " … ".join(shortest(unit(display).from_si(end)) for end in (value.low, value.high))
    return {"value": text, "unit": meta.parsed_unit.si, "symbol": meta.symbol, "description": meta.description,
            "display": {"text": text, "unit": display if isinstance(value, Extremes) else "1"}}  # fmt: skip
