"""Changes as a designer would type them: as few inputs as will do, as few digits as still pass."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.varied_machines import VariedMachines
from diecut_report.expressions import Array

NOTHING = 1e-6  # share of a value that is no change
DIGITS = (2, 3, 4, 5, 6)
DEARER, EACH = 1.05, 0.005  # what rounding may make of the size of all changes, and add for each of them
EXACT = 12

Run = Callable[[Array], VariedMachines]
Texts = tuple[str, ...]


def fewer(run: Run, share: Array) -> Array:
    """Return the changes without those that are not needed for a machine that passes, the smallest left out first."""
    share = np.where(np.abs(share) > NOTHING, share, 0.0)
    while True:
        changed = [int(each) for each in np.argsort(np.abs(share)) if share[each]]
        tried = np.array([np.where(np.arange(len(share)) == each, 0.0, share) for each in changed])
        good = passes(run(tried)) if len(changed) else np.zeros(0, dtype=bool)
        if not good.any():
            return share
        share = tried[int(np.argmax(good))]


def rounded(run: Run, inputs: Sequence[DesignInput], share: Array) -> tuple[Array, dict[int, str]]:
    """Return the changes with few digits that still pass, and how each input is typed, by its place.

    All are rounded alike first; then each for itself, as far as it goes.
    """
    changed = [int(each) for each in np.flatnonzero(share)]
    start = {each: _texts(inputs[each], share[each]) for each in changed}
    if not changed:
        return share, {}
    ways = range(len(next(iter(start.values()))))
    most = DEARER * float(np.abs(share).sum()) + EACH * len(changed)
    tried = [{each: start[each][way] for each in changed} for way in ways]
    good = _good(run, inputs, share, tried, most)
    if not good.any():
        return share, {each: inputs[each].typed(_value(inputs[each], share[each]), EXACT) for each in changed}
    typed = tried[int(np.argmax(good))]
    for each in changed:
        shorter = [typed | {each: text} for text in start[each] if len(text) < len(typed[each])]
        good = _good(run, inputs, share, shorter, most)
        typed = shorter[int(np.argmax(good))] if good.any() else typed
    return _shares(inputs, share, typed), typed


def passes(made: VariedMachines) -> Array:
    """Return which machines can be and have no check that fails."""
    return np.isin(made.status.astype(str), ["pass", "warn"])


def _good(run: Run, inputs: Sequence[DesignInput], share: Array, tried: Sequence[dict[int, str]], most: float) -> Array:
    """Which of these pass, with changes that are no greater than that."""
    if not tried:
        return np.zeros(0, dtype=bool)
    shares = np.array([_shares(inputs, share, typed) for typed in tried])
    return np.asarray(passes(run(shares)) & (np.abs(shares).sum(axis=1) <= most))


def _texts(design: DesignInput, share: float) -> Texts:
    """How a change may be typed, the shortest first: rounded to the nearest, beyond it, and before it."""
    value = _value(design, share)
    found = []
    for digits in DIGITS:
        further = share * (design.today or 1.0) > 0
        found += [
            design.typed(value, digits),
            design.typed_inwards(value, digits, up=further),
            design.typed_inwards(value, digits, up=not further),
        ]
    return tuple(found)


def _value(design: DesignInput, share: float) -> float:
    return (design.today or 0.0) * (1.0 + share)


def _shares(inputs: Sequence[DesignInput], share: Array, typed: dict[int, str]) -> Array:
    found = share.copy()
    for each, text in typed.items():
        try:
            found[each] = inputs[each].read(text) / (inputs[each].today or 1.0) - 1.0
        except ValueError:  # rounded beyond what its declaration allows: a machine that cannot be
            found[each] = np.nan
    return found
