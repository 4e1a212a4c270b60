"""The stepped shaft: the method's worked example, closed forms, brute force over instants and material points, advice that is followed."""

from __future__ import annotations

from math import cos, log10, pi, radians, tan
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.plugins.shaft import MECHANISM
from diecut_report.results.checks import check_results
from tests.examples import few
from tests.machines import inputs, number, statuses
from tests.plugins.shafts import CRANK, CRANKSHAFT, GEAR, LAYSHAFT, SECTIONS, STANDING, crankshaft, row, shaft

GROWING: list[tuple[str, dict[str, Any]]] = [
    ("fatigue", CRANKSHAFT | {"required_fatigue_safety": 2.6}),
    ("fatigue", LAYSHAFT | {"required_fatigue_safety": 30}),
    ("yield", CRANKSHAFT | {"required_yield_safety": 15}),
    ("yield", LAYSHAFT | {"required_yield_safety": 100}),
    ("bearing_slope", CRANKSHAFT | {"allowable_bearing_slope": 0.5}),
    ("deflection", CRANKSHAFT | {"allowable_deflection": 0.05}),
    ("twist", CRANKSHAFT | {"allowable_twist": 0.1}),
]


@pytest.mark.parametrize(
    ("check", "keys"),
    few(GROWING, keep=lambda one: one not in GROWING[1:3]),  # each check, and each of the two shafts
)
def test_a_failed_check_advises_larger_sections(check: str, keys: dict[str, Any]) -> None:
    failed = next(each for each in check_results(shaft(keys)) if each.id == check)
    assert failed.status in ("fail", "warn")
    (way,) = failed.advice
    assert {change.key.split(".")[0] for change in way} == {"sections"}


SHOULDER_1, SHOULDER_2, SHOULDER_3 = "shoulder 1", "shoulder 2", "shoulder 3"
GEAR_KEY, CRANK_KEY = "notch 1 (keyseat end mill)", "notch 2 (keyseat end mill)"


# --- the worked example of the method ----------------------------------------------------------------------------------


def test_the_notches_of_the_crankshaft_have_the_factors_of_the_method() -> None:
    found = [row(crankshaft(), name) for name in ("k_t", "k_ts", "k_f", "k_fs")]
    assert_allclose([each[SHOULDER_3] for each in found], [2.0893, 1.6418, 1.9479, 1.5743], rtol=5e-5)
    assert row(crankshaft(), "place_endurance")[CRANK_KEY] == pytest.approx(222.21e6, rel=5e-5)


def test_the_deflection_at_the_gear_is_that_of_the_method() -> None:
    assert crankshaft().sample("deflection", np.array([[0.13]]), np.array([[0.13]]))[0, 0] == pytest.approx(
        32.391e-6, rel=5e-5
    )


@pytest.mark.parametrize(
    ("step", "radius", "great", "k_t", "k_ts"),
    [(5, 2.5, 60, 1.9564, 1.5600), (2.5, 2, 60, 1.9261, 1.5381), (3, 3, 38, 1.6819, 1.3684)],
)
def test_shoulders_have_the_factors_of_petersons_charts(
    step: float, radius: float, great: float, k_t: float, k_ts: float
) -> None:
    sections = [{"length": 100, "diameter": great - 2 * step}, {"length": 240, "diameter": great}]
    sections[0]["fillet_radius"] = radius
    calculation = shaft(CRANKSHAFT, sections=sections, notches=[])
    found = [calculation[name][0, 0] for name in ("k_t", "k_ts")]
    assert found == pytest.approx([k_t, k_ts], rel=5e-5)


# --- closed forms and brute force ---------------------------------------------------------------------------------------


def test_constant_loads_on_a_turning_shaft_alternate_fully_in_bending() -> None:
    calculation = shaft(CRANKSHAFT, loads=[GEAR | {"torque": 100}, CRANK])
    sigma_a, sigma_m = row(calculation, "sigma_a"), row(calculation, "sigma_m")
    modulus = np.pi * 0.05**3 / 32
    assert sigma_a[SHOULDER_3] == pytest.approx(9994 * (0.355 - 0.28) / modulus, rel=1e-9)
    assert max(map(abs, sigma_m.values())) < 1e-6 * sigma_a[SHOULDER_3]


