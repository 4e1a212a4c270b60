"""What an optimisation has found as plain data, in SI."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from diecut_report.optimisation.bounds import InputPlace
from diecut_report.optimisation.recheck import Recheck
from diecut_report.optimisation.result import OptimisationResult

Data = dict[str, Any]


def data(found: OptimisationResult) -> Data:
    """Return all of it: objectives, counts, the whole front, what is suggested, where it lies, how it was found and proved."""
    front = found.front
    columns = {column.name: column for column in (*(goal.column for goal in front.objectives), *front.varied)}
    return {
        "study": found.stored.description.study.file,
        "objectives": [{"minimise" if goal.is_less else "maximise": goal.column.name} for goal in front.objectives],
        "units": {name: column.unit for name, column in columns.items() if column.is_number},
        "tried": found.tried,
        "calculated": found.calculated,
        "allowed": front.allowed,
        "errors": found.errors,
        "dropped": found.dropped,
        "front": list(_points(found)),
        "suggested": None if front.suggested is None else int(front.variants[front.suggested]),
        "today": front.today,
        "bounds": [_place(each) for each in found.bounds],
        "progress": [
            {"tried": tried, "reached": _number(reached)}
            for tried, reached in zip(found.progress.tried, found.progress.reached, strict=True)
        ],
        "recheck": [_recheck(each) for each in found.rechecks],
        "conflict": _conflict(found),
    }


def _points(found: OptimisationResult) -> Iterator[Data]:
    front, listed = found.front, set(found.front.listed)
    for place, variant in enumerate(front.variants):
        values = {goal.column.name: _plain(front.values[place, n]) for n, goal in enumerate(front.objectives)}
        inputs = {path: _plain(column[place]) for path, column in front.inputs.items()}
        verdict = {"status": front.status[place], "governing": front.governing[place]}
        yield {"variant": int(variant), **verdict, "listed": place in listed, "values": {**values, **inputs}}


def _place(each: InputPlace) -> Data:
    if each.is_text:
        return {"input": each.column.name, "count": each.count, "values": dict(each.counts)}
    ends = {"from": each.low, "to": each.high, "at_from": each.at_low, "at_to": each.at_high}
    return {"input": each.column.name, "count": each.count, **ends}


def _recheck(each: Recheck) -> Data:
    told = {"variant": each.variant, "status": each.status, "alone": each.alone, "same": each.is_same}
    return told | {"differs": each.name or None, "share": _number(each.share), "fault": each.fault or None}


def _conflict(found: OptimisationResult) -> Data | None:
    why = found.conflict
    if why is None:
        return None
    failing = {name: _number(used) for name, used in why.failing}
    return {"together": list(why.together), "nearest": why.nearest, "failing": failing, "reason": why.reason or None}


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _plain(value: Any) -> Any:
    return value.item() if hasattr(value, "item") else value
