"""What a study varies: lists, ranges and distributions, each with the path that it sets; SI floats, or texts.

A variable gives its values by number (``at``, for grids and zipped lists) or by share (``quantile``, for samples):
a share is a number above 0 and below 1, and the value is the one below which that share of all values lies.
Whole numbers (``integer=True``) are floats too; each takes the shares of a whole step, so that the first and the last
come as often as their neighbours. The keys of a study file have judged each number by itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Literal

import numpy as np

from diecut_report.formulas import Array
from diecut_report.text.phrases import MessageError

Values = Array | list[str]


class SampleError(MessageError, ValueError):
    """Report a variable or a sample that cannot be; `path` is the varied path that it is about, empty for the whole sample.

    The message names keys (from, to, count, low, mode, high, mean, sd) and no numbers, as these are SI here.
    """

    def __init__(self, template: str, path: str = "", /, **values: object) -> None:
        super().__init__(template, **values)
        self.path = path


@dataclass(frozen=True)
class ChoiceVariable:
    """Take a list of values; sampled, each is as probable as any other (write one twice to have it twice as often)."""

    path: str
    values: tuple[float, ...] | tuple[str, ...]

    def __post_init__(self) -> None:
        if not self.values:
            raise SampleError("the list is empty; give at least one value", self.path)
        if len({isinstance(value, str) for value in self.values}) > 1:
            raise SampleError("the list mixes numbers and texts; give one or the other", self.path)

    @property
    def count(self) -> int:
        return len(self.values)

    @cached_property
    def _array(self) -> Array:
        return np.array(self.values, dtype=object if isinstance(self.values[0], str) else float)

    def at(self, number: Array) -> Values:
        """Return the values with these numbers, counted from 0."""
        taken = self._array[number]
        return taken.tolist() if self._array.dtype == object else taken

    def quantile(self, share: Array) -> Values:
        return self.at(_cell(share, self.count))


@dataclass(frozen=True)
class RangeVariable:
    """Take values from `low` to `high`, both included; `high` may be the lower one, then they descend.

    In a grid `count` values with equal steps (equal ratios where `log`). Sampled, every value between, as probable as
    any other (with `log` every ratio); the count then plays no part.
    """

    path: str
    low: float
    high: float
    count: int | None = None
    log: bool = False
    integer: bool = False

    def __post_init__(self) -> None:
        if self.log and min(self.low, self.high) <= 0:
            raise SampleError("spacing: log needs from and to above zero", self.path)
        if self.count is None or self.low == self.high:
            return
        if self.count < 2:
            raise SampleError("count: 1 gives one value, but from and to differ", self.path)
        there = int(abs(self.high - self.low)) + 1
        if self.integer and self.count > there:
            template = "from … to holds {there} whole numbers, count: {count} is more"
            raise SampleError(template, self.path, there=there, count=self.count)
        if self.integer and self.log and (different := len(np.unique(self.at(np.arange(self.count))))) < self.count:
            template = (
                "count: {count} with spacing: log gives only {different} different whole numbers; write them as a list"
            )
            raise SampleError(template, self.path, count=self.count, different=different)

    def at(self, number: Array) -> Array:
        """Return the values with these numbers, counted from 0, of the `count` values."""
        steps = max((self.count or 1) - 1, 1)
        if self.integer and not self.log:
            doubled = 2 * number * round(self.high - self.low) + steps
            return np.asarray(self.low + doubled // (2 * steps), dtype=float)
        values = np.where(number == steps, self.high, self._between(number / steps))
        return np.floor(values + 0.5) if self.integer else values

    def quantile(self, share: Array) -> Array:
        if not self.integer:
            return self._between(share)
        lower, upper = min(self.low, self.high), max(self.low, self.high)
        turned = share if self.low <= self.high else 1 - share
        if not self.log:
            return lower + _cell(turned, int(upper - lower) + 1)
        ratio = (upper + 0.5) / (lower - 0.5)
        return np.clip(np.floor((lower - 0.5) * ratio**turned + 0.5), lower, upper)

    def _between(self, part: Array) -> Array:
        values = self.low * (self.high / self.low) ** part if self.log else self.low + (self.high - self.low) * part
        return np.clip(values, min(self.low, self.high), max(self.low, self.high))


@dataclass(frozen=True)
class Distribution:
    """Draw from a law between two limits: uniform, normal about the mean, or triangular with its mode.

    What a normal distribution has beyond a limit is cut off, and what remains counts as the whole.
    """

    path: str
    law: Literal["uniform", "normal", "triangular"]
    low: float = -math.inf
    high: float = math.inf
    middle: float = math.nan  # the mean, or the mode
    sd: float = math.nan
    integer: bool = False
    count: ClassVar[None] = None  # it has no list of values

    def __post_init__(self) -> None:
        if self.low >= self.high:
            raise SampleError("low must be below high", self.path)
        is_far = (self.low - self.middle) / self.sd >= 8 or (self.high - self.middle) / self.sd <= -8
        if self.law == "normal" and is_far:
            template = "the mean lies more than 8 standard deviations outside low … high; change one of them"
            raise SampleError(template, self.path)
        if self.law == "triangular" and not self.low <= self.middle <= self.high:
            raise SampleError("mode must lie between low and high", self.path)

    def quantile(self, share: Array) -> Array:
        # whole numbers are the rounded values of the distribution that reaches half a step beyond both limits
        beyond = 0.5 if self.integer else 0.0
        values = self._inverse(share, self.low - beyond, self.high + beyond)
        return np.clip(np.floor(values + 0.5) if self.integer else values, self.low, self.high)

    def _inverse(self, share: Array, low: float, high: float) -> Array:
        if self.law == "uniform":
            return low + (high - low) * share
        if math.isinf(low) and math.isinf(high):
            from scipy.special import ndtri

            return np.asarray(self.middle + self.sd * ndtri(share))
        from scipy.stats import triang, truncnorm

        if self.law == "triangular":
            return np.asarray(triang.ppf(share, (self.middle - low) / (high - low), loc=low, scale=high - low))
        limits = ((limit - self.middle) / self.sd for limit in (low, high))
        return np.asarray(truncnorm.ppf(share, *limits, loc=self.middle, scale=self.sd))


Variable = ChoiceVariable | RangeVariable | Distribution


def _cell(share: Array, count: int) -> Array:
    """Return the number, from 0, of the one of `count` equal cells of 0 … 1 in which each share lies."""
    return np.minimum((share * count).astype(np.int64), count - 1)