def test_constant_loads_on_a_standing_shaft_do_not_tire_it() -> None:
    calculation = shaft(STANDING)
    assert max(row(calculation, "sigma_a").values()) == 0
    assert max(row(calculation, "sigma_m").values()) > 1e6
    assert number(calculation, "size_share") == 0.37


class Turned:
    """A curve of this test's own: a force of constant size that turns with the shaft (1), or against it (-1)."""

    curve_id, cycle = "turned", "crank_angle"
    breakpoints = joints = np.empty((1, 0))

    def __init__(self, function: Any, turns: float = 1) -> None:
        self.function, self.turns = function, np.full((1, 1), turns)

    def values(self, share: Any, middle: Any, rows: Any) -> Any:
        """Return the force at shares of the cycle."""
        return self.function(2 * np.pi * share)


@pytest.mark.parametrize(("sense", "amplitude"), [(1, 0.0), (-1, 1.0)])
def test_a_load_that_turns_with_the_shaft_does_not_tire_it_one_against_it_does(sense: int, amplitude: float) -> None:
    load = {
        "name": "out of balance",
        "position": 130,
        "force_y": Turned(lambda a: 1000 * np.cos(a)),
        "force_z": Turned(lambda a: sense * 1000 * np.sin(a)),
    }
    calculation = shaft(CRANKSHAFT, loads=[load])
    modulus = np.pi * 0.055**3 / 32
    stress = 1000 * 0.12 * 0.105 / 0.225 / modulus
    assert row(calculation, "sigma_a")[GEAR_KEY] == pytest.approx(amplitude * stress, rel=1e-4, abs=1e-3)


PEAK, ARM, SPAN = 3000.0, 0.105, 0.225  # N, and m from bearing A to the load and to bearing B


@pytest.mark.parametrize(
    ("again", "turns"), [(40, 387), (12, 115), (3, 29), (361, 2), (40, 721), (90, 1), (1, 719), (1, 720), (1, 999)]
)
def test_a_load_that_comes_again_in_a_long_cycle_is_seen_at_its_peak_and_in_all_phases(again: int, turns: int) -> None:
    """A peak of a twentieth of its period; the amplitude is that of brute force over material points."""
    peak = Turned(lambda a: PEAK * np.cos(a * again / 2 + 0.3) ** 100, turns=2 * again)
    long = shaft(CRANKSHAFT, loads=[{"name": "peak", "position": 130, "force_y": peak}], turns_per_cycle=turns)
    still = shaft(CRANKSHAFT, loads=[{"name": "peak", "position": 130, "force_y": PEAK}], rotation="none")
    assert number(long, "reaction_b_max") == pytest.approx(PEAK * ARM / SPAN, rel=2e-3)
    assert number(long, "deflection_max") == pytest.approx(number(still, "deflection_max"), rel=2e-3)
    stress = PEAK * (SPAN - ARM) * ARM / SPAN / (np.pi * 0.055**3 / 32)
    angle = np.linspace(0, 2 * np.pi, 200_000)
    turned = peak.function(angle) / PEAK * np.exp(1j * turns * angle)
    amplitude = max(np.ptp((turned * np.exp(1j * psi)).real) / 2 for psi in np.linspace(0, np.pi, 61))
    assert row(long, "sigma_a")[GEAR_KEY] == pytest.approx(amplitude * stress, rel=0.02)


@pytest.mark.parametrize("turns", [1, 7, 240, 360, 720, 1000])
def test_a_constant_load_bends_a_turning_shaft_to_and_fro_however_often_it_turns(turns: int) -> None:
    calculation = shaft(CRANKSHAFT, loads=[{"name": "pull", "position": 130, "force_y": PEAK}], turns_per_cycle=turns)
    stress = PEAK * (SPAN - ARM) * ARM / SPAN / (np.pi * 0.055**3 / 32)
    assert row(calculation, "sigma_a")[GEAR_KEY] == pytest.approx(stress, rel=1e-4)


@pytest.mark.parametrize("turns", [1, 240, 720])
def test_a_load_that_hardly_varies_bends_it_so_too(turns: int) -> None:
    pull = Turned(lambda a: PEAK * (1 - 1e-4 * np.cos(a)))
    calculation = shaft(CRANKSHAFT, loads=[{"name": "pull", "position": 130, "force_y": pull}], turns_per_cycle=turns)
    stress = PEAK * (SPAN - ARM) * ARM / SPAN / (np.pi * 0.055**3 / 32)
    assert row(calculation, "sigma_a")[GEAR_KEY] == pytest.approx(stress, rel=2e-3)


