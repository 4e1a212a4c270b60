"""The best variants, what moves a quantity, and the utilisation matrix: single variants and inputs, as tables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.study.analysis.answers import rounded
from diecut_report.study.analysis.variants import Stored, StoredColumn
from diecut_report.study.summary import data
from diecut_report.text.translation import said, say

# The variants that no other beats in all objectives.


Array = NDArray[Any]
BLOCK, MAX_FRONT = 2_000, 20_000  # variants compared at a time; on a front
FIRST = 10  # variants that are best by a single objective


@dataclass(frozen=True)
class StoredObjective:
    """Name a quantity that is to be small or great."""

    column: StoredColumn
    is_less: bool

    @property
    def label(self) -> str:
        return say("{quantity} minimised" if self.is_less else "{quantity} maximised", quantity=data.named(self.column))


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
    given = [each for entry in stored.study.get("objectives") or () for each in entry.items()]
    known = [(stored.columns[name], way == "minimise") for way, name in given if name in stored.columns]
    return tuple(StoredObjective(column, is_less) for column, is_less in known if column.is_number)


def front(stored: Stored, wanted: tuple[StoredObjective, ...], passing: int) -> Front | None:
    """Return the front of the variants that do not fail; of all calculated ones where all fail. None without objectives or variants.

    By a single objective it is the first ten.
    """
    if not wanted:
        return None
    names = ", ".join(f"CAST({objective.column.sql} AS DOUBLE)" for objective in wanted)
    there = " AND ".join(f"{objective.column.sql} IS NOT NULL" for objective in wanted)
    among = data.SOUND if passing else "status = 'fail'"
    found = stored.connection.execute(f"SELECT variant, {names} FROM v WHERE {among} AND {there}").fetchnumpy()
    variants, *columns = (np.asarray(column) for column in found.values())
    if not len(variants):
        return None
    values = np.column_stack([column.astype(float) for column in columns])
    costs = rounded(values) * np.array([1.0 if objective.is_less else -1.0 for objective in wanted])
    kept = pareto_best(costs) if len(wanted) > 1 else np.lexsort((variants, costs[:, 0]))[:FIRST]
    order = kept[np.lexsort((variants[kept], costs[kept, 0]))]
    return Front(wanted, variants[order], values[order], len(variants), bool(passing), len(kept) >= MAX_FRONT)


def pareto_best(costs: Array) -> Array:
    """Return the indices of the rows of which no other row is nowhere greater and somewhere less; equal rows stay together."""
    order = np.lexsort(costs.T[::-1])
    kept = np.zeros(0, dtype=int)
    for start in range(0, len(order), BLOCK):
        block = order[start : start + BLOCK]
        block = block[~_beaten(costs[block], costs[kept])]
        block = block[~_beaten(costs[block], costs[block])]
        kept = np.concatenate([kept, block])
        if len(kept) >= MAX_FRONT:
            return kept[:MAX_FRONT]
    return kept


def _beaten(rows: Array, others: Array) -> Array:
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


# How much each varied input moves a quantity: Sobol indices where the sample is made for them, else partial rank correlation.


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
    """Judge by the points that lie one after the other in the sample; those of which any variant is missing are left out."""
    inputs = stored.varied
    points, size = int(stored.study["n"]), len(inputs) + 2  # see `Sobol` for the rows of a point
    sql = f"SELECT variant, CAST({target.sql} AS DOUBLE) AS f FROM w WHERE {target.sql} IS NOT NULL"
    found = stored.connection.execute(f"{sql} AND variant < {points * size}").fetchnumpy()
    column = np.full(points * size, np.nan)
    column[np.asarray(found["variant"])] = np.asarray(found["f"])
    values = column.reshape(points, size)
    values = values[np.isfinite(values).all(axis=1)]
    indices = sobol_indices(values) if len(values) >= FEWEST else None
    if indices is None:
        return None
    columns = zip(inputs, *indices.tolist(), *_half_widths(values).tolist(), strict=True)
    shares = sorted((Share(*each) for each in columns), key=lambda share: -(share.total or 0.0))
    return Influence(target, True, tuple(shares), values.size)


def sobol_indices(values: Array) -> Array | None:
    """Return first and total indices, shape (2, paths), from the values of a quantity, (points, paths + 2) in the order of `Sobol`.

    They say what part of the variance an input causes alone, and in what part it takes part at all: by Saltelli et al. 2010,
    Computer Physics Communications 181, 259–270, table 2 (b), and by Jansen 1999, Computer Physics Communications 117, 35–43 (table
    2 (f) there). Both are estimates and may lie a little outside 0 … 1. A point of which any value is missing is left out whole, since
    its rows only count together. None where fewer than two points remain or the quantity is the same in all of them.
    """
    complete = values[np.isfinite(values).all(axis=1)]
    if len(complete) < 2:
        return None
    both = complete[:, :2]
    scale, middle, variance = np.abs(both).max(), both.mean(), both.var()
    if variance <= (1e-14 * scale) ** 2:
        return None
    a, b, ab = complete[:, :1] - middle, complete[:, 1:2] - middle, complete[:, 2:] - middle
    first = (b * (ab - a)).mean(axis=0) / variance
    total = ((a - ab) ** 2).mean(axis=0) / (2 * variance)
    return np.array([first, total])


def _half_widths(values: Array) -> Array:
    """Return half the widths of the 95 % intervals, of first and total indices, by drawing the points again (bootstrap)."""
    draw = np.random.default_rng(0)
    some = values[:REDRAWN]
    again = [sobol_indices(some[draw.integers(0, len(some), len(some))]) for _ in range(DRAWS)]
    spread = np.array([each for each in again if each is not None]).std(axis=0)
    return np.asarray(SURE * spread * math.sqrt(len(some) / len(values)))


# --- partial rank correlation ----------------------------------------------------------------------------------------


def _ranks(stored: Stored, target: StoredColumn) -> Influence | None:
    """Judge by the correlation of the ranks of a quantity and of each input, both without what the other inputs explain."""
    goal, columns = _read(stored, target)
    columns = {column: values for column, values in columns.items() if np.isfinite(values).any()}
    there = np.logical_and.reduce([np.isfinite(values) for values in columns.values()]) & np.ones(len(goal), bool)
    goal = goal[there]
    if len(goal) < FEWEST or not np.ptp(goal) > 0:
        return None
    columns = {column: values[there] for column, values in columns.items() if np.ptp(values[there]) > 0}
    if not columns:
        return None
    found = partial([_terms(column, values) for column, values in columns.items()], ranks(goal))
    known = [(column, value) for column, value in zip(columns, found, strict=True) if value is not None]
    judged = [Share(column, abs(value) if column.kind == "text" else value) for column, value in known]
    shares = sorted(judged, key=lambda share: -abs(share.first))
    return Influence(target, False, tuple(shares), len(goal)) if shares else None


def _read(stored: Stored, target: StoredColumn) -> tuple[Array, dict[StoredColumn, Array]]:
    asked = ", ".join(f"{data.number_of(stored, column)} AS i{index}" for index, column in enumerate(stored.varied))
    count = stored.rows(f"SELECT count({target.sql}) FROM w")[0][0]
    every = max(1, math.ceil(count / RANKED))
    drawn = "" if every == 1 else f" AND hash(variant) % {every} = 0"
    sql = f"SELECT CAST({target.sql} AS DOUBLE) AS f, {asked} FROM w WHERE {target.sql} IS NOT NULL{drawn}"
    found = stored.connection.execute(sql).fetchnumpy()
    columns: list[Array] = [np.ma.filled(np.ma.asarray(column, dtype=float), np.nan) for column in found.values()]
    return columns[0], dict(zip(stored.varied, columns[1:], strict=True))


def _terms(column: StoredColumn, values: Array) -> Array:
    """Return what stands for an input in the regression: its ranks; for words a column for each but the first."""
    return (values[:, None] == np.unique(values)[1:]).astype(float) if column.kind == "text" else ranks(values)[:, None]


def partial(inputs: Sequence[Array], goal: Array) -> list[float | None]:
    """Return the partial correlation of the goal with each input, the others regressed out; for several columns that of their best sum.

    An input that goes with another one shares its influence. None where too few variants are there, or nothing is left of an input.
    """
    wide = [each.shape[1] for each in inputs]
    if len(goal) < 2 * sum(wide) + 4:
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
    own, left = _residual(other, mine), _residual(other, goal[:, None])[:, 0]
    size = float(left @ left)
    if (own**2).sum() < 1e-6 * (mine**2).sum() or size < 1e-12 * float(goal @ goal):
        return None
    rest = _residual(own, left[:, None])[:, 0]
    share = math.sqrt(max(0.0, 1.0 - float(rest @ rest) / size))
    return math.copysign(share, float(own[:, 0] @ left)) if mine.shape[1] == 1 else share


def _alike(one: Array, two: Array) -> bool:
    if one.shape[1] > 1 or two.shape[1] > 1:
        return False
    size = math.sqrt(float((one**2).sum() * (two**2).sum()))
    return abs(float((one * two).sum())) > ALIKE * size


def _residual(others: Array, values: Array) -> Array:
    return np.asarray(values - others @ np.linalg.lstsq(others, values, rcond=None)[0] if others.shape[1] else values)


def ranks(values: Array) -> Array:
    """Return ranks from 1; equal values share the mean of theirs."""
    from scipy.stats import rankdata  # slow to import, and not needed for Sobol indices

    return np.asarray(rankdata(values))


# The utilisation matrix: chosen variants against all checks, each with the way to its full report.


ALL, REPORTED, BEST, WORST_ONES = 80, 15, 15, 10  # rows: up to which all variants stand, else of each sort
ACROSS = 14  # checks in a table
MAX_REPORTS = 200  # links to full reports
IDLE = 0.1  # utilisation that a check of the matrix reaches in some variant
MAX_INPUTS = 6  # columns of inputs in the table of the best


class MatrixCell(NamedTuple):
    """Hold a utilisation as text, and its class: u0 … u4 by size, ``none`` without one; ``is_failing`` by the check's status."""

    text: str
    sort: str
    is_failing: bool


