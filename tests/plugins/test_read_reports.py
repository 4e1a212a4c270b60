"""What a reader of the finished reports of all kinds stumbled over: each once for all kinds."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.printing.substitution import printed
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.plugins.cam_gear_transport import MECHANISM as CAM_GEAR
from diecut_report.results.mechanism import mechanism_results
from tests.machines import inputs
from tests.plugins import gears, steppers
from tests.plugins.cases import FULL
from tests.plugins.shafts import CRANKSHAFT, shaft

KINDS = [*Discovery().origins]
KEY_WITH_VALUE = re.compile(r"\b(\w+): (\w+)")


def prose(mechanism: Mechanism) -> Iterator[str]:
    """What stands in a report as sentences: texts of chapters and captions."""
    yield from (chapter.text for chapter in mechanism.chapters)
    yield from (figure.caption for figure in mechanism.figures)


@pytest.mark.parametrize("kind", KINDS)
def test_no_sentence_says_a_choice_as_it_is_typed(kind: str) -> None:
    typed = {("engagement", "away"), ("engagement", "die"), ("role", "cylinder"), ("role", "other")}
    assert not {pair for text in prose(Discovery().mechanism(kind)) for pair in KEY_WITH_VALUE.findall(text)} & typed


def compared(tree: Any) -> Iterator[list[Any]]:
    """The comparisons within a printed condition."""
    if isinstance(tree, list):
        if tree[:1] == ["cmp"]:
            yield tree
        for part in tree:
            yield from compared(part)


def test_a_share_that_is_held_against_a_plain_number_stands_as_a_share() -> None:
    items = [item for section in section_items(shaft(CRANKSHAFT, reliability="99 %")) for item in section["items"]]
    [reliability] = [item for item in items if item.get("words") == "99 %"]
    [[_, sign, left, right]] = compared(reliability["condition_substituted"])
    assert (sign, left, right) == ("<", ["qty", "0.99", "1"], ["num", "0.995"])


def test_only_the_keys_that_are_not_given_are_named_as_missing() -> None:
    calc = steppers.stepper(sprocket_teeth=30, chain_pitch="19.05 mm")
    told = {part.title: part.text for part in mechanism_results(calc, {}).absent}
    assert told["Torque"] == "not calculated: conveyor_mass not given"
    assert told["Rest of the sheet within a tolerance"] == "not calculated: rest_tolerance not given"


def test_no_length_of_a_gear_is_finer_than_it_can_be_made() -> None:
    outputs = mechanism_results(gears.pair(gears.HELICAL), {}).outputs
    lengths = [row.display.text for row in outputs.values() if row.display.unit == "mm"]
    assert len(lengths) > 10
    assert all(len(text.partition(".")[2]) <= 3 for text in lengths)


def test_a_work_that_only_left_out_steps_name_is_not_among_the_sources() -> None:
    without, rolled = (
        steppers.stepper(),
        calculate(CAM_GEAR, inputs(CAM_GEAR, next(iter(FULL["cam_gear_transport"].values())))),
    )
    told = [{source.id for source in mechanism_results(calc, {}).sources} for calc in (without, rolled)]
    assert told == [{"003"}, {"003", "Hertz"}]


def test_what_a_drawing_or_a_message_says_of_a_length_is_no_finer_either() -> None:
    number, unit = printed(gears.pair(gears.HELICAL), "root_chord_1").split(" ")
    assert unit == "mm" and len(number.partition(".")[2]) <= 3
