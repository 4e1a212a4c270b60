"""A check: what is demanded against what limits it, always as ``demand ≤ limit``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, kw_only=True, eq=False)
class Check:
    """``demand`` ≤ ``limit`` (ids of numbers, or plain numbers in ``unit``).

    The utilisation is demand / limit, and null where the limit is not above zero.

    For an upper bound the demand is the machine's and the limit the allowed value; for a lower bound the demand is
    what is required and the limit what there is, so that the utilisation is required / available.
    ``severity`` "warn" makes a failing check a warning. ``consequence`` says what a failure means and what to change.
    """

    id: str
    title: str
    demand: str | float
    limit: str | float
    unit: str
    demand_label: str
    limit_label: str
    consequence: str
    source: str = ""
    operator: Literal["<=", "<"] = "<="
    severity: Literal["fail", "warn"] = "fail"
    tolerance: float = 0.0
    needs: tuple[str, ...] = ()
