"""Curves of many machines that several mechanisms take at the same places."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.machine.numerics.domain import SharedPlaces

HERE, THERE = np.linspace(0, 1, 12).reshape(3, 4), np.linspace(0, 2, 12).reshape(3, 4)


class Asked:
    """Curves that tell what they were asked for."""

    def __init__(self, most: int = 10_000) -> None:
        self.shared, self.calls = SharedPlaces(most), list[list[str]]()

    def at(self, name: str, places: Array, axis: str = "angle") -> Array:
        def evaluate(names: Sequence[str]) -> list[Array]:
            self.calls.append(list(names))
            return [places * (2 + "abc".index(each)) for each in names]

        return self.shared.at(name, axis, (places, places[:, :1], None), evaluate)


def test_what_is_known_at_places_is_not_evaluated_again() -> None:
    asked = Asked()
    for _ in range(2):
        assert np.array_equal(asked.at("b", HERE.copy()), 3 * HERE)
    assert np.array_equal(asked.at("b", THERE), 3 * THERE)
    assert np.array_equal(asked.at("b", THERE, "way"), 3 * THERE)
    assert asked.calls == [["b"]] * 3


def test_what_was_asked_together_before_is_evaluated_together() -> None:
    asked = Asked()
    for places in (HERE, THERE):
        for name in "acb":
            assert np.array_equal(asked.at(name, places), places * (2 + "abc".index(name)))
    assert asked.calls == [["a"], ["c"], ["b"], ["a", "c", "b"]]
    asked.at("c", HERE + 1)
    assert asked.calls[-1] == ["c"]


def test_no_more_is_kept_than_it_may() -> None:
    asked = Asked(2 * HERE.nbytes)
    for places in (HERE, THERE, HERE + 1, HERE):
        asked.at("a", places)
    assert len(asked.calls) == 4
    asked.at("a", HERE + 1)
    assert len(asked.calls) == 4


def test_what_others_read_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="read-only"):
        Asked().at("a", HERE)[0] = 1.0
