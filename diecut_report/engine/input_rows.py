"""Inputs of repeated parts as the engine holds them."""

from __future__ import annotations

from typing import Any

import numpy as np


def row(value: tuple[Any, ...], variants: int) -> Any:
    """Return the inputs of repeated parts as an array (variants, parts); as they are where some part has no number."""
    if not all(isinstance(v, int | float | np.ndarray | np.number) and not isinstance(v, bool) for v in value):
        return value  # texts, curves, what some parts leave out
    return np.stack([np.broadcast_to(np.asarray(v, dtype=float), (variants,)) for v in value], axis=1)
