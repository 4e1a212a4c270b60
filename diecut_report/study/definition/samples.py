"""Samples that are drawn: Latin hypercube and Sobol points (`scipy.stats.qmc`), as shares of each variable's values.

Equal seeds give equal rows. Points of a Sobol sequence are made where they are asked for; a Latin hypercube is held
whole, once in each process.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from diecut_report.formulas import Array
from diecut_report.study.definition.variables import ChoiceVariable, RangeVariable, SampleError, Values, Variable
from diecut_report.text.phrases import Phrase, joined, phrase

# Rows from which first and total Sobol indices can be calculated.


@dataclass(frozen=True)
class Saltelli:
    """Describe how the rows of a sample for Sobol indices belong together.

    Each of `points` has `size` rows in turn: the first from the matrix A, the second from B, then for each of `paths`
    the row of A with this path's value from B. So a row's point is ``row // size`` and its place ``row % size``.
    """

    points: int
    paths: tuple[str, ...]

    @property
    def size(self) -> int:
        """Return rows of a point."""
        return len(self.paths) + 2

    @property
    def matrices(self) -> tuple[str, ...]:
        """Return the names of the matrices by place: A, B, then ``AB PATH``."""
        return ("A", "B", *(f"AB {path}" for path in self.paths))

    def point(self, row: Array) -> Array:
        """Return the points to which rows belong."""
        return row // self.size

    def place(self, row: Array) -> Array:
        """Return the places of rows in their points: 0 is of A, 1 of B, 2 + i of A with the i-th path from B."""
        return row % self.size


# Samples in general, and those that are listed: grids, zipped lists, tables.
#
# A sample holds no rows: it makes those that are asked for, the same however the asking is cut into chunks and in
# whichever process.


class Sample(ABC):
    """Give the variants of a study before constraints, numbered from 0."""

    @property
    @abstractmethod
    def count(self) -> int:
        """Return the number of rows."""

    @property
    @abstractmethod
    def paths(self) -> tuple[str, ...]:
        """Return what each row sets."""

    @property
    def note(self) -> str | None:
        """Return what a user should know about this sample before it runs, in a sentence or two."""
        return None

    @property
    def design(self) -> Saltelli | None:
        """Return how the rows belong together where Sobol indices can be calculated from them."""
        return None

    def rows(self, start: int, stop: int) -> dict[str, Values]:
        """Return the rows start … stop − 1: an array of SI floats, or a list of texts, for each path."""
        if not 0 <= start <= stop <= self.count:
            raise IndexError(f"rows {start} to {stop} of a sample of {self.count}")
        return self._rows(start, stop)

    @abstractmethod
    def _rows(self, start: int, stop: int) -> dict[str, Values]: ...


@dataclass(frozen=True)
class Varied(Sample):
    """Sample variables, each of another path."""

    variables: tuple[Variable, ...]

    def __post_init__(self) -> None:
        if not self.variables:
            raise SampleError(phrase("nothing is varied; give at least one path under vary"))
        for path, times in Counter(self.paths).items():
            if times > 1:
                raise SampleError(phrase("is varied more than once; keep one of them"), path)

    @property
    def paths(self) -> tuple[str, ...]:
        return tuple(variable.path for variable in self.variables)


# --- lists and ranges ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Listed(Varied):
    method = "grid"

    def __post_init__(self) -> None:
        super().__post_init__()
        for variable in self.variables:
            if not isinstance(variable, ChoiceVariable | RangeVariable):
                words = Phrase("a distribution has no list of values for sample: {method}", method=self.method)
                raise SampleError(
                    Phrase("{words}; give a list or a range, or sample: latin_hypercube or sobol", words=words),
                    variable.path,
                )
            if variable.count is None:
                raise SampleError(
                    Phrase("count is missing; sample: {method} needs it", method=self.method), variable.path
                )

    @cached_property
    def counts(self) -> tuple[int, ...]:
        """Number of values of each variable."""
        return tuple(variable.count or 0 for variable in self.variables)

    def _taken(self, numbers: Sequence[Array]) -> dict[str, Values]:
        listed = (variable for variable in self.variables if isinstance(variable, ChoiceVariable | RangeVariable))
        return {variable.path: variable.at(number) for variable, number in zip(listed, numbers, strict=True)}


@dataclass(frozen=True)
class Grid(_Listed):
    """Combine every value of each variable with every value of the others; the first variable changes most slowly."""

    @property
    def count(self) -> int:
        return math.prod(self.counts)

    def _rows(self, start: int, stop: int) -> dict[str, Values]:
        rest = np.arange(start, stop, dtype=np.int64)
        numbers = []
        for count in reversed(self.counts):
            rest, number = np.divmod(rest, count)
            numbers.append(number)
        return self._taken(numbers[::-1])


@dataclass(frozen=True)
class Zip(_Listed):
    """Take the first values together, the second values together, and so on."""

    method = "zip"

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(set(self.counts)) > 1:
            lengths = joined(
                (
                    Phrase("{path} has {count}", path=path, count=count)
                    for path, count in zip(self.paths, self.counts, strict=True)
                ),
                ", ",
            )
            raise SampleError(
                Phrase(
                    "sample: zip needs as many values of each path: {lengths}. Fill up, or use sample: grid",
                    lengths=lengths,
                )
            )

    @property
    def count(self) -> int:
        return self.counts[0]

    def _rows(self, start: int, stop: int) -> dict[str, Values]:
        return self._taken([np.arange(start, stop)] * len(self.counts))


@dataclass(frozen=True)
class TableSample(Sample):
    """Hold rows that are given: a column of SI floats, or of texts, for each path."""

    columns: Mapping[str, Values]

    def __post_init__(self) -> None:
        lengths = {path: len(column) for path, column in self.columns.items()}
        if not lengths:
            raise SampleError(phrase("the table has no columns; give at least one, headed by a path"))
        if len(set(lengths.values())) > 1:
            told = joined((Phrase("{path} has {count}", path=path, count=n) for path, n in lengths.items()), ", ")
            raise SampleError(Phrase("the columns of the table are of unlike lengths: {lengths}", lengths=told))
        if 0 in lengths.values():
            raise SampleError(phrase("the table has no rows below its header; give at least one"))

    @property
    def count(self) -> int:
        return len(next(iter(self.columns.values())))

    @property
    def paths(self) -> tuple[str, ...]:
        return tuple(self.columns)

    def _rows(self, start: int, stop: int) -> dict[str, Values]:
        return {path: column[start:stop] for path, column in self.columns.items()}


SOBOL_BITS = 30
SOBOL_POINTS = 2**SOBOL_BITS
SOBOL_DIMENSIONS = 21201  # of scipy's table of direction numbers
LARGE = 500 * 2**20
"""Bytes from which on the note of a Latin hypercube says how much memory it takes."""


@dataclass(frozen=True)
class _Drawn(Varied):
    points: int
    seed: int = 0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.points < 1:
            raise SampleError(phrase("the sample is empty; give count: 1 or more"))
        if self.seed < 0:
            raise SampleError(phrase("seed must be 0 or more"))

    @property
    def count(self) -> int:
        return self.points


@dataclass(frozen=True)
class LatinHypercube(_Drawn):
    """Draw rows where each variable's probability is cut into as many equal parts as there are rows; each part is taken once."""

    @property
    def note(self) -> str | None:
        held = 8 * self.points * len(self.variables)
        words = Phrase(
            "The Latin hypercube holds {held} MB in each process; method: sobol holds nothing.",
            held=format(held / 2**20, ".0f"),
        )
        return words if held >= LARGE else None

    def _rows(self, start: int, stop: int) -> dict[str, Values]:
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
class Sobol(_Drawn):
    """Draw scrambled Sobol points: they fill the space of all variables evenly, also with few rows."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.points > SOBOL_POINTS:
            raise SampleError(
                Phrase(
                    "sample: sobol has at most {sobol_points} different points; give a smaller count",
                    sobol_points=SOBOL_POINTS,
                )
            )
        if self._dimensions > SOBOL_DIMENSIONS:
            raise SampleError(
                Phrase(
                    "sample: sobol serves at most {sobol_dimensions} dimensions; vary fewer paths",
                    sobol_dimensions=SOBOL_DIMENSIONS,
                )
            )

    @property
    def _dimensions(self) -> int:
        return len(self.variables)

    @property
    def note(self) -> str | None:
        below = 2 ** (self.points.bit_length() - 1)
        if below == self.points:
            return None
        return Phrase(
            "Sobol points are balanced where their count is a power of two: {below} or {above} serve better "
            "than {points}.",
            below=below,
            above=2 * below,
            points=self.points,
        )

    def _rows(self, start: int, stop: int) -> dict[str, Values]:
        shares = _sobol(self._dimensions, self.seed, start, stop).T
        return {variable.path: variable.quantile(share) for variable, share in zip(self.variables, shares, strict=True)}


def _sobol(dimensions: int, seed: int, start: int, stop: int) -> Array:
    """The points start … stop − 1 of the scrambled sequence, (points, dimensions).

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


