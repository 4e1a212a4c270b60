"""Roller chains: numbers of the method, brute force over the loop and the cycle, the choice of a chain."""

from __future__ import annotations

from math import cos, hypot, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest

from diecut_report.plugins.roller_chain import steps
from diecut_report.plugins.roller_chain.chains import CHAINS
from tests.machines import number
from tests.plugins.chains import CUSTOM, DRIVE, GRIPPERS, RATED, UNEVEN, chain, without

GRAVITY = 9.80665


@pytest.mark.parametrize(
    ("name", "expected"),
    [("sprocket_diameter_1", 0.1157389), ("velocity", 1.80975), ("useful_tension", 3456.054), ("centrifugal_tension", 3.7665),
     ("sag_tension", 42.2912), ("chordal_tension", 6.4866), ("tension_peak", 3508.5986), ("links_exact", 81.992126)],
)  # fmt: skip
def test_the_drive_of_the_method_has_its_numbers(name: str, expected: float) -> None:
    assert number(chain(), name) == pytest.approx(expected, rel=1e-5)


def test_the_bearing_areas_are_those_of_the_method() -> None:
    areas = [number(chain(chain=name), "bearing_area") * 1e6 for name in CHAINS.names]
    assert areas == pytest.approx([48.73, 66.29, 87.97, 209.65, 291.03, 547.16], abs=6e-3)


# --- the loop --------------------------------------------------------------------------------------------------------


def walked(center: float, pitch: float, teeth: tuple[int, int]) -> float:
    """Links by brute force: the direction in which both circles reach equally far is found by halving; there the straight run touches."""
    first, second = (pitch / sin(pi / count) / 2 for count in teeth)
    low, high = 0.0, pi  # of the normal from the line through the axes
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if center * cos(middle) + second > first else (low, middle)
    run = hypot(center + (second - first) * cos(low), (second - first) * sin(low))
    return 2 * run / pitch + teeth[0] * (pi - low) / pi + teeth[1] * low / pi


def polygon(center: float, pitch: float, teeth: tuple[int, int]) -> float:
    """The same by the program's formula."""
    diameters = [pitch / sin(pi / count) for count in teeth]
    return float(steps.polygon_links(center, pitch, *teeth, *diameters))


def test_the_links_by_formula_and_polygon_are_those_of_the_method() -> None:
    assert float(steps.exact_links(600, 19.05, 17, 38)) == pytest.approx(90.846794, abs=1e-6)
    assert polygon(600, 19.05, (17, 38)) == pytest.approx(90.847126, abs=1e-6)
    assert polygon(600, 19.05, (19, 19)) == pytest.approx(81.992126, abs=1e-6)


@pytest.mark.parametrize(("center", "teeth"), [(600, (17, 38)), (600, (38, 17)), (900, (11, 120)), (400, (19, 19))])
def test_the_polygon_is_that_of_the_taut_chain(center: float, teeth: tuple[int, int]) -> None:
    assert polygon(center, 19.05, teeth) == pytest.approx(walked(center, 19.05, teeth), rel=1e-12)


def test_whole_links_give_back_the_distance_of_the_axes() -> None:
    found = chain(without(DRIVE, "center_distance"), teeth_1=17, teeth_2=38, links=100)
    center = number(found, "center_distance_adjusted")
    assert center == pytest.approx(0.6876147, abs=1e-7)
    assert walked(center, 0.01905, (17, 38)) - 100 == pytest.approx(2.2e-4, abs=1e-5)
    assert number(found, "links_residual") == pytest.approx(2.2e-4, abs=1e-5)


@pytest.mark.parametrize("center", [381.0, 600.0, 771.525])
def test_links_are_even_and_a_chain_that_fits_exactly_takes_no_more(center: float) -> None:
    found = chain(center_distance=center)
    links = number(found, "links")
    assert links % 2 == 0
    assert 0 <= links - number(found, "links_exact") + 1e-9 < 2
    assert number(chain(center_distance=number(found, "center_distance_adjusted") * 1e3), "links") == links