class MatrixRow(NamedTuple):
    """Hold a variant: its number, the file of its full report (or nothing), its status, and in the matrix its cells."""

    variant: int
    href: str
    status: str
    cells: Sequence[MatrixCell] = ()


class Matrix(NamedTuple):
    """Hold part of the matrix: numbers and names of its checks, and its rows in groups, each with a title that says why."""

    checks: list[tuple[int, str]]
    groups: list[tuple[str, list[MatrixRow]]]

    @property
    def rows(self) -> list[MatrixRow]:
        return [row for _, rows in self.groups for row in rows]


class Best(NamedTuple):
    """Hold a variant on the front: number, report, status, greatest utilisation and whose it is, and objectives and inputs as texts."""

    variant: int
    href: str
    status: str
    utilisation: str
    governing: str
    values: list[str]


def report_of(folder: Path, variant: int) -> str:
    """Return the full report of a variant, from the summary's place, if there is one."""
    files = (f"reports/{variant}.{ending}" for ending in ("html", "pdf"))
    return next((file for file in files if (folder / file).is_file()), "")


def reported(folder: Path) -> list[int]:
    """Return the variants that have a full report."""
    files = (folder / "reports").glob("*.*") if (folder / "reports").is_dir() else []
    return sorted({int(file.stem) for file in files if file.stem.isdecimal() and file.suffix in (".html", ".pdf")})


