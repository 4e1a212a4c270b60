"""Figures that wait for the next sheet, while the text goes on: on pages of plain paragraphs and boxes."""

from __future__ import annotations

import re
from io import BytesIO

from pypdf import PdfReader

import diecut_report.report.pages.pdf  # noqa: F401 - figures wait where reports are set
from diecut_report.report.pages.page_engine import HTML

STYLE = (
    "@page { size: 100mm 101mm; margin: 0 } body { margin: 0 } html { font: 4mm/10mm sans-serif } p, h2 { margin: 0 }"
    "h2 { font-size: 4mm; break-after: avoid } figure { margin: 0; break-inside: avoid }"
)


def _sheets(*parts: str) -> list[str]:
    """What stands on each sheet, in its order: t1, F1 …"""
    page = HTML(string=f"<html><style>{STYLE}</style><body>{''.join(parts)}</body></html>")
    content = page.write_pdf()
    texts = [sheet.extract_text() for sheet in PdfReader(BytesIO(content)).pages]
    return [" ".join(re.findall(r"[tFC]\d+", text)) for text in texts]


def _text(first: int, last: int) -> str:
    return "".join(f"<p>t{n}</p>" for n in range(first, last + 1))


def _figure(number: int, height: int) -> str:
    """A figure so many lines high."""
    return f'<div class="waits"><figure><div style="height: {height * 10 - 10}mm"></div><p>F{number}</p></figure></div>'


def test_text_goes_on_where_a_figure_has_no_room() -> None:
    sheets = _sheets(_text(1, 7), _figure(1, 5), _text(8, 15))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7 t8 t9 t10", "F1 t11 t12 t13 t14 t15"]


def test_a_figure_that_has_room_stays_in_its_place() -> None:
    assert _sheets(_text(1, 5), _figure(1, 5), _text(6, 7)) == ["t1 t2 t3 t4 t5 F1", "t6 t7"]


def test_figures_keep_their_order() -> None:
    sheets = _sheets(_text(1, 6), _figure(1, 5), _text(7, 8), _figure(2, 2), _text(9, 15))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7 t8 t9 t10", "F1 F2 t11 t12 t13", "t14 t15"]


def test_a_figure_for_which_the_next_sheet_has_no_room_waits_for_the_one_after_it() -> None:
    sheets = _sheets(_text(1, 6), _figure(1, 6), _text(7, 8), _figure(2, 5), _text(9, 18))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7 t8 t9 t10", "F1 t11 t12 t13 t14", "F2 t15 t16 t17 t18"]
    chapter = "<section><h2>C1</h2><p>t9</p></section>"
    assert _sheets(_text(1, 6), _figure(1, 6), _figure(2, 5), _text(7, 7), chapter)[1:] == ["F1", "F2 C1 t9"]


def test_a_chapter_begins_behind_the_figures_of_the_one_before_it() -> None:
    sheets = _sheets(_text(1, 6), _figure(1, 5), _text(7, 7), "<section><h2>C1</h2>", _text(8, 9), "</section>")
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7", "F1 C1 t8 t9"]


def test_a_figure_at_the_end_is_not_lost() -> None:
    assert _sheets(_text(1, 7), _figure(1, 5)) == ["t1 t2 t3 t4 t5 t6 t7", "F1"]
    assert _sheets(_text(1, 7), _figure(1, 5), _text(8, 8)) == ["t1 t2 t3 t4 t5 t6 t7", "F1 t8"]


def test_a_figure_stays_with_the_heading_before_it() -> None:
    sheets = _sheets(_text(1, 6), "<h2>C1</h2>", _figure(1, 5), _text(7, 8))
    assert sheets == ["t1 t2 t3 t4 t5 t6", "C1 F1 t7 t8"]


def test_a_text_that_has_no_room_below_the_waiting_figure_stands_on_the_sheet_after_it() -> None:
    block = '<div style="break-inside: avoid; height: 50mm"><p>t8</p></div>'
    sheets = _sheets(_text(1, 7), _figure(1, 8), block, _text(9, 9))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7", "F1", "t8 t9"]


def test_a_waiting_figure_is_tagged_and_linked_where_it_stands() -> None:
    figure = _figure(1, 5).replace("<figure>", '<figure id="fig">')
    page = HTML(string=f'<html><style>{STYLE}</style><body><p><a href="#fig">t1</a></p>{_text(2, 7)}{figure}{_text(8, 9)}</body></html>')  # fmt: skip
    reader = PdfReader(BytesIO(page.write_pdf()))
    place = reader.named_destinations["fig"]
    assert reader.get_destination_page_number(place) == 1
