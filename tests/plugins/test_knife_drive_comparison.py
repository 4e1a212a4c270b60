"""What the folding knife's report says: comparison, verdicts, checks, refusals, figures, the example."""

from __future__ import annotations

import re
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest

from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.knife_drive import MECHANISM
from diecut_report.results.checks import check_results
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
from tests.configs import EXAMPLES
from tests.machines import inputs, made_possible, number
from tests.plugins.test_knife_drive import DRIVES, INNER, LINKAGE, OUTER, PLANETARY, SLIDER, at, knife

BLOCKS = {"planetary": PLANETARY, "crank_slider": SLIDER, "crank_rocker": INNER}
EVERY = PLANETARY | SLIDER | INNER


def word(calc: Calculation, name: str) -> str:
    return str(calc[name][0, 0])


@pytest.mark.parametrize("names", [n for size in (1, 2, 3) for n in combinations(DRIVES, size)], ids="+".join)
@pytest.mark.parametrize("depth", [20, 40])
def test_the_best_drive_has_the_least_peak_of_those_given(names: tuple[str, ...], depth: float) -> None:
    calc = knife(**{key: part for name in names for key, part in BLOCKS[name].items()}, working_depth=depth)
    peaks = {name: number(calc, f"{name}_acceleration_peak") for name in names}
    best = min(peaks, key=lambda name: peaks[name])
    assert word(calc, "best_drive") == best
    assert best.replace("_", "-") in word(calc, "verdict")
    for name in names if len(names) > 1 else ():
        for what in (
            "stroke",
            "working_time",
            "contact_velocity",
            "acceleration_peak",
            "acceleration_end",
            "end_factor",
            "grip_size",
        ):
            ratio = number(calc, f"{name}_{what}") / number(calc, f"{best}_{what}")
            assert number(calc, f"{name}_{what}_ratio") == pytest.approx(ratio, rel=1e-12)
    others = [peaks[name] for name in names if name != "planetary"]
    if "planetary" in names and others:
        assert number(calc, "acceleration_ratio_planetary") == pytest.approx(
            peaks["planetary"] / min(others), rel=1e-12
        )
    else:
        assert "acceleration_ratio_planetary" not in calc.values


def test_the_planetary_drive_is_the_best_one_where_it_is_small() -> None:
    calc = knife(planetary={"carrier_radius": 10.5}, **SLIDER, **INNER)
    assert word(calc, "best_drive") == "planetary"
    assert number(calc, "acceleration_ratio_planetary") < 1


def test_what_the_paper_stands_is_said() -> None:
    assert "and its acceleration is allowed" in word(knife(**EVERY), "verdict")
    assert "too, is above the allowed" in word(knife(**EVERY, allowable_paper_acceleration=100), "verdict")
    assert "given; its acceleration is allowed" in word(knife(**PLANETARY), "verdict")
    assert "above the allowed" in word(knife(**PLANETARY, allowable_paper_acceleration=999), "verdict")


def test_stroke_or_kind_of_drive_is_named_as_the_reason() -> None:
    assert word(knife(**EVERY), "reason") == "mostly its stroke"
    equal = knife(**PLANETARY, crank_slider={"crank_radius": 131.312, "rod_length": 300})
    assert word(equal, "reason") == "mostly the kind of drive"


def test_stroke_times_factor_is_the_acceleration_at_the_lowest_point() -> None:
    calc = knife(**EVERY)
    shares = number(calc, "stroke_ratio_planetary") * number(calc, "factor_ratio_planetary")
    ends = number(calc, "planetary_acceleration_end") / number(calc, "crank_rocker_acceleration_end")
    assert shares == pytest.approx(ends, rel=1e-12)


def test_what_asks_more_of_the_paper_is_named() -> None:
    assert word(knife(**EVERY), "grip_verdict").startswith("the grip of the rollers")
    slow = knife(**EVERY, roller_diameter=2)
    assert number(slow, "crank_rocker_grip_size") < number(slow, "crank_rocker_acceleration_peak")
    assert word(slow, "grip_verdict").startswith("the knife")


