"""What the shaft leaves out to be fast changes nothing: instants that cannot be extreme, bodies that are alike."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.mechanics.beams import Supports
from diecut_report.plugins.shaft.body import NO_NOTCH, Body
from diecut_report.plugins.shaft.elastic import ElasticShaft, remembered
from diecut_report.plugins.shaft.material_point import Points

PLACES, INSTANTS = 5, 300


def points(seed: int, *, has_axial: bool) -> Points:
    """Places under random moments, the last without any."""
    random = np.random.default_rng(seed)
    moments = random.normal(size=(PLACES, 2, INSTANTS)) * 1e8
    moments[-1] = 0
    axial = random.normal(size=(PLACES, INSTANTS)) * 1e7 if has_axial else None
    shear = (np.full(PLACES, 1e7), np.full(PLACES, 2e7))
    own = {"k_f": 1.5, "k_fs": 1.3, "endurance": 3e8, "tensile_strength": 9e8}
    return Points(moments, axial, np.zeros((2, PLACES)), shear, {k: np.full(PLACES, v) for k, v in own.items()})


@pytest.mark.parametrize("has_axial", [False, True])
@pytest.mark.parametrize("seed", range(5))
def test_instants_left_out_are_extreme_nowhere_within_the_turn(seed: int, has_axial: bool) -> None:
    whole = points(seed, has_axial=has_axial)
    psi = np.random.default_rng(seed + 100).uniform(0, 2 * np.pi, (PLACES, 1))
    near = whole.near(psi, turn := 0.06)
    assert near.moments.shape[2] < INSTANTS / 3
    around = psi + np.linspace(-turn, turn, 41)
    for few, all_of_them in zip(near.judged(around), whole.judged(around), strict=True):
        np.testing.assert_allclose(few, all_of_them, rtol=1e-12, atol=1e-3)


def shaft(diameters: list[float]) -> ElasticShaft:
    """A plain shaft of 0.5 m with a mass in the middle, a variant for each diameter."""
    ones = np.ones(len(diameters))
    none = np.zeros((1, len(diameters)))
    ends, x = np.outer([0, 0.5], ones), np.outer([0.25], ones)
    places = np.concatenate([x, np.outer([0.05, 0.45], ones)])
    body = Body(ends, np.array([diameters]), none, ("load",), (NO_NOTCH,), places, none, none, none, none, none)
    return ElasticShaft(body, Supports(0.05 * ones, 0.45 * ones), x, 20 * ones[None], 210e9 * ones, 7850 * ones)


def test_variants_of_one_body_among_others_have_the_numbers_of_each_alone() -> None:
    diameters = [0.04, 0.05, 0.04, 0.03, 0.05]
    together = shaft(diameters)
    alone = [shaft([each]) for each in diameters]
    assert together.critical.speed == pytest.approx([each.critical.speed[0] for each in alone], rel=1e-12)
    for index, each in enumerate(alone):
        np.testing.assert_allclose(together.at_joints.slope[:, index], each.at_joints.slope[:, 0], rtol=1e-12)


def test_a_body_that_is_the_same_is_known_already() -> None:
    known = remembered(shaft([0.04]))
    assert remembered(shaft([0.04])) is known
    assert remembered(shaft([0.05])) is not known
    assert remembered(together := shaft([0.04, 0.05])) is together
