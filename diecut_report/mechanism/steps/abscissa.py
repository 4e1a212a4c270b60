"""What curves run over, and where they jump."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Unpack

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.steps.base import Over, QuantityStep, SilentStep, Step, StepCondition
from diecut_report.mechanism.steps.protocols import (
    A_PLACE,
    AN_ABSCISSA,
    ANY,
    NUMBER,
    Item,
    Kinds,
    StepEngine,
    StepPrinter,
)
from diecut_report.quantities.units import Kind
from diecut_report.text.phrases import Phrase, phrase


def require_length(calc: StepEngine, step: Step, length: Array) -> None:
    """Mark the variants in which what curves are laid over has no length."""
    empty = ~(length > 0)[:, 0] & calc.possible
    if empty.any():
        template = "{description} ({id}) has no length to run over with these inputs"
        calc.mark(step, empty, Phrase(template, description=step.description, id=step.id))


@dataclass(frozen=True, eq=False)
class Abscissa(QuantityStep):
    """Declare what curves run over, [0, period): sampled at ``points`` (an input's id); shown in print at the place ``shown_at`` (an id).

    ``period`` is a part of a turn in rad, a ``Constant``, or an id. ``intervals`` are those of the search grid in each smooth piece: fewer are enough
    where breakpoints leave the pieces short. ``speed`` is the id of how fast it is run through, from which phases have
    their times; an abscissa of time needs none.
    """

    period: float | str
    points: str = field(default="n_points", kw_only=True)
    shown_at: str = field(default="", kw_only=True)
    intervals: int = field(default=64, kw_only=True)
    speed: str = field(default="", kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"points": NUMBER, "period": NUMBER, "speed": NUMBER, "shown_at": ANY}
    NUMBERS = ("period",)

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        return {("abscissa", self.id)}

    def runs_over(self, known: Mapping[str, str]) -> str:
        return self.id

    def shape_faults(self) -> Iterator[str]:
        yield from super().shape_faults()
        if self.intervals < 2:
            template = "has intervals={intervals}; the search for extremes needs at least 2, usually 32 or 64"
            yield Phrase(template, intervals=repr(self.intervals))

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        if isinstance(self.period, str):
            yield self.period, of(self.period), of(self.id)

    def run(self, calc: StepEngine) -> None:
        whole = calc[self.period] if isinstance(self.period, str) else np.full((calc.count, 1), self.period)
        require_length(calc, self, whole)
        calc.open_abscissa(self, whole, int(calc[self.points][0, 0]), self.intervals)

    def items(self, page: StepPrinter) -> list[Item]:
        told = {"title": phrase(self.description), "count": page.printed(self.points)}
        text = Phrase("{title}; curves are sampled at {count} places of it.", told)
        return [self.head() | {"type": "note", "text": text}]


@dataclass(frozen=True, eq=False)
class Breakpoints(SilentStep):
    """Declare places on an abscissa where a curve that follows jumps or has a corner: ids of numbers, or of found crossings.

    ``every`` is the id of a length within which curves turn back at most a few times: extremes and integrals are searched in
    pieces no longer than that. These are not breakpoints of the results.
    """

    abscissa: str
    places: tuple[str, ...] = ()
    every: str = field(default="", kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"abscissa": AN_ABSCISSA, "places": A_PLACE, "every": NUMBER}

    @classmethod
    def of(cls, id: str, abscissa: str, *places: str, every: str = "", **when: Unpack[StepCondition]) -> Breakpoints:
        """Declare places of an abscissa where a curve jumps or has a corner: see ``Breakpoints``."""
        return cls(id, abscissa, places, every=every, **when)

    def shape_faults(self) -> Iterator[str]:
        yield from super().shape_faults()
        if not all(isinstance(each, str) for each in self.places):
            template = 'has places={places}; name them one after another, each an id: "first", "second"'
            yield Phrase(template, places=repr(self.places))

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        yield from ((name, of(name), of(self.abscissa)) for name in (*self.places, self.every) if name)

    def run(self, calc: StepEngine) -> None:
        domain = calc.domains[self.abscissa]
        for place in self.places:
            domain.cut(calc[place])
        if self.every:
            domain.cut_every(np.where(calc.possible[:, None], calc[self.every], np.nan))
