"""A row of a table by a text that was found; what lies beyond a series, a list or a count is told, not rounded to what there is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Block,
    Chapter,
    Drawing,
    Inputs,
    ListedColumn,
    Mechanism,
    Quantity,
    Text,
    case,
    choice,
    computed,
    lookup,
    m,
    own_table,
    part,
    parts,
    pick,
    samples,
    value,
)
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine import mechanism as listings
from diecut_report.machine.calculation import Calculation, Impossible, Unproven
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.names import Misdeclared
from diecut_report.results.figure_views import figures

BEARINGS = own_table(
    title="Bearings",
    columns={"bore": "mm", "C": "kN"},
    rows={"small": (20, 13.5), "big": (25, 14.875)},
    sources=("One list", "Another list"),
)
NAMES = np.array(BEARINGS.names)
RATINGS = np.array([13.5e3, 14.875e3])


class Place(Inputs):
    load = Quantity("F", "kN", "Load", gt=0, default=14)
    given = Text("Bearing", ("small", "big"), optional=True)
    is_wet = Text("Wet", default=False)
    factor = Quantity("f", "1", "Factor", gt=0, default=1)


class Bar(Block):
    length = Quantity("l", "m", "Length of a bar", optional=True)


def found(load: Any) -> Any:
    return NAMES[(load <= RATINGS).argmax(axis=1)]


def made(*declare: Callable[[Chapter], None]) -> Mechanism:
    chapter = Chapter("All")
    for each in declare:
        each(chapter)
    return Mechanism(kind="place", version="1", title="Place", summary="A place.", inputs=Place, chapters=(chapter,))


def looked_up(chapter: Chapter) -> None:
    chapter.bore = lookup(BEARINGS, by="bearing", column="bore"), "d", "mm", "Bore"


BEARING = ("bearing", "B", "1", "Bearing that is taken")


def by_code(function: Callable[..., Any] = found) -> Callable[[Chapter], None]:
    return lambda chapter: chapter.add(computed(function, ("load",), "in words", is_text=True).step(*BEARING))


def chosen(light: str = "small") -> Callable[[Chapter], None]:
    by_load = case(light, "the load is light", m.load * m.factor < 13.9 * m.load)
    return lambda chapter: chapter.add(choice(by_load, case("big", "it is not")).step(*BEARING))


def run(mechanism: Mechanism, **inputs: Any) -> Calculation:
    return calculate(mechanism, flatten(Place(**inputs)))


def test_the_row_of_a_text_that_was_computed_is_taken() -> None:
    mechanism = made(by_code(), looked_up)
    check_mechanism(mechanism)
    assert run(mechanism, load=13)["bore"].item() == 0.02
    one = run(mechanism, load=14)
    (item,) = (each for section in section_items(one) for each in section["items"] if each["type"] == "lookup")
    assert one["bore"].item() == 0.025 and (item["by"], item["key"]) == ("Bearing that is taken", "big")
    many = calculate(mechanism, {**flatten(Place()), "load": np.array([14e3, 13e3])}, 2)
    assert many["bore"][:, 0].tolist() == [0.025, 0.02]


def test_the_row_of_a_text_that_a_choice_gives_is_taken() -> None:
    mechanism = made(chosen(), looked_up)
    check_mechanism(mechanism)
    assert run(mechanism)["bore"].item() == 0.02 and run(mechanism, factor=14)["bore"].item() == 0.025


def test_a_machine_without_the_text_has_no_row() -> None:
    def declare(chapter: Chapter) -> None:
        all_cases = case("small", "it is light", m.load < 14e3 * m.load / m.load), case("big", "it is not")
        chapter.bearing = choice(*all_cases, exists=m.factor > 1), "B", "1", "Bearing"

    mechanism = made(declare, looked_up)
    many = calculate(mechanism, {**flatten(Place()), "factor": np.array([1.0, 2.0])}, 2)
    assert np.isnan(many["bore"][0, 0]) and many["bore"][1, 0] == 0.025


def test_what_is_sought_in_the_place_of_an_input_is_marked_as_chosen() -> None:
    def sought(chapter: Chapter) -> None:
        chapter.size = computed(lambda load: load / 1e3, ("load",), "tried", lacks=("given",)), "s", "1", "Size"
        chapter.other = computed(lambda load: load / 2e3, ("load",), "halved"), "o", "1", "Other"

    items = [item for section in section_items(run(made(sought))) for item in section["items"]]
    assert [item.get("chosen") for item in items] == [True, None]


def test_names_that_are_no_rows_are_told() -> None:
    (fault,) = faults(made(chosen("smal"), looked_up))
    assert str(fault).endswith("step bore: has no row in the table for bearing=smal; the rows are small, big")
    with pytest.raises(
        Misdeclared, match=r"test_found_rows.py:\d+: step bore: bearing is 'smal', which is not a row of its table"
    ):
        run(made(by_code(lambda load: ["smal"]), looked_up))
    with pytest.raises(Misdeclared, match="gives 2 values; it must return a text for each machine, 1"):
        run(made(by_code(lambda load: ["small", "big"]), looked_up))


def test_a_text_that_all_machines_share_is_that_of_each() -> None:
    def given(chapter: Chapter) -> None:
        chapter.bearing = computed(lambda: "big", (), "as given", is_text=True), "B", "1", "Bearing"

    found = calculate(made(given, looked_up), {"load": np.array([1e3, 2e3, 3e3]), "factor": 1.0, "speed": 1.0}, 3)
    assert found["bearing"].tolist() == [["big"]] * 3


def test_words_of_messages_name_no_row() -> None:
    told = faults(made(lambda chapter: chapter.words("bearing", lambda load: "small", takes=("load",)), looked_up))
    assert any(
        "by is bearing, words that are made where a message asks for them; let choice or" in str(fault)
        for fault in told
    )


def listed(taken: str, rows: Any, digits: int = 0) -> Callable[[Chapter], None]:
    columns = (ListedColumn("name", "Bearing"), ListedColumn("C", "Rating", "C", "kN", digits=digits))
    return lambda chapter: chapter.listing("all", "All bearings", columns, lambda known: rows, ("load",), taken=taken)


def test_the_row_that_was_taken_is_marked_and_a_column_has_its_digits() -> None:
    rows = [("small", 13.5e3), ("big", 14.875e3)]
    one = run(made(by_code(), listed("bearing", rows, digits=3)))
    (table,) = (each for section in section_items(one) for each in section["items"] if each["type"] == "table")
    assert [column["title"] for column in table["columns"]] == ["taken", "Bearing", "Rating"]
    assert table["rows"] == [["", "small", "13.5"], ["→", "big", "14.9"]]
    assert listings.results(one)["all"]["taken"] == [1]


def test_a_row_of_a_number_is_marked_and_none_where_none_was_taken() -> None:
    one = run(made(listed("load", [(14e3 * (1 + 1e-12), 1.0), (13e3, 2.0)])))
    assert listings.results(one)["all"]["taken"] == [0]
    none = run(made(listed("given", [("small", 1.0)])))
    assert "taken" not in listings.results(none)["all"]
    (fault,) = faults(made(listed("lod", [])))
    assert "step all: takes lod, which nothing gives (did you mean 'load'?)" in str(fault)


def again(*asked: Any) -> Callable[[Chapter], None]:
    """A bearing for each of the texts, sought with the machine itself."""

    def sought(known: Any) -> Any:
        changed, names = asked
        return known["again"](changed, np.zeros(2, dtype=int), names)

    def declare(chapter: Chapter) -> None:
        chapter.prepared("sought", sought, ("load",), for_many=True, again=True, lacks=("given",))
        chapter.bore = lookup(BEARINGS, by="given", column="bore", needs=("given",)), "d", "mm", "Bore"
        chapter.twice = value(2 * m.bore * m.factor, needs=("given",)), "d_2", "mm", "Twice the bore"
        chapter.wet = value(3 * m.factor, needs=("is_wet=true",)), "w", "1", "Wet factor"

    return declare


def test_texts_are_tried_one_for_each_trial_or_one_for_all() -> None:
    each = run(made(again({"given": ["big", "small"], "factor": np.array([1.0, 10.0])}, ("twice",)))).inputs["sought"]
    assert each["twice"].tolist() == [0.05, 0.4]
    all_ = run(made(again({"given": "big"}, ("twice", "bore")))).inputs["sought"]
    assert (all_["twice"].tolist(), all_["bore"].tolist()) == ([0.05, 0.05], [0.025, 0.025])
    wet = run(made(again({"is_wet": np.array([True, False]), "given": "big"}, ("wet",)))).inputs["sought"]["wet"]
    assert wet[0] == 3 and np.isnan(wet[1])


def test_numbers_of_parts_are_tried_where_some_have_none() -> None:
    class Bars(Place):
        bars = parts(Bar, "Bars", optional=True)

    mechanism = made(again({"bars.length": (np.array([1.0, 2.0]), None), "given": "big"}, ("first",)))
    chapter = Chapter("More", needs=("bars",), absent="none")
    chapter.prepared("lengths", lambda known: known["bars.length"], ("bars.length",), for_many=True)
    chapter.first = (
        computed(lambda lengths: np.reshape(lengths[0], (-1, 1)), ("lengths",), "the first"),
        "L",
        "m",
        "First length",
    )
    whole = replace(mechanism, inputs=Bars, chapters=(*mechanism.chapters, chapter))
    given = flatten(Bars(bars=[Bar(length=1), Bar()]))
    assert calculate(whole, given).inputs["sought"]["first"].tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("changed", "names", "words"),
    [
        ({"given": "bigg"}, ("twice",), "tries 'bigg' for given; allowed: small, big"),
        ({"given": np.array([1.0, 2.0])}, ("twice",), "tries numbers for given, which is a text: small, big"),
        ({"factor": "2"}, ("twice",), "tries '2' for factor, which is a number: give it in SI"),
        (
            {"load": ["14 kN", "15 kN"]},
            ("twice",),
            r"tries '14 kN' for load, which is a number: give it in SI, si\(…, 'kN'\)",
        ),
        ({"fctor": 2.0}, ("twice",), r"changes fctor, which is not an input \(did you mean 'factor'\?\)"),
        ({"factor": 2.0}, ("load", "wet"), "tries machines that seek again: let the step lack the input that is tried"),
        ({"factor": np.ones(3)}, ("twice",), "gets 3 values of factor for 2 trials; give one for each"),
        ({"factor": 2.0}, ("twic",), r"asks for twic, which nothing gives \(did you mean 'twice'\?\)"),
    ],
)
def test_what_cannot_be_tried_is_told_with_the_plugins_line(changed: Any, names: Any, words: str) -> None:
    with pytest.raises(Misdeclared, match=rf'test_found_rows.py:\d+: step sought: known\["again"\] {words}'):
        run(made(again(changed, names)))


SERIES = (100.0, 160.0, 200.0)


class Drum(Block):
    width = Quantity("b", "mm", "Width")


class Lift(Inputs):
    power = Quantity("P", "kW", "Power", default=544)
    rating = Quantity("P_g", "kW", "Rating", optional=True)
    drums = parts(Drum, "Drums", optional=True)
    n_points = samples(36)


def lift(rule: Any = "above", index: int = 1, *, whole: bool = False, **options: Any) -> Mechanism:
    chapter = Chapter("Lift")
    chapter.needed = 1.0 * m.power, "P_n", "kW", "Needed power"
    chapter.motor = pick(rule, of="needed", series=SERIES, **options), "P_m", "kW", "Motor"
    chapter.second = part(of="drums.width", index=index, needs=("drums",)), "b_2", "mm", "Second drum"
    chapter.count = value(m.power / m.motor, whole=whole), "n", "1", "Number of belts"
    return Mechanism(kind="lift", version="1", title="", summary="", inputs=Lift, chapters=(chapter,))


def run_beyond(mechanism: Mechanism, power: float = 100e3, **more: Any) -> Any:
    return calculate(mechanism, {"power": power, "n_points": 36, **more})


@pytest.mark.parametrize(("rule", "power", "end"), [
    ("above", 544e3, "the greatest value is 200 kW"), ("nearest", 544e3, "the greatest value is 200 kW"),
    ("below", 50e3, "the least value is 100 kW"), ("nearest", 50e3, "the least value is 100 kW"),
])  # fmt: skip
def test_what_is_beyond_the_series_is_no_machine(rule: str, power: float, end: str) -> None:
    with pytest.raises(Impossible) as caught:
        run_beyond(lift(rule), power)
    words = f"Motor (motor): Needed power, P_n = {power / 1e3:g} kW, is beyond the series, of which {end}"
    assert caught.value.reasons == (("", words),)


def test_the_last_value_is_taken_where_the_step_says_so_and_where_the_rule_has_it() -> None:
    assert run_beyond(lift(beyond="last"), 544e3)["motor"][0, 0] == 200e3
    assert run_beyond(lift("above"), 50e3)["motor"][0, 0] == 100e3
    assert run_beyond(lift("below"), 544e3)["motor"][0, 0] == 200e3
    assert run_beyond(lift("above"), 200e3)["motor"][0, 0] == 200e3


def test_what_is_beyond_the_series_is_told_at_the_key_that_the_step_names() -> None:
    with pytest.raises(Impossible) as caught:
        run_beyond(lift(key="power"), 544e3)
    assert caught.value.key == "power" and caught.value.message.startswith("Motor (motor): Needed power")
    calc = calculate(lift(key="power"), {"power": np.array([50e3, 544e3]), "n_points": 36}, 2)
    assert calc.flaws[1][0] == "power"


def test_what_is_given_is_taken_in_place_of_a_value_of_the_series() -> None:
    mechanism = lift(given="rating", key="power")
    assert faults(mechanism) == []
    assert run_beyond(mechanism, 544e3, rating=555e3)["motor"][0, 0] == 555e3
    assert run_beyond(mechanism, 150e3)["motor"][0, 0] == 160e3
    calc = calculate(mechanism, {"power": np.array([50e3, 544e3]), "rating": np.array([1e3, 2e3]), "n_points": 36}, 2)
    assert calc["motor"][:, 0].tolist() == [1e3, 2e3] and calc.flaws == {}
    items = [item for section in section_items(run_beyond(mechanism, 544e3, rating=555e3)) for item in section["items"]]
    motor = next(item for item in items if item["id"] == "motor")
    assert (motor["by"], motor["key"], motor["result"]["text"]) == ("Rating", "as given", "555")


def test_a_variant_beyond_the_series_is_marked_alone() -> None:
    calc = calculate(lift(), {"power": np.array([50e3, 544e3, 150e3]), "n_points": 36}, 3)
    assert set(calc.flaws) == {1} and "544 kW" in calc.flaws[1][1]


def test_a_part_that_the_list_does_not_have_is_told() -> None:
    with pytest.raises(Impossible) as caught:
        run_beyond(lift(), drums=True, **{"drums.width": (0.1,)})
    assert caught.value.reasons == (
        ("drums", "has 1 entry, but Second drum (second) takes part 2; add what is missing"),
    )
    with pytest.raises(Impossible, match="takes part 3 from the last"):
        run_beyond(lift(index=-3), drums=True, **{"drums.width": (0.1, 0.2)})


def test_a_count_that_is_not_whole_is_refused() -> None:
    with pytest.raises(
        Unproven, match=r"Number of belts \(count, test_found_rows.py:\d+\) is 0\.5, but is marked as a count"
    ):
        run_beyond(lift(whole=True), 50e3)
    assert run_beyond(lift(whole=True), 100e3)["count"][0, 0] == 1


@pytest.mark.parametrize(
    ("drawn", "given"), [(None, "nothing"), ("circle", "a str"), ([1], "other things in its list")]
)
def test_a_drawing_that_gives_no_shapes_is_told(drawn: Any, given: str) -> None:
    def drum(view: Any) -> Any:
        return drawn

    mechanism = replace(lift(), figures=(Drawing("drum", "Drum", "", build=drum),))
    [figure] = figures(run_beyond(mechanism))
    assert figure.type == "failed"
    assert figure.error.startswith(f"drum gives {given}; return a list of what circle, polyline,")
