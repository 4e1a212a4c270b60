"""Curves that are taken over from an input, or made by plain code for one machine."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.steps import plain_code
from diecut_report.mechanism.steps.abscissa import require_length
from diecut_report.mechanism.steps.base import Over, QuantityStep
from diecut_report.mechanism.steps.protocols import (
    AN_ABSCISSA,
    CURVE_INPUT,
    NUMBER,
    PLAIN,
    Impossible,
    Item,
    Kinds,
    StepEngine,
    StepPrinter,
)
from diecut_report.quantities.units import Kind, pretty, unit
from diecut_report.text.phrases import Phrase


class CurveOverAbscissa(QuantityStep):
    """Declare the base of curves over an abscissa of this mechanism that come from elsewhere."""

    abscissa: str
    given: str = ""
    start: str = ""
    lasts: str = ""
    gains: bool = False

    TAKES: ClassVar[dict[str, Kinds]] = {
        "given": CURVE_INPUT,
        "abscissa": AN_ABSCISSA,
        "start": NUMBER,
        "lasts": NUMBER,
    }

    def takes_over(self) -> set[str]:
        return {self.given}

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("curve", self.abscissa)}

    def runs_over(self, known: Mapping[str, str]) -> str:
        return self.abscissa

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        yield from ((self.given, of(self.given), of(self.id)),) if self.given else ()
        yield from ((self.lasts, of(self.lasts), of(self.abscissa)),) if self.lasts else ()
        yield from ((self.start, of(self.start), unit("1").kind),) if self.start else ()

    def run(self, calc: StepEngine) -> None:
        calc.curves[self.id] = self
        domain, curve = calc.domains[self.abscissa], calc.inputs[self.given or self.id]
        if self.lasts:
            require_length(calc, self, calc[self.lasts])
        domain.cut(self._laid_out(calc, curve.joints))
        domain.cut_finer(self._laid_out(calc, curve.breakpoints))

    def _laid_out(self, calc: StepEngine, shares: Array) -> Array:
        """Shares of a curve's period as places on the abscissa that it is laid over, NaN where they are not on it."""
        period = calc.domains[self.abscissa].period
        lasts = calc[self.lasts] if self.lasts else period
        if self.start or self.lasts:
            shares = np.concatenate([shares, np.zeros((len(shares), 1))], axis=1)  # where the curve begins anew
        shares = np.mod(shares - (calc[self.start] if self.start else 0), 1)
        turns = np.where(calc.possible[:, None], np.ceil(period / lasts), 1)
        places = [(shares + turn) * lasts for turn in range(int(turns.max()))]
        return np.concatenate([np.where(place < period, place, np.nan) for place in places], axis=1)

    def curve(self, sampler: Any) -> Array:
        owner = sampler.owner
        lasts = sampler[self.lasts] if self.lasts else owner.domains[sampler.axis].period_of(sampler.rows)
        start = sampler[self.start] if self.start else 0.0
        share, middle = start + sampler.x / lasts, start + sampler.mid / lasts
        passed = np.floor(middle)
        curve = owner.inputs[self.given or self.id]
        found: Array = curve.values(share - passed, middle - passed, sampler.rows)
        return found + passed * curve.gain(sampler.rows) if self.gains else found

    def is_same(self, pair: Any) -> bool:
        return pair.is_given(self.given or self.id) and all(map(pair.holds, filter(None, (self.start, self.lasts))))


@dataclass(frozen=True, eq=False)
class FromCurve(CurveOverAbscissa):
    """Declare a curve input taken over as a curve of this mechanism, over ``abscissa`` (of the same kind and any period).

    The one period of what is referred to is laid over one period here, or over ``lasts`` (an id) of the abscissa, so that
    the abscissa begins at the share ``start`` (an id) of it. ``gains`` says that the curve goes on where a period ends,
    as an angle does that grows from turn to turn.
    """

    given: str = field()
    abscissa: str
    start: str = field(default="", kw_only=True)
    lasts: str = field(default="", kw_only=True)
    gains: bool = field(default=False, kw_only=True)


@dataclass(frozen=True, eq=False)
class MadeCurve(CurveOverAbscissa):
    """Declare a curve that plain code makes for one machine: ``function`` gives a ``Curve`` over the period of ``abscissa``.

    It takes what ``Computed`` takes; ``method`` says in words how the curve is made.
    """

    function: Callable[..., Any]
    takes: tuple[str, ...]
    abscissa: str
    method: str

    TAKES: ClassVar[dict[str, Kinds]] = {"takes": PLAIN, "abscissa": AN_ABSCISSA}

    def run(self, calc: StepEngine) -> None:
        if calc.count > 1:
            raise TypeError(f"{self.id} is made for one machine, and was asked for {calc.count}")
        calc.inputs[self.id] = calc.call(self, plain_code.taken(calc, self.takes))
        super().run(calc)

    def items(self, page: StepPrinter) -> list[Item]:
        axis = page.calc.axis[self.id]
        found = {"type": "found", "relation": None, "method": self.method}
        result = page.result(self, page.value_at(self.id, axis))
        return [self.head() | found | {"result": result, "at": page.shown(axis)}]


@dataclass(frozen=True, eq=False)
class CurvePeriod(QuantityStep):
    """Declare the period of what the curve input ``given`` refers to, a quantity of this step's unit.

    Where the curve runs over another kind of quantity, ``otherwise`` says in words what to give.
    """

    given: str
    otherwise: str

    TAKES: ClassVar[dict[str, Kinds]] = {"given": CURVE_INPUT}

    def run(self, calc: StepEngine) -> None:
        curve = calc.inputs[self.given]
        if not hasattr(curve, "abscissa"):
            template = "is a list of values, which tells no period; {otherwise}"
            raise Impossible([(self.given, Phrase(template, otherwise=self.otherwise))])
        declared = curve.abscissa
        if unit(declared.unit).kind != unit(self.unit).kind:
            template = "runs over {id}, in {unit}; {otherwise}"
            named = {"id": declared.id, "unit": pretty(declared.unit), "otherwise": self.otherwise}
            raise Impossible([(self.given, Phrase(template, named))])
        calc.values[self.id] = np.broadcast_to(curve.domain.period, (calc.count, 1))

    def items(self, page: StepPrinter) -> list[Item]:
        method = Phrase("the period of {symbol}", symbol=page.calc.meta[self.given].symbol)
        result = page.result(self, page.value_at(self.id, None))
        return [self.head() | {"type": "found", "relation": None, "method": method, "result": result}]
