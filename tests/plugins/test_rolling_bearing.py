"""Rolling bearings against the method's numbers, limit cases of ISO 281, brute force over the cycle, and other ways to the same life."""

from __future__ import annotations

from itertools import pairwise
from math import gamma, log10, pi, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from diecut_report.machine import mechanism
from diecut_report.machine.steps.run import recalculated
from diecut_report.plugins.rolling_bearing.catalogue import CATALOGUES, bore_of, outside_of
from diecut_report.plugins.rolling_bearing.duty import Duty
from diecut_report.plugins.rolling_bearing.loads import speed_over
from tests.examples import examples
from tests.machines import checks, statuses
from tests.plugins.bearings import (
    ANGULAR,
    BALL,
    JUMPING,
    ROLLER,
    SOUGHT,
    SOUGHT_ROLLER,
    SWINGING,
    WAVING,
    Over,
    bearings,
    one,
    value,
)

HOUR = 3600.0
K = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
E = (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
Y = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)


# --- the method's numbers ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("part", "expected"), [(BALL, (4 / (3 * pi)) ** (1 / 3)), (ROLLER, 0.762979)])
def test_a_rectified_sine_counts_as_its_power_mean(part: dict[str, Any], expected: float) -> None:
    p = 3 if part is BALL else 10 / 3
    by_gamma = (gamma((p + 1) / 2) / (sqrt(pi) * gamma(p / 2 + 1))) ** (1 / p)
    assert by_gamma == pytest.approx(expected, abs=5e-7)
    calc = one(part, radial_force=Over(lambda phi: 5000 * np.sin(phi)))
    assert value(calc, "equivalent_load") / 5000 == pytest.approx(by_gamma, rel=1e-9)
    assert value(calc, "equivalent_load_max") == pytest.approx(5000, rel=1e-9)


def test_two_levels_count_by_the_revolutions_that_they_last() -> None:
    load, speed = (
        Over(lambda phi, a=a, b=b: np.where(phi < pi, a, b), (0.5,)) for a, b in ((2000.0, 1000.0), (10.0, -30.0))
    )
    calc = one(BALL, radial_force=load, speed=speed)
    assert value(calc, "equivalent_load") / 1000 == pytest.approx(((8 + 3) / 4) ** (1 / 3), rel=1e-12)
    assert value(calc, "mean_speed") == pytest.approx(20)


def test_a_swing_of_thirty_degrees_to_either_side_is_a_third_of_a_turn() -> None:
    calc = one(SWINGING)
    assert value(calc, "turns_per_cycle") == pytest.approx(1 / 3, rel=1e-8)
    assert value(calc, "swing") == pytest.approx(pi / 3, rel=1e-8)
    assert value(calc, "mean_speed") == pytest.approx(50 / 3 * 2 * pi / 60, rel=1e-8)


@pytest.mark.parametrize(
    ("axial", "expected"), [(0.05, (0.19, 2.30)), (20, (0.44, 1.00)), (0.345, (0.22, 1.99)), (2.76, (0.36, 1.23))]
)
def test_the_factors_of_the_table_are_held_at_its_ends(axial: float, expected: tuple[float, float]) -> None:
    calc = one(BALL, f0=10, static_rating=10, axial_force=axial * 1000, radial_force=0.1 * axial * 1000)
    assert value(calc, "relative_axial") == pytest.approx(axial)
    assert (value(calc, "axial_limit"), value(calc, "axial_factor")) == pytest.approx(expected)


# --- brute force ---------------------------------------------------------------------------------------------------------


def equivalent(radial: Any, axial: Any, static: float, f0: float) -> Any:
    """The equivalent load of a deep groove ball bearing, by the table once more."""
    ratio = f0 * axial / static
    e, y = np.interp(ratio, K, E), np.interp(ratio, K, Y)
    return np.where(axial <= e * radial, radial, np.maximum(0.56 * radial + y * axial, radial))


