"""Which places of an abscissa are breakpoints of curves: the same as comparing each with each, in memory that grows as their number."""

from __future__ import annotations

import tracemalloc

import numpy as np

from diecut_report.machine.numerics.domain import SAME, Domain


def cut(places: np.ndarray, period: float = 2.0) -> Domain:
    """A domain for each row of places."""
    found = Domain(np.full((len(places), 1), period), np.arange(3.0))
    found.cut(places)
    return found


def test_a_place_is_a_joint_where_any_joint_is_as_near_as_rounding() -> None:
    draw = np.random.default_rng(5)
    domain = cut(draw.uniform(0, 2, (4, 30)))
    near = domain.joints + draw.choice([0, 0.4, -0.4, 3, -3], domain.joints.shape) * SAME * 2
    places = np.concatenate([near, draw.uniform(-1, 3, (4, 20)), np.full((4, 1), np.nan)], axis=1)
    expected = [
        [any(abs(place - joint) <= SAME * 2 for joint in row) for place in own]
        for row, own in zip(domain.joints, places, strict=True)
    ]
    assert domain.is_joint(places).tolist() == expected
    assert 0 < np.sum(expected) < np.size(expected)


def test_ten_thousand_places_among_ten_thousand_joints_take_little_memory() -> None:
    domain = cut(np.linspace(0, 2, 10_000, endpoint=False)[None, :])
    tracemalloc.start()
    found = domain.is_joint(domain.joints)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert found.all() and peak < 5e6  # comparing each with each takes 800 MB
