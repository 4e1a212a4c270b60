"""Where the figures of a chapter stand: after the step that gives what they show, numbered in that order."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any, NamedTuple

from diecut_report.report.model import Item

Data = Mapping[str, Any]
BEFORE = -1  # the first step of a section


class Place(NamedTuple):
    """The section and the step that a figure follows."""

    section: int
    step: int


class Placed(NamedTuple):
    """A figure with its number and its place."""

    place: Place
    number: str
    figure: Data


def placed(letter: str, mechanism: Data) -> list[Placed]:
    """Return the figures of a mechanism in the order of the printed page."""
    given = {item["id"]: Place(section, step) for section, part in enumerate(mechanism["sections"])
             for step, item in enumerate(part["items"]) if "id" in item}  # fmt: skip
    last = (
        Place(len(mechanism["sections"]) - 1, len(mechanism["sections"][-1]["items"]) - 1)
        if given
        else Place(0, BEFORE)
    )
    found = sorted(((_place(figure, given, last), figure) for figure in mechanism["figures"]), key=lambda pair: pair[0])
    return [Placed(place, f"{letter}.{n}", figure) for n, (place, figure) in enumerate(found, 1)]


def _place(figure: Data, given: Mapping[str, Place], last: Place) -> Place:
    """The section that gives most of what a figure shows, the last of them, and there the last step that does.

    A figure of inputs alone stands before the calculation if it is a drawing, any other after it.
    """
    places = [given[name] for name in figure.get("shows", ()) if name in given]
    if not places:
        return Place(0, BEFORE) if figure["type"] == "drawing" else last
    counts = Counter(place.section for place in places)
    section = max(counts, key=lambda number: (counts[number], number))
    return max(place for place in places if place.section == section)


def figure_item(each: Placed) -> Item:
    """A figure among the steps."""
    return Item("figure", number=each.number, title=each.figure["title"], caption=each.figure["caption"])


def sketch(figures: list[Placed]) -> list[Placed]:
    """Return the one figure of a mechanism that a brief report shows: a drawing, if one can be to scale; no chart, whose texts would be too small."""
    drawn = [each for each in figures if each.figure["type"] == "drawing"]
    to_scale = [each for each in drawn if not each.figure.get("schematic")]
    return (to_scale or drawn)[:1]
