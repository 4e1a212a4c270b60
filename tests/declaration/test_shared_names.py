"""Names of two things: one of them was lost in silence, the user's value, a result, a force, or a failing check."""

from __future__ import annotations

from typing import Annotated, Any

import pytest

from diecut_report.api import (
    Crossings,
    Fact,
    Mechanism,
    Quantity,
    Reduction,
    Value,
    bind,
)
from diecut_report.declaration import faults
from tests.declaration.test_faults import ANGLE, PEAK, TORQUE, Arm, check, is_long, made, require, same, value


def copy(name: str, of: str, **changes: Any) -> Value:
    return value(name, f"C_{name}", unit="mm", formula=bind(same, value=of), **changes)


ZEROS = Crossings(id="zero", symbol="φ_0", unit="deg", description="Zeros", of="torque")


class Placed(Arm):
    peak_at: Annotated[float, Quantity("φ_p", "deg", "Place")] = 3


FACT: Any = Fact(id="width", words="Wide", condition=is_long)

SOUND = {
    "a step that takes over its input": made(copy("arm", "inputs.arm")),
    "a step in the place of an input that is not given": made(copy("width", "arm", lacks=("width",))),
    "both": made(copy("width", "arm", lacks=("width",)), copy("width", "inputs.width", needs=("width",))),
    "a step beside what takes the input": made(copy("arm", "moment", output=False), copy("demanded", "inputs.arm")),
    "an input that is refused": made(copy("width", "arm"), require(id="no_width", key="width", needs=("width",))),
    "an input that a check takes": made(copy("arm", "moment"), checks=(check(demand="inputs.arm", unit="mm"),)),
    "a place that nothing else gives": made(value("peak_place", "P")),
}

HIDES = "has the id of an input, so that what the user gives for"
FAULTS: dict[str, tuple[Mechanism, str]] = {
    "a step with the id of an input": (made(copy("arm", "moment")), f"step arm: {HIDES} arm counts nowhere; name the step otherwise"),
    "of an optional input": (made(copy("width", "arm")), f"step width: {HIDES} width counts nowhere with width"),
    "taken only where it is not made": (
        made(copy("width", "arm"), copy("x", "inputs.width", needs=("width", "mode=away"))),
        f"step width: {HIDES} width counts nowhere with width",
    ),
    "a requirement of another matter": (made(copy("arm", "moment"), require(key="arm")), f"step arm: {HIDES} arm counts nowhere"),
    "a fact with the id of an input": (made(FACT), f"step width: {HIDES} width counts nowhere with width"),
    "a step with the name of a place": (
        made(value("peak_at", "P")),
        "gives peak_at as the place of its extreme, and this name is that of another step (at ",
    ),
    "a step before it": (made(first=(value("peak_at", "P"), value("moment", "M"), ANGLE, TORQUE, PEAK)), "step peak: gives peak_at as the place"),
    "a count of crossings": (made(ZEROS, value("zero_count", "n")), "step zero: gives zero_count as the number of its crossings"),
    "a crossing": (made(ZEROS, value("zero_2", "n")), "step zero: gives zero_2 as one of its crossings"),
    "a part": (
        made(value("bar", "B", formula=bind(same, value="bars.length"), unit="mm", needs=("bars",), numbered="bar_{}_length"),
             value("bar_7_length", "Q")),
        "step bar: gives bar_7_length as one of its parts",
    ),
    "places of one name": (
        made(Reduction(id="zero", symbol="Z", unit="N*m", description="Z", of="torque", operation="max"),
             value("bar", "B", formula=bind(same, value="bars.length"), unit="mm", needs=("bars",), numbered="zero_at{}", first=1),
             value("zero_at1", "Q")),
        "step bar: gives zero_at1 as one of its parts",
    ),
    "an input with the name of a place": (made(inputs=Placed), "gives peak_at as the place of its extreme, and this name is that of an input"),
}  # fmt: skip


@pytest.mark.parametrize("name", SOUND)
def test_names_of_one_thing_pass(name: str) -> None:
    assert [str(fault) for fault in faults(SOUND[name]) if HIDES in str(fault) or "this name is" in str(fault)] == []


@pytest.mark.parametrize("name", FAULTS)
def test_a_name_of_two_things_is_refused_with_its_place(name: str) -> None:
    mechanism, words = FAULTS[name]
    told = list(map(str, faults(mechanism)))
    assert any(words in line for line in told), told
