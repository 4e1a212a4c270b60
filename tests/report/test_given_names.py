"""Names that a configuration gives are printed as they are typed."""

from __future__ import annotations

from typing import Any

import pytest

from diecut_report.report.chapters.value_tables import value_row
from diecut_report.report.text import given_names, translated, value_in_words
from diecut_report.results.mechanism_record import ItemRecord, MechanismRecord, QuantityRecord, ShownRecord
from diecut_report.text.catalogues import Catalogues
from tests.records import filled
from tests.report.made_results import typed

Data = dict[str, Any]


def named(text: str, quantity: str = "name", **more: Any) -> QuantityRecord:
    """An input of a part of a list."""
    part = {"family": "loads", "index": 0, "quantity": quantity}
    given = {"value": text, "display": {"text": text, "unit": "1"}, "origin": "given", "text": text, "part": part}
    return filled(QuantityRecord, given | more)


@pytest.mark.parametrize(
    ("row", "text"),
    [
        (named("main_a"), "main_a"),
        (named("deep_groove", "type"), "deep groove"),
        (named("crank_rocker", "type"), "crank-rocker"),
        (named("gripper_chain", "mechanism", origin="reference", path="gripper_chain"), "gripper_chain"),
    ],
)
def test_a_name_keeps_its_form_and_a_choice_is_said_in_words(row: QuantityRecord, text: str) -> None:
    assert value_in_words(row) == text


def test_a_result_that_is_the_name_of_a_part_is_printed_as_it_is_typed() -> None:
    found = filled(QuantityRecord, {"value": "main_b", "display": {"text": "main_b", "unit": "1"}})
    assert value_in_words(found, {"main_b"}) == "main_b" and value_in_words(found) == "main b"
    result = ShownRecord(text="main_b", unit="1")
    item = ItemRecord(type="lookup", description="Bearing with the shortest life", symbol="B_L", result=result)
    assert value_row(item, "F.21", None, "", ".", {"main_b"}).value == "main_b"


def test_names_are_those_of_parts_and_of_mechanisms_that_are_taken() -> None:
    inputs = {
        "loads.0.name": named("crank"),
        "loads.0.type": named("gear", "type"),
        "drives": named("", "", value=["feeder"]),
        "pulleys.0.role": named("cylinder", "role"),  # a word that one of the mechanisms is called by, too
    }
    assert given_names(filled(MechanismRecord, {"inputs": inputs}), {"feeder", "gear_1", "cylinder"}) == {
        "crank",
        "feeder",
    }


def test_a_name_that_is_a_word_of_the_catalogue_is_not_translated(plain: Data) -> None:
    """“drive” is a word of several catalogues."""
    data = plain["mechanisms"]["cylinder"]
    data["inputs"]["lines.0.name"] = named("drive")
    data["figures"] = [
        {"id": "torque", "caption": "", "type": "plot", "title": "Torque", "panels": [{"series": [{"label": "drive"}]}]}
    ]
    catalogues = Catalogues("uk")
    catalogues.know(["cyclogram", "drive_train"])
    one = typed({**plain, "mechanisms": {"cylinder": data}, "comparisons": {}})
    said = translated(one, catalogues).mechanisms["cylinder"]
    assert said.inputs["lines.0.name"].display.text == "drive"
    assert said.figures[0].panels[0].series[0].label == "drive"
