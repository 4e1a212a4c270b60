"""Which checks conflict where no machine passes: a least set of them, found by leaving out, each step calculated.

A check that follows from none of the free inputs is told as proved, before anything is searched. Of others a search says that no
machine was found in which they hold together; that each of them left out lets the others hold is shown by a machine that was calculated.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.mending import MendingPath, Run
from diecut_report.design.varied_machines import VariedMachines, upstream
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase

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


@dataclass
class _ConflictSearch:
    """Looks for machines in which some checks hold, whatever the others do, from several beginnings."""

    run: Run
    inputs: Sequence[DesignInput]
    reached: Sequence[Array]
    scattered: Array
    tell: Callable[[str], None]
    left: int = MOST_SEARCHES
    made: VariedMachines | None = None
    seen: set[frozenset[str]] = field(default_factory=set)

    def failing_where_held(self, among: Collection[str]) -> list[str] | None:
        """Return the checks that fail in a machine in which these hold, as few as may be; None where none was found."""
        if known := [failing for failing in self.seen if failing.isdisjoint(among)]:
            return min((sorted(failing) for failing in known), key=lambda names: (len(names), names))
        self.tell(Phrase("looking for checks that conflict: {checks}", checks=", ".join(sorted(among))))
        self.left -= 1
        for share in self._beginnings(among):
            path = MendingPath(self._calculated, self.inputs, share, among)
            path.go(lambda _: None, until_it_holds=True)
            if path.passes:
                return path.made.failing(0)
        return None

    def _calculated(self, shares: Array) -> VariedMachines:
        """These machines; what fails in each of them is kept, as it may answer another question."""
        made = self.run(shares)
        fails = {name: made.check(name) == "fail" for name in made.checks}
        self.seen |= {frozenset(name for name in fails if fails[name][row]) for row in np.flatnonzero(made.exists)}
        return made

    def _beginnings(self, among: Collection[str]) -> Iterator[Array]:
        """What was reached before and today's machine; then the best of many that are scattered."""
        yield from self.reached
        if self.made is None:
            self.made = self._calculated(self.scattered)
        path = MendingPath(self._calculated, self.inputs, self.reached[0], among)
        yield self.scattered[int(np.argmin(path.merits(self.made, self.scattered)))]


def conflict_of(path: MendingPath, tell: Callable[[str], None]) -> CheckConflict:
    """Return why the search that this path has gone found no machine that passes."""
    failing = path.made.failing(0)
    if not len(path.inputs):  # choices alone, each of whose values was tried
        return CheckConflict(tuple(failing))
    search = _ConflictSearch(
        path.run, path.inputs, (path.share, np.zeros(len(path.inputs))), scattered(len(path.inputs)), tell
    )
    grown = _grown(search, failing)
    return CheckConflict(tuple(failing)) if grown is None else _least(search, grown)


def scattered(inputs: int) -> Array:
    """Return changes all over the place, the same at each call: shares of today's values, shape (machines, inputs)."""
    draws = np.random.default_rng(1)
    return draws.choice(WIDTHS, (SCATTERED, 1)) * draws.uniform(-1, 1, (SCATTERED, inputs))


def follows_from_none(config: Config, check: str, free: Collection[str]) -> bool:
    """Return whether the mechanism of a check follows from none of those whose inputs are free: all their values leave it as it is."""
    return upstream(config, [check.split(".")[0]]).isdisjoint(free)


def _grown(search: _ConflictSearch, failing: Iterable[str]) -> list[str] | None:
    """Checks of which no machine was found in which all hold: those that fail, and what fails where they hold; None where that was not ended."""
    among = dict.fromkeys(failing)
    while search.left > 0:
        more = search.failing_where_held(among)
        if more is None:
            return list(among)
        among |= dict.fromkeys(more)
    return None


def _least(search: _ConflictSearch, among: list[str]) -> CheckConflict:
    """The same checks without those that are not needed for it."""
    kept, shown = list(among), 0
    for name in among:
        if search.left <= 0:
            break
        others = [each for each in kept if each != name]
        if others and search.failing_where_held(others) is None:
            kept = others
        else:
            shown += 1
    return CheckConflict(tuple(sorted(kept)), is_least=shown == len(kept))
