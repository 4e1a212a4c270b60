"""Rows of machines in what computes the shaft: edges of the cycle, sizes of steel, reactions of one machine asked for in several rows."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.plugins.shaft.cycle import _instants
from diecut_report.plugins.shaft.strength import by_size
from tests.plugins.shafts import CRANKSHAFT, shaft


def test_the_edges_of_each_machines_cycle_ascend_by_themselves() -> None:
    joints = [np.array([[0.7], [0.1]]), np.array([[0.2], [0.4]])]
    share, middle, edges = _instants(joints, np.array([4, 4]))
    assert edges == pytest.approx(np.array([[0, 0.2, 0.7, 1], [0, 0.1, 0.4, 1]]))
    assert share.shape == middle.shape


def test_the_strength_is_that_of_the_least_size_that_holds_the_shaft() -> None:
    sizes = np.array([[0.016, 0.04, 0.1], [0.02, 0.05, 0.08]])
    values = np.array([[900.0, 800.0, 700.0], [1000.0, 850.0, 600.0]])
    found = [
        by_size(sizes, values, np.array([[first], [second]])).ravel().tolist()
        for first, second in ((0.016, 0.021), (0.05, 0.2))
    ]
    assert found == [[900.0, 850.0], [700.0, 600.0]]


def test_reactions_asked_for_in_several_rows_of_one_machine_are_those_of_each_row() -> None:
    under = shaft(CRANKSHAFT).inputs["under_load"]
    angle = np.array([[0.1, 2.0], [1.1, 3.0], [4.0, 6.0]])
    together = under.reactions(angle, angle, None)
    for row in range(3):
        alone = under.reactions(angle[row : row + 1], angle[row : row + 1], None)
        assert together[:, :, row] == pytest.approx(alone[:, :, 0])
