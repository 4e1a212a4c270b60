"""The kinds of a machine's parts by a second way: quadrature, counts on a grid, and the curves of the mechanisms at the angle of their own shaft."""

from __future__ import annotations

from math import cos, pi, radians
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.drive_line import MECHANISM as LINE
from diecut_report.plugins.machine_inertia import MECHANISM as INERTIA
from diecut_report.plugins.shaft_body import MECHANISM as BODY
from diecut_report.plugins.shaft_loads import MECHANISM as LOADS
from tests.machines import inputs, number
from tests.plugins import machine_parts
from tests.plugins.machine_parts import HALF, ONCE, STEPPED, SWINGING, moved_by, with_mechanisms

TURN = 2 * pi
PLACES = np.radians(
    [3.0, 61.0, 149.0, 222.0, 301.0, 377.0, 455.0, 592.0, 701.0]
)  # of the main shaft; at none a curve jumps
OFFSET = radians(39.4)


def body(**changes: Any) -> Calculation:
    return calculate(BODY, inputs(BODY, machine_parts.BODY | changes))


def loads(**keys: Any) -> Calculation:
    return calculate(LOADS, inputs(LOADS, with_mechanisms(keys)))


def at(calc: Calculation, name: str, angles: Array) -> Array:
    """A curve of a single machine at angles."""
    domain = next(iter(calc.domains.values()))
    places = np.atleast_2d(angles)
    found: Array = calc.sample(name, places, domain.middle_of(places))[0]
    return found


# --- shaft_body, machine_inertia -------------------------------------------------------------------------------------


def test_a_hollow_disc_has_the_mass_and_inertia_of_its_rings() -> None:
    calc = body()
    rings = [quad(lambda r, n=n: 0.6 * 7200 * 0.05 * TURN * r**n, 0.03, 0.174)[0] for n in (1, 3)]
    assert calc["disc_mass"][0, 2] == pytest.approx(rings[0], rel=1e-12)
    assert calc["disc_inertia"][0, 2] == pytest.approx(rings[1], rel=1e-12)


def test_a_shaft_has_the_mass_and_inertia_of_all_that_is_on_it() -> None:
    calc, alone = body(), body(bodies=[])
    assert number(alone, "mass") == pytest.approx(sum(calc["disc_mass"][0]), rel=1e-12)
    assert number(calc, "mass") == pytest.approx(number(alone, "mass") + 9.4, rel=1e-12)
    assert number(calc, "inertia") == pytest.approx(sum(calc["disc_inertia"][0]) + 0.08, rel=1e-12)


def test_a_disc_without_anything_left_is_refused() -> None:
    with pytest.raises(Impossible) as refused:
        body(discs=[{"name": "tube", "diameter": "60 mm", "bore": "60 mm", "width": "0.3 m"}])
    assert refused.value.key == "discs.0.bore"


def test_a_shaft_at_half_the_speed_has_a_quarter_of_its_inertia_at_the_main_shaft() -> None:
    calc = calculate(INERTIA, inputs(INERTIA, machine_parts.INERTIA))
    energy = (0.576 * 10**2 + 0.13 * (-0.5 * 10) ** 2) / 2  # at 10 rad/s
    assert number(calc, "inertia") * 10**2 / 2 == pytest.approx(energy, rel=1e-12)
    assert number(calc, "mass") == pytest.approx(57.8 + 36.9 + 30 + 41, rel=1e-12)


# --- drive_line ------------------------------------------------------------------------------------------------------


