"""Curves of many machines at the places at which others asked for them: several mechanisms that take the same curves ask alike."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from hashlib import blake2b

import numpy as np

from diecut_report.expressions import Array

MOST = 32 * 2**20  # bytes of values that are kept
Evaluate = Callable[[Sequence[str]], Sequence[Array]]


class SharedPlaces:
    """Keep the values of curves at the places that were asked for last.

    Who asks for a curve and then for others at the same places gets all of these at once the next time: what they have in common
    is computed once.
    """

    def __init__(self, most: int = MOST) -> None:
        """Keep so many bytes of values."""
        self.most, self._bytes = most, 0
        self._known: dict[bytes, dict[str, Array]] = {}
        self._followers: dict[str, list[str]] = defaultdict(list)

    def at(self, name: str, axis: str, places: Iterable[Array | None], evaluate: Evaluate) -> Array:
        """Return a curve over an abscissa at places (x, the middles of their pieces, the variants); evaluated where it is not known."""
        key = _digest(axis, places)
        found = self._known.pop(key, {})
        self._known[key] = found
        if name not in found:
            leader = next(iter(found), name)
            wanted = [name, *self._followers[name]] if leader == name else [name]
            if leader != name and name not in self._followers[leader]:
                self._followers[leader].append(name)
            self._keep(found, wanted, evaluate(wanted))
        return found[name]

    def _keep(self, found: dict[str, Array], names: Sequence[str], values: Sequence[Array]) -> None:
        for name, each in zip(names, values, strict=True):
            each.flags.writeable = False  # others will read it
            found[name] = each
            self._bytes += each.nbytes
        while self._bytes > self.most and len(self._known) > 1:
            oldest = self._known.pop(next(iter(self._known)))
            self._bytes -= sum(each.nbytes for each in oldest.values())

    def forget(self) -> None:
        """Forget all places."""
        self._known.clear()
        self._bytes = 0


def _digest(axis: str, places: Iterable[Array | None]) -> bytes:
    found = blake2b(axis.encode(), digest_size=16)
    for each in places:
        found.update(repr(None if each is None else (each.shape, each.dtype.str)).encode())
        if each is not None:
            found.update(np.ascontiguousarray(each).data if each.size else b"")
    return found.digest()
