"""Steps over repeated parts (a list of blocks in the config), and steps that take from standard series and tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from diecut_report.contract.steps import Step

if TYPE_CHECKING:
    from diecut_report.standards import StandardSeries, StandardTable


@dataclass(frozen=True, kw_only=True, eq=False)
class Total(Step):
    """Sum, product, least or greatest over repeated parts; with ``among`` (a row) only over the parts where that is above zero."""

    of: str
    operation: Literal["sum", "product", "min", "max"]
    among: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Neighbour(Step):
    """A row: the value of the next part (``shift`` = 1) or of the one before (-1), the parts standing in a closed loop."""

    of: str
    shift: Literal[1, -1] = 1


@dataclass(frozen=True, kw_only=True, eq=False)
class Running(Step):
    """A row: sum or product of a row's parts from the first one up to each."""

    of: str
    operation: Literal["sum", "product"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Part(Step):
    """The value of one part of a row: the first (``index`` = 0), the last (-1)."""

    of: str
    index: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Lookup(Step):
    """A number from a table by a text input, in the step's display unit; a row where the text is one of repeated parts."""

    by: str
    table: Mapping[str, float] | StandardTable


@dataclass(frozen=True, kw_only=True, eq=False)
class Pick(Step):
    """A value of a standard series: the next one at or above, at or below, or the nearest to a quantity.

    ``series`` are the standard values: in the display unit, or a standard series; or one for each value of the text
    input ``by``. The neighbours that were not taken are printed too.
    """

    of: str
    series: tuple[float, ...] | StandardSeries | Mapping[str, StandardSeries]
    by: str = ""
    rule: Literal["above", "below", "nearest"]
