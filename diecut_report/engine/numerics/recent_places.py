"""The places at which curves were asked for last: who takes several curves of a machine asks for each at the same places."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

from diecut_report.expressions import Array

MOST = 8  # places that are kept

Sampler = TypeVar("Sampler")


class RecentPlaces(Generic[Sampler]):
    """Keep what gives the curves at certain places, so that what they have in common is computed once."""

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], Sampler] = {}

    def at(self, axis: str, x: Array, middle: Array, make: Callable[[], Sampler]) -> Sampler:
        """Return what gives the curves over an abscissa at x, in the smooth pieces of these middles; made where it is not known."""
        key = (axis, x.shape, x.tobytes(), middle.shape, middle.tobytes())
        found = self._known.pop(key) if key in self._known else make()
        self._known[key] = found
        if len(self._known) > MOST:
            del self._known[next(iter(self._known))]
        return found

    def forget(self) -> None:
        """Forget all places."""
        self._known.clear()
