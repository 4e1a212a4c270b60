"""The range of a diagram's axis as it is declared: its ends, and that what is drawn lies between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from diecut_report.contract.figures import Range, View
from diecut_report.engine.drawable import Undrawable
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import unit

Data = dict[str, Any]
Lines = Sequence[tuple[str, Sequence[float]]]  # how each is called, and its heights
SAME = 1e-12  # of the range: beyond its ends by no more is rounding


def declared(made: Data, limits: Range | None, view: View, lines: Lines) -> Data:
    """Return a panel (or a group, or a polar diagram) with the range that is declared for it, its ends in SI."""
    if limits is None:
        return made
    factor = unit(made["unit"]).factor
    ends = [view[end] if isinstance(end, str) else None if end is None else float(end) * factor for end in limits]
    return checked(made | {"range": ends}, lines)


def of_lines(panel: Data) -> Data:
    """Return a chart's panel; Undrawable where its lines leave the range that it declares."""
    if "range" not in panel:
        return panel
    lines = [(each["label"], [y for y in each["y"] if y is not None]) for each in (*panel["lines"], *panel["fills"])]
    return checked(panel, lines)


def checked(panel: Data, lines: Lines) -> Data:
    """Return a panel with its range; Undrawable where that is empty, or where something drawn lies outside of it."""
    low, high = panel["range"]
    name = panel.get("title") or panel["label"]
    if low is not None and high is not None and not low < high:
        raise Undrawable(
            Phrase(
                "the range of {name} goes from {low} to {high}, which is none",
                name=repr(name),
                low=_told(low, panel),
                high=_told(high, panel),
            )
        )
    room = SAME * max(abs(end) for end in (low, high, 0.0) if end is not None)
    for label, value in _heights(panel, lines):
        if (low is not None and value < low - room) or (high is not None and value > high + room):
            limits = f"{'…' if low is None else _told(low, panel)} to {'…' if high is None else _told(high, panel)}"
            raise Undrawable(
                Phrase(
                    "{label} reaches {value}, outside of the range of {name}, {limits}; widen it",
                    label=label,
                    value=_told(value, panel),
                    name=repr(name),
                    limits=limits,
                )
            )
    return panel


def _heights(panel: Data, lines: Lines) -> Iterator[tuple[str, float]]:
    """What is drawn, with how it is called."""
    for label, values in lines:
        if values:
            yield from ((label, min(values)), (label, max(values)))
    yield from ((mark["label"], mark["y"]) for mark in panel.get("marks", ()))
    yield from ((level["label"], level["value"]) for level in panel.get("levels", ()))


def _told(value: float, panel: Data) -> str:
    return told(value, panel["unit"])
