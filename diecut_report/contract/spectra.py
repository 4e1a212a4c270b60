"""Curves over a range of their own, the same for every machine: what the results hold beside the machine's own curves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from diecut_report.contract.place import placed
from diecut_report.expressions import Array


@dataclass(frozen=True, kw_only=True, eq=False)
class SpectrumLine:
    """Declare one curve of a spectrum: ``values`` (SI) at those of the spectrum."""

    id: str
    symbol: str
    description: str
    values: Array
    unit: str = "1"
    source: str = ""
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Spectrum(SpectrumLine):
    """Declare what ``lines`` run over: its ``values`` ascend. ``lines`` is called when a machine's results are made."""

    lines: Callable[[], Sequence[SpectrumLine]]