def test_the_fatigue_of_any_loads_is_that_of_brute_force() -> None:
    """Sum reactions, moments and stresses anew at each instant and material point, place by place."""
    curves = {
        "force_y": Turned(lambda a: 3000 * np.cos(a) - 500),
        "force_z": Turned(lambda a: 2000 * np.sin(2 * a)),
        "torque": Turned(lambda a: 200 + 100 * np.sin(a)),
        "axial_force": Turned(lambda a: 800 * np.cos(3 * a)),
        "couple_xz": Turned(lambda a: 40 * np.sin(a)),
    }
    calculation = shaft(
        CRANKSHAFT,
        loads=[{"name": "all", "position": 130} | curves, {"name": "out", "position": 310, "torque": "balance"}],
    )
    angle = np.linspace(0, 2 * np.pi, 1441)
    values = {name: curve.function(angle) for name, curve in curves.items()}
    span, arm = 0.225, 0.105
    r_by, r_bz = -values["force_y"] * arm / span, -(values["force_z"] * arm + values["couple_xz"]) / span
    x, modulus, area = 0.13, np.pi * 0.055**3 / 32, np.pi * 0.055**2 / 4
    k_f, k_fs = (row(calculation, name)[GEAR_KEY] for name in ("k_f", "k_fs"))
    endurance = row(calculation, "place_endurance")[GEAR_KEY]
    least = np.inf
    for behind in (False, True):
        m_y = -(values["force_y"] + r_by) * (x - 0.025)
        m_z = -(values["force_z"] + r_bz) * (x - 0.025) - behind * values["couple_xz"]
        axial = values["axial_force"] * (1 - behind)
        torque = values["torque"] * behind
        for psi in np.linspace(0, 2 * np.pi, 721):
            stress = axial / area - (m_y * np.cos(psi + angle) + m_z * np.sin(psi + angle)) / modulus
            normal = np.ptp(stress) / 2, (stress.max() + stress.min()) / 2
            shear = np.ptp(torque) / 4 / modulus, (torque.max() + torque.min()) / 4 / modulus
            sides = [np.sqrt((k_f * s) ** 2 + 3 * (k_fs * t) ** 2) for s, t in zip(normal, shear, strict=True)]
            least = min(least, 1 / (sides[0] / endurance + sides[1] / 900e6))
    assert row(calculation, "place_safety")[GEAR_KEY] == pytest.approx(least, rel=2e-5)


def test_the_twist_of_a_hollow_shaft_is_that_of_its_closed_form() -> None:
    calculation = shaft(
        CRANKSHAFT,
        sections=[{"length": 500, "diameter": 60, "bore": 30}],
        notches=[],
        loads=[{"name": "in", "position": 50, "torque": 500}, {"name": "out", "position": 450, "torque": -500}],
    )
    polar = np.pi * (0.06**4 - 0.03**4) / 32
    assert number(calculation, "twist") == pytest.approx(500 * 0.4 / (79.3e9 * polar), rel=1e-9)
    assert number(calculation, "twist") == pytest.approx(2.114368e-3, rel=1e-6)


def geared(place: float, mesh_angle: float, torque: Any, case: Any = None, **more: Any) -> Calculation:
    """A plain shaft of 40 mm on bearings 300 mm apart, with a gear whose torque is balanced at a bearing; its slope at the teeth."""
    gear = {
        "name": "gear",
        "position": place,
        "torque": torque,
        "gear": {"pitch_radius": 60, "mesh_angle": mesh_angle},
    } | more
    return shaft(
        {key: value for key, value in CRANKSHAFT.items() if key != "notches"},
        sections=[{"length": 300, "diameter": 40}], bearing_a=0, bearing_b=300,
        loads=[gear, {"name": "driver", "position": 300, "torque": "balance", "seat": "none"}],
        load_cases=[case] if case else [],
    )  # fmt: skip


@pytest.mark.parametrize("torque", [200, -200])
@pytest.mark.parametrize("mesh_angle", [0, 37, 250])
def test_the_slope_at_the_teeth_is_that_of_a_beam_in_the_direction_of_their_force(
    torque: float, mesh_angle: float
) -> None:
    force = 200 / 0.06 / cos(radians(20))
    for place in (0.1, 0.2):
        left, right = place, 0.3 - place
        expected = force * left * right * (right - left) / (3 * 206e9 * pi * 0.04**4 / 64 * 0.3)
        calc = geared(place * 1e3, mesh_angle, torque)
        assert calc["mesh_slope"][0, 0] == pytest.approx(expected, rel=1e-9)
        assert np.isnan(calc["mesh_slope"][0, 1])


