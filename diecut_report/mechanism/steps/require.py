"""What must hold for a machine to be possible, and facts that other steps stand on."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.checks import AdviceWay
from diecut_report.mechanism.names import Written, formula_of
from diecut_report.mechanism.steps import plain_code
from diecut_report.mechanism.steps.base import SilentStep
from diecut_report.mechanism.steps.protocols import ROW, Kinds, StepEngine


class Obstacle(SilentStep):
    """Declare the base of steps that say in words why a machine cannot be, and which key to change."""

    key: str
    message: str

    def report(self, calc: StepEngine, variant: int, places: Mapping[str, int]) -> None:
        """Mark a variant with the message; what follows from impossible numbers says nothing more."""
        if variant not in calc.flaws or calc.count == 1:
            words = "" if calc.is_partial else calc.filled(self.message, variant, places)
            calc.refuse(variant, calc.filled(self.key, variant, places), words)


@dataclass(frozen=True, eq=False)
class Require(Obstacle):
    """Declare what must hold for the machine to be possible: where it does not, the message (``{id}`` prints a quantity) and its key.

    A condition on rows must hold for each part; message and key may name the first part that fails: ``{part}`` counted
    from 1, ``{next}`` the one after it in the loop, ``{index}`` counted from 0 as in the file. ``advise`` names the inputs of which
    values are found with which the machine is possible, as that of a check does.
    """

    condition: Written
    key: str
    message: str
    advise: tuple[AdviceWay, ...] = ()

    FORMULAS: ClassVar[dict[str, Kinds]] = {"condition": ROW}
    message_places = ("part", "next", "index")

    def can_be_judged(self, known: Collection[str]) -> bool:
        return all(name in known for name in formula_of(self.condition).parameters)

    def run(self, calc: StepEngine) -> None:
        held = calc.apply(self.condition).astype(bool)
        for variant in np.flatnonzero(~held.all(axis=1)):
            part, count = int(np.argmin(held[variant])), held.shape[1]
            self.report(calc, int(variant), {"part": part + 1, "next": (part + 1) % count + 1, "index": part})


@dataclass(frozen=True, eq=False)
class Clash(Obstacle):
    """Declare geometry that no printed formula tells: which of repeated parts stand in each other's way.

    ``function`` takes the rows ``takes``, each of shape (variants, parts), and gives for each part the index of the one that
    it clashes with, -1 for none, of the same shape. The message may name ``{part}`` and ``{other}``, counted from 1.
    """

    function: Callable[..., Array]
    takes: tuple[str, ...]
    key: str
    message: str

    TAKES: ClassVar[dict[str, Kinds]] = {"takes": ROW}
    message_places = ("part", "other", "index")

    def run(self, calc: StepEngine) -> None:
        rows = plain_code.taken(calc, self.takes)
        others = plain_code.partners(self, self.function(*rows), np.broadcast_shapes(*(np.shape(row) for row in rows)))
        for variant in np.flatnonzero((others >= 0).any(axis=1)):
            part = int(np.argmax(others[variant] >= 0))
            self.report(calc, int(variant), {"part": part + 1, "other": int(others[variant, part]) + 1, "index": part})


@dataclass(frozen=True, eq=False)
class Fact(SilentStep):
    """Declare what other steps stand on: they name its id among their ``needs``, as they do with an input.

    Where the condition does not hold for a machine, they are left out for it, and what refers to them is not calculated;
    ``words`` say why. A check that stands on it is then not checked for want of the first key of ``lacks``, with which the fact is not asked.
    """

    condition: Written
    words: str

    is_taken = True
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
