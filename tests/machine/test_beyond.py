"""What lies beyond a standard series, a list or a count is told, not rounded to the nearest thing that there is."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from diecut_report.api import POINTS, Annotated, Block, Chapter, Drawing, Inputs, Mechanism, Quantity, Text
from diecut_report.declaration import faults
from diecut_report.machine.calculation import Impossible, Unproven
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.results.figure_views import figures

SERIES = (100.0, 160.0, 200.0)


class Drum(Block):
    width: Annotated[float, Quantity("b", "mm", "Width")]


class Lift(Inputs):
    power: Annotated[float, Quantity("P", "kW", "Power")] = 544
    rating: Annotated[float | None, Quantity("P_g", "kW", "Rating")] = None
    drums: Annotated[list[Drum], Text("Drums")] = []  # noqa: RUF012
    n_points: Annotated[int, POINTS] = 36


def lift(rule: Any = "above", index: int = 1, *, whole: bool = False, **options: Any) -> Mechanism:
    chapter = Chapter("Lift")
    chapter.value("needed", "P_n", "kW", "Needed power", lambda power: 1.0 * power)
    chapter.pick("motor", "P_m", "kW", "Motor", rule, of="needed", series=SERIES, **options)
    chapter.part("second", "b_2", "mm", "Second drum", of="drums.width", index=index, needs=("drums",))
    chapter.value("count", "n", "1", "Number of belts", lambda power, motor: power / motor, whole=whole)
    return Mechanism(kind="lift", version="1", title="", summary="", inputs=Lift, chapters=(chapter,))


def run(mechanism: Mechanism, power: float = 100e3, **more: Any) -> Any:
    return calculate(mechanism, {"power": power, "n_points": 36, **more})


@pytest.mark.parametrize(("rule", "power", "end"), [
    ("above", 544e3, "the greatest value is 200 kW"), ("nearest", 544e3, "the greatest value is 200 kW"),
    ("below", 50e3, "the least value is 100 kW"), ("nearest", 50e3, "the least value is 100 kW"),
])  # fmt: skip
def test_what_is_beyond_the_series_is_no_machine(rule: str, power: float, end: str) -> None:
    with pytest.raises(Impossible) as caught:
        run(lift(rule), power)
    words = f"Motor (motor): Needed power, P_n = {power / 1e3:g} kW, is beyond the series, of which {end}"
    assert caught.value.reasons == (("", words),)


def test_the_last_value_is_taken_where_the_step_says_so_and_where_the_rule_has_it() -> None:
    assert run(lift(beyond="last"), 544e3)["motor"][0, 0] == 200e3
    assert run(lift("above"), 50e3)["motor"][0, 0] == 100e3
    assert run(lift("below"), 544e3)["motor"][0, 0] == 200e3
    assert run(lift("above"), 200e3)["motor"][0, 0] == 200e3


def test_what_is_beyond_the_series_is_told_at_the_key_that_the_step_names() -> None:
    with pytest.raises(Impossible) as caught:
        run(lift(key="power"), 544e3)
    assert caught.value.key == "power" and caught.value.message.startswith("Motor (motor): Needed power")
    calc = calculate(lift(key="power"), {"power": np.array([50e3, 544e3]), "n_points": 36}, 2)
    assert calc.flaws[1][0] == "power"


def test_what_is_given_is_taken_in_place_of_a_value_of_the_series() -> None:
    mechanism = lift(given="rating", key="power")
    assert faults(mechanism) == []
    assert run(mechanism, 544e3, rating=555e3)["motor"][0, 0] == 555e3
    assert run(mechanism, 150e3)["motor"][0, 0] == 160e3
    calc = calculate(mechanism, {"power": np.array([50e3, 544e3]), "rating": np.array([1e3, 2e3]), "n_points": 36}, 2)
    assert calc["motor"][:, 0].tolist() == [1e3, 2e3] and calc.flaws == {}
    items = [item for section in section_items(run(mechanism, 544e3, rating=555e3)) for item in section["items"]]
    motor = next(item for item in items if item["id"] == "motor")
    assert (motor["by"], motor["key"], motor["result"]["text"]) == ("Rating", "as given", "555")


def test_a_variant_beyond_the_series_is_marked_alone() -> None:
    calc = calculate(lift(), {"power": np.array([50e3, 544e3, 150e3]), "n_points": 36}, 3)
    assert set(calc.flaws) == {1} and "544 kW" in calc.flaws[1][1]


def test_a_part_that_the_list_does_not_have_is_told() -> None:
    with pytest.raises(Impossible) as caught:
        run(lift(), drums=True, **{"drums.width": (0.1,)})
    assert caught.value.reasons == (
        ("drums", "has 1 entry, but Second drum (second) takes part 2; add what is missing"),
    )
    with pytest.raises(Impossible, match="takes part 3 from the last"):
        run(lift(index=-3), drums=True, **{"drums.width": (0.1, 0.2)})


def test_a_count_that_is_not_whole_is_refused() -> None:
    with pytest.raises(
        Unproven, match=r"Number of belts \(count, test_beyond.py:\d+\) is 0\.5, but is marked as a count"
    ):
        run(lift(whole=True), 50e3)
    assert run(lift(whole=True), 100e3)["count"][0, 0] == 1


@pytest.mark.parametrize(
    ("drawn", "given"), [(None, "nothing"), ("circle", "a str"), ([1], "other things in its list")]
)
def test_a_drawing_that_gives_no_shapes_is_told(drawn: Any, given: str) -> None:
    def drum(view: Any) -> Any:
        return drawn

    mechanism = replace(lift(), figures=(Drawing(id="drum", title="Drum", caption="", build=drum),))
    [figure] = figures(run(mechanism))
    assert figure.type == "failed"
    assert figure.error.startswith(f"drum gives {given}; return a list of what circle, polyline,")
