"""Single extreme values end in numbers or in words, never in nan, a traceback, a fault of a plugin or a warning."""

from __future__ import annotations

import random

import pytest

from diecut_report.mechanism.inputs import Quantity
from diecut_report.quantities.plausible import Plausible
from tests.extremes.examples import HOMES, example_extremes, example_fault, new_extremes
from tests.extremes.harness import ALONE, extremes, fault, values

SAMPLE = 6  # of a kind
FEW = {
    "elastic_follower": 2,
    "gear_pair": 3,
    "cam_gear_transport": 3,
    "platen_press": 3,
    "circular_knife": 3,
}  # of those that take longest


@pytest.mark.parametrize("kind", ALONE)
def test_a_sample_of_single_extremes_is_numbers_or_words(kind: str) -> None:
    cases = [case for case in extremes(kind, short=True) if "n_points" not in case.key]
    chosen = random.Random(kind).sample(cases, min(FEW.get(kind, SAMPLE), len(cases)))
    assert [f"{case.name}: {found}" for case in chosen if (found := fault(case))] == []


@pytest.mark.nightly
@pytest.mark.parametrize("kind", ALONE)
def test_every_single_extreme_is_numbers_or_words(kind: str) -> None:
    assert [f"{case.name}: {found}" for case in extremes(kind) if (found := fault(case))] == []


@pytest.mark.nightly
def test_a_sample_of_extremes_of_what_holds_a_press_together_is_numbers_or_words() -> None:
    homes = ("timing", "consistency")
    cases = [case for home in homes for case in example_extremes("flat_cylinder_press_mended", home)]
    chosen = random.Random(1).sample(cases, 3)
    assert [f"{case.name}: {found}" for case in chosen if (found := example_fault(case))] == []


@pytest.mark.nightly
@pytest.mark.parametrize(("stem", "home"), HOMES)
def test_every_single_extreme_of_an_example_is_numbers_or_words(stem: str, home: str) -> None:
    cases = new_extremes(stem, home)
    assert [f"{case.name}: {found}" for case in cases if (found := example_fault(case))] == []


def test_a_fault_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Plausible, "holds", lambda self, values, *, calculated=False: values == values)
    cases = [case for case in extremes("damper") if abs(case.value) in (1e-300, 1e300)]
    assert any(fault(case) for case in cases)


def test_the_extremes_of_a_quantity_stand_on_both_sides_of_its_bounds() -> None:
    found = list(values(Quantity("l", "mm", "Length", gt=0, le=80)))
    assert {0, 80, 0.001, 1e5, 1e-300, 1e300, -1e300} <= set(found)
    assert any(0 < value - 80 < 1e-3 for value in found) and any(0 < 80 - value < 1e-3 for value in found)
    assert set(values(Quantity("n", "1", "Number", ge=3, integer=True))) >= {2, 3, 4, 1_000_000}
