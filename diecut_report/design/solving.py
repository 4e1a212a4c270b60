"""One input solved for what is asked of a machine: all its values in a range, the one nearest to today's first, each proved."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.answers import Answer, DesignQuestion, FoundValue, Range, Role, question
from diecut_report.design.inputs import DesignInput
from diecut_report.design.line_search import Function, crossings, greatest, looked_closer, roots, runs, without_gaps
from diecut_report.design.machines import VariedMachines, impossible, narrowed, proved, varied
from diecut_report.errors import Problem, UserError, refusal
from diecut_report.formulas import Array
from diecut_report.mechanism.names import SI
from diecut_report.press import Press
from diecut_report.quantities.formatting import told
from diecut_report.study.definition.base_inputs import is_of_parts, typed_data, with_values
from diecut_report.text.phrases import Phrase

# Where the values of an input are looked for: the range, and the numbers in it at which machines are calculated first.


POINTS = 33  # of the range, at which a machine is calculated before roots are searched between them
WIDER = 3.0  # the range reaches from today's value divided by this to so many times it
MOST_WHOLE = 400  # whole numbers that are all tried
SAME = 1e-12  # relative: what differs by less is the same


def searched_range(design: DesignInput, low: float | None, high: float | None) -> tuple[float, float]:
    """Return the range that is searched: given, or around today's value, as far as the input may go; of a list the whole of it.

    UserError where there is none.
    """
    (least, most), present, known = design.bounds, design.present, design.listed
    if len(known):
        return float(known[0]) if low is None else low, float(known[-1]) if high is None else high
    if (low is None or high is None) and not present:
        template = "{input} has no value at present; give the range to search with --from and --to."
        raise UserError(Problem(Phrase(template, input=design.name), path="--vary"))
    around = sorted((present / WIDER, present * WIDER)) if present else (math.nan, math.nan)
    first = max(around[0], least) if low is None else low
    last = min(around[1], most) if high is None else high
    if not first < last:
        template = "{input}: the range from {low} to {high} is empty; give --from below --to."
        empty = Phrase(template, input=design.name, low=design.told(first), high=design.told(last))
        raise UserError(Problem(empty, path="--from"))
    return first, last


def searched_places(design: DesignInput, low: float, high: float) -> Array:
    """Return where the range is looked at: at equal ratios where it is wide, today's value among them; whole and listed numbers all."""
    present, known = design.present, design.listed
    if len(known):
        if present is not None:  # it stands as it is, to the last digit
            known = np.where(np.isclose(known, present, rtol=SAME), present, known)
        return known[(known >= low * (1 - SAME)) & (known <= high * (1 + SAME))]
    if design.is_whole:
        whole = np.arange(math.ceil(low), math.floor(high) + 1, dtype=float)
        return whole if len(whole) <= MOST_WHOLE else np.unique(np.round(np.linspace(low, high, MOST_WHOLE)))
    is_wide = low > 0 and high / low > 4
    x = np.geomspace(low, high, POINTS) if is_wide else np.linspace(low, high, POINTS)
    if present is not None and low < present < high:
        x = np.unique(np.append(x, present))
    return x[design.allows(x)] if design.allows(x).any() else x


PASSING_CLOSE = 1e-6  # relative width at which the limit of what passes is known: more is not typed
NEAR = 60  # machines about the best one, as far as its neighbours


def solved(
    press: Press, asked: str, design: DesignInput, *, passing: bool, low: float | None, high: float | None
) -> Answer:  # fmt: skip
    """Return the values of an input with which a question is answered; with ``passing`` only those with which no check fails.

    UserError in words where that is not a question, there is no range to search, or what is asked does not vary with the input.
    """
    config, of_parts = press.config, is_of_parts(press.config, design.asked)
    if design.present is None and low is not None:  # a value may bring quantities with it that are not there without
        config, _ = _with_value(config, design, low)
    what = question(config, asked)
    press.tell(Phrase("solving for {input}", input=design.name))
    base = config if of_parts else press.config
    if design.is_text:
        answer = _TextSearch(base, what, design, passing, of_parts).chosen()
    else:
        search = _RangeSearch(base, what, design, passing, of_parts)
        answer = replace(search.answer(*searched_range(design, low, high)), refused=search.refused())
    return _proved(answer, press) if answer.found else answer


