"""Mistakes that Python, or a value that happens to fit, would let pass: each gave a wrong number, or a wrong pass, in silence."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pytest

from diecut_report.api import (
    POINTS,
    Block,
    Breakpoints,
    Case,
    Chapter,
    Choice,
    Constant,
    Crossings,
    Erratum,
    Inputs,
    Mechanism,
    Neighbour,
    Part,
    Pick,
    Quantity,
    Root,
    Running,
    Source,
    Text,
    Total,
    Words,
    bind,
    formula,
    standard_series,
)
from diecut_report.config.plugins import Discovery
from diecut_report.declaration import faults
from diecut_report.errors import PluginError
from tests.declaration.test_faults import (
    PEAK,
    STEPS,
    Arm,
    assert_told,
    check,
    is_long,
    made,
    plot,
    require,
    same,
    value,
    with_input,
)
from tests.examples import few


class Spring(Block):
    rate: Annotated[float, Quantity("c", "N/mm", "Rate")]


@formula
def doubled(arm: Any) -> Any:
    return 2 * arm


@formula
def difference(one: Any, other: Any) -> Any:
    return abs(one - other) / one


@formula
def quotient(one: Any, other: Any) -> Any:
    return one / other


@formula
def nested_flag(arm: Any) -> Any:
    return np.where(arm > 1, arm > 2, arm > 3)


def chosen(*cases: Case, **changes: Any) -> Choice:
    return Choice(**{"id": "x", "symbol": "x", "unit": "1", "description": "x", "cases": cases, **changes})


def of_bars(kind: Any, unit: str = "mm", of: str = "bars.length", **more: Any) -> Any:
    return kind(id="x", symbol="x", unit=unit, description="x", of=of, needs=("bars",), **more)


def pick(**changes: Any) -> Pick:
    sound = {
        "id": "x",
        "symbol": "x",
        "unit": "mm",
        "description": "x",
        "of": "arm",
        "rule": "above",
        "series": (1.0, 20.0),
    }
    return Pick(**{**sound, **changes})


def root(**changes: Any) -> Root:
    ends = {"low": bind(same, value=0.0), "high": bind(same, value="moment")}
    sides = {
        "equation": bind(quotient, one="x", other="moment"),
        "left": bind(same, value="x"),
        "right": bind(same, value="moment"),
    }
    return Root(**{"id": "x", "symbol": "x", "unit": "N*m", "description": "x", **ends, **sides, **changes})


TWO = bind(doubled)
LONG = bind(is_long)

SOUND = {
    "a flag of a flag": made(value("long", "λ", unit="1", formula=is_long),
                             chosen(Case(TWO, "long", bind(same, value="long")), Case(TWO, "short"), unit="mm")),
    "a condition with branches": made(require(condition=nested_flag)),
    "a quantity that exists": made(value("x", exists=LONG)),
    "a neighbour in other millimetres": made(of_bars(Neighbour, "m")),
    "a pick": made(pick()),
    "a root": made(root()),
    "a self-test of two ways": made(value("x", unit="1", formula=bind(difference, one="moment", other="peak")),
                                    checks=(check(check_class="numerical", demand="x", unit="1", limit=1e-6),)),
    "a tolerance of rounding": made(checks=(check(tolerance=1e-6),)),
}  # fmt: skip

FAULTS: dict[str, tuple[Mechanism, str]] = {
    # conditions
    "a requirement that is a number": (made(require(condition=doubled)), "step long: the condition gives a number, not yes or no"),
    "a case by a number": (made(chosen(Case(TWO, "a", TWO), Case(TWO, "b"), unit="mm")), "step x: the condition of a case gives a number"),
    "a quantity that exists by a number": (made(value("x", exists=TWO)), "step x: the condition exists gives a number"),
    "a comparison with a unit": (made(value("x", formula=is_long)), "step x: gives yes or no (1 or 0), but has the unit N*m"),
    # checks
    "a tolerance in per cent": (made(checks=(check(tolerance=5),)), "check strong: has the tolerance 5, a share of the limit; allowed: 0 to 0.01"),
    "a tolerance below zero": (made(checks=(check(tolerance=-0.001),)), "has the tolerance -0.001"),
    "a limit that is not a number": (made(checks=(check(limit=float("nan")),)), "check strong: compares nan, which is not a finite number"),
    "a lower bound without end": (made(checks=(check(at_least=float("-inf")),)), "check strong: compares -inf, which is not a finite number"),
    "a failure beyond what is not a number": (
        made(checks=(check(severity="warn", fails_beyond=float("nan")),)), "check strong: compares nan, which is not a finite number"),
    "a check that vanishes with its limit": (
        made(checks=(check(demand="arm", unit="mm", limit="width", only_with=("width",)),)),
        "check strong: has the limit width and names it in only_with, so that the check vanishes where it is not given"),
    "a self-test of what cancels": (
        made(value("x", unit="1", formula=bind(difference, one="moment", other="moment")),
             checks=(check(check_class="numerical", demand="x", unit="1", limit=1e-6),)),
        "check strong: compares x with 1e-06, neither of which depends on an input: its verdict is always the same"),
    "a self-test of what cancels by another name": (
        made(value("copy", "Q", formula=bind(same, value="moment")), value("x", unit="1", formula=bind(difference, one="moment", other="copy")),
             checks=(check(check_class="numerical", demand="x", unit="1", limit=1e-6),)),
        "check strong: compares x with 1e-06, neither of which depends on an input"),
    "a quotient of what is the same": (
        made(value("x", unit="1", formula=bind(quotient, one="moment", other="moment")), checks=(check(demand="x", unit="1", limit=1.001),)),
        "check strong: compares x with 1.001, neither of which depends on an input"),
    "a check of one part of what has none": (
        made(checks=(check(index=3),)), "check strong: is of part index=3 alone, but compares no row over repeated parts"),
    "a proof that leaves a third": (
        made(root(tolerance=0.3)), "step x: has the tolerance 0.3, the share by which its left and right may differ; allowed: above 0, to 1e-06"),
    "a proof that is not a number": (made(root(tolerance=float("nan"))), "step x: has the tolerance nan"),
    "an unknown severity": (made(checks=(check(severity="warning"),)), "has severity='warning' (did you mean 'warn'?); allowed: 'fail', 'warn'"),
    "an unknown operator": (made(checks=(check(operator=">="),)), "has operator='>='"),
    # words
    "an unknown operation": (made(replace(PEAK, id="x", symbol="X", operation="maximum")), "step x: has operation='maximum'"),
    "an unknown total": (made(of_bars(Total, operation="mean")), "step x: has operation='mean'"),
    "an unknown running": (made(of_bars(Running, operation="max")), "step x: has operation='max'"),
    "a neighbour two parts on": (made(of_bars(Neighbour, shift=2)), "step x: has shift=2; allowed: 1, -1"),
    "an unknown rule": (made(pick(rule="next")), "step x: has rule='next'"),
    "a text for yes or no": (made(value("x", output="no")), "step x: has output='no'; allowed: True, False"),
    "a text for a tuple": (made(key_results="moment"), "has key_results='moment', a text; write a tuple, ('moment',)"),
    "a text for places": (made(Breakpoints(id="b", abscissa="angle", places="arm")), "has places='arm', a text"),
    # rows and curves of what has none
    "a total of a number": (made(of_bars(Total, of="arm", operation="sum")), "of is arm, a number; a row over repeated parts is wanted"),
    "a total among a number": (made(of_bars(Total, operation="sum", among="arm")), "among is arm, a number; a row over repeated parts is wanted"),
    "a part of a curve": (made(of_bars(Part, "N*m", of="torque", index=0)), "of is torque, a curve; a row over repeated parts is wanted"),
    "a running of a number": (made(of_bars(Running, of="arm", operation="sum")), "of is arm, a number"),
    "a neighbour of a number": (made(of_bars(Neighbour, of="arm")), "of is arm, a number"),
    "crossings of a number": (made(Crossings(id="x", symbol="x", unit="deg", description="x", of="moment")), "of is moment, a number"),
    # units
    "a part in another unit": (made(of_bars(Part, "N", index=0)), "step x: is in N, bars.length in mm"),
    "a total in another unit": (made(of_bars(Total, "N", operation="max")), "step x: is in N, bars.length in mm"),
    "a product of lengths": (made(of_bars(Total, "mm", operation="product")), "a product of any number of parts in 1"),
    "a running in another unit": (made(of_bars(Running, "N", operation="sum")), "step x: is in N, bars.length in mm"),
    "a neighbour in another unit": (made(of_bars(Neighbour, "N")), "step x: is in N, bars.length in mm"),
    "crossings in another unit": (made(Crossings(id="x", symbol="x", unit="N*m", description="x", of="torque")), "step x: is in N*m, angle in deg"),
    "an extreme in another unit": (made(replace(PEAK, id="x", symbol="X", unit="N")), "step x: is in N, torque in N*m"),
    "a pick in another unit": (made(pick(unit="N")), "step x: is in N, arm in mm"),
    "a pick by another unit": (made(pick(of="force")), "step x: is in mm, force in N"),
    "a series in another unit": (made(pick(series=standard_series("iec_60072_ratings"))), "motors (IEC 60072-1)” is in kW, the step in mm"),
    # choices
    "text and number": (made(chosen(Case("yes", "a", LONG), Case(TWO, "b"), unit="mm")), "step x: mixes texts and numbers in its cases"),
    "a last case with a condition": (made(chosen(Case(TWO, "a", LONG), Case(TWO, "b", LONG), unit="mm")), "has a condition in its last case"),
    "a case that is always taken": (made(chosen(Case(TWO, "a"), Case(TWO, "b"), unit="mm")), "has no condition in case 1 of 2"),
    # one id
    "a wrong lacks": (made(value("x", needs=("width",)), value("x", "Q", lacks=("widht",))), "lacks names widht, which is not an input"),
    "steps of one id with another lack": (made(value("x", needs=("width",)), value("x", "Q", lacks=("remark",))), "has the id of another step"),
    # what vanishes
    "two chapters of one title": (made(chapters=(Chapter("All", steps=STEPS), Chapter("All"))), "has the title of another chapter"),
    "two sources of one id": (made(sources=(Source("1", "a"), Source("1", "b"))), "source 1: has the id of another source"),
    "a format in a message": (made(require(message="is {arm:.1f}")), "the message names {arm:.1f}"),
    "an open brace in a message": (made(require(message="is {arm")), "the message names {arm"),
    "an open brace in a consequence": (made(checks=(check(consequence="is {arm"),)), "the consequence names {arm"),
    "words of a function that takes more": (
        made(Words(id="w", function=lambda one, two: "", takes=("arm",))),
        "step w: its function takes 2, and takes names 1",
    ),
    "parameters in another order than what is taken": (
        made(Words(id="w", function=lambda force, arm: "", takes=("arm", "force"))),
        "step w: its function has the parameters force, arm, and takes names arm, force: each is given by its position; where",
    ),
    "an erratum that touches an unknown": (made(errata=(Erratum("1", "e", touches=("momnt",)),), sources=(Source("1", "a"),)), "touches momnt"),
    "a field of a block without its need": (
        made(value("x", formula=bind(same, value="extra.rate")), inputs=with_input(Annotated[Spring | None, Text("Spring")], None)),
        "step x: takes extra.rate",
    ),
    "a need of a figure": (made(figures=(replace(plot(), needs=("widht",)),)), "figure turn: needs names widht"),
    "keys that are not read": (
        made(inputs=type("Loose", (Arm,), {"__module__": __name__, "model_config": {"extra": "ignore"}})),
        "class Loose: changes extra in its model_config, so that keys that are misspelt may pass unread; take it away",
    ),
    "a symbol in LaTeX": (made(value("x", r"\frac{a}{b}")), r"step x: has the symbol \frac{a}{b} with \ { }; a symbol is plain text"),
    "a symbol in dollars": (made(value("x", "$x_1$")), "step x: has the symbol $x_1$ with $"),
    "a whole number in a unit": (
        made(inputs=with_input(Annotated[int, Quantity("z", "mm", "Z", integer=True)], 3)),
        "input extra: is a whole number in mm; a count has the unit 1",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SOUND)
def test_what_is_sound_passes(name: str) -> None:
    assert list(map(str, faults(SOUND[name]))) == []


@pytest.mark.parametrize("name", few(FAULTS, keep=lambda name: [*FAULTS].index(name) % 2 == 0))
def test_a_mistake_is_told_with_its_place(name: str) -> None:
    assert_told(*FAULTS[name])


TWICE = """
from diecut_report.api import *


