"""Each quantity that a formula, message or drawing may name has a symbol and a unit of its own; a name that none has is told."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
import pytest

from diecut_report.api import POINTS, Block, Chapter, Inputs, Mechanism, Quantity, Text
from diecut_report.declaration import faults
from diecut_report.formulas.tree import Node
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.printing.substitution import filled
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.names import Misdeclared
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import ItemRecord, ShownRecord


class Wave(Inputs):
    height: Annotated[float, Quantity("h", "mm", "Height", gt=0)] = 2
    n_points: Annotated[int, POINTS] = 36


wave = Chapter("Wave")
wave.abscissa("angle", "φ", "deg", "Angle", period=2 * np.pi)
wave.value("rise", "y", "mm", "Rise", lambda angle, height: height * np.cos(angle))
wave.crossings("zero", "φ_0", "deg", "Where it is level", of="rise")
wave.value("doubled", "z_2", "1", "Twice as many", lambda zero_count: 2 * zero_count)
wave.value("between", "Δφ", "deg", "Angle between them", lambda zero_1, zero_2: zero_2 - zero_1)

MECHANISM = Mechanism(kind="wave", version="1", title="Wave", summary="Wave.", inputs=Wave, chapters=(wave,))


def made() -> Calculation:
    return calculate(MECHANISM, {"height": 0.002, "n_points": 36})


def test_how_many_crossings_there_are_is_a_number_with_symbol_and_unit() -> None:
    calc = made()
    declared = calc.step_or_input("zero_count")
    assert (declared.symbol, declared.unit) == ("n_φ,0", "1") and "how many" in declared.description
    assert filled(calc, "it is level {zero_count} times") == "it is level 2 times"


def test_formulas_of_crossings_and_of_their_number_are_printed_with_symbols_of_their_own() -> None:
    assert not faults(MECHANISM)
    items: dict[str, ItemRecord] = {item.id: item for item in mechanism_results(made(), {}).sections[0].items}
    assert items["doubled"].equation == Node("*", (Node("num", ("2",)), Node("sym", ("n_φ,0",)))).to_json()
    assert items["doubled"].result.text == "4"  # cos is zero at 90° and at 270°
    assert items["between"].equation == Node("-", (Node("sym", ("φ_0,2",)), Node("sym", ("φ_0,1",)))).to_json()
    assert items["between"].result == ShownRecord(text="180", unit="deg")


def test_a_name_that_nothing_has_is_told_with_the_plugin_and_the_nearest() -> None:
    with pytest.raises(
        Misdeclared, match=r"test_named_quantity\.py:\d+: 'zero_cuont' is not a quantity .*'zero_count'"
    ):
        made().step_or_input("zero_cuont")
    with pytest.raises(
        Misdeclared, match=r"'inputs\.hieght' is not a quantity of this machine \(did you mean 'height'\?\)"
    ):
        made().step_or_input("inputs.hieght")


class Shaft(Block):
    ratio: Annotated[float, Quantity("i_k", "1", "Ratio", gt=0)]


class Shafts(Inputs):
    shafts: Annotated[list[Shaft], Text("Shafts")]


train = Chapter("Train")
train.running("speed", "ω_k", "1", "Speed", "product", of="shafts.ratio", numbered="shaft_{}_speed", first=3)
train.running("sum", "F_t", "1", "Sum", "sum", of="shafts.ratio", numbered="sum_{}")
train.value("slip", "s", "1", "Slip", lambda shaft_3_speed, shaft_4_speed: shaft_3_speed - shaft_4_speed)
train.value("more", "q", "1", "More", lambda sum_1, sum_2: sum_2 / sum_1)

TRAIN = Mechanism(kind="train", version="1", title="Train", summary="Train.", inputs=Shafts, chapters=(train,))


def test_formulas_of_several_parts_are_printed_with_the_number_of_each() -> None:
    assert not faults(TRAIN)
    calc = calculate(TRAIN, {"shafts.ratio": (5.0, 0.4)})
    items: dict[str, ItemRecord] = {item.id: item for item in mechanism_results(calc, {}).sections[0].items}
    assert items["slip"].equation == Node("-", (Node("sym", ("ω_3",)), Node("sym", ("ω_4",)))).to_json()
    assert items["more"].equation == Node("/", (Node("sym", ("F_t,2",)), Node("sym", ("F_t,1",)))).to_json()
    assert items["slip"].result == ShownRecord(text="3", unit="1") and items["more"].result.text == "1.08"


def test_a_part_with_the_symbol_of_another_quantity_is_a_fault() -> None:
    alike = Chapter("Alike")
    alike.running("sum", "F_k", "1", "Sum", "sum", of="shafts.ratio", numbered="sum_{}")
    alike.value("third", "F_3", "1", "Third", lambda sum_1: 3 * sum_1)
    alike.running("product", "F_i", "1", "Product", "product", of="shafts.ratio", numbered="product_{}", first=9)
    found = faults(replace(TRAIN, chapters=(alike,)))
    assert [(each.subject, each.text.split(" (at ")[0]) for each in found] == [
        ("step sum_3", "has the symbol F_3 of third"), ("step product_9", "has the symbol F_9 of sum_9"),
    ]  # fmt: skip
