"""What a study varies (lists, ranges, distributions), and its variants: grids, zipped lists, tables, points drawn by `scipy.stats.qmc`.

A variable gives its values by number (``at``, for grids and zipped lists) or by share (``quantile``, for samples): SI floats, or texts.
A share is a number above 0 and below 1, and the value is the one below which that share of all values lies.
Whole numbers (``integer=True``) are floats too; each takes the shares of a whole step, so that the first and the last
come as often as their neighbours. The keys of a study file have judged each number by itself.

A sample holds no rows: it makes those that are asked for, numbered from 0, the same however the asking is cut into chunks and in
whichever process. Equal seeds give equal rows. Only a Latin hypercube is held whole, once in each process.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar, Literal

import numpy as np

from diecut_report.formulas import Array
from diecut_report.text.phrases import MessageError, Phrase, joined

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


SOBOL_BITS = 30
SOBOL_POINTS = 2**SOBOL_BITS
SOBOL_DIMENSIONS = 21201  # of scipy's table of direction numbers
NOTED_SIZE = 500 * 2**20  # bytes of a Latin hypercube from which on its note says how much memory it takes


class Sample(ABC):
    """Give the variants of a study before constraints, numbered from 0."""

    @property
    @abstractmethod
    def count(self) -> int:
        """Return the number of rows."""

    @property
    def note(self) -> str | None:
        """Return what a user should know about this sample before it runs, in a sentence or two."""
        return None

    @abstractmethod
    def rows(self, start: int, stop: int) -> dict[str, Values]:
        """Return the rows start … stop − 1: an array of SI floats, or a list of texts, for each path."""


@dataclass(frozen=True)
class TableSample(Sample):
    """Hold rows that are given: a column of SI floats, or of texts, for each path."""

    columns: Mapping[str, Values]

    @property
    def count(self) -> int:
        return len(next(iter(self.columns.values())))

    def rows(self, start: int, stop: int) -> dict[str, Values]:
        return {path: column[start:stop] for path, column in self.columns.items()}


@dataclass(frozen=True)
class _Varied(Sample):
    variables: tuple[Variable, ...]


# --- lists and ranges ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Grid(_Varied):
    """Combine every value of each variable with every value of the others; the first variable changes most slowly."""

    method = "grid"

    def __post_init__(self) -> None:
        for variable in self.variables:
            if isinstance(variable, Distribution):
                template = "a distribution has no list of values for sample: {method}; give a list or a range, or sample: latin_hypercube or sobol"
                raise SampleError(template, variable.path, method=self.method)
            if variable.count is None:
                raise SampleError("count is missing; sample: {method} needs it", variable.path, method=self.method)

    @cached_property
    def counts(self) -> tuple[int, ...]:
        return tuple(variable.count or 0 for variable in self.variables)

    @property
    def count(self) -> int:
        return math.prod(self.counts)

    def rows(self, start: int, stop: int) -> dict[str, Values]:
        numbers = self._numbers(np.arange(start, stop, dtype=np.int64))
        listed = (variable for variable in self.variables if not isinstance(variable, Distribution))
        return {variable.path: variable.at(number) for variable, number in zip(listed, numbers, strict=True)}

    def _numbers(self, row: Array) -> list[Array]:
        numbers = []
        for count in reversed(self.counts):
            row, number = np.divmod(row, count)
            numbers.append(number)
        return numbers[::-1]


@dataclass(frozen=True)
class Zip(Grid):
    """Take the first values together, the second values together, and so on."""

    method = "zip"

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(set(self.counts)) > 1:
            template = "{path} has {count}"
            lengths = joined((Phrase(template, path=each.path, count=each.count) for each in self.variables), ", ")
            template = "sample: zip needs as many values of each path: {lengths}. Fill up, or use sample: grid"
            raise SampleError(template, lengths=lengths)

    @property
    def count(self) -> int:
        return self.counts[0]

    def _numbers(self, row: Array) -> list[Array]:
        return [row] * len(self.counts)


# --- points that are drawn -------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class LatinHypercube(_Varied):
    """Draw rows where each variable's probability is cut into as many equal parts as there are rows; each part is taken once."""

    points: int
    seed: int = 0

    @property
    def count(self) -> int:
        return self.points

    @property
    def note(self) -> str | None:
        size = 8 * self.points * len(self.variables)
        if size < NOTED_SIZE:
            return None
        template = "The Latin hypercube holds {held} MB in each process; method: sobol holds nothing."
        return Phrase(template, held=f"{size / 2**20:.0f}")

    def rows(self, start: int, stop: int) -> dict[str, Values]:
        shares = _hypercube(self.points, len(self.variables), self.seed)[:, start:stop]
        return {variable.path: variable.quantile(share) for variable, share in zip(self.variables, shares, strict=True)}


