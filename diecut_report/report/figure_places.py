"""Where the figures of a chapter stand: after the step that gives what they show, numbered in that order."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from diecut_report.report.model import Item

Data = Mapping[str, Any]
BEFORE = -1  # the first step of a section
NEAR = 2  # sections later a figure may stand, beside another one
MOST_NOTES = 3  # within a diagram that has room for them over half the width
MOST_LINES = 6  # of a diagram over half the width, whose legend would else be higher than the diagram
LONGEST_LEGEND = 110  # letters in the names of a diagram's lines, or of its marks, that have room over half the width
MANY = 4  # diagrams of one figure, which stand two by two over the whole width
SKETCHED_TEXTS = 12  # of a drawing that is legible as a sketch
VALUE = 16  # letters of the numbers behind the name of a mark


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


class Row(NamedTuple):
    """A figure, or two side by side, and the place that they follow."""

    place: Place
    figures: tuple[Placed, ...]


def rows_of(figures: list[Placed], *, paired: bool) -> list[Row]:
    """Return the figures in their order, alone or (``paired``) two by two: the first waits for the second, which stands near."""
    found: list[Row] = []
    waiting: Placed | None = None
    for each in figures:
        is_narrow = paired and _is_narrow(each.figure)
        if waiting and is_narrow and _are_near(waiting.place, each.place):
            found.append(Row(each.place, (waiting, each)))
            waiting = None
            continue
        found += [Row(waiting.place, (waiting,))] if waiting else []
        waiting = each if is_narrow else None
        found += [] if waiting else [Row(each.place, (each,))]
    return found + ([Row(waiting.place, (waiting,))] if waiting else [])


def _is_narrow(figure: Data) -> bool:
    """Whether a figure can be drawn half as wide as a sheet: it has few diagrams, no bars, no scheme of boxes, no long legend, few names within."""
    names = [
        sum(len(line.get("label", "")) for key in ("lines", "fills", "series") for line in panel.get(key, ()))
        for panel in figure.get("panels", ())
    ]
    marked = [
        sum(len(mark["label"]) + VALUE for mark in panel.get("marks", ()) if mark.get("label"))
        for panel in figure.get("panels", ())
    ]
    is_large = len(figure.get("panels", ())) >= MANY or _most_lines(figure) > MOST_LINES
    if figure["type"] == "bars" or figure.get("schematic") or is_large:
        return False
    longest, most = max([*names, *marked], default=0), max(map(_notes, figure.get("panels", ())), default=0)
    return longest <= LONGEST_LEGEND and most <= MOST_NOTES


def _most_lines(figure: Data) -> int:
    """How many lines a diagram of the figure has that a legend names."""
    named = [
        sum(bool(line.get("label")) for key in ("lines", "series") for line in panel.get(key, ()))
        for panel in figure.get("panels", ())
    ]
    return max(named, default=0)


def _notes(panel: Data) -> int:
    """How many names stand within a diagram, beside those of its lines."""
    kinds = ("marks", "levels", "verticals", "fills")
    return sum(bool(note.get("label")) for kind in kinds for note in panel.get(kind, ()))


def _are_near(one: Place, other: Place) -> bool:
    return other.section - one.section <= NEAR


def figures_at(rows: Sequence[Row], place: Place) -> Iterator[Item]:
    """The figures that stand at a place."""
    for row in rows:
        if row.place == place:
            yield row_item(row)


def row_item(row: Row) -> Item:
    """A figure, or two, among the steps."""
    items = tuple(
        Item("figure", number=each.number, title=each.figure["title"], caption=each.figure["caption"])
        for each in row.figures
    )
    return items[0] if len(items) == 1 else Item("pair", pair=items)


def sketch(figures: list[Placed]) -> list[Placed]:
    """Return the one figure of a mechanism that a brief report shows: a drawing of few texts, if one can be to scale; others would be too small."""
    drawn = [each for each in figures if each.figure["type"] == "drawing" and _texts(each.figure) <= SKETCHED_TEXTS]
    to_scale = [each for each in drawn if not each.figure.get("schematic")]
    return (to_scale or drawn)[:1]


def _texts(figure: Data) -> int:
    return sum("text" in shape or "label" in shape for shape in figure.get("shapes", ()))
