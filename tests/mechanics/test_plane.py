"""Points, directions and meetings in the plane, on a linkage that is solved numerically from the lengths of its links."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import fsolve

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, abscissa, derivative, inner, m, pi, samples, value
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.formulas import Array
from diecut_report.formulas.expression import Expression, FormulaError
from diecut_report.formulas.tree import written
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics import plane
from diecut_report.mechanics.plane import Circle, Line
from diecut_report.mechanism.steps.protocols import Impossible
from tests.machines import inputs


class Toggle(Inputs):
    crank = Quantity("r", "mm", "Radius of the crank", gt=0, default=40)
    rod = Quantity("l", "mm", "Length of the rod", gt=0, default=300)
    lever = Quantity("l_1", "mm", "Length of the upper lever", gt=0, default=200)
    link = Quantity("l_2", "mm", "Length of the lower lever", gt=0, default=220)
    shaft_x = Quantity("x_O", "mm", "Place of the crankshaft", default=300)
    shaft_y = Quantity("y_O", "mm", "Height of the crankshaft", default=-180)
    frame = Quantity("h", "mm", "Height of the lever's pivot", default=15)
    tilt = Quantity("α", "deg", "Angle of the guide", default=-80)
    n_points = samples(36)


PIVOT = (0, m.frame)
TOLD: dict[str, Any] = {"side": "right", "guide": Line((0, 0), angle=m.tilt), "slide": "ahead", "rod": m.rod}


def toggle(*, turns: bool = True, **changes: Any) -> Mechanism:
    """A crank that moves the knee of a toggle, over a turn or at one angle; two links on the far side of their circles by ``changes``."""
    own, motion = TOLD | changes, Chapter("Motion")
    if turns:
        motion.angle = abscissa(2 * np.pi), "φ", "deg", "Crank angle"
    else:
        motion.angle = inner(pi / 3), "φ", "deg", "Crank angle"
    motion.pin = plane.polar(m.crank, m.angle, about=m.shaft), "A", "mm", "Crank pin", "geometry"
    motion.knee = plane.meet(Circle(m.pin, own["rod"]), Circle(PIVOT, m.lever), own["side"]), "B", "mm", "Knee joint"
    motion.ram = plane.meet(Circle(m.knee, m.link), own["guide"], own["slide"]), "C", "mm", "Ram"
    motion.lever_angle = plane.direction(PIVOT, m.knee, around=-pi / 2), "ψ", "deg", "Angle of the lever"
    motion.rod_way = plane.distance(m.pin, m.knee), "s", "mm", "Distance of crank pin and knee"
    motion.coupler = plane.on_link(m.pin, m.knee, m.rod, m.rod / 3, m.crank), "D", "mm", "Point of the rod"
    motion.turned = inner(plane.turned(m.coupler, m.tilt, about=m.pin)), "E", "mm", "It turned about the pin"
    motion.corner = value(plane.moved(m.pin, (m.crank, -m.rod))), "F", "mm", "Pin moved"
    return Mechanism(kind="toggle", version="1", title="Toggle", summary="", inputs=Toggle, chapters=(motion,))


@cache
def found(mechanism: Mechanism) -> dict[str, Array]:
    """The points over the turn, shape (2, places), and the scalars, of the toggle as it is; metres and radians."""
    calc = calculate(mechanism, inputs(mechanism, {}))
    names = ("pin", "knee", "ram", "coupler", "turned", "corner")
    return {name: np.stack([over(calc, f"{name}_{axis}") for axis in "xy"]) for name in names} | {
        name: over(calc, name) for name in ("lever_angle", "rod_way")
    }


def over(calc: Calculation, name: str) -> Array:
    values: Array = calc.curve_samples(name)[0] if name in calc.curves else np.full(36, calc[name][0, 0])
    return values


def length(one: Array, other: Array) -> Array:
    values: Array = np.linalg.norm(one - other, axis=0)
    return values


PLACES = np.arange(36) * 2 * np.pi / 36
FRAME = np.array([[0.0], [0.015]])


def test_its_declarations_and_dimensions_are_sound() -> None:
    check_mechanism(toggle())


@pytest.mark.parametrize(
    "side, slide", [("right", "ahead"), ("right", "behind"), ("left", "ahead"), ("left", "behind")]
)
def test_links_keep_their_lengths_and_joints_their_sides(side: str, slide: str) -> None:
    points = found(toggle(side=side, slide=slide))
    pin, knee, ram = points["pin"], points["knee"], points["ram"]
    shaft = np.array([[0.3], [-0.18]])
    assert pin == pytest.approx(shaft + 0.04 * np.stack([np.cos(PLACES), np.sin(PLACES)]), abs=1e-15)
    assert (length(knee, pin), length(knee, FRAME)) == (pytest.approx(0.3), pytest.approx(0.2))
    assert points["rod_way"] == pytest.approx(0.3)
    (from_x, from_y), (to_x, to_y) = FRAME - pin, knee - pin
    assert set(np.sign(from_x * to_y - from_y * to_x)) == {1.0 if side == "left" else -1.0}
    tilt = np.radians(-80)
    assert ram[0] * np.sin(tilt) == pytest.approx(ram[1] * np.cos(tilt), abs=1e-15)
    assert length(ram, knee) == pytest.approx(0.22)
    along = np.array([np.cos(tilt), np.sin(tilt)]) @ (ram - knee)
    assert set(np.sign(along)) == {1.0 if slide == "ahead" else -1.0}


def test_a_numeric_solution_of_the_loop_finds_the_same_joints() -> None:
    points = found(toggle())
    start = np.array([0.2, 0.1, 0.0, -0.05])
    for place in range(36):
        pin = points["pin"][:, place]

        def loop(joints: Array, pin: Array = pin) -> list[float]:
            knee, ram = joints[:2], joints[2:]
            own = np.hypot(*(knee - pin)) - 0.3, np.hypot(*(knee - FRAME[:, 0])) - 0.2, np.hypot(*(ram - knee)) - 0.22
            return [*own, float(ram @ [np.sin(np.radians(80)), np.cos(np.radians(80))])]

        start = fsolve(loop, start, xtol=1e-13)
        here = np.concatenate([points["knee"][:, place], points["ram"][:, place]])
        assert here == pytest.approx(start, abs=1e-9)


def test_a_point_of_the_rod_moves_with_it() -> None:
    """By complex numbers: the rod is turned by its direction, the point about the pin by the guide's angle."""
    points = {name: each[0] + 1j * each[1] for name, each in found(toggle()).items() if np.ndim(each) == 2}
    rod = (points["knee"] - points["pin"]) / 0.3
    on_rod = (0.1 + 0.04j) * rod
    assert points["coupler"] == pytest.approx(points["pin"] + on_rod, abs=1e-15)
    assert points["turned"] == pytest.approx(points["pin"] + on_rod * np.exp(1j * np.radians(-80)), abs=1e-15)
    assert points["corner"] == pytest.approx(points["pin"] + 0.04 - 0.3j, abs=1e-15)


