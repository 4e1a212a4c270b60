"""Samples that are drawn: Latin hypercube and Sobol points (`scipy.stats.qmc`), as shares of each variable's values.

Equal seeds give equal rows. Points of a Sobol sequence are made where they are asked for; a Latin hypercube is held
whole, once in each process.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.sampling.listed_samples import Varied
from diecut_report.study.sampling.saltelli import Saltelli
from diecut_report.study.sampling.variables import SampleError, Values

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