def test_the_mean_load_is_that_of_an_adaptive_quadrature() -> None:
    calc = one(WAVING)

    def load(phi: float) -> float:
        return float(equivalent(3000 + 2000 * np.sin(phi), abs(2500 * np.sin(2 * phi)), 21600, 14))

    def speed(phi: float) -> float:
        return float(20 + 10 * np.cos(phi))

    corners = np.linspace(0, 2 * pi, 65)
    pairs = list(pairwise(corners))
    damage = sum(quad(lambda phi: load(phi) ** 3 * speed(phi), low, high, limit=200)[0] for low, high in pairs)
    turned = sum(quad(speed, low, high)[0] for low, high in pairs)
    assert value(calc, "equivalent_load") == pytest.approx((damage / turned) ** (1 / 3), rel=2e-7)
    assert value(calc, "mean_speed") == pytest.approx(turned / (2 * pi), rel=1e-9)
    dense = np.linspace(0, 2 * pi, 2000001)
    loads = equivalent(3000 + 2000 * np.sin(dense), abs(2500 * np.sin(2 * dense)), 21600, 14)
    assert value(calc, "equivalent_load_max") == pytest.approx(loads.max(), rel=1e-8)


waves = st.tuples(*[st.floats(-3000, 3000)] * 5)


def wave(of: tuple[float, ...]) -> Over:
    """A curve of two harmonics."""
    return Over(
        lambda phi: (
            of[0] + of[1] * np.sin(phi) + of[2] * np.cos(phi) + of[3] * np.sin(2 * phi) + of[4] * np.cos(2 * phi)
        )
    )


@given(
    radial=waves.filter(lambda each: sum(map(abs, each)) > 10),
    axial=waves,
    angle=waves.filter(lambda each: sum(map(abs, each[1:])) > 10),
)
@examples(40)
def test_any_load_and_swing_count_as_a_dense_sum_says(
    radial: tuple[float, ...], axial: tuple[float, ...], angle: tuple[float, ...]
) -> None:
    small = tuple(each / 3000 for each in angle)
    calc = one(SWINGING | {"type": "deep_groove", "f0": 14, "static_rating": 21.6, "dynamic_rating": 35.1},
               radial_force=wave(radial), axial_force=wave(axial), relative_angle=wave(small))  # fmt: skip
    phi = np.linspace(0, 2 * pi, 40001)
    theta = wave(small).function(phi)
    middle = (phi[1:] + phi[:-1]) / 2
    forces = [np.abs(wave(each).function(middle)) for each in (radial, axial)]
    loads = equivalent(forces[0], forces[1], 21600, 14)
    way = np.abs(np.diff(theta))
    assert value(calc, "turns_per_cycle") == pytest.approx(way.sum() / (2 * pi), rel=1e-6)
    assert value(calc, "equivalent_load") == pytest.approx((np.sum(loads**3 * way) / way.sum()) ** (1 / 3), rel=3e-6)
    assert value(calc, "equivalent_load_max") == pytest.approx(loads.max(), rel=1e-6)
    static = np.maximum(forces[0], 0.6 * forces[0] + 0.5 * forces[1])
    assert value(calc, "static_load") == pytest.approx(static.max(), rel=1e-6)
    if way.sum() < 2 * pi * 0.999:
        assert value(calc, "swing") == pytest.approx(np.ptp(theta), rel=1e-6)


def test_damage_by_miner_gives_the_same_life() -> None:
    """Half a turn under 4 kN and half a turn under 8 kN use up each its own share of the life under that load."""
    life = [value(one(ROLLER, radial_force=each), "life") for each in (4000, 8000)]
    assert value(one(JUMPING), "life") == pytest.approx(1 / np.mean([1 / each for each in life]), rel=1e-12)


# --- ISO 281 and 76 --------------------------------------------------------------------------------------------------------


def test_a_load_as_great_as_the_rating_lasts_a_million_revolutions() -> None:
    for part in (BALL, ROLLER):
        calc = one(part, radial_force=part["dynamic_rating"] * 1000)
        assert value(calc, "life_revolutions") == pytest.approx(1e6)


@pytest.mark.parametrize(("part", "power"), [(BALL, 3), (ANGULAR | {"axial_force": 0}, 3), (ROLLER, 10 / 3)])
def test_half_the_load_lasts_by_the_life_exponent_longer(part: dict[str, Any], power: float) -> None:
    one_load, half = (value(one(part, radial_force=each), "life") for each in (4000, 2000))
    assert half / one_load == pytest.approx(2**power)


