"""The title blocks of the sheets as boxes, in millimetres: a plain strip, ISO 7200, and DSTU GOST 2.104 (forms 2 and 2a)."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from functools import wraps
from itertools import takewhile
from typing import Any, NamedTuple

from diecut_report.report.document import DSTU, ISO, TitleBlock
from diecut_report.report.pages.page_engine import block_layout
from diecut_report.report.symbols import BOLD, LINE, MILLIMETRE, REGULAR, fitted
from diecut_report.report.text import Catalogue

PAD = 0.9  # millimetres between a line and a text
LABEL = 2.2  # height of a label in its box
LEAST = 4.5  # points of the letters of a text
SIDE = 0.18  # half a line's width
_DATE = re.compile(r"\d\d(?P<year>\d\d)-(?P<month>\d\d)-(?P<day>\d\d)")  # as it is typed, and as Ukrainian prints it
_UKRAINIAN = re.compile(r"(?P<day>\d\d)\.(?P<month>\d\d)\.\d\d(?P<year>\d\d)")


class Cell(NamedTuple):
    """A box of a title block: its place from the upper left corner, what it is called, and what stands in it."""

    x: float
    y: float
    width: float
    height: float
    label: str = ""
    text: str = ""
    kind: str = ""  # "sheet" (its number, of how many), "page" (its number), "sheets" (how many), "logo"
    largest: float = 8.0  # points
    bold: bool = False
    middle: bool = False
    anchor: str = ""

    @property
    def shown(self) -> list[str]:
        """The text in lines that fit."""
        return self._fitted[0]

    @property
    def style(self) -> str:
        """Where the box is, and how its text stands in it."""
        lines, size = self._fitted
        used = self._room if self.kind == "logo" else len(lines) * size * LINE / MILLIMETRE
        top = self._top + max(self._room - used, 0) / 2
        place = f"left:{self.x:g}mm;top:{self.y:g}mm;width:{self.width:g}mm;height:{self.height:g}mm;padding-top:{top:.3f}mm"
        return f"{place};font-size:{size:g}pt"

    @property
    def _top(self) -> float:
        return LABEL if self.label else 0.0

    @property
    def _room(self) -> float:
        return self.height - self._top - 2 * SIDE

    @property
    def _fitted(self) -> tuple[list[str], float]:
        text = {"sheet": "000 of 000", "page": "000", "sheets": "000", "logo": ""}.get(self.kind, self.text)
        face = BOLD if self.bold else REGULAR
        return fitted(text, self.width - 2 * PAD, self._room, self.largest, LEAST, face)


class SheetBlock(NamedTuple):
    """The title block of a sheet: its size, and its boxes."""

    width: float
    height: float
    cells: list[Cell]


class SheetBlocks(NamedTuple):
    """The title block of the first sheet, and that of the others."""

    first: SheetBlock
    next: SheetBlock


def sheet_blocks(block: TitleBlock, words: Catalogue, *, has_logo: bool) -> SheetBlocks:
    """Return the title blocks of a report's frame."""
    if block.frame == DSTU:
        return SheetBlocks(
            SheetBlock(185, 40, [*_changes(block, words), *_form_2(block, words, has_logo)]),
            SheetBlock(185, 15, [*_changes(block, words), *_form_2a(block, words)]),
        )
    if block.frame == ISO:
        first = SheetBlock(180, 34, list(_iso(block, words, has_logo)))
        return SheetBlocks(first, SheetBlock(180, 10, list(_iso_next(block, words))))
    strip = SheetBlock(174, 9, list(_strip(block, words, has_logo)))
    return SheetBlocks(strip, strip)


def _row(y: float, height: float, cells: list[tuple[float, Cell]], x: float = 0.0) -> Iterator[Cell]:
    for width, cell in cells:
        yield cell._replace(x=x, y=y, width=width, height=height)
        x += width


def _cell(label: str = "", text: str = "", **more: Any) -> Cell:
    return Cell(0, 0, 0, 0, label, text)._replace(**more)


def _owner(block: TitleBlock, has_logo: bool, label: str = "") -> list[Cell]:
    """The organisation's box, or two of its logo and its name."""
    named = _cell(label, block.project["organisation"] or (block.press if block.frame not in (ISO, DSTU) else ""))
    return [_cell(kind="logo", text=block.project["organisation"]), named] if has_logo else [named]


