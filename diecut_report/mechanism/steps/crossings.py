"""The places where a curve changes its sign."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from diecut_report.mechanism.steps.base import Over, QuantityStep, ResultName
from diecut_report.mechanism.steps.protocols import A_CURVE, Item, Kinds, Names, StepEngine, StepPrinter
from diecut_report.mechanism.steps.result_names import count_name, result_names
from diecut_report.text.phrases import Phrase, phrase


@dataclass(frozen=True, eq=False)
class Crossings(QuantityStep):
    """Declare all places where the curve ``of`` changes its sign, between the breakpoints known so far and at them.

    Their number differs from machine to machine; as outputs they are ``ID_count``, ``ID_1``, ``ID_2`` …
    """

    of: str

    TAKES: ClassVar[dict[str, Kinds]] = {"of": A_CURVE}
    is_counted: ClassVar[bool] = True

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