def _with_value(config: Config, design: DesignInput, value: float) -> tuple[Config, list[Problem]]:
    if is_of_parts(config, design.asked):
        return config.retyped({design.stands: typed_data(design.asked, value)})
    return with_values(config, {design.asked: SI(value, design.meta.parsed_unit.si, design.name)})


def _proved(answer: Answer, press: Press) -> Answer:
    """The answer with the first value that a machine can have, calculated alone; UserError where there is none such."""
    faults: list[UserError] = []
    for index, first in enumerate(answer.found):
        try:
            machine = proved(press.with_values({answer.design.stands: answer.design.in_file(first.typed)}))
        except UserError as fault:
            faults.append(fault)
            continue
        reached = machine.outputs.get(answer.question.quantity.column, first.reached)
        first = replace(first, reached=reached, failing=machine.failing)
        return replace(answer, found=(first, *answer.found[index + 1 :]), machine=machine)
    template = "{input} = {typed} satisfies it, but the machine then cannot exist: {reason}"
    typed, reason = answer.found[0].typed, faults[0].problems[0].message
    raise refusal(template, press.config.tree.file, input=answer.design.name, typed=typed, reason=reason)


@dataclass
class _RangeSearch:
    """Looks along the range of an input; ``part`` are the mechanisms that must be calculated for it, all where the parts follow it."""

    config: Config
    question: DesignQuestion
    design: DesignInput
    passing: bool
    of_parts: bool

    def __post_init__(self) -> None:
        asked = self.question.quantity
        # of an input the whole says whether it can be
        is_whole = self.passing or self.of_parts or asked.asked is not None
        self.part = self.config if is_whole else narrowed(self.config, [asked.home, self.design.asked.instance])
        self.inputs = [] if asked.asked is None else [asked.asked]
        self.known: dict[float, tuple[float, float]] = {}
        self.size = 0.0  # of what is asked, and of the checks: the same for all machines
        self.sizes: dict[str, float] = {}

    def machines(self, x: Array) -> VariedMachines:
        return varied(self.part, {self.design.asked: x}, len(x), self.inputs)

    def answer(self, low: float, high: float) -> Answer:
        """Return what is found in the range; nothing of it is proved yet."""
        x = searched_places(self.design, low, high)
        made = self.machines(x)
        y = made.values(self.question.quantity.column)
        self._refuse_constant(made, y, x)
        self._keep(x, made)
        present = y[x == (math.nan if self.design.present is None else self.design.present)]
        today = float(present[0]) if len(present) else math.nan
        answer = Answer(self.question, self.design, float(x[0]), float(x[-1]), today, passing=self.passing)
        if self.question.kind == "=":
            found, jumps = self._roots(x, y)
            answer = replace(answer, found=tuple(self._nearest_first(found)), jumps=tuple(jumps))
        elif self.question.is_extreme:
            answer = replace(answer, found=tuple(self._extreme(x, made, y)))
        else:
            ranges = self._ranges(x, self.holds(made, y))
            answer = replace(answer, found=tuple(self._of_ranges(ranges)), ranges=tuple(ranges))
        if answer.found:
            return answer
        failing = [name for name in made.checks if (made.check(name)[made.exists] == "fail").all()]
        return replace(answer, nearest=self._nearest(x, made, y), always=tuple(failing) if self.passing else ())

    def _refuse_constant(self, made: VariedMachines, y: Array, x: Array) -> None:
        known, places, file = y[np.isfinite(y)], x[np.isfinite(y)], self.config.tree.file
        name, asked = self.design.name, self.question.quantity
        if not made.exists.any():
            template = "no machine of the range of {input} can be calculated: {reason}"
            reason = next(filter(None, made.errors))
            raise impossible(self.config, reason, Phrase(template, input=name, reason=reason))
        if not len(known):
            raise refusal("{asked} has no value in the whole range of {input}.", file, asked=asked.name, input=name)
        # today's value may stand beside itself, but for rounding
        if np.ptp(known) <= SAME * np.abs(known).max() and np.ptp(places) > SAME * np.abs(places).max():
            template = "{asked} does not vary with {input}: it is {value} in the whole range."
            raise refusal(template, file, asked=asked.name, input=name, value=told(float(known[0]), asked.unit, 6))

    # --- what is looked for ------------------------------------------------------------------------------------------

    def _roots(self, x: Array, y: Array) -> tuple[list[FoundValue], list[float]]:
        value, present = self.question.value, self.design.present
        off = y - value
        if self.design.is_stepped:
            exact = np.abs(off) <= SAME * max(abs(value), 1e-300)
            return typed_answers(self, [(float(each), "root") for each in x[exact]]), []
        places, jumps = roots(self._off, x, off, present, self.design.allows)
        judged = typed_answers(self, [(each, "today" if each == present else "root") for each in places])
        # what misses the value stands beside a jump
        true = [each for each in judged if self.missed(np.array(each.reached)) <= REACHED]
        return [each for each in true if not (self.passing and each.failing)], jumps

    def missed(self, y: Array) -> Array:
        """Return by how much of the value, or of the range that is taken, each misses it."""
        known = [each for each, _ in self.known.values() if math.isfinite(each)]
        return np.abs(y - self.question.value) / (max(abs(self.question.value), float(np.ptp(known))) or 1.0)

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

    def refused(self) -> dict[str, str]:
        """Return which of the values that are tried no machine can have, and why."""
        if not self.design.among:
            return {}
        made = self.machines(np.array([self.design.read(text) for text in self.design.among]))
        return {text: why for text, why in zip(self.design.among, made.errors, strict=True) if why}

    def _keep(self, x: Array, made: VariedMachines) -> None:
        y = made.values(self.question.quantity.column)
        self.known |= dict(zip(x.tolist(), zip(y, self.holds(made, y), strict=True), strict=True))

    def holds(self, made: VariedMachines, y: Array) -> Array:
        """How far what is asked holds: above or equal to zero where it does, NaN where there is no machine."""
        if self.question.is_extreme:
            held = np.where(np.isfinite(y), 1.0, np.nan)
        else:
            sign = 1.0 if self.question.kind == "<=" else -1.0
            self.size = self.size or float(np.nanmax(np.abs(y), initial=abs(self.question.value)))
            held = sign * (self.question.value - y) / (self.size or 1.0)
        return np.minimum(held, made.least_slack(self.sizes)) if self.passing else np.where(made.exists, held, np.nan)

    def _ranges(self, x: Array, held: Array) -> list[Range]:
        refined: dict[float, float] = {}
        if not self.design.is_stepped:
            x, held = looked_closer(self._held, x, held)
            x, held = without_gaps(self._held, x, held)
            refined = {each.at: each.inside for each in crossings(self._held, x, held, PASSING_CLOSE)}
        places: list[tuple[float, Role]] = []
        for run in runs(held >= 0):
            first, last = run.start, run.stop - 1
            low = _between(refined, x[first - 1], x[first], x[first]) if first else x[first]
            high = _between(refined, x[last], x[last + 1], x[last]) if last + 1 < len(x) else x[last]
            places += [(float(low), "lower"), (float(high), "upper")]
        found = [
            replace(each, at_end=self._is_end(place, x))
            for each, (place, _) in zip(typed_answers(self, places), places, strict=True)
        ]
        return list(zip(found[::2], found[1::2], strict=True))

    def _extreme(self, x: Array, made: VariedMachines, y: Array) -> list[FoundValue]:
        """Where it is greatest or least among the machines that hold, which may be at the end of those."""
        sign = 1.0 if self.question.kind == "max" else -1.0

        def heights(places: Array) -> Array:
            own, holds = self._along(places)
            return np.where(holds >= 0, sign * own, np.nan)

        if self.design.is_stepped:
            places = x[self.holds(made, y) >= 0]
            top = float(places[np.nanargmax(heights(places))]) if len(places) else None
        else:
            top = self._top(np.union1d(x, self._about_the_best(x, heights(x))), sign, heights)
        found = [] if top is None else typed_answers(self, [(top, "extreme")])
        return [replace(each, at_end=self._is_end(top, x)) for each in found]

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
        """Where it is highest, between these numbers and at the ends of what holds where these may be better; None where nothing holds."""
        x, held = looked_closer(self._held, x, self._held(x))
        height = sign * self._along(x)[0]
        best = np.where(held >= 0, height, -np.inf).max()
        rising = ~(np.fmax(height[1:], height[:-1]) < best)
        ends = crossings(self._held, x, held, PASSING_CLOSE, rising)
        places = np.unique([*x[held >= 0], *(each.inside for each in ends)])
        known = heights(places)
        return greatest(heights, places, known)[0] if np.isfinite(known).any() else None

    # --- the answers -------------------------------------------------------------------------------------------------

    def _is_end(self, place: float | None, x: Array) -> bool:
        """Whether a number lies at an end of the range, beyond which others might answer."""
        return place in (x[0], x[-1]) and not self.design.among

    def _nearest_first(self, found: list[FoundValue]) -> list[FoundValue]:
        present = self.design.present
        return found if present is None else sorted(found, key=lambda each: abs(each.value - present))

    def _of_ranges(self, ranges: list[Range]) -> list[FoundValue]:
        """Of each range the value nearest to today's, which may be that itself."""
        present = self.design.present
        if present is None:
            return [low for low, _ in ranges]
        if any(low.value <= present <= high.value for low, high in ranges):
            return typed_answers(self, [(present, "today")])
        return self._nearest_first([min(ends, key=lambda each: abs(each.value - present)) for ends in ranges])

    def _nearest(self, x: Array, made: VariedMachines, y: Array) -> FoundValue | None:
        away = np.abs(y - self.question.value) if self.question.kind == "=" else -self.holds(made, y)
        away = np.where(made.exists & np.isfinite(away), away, np.inf)
        if not np.isfinite(away).any():
            return None
        if not self.design.is_stepped and self.question.kind == "=":
            value, _ = greatest(lambda places: -np.abs(self._off(places)), x, -away)
        else:
            best = x[away <= away.min()]  # where all are as far away the one that is nearest to today's
            value = float(best[np.argmin(np.abs(best - (self.design.present or best[0])))])
        found = typed_answers(self, [(value, "nearest")])
        return replace(found[0], at_end=self._is_end(value, x)) if found else None


