"""How a search sees what varies: shares of ranges, whole numbers, places in a list, and texts; and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from diecut_report.expressions import Array
from diecut_report.study.definition.optimise import Free, count_of
from diecut_report.study.sampling.variables import ChoiceVariable, Values

Kind = Literal["share", "whole", "text", "fixed"]
NEAR = 1e-9  # share of a range by which a value may lie beside one of a list


@dataclass(frozen=True)
class Gene:
    """Hold how one variable is searched: as a share of its range, as a whole number from 0, or as one of its texts.

    ``options`` are the different values of a list, numbers in their order: a standard size has neighbours, a text has none.
    """

    variable: Free
    kind: Kind
    options: tuple[Any, ...] = ()
    last: int = 0  # the greatest whole number

    @property
    def path(self) -> str:
        return self.variable.path

    def value(self, codes: Sequence[Any]) -> Values:
        """Return the values (SI floats, or texts) that codes stand for."""
        if self.kind == "text":
            return [str(code) for code in codes]
        if self.kind == "share":
            return self.variable.quantile(np.asarray(codes, dtype=float))
        numbers = np.asarray(codes, dtype=float).astype(int)
        if self.options:
            return ChoiceVariable(self.path, self.options).at(numbers)
        assert not isinstance(self.variable, ChoiceVariable)
        return min(self.variable.low, self.variable.high) + numbers.astype(float)

    def code(self, value: Any) -> Any:
        """Return the code of a value; None for one that is not among those that are searched."""
        if isinstance(self.variable, ChoiceVariable):
            found = [n for n, option in enumerate(self.options) if _is_alike(option, value)]
            if not found:
                return None
            return self.options[found[0]] if self.kind == "text" else found[0]
        low, high = sorted((self.variable.low, self.variable.high))
        if isinstance(value, str) or not low <= value <= high:
            return None
        return self._share(value) if self.kind == "share" else round(value - low)

    def _share(self, value: float) -> float:
        """Where a value lies in its range."""
        assert not isinstance(self.variable, ChoiceVariable)
        low, high = self.variable.low, self.variable.high
        if self.variable.log:
            return float(np.log(value / low) / np.log(high / low))
        return (value - low) / (high - low)


def _is_alike(option: Any, value: Any) -> bool:
    if isinstance(option, str) or isinstance(value, str):
        return bool(option == value)
    return bool(abs(option - value) <= NEAR * max(abs(option), abs(value)))


def gene(variable: Free) -> Gene:
    """Return how a variable is searched."""
    count = count_of(variable)
    if isinstance(variable, ChoiceVariable):
        is_text = isinstance(variable.values[0], str)
        options = tuple(dict.fromkeys(variable.values)) if is_text else tuple(sorted(set(variable.values)))  # type: ignore[type-var]
        return Gene(variable, "fixed" if count == 1 else "text" if is_text else "whole", options, len(options) - 1)
    if count is None:
        return Gene(variable, "share")
    return Gene(variable, "fixed" if count == 1 else "whole", (), count - 1)


def decoded(genes: Sequence[Gene], rows: Sequence[Mapping[str, Any]]) -> dict[str, Values]:
    """Return the machines that rows of codes stand for, a column for each path."""
    return {each.path: _column(each, rows) for each in genes}


def _column(each: Gene, rows: Sequence[Mapping[str, Any]]) -> Values:
    if each.kind != "fixed":
        return each.value([row[each.path] for row in rows])
    only = each.options[0] if each.options else each.variable.quantile(np.array([0.5]))[0]
    return [only] * len(rows) if isinstance(only, str) else np.full(len(rows), float(only))


def combinations(genes: Sequence[Gene], start: int, stop: int) -> list[dict[str, Any]]:
    """Return some of all machines that lists and whole numbers make; the last path changes first."""
    free = [each for each in genes if each.kind != "fixed"]
    rest: Array = np.arange(start, stop, dtype=np.int64)
    columns: dict[str, list[Any]] = {}
    for each in reversed(free):
        rest, numbers = np.divmod(rest, each.last + 1)
        columns[each.path] = [each.options[n] if each.kind == "text" else int(n) for n in numbers]
    return [{path: column[row] for path, column in columns.items()} for row in range(stop - start)]