def test_gears_whose_teeth_pass_one_by_one_turn_by_their_ratio() -> None:
    calc = calculate(LINE, inputs(LINE, machine_parts.LINE))
    assert calc["mesh_ratio"][0] == pytest.approx([24 / 48, 18 / 87])
    pitch = [pi * 0.005, pi * 0.004 / cos(radians(15))]  # transverse: what passes with each tooth
    first, second = calc["radius_1"][0], calc["radius_2"][0]
    assert TURN * first == pytest.approx([24 * pitch[0], 18 * pitch[1]], rel=1e-12)
    assert TURN * second == pytest.approx([48 * pitch[0], 87 * pitch[1]], rel=1e-12)
    assert calc["center_distance"][0] == pytest.approx(first + second, rel=1e-12)
    assert calc["speed"][0] == pytest.approx([TURN * 100 / 60, -TURN * 50 / 60], rel=1e-12)


def test_a_chain_travels_by_its_teeth_and_weighs_what_its_links_do() -> None:
    calc = calculate(LINE, inputs(LINE, machine_parts.LINE))
    assert TURN * calc["chain_travel"][0] == pytest.approx([52 * 0.0127, 30 * 0.01905], rel=1e-12)
    assert calc["chain_length"][0] == pytest.approx([3.048, 2.286], rel=1e-12)
    assert calc["chain_mass"][0] == pytest.approx([2 * 3.048 * 0.69 + 9.6, 2.286 * 1.25], rel=1e-12)
    assert calc["chain_pull"][0] == pytest.approx([4 * 800, 0])  # two chains, each with two sides
    assert calc["belt_ratio"][0] == pytest.approx([3])


# --- shaft_loads -----------------------------------------------------------------------------------------------------


def lossy(torque: Array, efficiency: float) -> Array:
    """What enters a way with losses: a power that drives is greater before it, one that comes back is less."""
    return np.array([each / efficiency if each > 0 else each * efficiency for each in torque])


def test_a_torque_is_the_curve_at_the_angle_of_the_lines_own_shaft_with_its_losses() -> None:
    calc, drive, cross = loads(**STEPPED), moved_by()["drive"], moved_by()["cross"]
    crank = at(drive, "crank_torque", PLACES / 2 % TURN)
    assert crank.max() > 0 > crank.min()  # both signs are looked at
    assert at(calc, "wheel_torque", PLACES) == pytest.approx(lossy(0.5 * crank, 0.97), rel=1e-7, abs=1e-7)
    own = (PLACES - OFFSET) % TURN
    assert at(calc, "crank_torque", PLACES) == pytest.approx(-at(cross, "torque", own), rel=1e-7, abs=1e-7)
    inertia = 0.5 * at(cross, "wheel_acceleration", own)
    assert np.abs(inertia).max() > 1
    assert at(calc, "inertia_torque", PLACES) == pytest.approx(lossy(inertia, 0.95), rel=1e-7, abs=1e-7)


def test_the_torques_of_a_shaft_and_what_balances_them_are_none_together() -> None:
    calc = loads(**STEPPED)
    others = sum(at(calc, f"{name}_torque", PLACES) for name in ("wheel", "crank", "inertia"))
    assert at(calc, "balance", PLACES) == pytest.approx(-others, rel=1e-12)


def test_a_force_is_a_curve_with_sign_and_constant_part_and_a_pull_never_pushes() -> None:
    calc, drive, cross = loads(**STEPPED), moved_by()["drive"], moved_by()["cross"]
    own = PLACES / 2 % TURN
    assert at(calc, "bearing_force", PLACES) == pytest.approx(120 - at(drive, "crank_bearing_force_x", own), rel=1e-7)
    pull = np.abs(at(drive, "crank_torque", own)) / 0.105 + 800
    assert at(calc, "chain_force", PLACES) == pytest.approx(pull, rel=1e-7)
    tooth = 0.5 * at(cross, "wheel_acceleration", (PLACES - OFFSET) % TURN) / 0.06
    assert at(calc, "tooth_force", PLACES) == pytest.approx(tooth, rel=1e-7, abs=1e-7)


