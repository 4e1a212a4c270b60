"""Which assumed and default values are harmless: no check changes its status at either end of what is usual for them.

Each value is tried alone, then all of them together in the direction that is worst for each check, then all at ends that are drawn: no check
may fail there that does not today. What remains open says why.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.design.inputs import DesignInput, standing_numbers
from diecut_report.design.machines import MARGIN, SIZE, downstream, margins
from diecut_report.errors import PluginError
from diecut_report.formulas import Array
from diecut_report.mechanism.inputs import flatten
from diecut_report.results.conclusion import VALUES
from diecut_report.results.model import OpenRecord, ResultsRecord
from diecut_report.results.open_items import UNPROVED
from diecut_report.results.usual import USUAL, ends_by_ratio, with_value
from diecut_report.results.warm_press import WarmPress, WarmRun
from diecut_report.standards.ranges import UsualRange, ranges_of
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.execution.press_batch import CalculatedVariants, Mixed, NotOnArrays, calculated
from diecut_report.study.execution.variant_rows import STATUS, verdicts
from diecut_report.text.phrases import Phrase, phrase

SHARE = 0.1  # of a value for which no range is known, downwards and upwards
HALVED = 50  # how often the way to an end that is not allowed is halved
TWICE = 2.0  # what a value is multiplied by to see with which power of it another one grows
STILL = 1e-9  # of the greater side of a check, by which rounding alone moves its margin
# how many of those that change a check together are taken out, strongest first
LEFT_OUT = tuple(2**k for k in range(8))
SEED, DRAWN = 29, 16  # of machines that are drawn, and how many at once
CLEAN = 64  # drawn without a find end the search
ROUNDS = 40  # at most
JUDGED = 4  # of those of one draw in which a check fails
NO_NUMBER = phrase("it is not one number of the configuration, so no other value was tried")
OF_PARTS = phrase("parts of the machine are made with it, so no other value was tried")
NO_ARRAYS = phrase("its mechanism takes no arrays, so no other value was tried")
STANDS_ALONE = phrase("what else it might be nothing tells, so no other value was tried")


def without_harmless(config: Config, results: ResultsRecord) -> list[OpenRecord]:
    """Return what is open of a machine without the assumed and default values that are proved harmless; those left say which check changes.

    Values that are not a single number of the configuration, those that parts are made with, and those of mechanisms that cannot be
    calculated on arrays stay open; so do those of which nobody knows what would be usual.
    """
    numbers = standing_numbers(config)
    tried = [each for each in results.summary.open if each.what in VALUES and each.why == UNPROVED]
    fixed = {path for path, each in numbers.items() if config.parts and config.parts.is_made_with(each.asked.node)}
    named = [each for each in tried if each.path in numbers.keys() - fixed]
    homes = {numbers[each.path].asked.instance for each in named}
    reached = {home: frozenset(downstream(config, home)) for home in homes}
    usual = UsualEnds(config)
    trials = [Trial.of(usual, each, numbers[each.path], reached) for each in named]
    machines = OpenValueTrials(config, usual.following([each for each in trials if not each.is_still]))
    changes = dict(machines.harmful()) if machines.trials else {}
    changes |= {each.item.path: STANDS_ALONE for each in trials if each.is_still}
    harmless = {each.item.path for each in trials if each.is_plain}
    harmless |= {each.item.path for each in machines.trials if each.item.path not in changes}
    harmless -= {each.item.path for each in trials if machines.left_out & each.reached}
    left = [each for each in results.summary.open if each.what not in VALUES or each.path not in harmless]
    untried = {each.path: OF_PARTS if each.path in fixed else NO_NUMBER for each in tried if each not in named}
    reasons = untried | changes
    return [each.with_(why=reasons.get(each.path, NO_ARRAYS)) if each in tried else each for each in left]


@dataclass(frozen=True, eq=False)
class Trial:
    """Hold an open value, its least and greatest usual one (SI), the mechanisms that follow from it, and whether its range is known.

    ``follows`` are exponents by the paths of other open values with whose powers its usual ones by a ``ratio`` grow, such as a strength with
    the tensile strength: it is tried at the ends that these leave it, but not beyond ``outermost``.
    """

    item: OpenRecord
    design: DesignInput
    low: float
    high: float
    reached: frozenset[str]
    has_range: bool = False
    follows: Mapping[str, float] = field(default_factory=dict)
    ratio: tuple[float, float] = (-np.inf, np.inf)
    outermost: tuple[float, float] = (-np.inf, np.inf)

    @staticmethod
    def of(usual: UsualEnds, item: OpenRecord, design: DesignInput, reached: Mapping[str, frozenset[str]]) -> Trial:
        """Return a trial of a value within what its declaration allows; of a whole number the whole numbers of its range."""
        home, present = design.asked.instance, design.present or 0.0
        known = usual.of(design)
        low, high = known or sorted((present * (1 - SHARE), present * (1 + SHARE)))
        ends = np.clip([low, high], *design.bounds)
        ends = np.array([_allowed(design, present, end) for end in ends])
        if design.is_whole:
            ends = np.array([np.ceil(low - STILL), np.floor(high + STILL)])
        if len(listed := design.listed):
            within = listed[(listed >= low) & (listed <= high)]
            ends = np.array([within.min(initial=present), within.max(initial=present)])
        return Trial(item, design, float(ends[0]), float(ends[1]), reached[home], known is not None)

    @property
    def present(self) -> float:
        """Return the value of the machine."""
        return self.design.present or 0.0

    @property
    def is_still(self) -> bool:
        """Return whether no other value is tried."""
        return self.low == self.present == self.high

    @property
    def is_plain(self) -> bool:
        """Return whether no other value is usual, or nobody has said what is not there, such as a bore, or there once, such as a key."""
        return self.is_still and (self.has_range or (self.item.what == "default" and self.present in (0, 1)))


def _allowed(design: DesignInput, present: float, end: float) -> float:
    """The value nearest to an end of what is usual that the declaration allows; what is allowed has no gaps."""
    if design.allows(np.array(end)):
        return end
    inside, outside = present, end
    for _ in range(HALVED):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if design.allows(np.array(middle)) else (inside, middle)
    return inside


@dataclass(frozen=True, eq=False)
class UsualEnds:
    """Tell between which ends a value of a machine is usual."""

    config: Config

    def of(self, design: DesignInput) -> tuple[float, float] | None:
        """Return the least and greatest value (SI) that all its rows call usual, else its first row; None where none is known."""
        known = [ends for row in self._rows(design) if (ends := self._of_ratio(design, row) if row.of else row.usual)]
        if not known:
            return None
        low, high = max(low for low, _ in known), min(high for _, high in known)
        return (low, high) if low <= high else known[0]

    def _rows(self, design: DesignInput) -> Sequence[UsualRange]:
        return ranges_of(self.config.kinds.get(design.asked.instance, PRESS)).get(design.key, ())

    def _of_ratio(
        self, design: DesignInput, row: UsualRange, other: DesignInput | None = None, times: float = 1.0
    ) -> tuple[float, float] | None:
        """What a ratio calls usual; with an ``other`` value so many times what it is."""
        home = design.asked.instance
        instance = self.config.instances[home]
        assert instance is not None, "a value of a broken plugin is not tried"
        inputs: Mapping[str, Any] = flatten(self.run.blocks[home])
        beside = self.run.beside(instance)
        if other is not None:
            value = times * (other.present or 0.0)
            if other.asked.instance == home:
                inputs = with_value(inputs, other.key, other.asked.key, value)
            else:
                beside = beside._replace(press={**beside.press, _named(other, home): value})
        return ends_by_ratio(instance, design.asked.key, row, inputs, beside, self.run.calculations[home].values)

    def following(self, trials: Sequence[Trial]) -> list[Trial]:
        """Return trials that know which others they follow, by the ratio that bounds them."""
        found = [self._following(each, trials) for each in trials]
        felt = {each.item.path: [other.reached for other in found if each.item.path in other.follows] for each in found}
        return [replace(each, reached=each.reached.union(*felt[each.item.path])) for each in found]

    def _following(self, trial: Trial, trials: Sequence[Trial]) -> Trial:
        others = {each.item.path: each.design for each in trials if each is not trial}
        for row in self._rows(trial.design):
            powers = {path: self._power(trial.design, row, other) for path, other in others.items()}
            follows = {path: power for path, power in powers.items() if power}
            if follows and (ends := self._of_ratio(trial.design, row)):
                return replace(trial, follows=follows, ratio=ends, outermost=self._outermost(trial.design))
        return trial

    def _outermost(self, design: DesignInput) -> tuple[float, float]:
        """Between which ends a value lies, whatever others are: what its declaration allows, and is usual without them."""
        ends = [design.bounds, *(row.usual for row in self._rows(design) if not row.of)]
        return max(low for low, _ in ends), min(high for _, high in ends)

    def _power(self, design: DesignInput, row: UsualRange, other: DesignInput) -> float:
        """The power of another value with which what a row calls usual grows; 0 where it does not, or otherwise."""
        if not other.present or f"${{{_named(other, design.asked.instance)}}}" not in row.of:
            return 0.0
        ends = [self._of_ratio(design, row, other, TWICE**k) for k in range(3)]
        grown = [max(map(abs, each)) for each in ends if each is not None]
        if len(grown) < 3 or min(grown) == 0:
            return 0.0
        once, twice = (float(np.log2(grown[k] / grown[0])) for k in (1, 2))
        return once if abs(twice - 2 * once) <= STILL else 0.0

    @cached_property
    def run(self) -> WarmRun:
        """The machine as it is: what a ratio is of may be a result."""
        return WarmPress(is_advised=False).calculate(self.config)


def _named(design: DesignInput, home: str) -> str:
    """How a row of a mechanism's kind names a value; empty for one of another mechanism."""
    return {home: design.key, PRESS: f"{PRESS}.{design.key}"}.get(design.asked.instance, "")


