"""Tables of curves: which rows stand in them."""

from __future__ import annotations

import math

import pytest

from diecut_report.report.chapters.tables import Tables, table_places
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import CurveRecord, ItemRecord, PhaseRecord
from tests.records import filled

TURN = CurveRecord(
    values=[math.radians(k / 2) for k in range(720)],
    unit="rad",
    display_unit="deg",
    symbol="φ",
    description="Angle",
    source="",
)


def curve(*breaks: float, jump: float = 0.0) -> CurveRecord:
    """A curve that is 5 everywhere and jumps to 5 + ``jump`` at its breakpoints (degrees), as the results hold it."""
    common = {"unit": "N", "display_unit": "N", "symbol": "F", "description": "Force", "abscissa": "angle"}
    places = {
        "breakpoints": [math.radians(b) for b in breaks],
        "left": [5.0] * len(breaks),
        "right": [5.0 + jump] * len(breaks),
    }
    return filled(CurveRecord, common | {"values": [5.0] * 720} | (places if breaks else {}))


def angles(*curves: CurveRecord) -> list[float]:
    """Where the rows of a table stand, in degrees."""
    return [round(math.degrees(place.x), 6) for place in table_places(TURN, curves)]


def test_a_table_of_curves_stands_at_even_steps() -> None:
    assert angles(curve()) == angles(curve(38.8465, 42.97, 55.695)) == [20.0 * k for k in range(18)]


def test_a_jump_stands_twice_and_takes_the_place_of_a_step() -> None:
    assert angles(curve(40.0, 55.5, jump=2.0))[:6] == [0.0, 20.0, 40.0, 40.0, 55.5, 55.5]


def test_a_jump_has_a_row_before_and_one_after_it() -> None:
    table = Tables("A", Catalogue("en")).of_curves({"angle": TURN, "force": curve(100.2, jump=2.0)})[0]
    assert [row[1] for row in table.rows if row[0] == "100.2"] == ["5", "7"]


@pytest.mark.parametrize("rounding", [0.0, 1e-7, -1e-7])
def test_a_breakpoint_without_a_jump_has_no_row(rounding: float) -> None:
    table = Tables("A", Catalogue("en")).of_curves({"angle": TURN, "force": curve(100.2, jump=rounding)})[0]
    assert [row[1] for row in table.rows if row[0] == "100.2"] == []


def test_rounding_beside_great_values_is_printed_as_zero() -> None:
    force = curve(100.2, jump=2.0).with_(left=[3e-11])
    table = Tables("A", Catalogue("en")).of_curves({"angle": TURN, "force": force})[0]
    assert [row[1] for row in table.rows if row[0] == "100.2"] == ["0", "7"]


@pytest.mark.parametrize(
    "curves",
    [(curve(*range(10, 350, 10), jump=2.0),), (curve(100.2, jump=2.0), curve())],
    ids=["too many", "not shared"],
)
def test_pieces_that_are_too_many_or_not_shared_are_not_told_apart(curves: tuple[CurveRecord, ...]) -> None:
    assert angles(*curves) == [20.0 * k for k in range(18)]


def test_phases_over_time_do_not_tell_their_time_once_more() -> None:
    shown = {"unit": "ms", "intervals": [{"from": "0", "to": "333.3", "length": "333.3", "time": "333.3"}]}
    phase = {"abscissa": "time", "description": "The input moves", "role": "moving", "display": shown}
    turned = phase | {"abscissa": "angle", "display": shown | {"unit": "deg"}}
    phases = {name: filled(PhaseRecord, each) for name, each in (("moves", phase), ("turns", turned))}
    over_time, over_angle = Tables("A", Catalogue("en")).of_phases(phases)
    assert [unit for _, _, unit in over_time.columns] == ["", "", "ms", "ms", "ms"]
    assert [unit for _, _, unit in over_angle.columns] == ["", "", "°", "°", "°", "ms"]


def test_the_head_of_a_column_leaves_out_what_is_explained_behind_a_semicolon() -> None:
    column = {"title": "Side of the pulley; outside is on the back", "symbol": "", "unit": "1"}
    item = {"type": "table", "title": "Pulleys", "columns": [column], "rows": [["inside"]]}
    table = Tables("A", Catalogue("en")).of_item(ItemRecord.model_validate(item))
    assert table.columns[0][0] == "Side of the pulley"
