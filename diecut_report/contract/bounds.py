"""Hard bounds of a quantity, in the unit that it is declared in."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any

import numpy as np

SAME = 1e-15  # share of a bound by which converting a unit and back may move a number
BOUNDS = (("gt", ">"), ("ge", "≥"), ("lt", "<"), ("le", "≤"))
HELD = (operator.gt, operator.ge, operator.lt, operator.le)


def within(shown: Any, limits: Sequence[float | None]) -> Any:
    """Return whether numbers keep the limits, which stand in the order of BOUNDS, each a number or None."""
    shown = as_typed(shown, limits)
    judged = [held(shown, limit) for limit, held in zip(limits, HELD, strict=True) if limit is not None]
    return np.logical_and.reduce(judged or [shown == shown]) if isinstance(shown, np.ndarray) else all(judged)


def as_typed(shown: Any, limits: Sequence[float | None]) -> Any:
    """Return numbers that are a limit but for the rounding of a unit's factor as that limit: 7 % in SI is not quite 0.07 · 100 %."""
    for limit in limits:
        if limit is not None:
            near = np.abs(shown - limit) <= SAME * abs(limit)
            shown = np.where(near, limit, shown) if isinstance(shown, np.ndarray) else limit if near else shown
    return shown