def apart(sets: Iterable[frozenset[str]]) -> list[list[int]]:
    """Return the numbers of sets in groups of which no two have an element in common."""
    groups: list[tuple[set[str], list[int]]] = []
    for number, own in sorted(enumerate(sets), key=lambda each: -len(each[1])):
        home = next((each for each in groups if not each[0] & own), None)
        if home is None:
            groups.append((set(own), [number]))
        else:
            home[0].update(own)
            home[1].append(number)
    return [members for _, members in groups]


K = TypeVar("K")


@dataclass
class TriedOpenValues:
    """Hold machines with other values: the status codes, margins and sizes of each check by name, and which machines cannot exist."""

    codes: dict[str, Array] = field(default_factory=dict)
    margins: dict[str, Array] = field(default_factory=dict)
    sizes: dict[str, Array] = field(default_factory=dict)
    impossible: set[int] = field(default_factory=set)

    def keep(self, made: CalculatedVariants, rows: Array, count: int) -> None:
        """Keep what came out of some of the machines; a value is tried for what it is, not for what it rests on."""
        for calc in made.calculations.values():
            calc.unfounded = {}
        found, own = verdicts(made.calculations, made.count), margins(made)
        judged = (each for each in zip(found.names, found.codes, strict=True) if not each[0].endswith(f".{USUAL}"))
        for name, codes in judged:  # what is tried is usual; that another value beside it is not is nobody's harm
            self.codes.setdefault(name, np.zeros(count, dtype=int))[rows] = codes
            for what, kept in ((MARGIN, self.margins), (SIZE, self.sizes)):
                if name + what in own:
                    kept.setdefault(name, np.full(count, np.nan))[rows] = own[name + what]
        self.impossible |= {int(rows[row]) for row in {**found.faults, **made.reasons}}


