"""One input solved for what is asked of a machine: all its values in a range, the one nearest to today's first, each proved."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.answers import (
    REACHED,
    Answer,
    DesignQuestion,
    FoundValue,
    Range,
    Role,
    needed,
    question,
    typed_answers,
)
from diecut_report.design.inputs import DesignInput, is_stepped, with_input
from diecut_report.design.machines import VariedMachines, impossible, proved, varied
from diecut_report.errors import Problem, UserError
from diecut_report.formulas import Array
from diecut_report.mechanics import numerics
from diecut_report.press import Press
from diecut_report.text.phrases import Phrase

# Roots, limits and extremes of a function of one number that is calculated for many numbers at once, each call being dear.
#
# Every call asks for a handful of numbers for each bracket: some spread evenly, which shrink any bracket, and some close to
# where a straight line through its ends says, which shrink a smooth one at once.


Function = Callable[[Array], Array]
"""Of numbers, shape (n,): what is to be zero, above zero where it holds, NaN where there is nothing."""

EVEN, LEAST_EVEN = 12, 3  # numbers that are spread evenly, of all brackets together, and of each at least
AROUND = np.array([-1e-2, -1e-4, 0.0, 1e-4, 1e-2])
ROUNDS = 20
CLOSE = 1e-9  # relative width at which a bracket is closed
JUMP = 1e-2  # share of a bracket's first difference that is left in one so narrow: the function jumps there
PARTS, ZOOMS = 10, 6  # of the neighbourhood of the greatest value, and how often it is looked at closer
EIGHTHS, HALF = np.arange(1, 8) / 8, np.array([0.5])  # of a pair of neighbours
HALVED = 5  # how often the distances of such neighbours are halved at most
MOST_CELLS = 12  # such ends that are looked at closer


@dataclass(frozen=True)
class Crossing:
    """Hold a place where a function changes its sign: ``inside`` is on the side where it is not below zero, ``at`` between both.

    ``is_jump``: it does not pass through zero there, but from one value to another (or to none).
    """

    at: float
    inside: float
    is_jump: bool


def crossings(
    function: Function, x: Array, values: Array, close: float = CLOSE, among: Array | None = None
) -> list[Crossing]:
    """Return where a function changes its sign, between neighbours of ascending numbers with their values; NaN is below zero.

    ``among`` says of each pair of neighbours whether it is looked at.
    """
    holds = values >= 0
    cells = np.flatnonzero((holds[1:] != holds[:-1]) & (True if among is None else among))
    if not len(cells):
        return []
    low, high = np.array([x[cells], values[cells]]), np.array([x[cells + 1], values[cells + 1]])
    first = np.abs(high[1] - low[1])
    for _ in range(ROUNDS):
        open_ = high[0] - low[0] > close * np.maximum(np.abs(low[0]), np.abs(high[0]))
        if not open_.any():
            break
        low[:, open_], high[:, open_] = _narrower(function, low[:, open_], high[:, open_])
    return [_crossing(low[:, i], high[:, i], first[i]) for i in range(len(cells))]


def _narrower(function: Function, low: Array, high: Array) -> tuple[Array, Array]:
    """The same brackets, each between the two of the numbers within it where the sign changes first."""
    share = _shares(low[1], high[1])
    places = low[0] + share * (high[0] - low[0])
    found = function(places.ravel()).reshape(places.shape)
    x = np.concatenate([low[:1], places, high[:1]])
    values = np.concatenate([low[1:], found, high[1:]])
    holds = values >= 0
    cell = np.argmax(holds[1:] != holds[:-1], axis=0)
    column = np.arange(x.shape[1])
    return (
        np.array([x[cell, column], values[cell, column]]),
        np.array([x[cell + 1, column], values[cell + 1, column]]),
    )


def _shares(low: Array, high: Array) -> Array:
    """Where to look in each bracket, as ascending shares of its width, shape (places, brackets)."""
    with np.errstate(all="ignore"):
        line = low / (low - high)
    line = np.where(np.isfinite(line), line, 0.5)
    near = np.clip(line[None] + AROUND[:, None], 1e-6, 1 - 1e-6)
    count = max(LEAST_EVEN, EVEN // len(low))
    even = np.broadcast_to(np.arange(1, count + 1)[:, None] / (count + 1), (count, len(low)))
    return np.sort(np.concatenate([even, near]), axis=0)


def _crossing(low: Array, high: Array, first: float) -> Crossing:
    inside = low if low[1] >= 0 else high
    left = abs(high[1] - low[1])
    is_jump = not np.isfinite(left) or (left > JUMP * first and inside[1] != 0)
    at = inside[0] if is_jump or not left else low[0] - low[1] * (high[0] - low[0]) / (high[1] - low[1])
    return Crossing(float(at), float(inside[0]), bool(is_jump))


def greatest(function: Function, x: Array, values: Array) -> tuple[float, float]:
    """Return where a function is greatest and its value there, refined from values at ascending numbers, of which some are not NaN."""
    best = int(np.nanargmax(values))
    low, high = x[max(best - 1, 0)], x[min(best + 1, len(x) - 1)]
    rounds = ZOOMS if high > low else 1
    place, depth = numerics.least(
        lambda at, _: np.nan_to_num(-function(at[0]), nan=np.inf)[None],
        np.array([low]),
        np.array([high]),
        PARTS,
        rounds,
    )
    return (float(place[0]), float(-depth[0])) if -depth[0] > values[best] else (float(x[best]), float(values[best]))


def looked_closer(function: Function, x: Array, values: Array, rounds: int = 1) -> tuple[Array, Array]:
    """Return ascending numbers and values with more of them where a pair of roots, or the end of what exists, may hide.

    Towards each such end they stand closer with each round: much may happen there, and all that exists may lie between two of the numbers.
    """
    cells = np.unique(np.concatenate([_edges(values), _lows(values)])).astype(int)
    for _ in range(rounds):
        if not len(cells):
            break
        x, values = _with_more(function, x, values, cells)
        cells = _edges(values)[:MOST_CELLS]
    return x, values


def without_gaps(function: Function, x: Array, values: Array) -> tuple[Array, Array]:
    """Return ascending numbers and values with more of them between neighbours that are not below zero, as long as one there is."""
    for _ in range(HALVED):
        cells = np.flatnonzero((values[1:] >= 0) & (values[:-1] >= 0))
        before = int((~(values >= 0)).sum())
        if len(cells):
            x, values = _with_more(function, x, values, cells, HALF)
        if int((~(values >= 0)).sum()) == before:
            break
    return x, values


def _with_more(
    function: Function, x: Array, values: Array, cells: Array, shares: Array = EIGHTHS
) -> tuple[Array, Array]:
    more = (x[cells] + shares[:, None] * (x[cells + 1] - x[cells])).ravel()
    joined, place = np.unique(np.concatenate([x, more]), return_index=True)
    return joined, np.concatenate([values, function(more)])[place]


def _edges(values: Array) -> Array:
    """The pairs of neighbours of which one alone has a value."""
    exists = np.isfinite(values)
    return np.flatnonzero(exists[1:] != exists[:-1])


def _lows(values: Array) -> Array:
    """The pairs of neighbours beside a value that is nearest to zero, and may reach it between them."""
    size, inner = np.abs(values), np.arange(1, len(values) - 1)
    with np.errstate(invalid="ignore"):
        signs = np.sign(values)
        alike = (signs[inner - 1] == signs[inner]) & (signs[inner] == signs[inner + 1])
        rise = np.maximum(size[inner - 1], size[inner + 1]) - size[inner]
        is_lowest = (size[inner] <= size[inner - 1]) & (size[inner] <= size[inner + 1])
        low = inner[alike & is_lowest & (size[inner] <= rise)]  # else it is too far from zero to reach it
    return np.concatenate([low - 1, low])


# All places of a range where a function takes a value: passed through, stayed at, or hidden beside an end of what exists.


SAME_PLACE = 1e-8  # relative: two roots that are no further apart are one
ROOT_SEARCH_ROUNDS = 4  # towards an end of what exists: to a 4096th of the distance between two numbers
NEARER = 60  # machines about today's value, as far as the nearest root that was found


def roots(
    function: Function, x: Array, values: Array, present: float | None, allows: Callable[[Array], Array]
) -> tuple[list[float], list[float]]:
    """Return where a function is zero, ascending, and where it jumps over zero; of places that are all zero the ends, and ``present``.

    It is searched between ascending numbers with their values, and closer about today's, so that the nearest root is not missed.
    """
    x, values = looked_closer(function, x, values, ROOT_SEARCH_ROUNDS)
    places, jumps = _crossed(function, x, values, present)
    more = _about(present, places, x, allows) if places else _about_the_nearest(function, x, values)
    if not len(more):
        return places, jumps
    x = np.union1d(x, more)
    return _crossed(function, x, function(x), present)


def _crossed(function: Function, x: Array, values: Array, present: float | None) -> tuple[list[float], list[float]]:
    """The places between these numbers alone."""
    places: list[float] = []
    jumps: list[float] = []
    for run in _existing(values):
        own, known = x[run], values[run]
        for each in crossings(function, own, known):
            (jumps if each.is_jump else places).append(each.at)
        ends = ((known[1:] == 0) != (known[:-1] == 0)) & (known[1:] >= 0) & (known[:-1] >= 0)
        places += [each.at for each in crossings(lambda at: -function(at), own, -known, among=ends)]
    beside = np.concatenate([[np.nan], values, [np.nan]])
    before, after = beside[:-2], beside[2:]
    is_kept = ((before == 0) | (after == 0)) & np.isfinite(before) & np.isfinite(after)  # its ends are found
    taken = [float(each) for each in x[(values == 0) & (~is_kept | (x == present))]]
    found = [each for each in places if all(abs(each - one) > SAME_PLACE * abs(one) for one in taken)]
    return sorted([*taken, *found]), jumps


def _about(present: float | None, places: list[float], x: Array, allows: Callable[[Array], Array]) -> Array:
    """Numbers about today's value, as far as the nearest place: another may lie nearer."""
    if present is None:
        return np.array([])
    reach = min(abs(each - present) for each in places)
    near = np.linspace(present - reach, present + reach, NEARER + 1)
    return np.asarray(near[(near > x[0]) & (near < x[-1]) & allows(near)])


