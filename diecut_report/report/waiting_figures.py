"""Figures that wait for the next sheet: the text goes on where a figure has no room, and the figure stands at the head of the next sheet.

CSS has no words for it that the page engine knows. So its layout of a block is asked for three kinds of blocks in another way: for those
of the class ``WAITS``, for chapters, and for the body of each sheet. Figures behind one that waits wait too, so that all keep their order.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import wraps
from typing import Any, NamedTuple

from diecut_report.report.page_engine import block_layout

WAITS = "waits"
MOST = 0.97  # of a sheet, for the figures that waited
BARRIER = "section"  # a chapter does not begin before the figures of the one before it
Laid = tuple[Any, ...]  # block, where it goes on, how the next page begins, margins, whether they meet, lines left
GOES_ON: Any = {"break": "any", "page": None}
NO_ROOM: Laid = (None, None, GOES_ON, [], False)


class BlockPlace(NamedTuple):
    """Where a block is to stand: what the page engine hands on with it, in its order."""

    bottom: float
    start: Any
    around: Any
    is_empty: bool
    absolute: list[Any]
    fixed: list[Any]
    margins: list[Any]
    first_letter: Any
    first_line: Any
    is_cut: bool
    most: Any


class _Waiting(NamedTuple):
    """A figure, the block that it stands in (with the width that it has here), how high it is, and the empty block in its place.

    That of a figure that waited on the sheet before, too, stands there.
    """

    figure: Any
    around: Any
    height: float
    empty: Any


class _Sheets:
    """What waits on each sheet of a document; on its ``last`` nothing does. ``top`` is where the text of a sheet begins."""

    def __init__(self) -> None:
        self.waiting: dict[int, list[_Waiting]] = {}
        self.top = 0.0
        self.last = 0


def waiting_figures(ordinary: Callable[..., Laid]) -> Callable[..., Laid]:
    """Return the page engine's layout of a block, by which figures wait."""

    @wraps(ordinary)
    def laid(context: Any, box: Any, *place: Any) -> Laid:
        element = box.element
        if element is None or len(place) != len(BlockPlace._fields):
            return ordinary(context, box, *place)
        if element.tag == "body":
            return _body(ordinary, context, box, BlockPlace(*place))
        if element.tag == BARRIER and place[1] is None and _is_waited_for(context):
            return ordinary(context, box, *place) if place[3] else (*NO_ROOM, place[-1])
        if element.tag == "div" and element.get("class", "").startswith(WAITS):
            return _figure(ordinary, context, box, BlockPlace(*place))
        return ordinary(context, box, *place)

    return laid


def _sheets(context: Any) -> _Sheets:
    found: _Sheets = vars(context).setdefault("sheets_of_figures", _Sheets())
    return found


def _is_waited_for(context: Any) -> bool:
    return bool(_sheets(context).waiting.get(context.current_page))


def _figure(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> Laid:
    """A figure, or the empty block in its place where it waits."""
    sheets, sheet = _sheets(context), context.current_page
    before = _before(sheets.waiting.get(sheet, []), box)
    laid = (*NO_ROOM, place.most) if before else ordinary(context, box, *place)
    if place.is_empty or (laid[0] is not None and _has_room(context, laid[0], place)):
        return laid
    if sheet == sheets.last or _is_kept_with(place.around, box):
        return laid
    _forget(context, laid, place)
    height = _height(ordinary, context, box, place)
    empty = box.copy_with_children([])
    empty.height = empty.margin_top = empty.margin_bottom = 0
    sheets.waiting[sheet] = [*before, _Waiting(box, place.around.copy(), height, empty)]
    return empty, None, GOES_ON, [], True, place.most


def _before(waiting: list[_Waiting], box: Any) -> list[_Waiting]:
    """What waits before a figure, which may have waited when the sheet was laid out before."""
    index = next((index for index, each in enumerate(waiting) if each.figure is box), len(waiting))
    return waiting[:index]


def _height(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> float:
    """How high a figure is, whether it has room or not."""
    laid = ordinary(context, box, *place._replace(bottom=-math.inf, is_empty=True))
    _forget(context, laid, place)
    return float(laid[0].margin_height())


def _forget(context: Any, laid: Laid, place: BlockPlace) -> None:
    """Take back what was laid out for a try."""
    if laid[0] is not None:
        block_layout.remove_placeholders(context, [laid[0]], place.absolute, place.fixed)


def _has_room(context: Any, box: Any, place: BlockPlace) -> bool:
    return not context.overflows_page(place.bottom, box.border_box_y() + box.border_height())


def _is_kept_with(around: Any, box: Any) -> bool:
    """Whether what stands before a figure must not be the last of a sheet: a heading."""
    index = next(index for index, child in enumerate(around.children) if child is box)
    return index > 0 and around.children[index - 1].style["break_after"] == "avoid"


def _body(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> Laid:
    """What stands on a sheet: the figure that waited, and what follows it."""
    sheets, sheet = _sheets(context), context.current_page
    sheets.top, sheets.waiting[sheet] = box.position_y, []
    laid = _below(ordinary, context, box, place, _heads(ordinary, context, box, place))
    there = {id(child) for child in laid[0].descendants()} if sheets.waiting[sheet] else set()
    # a figure with whose text before it the next sheet begins stands there
    sheets.waiting[sheet] = [each for each in sheets.waiting[sheet] if each.empty is None or id(each.empty) in there]
    if sheets.waiting[sheet] and laid[1] is None:  # the document ends here
        _forget(context, laid, place)
        sheets.last, box.position_y = sheet, sheets.top
        laid = _body(ordinary, context, box, place)
    return laid


def _heads(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> list[Any]:
    """The figures that waited on the sheet before, at the head of this one; those for which it has no room wait on."""
    sheets, sheet, heads = _sheets(context), context.current_page, list[Any]()
    lowest = sheets.top + MOST * (context.page_bottom - sheets.top)
    for waited in sheets.waiting.get(sheet - 1, ()):
        is_full = sheets.waiting[sheet] or box.position_y + waited.height > lowest
        if heads and is_full and sheet != sheets.last:
            sheets.waiting[sheet].append(waited._replace(empty=None))
            continue
        waited.figure.position_y = box.position_y
        own = place._replace(start=None, around=waited.around, is_empty=True, margins=[])
        heads.append(ordinary(context, waited.figure, *own)[0])
        box.position_y += heads[-1].margin_height()
    return heads


def _below(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace, heads: list[Any]) -> Laid:
    if not heads:
        return ordinary(context, box, *place)
    laid = ordinary(context, box, *place._replace(is_empty=False))
    if laid[0] is None:  # nothing has room below them
        alone = box.copy_with_children(heads)
        alone.height = sum(head.margin_height() for head in heads)
        return alone, place.start, GOES_ON, [], False, place.most
    laid[0].children = [*heads, *laid[0].children]
    return laid