class Effects:
    """Hold of each check what it is today, and what each trial alone makes of it at both of its ends, shape (trials, 2).

    Of so many trials that change nothing of a machine, the first one of these.
    """

    def __init__(self, machine: TriedOpenValues, trials: int) -> None:
        self.today = {name: int(codes[0]) for name, codes in machine.codes.items()}
        self.margin = {name: float(own[0]) for name, own in machine.margins.items()}
        self.size = {name: float(own[0]) for name, own in machine.sizes.items()}
        self.codes = {name: np.full((trials, 2), code) for name, code in self.today.items()}
        self.margins = {name: np.full((trials, 2), own) for name, own in self.margin.items()}
        self.impossible = np.zeros((trials, 2), dtype=bool)

    def take(
        self, groups: Sequence[Sequence[int]], trials: Sequence[Trial], tried: TriedOpenValues, first: int
    ) -> None:
        """Take what each trial makes of the checks of the mechanisms that follow from it, from two machines a group, counted from the first."""
        homes = {name: name.partition(".")[0] for name in self.codes}
        for row, members in enumerate(groups):
            rows = slice(first + 2 * row, first + 2 * row + 2)
            for trial in members:
                self.impossible[trial] = [each in tried.impossible for each in range(rows.start, rows.stop)]
                for name in (each for each, home in homes.items() if home in trials[trial].reached):
                    self.codes[name][trial] = tried.codes[name][rows] if name in tried.codes else 0
                    if name in self.margins:
                        self.margins[name][trial] = tried.margins[name][rows] if name in tried.margins else np.nan

    def change(self, trial: int, values: Sequence[Phrase | str]) -> Phrase | None:
        """Return what changes with a trial at its ends, whose values are these; None where nothing does."""
        for end, value in enumerate(values):
            if self.impossible[trial, end]:
                return Phrase("with {value} the machine cannot exist", value=value)
            for name, codes in self.codes.items():
                if (after := int(codes[trial, end])) != (before := self.today[name]):
                    template = "with {value} the check {check} turns from {before} to {after}"
                    turns = {"before": _status(before), "after": _status(after)}
                    return Phrase(template, value=value, check=_check(name), **turns)
        return None

    def corner(self, name: str, trials: Sequence[Trial]) -> Corner:
        """Return the trials that bring a check nearer to its limit, at the worse end of each; none where it fails already or has no limit."""
        margin = self.margin.get(name, np.nan)
        if STATUS[self.today[name]] == "fail" or not np.isfinite(margin):
            return Corner(name, np.array([], dtype=int), np.array([]))
        ends = np.nan_to_num(self.margins[name] - margin, nan=0.0)
        harm, side = ends.min(axis=1), ends.argmin(axis=1)
        order = np.argsort(harm, kind="stable")[: int((harm < -STILL * self.size[name]).sum())]
        worse = [(each.low, each.high)[end] for each, end in zip(trials, side, strict=True)]
        return Corner(name, order, np.array(worse))