class Twice(Inputs):
    arm: Annotated[float, Quantity("a", "mm", "Arm")] = 10
    arm: Annotated[float, Quantity("a", "mm", "Arm")] = 20


@formula
def reach(arm):
    return 2 * arm


@formula
def reach(arm):
    return 3 * arm


chapter = Chapter("All")
chapter.value("reach", "r", "mm", "Reach", reach)
MECHANISM = Mechanism(kind="twice", version="1", title="", summary="", inputs=Twice, chapters=(chapter,))
"""


def test_what_a_file_defines_twice_is_told(tmp_path: Path) -> None:
    file = tmp_path / "twice.py"
    file.write_text(TWICE, "utf-8")
    with pytest.raises(PluginError) as caught:
        Discovery([tmp_path]).mechanism("twice")
    told = [line.strip() for line in str(caught.value).splitlines()[1:]]
    assert told == [
        "twice.py:7: arm: is a field twice, at first in line 6, and only the last one counts; give one of them another name, or take it away",
        "twice.py:16: reach: is defined twice, at first in line 11, and only the last one counts; give one of them another name, or take it away",
    ]


def test_a_constant_in_no_coherent_unit_is_refused() -> None:
    with pytest.raises(TypeError, match=r"g is in mm/s\*\*2, which is 0.001 m/s\*\*2; give it in SI"):
        Constant(9806.65, "g", "mm/s**2")
    assert Constant(9.80665, "g", "m/s**2") == 9.80665


@formula
def unprintable(arm: Any) -> Any:
    return [arm, arm]


def test_a_formula_that_cannot_be_printed_is_told_once() -> None:
    (fault,) = faults(made(value("x", formula=unprintable, output=True)))
    assert "the formula cannot be printed" in str(fault)


class Sheets(Inputs):
    sheets: Annotated[int, Quantity("N", "1", "Sheets of a stack", integer=True)]
    n_points: Annotated[int, POINTS] = 36


def test_an_input_with_the_symbol_of_the_samples_is_told_at_its_own_line() -> None:
    chapter = Chapter("All")
    chapter.value("pairs", "n_p", "1", "Pairs", lambda sheets: sheets / 2)
    own = Mechanism(kind="sheets", version="1", title="Sheets", summary="", inputs=Sheets, chapters=(chapter,))
    (fault,) = faults(own)
    lines = Path(__file__).read_text("utf-8").splitlines()
    at, points = (1 + lines.index(line) for line in lines if line.startswith(("    sheets: ", "    n_points: ")))
    assert str(fault).startswith(
        f"{Path(__file__).name}:{at}: input sheets: has the symbol N of n_points (POINTS, at {Path(__file__).name}:{points})"
    )
