"""One input solved for what is asked of a machine: all its values in a range, the one nearest to today's first, each proved."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from diecut_report.config.discovery import Discovery
from diecut_report.config.loader import Config
from diecut_report.design.answers import Answer, FoundValue, Range, Role
from diecut_report.design.changeable import is_stepped
from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.line_search import Function, crossings, greatest, looked_closer, without_gaps
from diecut_report.design.proved_machine import proved
from diecut_report.design.questions import DesignQuestion, needed
from diecut_report.design.root_search import roots
from diecut_report.design.searched_range import searched_places, searched_range
from diecut_report.design.typed_answers import REACHED, typed_answers
from diecut_report.design.varied_machines import VariedMachines, varied
from diecut_report.errors import Problem, UserError
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase

PASSING_CLOSE = 1e-6  # relative width at which the limit of what passes is known: more is not typed
NEAR = 60  # machines about the best one, as far as its neighbours
SAME = 1e-12  # relative: what differs by less does not vary


def solved(
    config: Config, discovery: Discovery, question: DesignQuestion, design: DesignInput, *, passing: bool = False,
    low: float | None = None, high: float | None = None,
) -> Answer:  # fmt: skip
    """Return the values of an input with which a question is answered; with ``passing`` only those with which no check fails.

    UserError in words where there is no range to search, or what is asked does not vary with the input.
    """
    ends = searched_range(design, low, high)
    search = _RangeSearch(config, question, design, passing)
    answer = search.answer(*ends)
    if not answer.found:
        return answer
    return _proved(answer, config, discovery)


def _proved(answer: Answer, config: Config, discovery: Discovery) -> Answer:
    """The answer with the first value that a machine can have, calculated alone; UserError where there is none such."""
    faults: list[UserError] = []
    for index, first in enumerate(answer.found):
        try:
            machine = proved(config.tree, {answer.design.stands: first.typed}, discovery)
        except UserError as fault:
            faults.append(fault)
            continue
        reached = machine.outputs.get(answer.question.quantity.column, first.reached)
        failing = tuple(name for name, _ in machine.checks("fail"))
        return replace(
            answer,
            found=(replace(first, reached=reached, failing=failing), *answer.found[index + 1 :]),
            machine=machine,
        )
    words = "{input} = {typed} answers, but the rest of the machine cannot be as it is then: {reason}"
    what = {"input": answer.design.name, "typed": answer.found[0].typed, "reason": faults[0].problems[0].message}
    raise UserError(Problem(Phrase(words, what), config.tree.file))


@dataclass
class _RangeSearch:
    """Looks along the range of an input; ``at`` calculates many machines of it at once."""

    config: Config
    question: DesignQuestion
    design: DesignInput
    passing: bool

    def __post_init__(self) -> None:
        self.part = self.config if self.passing else needed(self.config, self.question.quantity, self.design.asked)
        asked = self.question.quantity.asked
        self.inputs = [asked] if asked is not None else []
        self.known: dict[float, tuple[float, float]] = {}
        self.is_stepped = is_stepped(self.design)

    def machines(self, x: Array) -> VariedMachines:
        return varied(self.part, {self.design.asked: x}, len(x), self.inputs)

    def answer(self, low: float, high: float) -> Answer:
        """Return what is found in the range; nothing of it is proved yet."""
        x = searched_places(self.design, low, high)
        made = self.machines(x)
        y = made.values(self.question.quantity.column)
        self._refuse_constant(made, y)
        self._keep(x, made)
        answer = Answer(self.question, self.design, float(x[0]), float(x[-1]), self._today(x, y), passing=self.passing)
        if self.question.kind == "=":
            roots, jumps = self._roots(x, y)
            answer = replace(answer, found=tuple(self._nearest_first(roots)), jumps=tuple(jumps))
        elif self.question.kind in ("max", "min"):
            answer = replace(answer, found=tuple(self._extreme(x, made, y)))
        else:
            ranges = self._ranges(x, self.holds(made, y))
            answer = replace(answer, found=tuple(self._of_ranges(ranges)), ranges=tuple(ranges))
        if answer.found:
            return answer
        always = _always_failing(made) if self.passing else ()
        return replace(answer, nearest=self._nearest(x, made, y), always=always)

    def _refuse_constant(self, made: VariedMachines, y: Array) -> None:
        known = y[np.isfinite(y)]
        name, asked = self.design.name, self.question.quantity.name
        if not made.exists.any():
            words = "no machine of the range of {input} can be calculated: {reason}"
            reason = next(filter(None, made.reasons))
            raise UserError(Problem(Phrase(words, input=name, reason=reason), self.config.tree.file))
        if not len(known):
            words = "{asked} has no value in the whole range of {input}."
            raise UserError(Problem(Phrase(words, asked=asked, input=name), self.config.tree.file))
        if np.ptp(known) <= SAME * np.abs(known).max() and len(y) > 1:
            words = "{asked} does not vary with {input}: it is {value} in the whole range."
            value = self.question.quantity.told(float(known[0]))
            raise UserError(Problem(Phrase(words, asked=asked, input=name, value=value), self.config.tree.file))

    def _today(self, x: Array, y: Array) -> float:
        index = np.flatnonzero(x == (np.nan if self.design.today is None else self.design.today))
        return float(y[index[0]]) if len(index) else math.nan

    # --- what is looked for ------------------------------------------------------------------------------------------

    def _roots(self, x: Array, y: Array) -> tuple[list[FoundValue], list[float]]:
        value = self.question.value
        off = y - value
        if self.is_stepped:
            exact = np.abs(off) <= SAME * max(abs(value), 1e-300)
            return self._judged([(float(each), "root") for each in x[exact]]), []
        places, jumps = roots(self._off, x, off, self.design.today, self.design.allows)
        judged = self._judged([(each, "today" if each == self.design.today else "root") for each in places])
        true = [
            each for each in judged if self.missed(np.array(each.reached)) <= REACHED
        ]  # else it stands beside a jump
        return [each for each in true if not (self.passing and each.failing)], jumps

    def missed(self, y: Array) -> Array:
        """Return by how much of the value, or of the range that is taken, each misses it."""
        known = [each for each, _ in self.known.values() if math.isfinite(each)]
        return np.abs(y - self.question.value) / max(abs(self.question.value), float(np.ptp(known)))

    def _off(self, x: Array) -> Array:
        return self._along(x)[0] - self.question.value

    def _held(self, x: Array) -> Array:
        return self._along(x)[1]

    def _along(self, x: Array) -> tuple[Array, Array]:
        """What is asked, and how far it holds, at numbers of which only those are calculated that are new."""
        new = np.array([each for each in dict.fromkeys(x.tolist()) if each not in self.known])
        if len(new):
            self._keep(new, self.machines(new))
        found = np.reshape([self.known[each] for each in x.tolist()], (len(x), 2))
        return found[:, 0], found[:, 1]

    def _keep(self, x: Array, made: VariedMachines) -> None:
        y = made.values(self.question.quantity.column)
        self.known |= dict(zip(x.tolist(), zip(y, self.holds(made, y), strict=True), strict=True))

    def holds(self, made: VariedMachines, y: Array) -> Array:
        """How far what is asked holds: above or equal to zero where it does, NaN where there is no machine."""
        if self.question.kind in ("max", "min"):
            held = np.where(np.isfinite(y), 1.0, np.nan)
        else:
            sign = 1.0 if self.question.kind == "<=" else -1.0
            size = np.maximum(np.maximum(np.abs(y), abs(self.question.value)), 1e-300)
            held = sign * (self.question.value - y) / size
        return np.minimum(held, made.least_slack) if self.passing else np.where(made.exists, held, np.nan)

    def _ranges(self, x: Array, held: Array) -> list[Range]:
        """The ranges of values where it holds."""
        ends: dict[float, float] = {}
        if not self.is_stepped:
            x, held = looked_closer(self._held, x, held)
            x, held = without_gaps(self._held, x, held)
            ends = {each.at: each.inside for each in crossings(self._held, x, held, PASSING_CLOSE)}
        places = self._ends(x, held >= 0, ends)
        found = self._judged(places)
        is_end = [place in (x[0], x[-1]) for place, _ in places]
        found = [replace(each, at_end=last) for each, last in zip(found, is_end, strict=True)]
        return list(zip(found[::2], found[1::2], strict=True))

    def _ends(self, x: Array, holds: Array, refined: dict[float, float]) -> list[tuple[float, Role]]:
        """The lower and the upper end of each range of values that hold; between the points those that were refined."""
        found: list[tuple[float, Role]] = []
        edges = np.flatnonzero(np.diff(np.concatenate([[False], holds, [False]]).astype(int)))
        for first, last in zip(edges[::2], edges[1::2] - 1, strict=True):
            low = _between(refined, x[first - 1], x[first]) if first else None
            high = _between(refined, x[last], x[last + 1]) if last + 1 < len(x) else None
            low, high = x[first] if low is None else low, x[last] if high is None else high
            found += [(float(low), "lower"), (float(high), "upper")]
        return found

    def _extreme(self, x: Array, made: VariedMachines, y: Array) -> list[FoundValue]:
        """Where it is greatest or least among the machines that hold, which may be at the end of those."""
        sign = 1.0 if self.question.kind == "max" else -1.0

        def heights(places: Array) -> Array:
            own, holds = self._along(places)
            return np.where(holds >= 0, sign * own, np.nan)

        if self.is_stepped:
            places = x[self.holds(made, y) >= 0]
            top = float(places[np.nanargmax(heights(places))]) if len(places) else None
        else:
            top = self._top(np.union1d(x, self._about_the_best(x, heights(x))), sign, heights)
        if top is None:
            return []
        return [replace(each, at_end=top in (x[0], x[-1])) for each in self._judged([(top, "extreme")])]

    def _about_the_best(self, x: Array, known: Array) -> Array:
        """More numbers about the best of these, as far as its neighbours: what is rounded fails and passes in steps."""
        if not np.isfinite(known).any():
            return np.array([])
        best = int(np.nanargmax(known))
        first, last = max(best - 2, 0), min(best + 2, len(x) - 1)
        reach = (x[last] - x[first]) / max(last - first, 1)
        near = np.linspace(max(x[best] - reach, x[0]), min(x[best] + reach, x[-1]), NEAR)
        return np.asarray(near[self.design.allows(near)])

    def _top(self, x: Array, sign: float, heights: Function) -> float | None:
        """Where it is highest, between these numbers and at the ends of what holds; None where nothing does."""
        places = self._holding(x, sign)
        known = heights(places)
        return greatest(heights, places, known)[0] if np.isfinite(known).any() else None

    def _holding(self, x: Array, sign: float) -> Array:
        """The places that hold, with the ends of what holds where these may be better than all of them."""
        x, held = looked_closer(self._held, x, self._held(x))
        height = sign * self._along(x)[0]
        best = np.where(held >= 0, height, -np.inf).max()
        rising = ~(np.fmax(height[1:], height[:-1]) < best)
        ends = crossings(self._held, x, held, PASSING_CLOSE, rising)
        return np.unique([*x[held >= 0], *(each.inside for each in ends)])

    # --- the answers -------------------------------------------------------------------------------------------------

    def _judged(self, places: list[tuple[float, Role]]) -> list[FoundValue]:
        """The values as they are typed, calculated as that: with as few digits as answer as well."""
        return typed_answers(self, places)

    def _nearest_first(self, found: list[FoundValue]) -> list[FoundValue]:
        today = self.design.today
        return found if today is None else sorted(found, key=lambda each: abs(each.value - today))

    def _of_ranges(self, ranges: list[Range]) -> list[FoundValue]:
        """Of each range the value nearest to today's, which may be that itself."""
        today = self.design.today
        if today is None:
            return [low for low, _ in ranges]
        if any(low.value <= today <= high.value for low, high in ranges):
            return self._judged([(today, "today")])
        return self._nearest_first([min(ends, key=lambda each: abs(each.value - today)) for ends in ranges])

    def _nearest(self, x: Array, made: VariedMachines, y: Array) -> FoundValue | None:
        """The value that comes nearest to what is asked."""
        away = np.abs(y - self.question.value) if self.question.kind == "=" else -self.holds(made, y)
        away = np.where(made.exists & np.isfinite(away), away, np.inf)
        if not np.isfinite(away).any():
            return None
        if not self.is_stepped and self.question.kind == "=":
            value, _ = greatest(lambda places: -np.abs(self._off(places)), x, -away)
        else:
            best = x[away <= away.min()]  # where all are as far away the one that is nearest to today's
            value = float(best[np.argmin(np.abs(best - (self.design.today or best[0])))])
        found = self._judged([(value, "nearest")])
        return replace(found[0], at_end=value in (x[0], x[-1])) if found else None


def _always_failing(made: VariedMachines) -> tuple[str, ...]:
    """The checks that fail in every machine that can be calculated."""
    return tuple(name for name in made.checks if (made.check(name)[made.exists] == "fail").all())


def _between(refined: dict[float, float], low: float, high: float) -> float | None:
    """The end that was found between two machines; None of values that have none between them."""
    return next((inside for at, inside in refined.items() if low <= at <= high), None)