def _check(name: str) -> str:
    return name.replace(".checks.", ".", 1)


def _status(code: int) -> str:
    return phrase(STATUS[code] or "not checked")


@dataclass(frozen=True, eq=False)
class Corner:
    """Hold the values that bring a check nearer to its limit: which trials, the strongest first, and the worse end of every trial."""

    check: str
    order: Array
    worse: Array

    def without(self, trials: set[int]) -> Corner:
        """Return the corner with these trials at their present values."""
        return replace(self, order=self.order[~np.isin(self.order, list(trials))])

    def values(self, present: Array) -> Array:
        """Return the values of all trials there, shape (trials,)."""
        found = present.copy()
        found[self.order] = self.worse[self.order]
        return found


@dataclass
class OpenValueTrials:
    """Calculate a machine with other values of its open inputs; ``left_out`` are mechanisms whose plugin cannot take arrays."""

    config: Config
    trials: Sequence[Trial]
    left_out: set[str] = field(default_factory=set)

    def harmful(self) -> Iterator[tuple[str, Phrase]]:
        """Yield the paths of the values that are not harmless, each with what changes."""
        effects, harmful = self._alone(), set[int]()
        for index, trial in enumerate(self.trials):
            why = effects.change(index, self._told(index))
            if why is not None:
                harmful.add(index)
                yield trial.item.path, why
        together = self._together(effects, harmful)
        for index, name in (together | self._scattered(effects, {*harmful, *together})).items():
            template = "together with other assumed and default values it changes the check {check}"
            yield self.trials[index].item.path, Phrase(template, check=_check(name))

    def _told(self, index: int) -> list[Phrase | str]:
        """Both ends of a trial as people read them, with what cannot stay what it is there."""
        found, ends, design = list[Phrase | str](), self._ends([[index]]), self.trials[index].design
        for value, moved in zip(ends, self._followed(ends), strict=True):
            others = ", ".join(self.trials[int(i)].design.name for i in np.flatnonzero(moved != value))
            told = design.told(value[index])
            found.append(Phrase("{value} (and {others} with it)", value=told, others=others) if others else told)
        return found

    @property
    def present(self) -> Array:
        """Return the values of the machine, shape (trials,)."""
        return np.array([each.present for each in self.trials])

    def _alone(self) -> Effects:
        """The effects of each trial alone; those that no mechanism follows from in common are tried in one machine."""
        groups = apart([each.reached for each in self.trials])
        tried = self._tried(np.concatenate([self.present[None, :], self._ends(groups)]))
        effects = Effects(tried, len(self.trials))
        effects.take(groups, self.trials, tried, 1)
        # which of several makes a machine impossible shows alone
        unclear = [[int(index)] for index in np.flatnonzero(effects.impossible.any(axis=1))]
        if unclear:
            effects.take(unclear, self.trials, self._tried(self._ends(unclear)), 0)
        return effects

    def _ends(self, groups: Sequence[Sequence[int]]) -> Array:
        """Two machines for each group of trials, all of it at their low and at their high ends, shape (2 groups, trials)."""
        values = np.tile(self.present, (2 * len(groups), 1))
        for row, members in enumerate(groups):
            for index in members:
                values[2 * row : 2 * row + 2, index] = self.trials[index].low, self.trials[index].high
        return values

    def _together(self, effects: Effects, harmful: set[int]) -> dict[int, str]:
        """The values that change a check only together with others, with that check: the fewest that need be taken out, strongest first."""
        corners, found = [effects.corner(name, self.trials) for name in effects.codes], dict[int, str]()
        while True:
            asked = {each.check: each.without({*harmful, *found}) for each in corners}
            asked = {name: each for name, each in asked.items() if len(each.order) > 1}
            failing = [name for name, changes in self._changing(effects, asked).items() if changes]
            if not failing:
                return found
            pairs = [(name, k) for name in failing for k in LEFT_OUT if k < len(asked[name].order)]
            fewer = {(name, k): replace(asked[name], order=asked[name].order[k:]) for name, k in pairs}
            changing = self._changing(effects, fewer)
            for name in failing:
                enough = next((k for k in LEFT_OUT if changing.get((name, k)) is False), len(asked[name].order))
                found |= {int(index): name for index in asked[name].order[:enough] if index not in found}

    def _scattered(self, effects: Effects, out: set[int]) -> dict[int, str]:
        """The values with which a check fails when others stand at any of their ends, with that check: found in machines that are drawn.

        A size of a series, or the place that governs, may be another one within the corners.
        """
        found, draw, count = dict[int, str](), np.random.default_rng(SEED), DRAWN
        for _ in range(ROUNDS):
            drawn = self._drawn(draw, count, {*out, *found})
            failing = self._failing(effects, drawn)
            if not failing and count > DRAWN:
                break
            count = DRAWN if failing else CLEAN - DRAWN
            strongest = {self._strongest(effects, name, drawn[row]): name for name, row in failing}
            found |= {index: name for index, name in strongest.items() if index is not None}
        return found

    def _drawn(self, draw: np.random.Generator, count: int, out: set[int]) -> Array:
        """So many machines of which each value that is not out stands at one of its ends, shape (count, trials)."""
        ends = np.array([(each.low, each.high) for each in self.trials])
        drawn = np.take_along_axis(ends.T, draw.integers(0, 2, (count, len(ends))), axis=0)
        return np.where(np.isin(np.arange(len(ends)), list(out)), self.present, drawn)

    def _failing(self, effects: Effects, values: Array) -> list[tuple[str, int]]:
        """Checks that fail in some of the machines and do not today, each with one, or a few of them."""
        made = self._tried(values)
        rows = [row for row in range(len(values)) if row not in made.impossible]
        fails = {name: [row for row in rows if STATUS[codes[row]] == "fail"] for name, codes in made.codes.items()}
        new = ((name, own) for name, own in fails.items() if STATUS[effects.today.get(name, 0)] != "fail")
        return [(name, row) for name, own in new for row in own[:JUDGED]]

    def _strongest(self, effects: Effects, name: str, values: Array) -> int | None:
        """Of the values of a machine in which a check fails that which takes most of its margin alone; of those that take none, the first.

        None where the check feels none.
        """
        home = name.partition(".")[0]
        felt = [i for i, each in enumerate(self.trials) if home in each.reached and values[i] != each.present]
        if not felt or name not in effects.margins:
            return next(iter(felt), None)
        side = [int(values[i] == self.trials[i].high) for i in felt]
        return felt[int(np.argmin(np.nan_to_num(effects.margins[name][felt, side], nan=np.inf)))]

    def _changing(self, effects: Effects, corners: Mapping[K, Corner]) -> dict[K, bool]:
        """Whether the check of each corner changes its status there, or the machine cannot exist."""
        found: dict[K, bool] = {}
        for alone in (False, True):  # which of several corners makes their machine impossible shows alone
            left = {key: each for key, each in corners.items() if key not in found}
            if not left:
                break
            machines, rows = self._machines(list(left.values()), alone)
            made = self._tried(machines)
            for row, (key, each) in zip(rows, left.items(), strict=True):
                if row not in made.impossible:
                    codes = made.codes.get(each.check)
                    found[key] = codes is None or int(codes[row]) != effects.today[each.check]
                elif alone or rows.count(row) == 1:
                    found[key] = True
        return found

    def _machines(self, corners: Sequence[Corner], alone: bool) -> tuple[Array, list[int]]:
        """Machines, shape (machines, trials), with the one of each corner: corners share it where no check feels the values of another one."""
        machines, rows = list[Array](), list[int]()
        for corner in corners:
            felt = np.array([corner.check.partition(".")[0] in each.reached for each in self.trials])
            own = np.where(felt, corner.values(self.present), np.nan)
            fitting = (row for row, each in enumerate(machines) if not np.any(np.abs(own - each) > 0))
            row = len(machines) if alone else next(fitting, len(machines))
            if row == len(machines):
                machines.append(own)
            machines[row] = np.where(felt, own, machines[row])
            rows.append(row)
        return np.where(np.isnan(machines), self.present, machines), rows

    def _followed(self, values: Array) -> Array:
        """Values with those that follow others where these let them be, shape (machines, trials): ends move, others keep within them."""
        low, high = np.array([(each.low, each.high) for each in self.trials]).T
        outermost, ratio = np.array([(each.outermost, each.ratio) for each in self.trials]).transpose(1, 2, 0)
        found = values
        for _ in self.trials:  # what is followed may follow others
            with np.errstate(divide="ignore", invalid="ignore"):
                grown = np.exp(np.nan_to_num(np.log(found / self.present), nan=0.0, neginf=0.0) @ self._powers.T)
            least, most = (np.clip(ends * grown, *outermost) for ends in ratio)
            moved = np.select(
                [grown == 1, values == low, values == high], [values, least, most], np.clip(values, least, most)
            )
            if np.array_equal(moved, found):
                break
            found = moved
        return found

    @cached_property
    def _powers(self) -> Array:
        paths = [each.item.path for each in self.trials]
        return np.array([[each.follows.get(path, 0.0) for path in paths] for each in self.trials])

    def _tried(self, values: Array) -> TriedOpenValues:
        """Machines with these values, shape (machines, trials)."""
        values = self._followed(values)
        while True:
            made = TriedOpenValues()
            try:
                self._fill(made, values, np.arange(len(values)))
                return made
            except NotOnArrays as fault:
                names = {name for name, kind in self.config.kinds.items() if kind == fault.kind} - self.left_out
                if not names:
                    raise
                self.left_out |= names

    def _fill(self, made: TriedOpenValues, values: Array, rows: Array) -> None:
        given: dict[Input, Array] = {each.design.asked: values[rows, i] for i, each in enumerate(self.trials)}
        lost = {name: PluginError("", self.config.kinds[name], name) for name in self.left_out}
        try:
            found = calculated(replace(self.config, broken={**self.config.broken, **lost}), given, len(rows))
        except Mixed as mixed:
            for part in (mixed.rows, ~mixed.rows):
                self._fill(made, values, rows[part])
            return
        try:
            made.keep(found, rows, len(values))
        finally:
            found.release()