def test_teeth_open_between_like_shafts_and_stay_parallel_between_mirrored_ones() -> None:
    """What bends both gears apart at one end adds up; shafts that lean to the same side leave the teeth parallel."""
    one, like, mirrored = (
        geared(place, angle, torque)["mesh_slope"][0, 0]
        for place, angle, torque in ((100, 0, 150), (100, 180, 150), (200, 180, 150))
    )
    assert one + like == pytest.approx(2 * one) and one > 0
    assert one + mirrored == pytest.approx(0, abs=1e-12)


def test_the_slope_at_the_teeth_is_that_of_the_instant_of_the_greatest_torque() -> None:
    """The torque is greatest at a quarter turn: a force of then counts by its part along the force on the teeth, one of another instant does not."""
    torque = Turned(lambda a: 200 + 100 * np.sin(a))
    alone = geared(100, 0, torque)["mesh_slope"][0, 0]
    assert alone == pytest.approx(geared(100, 0, 300)["mesh_slope"][0, 0], rel=1e-9)
    elsewhen = geared(100, 0, torque, force_y=Turned(lambda a: 9000 * np.cos(a)))["mesh_slope"][0, 0]
    assert elsewhen == pytest.approx(alone, rel=1e-9)
    then = geared(100, 0, torque, force_y=Turned(lambda a: -1000 * np.sin(a)))["mesh_slope"][0, 0]
    tangential = 300 / 0.06
    along = np.array(
        [-tangential * tan(radians(20)), tangential]
    )  # the mate stands in y: it pushes back, and turns by z
    share = np.dot([-1000, 0], along) / np.dot(along, along)
    assert then == pytest.approx(alone * (1 + share), rel=1e-9)


CASE = {"name": "engage", "enters": "gear", "leaves": "driver"}


def test_a_load_case_twists_the_shaft_by_its_torque_alone_where_nothing_bends_it() -> None:
    loads = [{"name": "gear", "position": 130, "torque": 100}, {"name": "driver", "position": 310, "torque": "balance"}]
    calc = shaft(CRANKSHAFT, loads=loads, load_cases=[CASE | {"torque": 900}])
    assert number(calc, "von_mises_max") == pytest.approx(
        3**0.5 * 16 * 900 / (pi * 0.05**3)
    )  # the thinnest section that it passes
    assert calc["yield_case"][0, 0] == "engagement of the clutch"
    assert number(calc, "fatigue_safety") == number(shaft(CRANKSHAFT, loads=loads), "fatigue_safety")


def test_a_load_case_yields_in_a_notch_as_the_same_torque_of_the_run_does() -> None:
    """Of the run where that is greater."""

    def turned_by(torque: float, **more: Any) -> Calculation:
        through = [
            {"name": "gear", "position": 130, "torque": torque},
            {"name": "driver", "position": 310, "torque": "balance"},
        ]
        return shaft(CRANKSHAFT, loads=through, **more)

    case, run = turned_by(100, load_cases=[CASE | {"torque": 900}]), turned_by(900)
    assert row(case, "place_yield_safety") == pytest.approx(row(run, "place_yield_safety"))
    small = turned_by(900, load_cases=[CASE | {"torque": 100}])
    assert row(small, "place_yield_safety") == pytest.approx(row(run, "place_yield_safety"))


def test_what_bends_the_shaft_in_a_load_case_is_the_run_grown_with_its_torque() -> None:
    """At its greatest torque of 300 N·m the gear has also a force of its own; a load case of 750 N·m has 2.5 times all of it."""
    torque = Turned(lambda a: 200 + 100 * np.sin(a))
    force = {"force_y": Turned(lambda a: -1000 * np.sin(a))}
    case = geared(100, 0, torque, case={**CASE, "torque": 750}, **force)
    still = geared(100, 0, 300, force_y=-1000)
    assert number(case, "von_mises_max") == pytest.approx(2.5 * number(still, "von_mises_max"))
    assert number(geared(100, 0, torque, case={**CASE, "torque": 290}, **force), "yield_safety") == number(
        geared(100, 0, torque, **force), "yield_safety"
    )