def _about_the_nearest(function: Function, x: Array, values: Array) -> Array:
    """Numbers about the one whose value comes nearest to zero: it may change its sign beside it."""
    tried: list[float] = []

    def nearness(places: Array) -> Array:
        tried.extend(places.tolist())
        return -np.abs(function(places))

    greatest(nearness, x, -np.abs(values))
    return np.array(tried)


def _existing(values: Array) -> list[slice]:
    """The runs of neighbours that all have a value."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], np.isfinite(values), [False]]).astype(int)))
    return [slice(int(first), int(last)) for first, last in zip(edges[::2], edges[1::2], strict=True)]


# Where the values of an input are looked for: the range, and the numbers in it at which machines are calculated first.


POINTS = 33  # of the range, at which a machine is calculated before roots are searched between them
WIDER = 3.0  # the range reaches from today's value divided by this to so many times it
MOST_WHOLE = 400  # whole numbers that are all tried
SAME = 1e-12  # relative: what differs by less is the same


def searched_range(design: DesignInput, low: float | None, high: float | None) -> tuple[float, float]:
    """Return the range that is searched: given, or around today's value, as far as the input may go; of a list the whole of it.

    UserError where there is none.
    """
    least, most = design.bounds
    present = design.present
    if design.meta.listed:
        known = _listed(design)
        return float(known[0]) if low is None else low, float(known[-1]) if high is None else high
    if (low is None or high is None) and not present:
        words = "{input} has no value at present; give the range to search with --from and --to."
        raise UserError(Problem(Phrase(words, input=design.name), path="--vary"))
    around = sorted((present / WIDER, present * WIDER)) if present else (math.nan, math.nan)
    first = max(around[0], least) if low is None else low
    last = min(around[1], most) if high is None else high
    if not first < last:
        words = "{input}: the range from {low} to {high} is empty; give --from below --to."
        raise UserError(
            Problem(Phrase(words, input=design.name, low=design.told(first), high=design.told(last)), path="--from")
        )
    return first, last


def searched_places(design: DesignInput, low: float, high: float) -> Array:
    """Return where the range is looked at: at equal ratios where it is wide, today's value among them; whole and listed numbers all."""
    if design.meta.listed:
        known = _listed(design)
        return known[(known >= low * (1 - SAME)) & (known <= high * (1 + SAME))]
    if design.is_whole:
        whole = np.arange(math.ceil(low), math.floor(high) + 1, dtype=float)
        return whole if len(whole) <= MOST_WHOLE else np.unique(np.round(np.linspace(low, high, MOST_WHOLE)))
    is_wide = low > 0 and high / low > 4
    x = np.geomspace(low, high, POINTS) if is_wide else np.linspace(low, high, POINTS)
    present = design.present
    if present is not None and low < present < high:
        x = np.unique(np.append(x, present))
    return x[design.allows(x)] if design.allows(x).any() else x


