"""What must hold for a machine to be possible, and facts that other steps stand on."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.tree import Node
from diecut_report.mechanism.checks import AdviceWay
from diecut_report.mechanism.names import Written, formula_of
from diecut_report.mechanism.steps import plain_code
from diecut_report.mechanism.steps.base import SilentStep
from diecut_report.mechanism.steps.protocols import CURVE, ROW, Kinds, Names, StepEngine
from diecut_report.mechanism.steps.value import mixed_axes
from diecut_report.quantities.formatting import told
from diecut_report.text.phrases import Phrase, phrase

ORDERED = ("<", "<=", ">", ">=")


class Obstacle(SilentStep):
    """Declare the base of steps that say in words why a machine cannot be, and which key to change."""

    key: str
    message: str

    def report(self, calc: StepEngine, variant: int, places: Mapping[str, int], at: str = "") -> None:
        """Mark a variant with the message and, of a curve, the place; what follows from impossible numbers says nothing more."""
        if variant not in calc.flaws or calc.count == 1:
            words = "" if calc.is_partial else calc.filled(self.message, variant, places)
            words = Phrase("{message} (at {place})", message=words, place=at) if words and at else words
            calc.refuse(variant, calc.filled(self.key, variant, places), words)


@dataclass(frozen=True, eq=False)
class Require(Obstacle):
    """Declare what must hold for the machine to be possible: where it does not, the message (``{id}`` prints a quantity) and its key.

    A condition on rows must hold for each part; message and key may name the first part that fails: ``{part}`` counted
    from 1, ``{next}`` the one after it in the loop, ``{index}`` counted from 0 as in the file. One on curves, comparisons joined by ``&``, must
    hold everywhere; the message is told with the place where it fails most. ``advise`` names the inputs of which
    values are found with which the machine is possible, as that of a check does.
    """

    condition: Written
    key: str
    message: str
    advise: tuple[AdviceWay, ...] = ()

    FORMULAS: ClassVar[dict[str, Kinds]] = {"condition": CURVE}
    message_places = ("part", "next", "index")

    @property
    def comparisons(self) -> list[tuple[str, Node, Node]]:
        """Return what is compared; nothing of a condition that is more than comparisons joined by ``&``."""
        return _comparisons(formula_of(self.condition).spoken)

    def faults(self, names: Names, when: object) -> Iterator[str]:
        taken = formula_of(self.condition).parameters
        yield from mixed_axes(taken, names)
        if not self.comparisons and any({"curve", "abscissa"} & {g.kind for g in names.givers(name)} for name in taken):
            yield phrase("takes a curve; of curves only comparisons are required, (a < b) & (b < c)")

    def can_be_judged(self, known: Collection[str]) -> bool:
        return all(name in known for name in formula_of(self.condition).parameters)

    def run(self, calc: StepEngine) -> None:
        over = {calc.axis.get(name, name) for name in formula_of(self.condition).parameters} & calc.domains.keys()
        if over:
            self._run_over(over.pop(), calc)
            return
        held = calc.apply(self.condition).astype(bool)
        for variant in np.flatnonzero(~held.all(axis=1)):
            part, count = int(np.argmin(held[variant])), held.shape[1]
            self.report(calc, int(variant), {"part": part + 1, "next": (part + 1) % count + 1, "index": part})

    def _run_over(self, axis: str, calc: StepEngine) -> None:
        abscissa = calc.steps[axis]
        for variant, place in calc.fails(self, axis).items():
            at = f"{abscissa.symbol} = {told(place, abscissa.unit)}" if np.isfinite(place) else ""
            self.report(calc, variant, {}, at)


def _comparisons(node: Node) -> list[tuple[str, Node, Node]]:
    if node.op == "and":
        parts = list(map(_comparisons, node.args))
        return [each for part in parts for each in part] if all(parts) else []
    return [node.args] if node.op == "cmp" and node.args[0] in ORDERED else []


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
