"""A generation calculated: many machines at once, what each costs, and by how much each breaks what is asked."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase
from diecut_report.study.definition.optimise import Optimise
from diecut_report.study.definition.study_file import Study
from diecut_report.study.definition.wanted_results import Objective
from diecut_report.study.execution.variant_rows import Rows, calculate_rows
from diecut_report.study.sampling.variables import Values
from diecut_report.study.storage.description import ResultColumn
from diecut_report.study.storage.state_form import SEARCHED

VIOLATION = ResultColumn(
    SEARCHED, "float", description="By how much limits and constraints are broken in sum; 0 where none is"
)
STATUS, UTILISATION = ".status", ".utilisation"
TOGETHER = 256  # machines of a piece, whatever number of processes there is: equal pieces give equal bytes
MOST, LEAST = 10.0, 1e-3  # that a check adds which fails by far, or by next to nothing
NO_VALUE, NO_MACHINE, NOT_TRIED = (
    1e3,
    1e4,
    2e4,
)  # without an objective; that cannot exist; that break a constraint on inputs


@dataclass(frozen=True)
class GenerationPiece:
    """Hold some machines of a generation: the number of the first, and their values by path."""

    start: int
    values: Mapping[str, Values]

    def __str__(self) -> str:
        return Phrase("machines from {start} on", start=self.start)


@dataclass
class Tried:
    """Hold what came of machines: the columns of those that were calculated, and for all costs and violations.

    ``costs`` are the objectives, less is better, shape (machines, objectives); ``violations`` are 0 where all holds.
    """

    columns: dict[str, Array]
    costs: Array
    violations: Array
    slow: dict[str, str] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)


def asked_of(study: Study) -> Optimise:
    """Return what the study searches for; its command has seen to it that it does."""
    assert study.optimise is not None
    return study.optimise


def pieces(start: int, values: Mapping[str, Values]) -> Iterator[GenerationPiece]:
    """Cut a generation, whose first machine has this number, into equal pieces."""
    count = size(values)
    for part in np.array_split(np.arange(count), max(1, -(-count // TOGETHER))):
        if len(part):
            yield GenerationPiece(start + int(part[0]), rows_of(values, part))


def size(values: Mapping[str, Values]) -> int:
    """Return how many machines there are."""
    return len(next(iter(values.values())))


def rows_of(values: Mapping[str, Values], rows: Array) -> dict[str, Values]:
    """Return some of the machines."""
    return {
        path: column[rows] if isinstance(column, np.ndarray) else [column[row] for row in rows]
        for path, column in values.items()
    }


def broken_inputs(study: Study, values: Mapping[str, Values]) -> Array:
    """Return for each machine by how much it breaks constraints between inputs: such a one is not calculated."""
    early = [constraint for constraint in study.constraints if not constraint.outputs]
    return sum((each.shortfall(values) for each in early), np.zeros(size(values)))


def evaluate(study: Study, piece: GenerationPiece) -> Tried:
    """Calculate the machines of a piece that the constraints between inputs leave, and judge them all."""
    broken = broken_inputs(study, piece.values)
    left = np.flatnonzero(broken == 0)
    values = rows_of(piece.values, left)
    rows = calculate_rows(study.base, {study.inputs[p]: v for p, v in values.items()}, len(left), study.curves)
    known = {**values, **rows.columns}
    violation = _violation(study, rows, known)
    costs = np.zeros((len(broken), len(asked_of(study).objectives)))
    costs[left] = costs_of(known, asked_of(study).objectives, len(left))
    violations = np.where(broken > 0, NOT_TRIED + broken, 0.0)
    violations[left] = violation
    costs[violations > 0] = 0.0
    kept = {name: column for name, column in rows.columns.items() if _is_kept(study, name)}
    inputs = {path: np.asarray(v, dtype=float if isinstance(v, np.ndarray) else object) for path, v in values.items()}
    found = {"variant": piece.start + left} | inputs | kept | {VIOLATION.name: violation}
    found |= {"status": rows.status, "governing": rows.governing, "error": rows.errors}
    return Tried(found, costs, violations, rows.slow, rows.broken)


def costs_of(known: Mapping[str, Values], objectives: Sequence[Objective], count: int) -> Array:
    """Return the objectives of machines, less is better; NaN where one has no value."""
    absent = np.full(count, np.nan)
    found = [
        np.asarray(known.get(each.output, absent), dtype=float) * (1 if each.minimise else -1) for each in objectives
    ]
    return np.stack(found, axis=1)


def _violation(study: Study, rows: Rows, known: Mapping[str, Values]) -> Array:
    """By how much calculated machines break what is asked."""
    found = failing(rows.columns, rows.count) if asked_of(study).is_passing else np.zeros(rows.count)
    absent = np.full(rows.count, None, dtype=object)
    for constraint in study.constraints:
        if constraint.outputs:
            named = {name: known.get(name, absent) for name in constraint.outputs}
            found = found + constraint.shortfall({**known, **named})
    without = ~np.isfinite(costs_of(known, asked_of(study).objectives, rows.count)).all(axis=1)
    found = np.where(without, found + NO_VALUE, found)
    return np.where(rows.status == "error", NO_MACHINE, found)


def failing(known: Mapping[str, Array], count: int) -> Array:
    """Return for each machine how far its failing checks are beyond their limits, in sum."""
    found = np.zeros(count)
    for name in known:
        if ".checks." in name and name.endswith(STATUS):
            used = np.asarray(known[name.removesuffix(STATUS) + UTILISATION], dtype=float) - 1
            beyond = np.clip(np.nan_to_num(used, nan=MOST, posinf=MOST), LEAST, MOST)
            found += np.where(known[name] == "fail", beyond, 0.0)
    return found


def _is_kept(study: Study, name: str) -> bool:
    return study.outputs is None or ".checks." in name or name in study.outputs or name in study.curves


def joined(tried: Sequence[Tried]) -> Tried:
    """Return pieces as one; a column that some of them lack holds nothing there."""
    kinds = {name: column.dtype for each in tried for name, column in each.columns.items()}
    found = {name: np.concatenate([_column(each, name, kind) for each in tried]) for name, kind in kinds.items()}
    return Tried(
        found, np.concatenate([each.costs for each in tried]), np.concatenate([each.violations for each in tried]),
        {k: v for each in tried for k, v in each.slow.items()}, {k: v for each in tried for k, v in each.broken.items()},
    )  # fmt: skip


def _column(each: Tried, name: str, kind: np.dtype[np.generic]) -> Array:
    if name in each.columns:
        return each.columns[name]
    return np.full(len(each.columns["status"]), None if kind.kind == "O" else np.nan, dtype=kind)
