"""How much each varied input moves a quantity: Sobol indices where the sample is made for them, else rank correlation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.batch.saltelli import Saltelli
from diecut_report.batch.sensitivity import sobol_indices
from diecut_report.batch.stored import Column, Stored
from diecut_report.batch.summary.data import number_of

Array = NDArray[Any]
RANKED = 100_000  # variants that a rank correlation looks at
FEWEST = 8  # variants (or points of a Saltelli sample) from which a number says anything
DRAWS, REDRAWN = 50, 20_000  # of the points for the intervals, and of how many
UNSURE = 0.3  # half the width of an interval from which an index says nothing
SURE = 1.96  # standard errors to each side of an interval of 95 %


class Share(NamedTuple):
    """An input's influence: by itself (or its correlation) and in all; half the width of the 95 % interval of each."""

    column: Column
    first: float
    total: float | None = None
    first_error: float | None = None
    total_error: float | None = None

    @property
    def is_certain(self) -> bool:
        """Whether the sample is large enough to tell it."""
        return max(self.first_error or 0.0, self.total_error or 0.0) <= UNSURE


@dataclass(frozen=True)
class Influence:
    """The inputs by their influence on a quantity, the greatest first, and from how many variants that is known."""

    target: Column
    is_sobol: bool
    shares: tuple[Share, ...]
    variants: int

    @property
    def is_certain(self) -> bool:
        """Whether the sample is large enough to tell it."""
        return all(share.is_certain for share in self.shares)


def is_saltelli(stored: Stored) -> bool:
    """Whether the sample has the rows that Sobol indices are made from."""
    return stored.study.get("design") == "saltelli" and int(stored.study.get("n") or 0) > 1


def influences(stored: Stored, targets: Sequence[Column]) -> list[Influence]:
    """The influence of the varied inputs on each target that can be judged."""
    judge = _sobol if is_saltelli(stored) else _ranks
    found = [judge(stored, target) for target in targets if stored.varied]
    return [each for each in found if each is not None]


# --- Sobol indices ---------------------------------------------------------------------------------------------------


def _sobol(stored: Stored, target: Column) -> Influence | None:
    """From the points that lie one after the other in the sample; those of which any variant is missing are left out."""
    inputs = stored.varied
    order = Saltelli(int(stored.study["n"]), tuple(column.name for column in inputs))
    size = order.points * order.size
    found = stored.connection.execute(
        f"SELECT variant, CAST({target.sql} AS DOUBLE) AS f FROM w WHERE {target.sql} IS NOT NULL AND variant < {size}"
    ).fetchnumpy()
    rows, values = np.asarray(found["variant"]), np.full((order.points, order.size), np.nan)
    values[order.point(rows), order.place(rows)] = np.asarray(found["f"])
    values = values[np.isfinite(values).all(axis=1)]
    indices = sobol_indices(values) if len(values) >= FEWEST else None
    if indices is None:
        return None
    errors = _half_widths(values)
    columns = zip(inputs, indices.first.tolist(), indices.total.tolist(), *errors.tolist(), strict=True)
    shares = [Share(*each) for each in columns]
    return Influence(target, True, tuple(sorted(shares, key=lambda s: -(s.total or 0.0))), values.size)


def _half_widths(values: Array) -> Array:
    """Half the widths of the 95 % intervals, of first and total indices, by drawing the points again (bootstrap)."""
    draw = np.random.default_rng(0)
    some = values[:REDRAWN]
    again = [sobol_indices(some[draw.integers(0, len(some), len(some))]) for _ in range(DRAWS)]
    spread = np.array([(each.first, each.total) for each in again if each is not None]).std(axis=0)
    widths: Array = SURE * spread * math.sqrt(len(some) / len(values))
    return widths


# --- rank correlation ------------------------------------------------------------------------------------------------


def _ranks(stored: Stored, target: Column) -> Influence | None:
    """Spearman's rank correlation with each input; for words the correlation ratio of the ranks, which has no sign."""
    inputs = stored.varied
    asked = ", ".join(f"{number_of(stored, column)} AS i{index}" for index, column in enumerate(inputs))
    count = stored.rows(f"SELECT count({target.sql}) FROM w")[0][0]
    every = max(1, math.ceil(count / RANKED))
    drawn = "" if every == 1 else f" AND hash(variant) % {every} = 0"
    sql = f"SELECT CAST({target.sql} AS DOUBLE) AS f, {asked} FROM w WHERE {target.sql} IS NOT NULL{drawn}"
    found = stored.connection.execute(sql).fetchnumpy()
    columns: dict[str, Array] = {
        name: np.ma.filled(np.ma.asarray(column, dtype=float), np.nan) for name, column in found.items()
    }
    goal = columns.pop("f")
    if len(goal) < FEWEST or not np.ptp(goal) > 0:
        return None
    judged = [_share(column, values, goal) for column, values in zip(inputs, columns.values(), strict=True)]
    shares = sorted((share for share in judged if share is not None), key=lambda share: -abs(share.first))
    return Influence(target, False, tuple(shares), len(goal)) if shares else None


def _share(column: Column, values: Array, goal: Array) -> Share | None:
    there = np.isfinite(values)
    values, goal = values[there], goal[there]
    if len(values) < FEWEST or not np.ptp(values) > 0 or not np.ptp(goal) > 0:
        return None
    return Share(column, ratio(values, goal) if column.kind == "text" else correlation(values, goal))


def correlation(one: Array, two: Array) -> float:
    """Spearman's rank correlation."""
    return float(np.corrcoef(ranks(one), ranks(two))[0, 1])


def ratio(groups: Array, goal: Array) -> float:
    """The root of the share of the ranks' variance that lies between the groups."""
    ranked = ranks(goal)
    _, group = np.unique(groups, return_inverse=True)
    means = np.bincount(group, ranked) / np.bincount(group)
    return float(np.sqrt(means[group].var() / ranked.var()))


def ranks(values: Array) -> Array:
    """Ranks from 1; equal values share the mean of theirs."""
    _, place, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    mean: Array = (last - (counts - 1) / 2)[place]
    return mean
