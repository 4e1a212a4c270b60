"""The root of an equation."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from diecut_report.formulas.tree import Node
from diecut_report.mechanism.names import Written, formula_of
from diecut_report.mechanism.steps.base import QuantityStep
from diecut_report.mechanism.steps.protocols import ANY, NUMBER, Item, Kinds, Names, StepEngine, StepPrinter
from diecut_report.quantities.formatting import told
from diecut_report.text.phrases import Phrase, phrase

METHOD = "bracketed root search, verified by the relation shown, which is independent of the search"

LOST = phrase(
    "{where}: the equation does not change its sign between low = {low} and high = {high}; let the bracket hold the root, or require "
    "what it needs to exist"
)
POLE = phrase(
    "{where}: the equation has a pole between low = {low} and high = {high}, where it changes its sign without a root; let the bracket "
    "leave the pole out"
)
EMPTY = phrase(
    "{where}: left and right are equal everywhere between low = {low} and high = {high}, not at the root alone, so that they prove "
    "nothing; write as left and right another form of the equation"
)


@dataclass(frozen=True, eq=False)
class Root(QuantityStep):
    """Declare a root found in [low, high] of ``equation``, a formula of the unknown that is zero there.

    The equation names the unknown by this step's id, or by ``unknown``. ``left`` = ``right`` is the relation that is printed and proves the
    root: another form than the one solved.
    """

    equation: Written
    low: Written = field(kw_only=True)
    high: Written = field(kw_only=True)
    left: Written = field(kw_only=True)
    right: Written = field(kw_only=True)
    unknown: str = field(default="", kw_only=True)
    tolerance: float = field(default=1e-9, kw_only=True)

    FORMULAS: ClassVar[dict[str, Kinds]] = {"equation": ANY, "low": NUMBER, "high": NUMBER, "left": ANY, "right": ANY}

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "unknown", self.unknown or self.id)

    @property
    def own_names(self) -> frozenset[str]:
        return frozenset((self.unknown, self.id))

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        takes = formula_of(self.equation).parameters
        if self.unknown not in takes:
            template = "the unknown {unknown} is nothing that the equation takes; it takes {asked}"
            yield Phrase(template, unknown=self.unknown, asked=", ".join(map(str, takes)))

    def run(self, calc: StepEngine) -> None:
        found, residual = calc.root(self)
        lost = np.isnan(found)[:, 0] & calc.possible
        pole = np.isinf(residual)[:, 0] & calc.possible
        for bad, template in ((lost, LOST), (pole, POLE), (calc.proves_nothing(self) & calc.possible, EMPTY)):
            if bad.any():
                calc.mark(self, bad, self._words(calc, template, int(np.flatnonzero(bad)[0])))
                residual = np.where(bad[:, None], 0.0, residual)
        calc.prove(self, residual, self.tolerance)

    def _words(self, calc: StepEngine, template: str, variant: int) -> str:
        low, high = (told(float(calc.apply(end)[variant, 0]), self.unit) for end in (self.low, self.high))
        where = f"{self.description} ({self.id}, {Path(self.at).name})"
        return Phrase(template, where=where, low=low, high=high)

    def items(self, page: StepPrinter) -> list[Item]:
        sides = (page.symbolic(formula_of(side)) for side in (self.left, self.right))
        found = {"type": "found", "relation": Node("cmp", ("==", *sides)).to_json(), "method": METHOD}
        result = page.result(self, page.value_at(self.id, None))
        return [self.head() | found | {"result": result, "residual": page.residual(self)}]
