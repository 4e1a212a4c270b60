"""The list of symbols of a chapter."""

from __future__ import annotations

from typing import Any

from markupsafe import Markup

from diecut_report.report.symbols import SymbolRow, in_blocks, symbol_rows
from diecut_report.results.mechanism_record import MechanismRecord
from tests.records import filled

Data = dict[str, Any]


def row(symbol: str, description: str, unit: str = "mm", **more: Any) -> Data:
    """A quantity of the results."""
    return {"symbol": symbol, "description": description, "display": {"text": "1", "unit": unit}} | more


def mechanism() -> Data:
    """Results in which ω and b stand in formulas, a of the source's letter is a result, and c is never printed."""
    formula = {"type": "formula", "symbol": "a_c", "equation": ["*", ["sym", "ω"], ["/", ["sym", "b"], ["num", "2"]]]}
    return {
        "inputs": {"width": row("b", "Width; without it the length"), "idle": row("c", "Clearance")},
        "curves": {"speed": {"symbol": "ω", "description": "Speed", "display_unit": "rpm"}},
        "outputs": {"acceleration": row("a_c", "Acceleration", "m/s**2", source_symbol="W")},
        "values": {"again": row("b", "Another width")},
        "sections": [{"items": [formula, {"type": "note", "text": "a note"}]}],
    }


def rows_of(data: Data) -> list[SymbolRow]:
    """The list of symbols of these results."""
    return symbol_rows(filled(MechanismRecord, data))


def test_a_symbol_of_a_formula_stands_once_with_meaning_and_unit_by_the_alphabet() -> None:
    rows = rows_of(mechanism())
    assert [(each.meaning, each.unit) for each in rows] == [
        ("Acceleration", "m/s²"), ("Width", "mm"), ("Speed", "r/min"),
    ]  # fmt: skip
    assert "ω" in rows[2].symbol


def test_the_list_tells_the_letter_of_the_source() -> None:
    first, *others = rows_of(mechanism())
    assert "W" in first.in_source and not any(each.in_source for each in others)


def test_the_arrow_before_a_choice_in_words_is_no_symbol() -> None:
    made = mechanism()
    made["values"]["chosen"] = row("→", "Drive that is taken", "1")
    made["sections"][0]["items"].append({"symbol": "→", "type": "choice"})
    assert all("→" not in each.symbol for each in rows_of(made))


def test_a_lone_symbol_stands_in_the_first_column() -> None:
    row = SymbolRow(Markup("φ"), "Cycle angle", "°", Markup(""))
    assert in_blocks([row]) == [[[row]]]


def test_a_long_list_is_cut_into_blocks_that_stay_whole_on_a_sheet() -> None:
    rows = [SymbolRow(Markup("a"), f"Number {nth}", "mm", Markup("")) for nth in range(100)]
    blocks = in_blocks(rows)
    assert [row for block in blocks for column in block for row in column] == rows
    assert len(blocks) == 3 and all(len(column) <= 14 for block in blocks for column in block)
    assert not in_blocks([])


def test_a_letter_means_what_its_step_prints_and_not_what_a_chart_draws_with_it() -> None:
    made = mechanism()
    made["curves"] = {
        "drawn": {"symbol": "a_c", "description": "Acceleration with another law", "display_unit": "1"}
    } | made["curves"]
    made["sections"][0]["items"][0]["id"] = "acceleration"
    assert rows_of(made)[0].meaning == "Acceleration"
