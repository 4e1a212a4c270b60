"""Phases of all kinds: the method's numbers, and each edge found again by dense sampling and bisection of the curve itself."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from math import degrees, pi
from typing import Any

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.mechanism import PhaseHandle, intervals, speed_of
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.geneva_transport import MECHANISM as GENEVA
from diecut_report.plugins.knife_drive import MECHANISM as KNIFE_DRIVE
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import AbsentPhaseRecord, ShownIntervalRecord
from tests.machines import at, cylinder, drive, inputs, number
from tests.plugins import steppers
from tests.plugins.cases import FULL
from tests.plugins.followers import follower, integrated, law_stretches
from tests.plugins.knives import SHAPES, knife
from tests.plugins.platens import platen

CONVEYOR = {"sprocket_teeth": 30, "chain_pitch": "19.05 mm", "rest_tolerance": "0.1 mm"}


@cache
def press_drive(**changes: Any) -> Calculation:
    """The drive of the example press: 6000 sheets an hour, two a turn."""
    sized = cylinder()
    keys: dict[str, Any] = {
        "crank_speed": "50 rpm",
        "segment_height": "40 mm",
        "carriage_clearance": "30 mm",
        "cutting_arc_fraction": number(sized, "cutting_arc_fraction"),
    }
    return drive(**keys | changes)


@cache
def stepper(**changes: Any) -> Calculation:
    """The cam-gear stepper of the example press."""
    return steppers.stepper(**CONVEYOR | changes)


@cache
def cross(**changes: Any) -> Calculation:
    """The Maltese cross of the example press."""
    keys = {"center_distance": "240 mm", "roller_radius": "16 mm", "gear_ratio": 6, "crank_speed": "100 rpm"}
    return calculate(GENEVA, inputs(GENEVA, keys | CONVEYOR | changes))


def in_degrees(calc: Calculation, name: str) -> list[tuple[float, float]]:
    """The intervals of a phase."""
    return [(degrees(a), degrees(b)) for a, b in intervals(calc, name)]


def milliseconds(calc: Calculation, name: str, axis: str) -> list[float]:
    """How long the intervals of a phase last."""
    speed = speed_of(calc, axis)
    assert speed is not None
    return [1000 * (b - a) / speed for a, b in intervals(calc, name)]


CYLINDER = {
    "forward": ([(18.8043, 203.0831)], [614.2625]),
    "return": ([(203.0831, 378.8043)], [585.7375]),
    "cutting": ([(58.5873, 153.9490), (254.0129, 342.4182)], [317.8720, 294.6845]),
    "cutting_forward": ([(58.5873, 153.9490)], [317.8720]),
    "cutting_return": ([(254.0129, 342.4182)], [294.6845]),
    "contact": ([(55.8619, 157.0511), (250.7741, 344.7650)], [337.2972, 313.3031]),
    "carriage_window": ([(5.3076, 32.8088), (184.7527, 221.7606)], [91.6708, 123.3596]),
    "carriage_window_outer": ([(5.3076, 32.8088)], [91.6708]),
    "carriage_window_inner": ([(184.7527, 221.7606)], [123.3596]),
    "standstill": ([(11.7306, 26.0172), (193.4931, 212.7708)], [47.6217, 64.2590]),
}


@pytest.mark.parametrize("name", CYLINDER)
def test_the_cylinder_does_what_the_method_says_when_it_says(name: str) -> None:
    places, times = CYLINDER[name]
    assert np.ravel(in_degrees(press_drive(), name)) == pytest.approx(np.ravel(places), abs=6e-5)
    assert milliseconds(press_drive(), name, "crank_angle") == pytest.approx(times, abs=6e-5)


TRANSPORTS = [
    (stepper, "dwell", [(0, 160)]),
    (stepper, "phase_2", [(0, 160)]),
    (stepper, "phase_3", [(160, 213.3333)]),
    (stepper, "phase_4", [(213.3333, 306.6667)]),
    (stepper, "phase_1", [(306.6667, 360)]),
    (stepper, "moving", [(160, 360)]),
    (cross, "moving", [(300, 420)]),
    (cross, "dwell", [(60, 300)]),
]


@pytest.mark.parametrize(("machine", "name", "places"), TRANSPORTS)
def test_the_sheet_moves_and_dwells_when_the_method_says(
    machine: Callable[[], Calculation], name: str, places: Any
) -> None:
    assert np.ravel(in_degrees(machine(), name)) == pytest.approx(np.ravel(places), abs=6e-5)


# --- a second way: where a condition on the curves changes, by dense sampling and bisection ------------------------------


def edges_by_bisection(holds: Callable[[Array], Array], period: float, steps: int = 1440) -> list[float]:
    """The places over a period where a condition changes."""
    places = period * (np.arange(steps + 1) + 0.123) / steps
    before = holds(places)
    edge = np.flatnonzero(before[1:] != before[:-1])
    low, high, first = places[edge], places[edge + 1], before[edge]
    for _ in range(50):
        middle = (low + high) / 2
        is_low = holds(middle) == first
        low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
    return sorted(float(place) for place in low % period)


def flat_angle(calc: Calculation) -> float:
    """Half the central angle of the flat, from the segment's height."""
    return float(np.arccos(1 - number(calc, "segment_height") / number(calc, "cylinder_radius")))


