"""A self-test of the calculation: two ways to one quantity, which agree but for rounding."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import Expression
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.checks import ROUNDING, Check
from diecut_report.mechanism.names import Written, as_formula, formula_of
from diecut_report.mechanism.steps.protocols import CURVE, Kinds, Names, StepEngine, StepPrinter
from diecut_report.mechanism.steps.value import Value
from diecut_report.text.phrases import Phrase, phrase


@dataclass(frozen=True, eq=False)
class SelfTest(Value):
    """Declare that two formulas give the same but for rounding: numbers, each part of rows, or curves everywhere.

    The quantity is their difference relative to the greater of both, or to ``scale``: where both are small differences of great numbers,
    and of curves, which may pass zero, for instance to the greatest value of one. It is held against ``within`` by a check of the class
    "numerical" with the id and the description of the quantity, if ``check`` and ``title`` do not say others: ROUNDING for what is calculated
    by formulas, CURVE_ROUNDING for what is integrated or found on curves.
    """

    formula: Written = field(init=False)
    left: Written
    right: Written
    scale: Written | None = field(default=None, kw_only=True)
    within: float = field(default=ROUNDING, kw_only=True)
    check: str = field(default="", kw_only=True)
    title: str = field(default="", kw_only=True)
    consequence: str = field(default=phrase("the calculation contradicts itself; do not use it."), kw_only=True)
    output: bool = field(default=False, kw_only=True)

    FORMULAS: ClassVar[dict[str, Kinds]] = {"left": CURVE, "right": CURVE, "scale": CURVE}
    MAY_LACK: ClassVar[tuple[str, ...]] = ("exists", "scale")

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "formula", self._named(_written(self._apart) / _written(self._scale)))

    @property
    def is_of_nothing(self) -> bool:
        """Return whether it is a number that is to be zero."""
        tree = formula_of(self.right).tree
        return tree.op == "num" and not float(tree.args[0])

    def _named(self, expression: Any) -> Formula:
        return formula_of(as_formula(expression, self.id))

    @cached_property
    def _apart(self) -> Formula:
        left, right = map(_written, (self.left, self.right))
        return self._named(abs(left) if self.is_of_nothing else abs(left - right))

    @cached_property
    def _scale(self) -> Formula:
        left, right = map(_written, (self.left, self.right))
        return self._named(np.maximum(abs(left), abs(right)) if self.scale is None else _written(self.scale))

    @property
    def as_check(self) -> Check:
        """Return the check that the difference is no more than rounding."""
        return Check(self.check or self.id, "numerical", self.title or self.description, self.id, self.within, source=self.source,
                     demand_label=phrase("relative difference"), consequence=self.consequence, at=self.at)  # fmt: skip

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        yield from super().faults(names, when)
        if self.scale is None and any(each.step is self and each.kind == "curve" for each in names.givers(self.id)):
            yield phrase(
                "compares curves, which may pass zero; give scale=, a number that tells how great they are, as the abs_max of one"
            )
        elif self.scale is None and self.is_of_nothing:
            yield phrase(
                "compares with 0, to which no difference is relative; give scale=, a number that tells what is small"
            )
        if self.unit != "1":
            yield Phrase('gives a relative difference, but is in {unit}; write "1"', unit=self.unit)

    def numbers(self, calc: StepEngine) -> Array:
        found = np.where(calc.apply(self._apart) == 0, 0.0, super().numbers(calc))  # though it be nothing by nothing
        return np.nan_to_num(found, nan=np.inf, posinf=np.inf)  # what is not known is apart

    def shown_formula(self, page: StepPrinter, elsewhere: bool) -> Written:
        axis, part = page.calc.axis.get(self.id), page.shown_part(self.id)
        scale = self._scale(*(page.value_at(name, axis, part=part) for name in self._scale.parameters))
        return self.formula if scale else self._apart


def _written(part: Written) -> Expression:
    """A formula as an expression, of which others can be made."""
    return Expression(formula_of(part).spoken)