def _listed(design: DesignInput) -> Array:
    """The numbers of its list (SI), ascending; today's as it is, to the last digit."""
    known = np.sort(np.array([design.meta.parsed_unit.to_si(value) for value in design.meta.listed]))
    return (
        known
        if design.present is None
        else np.where(np.isclose(known, design.present, rtol=SAME), design.present, known)
    )


PASSING_CLOSE = 1e-6  # relative width at which the limit of what passes is known: more is not typed
NEAR = 60  # machines about the best one, as far as its neighbours


def solved(
    press: Press, asked: str, design: DesignInput, *, passing: bool = False, low: float | None = None, high: float | None = None
) -> Answer:  # fmt: skip
    """Return the values of an input with which a question is answered; with ``passing`` only those with which no check fails.

    UserError in words where that is not a question, there is no range to search, or what is asked does not vary with the input.
    """
    config = press.config
    is_new = design.present is None and low is not None
    what = question(with_input(config, design, low or 0.0) if is_new else config, asked)
    press.tell(Phrase("solving for {input}", input=design.name))
    ends = searched_range(design, low, high)
    search = _RangeSearch(config, what, design, passing)
    answer = search.answer(*ends)
    if not answer.found:
        return answer
    return _proved(answer, press)


def _proved(answer: Answer, press: Press) -> Answer:
    """The answer with the first value that a machine can have, calculated alone; UserError where there is none such."""
    faults: list[UserError] = []
    for index, first in enumerate(answer.found):
        try:
            machine = proved(press.with_values({answer.design.stands: first.typed}))
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
    words = "{input} = {typed} satisfies it, but the machine then cannot exist: {reason}"
    what = {"input": answer.design.name, "typed": answer.found[0].typed, "reason": faults[0].problems[0].message}
    raise UserError(Problem(Phrase(words, what), press.config.tree.file))


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
        answer = Answer(
            self.question, self.design, float(x[0]), float(x[-1]), self._present(x, y), passing=self.passing
        )
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
            raise impossible(self.config, reason, Phrase(words, input=name, reason=reason))
        if not len(known):
            words = "{asked} has no value in the whole range of {input}."
            raise UserError(Problem(Phrase(words, asked=asked, input=name), self.config.tree.file))
        if np.ptp(known) <= SAME * np.abs(known).max() and len(known) > 1:
            words = "{asked} does not vary with {input}: it is {value} in the whole range."
            value = self.question.quantity.told(float(known[0]))
            raise UserError(Problem(Phrase(words, asked=asked, input=name, value=value), self.config.tree.file))

    def _present(self, x: Array, y: Array) -> float:
        index = np.flatnonzero(x == (np.nan if self.design.present is None else self.design.present))
        return float(y[index[0]]) if len(index) else math.nan

    # --- what is looked for ------------------------------------------------------------------------------------------

    def _roots(self, x: Array, y: Array) -> tuple[list[FoundValue], list[float]]:
        value = self.question.value
        off = y - value
        if self.is_stepped:
            exact = np.abs(off) <= SAME * max(abs(value), 1e-300)
            return self._judged([(float(each), "root") for each in x[exact]]), []
        places, jumps = roots(self._off, x, off, self.design.present, self.design.allows)
        judged = self._judged([(each, "today" if each == self.design.present else "root") for each in places])
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
        present = self.design.present
        return found if present is None else sorted(found, key=lambda each: abs(each.value - present))

    def _of_ranges(self, ranges: list[Range]) -> list[FoundValue]:
        """Of each range the value nearest to today's, which may be that itself."""
        present = self.design.present
        if present is None:
            return [low for low, _ in ranges]
        if any(low.value <= present <= high.value for low, high in ranges):
            return self._judged([(present, "today")])
        return self._nearest_first([min(ends, key=lambda each: abs(each.value - present)) for ends in ranges])

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
            value = float(best[np.argmin(np.abs(best - (self.design.present or best[0])))])
        found = self._judged([(value, "nearest")])
        return replace(found[0], at_end=value in (x[0], x[-1])) if found else None


def _always_failing(made: VariedMachines) -> tuple[str, ...]:
    """The checks that fail in every machine that can be calculated."""
    return tuple(name for name in made.checks if (made.check(name)[made.exists] == "fail").all())


def _between(refined: dict[float, float], low: float, high: float) -> float | None:
    """The end that was found between two machines; None of values that have none between them."""
    return next((inside for at, inside in refined.items() if low <= at <= high), None)
