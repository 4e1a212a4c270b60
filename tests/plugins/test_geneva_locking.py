"""The Geneva drive's slots, arms and locking disc against the bare geometry of the drawn parts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from diecut_report.machine.calculation import Calculation
from diecut_report.plugins.geneva_transport.figures import disc_outline, wheel_outline
from diecut_report.results.figure_views import MachineView
from tests.examples import examples, few
from tests.machines import number
from tests.plugins.test_geneva_transport import SHEET, SLOTS, engaged, geneva, wheel_from_middle, with_slots


@pytest.mark.parametrize("slots, roller", [(3, 0.02), (4, 0.03), (6, 0.012), (6, 0.06), (9, 0.03), (18, 0.02)])
def test_the_wall_between_slots_is_that_of_their_outlines(slots: int, roller: float) -> None:
    calc = geneva(slots=slots, roller_radius=f"{roller} m")
    inner, mouth = 0.2 * (1 - np.sin(np.pi / slots)), 0.2 * np.cos(np.pi / slots)
    middles = np.linspace(inner, mouth, 4001)  # the slot is what a roller sweeps whose middle goes along this line
    turned = middles * np.exp(2j * np.pi / slots)
    nearest = min(abs(turned[i : i + 200, None] - middles[None, :]).min() for i in range(0, 4001, 200))
    assert number(calc, "roller_clearance") == pytest.approx(nearest - 2 * roller, abs=1e-12)


@pytest.mark.parametrize("slots, roller", [(3, 10), (4, 12), (6, 12), (6, 24), (8, 10), (18, 6)])
def test_arms_are_as_thick_as_the_drawn_wheels(slots: int, roller: float) -> None:
    calc = geneva(slots=slots, roller_radius=roller)
    outline = np.array(wheel_outline(MachineView(calc), np.pi / slots)) @ [1, 1j]  # in the dwell
    radius, rim = number(calc, "locking_radius"), number(calc, "rim_radius")
    on_arc = outline[abs(abs(outline) - radius) < 1e-9]
    assert len(on_arc) >= 41 and min(abs(outline)) == pytest.approx(radius, rel=1e-9)
    on_rim = outline[abs(abs(outline - 0.2) - rim) < 1e-9]
    mouth = 0.2 + 0.2 * np.cos(np.pi / slots) * np.exp(1j * (np.pi - np.pi / slots))
    corner = on_rim[
        np.argmin(abs(on_rim - mouth) + 1e3 * (abs(on_rim) > abs(mouth)))
    ]  # the slot's corner next to the disc
    assert abs(corner - mouth) == pytest.approx(roller / 1e3, rel=1e-9)
    assert abs(corner) - radius == pytest.approx(number(calc, "arm_tip"), abs=1e-12)
    deepest = on_arc[np.argmin(abs(on_arc - 0.2))]
    flank = abs(np.imag((deepest - 0.2) * np.exp(-1j * (np.pi - np.pi / slots)))) - roller / 1e3
    assert 2 * flank == pytest.approx(number(calc, "arm_neck"), abs=1e-12)


def crosses(calc: Calculation, crank: float, wheel: float, depth: float = 1e-7) -> bool:
    """Whether wheel and disc overlap by more than ``depth``, judged by the points of the wheel's outline."""
    view = MachineView(calc)
    points = np.array(wheel_outline(view, wheel)) @ [1, 1j] * np.exp(-1j * crank)
    in_disc = abs(points) < number(calc, "disc_radius") - depth
    return bool(
        np.any(in_disc & (abs(points - number(calc, "relief_distance")) > number(calc, "relief_radius") + depth))
    )


def meets(calc: Calculation) -> bool:
    """Whether wheel and disc overlap anywhere in the engagement."""
    alpha = engaged(calc, 181)
    return any(crosses(calc, a, psi) for a, psi in zip(alpha, wheel_from_middle(calc, alpha), strict=True))


@pytest.mark.parametrize("slots", few(SLOTS, keep=lambda slots: slots in (3, 6, 18)))
def test_the_cut_out_lets_the_arms_pass_through_the_whole_engagement(slots: int) -> None:
    calc = with_slots(slots)
    assert number(calc, "cutout_gap") == pytest.approx(0, abs=1e-12)
    assert not meets(calc)


@pytest.mark.parametrize(
    "slots, roller, locking",
    [
        (6, 36, 36),
        (12, 13, None),
        (12, 13, 29),
        (18, 5, 24),
        *few([(6, 24, None), (8, 26, 32), (16, 5, 12), (18, 7, None), (4, 30, 70)], keep=lambda _: False),
    ],
)
def test_tips_that_meet_the_disc_are_found_as_by_turning_the_drawn_parts(
    slots: int, roller: float, locking: float | None
) -> None:
    changes = {} if locking is None else {"locking_radius": locking}
    calc = geneva(slots=slots, roller_radius=roller, locking_clearance=0, **changes)
    assert meets(calc) == (number(calc, "cutout_gap") < -1e-7)