def test_the_wrap_is_what_the_taut_chain_leaves_on_the_smaller_sprocket() -> None:
    found = chain(teeth_1=17, teeth_2=57)
    run = (walked(0.6, 0.01905, (17, 57)) - 17 * number(found, "wrap_small") / (2 * pi)
           - 57 * (2 * pi - number(found, "wrap_small")) / (2 * pi)) * 0.01905 / 2  # fmt: skip
    radii = (number(found, "sprocket_diameter_2") - number(found, "sprocket_diameter_1")) / 2
    assert run == pytest.approx(sqrt(0.6**2 - radii**2), rel=1e-9)


# --- chordal action --------------------------------------------------------------------------------------------------


def test_the_mean_velocity_of_the_polygon_is_that_of_the_pitches() -> None:
    found = chain(teeth_1=17)
    assert number(found, "speed_unevenness") == pytest.approx(0.01702690, abs=1e-8)
    turned = (np.arange(100_000) + 0.5) / 100_000 * 2 * pi / 17 - pi / 17
    mean = float(np.mean(number(found, "velocity_max") * np.cos(turned)))
    assert mean == pytest.approx(number(found, "velocity"), rel=1e-9)
    assert number(found, "velocity") / number(found, "velocity_max") == pytest.approx(0.9943179, abs=1e-7)


def test_the_step_of_the_acceleration_is_that_of_the_joint_that_leaves_and_the_one_that_comes() -> None:
    found, h = chain(), 1e-5
    speed, half = number(found, "angular_speed"), pi / 19
    velocity = number(found, "velocity_max") * np.cos([half - h, half, -half, -half + h])
    before, after = (velocity[1] - velocity[0]) / h * speed, (velocity[3] - velocity[2]) / h * speed
    assert (after - before) / 2 == pytest.approx(number(found, "chordal_acceleration"), rel=1e-4)


# --- tension over the cycle ------------------------------------------------------------------------------------------


def swept(keys: dict[str, Any], pitch: float, mass: float, count: int = 360_000) -> np.ndarray:
    """Tension of a conveyor's strand by brute force at many places of the cycle; the loop has equal sprockets."""
    places = np.arange(count) / count

    def over(name: str) -> np.ndarray:
        given = keys.get(f"{name}_curve")
        if given is None:
            return np.full(count, float(keys[name]))
        return np.interp(places, np.arange(len(given) + 1) / len(given), [*given, given[0]])

    velocity, teeth = over("velocity"), keys["teeth_1"]
    diameter, center = pitch / sin(pi / teeth), (keys["links"] - teeth) * pitch / 2
    hanging = keys["moving_mass"] + keys["strands"] * mass * keys["links"] * pitch
    total = hanging + keys["driven_inertia"] / (diameter / 2) ** 2
    useful = (abs(total * over("acceleration")) + (velocity != 0) * 0.1 * hanging * GRAVITY) / keys["strands"]
    shocks = mass * center * (velocity / (diameter / 2)) ** 2 * pitch / 2
    found: np.ndarray = useful + mass * velocity**2 + mass * GRAVITY * center / (8 * 0.02) + shocks
    return found


@pytest.mark.parametrize("left_out", ["", "acceleration", "velocity"])
def test_the_peak_of_a_conveyor_is_that_of_many_places(left_out: str) -> None:
    keys = without(GRIPPERS, f"{left_out}_curve") | (
        {left_out: -20 if left_out == "acceleration" else 2} if left_out else {}
    )
    found, expected = chain(keys), swept(keys, 0.01905, 1.15)
    assert number(found, "tension_peak") == pytest.approx(expected.max(), rel=1e-6)
    assert number(found, "safety_dynamic") == pytest.approx(28_900 / expected.max(), rel=1e-6)


def test_a_conveyor_by_numbers_is_one_moment_of_the_cycle() -> None:
    keys = without(GRIPPERS, "velocity_curve", "acceleration_curve") | {"velocity": 3, "acceleration": -40}
    assert number(chain(keys), "tension_peak") == pytest.approx(swept(keys, 0.01905, 1.15)[0], rel=1e-12)
    at_rest = chain(keys, velocity=0)
    assert number(at_rest, "useful_tension") == pytest.approx(number(at_rest, "moving_mass_total") * 40 / 2)