def corner_height(calc: Calculation, theta: Array) -> Array:
    """How far the nearer corner of the flat is above the die."""
    below = np.maximum(flat_angle(calc) - np.minimum(theta, abs(2 * pi - theta)), 0.0)
    found: Array = number(calc, "cylinder_radius") * (1 - np.cos(below))
    return found


def cylinder_condition(name: str, calc: Calculation, place: Array) -> Array:
    """Whether the cylinder does it, from its curves at crank angles."""
    theta = at(calc, "cylinder_rotation", place)
    if name in ("forward", "return"):
        return (at(calc, "velocity", place) > 0) == (name == "forward")
    if name == "cutting":
        middle = number(calc, "stroke") / 2
        return abs(at(calc, "displacement", place) - middle) <= number(calc, "cutting_arc_fraction") * middle
    if name == "standstill":
        end = number(calc, "sector_ratio") * number(calc, "swing_angle")
        return np.minimum(theta, end - theta) <= number(calc, "standstill_rotation")
    height = corner_height(calc, theta)
    return (
        height <= number(calc, "material_thickness")
        if name == "contact"
        else height >= number(calc, "carriage_clearance")
    )


DRIVES = [
    {},
    {"frame_ratio": 6, "rocker_ratio": 3.0},
    {"frame_ratio": 4.8, "coupler_ratio": 4.7},
    {"sector_ratio": 6.1},
]


@pytest.mark.parametrize("changes", DRIVES)
@pytest.mark.parametrize("name", ["forward", "return", "cutting", "contact", "carriage_window", "standstill"])
def test_each_edge_of_the_cylinder_is_where_its_curves_change(name: str, changes: dict[str, Any]) -> None:
    calc = press_drive(**changes)
    expected = edges_by_bisection(partial(cylinder_condition, name, calc), 2 * pi)
    assert sorted(np.mod(np.ravel(intervals(calc, name)), 2 * pi)) == pytest.approx(expected, abs=1e-7)


def travel(calc: Calculation, place: Array) -> Array:
    """How far the sheet is from where it stood in the dwell before, or will stand in the next one."""
    step, position = number(calc, "sheet_step"), at(calc, "sheet_position", place)
    position = position + (step / 2 if calc.mechanism is GENEVA else 0.0)
    return np.minimum(position % step, -position % step)


@pytest.mark.parametrize(
    "machine", [stepper, cross, partial(stepper, motion_law="modified_sine"), partial(cross, slots=4)]
)
def test_the_sheet_rests_where_its_way_is_within_the_tolerance(machine: Callable[[], Calculation]) -> None:
    calc = machine()
    expected = edges_by_bisection(lambda place: travel(calc, place) <= 1e-4, 2 * pi)
    assert sorted(np.mod(np.ravel(intervals(calc, "rest")), 2 * pi)) == pytest.approx(expected, abs=1e-7)


# --- what there is not -------------------------------------------------------------------------------------------------