def test_the_equivalent_load_is_never_below_the_radial_force() -> None:
    """Just beyond e the formula would give less than the radial force."""
    calc = one(BALL, radial_force=4000, axial_force=1200, f0=14, static_rating=12)
    assert 0.56 * 4000 + value(calc, "axial_factor") * 1200 < 4000
    assert value(calc, "axial_factor") * 1200 / 4000 > value(calc, "axial_limit")
    assert value(calc, "equivalent_load") == 4000


def test_the_service_factor_counts_in_life_and_safety() -> None:
    plain, shaken = bearings(BALL), bearings(BALL, service_factor=1.5)
    assert value(plain, "life") / value(shaken, "life") == pytest.approx(1.5**3)
    assert value(plain, "static_safety") / value(shaken, "static_safety") == pytest.approx(1.5)


def test_an_angular_contact_bearing_counts_by_its_own_factors() -> None:
    calc = one(ANGULAR)
    assert value(calc, "equivalent_load") == pytest.approx(0.35 * 2000 + 0.57 * 3000)
    assert value(calc, "static_load") == pytest.approx(max(2000, 0.5 * 2000 + 0.26 * 3000))


def test_signs_of_forces_do_not_count() -> None:
    calc = one(BALL, radial_force=-4000, axial_force=-900, speed=-300)
    other = one(BALL, radial_force=4000, axial_force=900, speed=300)
    assert value(calc, "life") == value(other, "life")


def test_reliability_and_lubrication_multiply_the_life() -> None:
    calc = bearings(BALL | {"a_iso": 2.5}, reliability=99)
    assert value(calc, "life_modified") / value(calc, "life") == pytest.approx(0.25 * 2.5)


def test_all_bearings_together_live_as_weibull_says() -> None:
    calc = bearings(BALL, ROLLER, ANGULAR)
    lives = [value(calc, "life_modified", part) for part in range(3)]
    assert value(calc, "system_life") == pytest.approx(sum(each ** (-10 / 9) for each in lives) ** (-9 / 10))
    least = int(np.argmin(lives))
    assert value(calc, "life_min") == lives[least]
    assert calc["governing_bearing"][0, 0] == ("ball", "roller", "angular")[least]
    survives = [0.9 ** ((value(calc, "system_life") / each) ** (10 / 9)) for each in lives]
    assert np.prod(survives) == pytest.approx(0.9)


def test_a_bearing_that_stands_has_a_static_safety_alone() -> None:
    calc = bearings(BALL | {"speed": 0}, ROLLER)
    assert np.isnan(value(calc, "life_modified")) and value(calc, "static_safety") == pytest.approx(5.4)
    assert value(calc, "life_min") == value(calc, "life_modified", 1) == value(calc, "system_life")
    assert "ball_life" not in checks(calc)
    alone = one(BALL, speed=0)
    assert np.isnan(value(alone, "life_min")) and alone["governing_bearing"][0, 0] == "none"


# --- the table ---------------------------------------------------------------------------------------------------------------


SERIES = {
    "60": SOUGHT,
    "62": SOUGHT,
    "63": SOUGHT,
    "NU2": SOUGHT_ROLLER,
    "NU22": SOUGHT_ROLLER,
    "NU3": SOUGHT_ROLLER,
    "NU23": SOUGHT_ROLLER,
}
USUAL_SAFETY = {"deep_groove": 1, "roller": 1.5}


def designations(series: str) -> list[str]:
    """The bearings of a series by how they are called: 62 of 6209, NU2 of NU209E, where NU2209E is of NU22."""
    suffix = "E" if series.startswith("NU") else ""
    table = CATALOGUES[SERIES[series]["type"]].names
    return [f"{series}{bore:02d}{suffix}" for bore in range(21) if f"{series}{bore:02d}{suffix}" in table]


@given(
    radial=st.floats(500, 9000),
    axial=st.floats(0, 4000),
    speed=st.floats(20, 800),
    series=st.sampled_from([*SERIES]),
)
@examples(4)
def test_the_smallest_bearing_that_holds_is_taken(radial: float, axial: float, speed: float, series: str) -> None:
    """Each of the series, given by its designation, fails if it is smaller and holds if it is the one."""
    sought = SERIES[series]
    is_ball = sought is SOUGHT
    keys = {"radial_force": radial * (1 if is_ball else 6), "axial_force": axial if is_ball else 0, "speed": speed}

    def holds(name: str) -> bool:
        calc = one(sought | keys | {"designation": name})
        return (
            value(calc, "life_modified") >= 20000 * HOUR
            and value(calc, "static_safety") >= USUAL_SAFETY[sought["type"]]
        )

    expected = next((name for name in designations(series) if holds(name)), None)
    if expected is not None:
        calc = one(sought | keys | {"series": series})
        assert calc["designations"][0, 0] == f"{sought['name']} {expected}"


