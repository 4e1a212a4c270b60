"""What a study varies: lists, ranges and distributions, each with the path that it sets; SI floats, or texts.

A variable gives its values by number (``at``, for grids and zipped lists) or by share (``quantile``, for samples):
a share is a number above 0 and below 1, and the value is the one below which that share of all values lies.
Whole numbers (``integer=True``) are floats too; each takes the shares of a whole step, so that the first and the last
come as often as their neighbours.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from diecut_report.formulas import Array
from diecut_report.text.phrases import Phrase, phrase

Values = Array | list[str]


class SampleError(ValueError):
    """Report a variable or a sample that cannot be; `path` is the varied path that it is about, empty for the whole sample.

    The words name keys (from, to, count, low, mode, high, mean, sd) and no numbers, as these are SI here.
    """

    def __init__(self, message: str, path: str = "") -> None:
        super().__init__(message)
        self.message, self.path = message, path


@dataclass(frozen=True)
class _Variable:
    path: str

    def _demand(self, holds: bool, message: str) -> None:
        if not holds:
            raise SampleError(message, self.path)

    def _finite(self, **numbers: float | None) -> None:
        for name, number in numbers.items():
            self._demand(number is None or math.isfinite(number), Phrase("{name} must be a finite number", name=name))


@dataclass(frozen=True)
class ChoiceVariable(_Variable):
    """Take a list of values; sampled, each is as probable as any other (write one twice to have it twice as often)."""

    values: tuple[float, ...] | tuple[str, ...]

    def __post_init__(self) -> None:
        self._demand(len(self.values) > 0, phrase("the list is empty; give at least one value"))
        texts = {isinstance(value, str) for value in self.values}
        self._demand(len(texts) == 1, phrase("the list mixes numbers and texts; give one or the other"))
        finite = texts == {True} or bool(np.isfinite(np.asarray(self.values, dtype=float)).all())
        self._demand(finite, phrase("the list holds a value that is not a finite number"))

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
class RangeVariable(_Variable):
    """Take values from `low` to `high`, both included; `high` may be the lower one, then they descend.

    In a grid `count` values with equal steps (equal ratios where `log`). Sampled, every value between, as probable as
    any other (with `log` every ratio); the count then plays no part.
    """

    low: float
    high: float
    count: int | None = None
    log: bool = False
    integer: bool = False

    def __post_init__(self) -> None:
        self._finite(**{"from": self.low, "to": self.high})
        self._demand(not self.log or min(self.low, self.high) > 0, phrase("spacing: log needs from and to above zero"))
        if self.integer:
            _whole(self, **{"from": self.low, "to": self.high})
        if self.count is not None:
            self._judge_count(self.count)

    def _judge_count(self, count: int) -> None:
        self._demand(count >= 1, phrase("count must be 1 or more"))
        self._demand(count > 1 or self.low == self.high, phrase("count: 1 gives one value, but from and to differ"))
        if self.integer and self.low != self.high:
            self._judge_whole(count, int(abs(self.high - self.low)) + 1)

    def _judge_whole(self, count: int, there: int) -> None:
        self._demand(
            count <= there,
            Phrase("from … to holds {there} whole numbers, count: {count} is more", there=there, count=count),
        )
        if self.log:
            different = len(np.unique(self.at(np.arange(count))))
            words = Phrase(
                "count: {count} with spacing: log gives only {different} different whole numbers; write them as a list",
                count=count,
                different=different,
            )
            self._demand(different == count, words)

    def at(self, number: Array) -> Array:
        """Return the values with these numbers, counted from 0, of the `count` values."""
        if self.count is None:
            raise SampleError(
                phrase("count is missing; a grid or zip needs to know how many values the range has"), self.path
            )
        steps = max(self.count - 1, 1)
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
class _Distribution(_Variable):
    @property
    def count(self) -> None:
        """A distribution has no list of values; None says that a grid or zip cannot use it."""
        return None

    def _spread(self, inverse: Callable[[float], Array], low: float, high: float, integer: bool) -> Array:
        # Whole numbers are the rounded values of the distribution that reaches half a step beyond both limits.
        values = inverse(0.5 if integer else 0.0)
        return np.clip(np.floor(values + 0.5) if integer else values, low, high)


@dataclass(frozen=True)
class Uniform(_Distribution):
    """Draw from the limits' range: every value in it is as probable as any other."""

    low: float
    high: float
    integer: bool = False

    def __post_init__(self) -> None:
        self._finite(low=self.low, high=self.high)
        self._demand(self.low < self.high, phrase("low must be below high"))
        if self.integer:
            _whole(self, low=self.low, high=self.high)

    def quantile(self, share: Array) -> Array:
        if self.integer:
            return self.low + _cell(share, int(self.high - self.low) + 1)
        return np.clip(self.low + (self.high - self.low) * share, self.low, self.high)


