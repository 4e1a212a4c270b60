"""The places at which curves were asked for last: who takes several curves of a machine asks for each at the same places."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Generic, TypeVar

from diecut_report.expressions import Array

Sampler = TypeVar("Sampler")


class RecentPlaces(Generic[Sampler]):
    """Keep what gives the curves at certain places, so that what they have in common is computed once."""

    def __init__(self, most: int) -> None:
        """Keep as many places."""
        self.most = most
        self._known: dict[tuple[object, ...], Sampler] = {}

    def at(self, axis: str, places: Iterable[Array | None], make: Callable[[], Sampler]) -> Sampler:
        """Return what gives the curves over an abscissa at places (x, the middles of their pieces, the variants); made where it is not known."""
        key = (axis, *(None if each is None else (each.shape, each.tobytes()) for each in places))
        found = self._known.pop(key) if key in self._known else make()
        self._known[key] = found
        if len(self._known) > self.most:
            del self._known[next(iter(self._known))]
        return found

    def forget(self) -> None:
        """Forget all places."""
        self._known.clear()