def test_a_series_has_all_its_bearings_in_the_order_of_their_bores() -> None:
    for series, sought in SERIES.items():
        assert list(CATALOGUES[sought["type"]].of_series(series)) == designations(series)


@pytest.mark.parametrize(
    ("sought", "names"),
    [("6220", ["6219", "6220"]), ("NU204E", ["NU204E", "NU205E"]), ("NU305E", ["NU304E", "NU305E", "NU306E"])],
)
def test_a_bearing_of_the_table_is_shown_between_its_neighbours_of_the_series(sought: str, names: list[str]) -> None:
    kind = SOUGHT_ROLLER if sought.startswith("NU") else SOUGHT
    rows = mechanism.results(one(kind, designation=sought))["choice"]["rows"]
    assert [row[1] for row in rows] == names
    assert [row[1] for row in rows if row[2] == "yes"] == [sought]


def test_without_a_series_balls_are_sought_in_62_and_rollers_in_nu2() -> None:
    calc = bearings(SOUGHT, SOUGHT_ROLLER)
    ball, roller = str(calc["designations"][0, 0]).split(", ")
    assert (
        ball.startswith("sought 62")
        and roller.startswith("sought_roller NU2")
        and not roller.startswith("sought_roller NU22")
    )
    assert value(one(SOUGHT_ROLLER, designation="NU 2208 E"), "dynamic_rating") == pytest.approx(72300)


def test_the_life_check_advises_a_rating_that_is_enough() -> None:
    short = one(BALL, radial_force=9000)
    needed = value(short, "rating_needed")
    assert statuses(short)["ball_life"] == "fail"
    assert statuses(one(BALL, radial_force=9000, dynamic_rating=needed * 1.0001 / 1e3))["ball_life"] == "pass"
    assert log10(needed) < 6


NSK_62 = {  # bore, outside, width in mm; ratings in kN; f0
    "6200": (10, 30, 9, 5.1, 2.39, 13.2), "6204": (20, 47, 14, 12.8, 6.6, 13.1), "6206": (30, 62, 16, 19.5, 11.3, 13.8),
    "6208": (40, 80, 18, 29.1, 17.9, 14.0), "6209": (45, 85, 19, 31.5, 20.4, 14.4), "6212": (60, 110, 22, 52.5, 36, 14.3),
    "6216": (80, 140, 26, 72.5, 53, 14.6), "6220": (100, 180, 34, 122, 93, 14.4),
}  # fmt: skip
SKF_62 = {
    "6200": (5.4, 2.36),
    "6204": (13.5, 6.55),
    "6206": (20.3, 11.2),
    "6208": (32.5, 19),
    "6209": (35.1, 21.6),
    "6212": (55.3, 36),
}


NSK_ROLLERS = {  # designs EW and ET: bore, outside, width in mm; ratings in kN
    "NU205E": (25, 52, 15, 29.3, 27.7), "NU2205E": (25, 52, 18, 35.0, 34.5), "NU305E": (25, 62, 17, 41.5, 37.5),
    "NU2305E": (25, 62, 24, 57.0, 56.0), "NU206E": (30, 62, 16, 39.0, 37.5), "NU2206E": (30, 62, 20, 49.0, 50.0),
    "NU306E": (30, 72, 19, 53.0, 50.0), "NU2306E": (30, 72, 27, 74.5, 77.5), "NU207E": (35, 72, 17, 50.5, 50.0),
    "NU2207E": (35, 72, 23, 61.5, 65.5), "NU307E": (35, 80, 21, 66.5, 65.5), "NU2307E": (35, 80, 31, 93.0, 101.0),
}  # fmt: skip


def test_rollers_have_the_dimensions_and_not_more_than_the_ratings_of_a_maker_that_the_table_was_not_made_of() -> None:
    table = CATALOGUES["roller"].table
    for name, (*sizes, dynamic, static) in NSK_ROLLERS.items():
        row = [table.by_name(column)[name] for column in ("d", "D", "B", "C", "C0")]
        assert row[:3] == sizes
        for own, makers in zip(row[3:], (dynamic, static), strict=True):
            assert makers * 0.95 <= own <= makers * 1.005


