"""The advice of several failing checks put together, and the search from there to the smallest changes with which none fails."""

from __future__ import annotations

from collections.abc import Callable, Collection, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.inputs import DesignInput, given_numbers, in_series, is_form, typed_input, untied
from diecut_report.design.machines import MARGIN, SIZE, ChangedMachines, Chosen, VariedMachines, varied
from diecut_report.errors import PluginError, UserError
from diecut_report.formulas import Array
from diecut_report.quantities.formatting import with_unit
from diecut_report.results.mechanism_record import CheckRecord, KeyChangeRecord
from diecut_report.results.model import AdvisedChangeRecord, FollowedAdviceRecord, ResultsRecord
from diecut_report.study.definition.base_inputs import MECHANISMS, Input
from diecut_report.text.phrases import Phrase, phrase


@dataclass
class Advised:
    """Hold what the failing checks advise, by the paths of the inputs: numbers, and texts or yes/no.

    ``others`` are the numbers that they advise, in any of their ways.
    """

    numbers: dict[str, tuple[DesignInput, float]] = field(default_factory=dict)
    choices: dict[str, Chosen] = field(default_factory=dict)
    others: dict[str, DesignInput] = field(default_factory=dict)

    def leave_out(self, is_out: Callable[[Input], bool]) -> None:
        """Forget what is advised of such inputs."""
        self.numbers = {path: each for path, each in self.numbers.items() if not is_out(each[0].asked)}
        self.choices = {path: each for path, each in self.choices.items() if not is_out(each[0].asked)}
        self.others = {path: each for path, each in self.others.items() if not is_out(each.asked)}


def advised(config: Config, failing: Mapping[str, CheckRecord]) -> Advised:
    """Return what failing checks, by their names, advise by their first way that can be taken; of several bounds of one input the furthest.

    The numbers of their other ways are ``others``.
    """
    found = Advised()
    for name, check in failing.items():
        home, is_taken = name.split(".")[0], False
        for way in check.advice:
            known = Advised() if is_taken else found
            taken = [
                _take(config, known, f"{MECHANISMS}.{change.mechanism or home}.{change.key}", change) for change in way
            ]
            is_taken = is_taken or any(taken)
            found.others |= {path: design for path, (design, _) in known.numbers.items()}
    return found


def _take(config: Config, found: Advised, path: str, change: KeyChangeRecord) -> bool:
    """Note a change that can be made, of a number the value that is furthest from today's; return whether it can."""
    values = change.value if isinstance(change.value, list) else [change.value]
    try:
        design = typed_input(config, path)
        if design.asked.node in config.links:  # by default the press gives it, to all that follow from it
            return False
        if design.asked.unit is None:
            texts = [str(each).lower() if isinstance(each, bool) else str(each) for each in values]
            known = [text for text in texts if text in (design.options or texts)]
            if known:
                found.choices.setdefault(path, (design, known[0]))
            return bool(known)
        numbers = [design.read(with_unit(f"{each}", change.unit)) for each in values]
    except (UserError, ValueError):  # of another mechanism, calculated, or not a value of this key
        return False
    if not design.present:
        return False
    present = design.present
    value = min(numbers, key=lambda each: abs(each - present))
    other = found.numbers.get(design.asked.path, (design, present))[1]
    found.numbers[design.asked.path] = (design, max((value, other), key=lambda each: abs(each - present)))
    return True


# Whether a machine passes when the advice of all its failing checks is followed at once: for the first page of its report.


def followed(config: Config, results: ResultsRecord) -> FollowedAdviceRecord | None:
    """Return the changes that failing checks advise, and which checks fail in the machine with all of them; None where none is advised.

    ``error`` is why there is no such machine, None where there is one.
    """
    checks = ((f"{name}.{check.id}", check) for name, data in results.mechanisms.items() for check in data.checks)
    advice = advised(config, {name: check for name, check in checks if check.status == "fail"})
    if not advice.numbers and not advice.choices:
        return None
    given: dict[Input, Any] = {design.asked: np.array([value]) for design, value in advice.numbers.values()}
    try:
        made = varied(config, given | {design.asked: [text] for design, text in advice.choices.values()}, 1)
    except PluginError:  # told where the report is made; it says nothing of the advice
        return None
    told = [(design.name, design.told(value)) for design, value in advice.numbers.values()]
    told += [(design.name, text) for design, text in advice.choices.values()]
    changes = [AdvisedChangeRecord(path=name, value=text) for name, text in told]
    return FollowedAdviceRecord(changes=changes, failing=made.failing(0), error=made.errors[0])


