"""Where the values of an input are looked for: the range, and the numbers in it at which machines are calculated first."""

from __future__ import annotations

import math

import numpy as np

from diecut_report.design.design_inputs import DesignInput
from diecut_report.errors import Problem, UserError
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase

POINTS = 33  # of the range, at which a machine is calculated before roots are searched between them
WIDER = 3.0  # the range reaches from today's value divided by this to so many times it
MOST_WHOLE = 400  # whole numbers that are all tried
SAME = 1e-12  # relative: what differs by less is the same


def searched_range(design: DesignInput, low: float | None, high: float | None) -> tuple[float, float]:
    """Return the range that is searched: given, or around today's value, as far as the input may go; of a list the whole of it.

    UserError where there is none.
    """
    least, most = design.bounds
    today = design.today
    if design.meta.listed:
        known = _listed(design)
        return float(known[0]) if low is None else low, float(known[-1]) if high is None else high
    if (low is None or high is None) and not today:
        words = "{input} has no value today; give the range to search with --from and --to."
        raise UserError(Problem(Phrase(words, input=design.name), path="--vary"))
    around = sorted((today / WIDER, today * WIDER)) if today else (math.nan, math.nan)
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
    today = design.today
    if today is not None and low < today < high:
        x = np.unique(np.append(x, today))
    return x[design.allows(x)] if design.allows(x).any() else x


def _listed(design: DesignInput) -> Array:
    """The numbers of its list (SI), ascending; today's as it is, to the last digit."""
    known = np.sort(np.array([value * design.meta.parsed_unit.factor for value in design.meta.listed]))
    return known if design.today is None else np.where(np.isclose(known, design.today, rtol=SAME), design.today, known)