def test_a_shaft_in_steps_goes_on_from_step_to_step() -> None:
    calc, cross = loads(**STEPPED), moved_by()["cross"]
    dwells = OFFSET + pi + TURN * np.arange(5)  # the wheel stands opposite its motion
    angles = at(calc, "shaft_angle", dwells)
    assert np.diff(angles) == pytest.approx(np.diff(angles)[0] * np.ones(4), rel=1e-9)
    assert abs(np.diff(angles)[0]) == pytest.approx(TURN / 6, rel=1e-9)  # six slots
    moved = at(cross, "wheel_angle", np.array([pi, pi + radians(170)]))
    later = at(calc, "shaft_angle", OFFSET + TURN + np.array([pi, pi + radians(170)]))
    assert np.diff(later) == pytest.approx(np.diff(moved), abs=1e-9)


def test_a_swinging_shaft_comes_back_and_follows_its_rocker() -> None:
    calc, drive = loads(**SWINGING), moved_by()["drive"]
    assert at(calc, "shaft_angle", np.array([0.0])) == pytest.approx(
        at(calc, "shaft_angle", np.array([2 * TURN])), abs=1e-9
    )
    assert at(calc, "shaft_angle", PLACES) == pytest.approx(
        -2.5 * at(drive, "rocker_angle", PLACES / 2 % TURN), rel=1e-7
    )


BAD: list[tuple[dict[str, Any], str, str]] = [
    ({"curve": "crank_torqu"}, "torques.0.curve", "no curve of this name"),
    ({"curve": "velocity"}, "torques.0.curve", "not a curve in N*m"),
    ({"inertia": "0.2 kg*m**2"}, "torques.0.curve", "not a curve in rad/s**2"),
    *(({"turns_per_sheet": text}, "torques.0.turns_per_sheet", "number or a ratio")
      for text in ("", "often", "1/0", "-1", "0", "1/65", "nan", "1/2/3")),
]  # fmt: skip


@pytest.mark.parametrize(("keys", "path", "words"), BAD)
def test_a_curve_or_a_ratio_that_is_not_there_is_refused_in_words(keys: dict[str, Any], path: str, words: str) -> None:
    torque = {"name": "wheel", "curve": "crank_torque"} | HALF | keys
    with pytest.raises(Impossible) as refused:
        loads(main_turns=2, torques=[torque])
    assert refused.value.key == path and words in str(refused.value.message)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"forces": [HALF | {"name": "wheel", "curve": "crank_torque"}]}, "forces.0.curve: not a curve in N"),
        ({"forces": [HALF | {"name": "wheel", "curve": "velocity", "lever": "0.1 m"}]}, "forces.0.curve: not a curve in N*m"),
        ({"motion": HALF | {"curve": "velocity"}}, "motion.curve: not a curve in rad"),
    ],
)  # fmt: skip
def test_a_force_and_a_motion_are_made_of_curves_of_their_own(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(Impossible) as refused:
        loads(main_turns=2, **keys)
    key, told = words.split(": ")
    assert refused.value.key == key and str(refused.value.message).endswith(told)


def test_a_curve_over_the_main_shaft_is_taken_as_it_is() -> None:
    """Of a mechanism whose cycle is a turn, ``main`` is one turn a sheet."""
    keys = {"name": "crank", "curve": "torque"} | ONCE
    named, counted = (loads(main_turns=1, torques=[keys | {"turns_per_sheet": text}]) for text in ("main", "1"))
    inside = PLACES[PLACES < TURN]
    assert at(named, "crank_torque", inside) == pytest.approx(at(counted, "crank_torque", inside), rel=1e-12, abs=1e-12)


# --- the body of a Geneva wheel --------------------------------------------------------------------------------------


def test_a_torque_that_acts_the_other_way_has_the_same_losses() -> None:
    keys = HALF | {"name": "wheel", "curve": "crank_torque", "efficiency": 0.9}
    one, other = (
        at(loads(main_turns=2, torques=[keys | {"ratio": ratio}]), "wheel_torque", PLACES) for ratio in (1, -1)
    )
    assert other == pytest.approx(-one)
