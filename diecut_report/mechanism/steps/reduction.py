"""What is found on a curve: one number of it, an extreme, a mean, an integral; and the places where it changes its sign."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from diecut_report.mechanism.steps.base import Over, QuantityStep, ResultName
from diecut_report.mechanism.steps.protocols import A_CURVE, Item, Kinds, Names, StepEngine, StepPrinter
from diecut_report.mechanism.steps.result_names import count_name, place_name, result_names
from diecut_report.quantities.formatting import is_nothing
from diecut_report.quantities.units import Kind, times
from diecut_report.text.phrases import Phrase, phrase

Operation = Literal["max", "min", "abs_max", "range", "mean", "rms", "integral"]
SIGNS = {"max": (1.0,), "min": (-1.0,), "abs_max": (1.0, -1.0), "range": (1.0, -1.0)}
SEARCHED = "bounded search on the curve within each smooth piece, one-sided limits at the breakpoints included"
INTEGRATED = "Gauss–Legendre quadrature between the breakpoints, repeated at twice the order"


@dataclass(frozen=True, eq=False)
class Reduction(QuantityStep):
    """Declare one number of the curve ``of`` over its abscissa; extremes also give their place, the quantity ``ID_at``."""

    operation: Operation
    of: str

    TAKES: ClassVar[dict[str, Kinds]] = {"of": A_CURVE}

    @property
    def is_extreme(self) -> bool:
        """Return whether it has a place."""
        return self.operation in ("max", "min", "abs_max")

    def beside(self) -> Iterator[ResultName]:
        if self.is_extreme:
            yield ResultName(place_name(self.id), self.id, "place")

    @property
    def asked_curve(self) -> str:
        return self.of

    @property
    def signs(self) -> tuple[float, ...]:
        return SIGNS.get(self.operation, ())

    def same_units(self, units: Callable[[str], set[str]], names: Names) -> Iterator[tuple[str, set[str]]]:
        if self.operation != "integral":
            yield self.of, units(self.of)

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        if self.operation == "integral":
            yield Phrase("the integral of {curve}", curve=self.of), times(of(self.of), of(axis(self.of))), of(self.id)
        else:
            yield self.of, of(self.of), of(self.id)

    def run(self, calc: StepEngine) -> None:
        if not self.signs:
            self._integrate(calc)
            return
        ends = [calc.extreme(self.of, sign) for sign in self.signs]
        calc.prove(
            self,
            np.maximum.reduce([calc.beyond(self.of, end[0], sign) for end, sign in zip(ends, self.signs, strict=True)]),
        )
        if self.operation == "range":
            calc.values[self.id] = ends[0][0] - ends[1][0]
            return
        upper = np.abs(ends[0][0]) >= np.abs(ends[-1][0]) * (1 - calc.SAME_HEIGHT)  # of two alike the upper one
        value, place, middle = (np.where(upper, top, bottom) for top, bottom in zip(ends[0], ends[-1], strict=True))
        calc.values[self.id] = np.maximum(*(np.abs(end[0]) for end in ends)) if self.operation == "abs_max" else value
        calc.values[place_name(self.id)], calc.middle[place_name(self.id)] = place, middle

    def _integrate(self, calc: StepEngine) -> None:
        whole, residual = calc.integral(self.of, 2 if self.operation == "rms" else 1)
        calc.prove(self, residual)
        mean = whole / calc.domains[calc.axis[self.of]].period
        calc.values[self.id] = {"integral": whole, "mean": mean, "rms": np.sqrt(np.abs(mean))}[self.operation]

    def items(self, page: StepPrinter) -> list[Item]:
        calc, axis, value = page.calc, page.calc.axis[self.of], page.value_at(self.id, None)
        item = self.head() | {
            "type": "reduction",
            "of": calc.step_or_input(self.of).symbol,
            "result": page.result(self, value),
        }
        item |= {
            "operation": self.operation,
            "method": SEARCHED if self.signs else INTEGRATED,
            "residual": page.residual(self),
        }
        if self.operation == "integral":
            item["over"] = page.place(axis, float(calc.domains[axis].period[0, 0]))
        place = place_name(self.id)
        if place in calc.values and (value == 0 or not is_nothing(value, self.unit)):  # that of rounding says nothing
            item["at"] = page.place(axis, float(calc[place][0, 0]))
        return [item]


@dataclass(frozen=True, eq=False)
class Crossings(QuantityStep):
    """Declare all places where the curve ``of`` changes its sign, between the breakpoints known so far and at them.

    Their number differs from machine to machine; as outputs they are ``ID_count``, ``ID_1``, ``ID_2`` …
    """

    of: str

    TAKES: ClassVar[dict[str, Kinds]] = {"of": A_CURVE}
    is_counted = True

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("crossings", "")}

    def beside(self) -> Iterator[ResultName]:
        yield ResultName(count_name(self.id), self.id, "count")

    @property
    def asked_curve(self) -> str:
        return self.of

    def same_units(self, units: Callable[[str], set[str]], names: Names) -> Iterator[tuple[str, set[str]]]:
        yield from ((axis, units(axis)) for axis in sorted(names.axes(self.of)))

    def run(self, calc: StepEngine) -> None:
        places, residual = calc.crossings(self.of)
        calc.values[self.id] = places
        calc.values[count_name(self.id)] = np.isfinite(places).sum(axis=1, keepdims=True)
        names = [each for each in result_names(self, places.shape[1]) if each.role == "crossing"]
        calc.values |= {each.name: places[:, [each.index]] for each in names}
        calc.prove(self, residual)

    def items(self, page: StepPrinter) -> list[Item]:
        places = [float(x) for x in page.calc[self.id][0] if x == x]
        if places:
            return [page.table_of_places(self, places)]
        return [
            self.head() | {"type": "note", "text": Phrase("{title}: there is none.", title=phrase(self.description))}
        ]