def test_a_phase_whose_inputs_are_missing_is_listed_with_the_missing_key() -> None:
    found = mechanism_results(drive(), {})
    assert set(found.phases_absent) == {
        "contact",
        "carriage_window",
        "carriage_window_outer",
        "carriage_window_inner",
    }
    assert found.phases_absent["contact"].missing == ["segment_height"]
    assert found.phases_absent["carriage_window"].missing == ["carriage_clearance", "segment_height"]
    assert mechanism_results(stepper(rest_tolerance=None), {}).phases_absent["rest"].missing == ["rest_tolerance"]


def test_a_board_as_thick_as_the_segment_is_always_touched_and_has_no_contact_phase() -> None:
    found = mechanism_results(press_drive(material_thickness="40 mm", carriage_clearance=None), {})
    assert found.phases_absent["contact"] == AbsentPhaseRecord(
        description="Contact of cylinder and board", missing=[], text="does not apply to this machine"
    )


def test_a_stroke_that_cuts_all_the_way_is_one_interval_of_the_whole_turn() -> None:
    assert intervals(press_drive(cutting_arc_fraction=1), "cutting") == ((0.0, 2 * pi),)


def test_the_results_hold_intervals_in_si_and_as_they_are_printed() -> None:
    phase = mechanism_results(press_drive(), {}).phases["contact"]
    assert (phase.role, phase.abscissa, phase.unit, phase.period) == (
        "working",
        "crank_angle",
        "rad",
        2 * pi,
    )
    assert phase.intervals[0] == pytest.approx(np.radians([55.8619, 157.0511]), abs=1e-6)
    told = phase.display.intervals[0]
    assert told == ShownIntervalRecord(begin="55.86", to="157.05", length="101.19", time="337.3")


# --- the other kinds -----------------------------------------------------------------------------------------------------


def edges_of(calc: Calculation, name: str) -> list[float]:
    """The edges of a phase within its period."""
    period = PhaseHandle(calc, name).period()
    return sorted(np.mod(np.ravel(intervals(calc, name)), period))


@pytest.mark.parametrize("shape", SHAPES)
def test_the_circular_knife_cuts_where_it_takes_torque(shape: str) -> None:
    calc = knife(**SHAPES[shape])
    expected = edges_by_bisection(lambda place: at(calc, "torque", place) > 0, 2 * pi)
    assert edges_of(calc, "cutting") == pytest.approx(expected, abs=1e-7)
    assert edges_of(calc, "free") == pytest.approx(expected, abs=1e-7)


def test_the_platen_opens_for_the_carriages_where_its_travel_leaves_them_room() -> None:
    calc = platen(carriage_clearance="30 mm")
    needed = number(calc, "carriage_clearance") + number(calc, "drive_deformation")
    expected = edges_by_bisection(lambda place: at(calc, "platen_displacement", place) >= needed, 2 * pi)
    assert edges_of(calc, "carriage_window") == pytest.approx(expected, abs=1e-7)


def test_the_platen_cuts_before_the_dead_centre_and_relaxes_after_it() -> None:
    calc = platen()
    stretch, board = number(calc, "drive_deformation"), number(calc, "material_thickness")
    edges = [
        edges_by_bisection(lambda place, u=u: at(calc, "platen_displacement", place) < u, 2 * pi)
        for u in (stretch, stretch + board)
    ]
    assert np.ravel(intervals(calc, "relaxing")) == pytest.approx([0, edges[0][0]], abs=1e-7)
    assert np.ravel(intervals(calc, "cutting")) == pytest.approx([edges[1][1], 2 * pi], abs=1e-7)
    assert np.ravel(intervals(calc, "pressing")) == pytest.approx([edges[1][1], edges[0][0] + 2 * pi], abs=1e-7)
    assert np.ravel(intervals(calc, "open")) == pytest.approx([edges[0][0], edges[1][1]], abs=1e-7)