# The smallest changes with which no check fails: sequential linear programming, every step calculated before it is taken.
#
# The size of changes is the sum of their shares of today's values, a norm that prefers few changed inputs. Around the machine that is
# reached, each check's slack is taken as a plane in the inputs; a linear programme (HiGHS) finds the least change that keeps all planes
# above zero, within a region that is trusted; several regions and several parts of each step are then calculated in one run, and the
# best machine is kept, whatever the planes said.


REGIONS = (0.03, 0.1, 0.3)  # shares of today's values within which the planes are tried
PARTS = (0.25, 0.5, 0.75, 1.0)  # of a step
NUDGE = 0.004  # share of a value by which it is moved to see what follows
PENALTY = 50.0  # of a share by which a check is beyond its limit, beside a share of a value
ROOM = 0.002  # slack that a plane is to leave, so that its curvature does not break the check
STEPS, TRIES = 25, 3  # at most; and how often the regions shrink before it is given up
SMALLEST = 1e-3  # share of the size of all changes by which a step must make it less
FEASIBLE = 1e-2  # the same, where it is only asked whether some checks can hold together
UNFIT = 1e6  # of a machine that cannot be
FIRST = 3  # failing checks that are named while the search goes on


@dataclass
class MendingPath:
    """Hold where the search is: the changes as shares of today's values, and what that machine's checks say.

    ``among``: only these checks are to hold, whatever the others do; None for all.
    """

    run: ChangedMachines
    share: Array
    among: Collection[str] | None = None
    made: VariedMachines = field(init=False)
    sizes: dict[str, float] = field(init=False)
    merit: float = field(init=False)

    def __post_init__(self) -> None:
        self.made = self.run(self.share[None])
        self.sizes = {name: float(self.made.check(name, SIZE)[0]) for name in self.made.checks}
        self.merit = float(self.merits(self.made, self.share[None])[0])

    @property
    def passes(self) -> bool:
        return bool(self.made.exists[0]) and not self.failing

    @property
    def failing(self) -> list[str]:
        """Return the checks that are to hold and fail."""
        return [name for name in self.made.failing(0) if self._is_asked(name)]

    def _is_asked(self, name: str) -> bool:
        return self.among is None or name in self.among

    def go(self, *, until_it_holds: bool = False) -> None:
        """Take steps as long as they make the machine better, or the changes smaller; or only until all holds."""
        scale, tries = 1.0, 0
        for step in range(1, STEPS + 1):
            if tries == TRIES or (until_it_holds and self.passes):
                break
            before, had_passed = self.merit, self.passes
            template = "correcting: step {step}, {machines} machines calculated; the best of them fails: {checks}"
            first = ", ".join(self.failing[:FIRST]) + (" …" if len(self.failing) > FIRST else "")
            self.run.tell(Phrase(template, step=step, machines=self.run.spent.count, checks=first or phrase("none")))
            self._step(scale)
            least = SMALLEST if self.among is None else FEASIBLE
            is_better = self.merit < before - least * max(before, 1e-9)
            tries = 0 if is_better else tries + 1
            scale = scale if is_better else scale / 5
            if had_passed and not is_better:
                break

    def _step(self, scale: float) -> None:
        slack, slope = self._planes()
        wanted = [self._wanted(slack, slope, region * scale) for region in REGIONS]
        tried = np.array(
            [self.share + part * (end - self.share) for end in wanted if end is not None for part in PARTS]
        )
        if not len(tried):
            return
        found = self.merits(self.run(tried), tried)
        best = int(np.argmin(found))
        if found[best] < self.merit:
            self.share, self.merit = tried[best], float(found[best])
            self.made = self.run(self.share[None])

    def _wanted(self, slack: Array, slope: Array, region: float) -> Array | None:
        """The least change whose planes hold, within the region; what does not hold is to be as little as can be."""
        from scipy.optimize import linprog

        count, checks = len(self.share), len(slack)
        eye, none, low, high = np.eye(count), np.zeros((count, checks)), *self._ends(region)
        # unknown: what is added to today's shares, what is taken from them, what each check lacks
        cost = np.concatenate([np.ones(2 * count), np.full(checks, PENALTY)])
        upper = np.vstack(
            [np.hstack([-slope, slope, -np.eye(checks)]), np.hstack([eye, -eye, none]), np.hstack([-eye, eye, none])]
        )
        limit = slack - ROOM - slope @ self.share
        found = linprog(cost, upper, np.concatenate([limit, high, -low]), method="highs")
        return None if found.x is None else found.x[:count] - found.x[count : 2 * count]

    def _ends(self, region: float) -> tuple[Array, Array]:
        """The least and the greatest share that each input may be changed by: within the region, and its own bounds."""
        share = self.share
        present = np.array([each.present or 1.0 for each in self.run.inputs])
        bounds = np.array([each.bounds for each in self.run.inputs])
        ends = np.sort(bounds / present[:, None] - 1.0, axis=1)
        inner = 1e-6 * np.maximum(1.0, np.abs(share))  # bounds may be open
        low = np.maximum(share - region, ends[:, 0] + inner)
        high = np.minimum(share + region, ends[:, 1] - inner)
        return np.minimum(low, share), np.maximum(high, share)

    def merits(self, made: VariedMachines, shares: Array) -> Array:
        """Return of each machine the size of its changes, with what its failing checks are beyond their limits; the least is the best."""
        beyond = np.zeros(made.count)
        for name in filter(self._is_asked, made.checks):
            slack = np.nan_to_num(self._slack(made, name))
            beyond += np.where(made.check(name) == "fail", np.maximum(-slack, 0.0) + ROOM, 0.0)
        return np.where(made.exists, PENALTY * beyond + np.abs(shares).sum(axis=1), UNFIT)

    def _slack(self, made: VariedMachines, name: str) -> Array:
        """How far a check is from its limit, in shares of a size that stays the same on the whole way."""
        if not self.sizes.get(name, np.nan) > 0:  # it was not made at the start
            self.sizes[name] = float(np.nanmax(made.check(name, SIZE).astype(float), initial=0.0))
        return made.check(name, MARGIN).astype(float) / (self.sizes[name] or 1.0)

    def _planes(self) -> tuple[Array, Array]:
        """Of each check that can fail its slack, and its slope by the share of each input (checks, inputs), from machines beside this one."""
        count = len(self.share)
        beside = np.concatenate([np.zeros((1, count)), NUDGE * np.eye(count), -NUDGE * np.eye(count)]) + self.share
        made = self.run(beside)
        slacks, slopes = [], []
        for name in filter(self._is_asked, made.checks):
            own = self._slack(made, name)
            if not np.isfinite(own[0]) or (made.check(name) == "warn").any():
                continue
            sides = np.array([own[1 : 1 + count] - own[0], own[0] - own[1 + count :]])
            known = np.isfinite(sides)
            slacks.append(own[0])
            slopes.append(np.where(known, sides, 0.0).sum(axis=0) / np.maximum(known.sum(axis=0), 1) / NUDGE)
        return np.array(slacks), np.reshape(slopes, (len(slacks), count))