def test_a_load_without_a_torque_of_its_own_takes_that_of_the_load_case() -> None:
    """As a flywheel does; the torque of the load that does not take part is none then."""
    loads = [
        {"name": "pulley", "position": 20, "torque": -50, "force_z": 500},
        {"name": "rim", "position": 150},
        {"name": "pinion", "position": 310, "torque": 50},
    ]
    case = {"name": "start", "torque": 400, "enters": "pulley", "leaves": "rim"}
    calc = shaft(CRANKSHAFT, loads=loads, load_cases=[case])
    assert calc["yield_case"][0, 0] == "start of the motor"
    assert number(calc, "nominal_torque") == pytest.approx(400)
    assert number(calc, "nominal_position") <= 0.15


BAD_CASES = [
    ({"enters": "wheel"}, "load_cases.0.enters", "not the name of a load"),
    ({"leaves": "wheel"}, "load_cases.0.leaves", "not the name of a load"),
    ({"leaves": "gear"}, "load_cases.0.leaves", "name another load"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "key", "words"), BAD_CASES)
def test_a_load_case_between_loads_that_are_not_there_is_refused(change: dict[str, str], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        geared(100, 0, 200, case={**CASE, "torque": 300} | change)
    assert refused.value.key == key and words in str(refused.value.message)


def test_a_helical_gear_loads_the_shaft_as_its_tooth_force_does() -> None:
    """The moment of the tooth force about the axis is the torque; its axial part turns about the mesh."""
    gear = {
        "name": "gear",
        "position": 130,
        "torque": 300,
        "gear": {"pitch_radius": 60, "helix_angle": 20, "mesh_angle": 90},
    }
    calculation = shaft(CRANKSHAFT, loads=[gear, CRANK | {"force_y": 0}])
    tangential = 300 / 0.06
    radial, axial = tangential * np.tan(np.radians(20)) / np.cos(np.radians(20)), tangential * np.tan(np.radians(20))
    span, arm = 0.225, 0.105
    b_y, b_z = tangential * arm / span, (radial * arm + axial * 0.06) / span
    assert number(calculation, "reaction_b_max") == pytest.approx(np.hypot(b_y, b_z), rel=1e-9)
    assert number(calculation, "axial_reaction_max") == pytest.approx(axial, rel=1e-9)


def test_balance_takes_what_the_extremes_leave_and_nothing_is_left_beyond() -> None:
    found = [number(crankshaft(), name) for name in ("torque_max", "torque_min")]
    assert found == [494, -327]
    assert float(crankshaft().sample("torque", np.array([[0.33]]), np.array([[0.33]]))[0, 0]) == 0


def test_reactions_over_the_cycle_are_in_balance_with_the_loads() -> None:
    force = Turned(lambda a: 3000 * np.cos(a))
    calculation = shaft(CRANKSHAFT, loads=[{"name": "one", "position": 130, "force_y": force}])
    angles = calculation.domains["cycle_angle"].samples
    a, b = (calculation.curve_samples(f"reaction_{name}_y") for name in "ab")
    assert_allclose(a + b, -3000 * np.cos(angles), atol=1e-9)
    assert np.max(calculation.curve_samples("reaction_b")) == pytest.approx(
        number(calculation, "reaction_b_max"), rel=1e-9
    )


@pytest.mark.parametrize(("downwards", "y", "z"), [("-90 deg", 0, -1), ("0 deg", 1, 0), ("30 deg", cos(pi / 6), 0.5)])
def test_weights_act_downwards_at_the_place_of_their_mass(downwards: str, y: float, z: float) -> None:
    force = {"name": "rim", "position": 130, "mass": "100 kg", "force_y": 50, "offset": 40}
    bare, weighed = (shaft(CRANKSHAFT, loads=[force], **keys) for keys in ({}, {"downwards": downwards}))
    weight, a, b = 100 * 9.80665, number(bare, "bearing_a"), number(bare, "bearing_b")
    share = (0.13 - a) / (b - a)
    for axis, direction in (("y", y), ("z", z)):
        before, after = (
            [each.curve_samples(f"reaction_{name}_{axis}")[0, 0] for name in "ab"] for each in (bare, weighed)
        )
        added = np.array(after) - before
        assert_allclose(added, [-weight * direction * (1 - share), -weight * direction * share], atol=1e-9)


def test_the_seat_of_what_brings_a_load_weakens_the_shaft_unless_it_is_loose_or_none() -> None:
    """By DIN 743-2, R_m 900 MPa: 2.7 · 0.9^0.43 = 2.580 of 40 mm, 2.604 of 55 mm."""
    found = {seat: row(shaft(CRANKSHAFT, notches=[], loads=[GEAR | seated, CRANK]), "k_f")["load gear"]
             for seat, seated in (("default", {}), *((seat, {"seat": seat}) for seat in ("tight", "loose", "none")))}  # fmt: skip
    assert found == pytest.approx({"default": 2.604, "tight": 2.604, "loose": 1, "none": 1}, rel=1e-3)
    keyed = row(shaft(CRANKSHAFT), "k_f")["load gear"]
    assert keyed == pytest.approx(2.912, rel=1e-3)  # of the keyseat there, the greater


def test_of_two_notches_at_one_place_the_greater_factors_hold() -> None:
    both = [
        {"position": 130, "type": "custom", "k_f": 2.5, "k_fs": 1.2},
        {"position": 130, "type": "custom", "k_f": 1.5, "k_fs": 2.2},
    ]
    calculation = shaft(CRANKSHAFT, notches=both, loads=[GEAR | {"seat": "none"}, CRANK])
    for place in ("notch 1 (custom)", "notch 2 (custom)", "load gear"):
        assert [row(calculation, name)[place] for name in ("k_f", "k_fs")] == [2.5, 2.2]


def by_din_743(of_40_mm: float, diameter: float) -> float:
    """A fatigue notch factor of DIN 743-2 at a diameter (mm)."""
    k_3 = [1 - 0.2 * log10(of_40_mm) * log10(min(max(d, 7.5), 150) / 7.5) / log10(20) for d in (40, diameter)]
    return of_40_mm * k_3[0] / k_3[1]


@pytest.mark.parametrize("diameter", [5, 7.5, 40, 55, 150, 200])
@pytest.mark.parametrize(
    ("kind", "strength", "share"), [("press_fit", 900, 1), ("keyseat_end_mill", 900, 1), ("keyseat_pair", 500, 1.15)]
)
def test_keyseats_and_press_fits_have_the_factors_of_din_743(
    kind: str, strength: float, share: float, diameter: float
) -> None:
    calculation = shaft(
        LAYSHAFT, sections=[{"length": 500, "diameter": diameter}], notches=[{"position": 130, "type": kind}], tensile_strength=strength,
        yield_strength=300,
    )  # fmt: skip
    bending = 2.7 * (strength / 1000) ** 0.43 if kind == "press_fit" else 3.0 * (strength / 1000) ** 0.38
    torsion = 0.65 * bending if kind == "press_fit" else 0.56 * bending + 0.1
    place = f"notch 1 ({kind.replace('_', ' ')})"
    found = [row(calculation, name)[place] for name in ("k_f", "k_fs")]
    assert found == pytest.approx([share * by_din_743(each, diameter) for each in (bending, torsion)], rel=1e-12)


def test_a_seat_of_a_bearing_is_a_press_fit_unless_it_is_loose() -> None:
    tight = {name: value for name, value in CRANKSHAFT.items() if not name.startswith("seat")}
    assert row(shaft(tight), "k_f")["bearing A"] == pytest.approx(by_din_743(2.7 * 0.9**0.43, 45))
    assert row(shaft(tight | {"seat_a": "loose"}), "k_f")["bearing A"] == 1
    assert row(shaft(tight | {"seat_a": "loose"}), "k_f")["bearing B"] > 2.6


@pytest.mark.parametrize("place", [GEAR_KEY, CRANK_KEY])
def test_the_safety_at_a_keyseat_follows_from_its_stresses(place: str) -> None:
    """Distortion energy and Goodman, written out."""
    known = {
        name: row(crankshaft(), name)[place]
        for name in ("sigma_a", "sigma_m", "tau_a", "tau_m", "k_f", "k_fs", "place_endurance")
    }
    alternating, mean = (
        np.hypot(known["k_f"] * known[f"sigma_{end}"], np.sqrt(3) * known["k_fs"] * known[f"tau_{end}"]) for end in "am"
    )
    expected = 1 / (alternating / known["place_endurance"] + mean / 900e6)
    assert row(crankshaft(), "place_safety")[place] == pytest.approx(expected, rel=1e-9)


# --- checks and their advice ----------------------------------------------------------------------------------------------


def grown(keys: dict[str, Any], factor: float) -> dict[str, Any]:
    """A shaft of which all diameters, bores and radii are greater."""
    sizes = ("diameter", "bore", "fillet_radius")
    sections = [part | {name: part[name] * factor for name in sizes if name in part} for part in keys["sections"]]
    return keys | {"sections": sections}


def test_without_their_keys_checks_are_not_made() -> None:
    found = statuses(crankshaft())
    assert {name for name, status in found.items() if status == "not_checked"} == {
        "critical_speed",
        "deflection",
        "twist",
    }


def test_only_steps_with_a_fillet_are_held_against_the_charts_of_fillets() -> None:
    made = {check.id: check for check in check_results(crankshaft())}["notch_range"]
    assert [part.status for part in made.parts if part.status] == ["pass"] * 3
    plain = shaft(CRANKSHAFT, sections=[{"length": 340, "diameter": 50}])
    assert "notch_range" not in statuses(plain)


def test_the_stress_along_the_shaft_is_that_of_each_section_and_has_the_greatest_as_its_peak() -> None:
    calc = crankshaft()
    x = np.array([[0.125, 0.215, 0.27, 0.30]])
    moment, torque, stress = (calc.sample(name, x, x)[0] for name in ("bending_moment", "torque", "stress_along"))
    size = np.array([0.055, 0.055, 0.060, 0.050])
    bound = np.hypot(32 * moment / (np.pi * size**3), 3**0.5 * 16 * torque / (np.pi * size**3))
    assert (stress <= bound * (1 + 1e-12)).all() and (stress >= 32 * moment / (np.pi * size**3) * (1 - 1e-12)).all()
    peak = np.full((1, 2), number(calc, "nominal_position"))
    assert calc.sample("stress_along", peak, peak + np.array([[-1e-3, 1e-3]])).max() == pytest.approx(
        number(calc, "von_mises_max"), rel=1e-9
    )


def test_a_shaft_that_does_not_turn_is_held_against_no_critical_speed() -> None:
    """Neither with a speed nor, as one that is not given, without."""
    assert statuses(shaft(CRANKSHAFT, speed=60))["critical_speed"] == "pass"
    assert "critical_speed" not in statuses(shaft(STANDING)) and "critical_speed" not in statuses(
        shaft(STANDING, speed=60)
    )
    assert "at_rest" not in statuses(shaft(CRANKSHAFT)) and "at_rest" not in statuses(shaft(STANDING))


def test_a_fillet_beyond_the_charts_and_a_wide_bore_warn() -> None:
    sections = [SECTIONS[0] | {"fillet_radius": 0.5}, SECTIONS[1] | {"bore": 40}, *SECTIONS[2:]]
    found = statuses(shaft(CRANKSHAFT, sections=sections))
    assert found["notch_range"] == found["hollow_notch"] == "warn"


# --- what cannot be -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        ({"bearing_b": 400}, "bearing_b", "beside the shaft"),
        ({"bearing_a": 260}, "bearing_b", "not beyond bearing_a"),
        ({"total_length": 350}, "sections", "add up to 340 mm, but total_length is 350 mm"),
        ({"loads": [{"name": "nothing", "position": 100}]}, "loads", "have neither force, couple nor torque"),
        ({"loads": [GEAR | {"position": 500}, CRANK]}, "loads.0.position", "beyond the shaft"),
        ({"notches": [{"position": 345, "type": "groove_ring"}]}, "notches.0.position", "beyond the shaft"),
        ({"loads": [GEAR, CRANK | {"torque": 10}]}, "loads", "add up to"),
        ({"loads": [GEAR | {"torque": "balance"}, CRANK]}, "loads.1.torque", "only one load can balance"),
        (
            {"loads": [GEAR | {"gear": {"pitch_radius": 60, "mesh_angle": 0}}, CRANK]},
            "loads.0.torque",
            "at each instant",
        ),
        ({"loads": []}, "loads", "at least one load"),
        ({"sections": []}, "sections", "at least one section"),
        ({"sections": [SECTIONS[0] | {"bore": 45}, *SECTIONS[1:]]}, "sections.0.bore", "smaller bore"),
        (
            {"sections": [SECTIONS[0] | {"fillet_radius": 6}, *SECTIONS[1:]]},
            "sections.0.fillet_radius",
            "smaller radius",
        ),
        ({"sections": [*SECTIONS[:3], SECTIONS[3] | {"fillet_radius": 2}]}, "sections.3.fillet_radius", "no step"),
        ({"yield_strength": 950}, "yield_strength", "above the tensile strength"),
        (
            {"notches": [{"position": 100, "type": "custom", "k_t": 2}]},
            "notches.0",
            "k_t, k_ts and radius, or k_f and k_fs",
        ),
        ({"notches": [{"position": 100, "type": "keyseat_sled_runner"}]}, "notches.0", "give its k_t and k_ts"),
        ({"notches": [{"position": 100, "type": "press_fit", "radius": 1}]}, "notches.0.radius", "remove it"),
        ({"notches": [{"position": 100, "type": "groove_ring", "k_t": 2}]}, "notches.0", "type custom"),
    ],
)
def test_what_cannot_be_is_refused_in_words(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        shaft(CRANKSHAFT, **changes)
    assert refused.value.key == key
    assert words in refused.value.message


def test_curves_of_unlike_cycles_are_refused() -> None:
    one, other = Turned(np.cos), Turned(np.sin)
    other.cycle = "disc_angle"
    with pytest.raises(Impossible, match="crank_angle"):
        shaft(CRANKSHAFT, loads=[GEAR | {"torque": 0, "force_y": one}, CRANK | {"force_y": other}])


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"torque": {"min": 5, "max": 1}}, "exchange"),
        ({"torque": {"min": 5}}, "min and max"),
        ({"force_y": {"min": 1, "max": 5}}, "number or a reference"),
        ({"torque": "balanced"}, "balance"),
    ],
)
def test_a_load_that_is_neither_number_nor_curve_is_refused(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        inputs(MECHANISM, CRANKSHAFT | {"loads": [GEAR | keys, CRANK]})


def test_a_reliability_that_is_not_listed_is_refused_with_those_that_are() -> None:
    with pytest.raises(ValueError, match=r"50, 90, 95, 99, 99.9, 99.99 %"):
        inputs(MECHANISM, CRANKSHAFT | {"reliability": 98})


# --- steels ---------------------------------------------------------------------------------------------------------------------


def of_steel(grade: str, factor: float = 1.0) -> Calculation:
    """The crankshaft of a steel, and of another size."""
    keys = {name: value for name, value in CRANKSHAFT.items() if name not in ("tensile_strength", "yield_strength")}
    return shaft(grown(keys, factor), material=grade)


@pytest.mark.parametrize(
    ("grade", "factor", "tensile", "proof"),
    [
        ("42CrMo4+QT", 1, 900, 650),
        ("42CrMo4+QT", 100 / 60, 900, 650),
        ("42CrMo4+QT", 2, 800, 550),
        ("42CrMo4+QT", 3, 750, 500),
        ("C45E+QT", 1, 630, 370),
        ("C45E+N", 1, 580, 305),
        ("C45E+N", 2, 560, 275),
    ],
)
def test_a_steel_has_the_strengths_of_the_greatest_diameter(
    grade: str, factor: float, tensile: float, proof: float
) -> None:
    found = of_steel(grade, factor)
    assert [number(found, name) / 1e6 for name in ("tensile_strength", "yield_strength")] == [tensile, proof]


def test_the_named_steel_judges_as_its_typed_strengths_do() -> None:
    assert number(of_steel("42CrMo4+QT"), "fatigue_safety") == number(crankshaft(), "fatigue_safety")


def test_a_steel_beyond_its_sizes_is_refused() -> None:
    with pytest.raises(Impossible, match="known up to 100 mm"):
        of_steel("C45E+QT", 2)


def test_a_shaft_that_stands_has_no_speed() -> None:
    """A word makes neither the fatigue milder nor the critical speed go away: what has a speed turns."""
    assert statuses(shaft(STANDING, speed=1500))["at_rest"] == "fail"


def test_the_growth_counts_on_the_strengths_of_a_thicker_bar() -> None:
    keys = {key: value for key, value in STANDING.items() if key not in ("tensile_strength", "yield_strength")}
    keys |= {"material": "42CrMo4+QT", "sections": [{"length": 340, "diameter": 15.9}], "required_yield_safety": 3.4}
    test_a_failed_check_advises_larger_sections("yield", keys)