def _strip(block: TitleBlock, words: Catalogue, has_logo: bool) -> Iterator[Cell]:
    p, owner = block.project, _owner(block, has_logo)
    widths = [15.0, 21.0] if has_logo else [30.0]
    yield from _row(0, 9, [
        *zip(widths, owner, strict=True),
        (174 - sum(widths) - 98, _cell(text=p["title"], bold=True)),
        (33, _cell(words["document"], p["document_number"] or "–")),
        (13, _cell(words["revision"], p["revision"] or "–")),
        (17, _cell(words["date"], p["date"] or "–")),
        (18, _cell(words["status"], block.status, bold=block.is_held)),
        (17, _cell(words["sheet"], kind="sheet")),
    ])  # fmt: skip


def _iso(block: TitleBlock, words: Catalogue, has_logo: bool) -> Iterator[Cell]:
    """The fields of ISO 7200: owner, number, revision, date, sheet, title, approval, creator, type, department, status."""
    p = block.project
    yield from _row(0, 8.5, [
        (45, _cell(words["department"], p["department"])),
        (34, _cell(words["prepared"], p["prepared_by"])),
        (34, _cell(words["checked"], p["checked_by"])),
        (34, _cell(words["approved"], p["approved_by"])),
        (33, _cell(words["status"], block.status, bold=block.is_held)),
    ])  # fmt: skip
    owner = _owner(block, has_logo, words["owner"])
    yield from _row(8.5, 17, [
        *zip([16.0, 29.0] if has_logo else [45.0], owner, strict=True),
        (102, _cell(words["title"], p["title"], largest=12, bold=True)),
        (33, _cell(words["document_type"], p["document_type"])),
    ])  # fmt: skip
    yield from _row(25.5, 8.5, [
        (79, _cell(words["identification"], p["document_number"], largest=10, bold=True)),
        (16, _cell(words["revision"], p["revision"])),
        (36, _cell(words["issued"], p["date"])),
        (16, _cell(words["language"], words.language)),
        (33, _cell(words["sheet"], kind="sheet", largest=9)),
    ])  # fmt: skip


def _iso_next(block: TitleBlock, words: Catalogue) -> Iterator[Cell]:
    p = block.project
    yield from _row(0, 10, [
        (36, _cell(words["owner"], p["organisation"])),
        (43, _cell(words["title"], p["title"])),
        (38, _cell(words["identification"], p["document_number"], bold=True)),
        (13, _cell(words["revision"], p["revision"])),
        (17, _cell(words["issued"], p["date"])),
        (18, _cell(words["status"], block.status, bold=block.is_held)),
        (15, _cell(words["sheet"], kind="sheet")),
    ])  # fmt: skip


CHANGES = (7.0, 10.0, 23.0, 15.0, 10.0)  # widths of the columns: change, sheet, document, signature, date


def _changes(block: TitleBlock, words: Catalogue) -> Iterator[Cell]:
    """The columns of changes, the same in both forms: this revision's line, and room for one below."""
    mark, day = block.project["revision"], _short(block.project["date"])
    for y, texts in ((0, ("", "", "", "", "")), (5, (mark, "", "", "", day))):
        yield from _row(
            y, 5, [(width, _cell(text=text, middle=True)) for width, text in zip(CHANGES, texts, strict=True)]
        )
    heads = [_cell(text=words[f"dstu_{key}"], middle=True) for key in ("change", "page", "document", "sign", "date")]
    yield from _row(10, 5, list(zip(CHANGES, heads, strict=True)))


def _form_2(block: TitleBlock, words: Catalogue, has_logo: bool) -> Iterator[Cell]:
    """The first sheet of a text document: signatures, designation, title, organisation."""
    p, names = block.project, dict(block.signers)
    for y, key in ((15, "prepared"), (20, "checked"), (25, ""), (30, "norm_checked"), (35, "approved")):
        label = words[f"dstu_{key}"] if key else ""
        signed = _cell(anchor=f"sign-{key}") if key else _cell()
        yield from _row(
            y, 5, [(17, _cell(text=label)), (23, _cell(text=names.get(key, ""))), (15, signed), (10, _cell())]
        )
    yield Cell(65, 0, 120, 10, text=p["document_number"], largest=14, bold=True, middle=True)
    yield Cell(65, 10, 120, 5, text=_state(block, words), middle=True, bold=block.is_held)
    yield Cell(65, 15, 70, 18, text=p["title"], largest=12, bold=True, middle=True)
    yield Cell(65, 33, 70, 7, text=p["document_type"], largest=9, middle=True)
    heads = [(15, "letter"), (15, "sheet"), (20, "sheets")]
    yield from _row(15, 5, [(width, _cell(text=words[f"dstu_{key}"], middle=True)) for width, key in heads], 135)
    numbers = [(15, _cell(kind="page", middle=True)), (20, _cell(kind="sheets", middle=True))]
    yield from _row(20, 5, [(5, _cell()), (5, _cell()), (5, _cell()), *numbers], 135)
    firm = Cell(135, 25, 50, 15, text=", ".join(filter(None, (p["organisation"], p["department"]))), middle=True)
    if has_logo:
        yield firm._replace(width=16, kind="logo", text=p["organisation"])
    yield firm._replace(x=151, width=34) if has_logo else firm


