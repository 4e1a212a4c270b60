"""Curves that plain code gives for all variants, from a prepared object."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, ClassVar

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.steps.base import Over, QuantityStep, SilentStep
from diecut_report.mechanism.steps.protocols import AN_ABSCISSA, PREPARED, Called, Item, Kinds, StepEngine, StepPrinter
from diecut_report.mechanism.steps.result_names import part_result
from diecut_report.text.phrases import Phrase, phrase

FROM_OBJECT: dict[str, Kinds] = {"abscissa": AN_ABSCISSA, "of": PREPARED}


@dataclass(frozen=True, eq=False)
class ComputedCurve(QuantityStep):
    """Declare a curve over ``abscissa`` that plain code gives for all variants, from the prepared object ``of``.

    ``function`` takes it, the places x of shape (rows, points), the middles of their smooth pieces (of any shape that broadcasts to
    that) and the variants ``rows`` (None: all, or the only one); it gives values of the shape of x. ``joints`` gives from the object
    the places where the curve jumps or has a corner, of shape (variants, places), NaN where there is none. With ``named_by`` there is a
    curve for each named part: ``function`` takes the part's index before all else.
    """

    function: Callable[..., Array]
    of: str
    abscissa: str
    method: str
    joints: Callable[[Any], Array] | None = field(default=None, kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = FROM_OBJECT

    @property
    def called(self) -> Called:
        first = phrase("the part's index, ") if self.named_by else ""
        template = "it is called with {first}the object, x, the middles of the pieces and the rows"
        return Called(4 + bool(self.named_by), Phrase(template, first=first))

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("curve", self.abscissa)}

    def runs_over(self, known: Mapping[str, str]) -> str:
        return self.abscissa

    def run(self, calc: StepEngine) -> None:
        calc.add_curves(self._of_parts(calc), self.abscissa)
        if self.joints is not None:
            places = self.joints(calc.inputs[self.of])
            calc.domains[self.abscissa].cut(np.broadcast_to(places, (calc.count, places.shape[1])))

    def _of_parts(self, calc: StepEngine) -> dict[str, ComputedCurve]:
        """The curve of each named part by its id; the step itself where it is of no parts."""
        names = calc.names_of_parts(self)
        if names is None:
            return {self.id: self}
        made = (
            replace(self, id=part_result(name, self), named_by="", function=partial(self.function, index),
                    description=Phrase("{quantity}: {part}", quantity=phrase(self.description), part=name))
            for index, name in enumerate(names)
        )  # fmt: skip
        return {each.id: each for each in made}

    def curve(self, sampler: Any) -> Array:
        return self.function(sampler.owner.inputs[self.of], sampler.x, sampler.mid, sampler.rows)

    def items(self, page: StepPrinter) -> list[Item]:
        at = page.shown(self.abscissa)
        if self.named_by:
            return [page.table_of_curves(self, at)]
        result = page.result(self, page.value_at(self.id, self.abscissa))
        return [self.head() | {"type": "found", "relation": None, "method": self.method, "result": result, "at": at}]


@dataclass(frozen=True, eq=False)
class PartCurves(SilentStep):
    """Declare curves over ``abscissa`` of named parts, from the prepared object ``of``: ``ID_1``, ``ID_2`` … in the results.

    ``names`` gives from it the names of the parts, one for each curve; ``function`` takes it, the part's number (from 0), and
    then what that of ``ComputedCurve`` takes. Each is told by the description and the part's name.
    """

    symbol: str = field()
    unit: str = field()
    description: str = field()
    names: Callable[[Any], Sequence[str]]
    function: Callable[..., Array]
    of: str
    abscissa: str
    method: str
    joints: Callable[[Any], Array] | None = field(default=None, kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = FROM_OBJECT
    is_taken = True

    @property
    def called(self) -> Called:
        return Called(
            5, phrase("it is called with the object, the part's number, x, the middles of the pieces and the rows")
        )

    def _curves(self, of: Any) -> Iterator[ComputedCurve]:
        """The curve of each part."""
        between = "," if "_" in self.symbol else "_"
        for index, name in enumerate(self.names(of)):
            yield ComputedCurve(
                f"{self.id}_{index + 1}", f"{self.symbol}{between}{index + 1}", self.unit,
                Phrase("{title}: {name}", title=phrase(self.description), name=name),
                lambda of, *places, index=index: self.function(of, index, *places), self.of, self.abscissa, self.method,
                source=self.source, at=self.at,
            )  # fmt: skip

    def run(self, calc: StepEngine) -> None:
        made = {each.id: each for each in self._curves(calc.inputs[self.of])}
        calc.add_curves(made, self.abscissa)
        if self.joints is not None and made:
            calc.domains[self.abscissa].cut(self.joints(calc.inputs[self.of]))
