"""Lines: mechanisms that the main shaft drives at a fixed ratio, and the period that all of them have in common."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm, pi

from diecut_report.mechanics.timing.intervals import Intervals, merged, repeated

MAX_DENOMINATOR = 64
WHOLE = 1e-9  # by which a ratio may miss its fraction, relative

Rational = Fraction | float


def exact_turns(turns_per_sheet: Rational) -> Fraction:
    """Return turns of a line for each turn of the main shaft (a sheet) as a fraction with a denominator of at most 64.

    ValueError where there is no such fraction, or where it is not above zero.
    """
    found = Fraction(turns_per_sheet).limit_denominator(MAX_DENOMINATOR)
    if found <= 0 or abs(found - Fraction(turns_per_sheet)) > WHOLE * found:
        raise ValueError(
            f"{turns_per_sheet} is not a fraction above zero with a denominator of at most {MAX_DENOMINATOR}"
        )
    return found


def common_period(turns: Iterable[Fraction]) -> Fraction:
    """Return the turns of the main shaft after which all lines, given by their periods in turns, are where they were.

    The least common multiple of fractions: that of the numerators over the greatest common divisor of the denominators.
    """
    given = tuple(turns)
    return Fraction(lcm(*(t.numerator for t in given)), gcd(*(t.denominator for t in given)))


@dataclass(frozen=True)
class DrivenLine:
    """Hold how a mechanism is driven: turns of its own shaft for each of the main shaft, and the main-shaft angle of its zero (rad)."""

    turns: Fraction
    offset: float = 0.0

    def period_turns(self, every: int = 1) -> Fraction:
        """Return the turns of the main shaft for a turn of the line, or for ``every`` of its turns."""
        return every / self.turns

    def main_angle(self, own_angle: float) -> float:
        """Return the main-shaft angle at which the line is at an angle of its own shaft."""
        return self.offset + own_angle / float(self.turns)

    def on_main_shaft(self, intervals: Intervals, common: Fraction, every: int = 1) -> Intervals:
        """Return a phase in main-shaft angle over the common period (turns of the main shaft).

        ``intervals`` are angles of the line's own shaft (rad), over one own turn, or over ``every`` own turns. A phase over
        time is handed over with its time as the share of 2π of its cycle.
        """
        period = 2 * pi * float(common)
        main = tuple((self.main_angle(start), self.main_angle(end)) for start, end in intervals)
        own_period = 2 * pi * float(self.period_turns(every))
        return repeated(merged(main, own_period), own_period, period)
