"""What other steps stand on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from diecut_report.formulas import Array
from diecut_report.mechanism.names import Written
from diecut_report.mechanism.steps.base import SilentStep
from diecut_report.mechanism.steps.protocols import ROW, Kinds, StepEngine


@dataclass(frozen=True, eq=False)
class Fact(SilentStep):
    """Declare what other steps stand on: they name its id among their ``needs``, as they do with an input.

    Where the condition does not hold for a machine, they are left out for it, and what refers to them is not calculated;
    ``words`` say why. A check that stands on it is then not checked for want of the first key of ``lacks``, with which the fact is not asked.
    """

    condition: Written
    words: str

    is_taken: ClassVar[bool] = True
    FORMULAS: ClassVar[dict[str, Kinds]] = {"condition": ROW}

    def run(self, calc: StepEngine) -> None:
        """Mark which variants do not meet it; where none does, the steps that need it take no part.

        Where some do, the numbers of the others mean nothing: these variants are to be calculated by themselves.
        """
        missed: Array = calc.apply(self.condition)[:, 0] == 0
        if missed.any():
            calc.withheld[self.id] = missed
            if missed[calc.possible].all():
                calc.withdraw(self.id)