def test_of_a_torque_curve_the_greatest_size_counts() -> None:
    over, alone = chain(UNEVEN), chain()
    assert number(over, "tension_peak") == pytest.approx(number(alone, "tension_peak"), rel=1e-12)
    turned = chain(UNEVEN, torque_curve=[-200, 100, -50, 20, 80, 150])
    assert number(turned, "tension_peak") == pytest.approx(number(alone, "tension_peak"), rel=1e-12)


def test_power_and_torque_are_two_forms_of_one_load() -> None:
    power = 200 * 300 * 2 * pi / 60 / 1000
    assert number(chain(without(DRIVE, "torque"), power=power), "tension_peak") == pytest.approx(
        number(chain(), "tension_peak")
    )


def test_the_sag_is_that_of_a_rope_under_its_weight() -> None:
    """A catenary through the same sag has nearly the same tension at its end: the parabola is near it for little sag."""
    weight, span, drop = 1.15 * GRAVITY, 0.6, 0.012
    low, high = 1.0, 1000.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (
            (middle, high) if middle / weight * (np.cosh(weight * span / 2 / middle) - 1) > drop else (low, middle)
        )
    assert number(chain(), "sag_tension") == pytest.approx(low, rel=2e-3)


def test_the_shaft_bears_both_strands() -> None:
    found = chain(strands=2, pretension=100, application_factor=1.5)
    tight = 1.5 * number(found, "useful_tension") + number(found, "sag_tension") + 100
    assert number(found, "shaft_load") == pytest.approx(2 * (tight + number(found, "sag_tension") + 100))


# --- rating ----------------------------------------------------------------------------------------------------------


def test_the_rating_is_that_of_the_smaller_sprocket() -> None:
    slowing, hastening = chain(RATED, teeth_1=19, teeth_2=38), chain(RATED, teeth_1=38, teeth_2=19, speed=150)
    assert number(slowing, "rated_power") == pytest.approx(number(hastening, "rated_power"))
    double = chain(RATED, teeth_1=19, teeth_2=38, strands=2, chain=str(chain_name(slowing)))
    assert number(double, "rated_power") == pytest.approx(1.7 * number(slowing, "rated_power"))


def chain_name(found: Any) -> str:
    """The chain of a machine by its pitch."""
    return next(
        name for name, pitch in CHAINS.by_name("pitch").items() if abs(pitch / 1e3 - number(found, "pitch")) < 1e-9
    )


# --- the choice of a chain -------------------------------------------------------------------------------------------

LOADS = [
    *(RATED | {"power": power} for power in (1, 6, 20, 60)),
    *(without(UNEVEN, "chain") | {"torque_curve": [scale, 0, -scale / 2, 0]} for scale in (100, 1500)),
    *(
        without(GRIPPERS, "chain") | {"moving_mass": mass, "allowable_bearing_pressure": 60}
        for mass in (1, 50, 150, 300)
    ),
    without(GRIPPERS, "chain", "velocity_curve") | {"velocity": 2, "moving_mass": 150},
]


@pytest.mark.parametrize("keys", LOADS)
def test_the_smallest_chain_that_holds_is_taken(keys: dict[str, Any]) -> None:
    held = [name for name in CHAINS.names if holds(chain(keys, chain=name))]
    assert chain_name(chain(keys)) == held[0]


def test_different_loads_ask_for_different_chains() -> None:
    assert len({chain_name(chain(keys)) for keys in LOADS}) >= 4


def holds(found: Any) -> bool:
    """Whether the safeties and the joints of a chain hold."""
    allowed = number(found, "allowable_bearing_pressure") if "allowable_bearing_pressure" in found.inputs else np.inf
    return (
        number(found, "safety_dynamic") >= 6
        and number(found, "safety_static") >= 7
        and number(found, "bearing_pressure") <= allowed
    )


def test_a_custom_chain_takes_what_is_given() -> None:
    found = chain(CUSTOM)
    assert [
        number(found, key) for key in ("pitch", "bearing_area", "breaking_load", "mass_per_length")
    ] == pytest.approx([0.02, 90e-6, 30_000, 1.2])
    assert number(chain(bearing_area=89), "bearing_area") == pytest.approx(89e-6)
    assert number(chain(pin_diameter=6), "bearing_area") == pytest.approx(6 * (11.68 + 3.7) * 1e-6)