@lru_cache(maxsize=1)
def _hypercube(count: int, dimensions: int, seed: int) -> Array:
    # One dimension at a time: the columns are independent permutations anyway, and scipy needs four times the memory.
    from scipy.stats import qmc

    shares = np.empty((dimensions, count))
    for share, stream in zip(shares, np.random.SeedSequence(seed).spawn(dimensions), strict=True):
        share[:] = qmc.LatinHypercube(1, rng=np.random.default_rng(stream)).random(count)[:, 0]
    np.minimum(shares, np.nextafter(1.0, 0.0), out=shares)
    shares.flags.writeable = False
    return shares


@dataclass(frozen=True)
class Sobol(_Varied):
    """Draw scrambled Sobol points: they fill the space of all variables evenly, also with few rows.

    With ``indices`` each point is a group of rows from which first and total Sobol indices follow (Saltelli et al. 2010,
    doi:10.1016/j.cpc.2009.09.018). Its two halves are rows of the matrices A and B; the group has the row of A, that of B,
    and then for each path the row of A with this path's value from B. So a row's point is ``row // size``.
    """

    points: int
    seed: int = 0
    indices: bool = False

    def __post_init__(self) -> None:
        if self.points > SOBOL_POINTS:
            template = "sample: sobol has at most {sobol_points} different points; give a smaller count"
            raise SampleError(template, sobol_points=SOBOL_POINTS)
        if self._dimensions > SOBOL_DIMENSIONS:
            template = "sample: sobol serves at most {sobol_dimensions} dimensions; vary fewer paths"
            raise SampleError(template, sobol_dimensions=SOBOL_DIMENSIONS)

    @property
    def size(self) -> int:
        """Return the rows of a point."""
        return len(self.variables) + 2 if self.indices else 1

    @property
    def count(self) -> int:
        return self.points * self.size

    @property
    def _dimensions(self) -> int:
        return len(self.variables) * (2 if self.indices else 1)

    @property
    def note(self) -> str | None:
        below = 2 ** (self.points.bit_length() - 1)
        if below == self.points:
            return None
        template = (
            "Sobol samples are balanced when their size is a power of two: {below} or {above} are better than {points}."
        )
        return Phrase(template, below=below, above=2 * below, points=self.points)

    def rows(self, start: int, stop: int) -> dict[str, Values]:
        point, place = np.divmod(np.arange(start, stop), self.size)
        first = start // self.size
        shares = _sobol(self._dimensions, self.seed, first, -(-stop // self.size))
        taken: dict[str, Values] = {}
        for number, variable in enumerate(self.variables):
            from_b = (place == 1) | (place == 2 + number)
            taken[variable.path] = variable.quantile(shares[point - first, number + from_b * len(self.variables)])
        return taken


def _sobol(dimensions: int, seed: int, start: int, stop: int) -> Array:
    """Return the points start … stop − 1 of the scrambled sequence, shape (points, dimensions).

    Each stands in the middle of its cell: a share of exactly 0 would be an infinite value of a normal distribution.
    """
    from scipy.stats import qmc

    if start == stop:
        return np.empty((0, dimensions))
    engine = qmc.Sobol(dimensions, bits=SOBOL_BITS, rng=np.random.default_rng(seed))
    if start > 0:
        engine.fast_forward(start)
    # The first point alone: scipy warns of a first draw that is not a power of two, but `note` reports it, and once.
    shares = np.concatenate([engine.random(1), engine.random(stop - start - 1)])
    return np.asarray(shares + 0.5 / SOBOL_POINTS)