def test_a_direction_counts_from_where_it_is_asked_and_passes_half_a_turn() -> None:
    points = found(toggle())
    x, y = points["knee"] - FRAME
    assert points["lever_angle"] == pytest.approx(np.arctan2(y, x), abs=1e-14)
    leftwards = plane.direction((0, 0), (-1, m.y), around=pi)
    assert (evaluated(leftwards, y=0.2), evaluated(leftwards, y=-0.2)) == (
        pytest.approx(np.pi - np.arctan(0.2)), pytest.approx(np.pi + np.arctan(0.2)),
    )  # fmt: skip


def evaluated(made: Any, **known: float) -> float:
    return float(eval(repr(made).strip("<>").replace("^", "**").replace("π", "pi"), vars(np) | known))


def test_numbers_are_the_curves_at_their_place_and_many_machines_are_each_alone() -> None:
    single, turning = toggle(turns=False), toggle()
    names = ("knee_x", "knee_y", "ram_x", "ram_y", "lever_angle", "coupler_x")
    rods = np.array([0.28, 0.3, 0.32])
    many = calculate(single, {**inputs(single, {}), "rod": rods}, 3)
    curves = calculate(turning, {**inputs(turning, {}), "rod": rods}, 3)
    for row, rod in enumerate(rods):
        alone = calculate(single, {**inputs(single, {}), "rod": float(rod)})
        for name in names:
            assert float(many[name][row, 0]) == float(alone[name][0, 0])
            assert curves.curve_samples(name)[row, 6] == pytest.approx(float(alone[name][0, 0]), rel=1e-13)