def chosen(stored: Stored, total: int, best: Sequence[int]) -> list[tuple[str, list[int]]]:
    """Return the best first, then those with reports, then the most overloaded; of a small study all variants. Each stands once."""
    is_single = len(stored.study.get("objectives") or ()) == 1
    first = say("Best: first by the objective") if is_single else say("Best: on the Pareto front")
    groups = [_cut(first, best, BEST)]
    if total <= ALL:
        order = "NULLS LAST, variant"
        groups += [
            (say("Other passing variants, largest margin first"), _numbers(stored, data.SOUND, order)),
            (say("Failing variants, least overloaded first"), _numbers(stored, "status = 'fail'", order)),
            (say("Impossible variants"), _numbers(stored, "status = 'error'", order)),
        ]
    else:
        overloaded = say("Fail: the {n} most overloaded variants", n=WORST_ONES)
        order = f"DESC NULLS FIRST, variant LIMIT {WORST_ONES}"
        groups.append(_cut(say("Others with a full report"), reported(stored.folder), REPORTED))
        groups.append((overloaded, _numbers(stored, "status = 'fail'", order)))
    return list(_once(groups))


def _cut(title: str, variants: Sequence[int], most: int) -> tuple[str, list[int]]:
    if len(variants) > most:
        title = say("{title} (the first {most} of {n})", title=title, most=most, n=len(variants))
    return title, list(variants[:most])


