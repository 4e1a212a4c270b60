"""Checks: demand against limit, margin, utilisation and verdict, for one machine or an array of them."""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np

from diecut_report.contract.checks import Check
from diecut_report.engine import Calculation
from diecut_report.engine.printing.substitution import filled
from diecut_report.quantities.formatting import shown, with_unit
from diecut_report.quantities.units import unit

Data = dict[str, Any]
Status = Literal["pass", "warn", "fail"]
ROUNDING = 1e-12


def check_results(calc: Calculation) -> list[Data]:
    """Each check with demand, limit, margin, utilisation and verdict."""
    return [_check(calc, check) for check in calc.mechanism.checks if applies(calc, check)]


def applies(calc: Calculation, check: Check) -> bool:
    """Whether a check is made. It is left out where an optional input of it is not given, or what it judges is absent."""
    sides = [side for side in (check.demand, check.limit) if isinstance(side, str)]
    there = all(side in calc.values or side in calc.inputs for side in sides) and calc.given.issuperset(check.needs)
    return there and not any(
        calc.steps[s].exists is not None and np.isnan(calc[s][0, 0]) for s in sides if s in calc.steps
    )


def sides(calc: Calculation, check: Check) -> tuple[Any, Any]:
    """Demand and limit of all variants, SI, each of shape (variants, 1)."""
    factor = unit(check.unit).factor
    demand, limit = (
        calc[s] if isinstance(s, str) else np.full((calc.count, 1), s * factor) for s in (check.demand, check.limit)
    )
    return demand, limit


def verdict(check: Check, demand: Any, limit: Any) -> tuple[Any, Any]:
    """Whether the check holds, and its utilisation (NaN where the limit is not above zero), for arrays of variants."""
    with np.errstate(all="ignore"):
        allowed = limit * (1 + check.tolerance)
        held = demand < allowed if check.operator == "<" else demand <= allowed
        return held, np.where(limit > 0, np.divide(demand, limit), np.nan)


def _check(calc: Calculation, check: Check) -> Data:
    demand, limit = (float(side[0, 0]) for side in sides(calc, check))
    if not (math.isfinite(demand) and math.isfinite(limit)):
        raise ValueError(f"check {check.id} compares {demand} with {limit}")
    held, ratio = verdict(check, demand, limit)
    status: Status = "pass" if held else check.severity
    told = _told(demand, limit, check.unit)
    sentence = f"{check.demand_label} {with_unit(*told['demand'].values())}, {check.limit_label} {with_unit(*told['limit'].values())}"
    message = f"{sentence}." if held else f"{sentence}: {filled(calc, check.consequence)}"
    return {
        "id": check.id,
        "title": check.title,
        "status": status,
        "demand": demand,
        "limit": limit,
        "operator": check.operator,
        "unit": unit(check.unit).si,
        "utilisation": None if math.isnan(ratio) else float(ratio),
        "source": check.source,
        "message": message[0].upper() + message[1:],
        "demand_label": check.demand_label,
        "limit_label": check.limit_label,
        **{f"{name}_display": text for name, text in told.items()},
    }


def _told(demand: float, limit: float, display: str) -> dict[str, dict[str, str]]:
    """Demand, limit and margin as texts, with so many digits that the margin can be seen in the two others.

    A demand that is nothing but rounding beside its limit is told as zero.
    """
    demand = 0.0 if abs(demand) < ROUNDING * abs(limit) else demand
    margin = limit - demand
    for digits in range(4, 10):
        texts = [shown(value, display, digits) for value in (demand, limit)]
        seen = (float(texts[1]["text"]) - float(texts[0]["text"])) * unit(display).factor
        if abs(seen - margin) <= 0.05 * abs(margin):
            break
    return {"demand": texts[0], "limit": texts[1], "margin": shown(margin, display)}