def test_the_table_has_the_dimensions_and_not_more_than_the_ratings_of_the_makers() -> None:
    table = CATALOGUES["deep_groove"].table
    for name, (*sizes, dynamic, static, f0) in NSK_62.items():
        row = [table.by_name(column)[name] for column in ("d", "D", "B", "C", "C0", "f0")]
        assert row[:3] == sizes
        for own, makers in zip(row[3:], (dynamic, static, f0), strict=True):
            assert makers * 0.95 <= own <= makers
    for name, ratings in SKF_62.items():
        assert all(table.by_name(key)[name] <= rating for key, rating in zip(("C", "C0"), ratings, strict=True))


# least corners of the inner rings by the number of the bore, 00 to 20 (NKE, rolling bearings, catalogue)
NKE_CORNERS = {
    "60": "0.3 0.3 0.3 0.3 0.6 0.6 1 1 1 1 1 1.1 1.1 1.1 1.1 1.1 1.1 1.1 1.5 1.5 1.5",
    "62": "0.6 0.6 0.6 0.6 1 1 1 1.1 1.1 1.1 1.1 1.5 1.5 1.5 1.5 1.5 2 2 2 2.1 2.1",
    "63": "0.6 1 1 1 1.1 1.1 1.1 1.5 1.5 1.5 2 2 2.1 2.1 2.1 2.1 2.1 3 3 3 3",
    "NU2": "0.6 0.6 0.6 0.6 1.1 1.1 1.1 1.1 1.5 1.5 1.5 1.5 2 2 2 2.1 2.1",
    "NU22": "0.6 0.6 0.6 0.6 1.1 1.1 1.1 1.1 1.5 1.5 1.5 1.5 2 2 2 2.1 2.1",
    "NU3": "0.6 1.1 1.1 1.1 1.5 1.5 2 2 2.1 2.1 2.1 2.1 2.1 3 3 3 3",
    "NU23": "0.6 1.1 1.1 1.1 1.5 1.5 2 2 2.1 2.1 2.1 2.1 2.1 3 3 3 3",
}


def test_the_corners_of_the_rings_are_those_of_a_second_maker() -> None:
    for kind, suffix in (("deep_groove", ""), ("roller", "E")):
        corners = CATALOGUES[kind].table.by_name("r")
        typed = {
            f"{series}{number:02}{suffix}": float(corner)
            for series, text in NKE_CORNERS.items()
            if series.startswith("NU") is (kind == "roller")
            for number, corner in enumerate(text.split(), 4 if kind == "roller" else 0)
        }
        assert corners == typed


def test_larger_bearings_of_a_series_bear_more() -> None:
    """So that the first of a series that holds is the smallest; the last two of series 60 are alike but for their bore."""
    for series, sought in SERIES.items():
        catalogue = CATALOGUES[sought["type"]]
        for key in ("C", "C0"):
            ratings = [catalogue.size(key, name) for name in catalogue.of_series(series)]
            assert all(b > a * 0.99 for a, b in pairwise(ratings))


@pytest.mark.parametrize(
    ("designation", "bore"),
    [
        ("6209", 45), ("6000", 10), ("6203-2RS1", 17), ("NU 2208", 40), ("nu2208e", 40), ("NJ 310 ECP", 50), ("22212", 60), ("2208", 40),
        ("7210", 50), ("HK 2020", 0), ("", 0), (None, 0), ("62", 0), ("62091", 0),
    ],
)  # fmt: skip
def test_a_designation_tells_the_bore(designation: str | None, bore: float) -> None:
    """By the bore codes of ISO 15."""
    assert bore_of(designation) == pytest.approx(bore * 1e-3)


def test_a_designation_tells_the_outside_diameter_of_each_bearing_of_the_tables() -> None:
    for catalogue in CATALOGUES.values():
        assert [outside_of(name) for name in catalogue.names] == [catalogue.size("D", name) for name in catalogue.names]


