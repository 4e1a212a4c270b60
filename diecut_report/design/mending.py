"""The smallest changes with which no check fails: sequential linear programming, every step calculated before it is taken.

The size of changes is the sum of their shares of today's values, a norm that prefers few changed inputs. Around the machine that is
reached, each check's slack is taken as a plane in the inputs; a linear programme (HiGHS) finds the least change that keeps all planes
above zero, within a region that is trusted; several regions and several parts of each step are then calculated in one run, and the
best machine is kept, whatever the planes said.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field

import numpy as np

from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.varied_machines import MARGIN, SIZE, VariedMachines
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase

REGIONS = (0.03, 0.1, 0.3)  # shares of today's values within which the planes are tried
PARTS = (0.25, 0.5, 0.75, 1.0)  # of a step
NUDGE = 0.004  # share of a value by which it is moved to see what follows
PENALTY = 50.0  # of a share by which a check is beyond its limit, beside a share of a value
ROOM = 0.002  # slack that a plane is to leave, so that its curvature does not break the check
STEPS, TRIES = 25, 3  # at most; and how often the regions shrink before it is given up
SMALLEST = 1e-3  # share of the size of all changes by which a step must make it less
FEASIBLE = 1e-2  # the same, where it is only asked whether some checks can hold together
UNFIT = 1e6  # of a machine that cannot be

Run = Callable[[Array], VariedMachines]
"""Of machines by the shares of their inputs that are changed, shape (machines, inputs)."""


Planes = tuple[list[str], Array, Array]
"""Checks, the slack of each, and its slope by each input, shape (checks, inputs)."""


@dataclass
class MendingPath:
    """Hold where the search is: the changes as shares of today's values, what that machine's checks say, and how far it went.

    ``among``: only these checks are to hold, whatever the others do; None for all.
    """

    run: Run
    inputs: Sequence[DesignInput]
    share: Array
    among: Collection[str] | None = None
    made: VariedMachines = field(init=False)
    sizes: dict[str, float] = field(init=False)
    merit: float = field(init=False)
    planes: Planes | None = None
    steps: int = 0

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

    def go(self, tell: Callable[[str], None], *, until_it_holds: bool = False) -> None:
        """Take steps as long as they make the machine better, or the changes smaller; or only until all holds."""
        scale, tries = 1.0, 0
        while self.steps < STEPS and tries < TRIES and not (until_it_holds and self.passes):
            before, had_passed = self.merit, self.passes
            tell(Phrase("mending: step {step}, failing checks: {n}", step=self.steps + 1, n=len(self.failing)))
            self._step(scale)
            self.steps += 1
            least = SMALLEST if self.among is None else FEASIBLE
            is_better = self.merit < before - least * max(before, 1e-9)
            tries = 0 if is_better else tries + 1
            scale = scale if is_better else scale / 5
            if had_passed and not is_better:
                break

    def _step(self, scale: float) -> None:
        self.planes = self._planes()
        steps = [self._wanted(region * scale) for region in REGIONS]
        tried = np.array(
            [self.share + part * (step - self.share) for step in steps if step is not None for part in PARTS]
        )
        if not len(tried):
            return
        made = self.run(tried)
        found = self.merits(made, tried)
        best = int(np.argmin(found))
        if found[best] < self.merit:
            self.share, self.merit = tried[best], float(found[best])
            self.made = self.run(self.share[None])

    def _wanted(self, region: float) -> Array | None:
        """The least change whose planes hold, within the region; what does not hold is to be as little as can be."""
        from scipy.optimize import linprog

        assert self.planes is not None
        names, slack, slope = self.planes
        count, checks = len(self.share), len(names)
        eye, low, high = np.eye(count), *_ends(self.inputs, self.share, region)
        # unknown: what is added to today's shares, what is taken from them, what each check lacks
        cost = np.concatenate([np.ones(2 * count), np.full(checks, PENALTY)])
        upper = np.hstack([-slope, slope, -np.eye(checks)])
        limit = slack - ROOM - slope @ self.share
        ends = np.vstack(
            [np.hstack([eye, -eye, np.zeros((count, checks))]), np.hstack([-eye, eye, np.zeros((count, checks))])]
        )
        found = linprog(cost, np.vstack([upper, ends]), np.concatenate([limit, high, -low]), method="highs")
        return None if found.x is None else found.x[:count] - found.x[count : 2 * count]

    def merits(self, made: VariedMachines, shares: Array) -> Array:
        """Return of each machine the size of its changes, with what its failing checks are beyond their limits; the least is the best."""
        beyond = np.zeros(made.count)
        for name in filter(self._is_asked, made.checks):
            slack = np.nan_to_num(self._slack(made, name))
            beyond += np.where(made.check(name) == "fail", np.maximum(-slack, 0.0) + ROOM, 0.0)
        return np.where(made.exists, PENALTY * beyond + np.abs(shares).sum(axis=1), UNFIT)

    def _slack(self, made: VariedMachines, name: str) -> Array:
        """How far a check is from its limit, in shares of a size that stays the same on the whole way."""
        margin = made.check(name, MARGIN).astype(float)
        size = self.sizes.get(name, np.nan)
        if not size > 0:  # it was not made at the start
            size = self.sizes[name] = float(np.nanmax(made.check(name, SIZE).astype(float), initial=1e-300))
        return margin / size

    def _planes(self) -> Planes:
        """Each check that can fail with its slack and its slope by the share of each input, from machines beside this one."""
        count = len(self.share)
        beside = np.concatenate([np.zeros((1, count)), NUDGE * np.eye(count), -NUDGE * np.eye(count)]) + self.share
        made = self.run(beside)
        names, slacks, slopes = [], [], []
        for name in filter(self._is_asked, made.checks):
            own = self._slack(made, name)
            if not np.isfinite(own[0]) or (made.check(name) == "warn").any():
                continue
            sides = np.array([own[1 : 1 + count] - own[0], own[0] - own[1 + count :]])
            known = np.isfinite(sides)
            names.append(name)
            slacks.append(own[0])
            slopes.append(np.where(known, sides, 0.0).sum(axis=0) / np.maximum(known.sum(axis=0), 1) / NUDGE)
        return names, np.array(slacks), np.reshape(slopes, (len(names), count))


def _ends(inputs: Sequence[DesignInput], share: Array, region: float) -> tuple[Array, Array]:
    """The least and the greatest share that each input may be changed by: within the region, and its own bounds."""
    today = np.array([each.today or 1.0 for each in inputs])
    bounds = np.array([each.bounds for each in inputs])
    ends = np.sort(bounds / today[:, None] - 1.0, axis=1)
    inner = 1e-6 * np.maximum(1.0, np.abs(share))  # bounds may be open
    low = np.maximum(share - region, ends[:, 0] + inner)
    high = np.minimum(share + region, ends[:, 1] - inner)
    return np.minimum(low, share), np.maximum(high, share)
