"""Tables say themselves what stands in their columns, whatever their language."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from markupsafe import Markup

from diecut_report.report.chapters.printed_tables import PrintedTable
from diecut_report.report.chapters.tables import Tables
from diecut_report.report.pages.html import folder
from diecut_report.report.pages.page_engine import HTML
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import ItemRecord, PhaseRecord
from tests.records import filled

NONE = Markup("")
PHASE = filled(PhaseRecord, {
    "description": "Ніж ріже", "role": "working", "abscissa": "phi",
    "display": {"unit": "deg", "intervals": [{"from": "1.5", "to": "20", "length": "18.5"}]},
})  # fmt: skip


def kinds(*columns: list[str], symbol: str = "", unit: str = "") -> list[str]:
    rows = [list(row) for row in zip(*columns, strict=True)]
    return PrintedTable("", [("", Markup(symbol), unit) for _ in columns], rows).kinds


@pytest.mark.parametrize(
    ("texts", "kind"),
    [
        (["1", "2", "3"], "nth"),
        (["1", "3"], ""),
        (["барабан", "вал"], "named"),
        (["A", "–"], "named"),
        (["12,5", "–", "−3"], ""),
        (["1,2\u2009×\u200910⁻⁵", "3"], ""),
    ],
)
def test_a_first_column_is_what_its_texts_are(texts: list[str], kind: str) -> None:
    assert kinds(texts) == [kind]


def test_texts_in_another_column_are_words_also_where_they_are_numbers_with_their_units() -> None:
    assert kinds(["1", "2"], ["26 µm", "1,5 mm"], ["1", "2"]) == ["nth", "words", ""]


def test_values_of_a_quantity_do_not_number_lines() -> None:
    assert kinds(["1", "2"], symbol="φ") == [""] and kinds(["1", "2"], unit="mm") == [""]


@pytest.mark.parametrize("language", ["en", "uk"])
def test_phases_are_named_in_every_language(language: str) -> None:
    (table,) = Tables("A", Catalogue(language)).of_phases({"cuts": PHASE})
    assert table.kinds == ["named", "words", "", "", ""]


def test_a_long_table_of_few_columns_stands_in_two_halves() -> None:
    rows = [[f"phase {n}", f"{n}.5"] for n in range(17)]
    columns = [{"title": "Phase", "symbol": "", "unit": "1"}, {"title": "Time", "symbol": "t", "unit": "ms"}]
    item = {"type": "table", "title": "Times", "columns": columns, "rows": rows}
    table = Tables("A", Catalogue("en")).of_item(ItemRecord.model_validate(item))
    assert len(table.columns) == 4 and len(table.rows) == 9
    assert table.rows[0] == ["phase 0", "0.5", "phase 9", "9.5"] and table.rows[8] == ["phase 8", "8.5", "", ""]
    assert table.kinds == ["named", "", "named", ""]


def test_columns_of_a_wide_table_have_room_for_symbols_alone() -> None:
    wide = PrintedTable("", [("A long title", Markup("a"), "mm")] * 13, [["1"] * 13])
    assert wide.is_wide and not PrintedTable("", wide.columns[:8], [["1"] * 8]).is_wide


def test_a_long_word_in_a_narrow_head_is_divided_between_syllables(tmp_path: Path) -> None:
    style = (folder() / "report.css").read_text("utf-8")
    head = '<table style="width: 25mm; table-layout: fixed"><tr><th>За продуктивністю</th></tr></table>'
    file = tmp_path / "head.pdf"
    HTML(string=f'<html lang="uk"><style>{style}</style>{head}').write_pdf(file)
    told = subprocess.run(["pdftotext", "-layout", str(file), "-"], capture_output=True, text=True, check=True).stdout
    assert re.search(r"\w{4,}[-\u2010]\n\s*\w{4,}", told)
