"""Samples in general, and those that are listed: grids, zipped lists, tables.

A sample holds no rows: it makes those that are asked for, the same however the asking is cut into chunks and in
whichever process.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, joined, phrase
from diecut_report.study.sampling.saltelli import Saltelli
from diecut_report.study.sampling.variables import ChoiceVariable, RangeVariable, SampleError, Values, Variable


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
