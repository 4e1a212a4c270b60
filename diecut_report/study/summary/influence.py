"""How much each varied input moves a quantity: Sobol indices where the sample is made for them, else partial rank correlation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.study.analysis.sensitivity import sobol_indices
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.sampling.saltelli import Saltelli
from diecut_report.study.summary.data import number_of

Array = NDArray[Any]
RANKED = 100_000  # variants that a rank correlation looks at
FEWEST = 8  # variants (or points of a Saltelli sample) from which a number says anything
DRAWS, REDRAWN = 50, 20_000  # of the points for the intervals, and of how many
UNSURE = 0.3  # half the width of an interval from which an index says nothing
COMPLETE = 0.99  # share of a Saltelli sample that must have results
WEAK = 0.05  # size of a number up to which it is not reported
ALIKE = 0.999  # correlation of ranks from which two inputs are one
SURE = 1.96  # standard errors to each side of an interval of 95 %


class Share(NamedTuple):
    """Hold an input's influence: by itself (or its correlation) and in all; half the width of the 95 % interval of each."""

    column: StoredColumn
    first: float
    total: float | None = None
    first_error: float | None = None
    total_error: float | None = None

    @property
    def is_certain(self) -> bool:
        """Return whether the sample is large enough to tell it."""
        return max(self.first_error or 0.0, self.total_error or 0.0) <= UNSURE

    @property
    def is_telling(self) -> bool:
        """Return whether it is more than next to nothing."""
        return max(abs(self.first), self.total or 0.0) >= WEAK


@dataclass(frozen=True)
class Influence:
    """Hold the inputs by their influence on a quantity, the greatest first, and from how many variants that is known."""

    target: StoredColumn
    is_sobol: bool
    shares: tuple[Share, ...]
    variants: int

    @property
    def is_certain(self) -> bool:
        """Return whether the sample is large enough to tell it."""
        return all(share.is_certain for share in self.shares)

    @property
    def telling(self) -> tuple[Share, ...]:
        """Return the inputs whose influence is more than next to nothing."""
        return tuple(share for share in self.shares if share.is_telling)


def is_saltelli(stored: Stored) -> bool:
    """Return whether the sample has the rows that Sobol indices are made from, and (nearly) all of them could be calculated.

    Where variants that cannot exist or constraints cut into it, its inputs are no longer independent: indices would sum
    to more than 1.
    """
    if stored.study.get("design") != "saltelli" or (points := int(stored.study.get("n") or 0)) < 2:
        return False
    whole = points * (len(stored.varied) + 2)
    return bool(stored.rows("SELECT count(*) FROM v WHERE status <> 'error'")[0][0] >= COMPLETE * whole)


def influences(stored: Stored, targets: Sequence[StoredColumn]) -> list[Influence]:
    """Return the influence of the varied inputs on each target that can be judged."""
    judge = _sobol if is_saltelli(stored) else _ranks
    found = [judge(stored, target) for target in targets if stored.varied]
    return [each for each in found if each is not None]


# --- Sobol indices ---------------------------------------------------------------------------------------------------


def _sobol(stored: Stored, target: StoredColumn) -> Influence | None:
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


# --- partial rank correlation ----------------------------------------------------------------------------------------


def _ranks(stored: Stored, target: StoredColumn) -> Influence | None:
    """The correlation of the ranks of a quantity and of each input, both without what the other inputs explain."""
    goal, columns = _read(stored, target)
    columns = {column: values for column, values in columns.items() if np.isfinite(values).any()}
    there = (
        np.all([np.isfinite(values) for values in columns.values()], axis=0) if columns else np.zeros(len(goal), bool)
    )
    goal = goal[there]
    columns = {column: values[there] for column, values in columns.items()}
    columns = {column: values for column, values in columns.items() if len(values) and np.ptp(values) > 0}
    if len(goal) < FEWEST or not columns or not np.ptp(goal) > 0:
        return None
    found = partial([_terms(column, values) for column, values in columns.items()], ranks(goal))
    known = [(column, value) for column, value in zip(columns, found, strict=True) if value is not None]
    judged = [Share(column, abs(value) if column.kind == "text" else value) for column, value in known]
    shares = sorted(judged, key=lambda share: -abs(share.first))
    return Influence(target, False, tuple(shares), len(goal)) if shares else None


