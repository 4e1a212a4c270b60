"""How a search went: after each generation what is best so far, or which share of the final front's volume is reached."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.expressions import Array
from diecut_report.optimisation.front import TriedMachines
from diecut_report.study.summary.pareto import best

BEYOND = 1.1  # of the front's size: the corner against which its volume is measured, so that its ends count
MOST = 300  # points of a front of which the volume is taken


@dataclass(frozen=True)
class SearchProgress:
    """Hold for the end of each generation the machines tried so far and what is reached (NaN before the first that is allowed).

    It is the best cost of a single objective, else the volume that the front dominates, as a share of that at the end.
    """

    tried: tuple[int, ...]
    reached: tuple[float, ...]

    @property
    def last_gain(self) -> int:
        """Return how many machines were tried when the last thousandth was gained."""
        final = self.reached[-1] if self.reached else float("nan")
        near = [n for n, value in zip(self.tried, self.reached, strict=True) if abs(value - final) <= 1e-3 * abs(final)]
        return near[0] if near else 0


def progress(there: TriedMachines, rows: int, chunk: int) -> SearchProgress:
    """Return how the search went: ``rows`` machines were proposed, ``chunk`` in a generation."""
    ends = [min(end, rows) for end in range(chunk, rows + chunk, chunk)]
    allowed = there.violations == 0
    if not allowed.any():
        return SearchProgress(tuple(ends), (float("nan"),) * len(ends))
    if there.costs.shape[1] == 1:
        costs = np.where(allowed, there.costs[:, 0], np.inf)
        found = [float(np.min(costs[there.variants < end], initial=np.inf)) for end in ends]
        return SearchProgress(tuple(ends), tuple(value if np.isfinite(value) else float("nan") for value in found))
    return SearchProgress(tuple(ends), tuple(_volumes(there, allowed, ends)))


def _volumes(there: TriedMachines, allowed: Array, ends: list[int]) -> list[float]:
    """The volume after each generation, as a share of the last."""
    fronts: list[Array] = []
    front = np.empty((0, there.costs.shape[1]))
    begin = 0
    for end in ends:
        new = there.costs[allowed & (there.variants >= begin) & (there.variants < end)]
        front = np.concatenate([front, new])
        front = front[best(front)]
        fronts.append(front)
        begin = end
    low, size = front.min(axis=0), np.where(np.ptp(front, axis=0) > 0, np.ptp(front, axis=0), 1.0)
    volumes = [_volume((each - low) / size) for each in fronts]
    return [volume / volumes[-1] if len(each) else float("nan") for volume, each in zip(volumes, fronts, strict=True)]


def _volume(costs: Array) -> float:
    from pymoo.indicators.hv import HV

    inside = costs[(costs < BEYOND).all(axis=1)]
    some = inside[np.linspace(0, len(inside) - 1, MOST).astype(int)] if len(inside) > MOST else inside
    return float(HV(ref_point=np.full(costs.shape[1], BEYOND))(some)) if len(some) else 0.0
