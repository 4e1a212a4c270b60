"""The names of results: what is made of a step is read back, and the results of a run carry which part each is of."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.mechanism.chapters import prefixed, taken
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import (
    Breakpoints,
    Crossings,
    Reduction,
    ResultName,
    SilentStep,
    Step,
    named,
    names_ahead,
    result_names,
)
from diecut_report.results.mechanism_record import PartRecord
from tests.machine.loop import MECHANISM as LOOP
from tests.machine.test_loop import told

PARTS = 12

TURNS = Crossings(symbol="", unit="1", description="", id="turn", of="speed")
PEAK = Reduction(symbol="", unit="1", description="", id="peak", of="speed", operation="abs_max")
MEAN = Reduction(symbol="", unit="1", description="", id="mean", of="speed", operation="mean")
ROW = Step(id="gap")
SHAFTS = Step(id="speeds", numbered="shaft_{}_speed", first=3)
WRAPS = Step(id="wrap", numbered="wraps.{}", first=0)
STEPS = {step.id: step for step in (TURNS, PEAK, MEAN, ROW, SHAFTS, WRAPS)}


def _built_in() -> Iterator[Any]:
    discovery = Discovery()
    for kind in sorted(discovery.origins):
        yield pytest.param(discovery.mechanism(kind), id=kind)


@pytest.mark.parametrize(("step", "parts", "wanted"), [
    (MEAN, None, ["mean"]), (PEAK, None, ["peak", "peak_at"]), (TURNS, None, ["turn_count"]), (TURNS, 2, ["turn_count", "turn_1", "turn_2"]),
    (ROW, 2, ["gap.0", "gap.1"]), (SHAFTS, 2, ["shaft_3_speed", "shaft_4_speed"]), (WRAPS, 2, ["wraps.0", "wraps.1"]),
    (Breakpoints(id="cuts", abscissa="angle"), None, []),
])  # fmt: skip
def test_names_of_a_step(step: Step, parts: int | None, wanted: list[str]) -> None:
    assert [each.name for each in result_names(step, parts)] == wanted


@pytest.mark.parametrize(("name", "found"), [
    ("peak", ("peak", "value", -1, 0)), ("peak_at", ("peak", "place", -1, 0)), ("turn_count", ("turn", "count", -1, 0)),
    ("turn", ("turn", "value", -1, 0)), ("turn_12", ("turn", "crossing", 11, 12)), ("gap.0", ("gap", "part", 0, 1)),
    ("shaft_5_speed", ("speeds", "part", 2, 5)), ("speeds.2", ("speeds", "part", 2, 5)), ("wraps.4", ("wrap", "part", 4, 5)),
])  # fmt: skip
def test_a_name_is_read(name: str, found: tuple[Any, ...]) -> None:
    assert named(name, STEPS) == ResultName(name, *found)


@pytest.mark.parametrize("name", [
    "mean_at", "peak_count", "turn_0", "turn_01", "turn_", "turn_x", "turn_²", "turn_at", "gap_1", "gap.-1", "gap.", "gap.01", "shaft_2_speed",
    "shaft__speed", "shaft_speed", "shaft_3_torque", "", ".", "other",
])  # fmt: skip
def test_what_no_step_gives_is_nothing(name: str) -> None:
    assert named(name, STEPS) is None


@pytest.mark.parametrize("mechanism", [*_built_in(), pytest.param(LOOP, id="loop")])
def test_names_go_round(mechanism: Mechanism) -> None:
    steps = {step.id: step for _, step in mechanism.steps}
    for step in steps.values():
        for parts in (None, PARTS):
            for each in result_names(step, parts):
                own = steps.get(each.name, step)  # another step may have this id, and is meant then
                assert named(each.name, steps) == (each if own is step else ResultName(each.name, own.id))


@pytest.mark.parametrize("mechanism", [*_built_in(), pytest.param(LOOP, id="loop")])
def test_what_steps_take_is_given(mechanism: Mechanism) -> None:
    """A step whose name another one takes with an ending is found as its giver."""
    steps = {step.id: step for _, step in mechanism.steps if not isinstance(step, SilentStep)}
    ahead = {each.name: each.id for step in steps.values() for each in names_ahead(step)} | {
        name: name for name in steps
    }
    for name in {name for step in steps.values() for name in taken(step)} & ahead.keys():
        found = named(name, steps)
        assert found is not None and found.id == ahead[name]


def test_a_family_for_another_variant_takes_its_own_crossings() -> None:
    later = Breakpoints(id="cuts", abscissa="angle", places=("turn_1", "peak_at", "turn_count", "mean"))
    *_, cuts = prefixed("second_", (TURNS, PEAK, MEAN, later), shared=("mean",))
    assert taken(cuts) == {"angle", "second_turn_1", "second_peak_at", "second_turn_count", "mean"}


def test_results_carry_the_part_that_they_are_of() -> None:
    data = told()
    assert data.outputs["gap.1"].part == PartRecord(family="fence.posts", index=1, quantity="gap")
    assert data.outputs["way_3"].part == PartRecord(family="way", index=1, number=3)
    assert data.inputs["fence.posts.1.x"].part == PartRecord(family="fence.posts", index=1, quantity="x")
    assert data.outputs["length"].part is None