def _read(stored: Stored, target: StoredColumn) -> tuple[Array, dict[StoredColumn, Array]]:
    """A quantity and the inputs of the variants that have it, of many a part."""
    asked = ", ".join(f"{number_of(stored, column)} AS i{index}" for index, column in enumerate(stored.varied))
    count = stored.rows(f"SELECT count({target.sql}) FROM w")[0][0]
    every = max(1, math.ceil(count / RANKED))
    drawn = "" if every == 1 else f" AND hash(variant) % {every} = 0"
    sql = f"SELECT CAST({target.sql} AS DOUBLE) AS f, {asked} FROM w WHERE {target.sql} IS NOT NULL{drawn}"
    found = stored.connection.execute(sql).fetchnumpy()
    columns: list[Array] = [np.ma.filled(np.ma.asarray(column, dtype=float), np.nan) for column in found.values()]
    return columns[0], dict(zip(stored.varied, columns[1:], strict=True))


def _terms(column: StoredColumn, values: Array) -> Array:
    """What stands for an input in the regression: its ranks; for words a column for each but the first."""
    if column.kind != "text":
        return ranks(values)[:, None]
    known = np.unique(values)[1:]
    found: Array = (values[:, None] == known).astype(float)
    return found


def partial(inputs: Sequence[Array], goal: Array) -> list[float | None]:
    """Return the partial correlation of the goal with each input, the others regressed out; for several columns that of their best sum.

    An input that goes with another one shares its influence. None where too few variants are there, or nothing is left of an input.
    """
    wide = [each.shape[1] for each in inputs]
    if len(goal) < 2 * (sum(wide) + 1) + 2:
        return [None] * len(inputs)
    every = np.column_stack([*inputs, goal])
    every = (every - every.mean(axis=0)) / every.std(axis=0)
    triangle: Array = np.asarray(np.linalg.qr(every, mode="r"))  # keeps all sums of products
    ends = np.cumsum([0, *wide])
    parts = [triangle[:, start:end] for start, end in pairwise(ends)]
    return [_partial(parts, index, triangle[:, -1]) for index in range(len(parts))]


def _partial(parts: Sequence[Array], index: int, goal: Array) -> float | None:
    mine = parts[index]
    others = [each for place, each in enumerate(parts) if place != index and not _alike(mine, each)]
    other = np.column_stack(others) if others else np.zeros((len(goal), 0))
    own, left = _without(other, mine), _without(other, goal[:, None])[:, 0]
    size = float(left @ left)
    if (own**2).sum() < 1e-6 * (mine**2).sum() or size < 1e-12 * float(goal @ goal):
        return None
    rest = _without(own, left[:, None])[:, 0]
    share = math.sqrt(max(0.0, 1.0 - float(rest @ rest) / size))
    return math.copysign(share, float(own[:, 0] @ left)) if mine.shape[1] == 1 else share


def _alike(one: Array, two: Array) -> bool:
    """Whether two inputs go up and down together."""
    if one.shape[1] > 1 or two.shape[1] > 1:
        return False
    size = math.sqrt(float((one**2).sum() * (two**2).sum()))
    return abs(float((one * two).sum())) > ALIKE * size


def _without(others: Array, values: Array) -> Array:
    """What a linear regression on the others leaves."""
    left: Array = values - others @ np.linalg.lstsq(others, values, rcond=None)[0] if others.shape[1] else values
    return left


def ranks(values: Array) -> Array:
    """Return ranks from 1; equal values share the mean of theirs."""
    from scipy.stats import rankdata  # slow to import, and not needed for Sobol indices

    found: Array = rankdata(values)
    return found