class _TextSearch(_RangeSearch):
    """Tries each text that an input may be; the numbers along the range are their places in the list."""

    def machines(self, x: Array) -> VariedMachines:
        return varied(self.part, {self.design.asked: [self.design.options[int(i)] for i in x]}, len(x), self.inputs)

    def chosen(self) -> Answer:
        """Return the texts with which what is asked holds, today's first; nothing of it is proved yet."""
        options, present = self.design.options, self.design.written
        made = self.machines(np.arange(len(options)))
        y = made.values(self.question.quantity.column)
        self._refuse_constant(made, y, np.arange(len(options)))
        tried = [FoundValue(math.nan, text, float(y[i]), "today" if text == present else "choice", tuple(made.failing(i)))
                 for i, text in enumerate(options)]  # fmt: skip
        today = next((each.reached for each in tried if each.role == "today"), math.nan)
        answer = Answer(self.question, self.design, math.nan, math.nan, today, passing=self.passing)
        answer = replace(answer, refused={options[i]: why for i, why in enumerate(made.errors) if why})
        held = self._held_by(made, y)
        if held.any():
            found = sorted((tried[i] for i in np.flatnonzero(held)), key=lambda each: each.role != "today")
            return replace(answer, found=tuple(found))
        away = np.abs(y - self.question.value) if self.question.kind == "=" else -self.holds(made, y)
        nearest = tried[int(np.nanargmin(away))] if np.isfinite(away).any() else None
        return replace(answer, nearest=nearest and replace(nearest, role="nearest"))

    def _held_by(self, made: VariedMachines, y: Array) -> Array:
        """The texts that answer: of an extreme the best of those that hold."""
        if self.question.kind == "=":
            size = max(abs(self.question.value), float(np.ptp(y[np.isfinite(y)])))
            passes = made.passes if self.passing else made.exists
            return np.asarray(passes & (np.abs(y - self.question.value) <= REACHED * size))
        held = self.holds(made, y) >= 0
        if self.question.is_extreme and held.any():
            height = np.where(held, y if self.question.kind == "max" else -y, -np.inf)
            held &= height >= height.max() - SAME * abs(height.max())
        return np.asarray(held)