# Which checks conflict where no machine passes: a least set of them, found by leaving out, each step calculated.
#
# A check that follows from none of the free inputs is told as proved, before anything is searched. Of others a search says that no
# machine was found in which they hold together; that each of them left out lets the others hold is shown by a machine that was calculated.


MOST_SEARCHES = 40  # of machines in which some checks hold, before it is left as it is
SCATTERED = 200  # machines
WIDTHS = (0.03, 0.1, 0.3, 0.9)  # shares of today's values by which their inputs are changed at most


@dataclass(frozen=True)
class CheckConflict:
    """Hold checks that do not hold together with any values that were tried of the free inputs.

    ``is_proved``: each of them fails, and follows from none of the free inputs. ``is_least``: with any one of them left out the others
    hold in a machine that was calculated.
    """

    checks: tuple[str, ...]
    is_proved: bool = False
    is_least: bool = False


@dataclass(frozen=True)
class _WatchedMachines(ChangedMachines):
    """Calculates machines, and keeps what fails in each of them: it may answer another question."""

    seen: set[frozenset[str]] = field(default_factory=set)

    def __call__(self, shares: Array) -> VariedMachines:
        made = super().__call__(shares)
        self.seen.update(frozenset(made.failing(int(row))) for row in np.flatnonzero(made.exists))
        return made


@dataclass
class _ConflictSearch:
    """Looks for machines in which some checks hold, whatever the others do, from several beginnings."""

    path: MendingPath
    left: int = MOST_SEARCHES
    made: VariedMachines | None = None

    def __post_init__(self) -> None:
        run = self.path.run
        self.run = _WatchedMachines(run.config, run.inputs, run.choices, run.spent)
        self.scattered = scattered(len(run.inputs))

    def failing_where_held(self, among: Collection[str]) -> list[str] | None:
        """Return the checks that fail in a machine in which these hold, as few as may be; None where none was found."""
        if known := [failing for failing in self.run.seen if failing.isdisjoint(among)]:
            return min((sorted(failing) for failing in known), key=lambda names: (len(names), names))
        self.path.run.tell(Phrase("looking for checks that conflict: {checks}", checks=", ".join(sorted(among))))
        self.left -= 1
        for share in self._beginnings(among):
            path = MendingPath(self.run, share, among)
            path.go(until_it_holds=True)
            if path.passes:
                return path.made.failing(0)
        return None

    def _beginnings(self, among: Collection[str]) -> Iterator[Array]:
        """What was reached before and today's machine; then the best of many that are scattered."""
        yield from (self.path.share, self.run.present)
        if self.made is None:
            self.made = self.run(self.scattered)
        path = MendingPath(self.run, self.path.share, among)
        yield self.scattered[int(np.argmin(path.merits(self.made, self.scattered)))]

    def grown(self, failing: Sequence[str]) -> list[str]:
        """Return checks that that hold together in no machine found: those that fail, and what fails where they hold; none if that was not ended."""
        among = dict.fromkeys(failing)
        while self.left > 0:
            more = self.failing_where_held(among)
            if more is None:
                return list(among)
            among |= dict.fromkeys(more)
        return []

    def least(self, among: Sequence[str]) -> CheckConflict:
        """Return the same checks without those that are not needed for it."""
        kept, shown = list(among), 0
        for name in among:
            if self.left <= 0:
                break
            others = [each for each in kept if each != name]
            if others and self.failing_where_held(others) is None:
                kept = others
            else:
                shown += 1
        return CheckConflict(tuple(sorted(kept)), is_least=shown == len(kept))


