"""Whether a curve of a mechanism that was calculated twice is the same to the last bit: all that it follows from is then."""

from __future__ import annotations

from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Accumulated, Choice, Derivative, FromCurve, Value
from diecut_report.engine.calculation import Calculation, CurveHandle

DOMAIN = ("period", "samples", "edges", "joints")


def same_curve(one: CurveHandle, other: CurveHandle) -> bool:
    """Return whether two curves give the same values everywhere, to the last bit; False also where that cannot be told."""
    if one.curve_id != other.curve_id:
        return False
    if one.calculation is other.calculation:
        return True
    pairs = _KNOWN.setdefault(one.calculation, WeakKeyDictionary())
    if other.calculation not in pairs:
        pairs[other.calculation] = {}
    return _Pair(one.calculation, other.calculation, pairs[other.calculation]).holds(one.curve_id)


_KNOWN: WeakKeyDictionary[Calculation, WeakKeyDictionary[Calculation, dict[str, bool]]] = WeakKeyDictionary()
"""Of two calculations which quantities are the same, as several mechanisms take curves of one."""


class _Pair:
    """Hold two calculations of one mechanism, of one machine each."""

    def __init__(self, one: Calculation, other: Calculation, known: dict[str, bool]) -> None:
        self.one, self.other, self.known = one, other, known

    def holds(self, name: str) -> bool:
        """Return whether a quantity is the same in both."""
        if name not in self.known:
            self.known[name] = self._compared(name)
        return self.known[name]

    def _compared(self, name: str) -> bool:
        one, other = self.one, self.other
        if name in one.domains:
            return one.steps[name] is other.steps.get(name) and self._domain(name)
        if name not in one.curves:
            return self._given(name)
        if one.curves[name] is not other.curves.get(name) or not self.holds(one.axis[name]):
            return False
        match one.curves[name]:
            case Accumulated() | Derivative():
                series = one.series[name], other.series[name]
                return all(_same(*(getattr(each, part) for each in series)) for part in ("edges", "series"))
            case FromCurve() as step:
                beside = filter(None, (step.start, step.lasts))
                return self._given(step.given or step.id) and all(map(self.holds, beside))
            case Value() | Choice() as step:
                return all(map(self.holds, taken(step)))
        return False  # what plain code gives is not looked into

    def _domain(self, name: str) -> bool:
        one, other = self.one.domains[name], self.other.domains[name]
        return one.intervals == other.intervals and all(_same(getattr(one, n), getattr(other, n)) for n in DOMAIN)

    def _given(self, name: str) -> bool:
        """Whether a number, or what was given, is the same."""
        try:
            one, other = self.one[name], self.other[name]
        except KeyError:
            return False
        return _same(one, other)


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, CurveHandle) and isinstance(other, CurveHandle):
        return same_curve(one, other)
    if not isinstance(one, np.ndarray) or not isinstance(other, np.ndarray) or one.dtype == object:
        return one is other
    return (one.dtype, one.shape, one.tobytes()) == (other.dtype, other.shape, other.tobytes())
