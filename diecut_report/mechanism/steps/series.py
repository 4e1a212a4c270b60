"""The running integral of a curve, and its derivative."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from diecut_report.formulas import Array
from diecut_report.mechanism.steps.base import Over, QuantityStep
from diecut_report.mechanism.steps.protocols import A_CURVE, Item, Kinds, StepEngine, StepPrinter
from diecut_report.quantities.units import Kind, times
from diecut_report.text.phrases import Phrase


@dataclass(frozen=True, eq=False)
class SeriesStep(QuantityStep):
    """Declare the base of curves that are found as series of another one, piece by piece."""

    of: str

    TAKES: ClassVar[dict[str, Kinds]] = {"of": A_CURVE}
    is_shown_at_place = True
    OPERATION: ClassVar[str]
    METHOD: ClassVar[str]

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return over(self.of) or {("curve", "")}

    def runs_over(self, known: Mapping[str, str]) -> str:
        return known[self.of]

    @property
    def asked_curve(self) -> str:
        return self.of

    def curve(self, sampler: Any) -> Array:
        found: Array = sampler.owner.series[self.id].values(sampler.x, sampler.mid, sampler.rows)
        return found

    def is_same(self, pair: Any) -> bool:
        return bool(pair.same_series(self.id))

    def items(self, page: StepPrinter) -> list[Item]:
        axis = page.calc.axis[self.id]
        item = self.head() | {
            "type": "reduction",
            "operation": self.OPERATION,
            "of": page.calc.step_or_input(self.of).symbol,
        }
        item |= {"result": page.result(self, page.value_at(self.id, axis)), "at": page.shown(axis)}
        return [item | {"method": self.METHOD, "residual": page.residual(self)}]


@dataclass(frozen=True, eq=False)
class Accumulated(SeriesStep):
    """Declare a curve: the running integral of the curve ``of`` over its abscissa, from the abscissa's start."""

    OPERATION = "accumulated"
    METHOD = "Chebyshev series between the breakpoints, integrated; its final value is compared with Gauss–Legendre quadrature"

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        yield Phrase("the integral of {curve}", curve=self.of), times(of(self.of), of(axis(self.of))), of(self.id)

    def run(self, calc: StepEngine) -> None:
        calc.prove(self, calc.accumulate(self))


@dataclass(frozen=True, eq=False)
class Derivative(SeriesStep):
    """Declare a curve: the derivative of the curve ``of`` by its abscissa, within the smooth pieces."""

    OPERATION = "derivative"
    METHOD = "Chebyshev series between the breakpoints, differentiated; the series is compared with the curve at other points"

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        yield Phrase("the derivative of {curve}", curve=self.of), times(of(self.of), of(axis(self.of)), -1), of(self.id)

    def run(self, calc: StepEngine) -> None:
        calc.prove(self, calc.differentiate(self))
