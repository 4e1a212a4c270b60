"""Where the front lies within what varies: an input that stands at an end of its range is held by that end."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.contract.inputs import Quantity
from diecut_report.expressions import Array
from diecut_report.optimisation.coding import gene
from diecut_report.optimisation.front import FoundFront
from diecut_report.optimisation.generation import asked_of
from diecut_report.study.analysis.stored_variants import StoredColumn
from diecut_report.study.definition.optimise import Free
from diecut_report.study.definition.study_file import Study
from diecut_report.study.sampling.variables import ChoiceVariable

AT_END = 1e-2  # share of a range within which a value stands at its end


@dataclass(frozen=True)
class InputPlace:
    """Hold where the front lies within one varied input: its ends (SI), how many points stand at each, and their shares of the range.

    Of a text ``counts`` says how many points have each value; numbers have ``low`` and ``high``. ``may_lower`` and ``may_raise`` say
    whether the input itself allows less or more than what is searched.
    """

    column: StoredColumn
    low: float
    high: float
    shares: Array
    at_low: int
    at_high: int
    counts: tuple[tuple[str, int], ...]
    may_lower: bool
    may_raise: bool

    @property
    def is_text(self) -> bool:
        return bool(self.counts)

    @property
    def count(self) -> int:
        return len(self.shares) if not self.is_text else sum(n for _, n in self.counts)


def places(study: Study, front: FoundFront) -> list[InputPlace]:
    """Return where the front lies within each input that has more than one value."""
    columns = {column.name: column for column in front.varied}
    found = []
    for variable in asked_of(study).variables:
        own = gene(variable)
        if own.kind == "fixed":
            continue
        values = front.inputs[variable.path]
        if own.kind == "text":
            counted = Counter(map(str, values))
            told = tuple((option, counted[option]) for option in own.options)
            found.append(InputPlace(columns[variable.path], 0.0, 0.0, np.empty(0), 0, 0, told, False, False))
            continue
        is_list = isinstance(variable, ChoiceVariable)
        ends = (own.options[0], own.options[-1]) if is_list else sorted(ends_of(variable))
        least = len(values) / 2 if is_list else 0.0
        found.append(_of_numbers(study, columns[variable.path], values.astype(float), ends[0], ends[-1], least))
    return found


def ends_of(variable: Free) -> tuple[float, float]:
    """Return the ends of a range."""
    assert not isinstance(variable, ChoiceVariable)
    return variable.low, variable.high


def _of_numbers(study: Study, column: StoredColumn, values: Array, low: float, high: float, least: float) -> InputPlace:
    """Where numbers lie; an end holds some where it holds more than so many: the ends of a short list are met by chance."""
    shares = (values - low) / (high - low)
    at_low, at_high = (
        int(count) if count > least else 0 for count in (np.sum(shares <= AT_END), np.sum(shares >= 1 - AT_END))
    )
    meta: Any = study.inputs[column.name].meta
    assert isinstance(meta, Quantity)
    step = meta.parsed_unit.factor if meta.integer else AT_END * (high - low)
    beyond = meta.holds(np.array([low - step, high + step]))
    return InputPlace(column, low, high, shares, at_low, at_high, (), bool(beyond[0]), bool(beyond[1]))