def test_the_velocity_of_the_ram_is_that_of_the_power_of_its_links() -> None:
    """With the crank at 1 rad/s: the pin's velocity along the rod is the knee's, the knee's along the link the ram's."""
    mechanism = toggle(guide=Line((0, 0), angle=-pi / 2))
    chapter = mechanism.chapters[0]
    chapter.rate = derivative(of="ram_y"), "v", "mm", "Way of the ram for each radian"
    mechanism = Mechanism(kind="toggle", version="1", title="", summary="", inputs=Toggle, chapters=(chapter,))
    calc, at = calculate(mechanism, inputs(mechanism, {})), found(toggle(guide=Line((0, 0), angle=-pi / 2)))
    pin, knee, ram = at["pin"], at["knee"], at["ram"]
    rod, link, lever = knee - pin, ram - knee, knee - FRAME
    moved = 0.04 * np.stack([-np.sin(PLACES), np.cos(PLACES)])
    swing = np.stack([-lever[1], lever[0]])
    knee_moved = swing * (moved * rod).sum(axis=0) / (swing * rod).sum(axis=0)
    assert over(calc, "rate") == pytest.approx((knee_moved * link).sum(axis=0) / link[1], abs=1e-9)


@pytest.mark.parametrize("turns", [True, False], ids=["a turn", "one angle"])
@pytest.mark.parametrize(
    "keys, key, words",
    [
        ({"rod": "100 mm"}, "rod", "is too short: the circles that meet in “Knee joint” lie farther apart than both radii together"),
        ({"rod": "900 mm"}, "rod", "is too unlike the other radius: of the circles that meet in “Knee joint” one lies within the other"),
        ({"link": "40 mm"}, "link", "is too short: the circle and the line that meet in “Ram” do not reach each other"),
    ],
    ids=["apart", "within", "beside"],
)  # fmt: skip
def test_a_machine_whose_links_do_not_meet_is_refused_in_words(
    turns: bool, keys: dict[str, str], key: str, words: str
) -> None:
    mechanism = toggle(turns=turns)
    with pytest.raises(Impossible) as told:
        calculate(mechanism, inputs(mechanism, keys))
    assert (told.value.key, told.value.message.partition(" (at φ = ")[0]) == (key, words)
    assert ("(at φ = " in told.value.message) == turns


def test_circles_about_one_centre_do_not_meet() -> None:
    chapter = Chapter("Knee")
    chapter.knee = plane.meet(Circle((0, 0), m.rod), Circle((m.frame, 0), m.lever), "left"), "B", "mm", "Knee"
    mechanism = Mechanism(kind="knee", version="1", title="Knee", summary="", inputs=Toggle, chapters=(chapter,))
    with pytest.raises(Impossible, match="one lies within the other"):
        calculate(mechanism, inputs(mechanism, {"frame": "0 mm", "rod": "200 mm"}))


def test_of_many_machines_those_that_do_not_meet_are_marked() -> None:
    mechanism = toggle()
    rods = np.array([0.3, 0.1, 0.9, 0.31])
    calc = calculate(mechanism, {**inputs(mechanism, {}), "rod": rods}, 4)
    assert {row: key for row, (key, _) in calc.flaws.items()} == {1: "rod", 2: "rod"}
    assert np.isfinite(calc.curve_samples("ram_y")[[0, 3]]).all()


def test_a_line_through_two_points_is_that_at_their_angle() -> None:
    at_angle = found(toggle(guide=Line((0, m.frame), angle=m.tilt)))
    through = toggle(guide=Line((0, m.frame), through=plane.polar(2 * m.crank, m.tilt, about=(0, m.frame))))
    check_mechanism(through)
    assert found(through)["ram"] == pytest.approx(at_angle["ram"], abs=1e-15)