@dataclass(frozen=True)
class SobolIndices(Sobol):
    """Draw Sobol points in the order that first and total Sobol indices need (Saltelli et al. 2010, doi:10.1016/j.cpc.2009.09.018).

    A and B are the halves of points in twice as many dimensions; see `Saltelli` for the rows.
    """

    @property
    def count(self) -> int:
        return self.points * self.design.size

    @property
    def design(self) -> Saltelli:
        return Saltelli(self.points, self.paths)

    @property
    def _dimensions(self) -> int:
        return 2 * len(self.variables)

    def _rows(self, start: int, stop: int) -> dict[str, Values]:
        row = np.arange(start, stop)
        first, end = start // self.design.size, -(-stop // self.design.size)
        shares = _sobol(self._dimensions, self.seed, first, end)
        point, place = self.design.point(row) - first, self.design.place(row)
        taken: dict[str, Values] = {}
        for number, variable in enumerate(self.variables):
            from_b = (place == 1) | (place == 2 + number)
            taken[variable.path] = variable.quantile(shares[point, number + from_b * len(self.variables)])
        return taken


# The variants of a study by number: what kinds of samples there are.


__all__ = ["Saltelli", "Sample", "SampleError", "grid", "latin_hypercube", "sobol", "table", "zipped"]


def grid(variables: Sequence[Variable]) -> Sample:
    """Return every value of each list or range with every value of the others; the first path changes most slowly."""
    return Grid(tuple(variables))


def zipped(variables: Sequence[Variable]) -> Sample:
    """Return lists and ranges of equal lengths: their first values together, their second values together, and so on."""
    return Zip(tuple(variables))


def latin_hypercube(variables: Sequence[Variable], count: int, seed: int = 0) -> Sample:
    """Return so many rows; each `1 / count` of the probability of each variable is taken once."""
    return LatinHypercube(tuple(variables), count, seed)


def sobol(variables: Sequence[Variable], count: int, seed: int = 0, *, indices: bool = False) -> Sample:
    """Return so many scrambled Sobol points; with `indices` each is a group of paths + 2 rows (see `Saltelli`)."""
    return (SobolIndices if indices else Sobol)(tuple(variables), count, seed)


def table(columns: Mapping[str, Values]) -> Sample:
    """Return given rows: for each path a column of SI floats, or of texts."""
    return TableSample(dict(columns))
