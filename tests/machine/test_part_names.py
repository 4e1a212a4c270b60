"""Parts have names of their own, and what a formula, message or drawing may name has a symbol and a unit; a name that none has is told."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Block,
    Chapter,
    Inputs,
    Mechanism,
    Quantity,
    abscissa,
    crossings,
    m,
    parts,
    running,
    samples,
)
from diecut_report.declaration import faults
from diecut_report.formulas.tree import Node
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.printing.substitution import filled
from diecut_report.machine.steps import run
from diecut_report.mechanism.names import Misdeclared
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import ItemRecord, ShownRecord
from diecut_report.testing.machines import Refused, calculate, load
from diecut_report.testing.values import MechanismFound

SPRINGS = """
from diecut_report.api import *


class Spring(Block):
    name = Text("Name")
    force = Quantity("F_i", "N", "Force")


class Springs(Inputs):
    springs = parts(Spring, "Springs")
    allowed = Quantity("F_z", "N", "Allowed force", default=10)


def check(id, named_by=""):
    return Check(id, "strength", id, m.springs.force, m.allowed, consequence="x.", named_by=named_by)


chapter = Chapter("All")
chapter.pull = value(2 * m.springs.force, named_by="%(named)s"), "P_i", "N", "Pull"
chapter.push_pull = value(3 * m.springs.force, named_by="%(named)s"), "Q_i", "N", "Both"
MECHANISM = Mechanism(kind="springs", version="1", title="S", summary="S.", inputs=Springs, chapters=(chapter,), checks=(%(checks)s))
"""
NAMED, EACH = "springs.name", 'check("force", "springs.name"),'


def calculated(folder: Path, names: tuple[str, ...], checks: str = "", named: str = "") -> MechanismFound:
    (folder / "springs.py").write_text(SPRINGS % {"checks": checks, "named": named}, "utf-8")
    given: dict[str, Any] = {"springs": [{"name": name, "force": 100 if i == 0 else 1} for i, name in enumerate(names)]}
    return calculate(load("springs", folder), given, plugins=[folder])


def test_parts_with_names_of_their_own_are_calculated(tmp_path: Path) -> None:
    found = calculated(tmp_path, ("left", "right"), EACH, NAMED)
    assert (found["left_pull"].shown, found["right_pull"].shown) == ("200 N", "2 N")
    assert {name: each.status for name, each in found.checks.items()} == {"force_left": "fail", "force_right": "pass"}


LOST = {
    "results": ("", NAMED, ("a", "b", "a"), "springs.2.name: is a, as is that of part 1 of springs; give each part a name of its own"),
    "a failing check": (EACH, "", ("a", "a"), "springs.1.name: is a, as is that of part 1 of springs"),
    "what plain code keeps by its name": ("", "", ("a", "a"), "springs.1.name: is a, as is that of part 1 of springs"),
    "a result of another row": ("", NAMED, ("a", "a_push"), "is a, with which its result a_push_pull would be called as another one"),
    "a check of the machine": (EACH + 'check("force_b"),', "", ("a", "b"), "springs.1.name: is b, with which its check force_b would be"),
}  # fmt: skip


@pytest.mark.parametrize("what", LOST)
def test_two_parts_of_one_name_are_refused(tmp_path: Path, what: str) -> None:
    checks, named, names, words = LOST[what]
    with pytest.raises(Refused) as caught:
        calculated(tmp_path, names, checks, named)
    assert words in str(caught.value)


class Wave(Inputs):
    height = Quantity("h", "mm", "Height", gt=0, default=2)
    n_points = samples(36)


wave = Chapter("Wave")
wave.angle = abscissa(period=2 * np.pi), "φ", "deg", "Angle"
wave.rise = m.height * np.cos(m.angle), "y", "mm", "Rise"
wave.zero = crossings(of="rise"), "φ_0", "deg", "Where it is level"
wave.doubled = 2 * m.zero_count, "z_2", "1", "Twice as many"
wave.between = m.zero_2 - m.zero_1, "Δφ", "deg", "Angle between them"

MECHANISM = Mechanism(kind="wave", version="1", title="Wave", summary="Wave.", inputs=Wave, chapters=(wave,))


def made() -> Calculation:
    return run.calculate(MECHANISM, {"height": 0.002, "n_points": 36})


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
    with pytest.raises(Misdeclared, match=r"test_part_names\.py:\d+: 'zero_cuont' is not a quantity .*'zero_count'"):
        made().step_or_input("zero_cuont")
    with pytest.raises(
        Misdeclared, match=r"'inputs\.hieght' is not a quantity of this machine \(did you mean 'height'\?\)"
    ):
        made().step_or_input("inputs.hieght")


class Shaft(Block):
    ratio = Quantity("i_k", "1", "Ratio", gt=0)


class Shafts(Inputs):
    shafts = parts(Shaft, "Shafts")


train = Chapter("Train")
train.speed = running("product", of="shafts.ratio", numbered="shaft_{}_speed", first=3), "ω_k", "1", "Speed"
train.sum = running("sum", of="shafts.ratio", numbered="sum_{}"), "F_t", "1", "Sum"
train.slip = m.shaft_3_speed - m.shaft_4_speed, "s", "1", "Slip"
train.more = m.sum_2 / m.sum_1, "q", "1", "More"

TRAIN = Mechanism(kind="train", version="1", title="Train", summary="Train.", inputs=Shafts, chapters=(train,))


def test_formulas_of_several_parts_are_printed_with_the_number_of_each() -> None:
    assert not faults(TRAIN)
    calc = run.calculate(TRAIN, {"shafts.ratio": (5.0, 0.4)})
    items: dict[str, ItemRecord] = {item.id: item for item in mechanism_results(calc, {}).sections[0].items}
    assert items["slip"].equation == Node("-", (Node("sym", ("ω_3",)), Node("sym", ("ω_4",)))).to_json()
    assert items["more"].equation == Node("/", (Node("sym", ("F_t,2",)), Node("sym", ("F_t,1",)))).to_json()
    assert items["slip"].result == ShownRecord(text="3", unit="1") and items["more"].result.text == "1.08"


def test_a_part_with_the_symbol_of_another_quantity_is_a_fault() -> None:
    alike = Chapter("Alike")
    alike.sum = running("sum", of="shafts.ratio", numbered="sum_{}"), "F_k", "1", "Sum"
    alike.third = 3 * m.sum_1, "F_3", "1", "Third"
    alike.product = running("product", of="shafts.ratio", numbered="product_{}", first=9), "F_i", "1", "Product"
    found = faults(replace(TRAIN, chapters=(alike,)))
    assert [(each.subject, each.text.split(" (at ")[0]) for each in found] == [
        ("step sum_3", "has the symbol F_3 of third"), ("step product_9", "has the symbol F_9 of sum_9"),
    ]  # fmt: skip