def _numbers(stored: Stored, where: str, order: str) -> list[int]:
    return [
        number for (number,) in stored.rows(f"SELECT variant FROM w WHERE {where} ORDER BY {data.WORST.sql} {order}")
    ]


def _once(groups: Iterable[tuple[str, list[int]]]) -> Iterator[tuple[str, list[int]]]:
    known: set[int] = set()
    for title, variants in groups:
        new = [variant for variant in variants if variant not in known]
        known |= set(new)
        if new:
            yield title, new


def telling(used: Sequence[data.Utilisation]) -> list[data.Utilisation]:
    """Return the checks that stand in the matrix: those that do not always pass with ease."""
    return [row for row in used if row.failing or row.warning or (row.greatest or 0.0) > IDLE]


def _of_variants(stored: Stored, variants: Iterable[int], asked: Sequence[str]) -> dict[int, tuple[Any, ...]]:
    listed = ", ".join(map(str, variants)) or "NULL"
    rows = stored.rows(f"SELECT {', '.join(['variant', *asked])} FROM w WHERE variant IN ({listed})")
    return {number: tuple(values) for number, *values in rows}


def matrices(stored: Stored, groups: Sequence[tuple[str, list[int]]], checks: Sequence[str]) -> Iterator[Matrix]:
    """Yield the matrix in parts that fit on paper."""
    for start in range(0, len(checks), ACROSS):
        part = list(checks[start : start + ACROSS])
        numbers = [(start + index + 1, said(stored.check_label(name))) for index, name in enumerate(part)]
        asked = ["status", *(column.sql for check in part for column in stored.checks[check])]
        rows = _of_variants(stored, [variant for _, some in groups for variant in some], asked)
        found = [(title, [_row(stored, one, *rows[one]) for one in some if one in rows]) for title, some in groups]
        yield Matrix(numbers, [(title, some) for title, some in found if some])


def _row(stored: Stored, variant: int, status: str, *values: Any) -> MatrixRow:
    cells = [_cell(value, made) for value, made in zip(values[::2], values[1::2], strict=True)]
    return MatrixRow(variant, report_of(stored.folder, variant), status, cells)


def _cell(value: float | None, made: str | None) -> MatrixCell:
    failing = made == "fail"
    if value is None:
        return MatrixCell("✗" if failing else "–" if made is None else "✓", "u4" if failing else "none", failing)
    return MatrixCell(data.utilised(value), f"u{sum(value > limit for limit in data.BANDS)}", failing)


def columns(stored: Stored, goals: Sequence[StoredObjective]) -> list[StoredColumn]:
    """Return objectives and inputs that the table of the best shows."""
    return list(dict.fromkeys([*(goal.column for goal in goals), *stored.varied[:MAX_INPUTS]]))


def best(stored: Stored, variants: Sequence[int], shown: Sequence[StoredColumn]) -> list[Best]:
    """Return the rows of that table, in the order of the variants."""
    rows = _of_variants(stored, variants, ["status", data.WORST.sql, "governing", *(column.sql for column in shown)])
    found = []
    for one in variants:
        status, worst, governing, *values = rows[one]
        used = "–" if worst is None else data.utilised(worst)
        check = said(stored.check_label(governing)) if governing else ""
        texts = [
            "–" if value is None else data.display(float(value), column) if column.is_number else data.value_text(value)
            for value, column in zip(values, shown, strict=True)
        ]
        found.append(Best(one, report_of(stored.folder, one), status, used, check, texts))
    return found


def reports(stored: Stored, variants: Sequence[int]) -> list[MatrixRow]:
    states = _of_variants(stored, variants, ["status"])
    return [MatrixRow(one, report_of(stored.folder, one), *states[one]) for one in variants if one in states]
