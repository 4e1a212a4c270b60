"""The data of charts: lines, areas and marks over an abscissa of any kind, all in SI."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from diecut_report.expressions import Array
from diecut_report.quantities.formatting import si

Data = dict[str, Any]
Values = Sequence[float] | Array


def chart_panel(
    title: str,
    unit: str,
    x_title: str,
    x_symbol: str,
    x_unit: str,
    *,
    lines: Sequence[Data],
    fills: Sequence[Data] = (),
    marks: Sequence[Data] = (),
    levels: Sequence[Data] = (),
    verticals: Sequence[Data] = (),
    range: tuple[float | None, float | None] | None = None,
    over: str = "",
) -> Data:
    """Return one diagram of a chart; ``unit`` and ``x_unit`` are display units, ``title`` says what stands upwards.

    ``range`` is that of the upright axis, (0, None), in ``unit``; None for an end that follows from the lines. ``over`` names
    the abscissa of the machine's curves whose places these are, or whole turns off: on a screen they share its cursor.
    """
    limits: Data = {"range": [None if end is None else si(end, unit) for end in range]} if range else {}
    limits |= {"over": over} if over else {}
    return {"title": title, "unit": unit, "x": {"title": x_title, "symbol": x_symbol, "unit": x_unit},
            "lines": list(lines), "fills": list(fills), "marks": list(marks), "levels": list(levels),
            "verticals": list(verticals), **limits}  # fmt: skip


def line(x: Values, y: Values, label: str) -> Data:
    """Return a line; it is broken where a value is NaN."""
    return {"x": _plain(x), "y": _plain(y), "label": label}


def fill(x: Values, y: Values, label: str) -> Data:
    """Return the area between a line and zero."""
    return line(x, y, label)


def mark(x: float, y: float, label: str) -> Data:
    """Return a marked point."""
    return {"x": float(x), "y": float(y), "label": label}


def level(y: float, label: str) -> Data:
    """Return a horizontal line."""
    return {"value": float(y), "label": label}


def vertical(x: float, label: str) -> Data:
    """Return a vertical line."""
    return {"x": float(x), "label": label}


def _plain(values: Values) -> list[float | None]:
    """Numbers as results hold them, null where there is none."""
    numbers = np.asarray(values, dtype=float)
    plain = numbers.astype(object)
    plain[~np.isfinite(numbers)] = None
    return list(plain)