def _form_2a(block: TitleBlock, words: Catalogue) -> Iterator[Cell]:
    p = block.project
    yield Cell(65, 0, 110, 7, text=p["document_number"], largest=12, bold=True, middle=True)
    yield Cell(65, 7, 110, 4, text=p["title"], largest=7, middle=True)
    yield Cell(65, 11, 110, 4, text=_state(block, words), largest=7, middle=True, bold=block.is_held)
    yield Cell(175, 0, 10, 7, text=words["dstu_page"], middle=True)
    yield Cell(175, 7, 10, 8, kind="page", largest=9, middle=True)


def _state(block: TitleBlock, words: Catalogue) -> str:
    """Revision, date and status in a line, for which the forms have no box of their own."""
    p = block.project
    revision = f"{words['revision']} {p['revision']}" if p["revision"] else ""
    return " · ".join(filter(None, (revision, p["date"], block.status)))


def _short(date: str) -> str:
    """A date as it fits into a centimetre; one that is written otherwise stands in the document alone."""
    found = _DATE.fullmatch(date) or _UKRAINIAN.fullmatch(date)
    return f"{found['day']}.{found['month']}.{found['year']}" if found else ""


# Figures that wait for the next sheet: the text goes on where a figure has no room, and the figure stands at the head of the next sheet.
#
# CSS has no words for it that the page engine knows. So its layout of a block is asked for three kinds of blocks in another way: for those
# of the class ``WAITS``, for chapters, and for the body of each sheet. Figures behind one that waits wait too, so that all keep their order.


WAITS = "waits"
MOST = 0.97  # of a sheet, for the figures that waited
BARRIER = "section"  # a chapter does not begin before the figures of the one before it
SHEET_BEGUN: ContextVar[Callable[[int], object]] = ContextVar("SHEET_BEGUN", default=int)
"""What is called with the number of each sheet that is begun."""
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
        if element.tag == BARRIER and place[1] is None and _sheets(context).waiting.get(context.current_page):
            return ordinary(context, box, *place) if place[3] else (*NO_ROOM, place[-1])
        if element.tag == "div" and element.get("class", "").startswith(WAITS):
            return _figure(ordinary, context, box, BlockPlace(*place))
        return ordinary(context, box, *place)

    return laid


def _sheets(context: Any) -> _Sheets:
    found: _Sheets = vars(context).setdefault("sheets_of_figures", _Sheets())
    return found


def _figure(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> Laid:
    sheets, sheet = _sheets(context), context.current_page
    # what waits before it, which may have waited when the sheet was laid out before
    before = list(takewhile(lambda each: each.figure is not box, sheets.waiting.get(sheet, [])))
    laid = (*NO_ROOM, place.most) if before else ordinary(context, box, *place)
    lowest = laid[0] and laid[0].border_box_y() + laid[0].border_height()
    if place.is_empty or (lowest is not None and not context.overflows_page(place.bottom, lowest)):
        return laid
    if sheet == sheets.last or _is_kept_with(place.around, box):
        return laid
    _forget(context, laid, place)
    whole = ordinary(context, box, *place._replace(bottom=-math.inf, is_empty=True))  # whether it has room or not
    _forget(context, whole, place)
    empty = box.copy_with_children([])
    empty.height = empty.margin_top = empty.margin_bottom = 0
    sheets.waiting[sheet] = [*before, _Waiting(box, place.around.copy(), float(whole[0].margin_height()), empty)]
    return empty, None, GOES_ON, [], True, place.most


def _forget(context: Any, laid: Laid, place: BlockPlace) -> None:
    """Take back what was laid out for a try."""
    if laid[0] is not None:
        block_layout.remove_placeholders(context, [laid[0]], place.absolute, place.fixed)


def _is_kept_with(around: Any, box: Any) -> bool:
    """Whether what stands before a figure must not be the last of a sheet: a heading."""
    index = next(index for index, child in enumerate(around.children) if child is box)
    return index > 0 and around.children[index - 1].style["break_after"] == "avoid"


def _body(ordinary: Callable[..., Laid], context: Any, box: Any, place: BlockPlace) -> Laid:
    sheets, sheet = _sheets(context), context.current_page
    SHEET_BEGUN.get()(sheet)
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
