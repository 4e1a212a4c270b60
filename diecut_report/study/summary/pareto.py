"""The variants that no other beats in all objectives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.languages.speech import say
from diecut_report.study.analysis.near_equality import rounded
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.summary.quantity_names import named

Array = NDArray[Any]
BLOCK, MOST = 2_000, 20_000  # variants compared at a time; on a front
FIRST = 10  # variants that are best by a single objective


@dataclass(frozen=True)
class StoredObjective:
    """Name a quantity that is to be small or great."""

    column: StoredColumn
    is_less: bool

    @property
    def told(self) -> str:
        """Return the objective in words."""
        told = named(self.column)
        return say("least {quantity}", quantity=told) if self.is_less else say("greatest {quantity}", quantity=told)


@dataclass(frozen=True)
class Front:
    """Hold the best variants in the order of the first objective: their numbers, objectives (SI, a column each), and among how many.

    ``is_passing`` says that only variants without a failing check were compared; ``is_cut`` that the front is longer than kept.
    """

    objectives: tuple[StoredObjective, ...]
    variants: Array
    values: Array
    among: int
    is_passing: bool
    is_cut: bool


def objectives(stored: Stored) -> tuple[StoredObjective, ...]:
    """Return the study's objectives, as far as numbers are stored for them."""
    found = []
    for given in stored.study.get("objectives") or ():
        for direction, name in given.items():
            column = stored.columns.get(name)
            if column is not None and column.is_number:
                found.append(StoredObjective(column, direction == "minimise"))
    return tuple(found)


def front(stored: Stored, wanted: tuple[StoredObjective, ...], passing: int) -> Front | None:
    """Return the front of the variants that do not fail; of all calculated ones where all fail. None without objectives or variants.

    By a single objective it is the first ten.
    """
    if not wanted:
        return None
    states = "('pass', 'warn')" if passing else "('fail')"
    names = ", ".join(f"CAST({objective.column.sql} AS DOUBLE)" for objective in wanted)
    there = " AND ".join(f"{objective.column.sql} IS NOT NULL" for objective in wanted)
    found = stored.connection.execute(
        f"SELECT variant, {names} FROM v WHERE status IN {states} AND {there}"
    ).fetchnumpy()
    columns = [np.asarray(column) for column in found.values()]
    variants, values = columns[0], np.column_stack([column.astype(float) for column in columns[1:]])
    if not len(variants):
        return None
    costs = rounded(values) * np.array([1.0 if objective.is_less else -1.0 for objective in wanted])
    kept = best(costs) if len(wanted) > 1 else np.lexsort((variants, costs[:, 0]))[:FIRST]
    order = kept[np.lexsort((variants[kept], costs[kept, 0]))]
    return Front(wanted, variants[order], values[order], len(variants), bool(passing), len(kept) >= MOST)


def best(costs: Array) -> Array:
    """Return the indices of the rows of which no other row is nowhere greater and somewhere less; equal rows stay together."""
    order = np.lexsort(costs.T[::-1])
    kept = np.zeros(0, dtype=int)
    for start in range(0, len(order), BLOCK):
        block = order[start : start + BLOCK]
        block = block[~_beaten(costs[block], costs[kept])]
        block = block[~_beaten(costs[block], costs[block])]
        kept = np.concatenate([kept, block])
        if len(kept) >= MOST:
            return kept[:MOST]
    return kept


def _beaten(rows: Array, others: Array) -> Array:
    """Which rows some other row dominates."""
    found = np.zeros(len(rows), dtype=bool)
    for start in range(0, len(others), BLOCK):
        part = others[start : start + BLOCK]
        nowhere = np.ones((len(rows), len(part)), dtype=bool)
        somewhere = np.zeros_like(nowhere)
        for mine, theirs in zip(rows.T, part.T, strict=True):
            nowhere &= theirs <= mine[:, None]
            somewhere |= theirs < mine[:, None]
        found |= (nowhere & somewhere).any(axis=1)
    return found