@pytest.mark.parametrize("slots", SLOTS)
def test_the_disc_holds_up_to_the_entry_and_frees_the_wheel_there(slots: int) -> None:
    calc = with_slots(slots)
    half, rest, nudge = np.pi / 2 - np.pi / slots, np.pi / slots, 0.01
    hold = number(calc, "hold_half_angle")
    for crank in (half + hold, np.pi, 2 * np.pi - half - hold):
        assert not crosses(calc, crank, rest)
        assert crosses(calc, crank, rest + nudge) and crosses(calc, crank, rest - nudge)
    early, late = 2 * np.pi - half - 0.25 * hold, 2 * np.pi - half + 1e-6
    assert crosses(calc, early, rest + nudge)
    assert not crosses(calc, late, rest + 1e-5, depth=1e-9)


def test_the_disc_is_the_turn_without_the_cut_out_and_the_hollow_closes_it() -> None:
    calc = geneva()
    outline = np.array(disc_outline(MachineView(calc), 0.0)) @ [1, 1j]
    arc = outline[abs(abs(outline) - number(calc, "disc_radius")) < 1e-12]
    angles = np.unwrap(np.angle(arc))
    assert angles[-1] - angles[0] == pytest.approx(number(calc, "locking_arc_angle"), rel=1e-12)
    assert number(calc, "locking_arc_angle") == pytest.approx(np.radians(240), rel=1e-12)
    hollow = outline[len(arc) :]
    assert abs(hollow - number(calc, "relief_distance")) == pytest.approx(
        np.full(len(hollow), number(calc, "relief_radius")), rel=1e-12
    )
    assert abs(hollow[0] - arc[-1]) < 0.01 and abs(hollow[-1] - arc[0]) < 0.01


def turned_until_it_touches(calc: Calculation, cover: float, way: int) -> float:
    """Angle by which the wheel turns until its locking arc meets one of many points of the disc's arc."""
    center, radius = number(calc, "center_distance"), number(calc, "locking_radius")
    hold = number(calc, "hold_half_angle")
    disc = number(calc, "disc_radius") * np.exp(1j * np.linspace(-hold, min(cover, hold), 20_001))
    return float(
        brentq(lambda turn: abs(disc - center * (1 - np.exp(1j * way * turn))).max() - radius, 0, 0.3, xtol=1e-15)
    )


@pytest.mark.parametrize("clearance", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("cover", [2.0, 10.98, 30.0, 90.0])
def test_the_play_is_that_of_the_disc_that_covers_its_arc_on_one_side_in_part(clearance: float, cover: float) -> None:
    calc = geneva(locking_clearance=f"{clearance} mm", cover_angle=cover, **SHEET)
    play = max(turned_until_it_touches(calc, np.radians(cover), way) for way in (1, -1))
    assert number(calc, "locking_play") == pytest.approx(play, rel=1e-6)
    assert number(calc, "sheet_play") == pytest.approx(play * 24 * 0.03175 * 4 / (2 * np.pi), rel=1e-6)


def test_the_play_of_the_press_that_passed_was_four_times_what_was_printed() -> None:
    conveyor = {"sprocket_teeth": 30, "chain_pitch": "19.05 mm", "gear_ratio": 6, "allowable_sheet_play": "0.3 mm"}
    size = {"center_distance": "240 mm", "roller_radius": "16 mm"}
    for cover, play in ((10.98, 1.179), (49.3, 0.300), (90, 0.274)):
        assert number(geneva(**size, **conveyor, cover_angle=cover), "sheet_play") == pytest.approx(
            play * 1e-3, abs=5e-7
        )


def test_the_usual_proportions_of_stop_arc_and_clearance_arc() -> None:
    """A worked example of the usual shop rules: six slots, wheel radius 55, pin 4, clearance 0.1 (all mm)."""
    calc = geneva(center_distance=float(55 / np.cos(np.pi / 6)), roller_radius="2 mm", locking_clearance="0.1 mm")
    expected = {
        "crank_radius": 31.7543,
        "center_distance": 63.5085,
        "locking_radius": 25.7543,
        "disc_radius": 25.6543,
        "relief_radius": 44.4345,
    }
    for name, value in expected.items():
        assert number(calc, name) * 1e3 == pytest.approx(value, abs=5e-5)
    assert (number(calc, "slot_length") - 0.002) * 1e3 == pytest.approx(23.2457, abs=5e-5)


@examples(50)
@given(slots=st.integers(3, 18), share=st.floats(0.001, 0.999))
def test_the_default_locking_arc_lies_between_rim_and_slots_wherever_there_is_room(slots: int, share: float) -> None:
    ratio = np.sin(np.pi / slots)
    calc = geneva(slots=slots, roller_radius=200 * min(ratio / 2, 1 - ratio) * share, locking_clearance=0)
    rim, locking, flank = (number(calc, name) for name in ("rim_distance", "locking_radius", "flank_distance"))
    if rim < flank:
        assert rim < locking < flank
        assert 0 < number(calc, "hold_half_angle") < number(calc, "engagement_half_angle")
    else:
        assert np.isnan(calc["hold_half_angle"][0, 0])


def test_a_given_locking_radius_is_taken() -> None:
    assert number(geneva(locking_radius="80 mm"), "arm_tip") == pytest.approx(0.01, rel=1e-12)
