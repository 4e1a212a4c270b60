"""A condition on curves holds all over their abscissa, or the machine is refused with the place where it fails most."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, abscissa, m, pi, samples
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.steps.protocols import Impossible
from tests.machines import inputs


class Wave(Inputs):
    size = Quantity("a", "mm", "Size of the wave", gt=0, default=20)
    top = Quantity("h_t", "mm", "Height above it", default=100)
    n_points = samples(36)


def wave(condition: Any, shift: Any = pi / 25) -> Mechanism:
    """A height of 3a − a·cos(φ − shift)¹⁰⁰¹, even but for a narrow top, half a turn further on, and a narrow dip."""
    chapter = Chapter("Wave")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.other = abscissa(2 * np.pi), "ψ", "deg", "Other angle"
    chapter.height = m.size * (3 - np.cos(m.angle - shift) ** 1001), "h", "mm", "Height"
    chapter.depth = m.size * np.sin(m.other), "z", "mm", "Depth"
    chapter.require("below", condition, key="top", message="is {top}; the wave of {size} reaches it")
    chapter.beyond = 2 * m.top, "h_2", "mm", "Twice the height"
    return Mechanism(kind="wave", version="1", title="Wave", summary="", inputs=Wave, chapters=(chapter,))


BELOW = m.height < m.top


def refused(mechanism: Mechanism, **keys: str) -> tuple[str, str]:
    with pytest.raises(Impossible) as told:
        calculate(mechanism, inputs(mechanism, keys))
    return told.value.key, told.value.message


def test_a_curve_that_keeps_a_condition_lets_the_machine_be() -> None:
    for condition in (BELOW, m.top > m.height, m.height <= m.top, BELOW & (m.height > 0)):
        mechanism = wave(condition)
        check_mechanism(mechanism)
        assert float(calculate(mechanism, inputs(mechanism, {}))["beyond"][0, 0]) == pytest.approx(0.2)


def test_a_narrow_top_is_found_with_its_place() -> None:
    assert refused(wave(BELOW), top="79.99 mm") == ("top", "is 79.99 mm; the wave of 20 mm reaches it (at φ = 187.2°)")


def test_the_first_comparison_that_fails_is_told() -> None:
    dips, both = m.height > 41 / 20 * m.size, "is 79 mm; the wave of 20 mm reaches it (at φ = "
    assert refused(wave(dips & BELOW), top="79 mm")[1] == f"{both}7.200°)"
    assert refused(wave(BELOW & dips), top="79 mm")[1] == f"{both}187.2°)"


def test_a_curve_may_touch_where_it_need_not_be_below() -> None:
    assert refused(wave(m.angle < 0 * m.angle))[1].endswith("(at φ = 360°)")
    for condition, top in ((m.height <= 4 * m.size, "1 mm"), (m.height < 4 * m.size + m.top, "1 um")):
        calculate(wave(condition, shift=0 * pi), inputs(wave(condition), {"top": top}))
    assert refused(wave(m.height < 4 * m.size, shift=0 * pi))[0] == "top"


def test_of_many_machines_those_are_refused_that_are_refused_alone() -> None:
    tops = np.array([100.0, 79.99, 80.01, 20.0])
    mechanism = wave(BELOW)
    together = calculate(mechanism, {**inputs(mechanism, {}), "top": tops / 1000}, len(tops))
    assert {row: words for row, (_, words) in together.flaws.items()} == {
        row: refused(mechanism, top=f"{tops[row]:g} mm")[1] for row in (1, 3)
    }


@pytest.mark.parametrize(
    "condition, words",
    [
        ((m.height < m.top) | (m.height > m.size), "of curves only comparisons are required, (a < b) & (b < c)"),
        (m.depth < m.height, "mixes what runs over unlike places"),
    ],
    ids=["either", "two abscissas"],
)
def test_what_cannot_be_required_of_curves_is_told(condition: Any, words: str) -> None:
    assert [words in str(each) for each in faults(wave(condition))] == [True]