def conflict_of(path: MendingPath) -> CheckConflict:
    """Return why the search that this path has gone found no machine that passes."""
    failing = path.made.failing(0)
    if not path.run.inputs:  # choices alone, each of whose values was tried
        return CheckConflict(tuple(failing))
    search = _ConflictSearch(path)
    grown = search.grown(failing)
    return search.least(grown) if grown else CheckConflict(tuple(failing))


def scattered(inputs: int) -> Array:
    """Return changes all over the place, the same at each call: shares of today's values, shape (machines, inputs)."""
    draws = np.random.default_rng(1)
    return draws.choice(WIDTHS, (SCATTERED, 1)) * draws.uniform(-1, 1, (SCATTERED, inputs))


# Inputs that take one of some values (texts, yes/no, whole numbers, numbers of a list), tried where a change of sizes alone mends nothing.
#
# One after the other is given each of its values, with the sizes as they were reached and as they are today; the best is kept, and from
# it the sizes are changed again. Several rounds change several of them.


ROUNDS, BEGINNINGS = 3, 3  # choices that are changed at most; machines of a round from which sizes are changed again
WHOLE_REACH = 10  # to each side of a whole number
BETTER = 1e-9

Choices = dict[str, tuple[DesignInput, dict[str, float]]]
"""By their paths inputs that take one of some values, as they are typed, the nearest to today's first; what each costs, 0 for a text."""


def changeable_choices(config: Config, free: Sequence[DesignInput], keep: Container[str]) -> Choices:
    """Return what of the ``free`` ones takes one of some values, else the sizes that are numbers of a list; not those paths."""
    form = [each for each in untied(config, given_numbers(config)) if is_form(config, each)]
    named = [each for each in (in_series(config, each) for each in free or form) if free or len(each.listed)]
    return {each.asked.path: (each, own) for each in named if each.asked.path not in keep and (own := _values(each))}


def with_choices(path: MendingPath, choices: Choices) -> MendingPath:
    """Return the best path that was found by changing choices; the same where none is better."""
    for _ in range(ROUNDS):
        found = sorted(_changed(path, choices), key=lambda each: each[0])
        best = path
        for _, other in found[:BEGINNINGS]:
            if not other.passes and other.run.inputs:
                other.go()
            best = other if other.passes or other.merit < best.merit - BETTER else best
            if best.passes:
                return best
        if best is path:
            break
        path = best
    return path


def _changed(path: MendingPath, choices: Choices) -> Iterator[tuple[float, MendingPath]]:
    """Each value of each choice, with the sizes that were reached and with today's, and how bad each of them is."""
    run = path.run
    places = {tuple(share): share for share in (path.share, run.present)}.values()
    for name, (design, values) in choices.items():
        run.tell(Phrase("trying the values of {input}", input=name))
        for text, cost in values.items():
            chosen = replace(run, choices={**run.choices, name: (design, text)})
            for share in places:
                other = MendingPath(chosen, share)
                yield other.merit + cost, other


def _values(design: DesignInput) -> dict[str, float]:
    """The other values that an input may have, each with its cost; none of what may be any of a range."""
    if design.asked.unit is None:
        return {text: 0.0 for text in design.options if text != design.written}
    present = design.present
    if not present or not design.is_stepped:
        return {}
    around = np.arange(round(present) - WHOLE_REACH, round(present) + WHOLE_REACH + 1, dtype=float)
    steps = design.listed if len(design.listed) else around[design.allows(around)]
    others = sorted((each for each in steps.tolist() if each != present), key=lambda each: abs(each - present))
    return {design.typed(each): abs(design.share(each)) for each in others}
