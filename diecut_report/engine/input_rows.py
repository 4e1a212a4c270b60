"""Inputs as the engine holds them: those of repeated parts, and single ones."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.contract.varying import Extremes


def row(value: tuple[Any, ...], variants: int) -> Any:
    """Return the inputs of repeated parts as an array (variants, parts); as they are where some part has no number."""
    if not all(isinstance(v, int | float | np.ndarray | np.number) and not isinstance(v, bool) for v in value):
        return value  # texts, curves, what some parts leave out
    return np.stack([np.broadcast_to(np.asarray(v, dtype=float), (variants,)) for v in value], axis=1)


def alone(value: Any, variants: int) -> Any:
    """Return a single input as an array (variants, 1), of which only extremes are known as these."""
    return value if isinstance(value, Extremes) else np.full((variants, 1), value, dtype=float)


def column(value: Any, variants: int) -> Any:
    """Return an input as an array (variants, 1) or (variants, parts); texts, flags, curves and whole mechanisms stay as they are."""
    match value:
        case bool() | str():
            return value
        case tuple():
            return row(value, variants)
        case np.ndarray():
            return np.ascontiguousarray(value, dtype=float).reshape(variants, -1)
        case int() | float() | np.number():
            return alone(value, variants)
    return value