def _between(refined: dict[float, float], low: float, high: float, known: float) -> float:
    """The end that was found between two machines; of values that have none between them the known one."""
    return next((inside for at, inside in refined.items() if low <= at <= high), known)


# Values that were found, as they are typed: with few digits where these answer as well, each calculated as it is typed.


EXACT, ALL = 9, 17  # digits of a root; of one beside a jump
REACHED = 1e-5  # share of its size by which a root as it is typed may miss the value
FEW = 5  # digits of the end of a range
SAME_END = 1e-6  # share of an end by which a rounded one may lie beyond it, where it holds all the same
SAME_EXTREME = 2e-5  # share of an extreme that rounding the input may take from it
BEYOND = 1e-4  # share of a value by which it is left to see what fails there


def typed_answers(search: _RangeSearch, places: Sequence[tuple[float, Role]]) -> list[FoundValue]:
    """Return for each place what is typed there, all calculated in one run."""
    design = search.design
    texts = [_candidates(design, value, role) for value, role in places]
    rows = [(number, design.read(text)) for number, each in enumerate(texts) for text in each]
    beyond = [(number, value) for number, (value, role) in enumerate(places) for value in _outside(search, value, role)]
    if not rows:
        return []
    x = np.array([value for _, value in (*rows, *beyond)])
    made = search.machines(x)
    y = made.values(search.question.quantity.column)
    held, missed = search.holds(made, y) >= 0, search.missed(y)
    failed = np.array([len(made.failing(row)) for row in range(len(rows))])
    owner = np.array([number for number, _ in (*rows, *beyond)])
    found = []
    for number, (value, role) in enumerate(places):
        own = np.flatnonzero(owner[: len(rows)] == number)
        best = _chosen(own, x, y, held, missed, failed, value, role)
        outside = np.flatnonzero(owner[len(rows) :] == number) + len(rows)
        failing = tuple(made.failing(best)) if search.passing else ()
        limits = tuple(dict.fromkeys(name for row in outside for name in made.failing(int(row)) if name not in failing))
        found.append(FoundValue(float(x[best]), texts[number][best - own[0]], float(y[best]), role, failing, limits))
    return found