@pytest.mark.parametrize("side", ["outer", "inner"])
@pytest.mark.parametrize("drive_kind", ["planetary", "crank_slider", "crank_rocker"])
def test_the_knife_is_below_the_table_where_its_edge_is(drive_kind: str, side: str) -> None:
    calc = calculate(KNIFE_DRIVE, inputs(KNIFE_DRIVE, FULL["knife_drive"][side]))
    depth = number(calc, "working_depth")

    def height(place: Array) -> Array:
        found = at(calc, f"{drive_kind}_displacement", place)
        return found - (
            at(calc, f"{drive_kind}_displacement", np.array([3 * pi / 2]))[0] if drive_kind == "planetary" else 0.0
        )

    expected = edges_by_bisection(lambda place: height(place) < depth, 2 * pi)
    assert edges_of(calc, f"{drive_kind}_below") == pytest.approx(expected, abs=1e-7)
    assert edges_of(calc, f"{drive_kind}_clear") == pytest.approx(expected, abs=1e-7)
    ((start, end),) = intervals(calc, f"{drive_kind}_working")
    assert start % (2 * pi) == pytest.approx(number(calc, f"{drive_kind}_contact_angle") % (2 * pi))
    assert end - start == pytest.approx(number(calc, f"{drive_kind}_working_angle"))


def test_the_driven_link_rests_once_its_deflection_stays_within_the_tolerance() -> None:
    calc = follower(cycles_per_hour="1800 1/h", rise_time="0.1", rest_tolerance="0.2 deg", dwell_cycles=20)
    duration, rise = number(calc, "duration"), number(calc, "rise_duration")
    edges = edges_by_bisection(lambda place: abs(at(calc, "deflection", place)) > np.radians(0.2), duration, 20_000)
    assert np.ravel(intervals(calc, "settling")) == pytest.approx([rise, edges[-1]])
    assert np.ravel(intervals(calc, "moving")) == pytest.approx([0.0, rise])
    assert np.ravel(intervals(calc, "rest")) == pytest.approx([edges[-1], 2.0])


@pytest.mark.parametrize("damping", [0.05, 0.1])
def test_the_rest_does_not_depend_on_how_long_the_vibration_is_calculated(damping: float) -> None:
    """A link that swings through its place is not at rest; what is calculated of it told so where it ended in such an instant."""
    omega, rise, tolerance = 20 * np.pi, 0.2, np.radians(0.1)
    link = {
        "inertia": 1,
        "stiffness": omega**2,
        "damping_ratio": damping,
        "rise": 1.2,
        "rise_time": 0.1,
        "cycles_per_hour": "1800 1/h",
    }
    last = integrated(law_stretches("modified_sine", 1.2, rise), 1.7, omega, damping)[-1]
    end = float(last.time[np.flatnonzero(np.abs(last.states[2]) > tolerance)[-1]])
    ends = [
        number(
            follower(**link, motion_law="modified_sine", rest_tolerance="0.1 deg", dwell_cycles=cycles), "settle_end"
        )
        for cycles in (*np.arange(0.5, 5, 0.25), 16)
    ]
    assert (
        min(ends) >= end - 1e-3 and max(ends) <= end + np.pi / omega
    )  # half a period later at most: then it is the amplitude
    assert ends[-1] == pytest.approx(end, abs=1e-3)


@pytest.mark.usefixtures("without_advice")
@pytest.mark.parametrize("never", [{"damping_ratio": 0}, {"cycles_per_hour": "9000 1/h", "rise_time": "0.5"}])
def test_a_link_that_still_swings_when_the_next_motion_begins_tells_no_rest(never: dict[str, Any]) -> None:
    link = {"cycles_per_hour": "1800 1/h", "rise_time": "0.1", "rest_tolerance": "0.001 deg", "dwell_cycles": 2}
    assert set(mechanism_results(follower(**link | never), {}).phases) == {"moving"}
    assert mechanism_results(follower(), {}).phases_absent["moving"].missing == ["cycles_per_hour"]


@pytest.mark.parametrize(("machine", "length"), [(stepper, 172.0596), (cross, 242.8662)])
def test_the_sheet_rests_within_a_tenth_of_a_millimetre(machine: Callable[[], Calculation], length: float) -> None:
    ((start, end),) = in_degrees(machine(), "rest")
    assert end - start == pytest.approx(length, abs=6e-5)
