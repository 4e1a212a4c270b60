"""Inputs that a mechanism takes from others by itself: nobody typed them, and each stands in the chapter that gives it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from diecut_report.report.model import QuantityRow

Data = Mapping[str, Any]


class TakenGroup(NamedTuple):
    """What is taken from one mechanism, the id there as key of each row; ``basis`` is what all of it rests on."""

    home: str
    basis: str
    rows: list[QuantityRow]


def is_taken(row: Data) -> bool:
    """Return whether an input is a number or a curve of another mechanism that nobody asked for by a reference."""
    return row["origin"] == "reference" and not row.get("text") and "." in row.get("path", "")


def is_partner(row: Data) -> bool:
    """Return whether an input is a mechanism that was found, not typed."""
    is_name = isinstance(row["value"], str) and not row.get("text") and "part" not in row
    return is_name and (row["origin"] == "given" or row.get("path") == row["value"])


def taken_groups(rows: Iterable[tuple[str, QuantityRow]]) -> list[TakenGroup]:
    """Return the rows, given with the paths that they are taken from, by the mechanisms that give them."""
    found: dict[str, list[QuantityRow]] = {}
    for path, row in rows:
        home, _, name = path.partition(".")
        found.setdefault(home, []).append(replace(row, key=name))
    return [_group(home, own) for home, own in found.items()]


def _group(home: str, rows: list[QuantityRow]) -> TakenGroup:
    bases = {row.origin for row in rows}
    if len(bases) > 1:
        return TakenGroup(home, "", rows)
    return TakenGroup(home, rows[0].origin, [replace(row, origin="") for row in rows])