def _candidates(design: DesignInput, value: float, role: Role) -> list[str]:
    """What may be typed, the best first."""
    exact = design.typed(value, EXACT)
    if design.is_stepped or role == "today" or value == design.present:
        return [exact]
    inwards = [design.typed_inwards(value, EXACT, up=up) for up in (True, False)]
    few = {
        "root": [exact, *inwards, design.typed(value, ALL)],  # beside a jump rounding may fall over its edge
        "lower": [design.typed(value, FEW), design.typed_inwards(value, FEW, up=True), inwards[0], exact],
        "upper": [design.typed(value, FEW), design.typed_inwards(value, FEW, up=False), inwards[1], exact],
        "extreme": [*(design.typed(value, digits) for digits in (3, 4, 5, 6, 7)), exact],
    }.get(role, [exact])
    return [text for text in dict.fromkeys(few) if design.allows(np.array(design.read_allowed(text)))]


def _chosen(own: Array, x: Array, y: Array, held: Array, missed: Array, failed: Array, value: float, role: Role) -> int:
    """The first of the candidates that is as good as the exact one, which is the last.

    What is asked may be the limit of a check: of roots those count with which fewer checks fail.
    """
    exact = int(own[-1])
    if role in ("lower", "upper"):
        near = np.abs(x[own] - value) <= SAME_END * abs(value)
        inside = x[own] >= value if role == "lower" else x[own] <= value
        good = held[own] & (near | inside)
    elif role == "extreme":
        good = held[own] & (np.abs(y[own] - y[exact]) <= SAME_EXTREME * abs(y[exact]))
    elif role == "root":
        good = missed[own] <= REACHED
        good &= failed[own] == np.min(failed[own], initial=np.max(failed[own]), where=good)
    else:
        return exact
    return int(own[np.argmax(good)]) if good.any() else exact


def _outside(search: _RangeSearch, value: float, role: Role) -> list[float]:
    """Values just beyond the end of what passes."""
    is_whole = search.design.is_whole
    if not search.passing or role in ("root", "today", "nearest") or search.design.is_stepped > is_whole:
        return []
    step = 1.0 if is_whole else BEYOND * abs(value)
    ways = {"lower": (-step,), "upper": (step,)}.get(role, (-step, step))
    beyond = np.array([value + way for way in ways])
    return [float(each) for each in beyond[search.design.allows(beyond)]]
