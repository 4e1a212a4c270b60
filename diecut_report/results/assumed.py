"""What a calculation rests on that is assumed: those first that move a governing check most."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

Data = Mapping[str, Any]
MOVES = 1e-3  # change of a utilisation, by a change of the value by a tenth, below which it does not count


class Assumed(NamedTuple):
    """Name an assumed value by its path, and the governing check (``train.motor``) that it moves most, "" where none is known.

    ``change`` is the greatest change of that check's utilisation when the value changes by a tenth.
    """

    path: str
    check: str = ""
    change: float = 0.0


def ordered(results: Data) -> list[Assumed]:
    """Return the assumed values of a results document: those that move a governing check first, then in the file's order."""
    summary = results.get("summary", {})
    moves = {move["path"]: Assumed(move["path"], move["check"], move["change"]) for move in summary.get("moves", ())}
    found = [moves.get(path, Assumed(path)) for path in summary.get("assumed", ())]
    return sorted(found, key=lambda each: -each.change)
