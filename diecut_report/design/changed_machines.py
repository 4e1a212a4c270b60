"""Machines with other values of the free inputs, counted: no more of them are calculated than a search may spend."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.contract.inputs import Quantity
from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.varied_machines import VariedMachines, varied
from diecut_report.expressions import Array
from diecut_report.study.definition.base_inputs import Input

MOST = 10_000  # machines of a search, unless the user says otherwise


class Enough(Exception):
    """Report that a search has calculated as many machines as it may."""


@dataclass
class Spent:
    """Count the machines that were calculated; ``most`` is how many may be."""

    most: float = math.inf
    count: int = 0

    def take(self, count: int) -> None:
        """Note machines that are about to be calculated; Enough where they are too many."""
        if self.count + count > self.most:
            raise Enough
        self.count += count


@dataclass(frozen=True)
class ChangedMachines:
    """Calculate machines by the shares of their inputs that are changed; ``choices`` are texts and stepped numbers, as typed."""

    config: Config
    inputs: Sequence[DesignInput]
    choices: Mapping[Input, str] = field(default_factory=dict)
    spent: Spent = field(default_factory=Spent)

    def __call__(self, shares: Array) -> VariedMachines:
        count = len(shares)
        self.spent.take(count)
        today = np.array([each.today for each in self.inputs], dtype=float)
        values = today * (1.0 + shares)
        given: dict[Input, Any] = {each.asked: values[:, index] for index, each in enumerate(self.inputs)}
        return varied(
            self.config, given | {asked: _column(asked, text, count) for asked, text in self.choices.items()}, count
        )

    def with_choice(self, asked: Input, text: str) -> ChangedMachines:
        """Return the same with one more choice."""
        return self.with_choices({**self.choices, asked: text})

    def with_choices(self, choices: Mapping[Input, str]) -> ChangedMachines:
        """Return the same with these choices in the place of its own."""
        return ChangedMachines(self.config, self.inputs, choices, self.spent)


def _column(asked: Input, text: str, count: int) -> Any:
    return np.full(count, float(asked.meta.validate(text))) if isinstance(asked.meta, Quantity) else [text] * count
