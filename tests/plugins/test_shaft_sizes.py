"""Diameters that are left out, found again by trying every size; what the shaft leaves out to be fast changes nothing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.machine import mechanism
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics.beams import Supports
from diecut_report.plugins.shaft import MECHANISM
from diecut_report.plugins.shaft.body import NO_NOTCH, Body
from diecut_report.plugins.shaft.cycle import _instants
from diecut_report.plugins.shaft.elastic import ElasticShaft, remembered
from diecut_report.plugins.shaft.material_point import Points
from diecut_report.plugins.shaft.sizing import SERIES
from diecut_report.plugins.shaft.strength import by_size
from diecut_report.press import Press
from diecut_report.results.checks import verdicts
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.variant_rows import columns_of
from diecut_report.study.execution.worker import Chunk
from diecut_report.study.execution.worker import calculate as calculated
from tests.configs import DISCOVERY, loaded, saved
from tests.machines import inputs, number
from tests.plugins.shafts import CRANKSHAFT, shaft
from tests.plugins.test_shaft_of_a_press import PRESS

SETTLED = {"fatigue", "yield", "bearing_slope", "critical_speed", "deflection", "twist"}
PLAIN = [{key: value for key, value in section.items() if key != "fillet_radius"} for section in CRANKSHAFT["sections"]]


def without(*sections: int, of: list[dict[str, Any]] | None = None) -> list[dict[str, Any]]:
    """The sections of the crankshaft, some without their diameters."""
    given = of or CRANKSHAFT["sections"]
    return [
        {k: v for k, v in each.items() if k != "diameter"} if i in sections else dict(each)
        for i, each in enumerate(given)
    ]


def diameters(calculation: Calculation) -> list[float]:
    """The diameters of all sections, in mm."""
    return [round(float(each) * 1e3, 6) for each in calculation["section_diameter"][0]]


def holds(**changes: Any) -> bool:
    """Whether a crankshaft with all diameters given keeps the checks that diameters settle; one that cannot exist does not."""
    try:
        found = verdicts(shaft(CRANKSHAFT, **changes))
    except Impossible:
        return False
    return all(check.status in ("pass", "not_checked") for check in found if check.id in SETTLED)


def with_sizes(sections: list[dict[str, Any]], sizes: list[float]) -> list[dict[str, Any]]:
    return [section | {"diameter": size} for section, size in zip(sections, sizes, strict=True)]


def test_a_shaft_whose_angle_is_a_constant_is_sized_as_one_that_stands() -> None:
    swung, standing = (shaft(CRANKSHAFT, sections=without(1, of=PLAIN), rotation=each) for each in (1e-7, "none"))
    assert diameters(swung) == diameters(standing)


@pytest.mark.nightly  # each calculates dozens of shafts
@pytest.mark.parametrize(
    "changes", [{}, {"required_fatigue_safety": 1.2}, {"allowable_deflection": 0.08}, {"speed": 20_000}]
)
def test_the_diameter_of_a_section_is_the_least_of_the_series_with_which_the_shaft_holds(
    changes: dict[str, Any],
) -> None:
    found = diameters(shaft(CRANKSHAFT, sections=without(2), **changes))
    assert found[:2] + found[3:] == [45, 55, 50]
    tried = [float(size) * 1e3 for size in SERIES if size <= found[2] / 1e3 * (1 + 1e-9)]
    assert [holds(sections=with_sizes(without(2), [45, 55, size, 50]), **changes) for size in tried] == [False] * (
        len(tried) - 1
    ) + [True]


def test_of_several_sections_none_can_be_thinner_alone() -> None:
    found = diameters(shaft(CRANKSHAFT, sections=without(0, 1, 2, 3, of=PLAIN)))
    assert holds(sections=with_sizes(PLAIN, found))
    series = [round(float(size) * 1e3, 6) for size in SERIES]
    for section, size in enumerate(found):
        thinner = [*found[:section], series[series.index(size) - 1], *found[section + 1 :]]
        assert not holds(sections=with_sizes(PLAIN, thinner))


def test_a_steel_is_taken_at_the_size_that_is_found() -> None:
    steel = {"material": "42CrMo4+QT", "tensile_strength": None, "yield_strength": None}
    given = {key: value for key, value in (CRANKSHAFT | {"sections": without(2)} | steel).items() if value is not None}
    found = calculate(MECHANISM, inputs(MECHANISM, given))
    assert number(found, "tensile_strength") == (1000e6 if max(diameters(found)) <= 40 else 900e6)
    assert number(found, "fatigue_safety") >= 1.5


def test_the_neighbours_in_the_series_are_shown() -> None:
    found = shaft(CRANKSHAFT, sections=without(2, of=PLAIN), required_fatigue_safety=1)
    rows = mechanism.results(found)["size_neighbours"]["rows"]
    size = diameters(found)[2]
    place = [round(float(each) * 1e3, 6) for each in SERIES].index(size)
    assert [row[1] for row in rows] == pytest.approx(SERIES[place - 1 : place + 2])
    assert rows[0][5].startswith("not enough for") and rows[1][5] == "taken"
    alone = shaft(CRANKSHAFT, sections=with_sizes(PLAIN, [45, 55, float(SERIES[place - 1]) * 1e3, 50]))
    assert rows[0][2] == pytest.approx(number(alone, "fatigue_safety"), rel=1e-9)


def test_diameters_that_are_given_are_not_sought() -> None:
    found = shaft(CRANKSHAFT)
    assert diameters(found) == [45, 55, 60, 50]
    assert mechanism.results(found)["size_neighbours"]["rows"] == []


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        (
            {"sections": without(1, 2)},
            "sections.2.diameter",
            "a fillet stands between both, which needs a step; give one of the two",
        ),
        (
            {"sections": without(3), "required_fatigue_safety": 1e5},
            "sections",
            "no preferred one up to 250 mm is enough",
        ),
        ({"sections": []}, "sections", "is empty; give at least one section"),
    ],
)
def test_what_cannot_be_sized_is_told(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as found:
        shaft(CRANKSHAFT, **changes)
    assert any(path == key and words in message for path, message in found.value.reasons)


@pytest.mark.nightly
def test_variants_under_curves_get_their_own_diameters(tmp_path: Path) -> None:
    text = PRESS.replace("length: 60 mm, diameter: 60 mm", "length: 60 mm").replace(", fillet_radius: 2 mm", "")
    text = text.replace("n_points: 720", "n_points: 72") + "    required_fatigue_safety: 1.05\n"
    base = loaded(tmp_path, text)
    alone = [
        Press.read(saved(tmp_path, text.replace("crank_length: 100 mm", f"crank_length: {length} mm")), DISCOVERY)
        .calculate()
        .results
        for length in (80, 300)
    ]
    sizes = [each.mechanisms["crankshaft"].outputs["section_diameter.2"].value for each in alone]
    assert sizes[0] != sizes[1]  # a longer crank has smaller forces in its joints
    saved(tmp_path, base.tree.text)
    study = "schema_version: 1\nbase: press.yaml\nsample: {method: grid}\nvary: {mechanisms.drive.crank_length: [80 mm, 300 mm]}\n"
    columns = calculated(load_study(saved(tmp_path, study, "study.yaml"), Discovery([])), Chunk(0, 0, 2)).columns
    assert list(columns["crankshaft.section_diameter.2"]) == pytest.approx(sizes, rel=1e-12)
    outputs = [each.mechanisms["crankshaft"].outputs for each in alone]
    places = [name for name in outputs[0] if name.startswith(("place_safety.", "place_yield_safety."))]
    assert len(places) == 2 * 9
    for name in places:
        assert list(columns[f"crankshaft.{name}"]) == pytest.approx([each[name].value for each in outputs], rel=1e-9)


def test_the_columns_of_a_study_name_the_safety_at_each_place(tmp_path: Path) -> None:
    known = {column.name: column.description for column in columns_of(loaded(tmp_path, PRESS))}
    assert [name for name in known if "place_safety" in name] == [
        f"crankshaft.place_safety.{index}" for index in range(9)
    ]


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


def turning_shaft(diameters: list[float]) -> ElasticShaft:
    """A plain shaft of 0.5 m with a mass in the middle, a variant for each diameter."""
    ones = np.ones(len(diameters))
    none = np.zeros((1, len(diameters)))
    ends, x = np.outer([0, 0.5], ones), np.outer([0.25], ones)
    places = np.concatenate([x, np.outer([0.05, 0.45], ones)])
    body = Body(ends, np.array([diameters]), none, ("load",), (NO_NOTCH,), places, none, none, none, none, none)
    return ElasticShaft(body, Supports(0.05 * ones, 0.45 * ones), x, 20 * ones[None], 210e9 * ones, 7850 * ones)


def test_variants_of_one_body_among_others_have_the_numbers_of_each_alone() -> None:
    diameters = [0.04, 0.05, 0.04, 0.03, 0.05]
    together = turning_shaft(diameters)
    alone = [turning_shaft([each]) for each in diameters]
    assert together.critical.speed == pytest.approx([each.critical.speed[0] for each in alone], rel=1e-12)
    for index, each in enumerate(alone):
        np.testing.assert_allclose(together.at_joints.slope[:, index], each.at_joints.slope[:, 0], rtol=1e-12)


def test_a_body_that_is_the_same_is_known_already() -> None:
    known = remembered(turning_shaft([0.04]))
    assert remembered(turning_shaft([0.04])) is known
    assert remembered(turning_shaft([0.05])) is not known
    assert remembered(together := turning_shaft([0.04, 0.05])) is together