def test_each_drive_has_its_checks_and_only_the_drives_that_are_given() -> None:
    ids = [check.id for check in check_results(knife(**PLANETARY, **INNER))]
    what = ("paper_acceleration", "grip_acceleration", "depth")
    every = (*what, "time_budget")  # not checked: the signature's length is not given
    assert set(ids) == {"in_step"} | {f"{drive}_{name}" for drive in ("planetary", "crank_rocker") for name in every}
    timed = {c.id: c for c in check_results(knife(**PLANETARY, signature_length=800))}["planetary_time_budget"]
    assert timed.status == "fail"
    assert timed.utilisation == pytest.approx((0.0091885 + 0.76 / 6.981317) / 0.072, rel=1e-4)


@pytest.mark.parametrize(
    "keys, key, words",
    [
        ({}, "planetary", "at least one of the blocks planetary, crank_slider and crank_rocker"),
        ({"crank_slider": {"crank_radius": 35, "rod_length": 35}}, "crank_slider.rod_length", "not longer than the crank_radius"),
        ({"planetary": {"carrier_radius": 9}}, "working_depth", "never rise above the table"),
        ({"crank_slider": {"crank_radius": 19, "rod_length": 90}}, "working_depth", "travels 38 mm in all"),
        (OUTER | {"working_depth": 60}, "working_depth", "longer knife_arm"),
        ({"crank_rocker": LINKAGE | {"crank": 85}}, "crank_rocker.crank", "Grashof"),
        ({"crank_rocker": LINKAGE | {"frame": 180}}, "crank_rocker.crank", "frame = 180 mm"),
        ({"crank_rocker": LINKAGE | {"frame": 200}}, "crank_rocker.crank", "shorter than the other two together"),
        (PLANETARY | {"working_depth": 0.2}, "grip_angle", "before the knife meets the signature"),
        (PLANETARY | {"working_depth": 0.2}, "grip_angle", "make grip_angle at most 3.162°"),
        (OUTER | {"working_depth": 60}, "working_depth", "at most 55.44 mm"),
        (PLANETARY | {"signature_length": 40}, "signature_length", "make signature_length greater than that"),
    ],
)  # fmt: skip
def test_an_impossible_knife_is_refused_in_words(keys: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        knife(**keys)
    assert refused.value.key == key
    assert words in refused.value.message


@pytest.mark.parametrize(
    "link, length, limit",
    [("crank", 85, 80 + 110 - 120), ("frame", 200, 110 + 80 - 20)],
)  # fmt: skip
def test_a_link_that_lets_the_crank_turn_fully_is_named(link: str, length: float, limit: float) -> None:
    """By Grashof: the shortest and the longest link are together shorter than the other two."""
    changed = {link: length}
    ways = made_possible(MECHANISM, {"working_depth": 40, "crank_rocker": LINKAGE | changed}, "crank_rocker.crank")
    (told,) = [way for way in ways if way.startswith(f"set crank_rocker.{link} to")]
    low, high = (float(end) for end in re.findall(r"([\d.]+) mm", told))
    assert low < high < limit
    for end in (low, high):
        knife(crank_rocker=LINKAGE | {link: end})


def test_every_drive_that_would_be_gripped_too_early_is_told_at_once() -> None:
    with pytest.raises(Impossible) as refused:
        knife(**EVERY, grip_angle=130)
    told = [message for key, message in refused.value.reasons if key == "grip_angle"]
    for drive in ("planetary drive", "crank-slider", "crank-rocker"):
        assert any(f"working stroke of the {drive} is" in message for message in told)


def test_a_depth_beyond_stroke_and_signature_is_told_for_both() -> None:
    with pytest.raises(Impossible) as refused:
        knife(**PLANETARY, working_depth=300, signature_length=273)
    assert [key for key, _ in refused.value.reasons] == ["working_depth", "signature_length"]


def drawn(calc: Calculation) -> dict[str, FigureRecord]:
    return {figure.id: figure for figure in figures(calc)}


def test_the_working_stroke_is_shaded_from_contact_to_the_lowest_point() -> None:
    calc = knife(**PLANETARY, **SLIDER, **OUTER, working_depth=30)
    found = drawn(calc)
    for drive in DRIVES:
        fills = found[f"{drive}_motion"].panels[1].fills[0]
        shaded = np.array([x for x, y in zip(fills.x, fills.y, strict=True) if y is not None])
        lowest, angle = number(calc, f"{drive}_lowest_angle"), number(calc, f"{drive}_working_angle")
        back = np.mod(lowest - shaded + 1e-6, 2 * np.pi) - 1e-6
        assert back.min() == pytest.approx(0, abs=1e-9) and back.max() == pytest.approx(angle, abs=1e-9)
        assert len(shaded) == pytest.approx(angle / (2 * np.pi) * 721, abs=4)


def test_all_drives_stand_still_at_the_common_origin() -> None:
    panel = drawn(knife(**EVERY))["from_lowest"].panels[0]
    for line in panel.lines[:3]:
        assert np.interp(0.0, line.x, line.y) == pytest.approx(0, abs=0.02)
        assert np.interp(-0.5, line.x, line.y) > 0.9
    assert panel.lines[3].y[0] == pytest.approx(0.08 * 2 * np.pi * 50000 / 3600)


def test_a_long_signature_does_not_stretch_the_comparison() -> None:
    for length, last in ((273, (0.273 - 0.04) / 0.08), (2000, None)):
        panel = drawn(knife(**EVERY, signature_length=length))["from_lowest"].panels[0]
        ends = {line.label: line.x[-1] for line in panel.lines}
        assert ends["rollers"] == pytest.approx(last or ends["crank-rocker"])
        assert ["off the table" in place.label for place in panel.verticals] == [False, True][: 1 + (length == 273)]


def test_the_differences_of_the_first_order_form_are_drawn() -> None:
    calc = knife(**SLIDER)
    exact, *errors = drawn(calc)["crank_slider_first_order"].panels
    assert [line.label for line in exact.lines] == ["exact", "first order"]
    for panel, name in zip(errors, ("displacement", "velocity", "acceleration"), strict=True):
        assert np.abs(panel.lines[0].y).max() == pytest.approx(
            number(calc, f"crank_slider_{name}_difference"), rel=1e-3
        )


def test_the_lines_over_the_stroke_pass_through_the_machines() -> None:
    panel = drawn(knife(**EVERY))["over_stroke"].panels[0]
    for line, mark in zip(panel.lines, panel.marks, strict=True):
        assert np.interp(mark.x, line.x, line.y) == pytest.approx(mark.y, rel=1e-6)
        slopes = np.array(line.y) / np.array(line.x)
        np.testing.assert_allclose(slopes, slopes[0], rtol=1e-9)


def test_the_table_holds_the_numbers_and_their_ratios() -> None:
    boxes = drawn(knife(**EVERY))["comparison"].shapes
    cells = [line for box in boxes for line in box.lines]
    assert "planetary drive" in cells and "crank-rocker" in cells
    assert "1000 m/s² (× 6.00)" in cells and "262.6 mm (× 4.74)" in cells
    timed = [line for box in drawn(example())["comparison"].shapes for line in box.lines]
    assert "42.56 ms of 72 ms" in timed
    assert "0.7894 (× 1.00)" in cells and "6815 m/s² (× 1.00)" in cells
    assert "crank-rocker is gentlest on the paper, and its acceleration is allowed" in " ".join(cells)
    assert "6.00 = 4.74 (stroke) × 1.27 (factor); mostly its stroke." in " ".join(cells)
    alone = [line for box in drawn(knife(**PLANETARY))["comparison"].shapes for line in box.lines]
    assert "262.6 mm" in alone


@pytest.mark.parametrize("keys", [OUTER, INNER], ids=["outer", "inner"])
def test_the_drawn_linkage_has_its_lengths_and_its_edge_travels_down_to_the_table_and_below(
    keys: dict[str, Any],
) -> None:
    calc = knife(**keys)
    chains = [np.array(s.points) for s in drawn(calc)["crank_rocker_drive"].shapes
              if s.shape == "polyline" and len(s.points) == 5]  # fmt: skip
    assert len(chains) == 3
    for chain in chains:
        lengths = [float(np.hypot(*(two - one))) for one, two in pairwise(chain)]
        assert lengths == pytest.approx([0.02, 0.11, 0.08, 0.107], abs=1e-4)
    contact, high, low = (chain[4, 1] for chain in chains)
    assert low == pytest.approx(0, abs=1e-9)
    assert contact == pytest.approx(0.107 * np.sin(0.04 / 0.107), rel=1e-4)
    assert high > contact


@pytest.mark.parametrize("drive, links", [("planetary", [65.656, 65.656]), ("crank_slider", [35, 140, 80])])
def test_the_drawn_straight_line_drives_have_their_lengths(drive: str, links: list[float]) -> None:
    shapes = drawn(knife(**PLANETARY, **SLIDER))[f"{drive}_drive"].shapes
    chains = [np.array(s.points) for s in shapes if s.shape == "polyline" and len(s.points) == len(links) + 1]
    for chain in chains:
        assert [1e3 * float(np.hypot(*(b - a))) for a, b in pairwise(chain)] == pytest.approx(links)
    contact, _, lowest = (chain[-1] for chain in chains)
    assert contact[1] - lowest[1] == pytest.approx(0.04, rel=1e-9)


def example() -> Calculation:
    """The knife of the example."""
    return knife(**EVERY, signature_length=273)


def test_the_example_is_the_machine_of_these_tests() -> None:
    text = next(path for path in EXAMPLES if path.name == "folding_knife.yaml").read_text("utf-8")
    for said in (
        "carrier_radius: 65.656 mm",
        "crank_radius: {value: 35 mm",
        "rod_length: {value: 140 mm",
        "knife_arm: {value: 107 mm",
        "working_depth: {value: 40 mm",
    ):
        assert said in text


def test_the_example_shows_accelerations_three_to_six_times_lower_and_strokes_about_as_much_shorter() -> None:
    calc = example()
    for drive, lower, shorter in (("crank_slider", 3.0, 3.75), ("crank_rocker", 6.0, 4.74)):
        peaks = number(calc, "planetary_acceleration_peak") / number(calc, f"{drive}_acceleration_peak")
        strokes = number(calc, "planetary_stroke") / number(calc, f"{drive}_stroke")
        assert peaks == pytest.approx(lower, abs=0.01)
        assert strokes == pytest.approx(shorter, abs=0.01)
        assert 3 <= round(peaks, 1) <= 6 and 3 <= strokes <= 6


def test_the_examples_planetary_drive_is_harshest_in_all_that_the_paper_names() -> None:
    calc = example()
    for drive in ("crank_slider", "crank_rocker"):
        assert number(calc, "planetary_working_time") < number(calc, f"{drive}_working_time")
        assert number(calc, "planetary_contact_velocity") > number(calc, f"{drive}_contact_velocity")
        assert number(calc, "planetary_acceleration_end") > number(calc, f"{drive}_acceleration_end")
        contact = [
            abs(at(calc, f"{d}_acceleration", np.array([number(calc, f"{d}_contact_angle")]))[0])
            for d in ("planetary", drive)
        ]
        assert contact[0] > contact[1]


def test_a_knife_without_a_drive_says_so_once() -> None:
    with pytest.raises(Impossible) as refused:
        calculate(MECHANISM, inputs(MECHANISM, {"working_depth": 40}))
    assert len(refused.value.reasons) == 1