@dataclass(frozen=True)
class Normal(_Distribution):
    """Draw from a normal distribution about the mean; with a limit the part beyond it is cut off, and what remains counts as the whole."""

    mean: float
    sd: float
    low: float | None = None
    high: float | None = None
    integer: bool = False

    def __post_init__(self) -> None:
        self._finite(mean=self.mean, sd=self.sd, low=self.low, high=self.high)
        self._demand(self.sd > 0, phrase("sd (standard deviation) must be above zero"))
        low, high = self._limits()
        self._demand(low < high, phrase("low must be below high"))
        near = (low - self.mean) / self.sd < 8 and (high - self.mean) / self.sd > -8
        self._demand(
            near, phrase("the mean lies more than 8 standard deviations outside low … high; change one of them")
        )
        if self.integer:
            _whole(self, low=self.low, high=self.high)

    def _limits(self) -> tuple[float, float]:
        return -math.inf if self.low is None else self.low, math.inf if self.high is None else self.high

    def quantile(self, share: Array) -> Array:
        low, high = self._limits()

        def inverse(beyond: float) -> Array:
            if low == -math.inf and high == math.inf:
                from scipy.special import ndtri

                return np.asarray(self.mean + self.sd * ndtri(share))
            from scipy.stats import truncnorm

            limits = ((limit - self.mean) / self.sd for limit in (low - beyond, high + beyond))
            return np.asarray(truncnorm.ppf(share, *limits, loc=self.mean, scale=self.sd))

        return self._spread(inverse, low, high, self.integer)


@dataclass(frozen=True)
class Triangular(_Distribution):
    """Draw most probably at the mode, less in equal steps towards both limits, where it ends."""

    low: float
    mode: float
    high: float
    integer: bool = False

    def __post_init__(self) -> None:
        self._finite(low=self.low, mode=self.mode, high=self.high)
        self._demand(self.low < self.high, phrase("low must be below high"))
        self._demand(self.low <= self.mode <= self.high, phrase("mode must lie between low and high"))
        if self.integer:
            _whole(self, low=self.low, high=self.high)

    def quantile(self, share: Array) -> Array:
        from scipy.stats import triang

        def inverse(beyond: float) -> Array:
            low, high = self.low - beyond, self.high + beyond
            return np.asarray(triang.ppf(share, (self.mode - low) / (high - low), loc=low, scale=high - low))

        return self._spread(inverse, self.low, self.high, self.integer)


Variable = ChoiceVariable | RangeVariable | Uniform | Normal | Triangular


def _cell(share: Array, count: int) -> Array:
    """The number, from 0, of the one of `count` equal cells of 0 … 1 in which each share lies."""
    return np.minimum((share * count).astype(np.int64), count - 1)


def _whole(variable: Variable, **limits: float | None) -> None:
    for name, limit in limits.items():
        if limit is not None and limit != math.floor(limit):
            raise SampleError(
                Phrase("{name} must be a whole number, as {path} is one", name=name, path=variable.path), variable.path
            )