def test_an_alternative_by_a_text_has_its_own_side() -> None:
    chapter = Chapter("Knee")
    for side in ("left", "right"):
        met = plane.meet(Circle((0, 0), m.rod), Circle((m.frame, 0), m.lever), side)
        chapter.knee = value(met, needs=(f"assembly={side}",), digits=5), "B", "mm", "Knee"
    assert [(step.id, step.needs) for step in chapter][::7] == [
        ("knee_span", ("assembly=left",)), ("knee_span", ("assembly=right",)),
    ]  # fmt: skip


def test_what_is_printed_holds_no_zeros_ones_or_double_signs() -> None:
    made = plane.meet(Circle(m.knee, m.link), Line((0, 0), angle=-pi / 2), "ahead")
    chapter = Chapter("Ram")
    chapter.ram = made, "C", "mm", "Ram"
    told = {step.id: written(step.formulas().__next__().formula.tree) for step in chapter}
    assert told == {
        "ram_in_reach": "knee_x ^ 2 < link ^ 2",
        "ram_foot": "-knee_y",
        "ram_height": "sqrt(link ^ 2 - knee_x ^ 2)",
        "ram_x": "0",
        "ram_y": "-ram_foot + ram_height",
    }


def test_the_quantities_of_a_meeting_have_its_symbol_and_description() -> None:
    mechanism = toggle()
    calc = calculate(mechanism, inputs(mechanism, {}))
    items = {item["id"]: item for item in section_items(calc)[0]["items"] if "id" in item}
    told = [(name, items[name]["symbol"], items[name]["description"]) for name in items if name.startswith("knee_")]
    assert told == [
        ("knee_span", "d_B", "Knee joint: distance of the centres"),
        ("knee_foot", "a_B", "Knee joint: distance from the first centre, along the line of centres"),
        ("knee_height", "h_B", "Knee joint: distance from that line"),
        ("knee_x", "x_B", "Knee joint: x-coordinate"),
        ("knee_y", "y_B", "Knee joint: y-coordinate"),
    ]


REFUSED = {
    "no point": (lambda: plane.distance((0, 0), m.crank + m.rod), "<crank + rod> is not a point; write a quantity"),
    "a number": (lambda: plane.distance((0, 0), 5), "5 is not a point"),
    "a meeting at once": (
        lambda: plane.distance((0, 0), plane.meet(Circle((0, 0), m.rod), Line((0, 0)), "ahead")),
        "a meeting is declared before it is used",
    ),
    "a side of another": (
        lambda: plane.meet(Circle((0, 0), m.rod), Line((0, 0)), "left"),
        "side is 'left', not 'ahead' or 'behind'",
    ),
    "no key": (
        lambda: plane.meet(Circle((0, 0), m.rod / 2), Line((0, 0)), "ahead"),
        "the first radius is not an input; name the one to be changed",
    ),
}


@pytest.mark.parametrize("made, words", REFUSED.values(), ids=REFUSED.keys())
def test_a_mistake_is_told_with_the_authors_line(made: Any, words: str) -> None:
    with pytest.raises(FormulaError) as told:
        made()
    assert words in told.value.text and "test_plane.py:" in told.value.place


def test_a_radius_that_is_calculated_needs_an_input_as_its_key() -> None:
    assert [str(each) for each in faults(toggle(rod=m.pin_x))] != []
    assert "the key 'pin_x' is not an input" in str(faults(toggle(rod=m.pin_x))[0])


def test_a_point_that_is_not_declared_is_told() -> None:
    assert isinstance(plane.distance((0, 0), m.heel), Expression)
    chapter = Chapter("Way")
    chapter.way = plane.distance((0, m.frame), m.heel), "s", "mm", "Way"
    mechanism = Mechanism(kind="way", version="1", title="Way", summary="", inputs=Toggle, chapters=(chapter,))
    assert any("heel_x, which nothing gives" in str(each) for each in faults(mechanism))
