"""Figures that wait for the next sheet: the text goes on where a figure has no room, and the figure stands at the head of the next sheet.

CSS has no words for it that the page engine knows. So its layout of a block is asked for three kinds of blocks in another way: for those
of the class ``WAITS``, for chapters, and for the body of each sheet. One figure at a time waits, so that the figures keep their order.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from diecut_report.report.page_engine import block_layout

WAITS = "waits"
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
    """A figure, the block that it stands in (with the width that it has here), and the empty one in its place."""

    figure: Any
    around: Any
    empty: Any


class _Sheets:
    """What waits on each sheet of a document; on its ``last`` nothing does."""

    def __init__(self) -> None:
        self.waiting: dict[int, _Waiting] = {}
        self.last = 0


def waiting_figures(ordinary: Callable[..., Laid]) -> Callable[..., Laid]:
    """Return the page engine's layout of a block, by which figures wait."""

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
    return context.current_page in _sheets(context).waiting


def _figure(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> Laid:
    """A figure, or the empty block in its place where it waits."""
    sheets, sheet = _sheets(context), context.current_page
    before = sheets.waiting.get(sheet)
    if before and before.figure is not box:
        return (*NO_ROOM, place.most)
    sheets.waiting.pop(sheet, None)
    laid = ordinary(context, box, *place)
    if place.is_empty or (laid[0] is not None and _has_room(context, laid[0], place)):
        return laid
    if sheet == sheets.last or _is_kept_with(place.around, box):
        return laid
    if laid[0] is not None:
        block_layout.remove_placeholders(context, [laid[0]], place.absolute, place.fixed)
    empty = box.copy_with_children([])
    empty.height = empty.margin_top = empty.margin_bottom = 0
    sheets.waiting[sheet] = _Waiting(box, place.around.copy(), empty)
    return empty, None, GOES_ON, [], True, place.most


def _has_room(context: Any, box: Any, place: BlockPlace) -> bool:
    return not context.overflows_page(place.bottom, box.border_box_y() + box.border_height())


def _is_kept_with(around: Any, box: Any) -> bool:
    """Whether what stands before a figure must not be the last of a sheet: a heading."""
    index = next(index for index, child in enumerate(around.children) if child is box)
    return index > 0 and around.children[index - 1].style["break_after"] == "avoid"


def _body(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> Laid:
    """What stands on a sheet: the figure that waited, and what follows it."""
    sheets, sheet, top = _sheets(context), context.current_page, box.position_y
    sheets.waiting.pop(sheet, None)
    head = _head(ordinary, context, box, place)
    laid = _below(ordinary, context, box, place, head)
    waiting = sheets.waiting.get(sheet)
    if waiting and not any(child is waiting.empty for child in laid[0].descendants()):
        del sheets.waiting[sheet]  # it stands on the next sheet with the text before it
    elif waiting and laid[1] is None:  # the document ends here
        block_layout.remove_placeholders(context, [laid[0]], place.absolute, place.fixed)
        sheets.last, box.position_y = sheet, top
        laid = _body(ordinary, context, box, place)
    return laid


def _head(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> Any:
    """The figure that waited on the sheet before, at the head of this one; None where there is none."""
    waited = _sheets(context).waiting.get(context.current_page - 1)
    if waited is None:
        return None
    waited.figure.position_y = box.position_y
    own = place._replace(start=None, around=waited.around, is_empty=True, margins=[])
    head = ordinary(context, waited.figure, *own)[0]
    box.position_y += head.margin_height()
    return head


def _below(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace, head: Any) -> Laid:
    if head is None:
        return ordinary(context, box, *place)
    laid = ordinary(context, box, *place._replace(is_empty=False))
    if laid[0] is None:  # nothing has room below it
        alone = box.copy_with_children([head])
        alone.height = head.margin_height()
        return alone, place.start, GOES_ON, [], False, place.most
    laid[0].children = [head, *laid[0].children]
    return laid
