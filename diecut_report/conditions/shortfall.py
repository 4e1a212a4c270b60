"""How far rows are from a condition that does not hold: what a search follows to where it does."""

from __future__ import annotations

import numpy as np

from diecut_report.conditions.numpy_emitter import ValueOf, judged, numbers
from diecut_report.conditions.tree import Compared, Joined, Node, is_condition, is_text
from diecut_report.expressions import Array

UNKNOWN = 1.0  # of what holds or does not, without a size, and of what has no value
LEAST = 1e-9  # of what does not hold by next to nothing


def shortfall(node: Node, value_of: ValueOf, count: int) -> Array:
    """Return for each of so many rows 0 where the condition holds, else how far it is from that, as a share of the greater side."""
    holds = judged(node, value_of, count).holds
    with np.errstate(all="ignore"):
        found = np.broadcast_to(_distance(node, value_of, count), (count,))
    return np.where(holds, 0.0, np.maximum(found, LEAST))


def _distance(node: Node, value_of: ValueOf, count: int) -> Array:
    match node:
        case Joined("and", parts):
            return np.asarray(np.sum([shortfall(part, value_of, count) for part in parts], axis=0))
        case Joined(_, parts):
            return np.asarray(np.min([shortfall(part, value_of, count) for part in parts], axis=0))
        case Compared(sign, left, right) if sign != "!=" and not (is_text(left) or is_condition(left)):
            low, high = numbers(left, value_of), numbers(right, value_of)
            share = np.abs(low - high) / np.maximum(np.maximum(np.abs(low), np.abs(high)), np.finfo(float).tiny)
            return np.where(np.isfinite(share), share, UNKNOWN)
    return np.array(UNKNOWN)