@pytest.mark.parametrize(
    ("designation", "outside"),
    [
        ("16012", 95), ("NU 1012", 95), ("23012", 95), ("7209 B", 85), ("NJ 2209 ECP", 85), ("22212", 110), ("2208", 80), ("21312", 130),
        ("1308", 90), ("6409", 0), ("16112", 0), ("7224", 0), ("NA 4909", 0), ("HK 2020", 0), ("", 0), (None, 0),
    ],
)  # fmt: skip
def test_a_designation_tells_the_outside_diameter(designation: str | None, outside: float) -> None:
    """By the diameter series of ISO 15: the diameters are those that makers print."""
    assert outside_of(designation) == pytest.approx(outside * 1e-3)


def test_the_mean_diameter_of_machines_of_a_study_is_that_of_the_bearing_which_each_takes() -> None:
    made = recalculated(one(SOUGHT, axial_force=0), {"bearings.radial_force": (np.array([300.0, 3000.0, 9000.0]),)}, 3)
    assert made is not None
    table = CATALOGUES["deep_groove"]
    means = {
        rating: (table.size("d", name) + table.size("D", name)) / 2
        for name in table.of_series("62")
        for rating in [table.size("C", name)]
    }
    taken = made["dynamic_rating"][:, 0].tolist()
    assert len(set(taken)) == 3
    assert made["mean_diameter"][:, 0].tolist() == pytest.approx([means[rating] for rating in taken])


class AngleOfTwoLines:
    """A relative angle that is two straight lines, each of which goes on beyond its piece."""

    breakpoints = joints = np.array([[0.5]])

    def values(self, share: Any, middle: Any, rows: Any) -> Any:
        """Up with 2 in the first half, down with 1 in the second."""
        return np.where(middle < 0.5, 2 * share, 1.5 - share)


def duty(**changes: Any) -> Duty:
    """A bearing of a single machine under a constant force."""
    one = np.ones((1, 1))
    return Duty(
        **(
            {"radial": one, "axial": 0 * one, "speed": None, "angle": AngleOfTwoLines(), "factor": one, "variants": 1}
            | changes
        )
    )


def test_the_angle_at_the_end_of_the_cycle_is_that_of_its_last_piece() -> None:
    found = [duty()._angle_at(np.full((1, 1), share))[0, 0] for share in (0.0, 1.0)]
    assert found == pytest.approx([0.0, 0.5], abs=1e-12)  # by the first piece's line the end would be 2


def test_all_peaks_of_a_curve_are_looked_at_together() -> None:
    """Each look at a curve costs about the same, be it at one place or at many."""
    looks: list[tuple[int, ...]] = []

    class Waves:
        breakpoints = joints = np.empty((1, 0))

        def values(self, share: Any, middle: Any, rows: Any) -> Any:
            looks.append(share.shape)
            return 2 + np.sin(10 * np.pi * share) + 0.1 * np.sin(2 * np.pi * share - 0.2)

    of_waves = duty(radial=Waves(), speed=np.ones((1, 1)), angle=None)
    first = of_waves.first
    looks.clear()
    radial, _ = of_waves.greatest(lambda radial, _: radial, first)
    assert len(looks) <= 5
    fine = np.linspace(0, 1, 200_001)
    expected = np.max(2 + np.sin(10 * np.pi * fine) + 0.1 * np.sin(2 * np.pi * fine - 0.2))
    assert radial[0, 0] == pytest.approx(expected, rel=1e-9)


def test_the_neighbours_of_a_place_lie_in_its_own_piece() -> None:
    share = np.array([[[0.0, 0.1, 0.2], [0.2, 0.6, 1.0]]])
    for index, expected in (
        (0, (0.0, 0.0, 0.1, 0.1)),
        (2, (0.2, 0.1, 0.2, 0.1)),
        (3, (0.2, 0.2, 0.6, 0.6)),
        (4, (0.6, 0.2, 1.0, 0.6)),
    ):
        found = duty()._about(np.array([0]), np.array([index]), share)
        assert [each[0, 0] for each in found] == pytest.approx(expected)


def test_the_speed_of_a_bearing_is_asked_for_at_shares_of_its_cycle() -> None:
    asked: list[Any] = []

    class NotedSpeeds:
        """Notes what it is asked for."""

        def speed(self, *given: Any) -> Any:
            asked.append(given)
            return 0

    speed_over(3, NotedSpeeds(), np.array([[np.pi]]), np.array([[3 * np.pi / 2]]), None)  # type: ignore[arg-type]
    assert asked == [(3, 0.5, 0.75, None)]
