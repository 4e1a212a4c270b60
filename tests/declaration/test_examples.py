"""What an example gives is what the kind takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest

from diecut_report.api import Block, ExampleBlock, Inputs, Quantity, Text, Wired, parts
from diecut_report.declaration import faults
from tests.declaration.test_faults import made


class Tooth(Block):
    height = Quantity("h", "mm", "Height", gt=0)


class Toothed(Inputs):
    force = Quantity("F", "N", "Force", gt=0)
    teeth = parts(Tooth, "Teeth", optional=True)
    side = Text("Side", ("left", "right"), default="left")


class Turning(Inputs):
    mass = Quantity("m", "kg", "Mass", gt=0, optional=True)
    stiffness = Quantity("K", "N*m/rad", "Stiffness", gt=0, units=(("mass", "N/m"),))


def told(inputs: Mapping[str, Any]) -> list[str]:
    mechanism = replace(made(), inputs=Toothed, example=ExampleBlock("part", inputs))
    return [str(fault) for fault in faults(mechanism) if "example" in str(fault)]


def test_an_example_may_refer_and_have_other_values_where_a_kind_is_absent() -> None:
    teeth = [{"height": "2 mm"}, Wired({"height": 3}, needs=("clutch",))]
    assert told({"force": Wired("${<clutch>.pressing_force}", otherwise="2 kN"), "teeth": teeth, "side": "right"}) == []


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        ({"forces": "2 kN"}, "example part: forces names no input (did you mean 'force'?)"),
        ({"force": "2 mm"}, "example part: force 2 mm is a length; a force is needed"),
        ({"force": Wired("${<clutch>.force}", otherwise=-1)}, "example part: force -1 N is out of range"),
        ({"force": {"value": 0, "basis": "assumed"}}, "example part: force 0 N is out of range"),
        ({"force": 1, "teeth": [{"hight": 2}]}, "example part: teeth.hight names no input"),
        ({"force": 1, "teeth": [Wired({"height": -2}, needs=("clutch",))]}, "example part: teeth.height -2 mm is out"),
    ],
)
def test_what_an_input_does_not_take_is_told_at_the_example(inputs: dict[str, Any], words: str) -> None:
    (text,) = told(inputs)
    assert text.startswith("test_examples.py:") and words in text


def test_a_value_may_be_in_the_unit_of_another_form() -> None:
    example = ExampleBlock("part", {"mass": 1, "stiffness": "5 N/m"})
    assert not [each for each in faults(replace(made(), inputs=Turning, example=example)) if "example" in str(each)]


@pytest.mark.parametrize("name", ["1x", "", "my hook"])
def test_a_name_that_no_mechanism_may_have_is_told(name: str) -> None:
    found = faults(replace(made(), inputs=Toothed, example=ExampleBlock(name, {"force": 1})))
    assert [str(each) for each in found if "is not a name of a mechanism" in str(each)]


def test_an_example_that_is_none_is_told() -> None:
    mechanism = replace(made(), example={"force": 1})  # type: ignore[arg-type]
    assert [str(fault) for fault in faults(mechanism) if "has example=" in str(fault)]
