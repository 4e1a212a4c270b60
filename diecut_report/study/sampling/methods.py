"""The variants of a study by number: what kinds of samples there are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from diecut_report.study.sampling.drawn_samples import LatinHypercube, Sobol, SobolIndices
from diecut_report.study.sampling.listed_samples import Grid, Sample, TableSample, Zip
from diecut_report.study.sampling.saltelli import Saltelli
from diecut_report.study.sampling.variables import SampleError, Values, Variable

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
