"""How numbers were found, in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from diecut_report.contract.steps import CurvePeriod
from diecut_report.engine.calculation import Calculation
from diecut_report.languages.phrases import Phrase

EQUAL_TERMS = "the terms are equal up to the rounding of the computer, or so nearly that printed numbers do not show it"
TO_ROUNDING = "0 up to the rounding of the computer"
METHODS = {
    "root": "bracketed root search, proved by the relation shown, which was not used to find it",
    "max": "bounded search on the curve within each smooth piece, one-sided limits at the breakpoints included",
    "mean": "Gauss–Legendre between the breakpoints, repeated with the doubled order",
    "derivative": "Chebyshev series between the breakpoints, differentiated; the series is compared with the curve at other places",
    "accumulated": "Chebyshev series between the breakpoints, integrated; its end compared with Gauss–Legendre",
}


def period(calc: Calculation, step: CurvePeriod) -> str:
    """Return that a number is the period of a curve."""
    return Phrase("the period of {symbol}", symbol=calc.meta[step.given].symbol)


def said_rounded(calc: Calculation, items: Iterable[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """Yield items; of a number that is printed as 0, but is what rounding left, a note says so."""
    for item in items:
        is_zero = item.get("result", {}).get("text") == "0" and item["id"] not in calc.axis and "note" not in item
        yield item | {"note": TO_ROUNDING} if is_zero and calc[item["id"]][0, 0] else item
