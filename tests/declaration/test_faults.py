"""Each kind of mistake in a plugin's declarations is told with its place, what it is of, and what to write instead."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    BarGroup,
    Bars,
    Block,
    ByText,
    Case,
    Chapter,
    Check,
    Comparison,
    Constant,
    CurveInput,
    Erratum,
    Inputs,
    Level,
    Mechanism,
    OneOf,
    Panel,
    Plot,
    Profile,
    Quantity,
    Series,
    Source,
    Step,
    Text,
    Vary,
    block,
    formula,
    m,
    parts,
    samples,
)
from diecut_report.config.plugins import Discovery
from diecut_report.declaration import Fault, faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.errors import PluginError
from diecut_report.mechanism.figures import Figure
from diecut_report.mechanism.steps import (
    Abscissa,
    Breakpoints,
    Choice,
    Crossings,
    Fact,
    FromCurve,
    Lookup,
    Neighbour,
    Part,
    Pick,
    Reduction,
    Require,
    Root,
    Running,
    Total,
    Value,
    Words,
)
from diecut_report.standards.tables import StandardSeries
from diecut_report.text.translation import said, speaking
from tests.examples import few


class Bar(Block):
    length = Quantity("l", "mm", "Length")


class Arm(Inputs):
    force = Quantity("F", "N", "Force", default=5)
    arm = Quantity("a", "mm", "Arm", default=10)
    width = Quantity("b", "mm", "Width", optional=True)
    mode = Text("Mode", ("near", "away"), default="near")
    remark = Text("Remark", optional=True)
    bars = parts(Bar, "Bars", optional=True)
    motion = CurveInput("y", "mm", "Motion", optional=True)
    n_points = samples(36)


@formula
def product(force: Any, arm: Any) -> Any:
    return force * arm


@formula
def same(value: Any) -> Any:
    return value


@formula
def turned(force: Any, arm: Any) -> Any:
    return 1 * arm * (force + 0)


@formula
def is_long(arm: Any) -> Any:
    return arm > 0


@formula
def without_return(arm: Any) -> Any:
    arm + 1


def plain(force: Any, arm: Any) -> Any:
    force * arm


def value(name: str, symbol: str = "", **changes: Any) -> Value:
    sound = {"symbol": symbol or f"M_{name}", "unit": "N*m", "description": name, "formula": product}
    return Value(**{"id": name, **sound, **changes})


MOMENT = value("moment", "M")
ANGLE = Abscissa(id="angle", symbol="φ", unit="deg", description="Angle", period=2 * np.pi)
TORQUE = value("torque", "T", formula=lambda angle, moment: moment * np.sin(angle))
PEAK = Reduction(id="peak", symbol="T_max", unit="N*m", description="Peak", of="torque", operation="max")
STEPS = (MOMENT, ANGLE, TORQUE, PEAK)


def check(**changes: Any) -> Check:
    sound = {"id": "strong", "check_class": "strength", "title": "Strong", "demand": "moment", "limit": 3.0, "unit": "N*m", "demand_label": "moment",
             "limit_label": "allowed", "consequence": "shorten the arm"}  # fmt: skip
    return Check(**{**sound, **changes})


def made(*more: Step, first: tuple[Step, ...] = STEPS, **changes: Any) -> Mechanism:
    sound: dict[str, Any] = {"kind": "arm", "version": "1", "title": "Arm", "summary": "", "inputs": Arm,
             "chapters": (Chapter("All", steps=(*first, *more)),)}  # fmt: skip
    return Mechanism(**{**sound, **changes})


def plot(series: str = "torque", unit: str = "N*m", abscissa: str = "angle", **panel: Any) -> Figure:
    drawn = Panel("Torque", unit, series=(Series(series, "T"),), **panel)
    return Plot("turn", "Turn", "", abscissa=abscissa, panels=(drawn,))


def require(**changes: Any) -> Require:
    return Require(**{"id": "long", "condition": is_long, "key": "arm", "message": "is {arm}", **changes})


def with_input(declared: Any) -> type[Inputs]:
    return type(Arm)("Extra", (Arm,), {"extra": declared, "__module__": __name__})


class Torn(Arm):
    one_of = (OneOf(("force",), ("torc",)),)


class Laid(Arm):
    curve_keys = {"force": "force_curve"}


class Needed(Inputs):
    ratio = Quantity("i", "1", "Ratio")


PARTNER = Mechanism(kind="both", version="1", title="", summary="", inputs=Needed, chapters=())
LATE = value("late", formula=product.of(force=m.moment, arm=m.arm), unit="N*m*mm")
SOURCES = (Source("002", "A paper"),)

SOUND = {
    "as it is": made(checks=(check(),), figures=(plot(),), key_results=("moment", "peak")),
    "steps that exclude each other": made(value("other", "Q", needs=("width",)), value("other", "Q", lacks=("width",))),
    "a choice by texts": made(value("other", "Q", needs=("mode=near",)), value("other", "Q", needs=("mode=away",))),
    "an optional input behind its need": made(value("other", formula=product.of(arm=m.width), needs=("width",))),
    "an input that a step takes over": made(value("arm", "a", unit="mm", formula=same.of(value=m.inputs.arm))),
    "a two-sided check": made(checks=(check(at_least=1.0),)),
    "a check on a row": made(checks=(check(demand="bars.length", unit="mm", consequence="shorten bar {part}"),)),
    "a check on a curve": made(checks=(check(demand="torque"),)),
    "advice on what a check follows from": made(
        checks=(
            check(advise=("arm", Vary("force", "down", (1, 2, 3)), Vary("arm", "up"), ("force", "arm"))),
            check(id="long", demand="bars.length", unit="mm", needs=("width",), advise=("bars.length", "width")),
        ),
    ),
    "advice by a text that chooses a formula": made(
        value("side", formula=ByText("mode", {"near": product, "away": turned})),
        checks=(check(demand="side", advise=("mode", Vary("mode", series=("away",)))),),
    ),
    "a cited source": made(value("other", source="002 eq. 3; energy"), sources=SOURCES),
}  # fmt: skip

FAULTS: dict[str, tuple[Mechanism, str]] = {
    # checks that say nothing
    "a check of one quantity with itself": (
        made(checks=(check(limit="moment"),)),
        "check strong: compares moment with moment, which is the same expression: it can never fail",
    ),
    "a check of one formula under two names": (
        made(value("other", "Q"), checks=(check(limit="other"),)),
        "compares moment with other, which is the same expression: it can never fail",
    ),
    "a check of one product, written the other way round": (
        made(value("other", "Q", formula=lambda force, arm: arm * force), checks=(check(limit="other"),)),
        "compares moment with other, which is the same expression: it can never fail",
    ),
    "a check of a quantity with its copy": (
        made(value("copy", "Q", formula=same.of(value=m.moment)), checks=(check(demand="copy", limit="moment"),)),
        "compares copy with moment, which is the same expression: it can never fail",
    ),
    "a check of one formula written another way": (
        made(value("other", "Q", formula=turned), checks=(check(limit="other"),)),
        "compares moment with other, which is the same expression: it can never fail",
    ),
    "a check of a constant with a constant": (
        made(value("fixed", "Q", formula=same.of(value=2.0)), checks=(check(demand="fixed"),)),
        "compares fixed with 3, neither of which depends on an input: its verdict is always the same",
    ),
    "a check of what is bounded by its own limit": (
        made(
            value("most", "Q", formula=lambda moment, peak: np.minimum(moment, peak)),
            checks=(check(demand="most", limit="peak"),),
        ),
        "compares most with peak, by which it is bounded itself: it can never fail",
    ),
    # ids and order
    "an id that nothing gives": (
        made(value("x", formula=product.of(arm=m.arms))),
        "step x: takes arms, which nothing gives (did you mean 'arm'?)",
    ),
    "an id before it is calculated": (
        made(first=(LATE, *STEPS)),
        "step late: takes moment before it is calculated (at test_faults.py:",
    ),
    "an optional input without its need": (
        made(value("x", formula=product.of(arm=m.width))),
        "step x: takes width, which nothing gives without width",
    ),
    "a step that is there in one mode only": (
        made(value("x", needs=("mode=near",)), value("y", formula=same.of(value=m.x))),
        "step y: takes x, which nothing gives with mode=away",
    ),
    "two steps of one id": (made(value("moment", "Q")), "step moment: has the id of another step (at test_faults.py:"),
    "two steps of one id that overlap": (
        made(value("x", needs=("width",)), value("x", "Q", needs=("mode=near",))),
        "both are made with mode=near and with width",
    ),
    "a step that is never made": (made(value("x", needs=("width",), lacks=("width",))), "step x: is never calculated"),
    "two checks of one id": (made(checks=(check(), check(limit=4.0))), "check strong: has the id of another check"),
    "two figures of one id": (made(figures=(plot(), plot())), "figure turn: has the id of another figure"),
    "no symbol": (made(value("x", description="")), "step x: has no symbol or no description"),
    "one symbol for two": (made(value("x", "M")), "step x: has the symbol M of moment"),
    "one symbol for an input and a step": (made(value("x", "F")), "step x: has the symbol F of force"),
    "the symbol of the samples": (
        made(value("x", "N")),
        "step x: has the symbol N of n_points (samples, at test_faults.py:",
    ),
    # tokens
    "a need that is not an input": (
        made(value("x", needs=("widht",))),
        "step x: needs names widht, which is not an input (did you mean 'width'?)",
    ),
    "a need that is a step": (
        made(value("x", needs=("moment",))),
        "needs names moment, which is a step; only inputs can be named",
    ),
    "a text that is not allowed": (
        made(value("x", lacks=("mode=nere",))),
        "lacks names mode=nere (did you mean 'near'?); mode may be near, away",
    ),
    "a text of a number": (
        made(value("x", needs=("arm=1",))),
        "needs names arm=1, but arm is not a text with allowed values",
    ),
    "a need of a check": (
        made(checks=(check(needs=("wide",)),)),
        "check strong: needs names wide, which is not an input",
    ),
    "a need of a section": (
        made(chapters=(Chapter("All", steps=STEPS), Chapter("More", steps=(), needs=("wide",)))),
        "chapter 'More': needs names wide",
    ),
    # messages
    "an unknown id in a message": (
        made(require(message="is {arms}")),
        "step long: the message names arms, which nothing gives",
    ),
    "an id that comes later": (
        made(first=(require(message="is {moment}"), *STEPS)),
        "the message names moment before it is calculated",
    ),
    "a curve in a message": (made(require(message="is {torque}")), "{torque}, a curve, which has no single number"),
    "a key that is not an input": (
        made(require(key="amr")),
        "step long: the key 'amr' is not an input (did you mean 'arm'?)",
    ),
    "names of parts of a check that has none": (
        made(checks=(check(named_by="bars.length"),)),
        "check strong: is one check for each of bars.length, but compares no row over repeated parts",
    ),
    "names of parts that are numbers": (
        made(checks=(check(demand="bars.length", unit="mm", named_by="bars.length"),)),
        "check strong: is one check for each of bars.length, which is not a text of repeated parts",
    ),
    "an unknown id in a consequence": (
        made(checks=(check(consequence="see {momnt}"),)),
        "check strong: the consequence names momnt, which nothing gives",
    ),
    "a part of what has none": (
        made(checks=(check(consequence="part {part}"),)),
        "the consequence names part, which nothing gives",
    ),
    "a text made of what is not given": (
        made(Words(id="advice", function=str, takes=("width",)), checks=(check(consequence="{advice}"),)),
        "takes width, which nothing gives",
    ),
    "an id in a caption": (
        made(figures=(replace(plot(), caption="At {moment}"),)),
        "{moment} stands in braces in caption",
    ),
    # checks
    "an unknown side": (
        made(checks=(check(demand="momnt"),)),
        "check strong: takes momnt, which nothing gives (did you mean 'moment'?)",
    ),
    "a text as a side": (made(checks=(check(demand="mode"),)), "check strong: compares mode, a text"),
    "a check in another unit": (made(checks=(check(unit="mm"),)), "check strong: is in mm, moment in N*m"),
    "a check of numbers alone": (made(checks=(check(demand=1.0),)), "compares plain numbers only"),
    "a row against a curve": (
        made(checks=(check(demand="bars.length", limit="torque", unit="mm"),)),
        "compares what runs over",
    ),
    # advice
    "advice on a key that is not an input": (
        made(checks=(check(advise=("amr",)),)),
        "check strong: advise names amr, which is not an input (did you mean 'arm'?)",
    ),
    "advice on a step": (
        made(checks=(check(advise=(Vary("moment", "down"),)),)),
        "check strong: advise names moment, which is a step; only inputs can be named",
    ),
    "advice on a text that may be any": (
        made(checks=(check(advise=("remark",)),)),
        "check strong: advise names remark, which is neither a number nor a text with allowed values",
    ),
    "advice on a curve": (
        made(checks=(check(advise=("motion",)),)),
        "check strong: advise names motion, which is neither a number nor a text with allowed values",
    ),
    "advice on a text together with a number": (
        made(checks=(check(advise=(("mode", "arm"),)),)),
        "check strong: advise names mode together with arm, but texts are changed each by itself",
    ),
    "advice on nothing": (
        made(checks=(check(advise=((),)),)),
        "check strong: advise holds (); write the key of an input",
    ),
    "advice on keys in one list": (
        made(checks=(check(advise=(["arm", "force"],)),)),
        "check strong: advise holds ['arm', 'force']; write the key of an input",
    ),
    "advice in a list": (
        made(checks=(check(advise=["arm"]),)),
        "check strong: has advise=['arm']; write a tuple of ways, with a comma behind a single one",
    ),
    "advice on a key that changes nothing of the check": (
        made(checks=(check(advise=("width",)),)),
        "check strong: advise names width, on which its verdict does not depend",
    ),
    "advice on a key that changes nothing of what is required": (
        made(require(advise=("force",))),
        "step long: advise names force, on which its verdict does not depend",
    ),
    "advice to an unknown side": (
        made(checks=(check(advise=(Vary("arm", "dwon"),)),)),
        "check strong: the advice on arm has to='dwon' (did you mean 'down'?)",
    ),
    "advice by a descending series": (
        made(checks=(check(advise=(Vary("arm", series=(8, 6, 6)),)),)),
        "check strong: the advice on arm has a series that does not ascend (8 before 6)",
    ),
    "advice by a series of texts": (
        made(checks=(check(advise=(Vary("arm", series=("8 mm",)),)),)),
        "check strong: the advice on arm has '8 mm' in its series; write plain numbers, which count in its unit (mm)",
    ),
    "advice by a standard series in another unit": (
        made(checks=(check(advise=(Vary("force", series=StandardSeries("", "R10", "mm", (1.0, 2.0), ())),)),)),
        "check strong: the series “R10” is in mm, force in N",
    ),
    "advice by a series that the key cannot have": (
        made(checks=(check(advise=(Vary("arm", series=(1e-5, 2e-5)),)),)),
        "check strong: the advice on arm has a series of which no value is allowed: 1e-05 mm is not plausible",
    ),
    "advice by texts that are not allowed": (
        made(
            value("side", formula=ByText("mode", {"near": product, "away": turned})),
            checks=(check(demand="side", advise=(Vary("mode", series=("awy",)),)),),
        ),
        "check strong: the advice on mode has 'awy' in its series (did you mean 'away'?)",
    ),
    # kinds
    "an extreme of a number": (
        made(replace(PEAK, id="x", symbol="X", of="moment")),
        "of is moment, a number; a curve over an abscissa is wanted",
    ),
    "a formula of a text": (made(value("x", formula=same.of(value=m.mode))), "the formula is mode, a text"),
    "a curve input taken directly": (
        made(value("x", formula=same.of(value=m.motion), needs=("motion",))),
        "motion, a curve input",
    ),
    "rows and curves mixed": (
        made(value("x", formula=product.of(force=m.torque, arm=m.bars.length), needs=("bars",))),
        "mixes what runs over",
    ),
    "a curve over no abscissa": (
        made(
            FromCurve(
                id="y", symbol="y", unit="mm", description="y", given="motion", abscissa="moment", needs=("motion",)
            )
        ),
        "abscissa is moment, a number; the id of an Abscissa is wanted",
    ),
    # formulas and tables
    "a plain function without a return": (made(value("x", formula=plain)), "the formula cannot be printed:"),
    "no return": (made(value("x", formula=without_return)), "the formula cannot be printed:"),
    "a table without an allowed text": (
        made(Lookup(unit="1", id="x", symbol="x", description="x", by="mode", table={"near": 1.0})),
        "step x: has no row in the table for mode=away; add it",
    ),
    "a choice of a formula without a text": (
        made(value("x", formula=ByText("mode", {"near": product}))),
        "step x: has no formula for mode=away",
    ),
    "a choice by any text": (
        made(Lookup(unit="1", id="x", symbol="x", description="x", by="remark", table={"a": 1.0}, needs=("remark",))),
        "remark, which may be any text",
    ),
    "an unknown that the equation does not take": (
        made(
            Root(
                unit="1",
                id="x",
                symbol="x",
                description="x",
                equation=same.of(value=m.y),
                unknown="x",
                low=same.of(value=0),
                high=same.of(value=1),
                left=same.of(value=m.x),
                right=same.of(value=1),
            )
        ),
        "the unknown x is nothing that the equation takes",
    ),
    "an unknown unit": (made(value("x", unit="mmm")), "step x: has the unit 'mmm'"),
    "no cases": (made(Choice(unit="1", id="x", symbol="x", description="x", cases=())), "step x: has no cases"),
    # figures
    "a curve in another unit than its axis": (
        made(figures=(plot(unit="mm"),)),
        "figure turn: draws torque, in N*m, on an axis in mm",
    ),
    "a number as a curve": (
        made(figures=(plot("moment"),)),
        "draws moment, which is a number; a curve is wanted there",
    ),
    "an unknown curve": (
        made(figures=(plot("torqe"),)),
        "figure turn: draws torqe, which nothing gives (did you mean 'torque'?)",
    ),
    "no abscissa": (made(figures=(plot(abscissa="moment"),)), "the abscissa is moment, which is not an Abscissa"),
    "a level that is not always there": (
        made(value("x", needs=("width",)), figures=(plot(levels=(Level("x", "x"),)),)),
        "draws x, which nothing gives without width",
    ),
    "a bar in another unit": (
        made(figures=(Bars("b", "", "", groups=(BarGroup("", "N", bars=(("M", "-moment"),)),)),)),
        "draws moment, in N*m, on an axis in N",
    ),
    # inputs
    "a default out of its bounds": (
        made(inputs=with_input(Quantity("x", "mm", "X", gt=0, default=-3))),
        "input extra: the default -3 mm is out of range; allowed: > 0 mm",
    ),
    "a default that is not allowed": (
        made(inputs=with_input(Text("Colour", ("red", "blue"), default="rad"))),
        "has the default 'rad' (did you mean 'red'?)",
    ),
    "an input in an unknown unit": (
        made(inputs=with_input(Quantity("x", "mmm", "X", default=1))),
        "input extra: has the unit 'mmm'",
    ),
    "a curve on an unknown key": (
        made(inputs=Laid),
        "curve_keys of Laid: lay force on force_curve; a Quantity and a CurveInput of the inputs are needed",
    ),
    "a rule of an unknown key": (made(inputs=Torn), "one_of of Torn: names torc, which is not an input"),
    "units beside an unknown key": (
        made(value("x", units=(("wdth", "N"),))),
        "step x: has units beside wdth, which is not an input (did you mean 'width'?)",
    ),
    "units beside what is always given": (
        made(value("x", units=(("arm", "N"),))),
        "units beside arm, which is not an optional input",
    ),
    # what is said beside
    "an unknown key result": (
        made(key_results=("momnt",)),
        "key_results: momnt is not a step (did you mean 'moment'?)",
    ),
    "a key result that is not an output": (
        made(value("x", output=False), key_results=("x",)),
        "x is not an output; take output=False away",
    ),
    "a source that is not listed": (
        made(value("x", source="003 eq. 1"), sources=SOURCES),
        "step x: cites 003, which is not a source",
    ),
    "a source whose name begins as a listed one": (
        made(value("x", source=f"{SOURCES[0].id}2, eq. 1"), sources=SOURCES),
        f"step x: cites {SOURCES[0].id}2, which is not a source",
    ),
    "an erratum of no source": (
        made(errata=(Erratum("004", "wrong"),), sources=SOURCES),
        "erratum of 004: is of no listed source",
    ),
    "an erratum that touches nothing": (
        made(errata=(Erratum("002", "wrong", ("momnt",)),), sources=SOURCES),
        "touches momnt, which nothing gives",
    ),
    "an export of a number": (
        made(exports=(Profile(id="p", title="P", columns=("torque", "moment")),)),
        "export p: writes moment, which is not a curve",
    ),
    "a comparison of an unknown quantity": (
        made(comparisons=(Comparison(kinds=("arm",), mechanism=PARTNER, takes={"ratio": ("arm", "momnt")}),)),
        "comparison both: takes momnt, which nothing gives",
    ),
    "a comparison that leaves an input open": (
        made(comparisons=(Comparison(kinds=("arm",), mechanism=PARTNER, takes={}),)),
        "fills nothing into ratio, which is required",
    ),
}


# Mistakes that Python, or a value that happens to fit, would let pass: each gave a wrong number, or a wrong pass, in silence.


class Spring(Block):
    rate = Quantity("c", "N/mm", "Rate")


@formula
def doubled(arm: Any) -> Any:
    return 2 * arm


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
    ends = {"low": same.of(value=0.0), "high": same.of(value=m.moment)}
    sides = {
        "equation": lambda x, moment: x / moment,
        "left": same.of(value=m.x),
        "right": same.of(value=m.moment),
    }
    return Root(**{"id": "x", "symbol": "x", "unit": "N*m", "description": "x", **ends, **sides, **changes})


TWO = doubled.of()
LONG = is_long.of()

SOUND |= {
    "a flag of a flag": made(value("long", "λ", unit="1", formula=is_long),
                             chosen(Case(TWO, "long", same.of(value=m.long)), Case(TWO, "short"), unit="mm")),
    "a condition with branches": made(require(condition=lambda arm: np.where(arm > 1, arm > 2, arm > 3))),
    "a quantity that exists": made(value("x", exists=LONG)),
    "a neighbour in other millimetres": made(of_bars(Neighbour, "m")),
    "a pick": made(pick()),
    "a root": made(root()),
    "a self-test of two ways": made(value("x", unit="1", formula=lambda moment, peak: abs(moment - peak) / moment),
                                    checks=(check(check_class="numerical", demand="x", unit="1", limit=1e-6),)),
    "a tolerance of rounding": made(checks=(check(tolerance=1e-6),)),
}  # fmt: skip

FAULTS |= {
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
        made(value("x", unit="1", formula=lambda moment: abs(moment - moment) / moment),
             checks=(check(check_class="numerical", demand="x", unit="1", limit=1e-6),)),
        "check strong: compares x with 1e-06, neither of which depends on an input: its verdict is always the same"),
    "a self-test of what cancels by another name": (
        made(value("copy", "Q", formula=same.of(value=m.moment)), value("x", unit="1", formula=lambda moment, copy: abs(moment - copy) / moment),
             checks=(check(check_class="numerical", demand="x", unit="1", limit=1e-6),)),
        "check strong: compares x with 1e-06, neither of which depends on an input"),
    "a quotient of what is the same": (
        made(value("x", unit="1", formula=lambda moment: moment / moment), checks=(check(demand="x", unit="1", limit=1.001),)),
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
    "a series in another unit": (made(pick(series=StandardSeries("", "R10", "kW", (1.0, 2.0), ()))), "the series “R10” is in kW, the step in mm"),
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
    "a field of a block without its need": (
        made(value("x", formula=same.of(value=m.extra.rate)), inputs=with_input(block(Spring, "Spring", optional=True))),
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
        made(inputs=with_input(Quantity("z", "mm", "Z", integer=True, default=3))),
        "input extra: is a whole number in mm; a count has the unit 1",
    ),
}  # fmt: skip


# Names of two things: one of them was lost in silence, the user's value, a result, a force, or a failing check.


def copy(name: str, of: str, **changes: Any) -> Value:
    return value(name, f"C_{name}", unit="mm", formula=same.of(value=m[of]), **changes)


ZEROS = Crossings(id="zero", symbol="φ_0", unit="deg", description="Zeros", of="torque")


class Placed(Arm):
    peak_at = Quantity("φ_p", "deg", "Place", default=3)


FACT: Any = Fact(id="width", words="Wide", condition=is_long)

ONE_THING = {
    "a step that takes over its input": made(copy("arm", "inputs.arm")),
    "a step in the place of an input that is not given": made(copy("width", "arm", lacks=("width",))),
    "both": made(copy("width", "arm", lacks=("width",)), copy("width", "inputs.width", needs=("width",))),
    "a step beside what takes the input": made(copy("arm", "moment", output=False), copy("demanded", "inputs.arm")),
    "an input that is refused": made(copy("width", "arm"), require(id="no_width", key="width", needs=("width",))),
    "an input that a check takes": made(copy("arm", "moment"), checks=(check(demand="inputs.arm", unit="mm"),)),
    "a place that nothing else gives": made(value("peak_place", "P")),
}

HIDES = "has the id of an input, so that what the user gives for"
FAULTS |= {
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
        made(value("bar", "B", formula=same.of(value=m.bars.length), unit="mm", needs=("bars",), numbered="bar_{}_length"),
             value("bar_7_length", "Q")),
        "step bar: gives bar_7_length as one of its parts",
    ),
    "places of one name": (
        made(Reduction(id="zero", symbol="Z", unit="N*m", description="Z", of="torque", operation="max"),
             value("bar", "B", formula=same.of(value=m.bars.length), unit="mm", needs=("bars",), numbered="zero_at{}", first=1),
             value("zero_at1", "Q")),
        "step bar: gives zero_at1 as one of its parts",
    ),
    "an input with the name of a place": (made(inputs=Placed), "gives peak_at as the place of its extreme, and this name is that of an input"),
}  # fmt: skip


@pytest.mark.parametrize("name", SOUND)
def test_what_is_sound_passes(name: str) -> None:
    assert list(map(str, faults(SOUND[name]))) == []


@pytest.mark.parametrize("name", few(FAULTS, keep=lambda name: [*FAULTS].index(name) % 2 == 0))
def test_a_mistake_is_told_with_its_place_and_in_ukrainian(name: str) -> None:
    found = assert_told(*FAULTS[name])
    with speaking("uk"):  # only names of the contract, ids and what was written stay as they are
        translated = [said(str(fault)) for fault in found]
    assert [line for line in translated if re.search(r"[a-z]{2,} [a-z]{2,}", line)] == []
    assert all(re.search("[а-яіїєґ]{3}", line) for line in translated)


def assert_told(mechanism: Mechanism, words: str) -> list[Fault]:
    """Return the mistakes of a mechanism, of which one is told in these words, each with its place."""
    found = faults(mechanism)
    told = list(map(str, found))
    assert any(words in line for line in told), told
    assert all(re.match(r"test_faults\.py:", line) for line in told), told
    return found


def test_the_authors_test_fails_by_a_mistake() -> None:
    mechanism, words = FAULTS["a default out of its bounds"]
    with pytest.raises(AssertionError, match=re.escape(words)):
        check_mechanism(mechanism)


def test_a_place_is_the_line_of_the_author_and_is_kept() -> None:
    here = Path(__file__).read_text("utf-8").splitlines()
    file, _, line = MOMENT.at.rpartition(":")
    assert file == __file__ and "return Value(" in here[int(line) - 1]
    assert replace(MOMENT, symbol="Q").at == MOMENT.at and "at=" not in repr(MOMENT)
    assert Quantity("F", "N", "Force") == Quantity("F", "N", "Force")


def test_a_case_of_a_text_and_its_words_are_read() -> None:
    step = Choice(
        unit="1", id="x", symbol="x", description="x", cases=(Case("yes", "as {moment}", is_long), Case("no", "else"))
    )
    assert "{moment} stands in braces in the words of a case" in str(faults(made(step)))


@pytest.mark.parametrize("name", ONE_THING)
def test_names_of_one_thing_pass(name: str) -> None:
    assert [
        str(fault) for fault in faults(ONE_THING[name]) if HIDES in str(fault) or "this name is" in str(fault)
    ] == []


TWICE = """
from diecut_report.api import *


class Twice(Inputs):
    arm = Quantity("a", "mm", "Arm", default=10)
    arm = Quantity("a", "mm", "Arm", default=20)


@formula
def reach(arm):
    return 2 * arm


@formula
def reach(arm):
    return 3 * arm


chapter = Chapter("All")
chapter.reach = reach, "r", "mm", "Reach"
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
    sheets = Quantity("N", "1", "Sheets of a stack", integer=True)
    n_points = samples(36)


def test_an_input_with_the_symbol_of_the_samples_is_told_at_its_own_line() -> None:
    chapter = Chapter("All")
    chapter.pairs = m.sheets / 2, "n_p", "1", "Pairs"
    own = Mechanism(kind="sheets", version="1", title="Sheets", summary="", inputs=Sheets, chapters=(chapter,))
    (fault,) = faults(own)
    lines = Path(__file__).read_text("utf-8").splitlines()
    at = next(number for number, line in enumerate(lines, 1) if line.startswith("    sheets = "))
    assert str(fault).startswith(
        f"{Path(__file__).name}:{at}: input sheets: has the symbol N of n_points (samples, at {Path(__file__).name}:{at + 1})"
    )
