"""What the plugin contract can say, on a made-up mechanism in closed form; vertices of curves; compiled curves against plain formulas."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, CurveInput, Inputs, Mechanism, as_angle, formula, m, pi
from diecut_report.config.loader import Config, load_config
from diecut_report.config.model import PRESS
from diecut_report.config.plugins import Discovery
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle, Impossible, Unproven
from diecut_report.machine.numerics import curves as curve_evaluation
from diecut_report.machine.numerics.curves import MANY, Curves, Program
from diecut_report.machine.numerics.domain import shares
from diecut_report.machine.numerics.extremes import Spots, around, vertices
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.steps import Choice, Require, Root, Value
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import AbsentRecord
from diecut_report.study.definition.base_inputs import Input, UnknownPath, find_input, known_paths
from diecut_report.study.execution.press_batch import calculated
from tests.configs import ON_ARRAYS
from tests.examples import few
from tests.machine.toy import MECHANISM, ROOTED, cube, cubed, doubled, plus_one, same, zero
from tests.machines import inputs, number

STEP = np.radians(120)


def toy(**keys: Any) -> Calculation:
    """The toy with some keys."""
    return calculate(MECHANISM, inputs(MECHANISM, keys))


def test_a_formula_gives_a_number() -> None:
    assert number(toy(), "moment") == pytest.approx(200)


def test_extremes_take_one_sided_limits_at_a_jump_and_search_inside_a_piece() -> None:
    calc = toy()
    assert number(calc, "torque_max") == pytest.approx(200 * (np.sin(STEP) + 1), rel=1e-14)
    assert number(calc, "torque_max_at") == pytest.approx(STEP, abs=1e-12)
    assert number(calc, "torque_min") == pytest.approx(0, abs=1e-9)
    assert number(calc, "torque_range") == pytest.approx(200 * (np.sin(STEP) + 1), rel=1e-12)


@pytest.mark.parametrize("before", [1e-1, 1e-2, 1e-4, 1e-6])
def test_an_extreme_that_hides_beside_a_breakpoint_is_found(before: float) -> None:
    calc = toy(step_angle=90 - before)
    assert number(calc, "torque_max") == pytest.approx(400, rel=1e-14)
    assert number(calc, "torque_max_at") == pytest.approx(np.pi / 2, abs=1e-7)


def test_integrals_go_piece_by_piece() -> None:
    calc, on = toy(), 2 * np.pi - STEP
    assert number(calc, "work") == pytest.approx(200 * on, rel=1e-13)
    assert number(calc, "torque_mean") == pytest.approx(200 * on / (2 * np.pi), rel=1e-13)
    square = np.pi + on + 2 * (np.cos(STEP) - 1)
    assert number(calc, "torque_rms") == pytest.approx(200 * np.sqrt(square / (2 * np.pi)), rel=1e-12)


def test_crossings_are_found_inside_pieces_and_at_jumps() -> None:
    calc = toy(step_angle="270 deg")
    found = calc["turns"][0]
    np.testing.assert_allclose(np.degrees(found[np.isfinite(found)]), [180, 270], atol=1e-9)


def test_a_choice_gives_a_text_and_keeps_the_branch() -> None:
    assert toy(force=2)["verdict"][0, 0] == "light"
    assert toy(force=6)["verdict"][0, 0] == "heavy"
    assert mechanism_results(toy(force=6), {}).outputs["verdict"].value == "heavy"


def test_an_output_can_exist_under_a_condition() -> None:
    assert mechanism_results(toy(force=2), {}).outputs["twice"].value == pytest.approx(400)
    heavy = mechanism_results(toy(force=7), {})
    assert "twice" not in heavy.outputs
    assert [c.id for c in heavy.checks] == ["rated"]


@pytest.mark.parametrize("force, rated", [(0.9, 100), (1.0, 100), (1.001, 200), (5, 800), (20, 800)])
def test_a_standard_value_is_picked_at_or_above(force: float, rated: float) -> None:
    assert number(toy(force=force), "rated") == rated


def test_the_neighbours_that_were_not_taken_are_printed() -> None:
    items = [i for s in mechanism_results(toy(force=3), {}).sections for i in s.items]
    picked = next(i for i in items if i.id == "rated")
    assert "200" in picked.method and "800" in picked.method and picked.result.text == "400"


def test_repeated_parts_make_rows_sums_and_products() -> None:
    gears = [{"driver_teeth": 20, "driven_teeth": 60}, {"driver_teeth": 18, "driven_teeth": 45}]
    calc = toy(gears=gears)
    np.testing.assert_allclose(calc["pair_ratio"], [[3, 2.5]])
    assert number(calc, "total_ratio") == pytest.approx(7.5)
    assert number(calc, "total_teeth") == 38
    results = mechanism_results(calc, {})
    assert results.outputs["pair_ratio.1"].value == 2.5
    assert results.inputs["gears.1.driven_teeth"].value == 45
    tables = [i for s in results.sections for i in s.items if i.type == "table" and i.title == "Ratio of the pair"]
    assert [row[-1] for row in tables[0].rows] == ["3", "2.5"]


def test_an_absent_block_switches_its_chapter_off_and_says_so() -> None:
    without, with_spring = mechanism_results(toy(), {}), mechanism_results(toy(spring={"stiffness": "100 N/mm"}), {})
    assert AbsentRecord(title="Spring", text="no spring is given") in without.absent
    assert with_spring.outputs["sag"].value == pytest.approx(0.02)
    assert "Spring" not in [a.title for a in with_spring.absent]


def test_a_family_of_outputs_is_written_once() -> None:
    calc = toy()
    assert number(calc, "first_load_moment") == number(calc, "second_load_moment") == pytest.approx(200)


def test_a_curve_is_an_input_of_another_mechanism_with_its_breakpoints() -> None:
    source = toy(step_angle="33.3 deg")
    taken = calculate(MECHANISM, inputs(MECHANISM, {"n_points": 40}) | {"torque_curve": CurveHandle(source, "torque")})
    assert number(taken, "taken_max") == pytest.approx(number(source, "torque_max"), rel=1e-12)
    assert number(taken, "taken_mean") == pytest.approx(number(source, "torque_mean"), rel=1e-12)


def test_a_curve_taken_over_keeps_its_one_sided_limits_at_a_jump() -> None:
    taken = toy(torque_curve=CurveHandle(toy(), "torque"))
    (curve,) = (mechanism_results(taken, {}).curves[name] for name in ("taken",))
    jump = curve.breakpoints.index(pytest.approx(2 * np.pi / 3))
    moment = 200 * np.sin(2 * np.pi / 3)
    assert (curve.left[jump], curve.right[jump]) == (pytest.approx(moment), pytest.approx(moment + 200))


def test_a_list_of_values_is_a_curve_that_runs_straight_between_them() -> None:
    calc = toy(torque_curve=[0, 10, 0, -10])
    assert number(calc, "taken_max") == pytest.approx(10)
    assert number(calc, "taken_mean") == pytest.approx(0, abs=1e-12)


def root_step() -> Root:
    """The only step of the mechanism with a root."""
    step = ROOTED.chapters[0].steps[0]
    assert isinstance(step, Root)
    return step


def test_a_root_is_found_and_proved() -> None:
    assert number(calculate(ROOTED, inputs(ROOTED, {})), "x") == pytest.approx(2000 ** (1 / 3), rel=1e-13)


def test_a_root_that_its_relation_does_not_confirm_is_refused() -> None:
    wrong = replace(root_step(), right=plus_one)
    with pytest.raises(Unproven, match="Cube root"):
        calculate(replace(ROOTED, chapters=(Chapter("Root", steps=(wrong,)),)), inputs(ROOTED, {}))


def test_a_relation_that_is_zero_on_both_sides_is_proved() -> None:
    """Both sides may become nothing for a sensible machine, such as one without a gap."""
    nothing = replace(root_step(), low=zero, equation=cubed, left=zero, right=zero)
    calc = calculate(replace(ROOTED, chapters=(Chapter("Root", steps=(nothing,)),)), inputs(ROOTED, {}))
    assert (number(calc, "x"), calc.proof["x"]) == (0.0, 0.0)


def test_a_bracket_without_a_root_is_no_silent_nan() -> None:
    empty = replace(root_step(), high=zero, low=zero, equation=cube)
    with pytest.raises(Unproven):
        calculate(replace(ROOTED, chapters=(Chapter("Root", steps=(empty,)),)), inputs(ROOTED, {}))


def test_an_impossible_machine_is_refused_in_the_users_words() -> None:
    with pytest.raises(Impossible) as refused:
        toy(arm="600 mm")
    assert (refused.value.key, refused.value.message) == ("arm", "is 600 mm, too long for 2 kN")


def test_an_impossible_variant_is_marked_and_leaves_its_neighbours_alone() -> None:
    base = inputs(MECHANISM, {})
    calc = calculate(MECHANISM, base | {"arm": np.array([0.1, 0.6, 0.2])}, variants=3)
    assert calc.flaws == {1: ("arm", "is 600 mm, too long for 2 kN")}
    np.testing.assert_allclose(calc["moment"][[0, 2], 0], [200, 400])
    np.testing.assert_allclose(calc["torque_max"][[0, 2], 0], np.array([200, 400]) * (np.sin(STEP) + 1))


root_of = formula(lambda arm: np.sqrt(arm))
is_between = formula(lambda root: root > 0.5)


def test_what_follows_from_an_impossible_number_makes_no_message() -> None:
    steps = (
        Require(id="positive", condition=m.arm > 0, key="arm", message="is {arm}"),
        Value(id="root", symbol="r", unit="m", description="Root", formula=root_of.of()),
        Require(id="long", condition=is_between, key="arm", message="has a root of {root}"),
    )
    mechanism = Mechanism(
        kind="m", version="1", title="M", summary="M.", inputs=MECHANISM.inputs, chapters=(Chapter("S", steps=steps),)
    )
    calc = calculate(mechanism, inputs(MECHANISM, {}) | {"arm": np.array([0.04, -1.0])}, 2)
    assert calc.flaws[0][1] == "has a root of 0.2 m" and calc.flaws[1][1] == "is -1000 mm"


def test_variants_may_jump_at_places_of_their_own() -> None:
    places = np.radians([10.0, 200.0, 350.0])
    calc = calculate(MECHANISM, inputs(MECHANISM, {}) | {"step_angle": places}, variants=3)
    np.testing.assert_allclose(calc["work"][:, 0], 200 * (2 * np.pi - places), rtol=1e-12)


def test_a_number_that_is_not_finite_is_refused() -> None:
    with pytest.raises(Unproven, match="moment"):
        calculate(MECHANISM, inputs(MECHANISM, {}) | {"force": float("nan")})


def test_curves_in_results_carry_their_one_sided_values() -> None:
    torque = mechanism_results(toy(), {}).curves["torque"]
    assert torque.breakpoints == pytest.approx([STEP])
    assert torque.left == pytest.approx([200 * np.sin(STEP)])
    assert torque.right == pytest.approx([200 * (np.sin(STEP) + 1)])
    assert len(torque.values) == 90


def test_formula_of_a_plugin_is_callable_alone() -> None:
    assert doubled(21) == 42


def test_repeated_parts_may_differ_in_their_optional_keys() -> None:
    first, second = {"driver_teeth": 20, "driven_teeth": 60}, {"driver_teeth": 20, "driven_teeth": 60, "label": "slow"}
    for gears in ([first, second], [second, first]):
        assert inputs(MECHANISM, {"gears": gears})["gears.label"] == tuple(g.get("label") for g in gears)


def test_a_required_curve_may_not_be_empty() -> None:
    class Needy(Inputs):
        curve = CurveInput("M", "N*m", "Torque")

    with pytest.raises(ValueError, match="curve or a list"):
        Needy.model_validate({"curve": None})


def test_each_crossing_can_be_referred_to() -> None:
    calc = toy(step_angle="270 deg")
    known = MECHANISM.results_of(calc.given)
    assert {"turns_count", "turns_1", "turns_2"} < set(known)
    assert number(calc, "turns_count") == 2
    assert np.degrees(number(calc, "turns_2")) == pytest.approx(270)


def test_a_root_without_a_change_of_sign_names_its_bracket() -> None:
    step = ROOTED.chapters[0].steps[0]
    shifted = replace(ROOTED, chapters=(Chapter("Root", steps=(replace(step, low=same.of(quantity=m.target)),)),))
    template = r"Cube root \(x, toy\.py:\d+\): the equation does not change its sign between low = 2000 and high = 2001"
    with pytest.raises(Unproven, match=template):
        calculate(shifted, {"target": 2000.0})


def rooted(**changes: Any) -> Mechanism:
    step = ROOTED.chapters[0].steps[0]
    return replace(ROOTED, chapters=(Chapter("Root", steps=(replace(step, **changes),)),))


NO_PROOF = {
    "a relation that always holds": (
        {"left": lambda x: np.sin(as_angle(x)) ** 2, "right": lambda x: 1 - np.cos(as_angle(x)) ** 2},
        "left and right are equal everywhere between low = 0 and high = 2001, not at the root alone, so that they prove nothing",
    ),
    "one side twice": ({"left": cubed, "right": cubed}, "left and right are equal everywhere"),
    "a pole, which the relation proves": (
        {"equation": lambda x, target: 1 / (x - target / 3), "left": lambda x: 3 * x, "right": same.of(quantity=m.target)},
        "the equation has a pole between low = 0 and high = 2001, where it changes its sign without a root",
    ),
    "a pole of the tangent": (
        {"equation": lambda x: np.tan(as_angle(x)), "low": lambda: 1.0, "high": lambda: 2.5, "left": lambda x: x, "right": lambda: pi / 2},
        "the equation has a pole between low = 1 and high = 2.5",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", NO_PROOF)
def test_a_root_that_is_not_proved_is_refused_alone_and_among_others(name: str) -> None:
    changes, words = NO_PROOF[name]
    with pytest.raises(Unproven, match=r"Cube root \(x, .*: " + words) as alone:
        calculate(rooted(**changes), {"target": 2000.0})
    many = calculate(rooted(**changes), {"target": np.full(3, 2000.0)}, 3)
    assert many.flaws == dict.fromkeys(range(3), ("x", str(alone.value)))


@pytest.mark.parametrize(
    ("low", "high"), [(8.0, 8.0), (8 - 1e-12, 8 + 1e-12), (7.9, 8.0), (8.0, 1e6), (-1e3, 1e6)], ids=str
)
def test_a_root_in_any_bracket_is_proved(low: float, high: float) -> None:
    found = rooted(low=lambda target: 0 * target + low, high=lambda target: 0 * target + high)
    assert number(calculate(found, {"target": 512.0}), "x") == pytest.approx(8, rel=1e-12)


def test_a_number_may_have_the_name_of_a_place_that_no_extreme_gives() -> None:
    steps = Chapter("Toy")
    steps.twice_at = 3 * m.arm, "y", "m", "At"
    steps.twice = 2 * m.arm, "z", "m", "Twice"
    found = mechanism_results(
        calculate(replace(MECHANISM, chapters=(steps,), checks=(), figures=(), exports=()), {"arm": 1.0}), {}
    )
    assert (found.outputs["twice"].value, found.outputs["twice"].at) == (2, None) and found.outputs[
        "twice_at"
    ].value == 3


INTERVALS = 32
Curve = Callable[[Array], Array]


def told(curve: Curve, left: float, width: float, k: int | None = None) -> tuple[float, float, bool]:
    """The vertex of a curve in one piece about its greatest value on the grid (or a given point of it)."""
    values = curve(left + width * shares(INTERVALS))[None, :]
    spot = np.array([values.argmax() if k is None else k])
    spots = Spots(spot, around(values, np.array([0]), spot), np.array([left]), np.array([width]), INTERVALS)
    place, height, holds = vertices(lambda x, _: curve(x), spots)
    return float(place[0]), float(height[0]), bool(holds[0])


@pytest.mark.parametrize("seed", few(range(200), keep=lambda seed: seed % 5 == 0))
def test_a_peak_between_points_is_found_to_rounding(seed: int) -> None:
    random = np.random.default_rng(seed)
    top, left, width, size = (
        random.uniform(-2, 2),
        random.uniform(-5, 5),
        random.uniform(0.3, 2.5),
        10 ** random.uniform(-6, 6),
    )
    peak = left + width * random.uniform(0.05, 0.95)
    place, height, holds = told(lambda x: size * (top + np.cos(1.3 * (x - peak))), left, width)
    assert holds
    assert abs(place - peak) < 1e-7 * width
    assert abs(height - size * (top + 1)) < 1e-14 * size * (abs(top) + 1)


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_curve_that_falls_from_the_end_has_its_top_there(side: str) -> None:
    curve: Curve = np.exp if side == "right" else lambda x: np.exp(-x)
    place, height, holds = told(curve, 1.0, 2.0)
    assert holds
    assert height == (curve(np.array([3.0 if side == "right" else 1.0])))[0]
    assert abs(place - (3.0 if side == "right" else 1.0)) < 1e-15


@pytest.mark.parametrize("side", [1, -1])
def test_a_peak_between_the_end_and_the_next_point_is_found(side: int) -> None:
    first = shares(INTERVALS)[1]
    peak = side * (1 - 0.9 * first)  # in a piece from -1 to 1, nearer to its end than the first point
    curve: Curve = lambda x: 3 - (x - peak) ** 2  # noqa: E731
    place, height, holds = told(curve, -1.0, 2.0, INTERVALS if side > 0 else 0)
    assert holds
    assert abs(place - peak) < 1e-7
    assert abs(height - 3) < 1e-15


@pytest.mark.parametrize(
    "curve",
    [
        lambda x: -np.abs(x - 0.3),  # a corner
        lambda x: np.where(x < 0.3, x, x - 1),  # a jump
        lambda x: np.cos(3 * x) + 0.2 * np.cos(120 * x),  # more waves than points
        lambda x: np.sqrt(np.abs(x - 0.99)),  # an endless slope
        lambda x: np.where(np.abs(x - 0.3) < 0.001, 2.0, np.cos(x - 0.3)),  # a spike that the points do not show
    ],
    ids=["corner", "jump", "waves", "root", "spike"],
)
def test_a_curve_that_does_not_follow_the_polynomial_is_left_to_the_search(curve: Curve) -> None:
    values = curve(-1 + 2 * shares(INTERVALS))
    inner = 1 + int(np.argmax(values[1:-1]))
    assert not told(curve, -1.0, 2.0, inner)[2]


def test_nothing_holds_where_the_curve_is_no_number() -> None:
    assert not told(lambda x: np.full_like(x, np.nan), 0.0, 1.0, 4)[2]


def test_a_straight_line_has_no_vertex_inside() -> None:
    assert not told(lambda x: 2 * x, 0.0, 1.0, 5)[2]


COUNT = 2 * MANY
SPREAD = 0.02  # of each number about that of the example
PLACES = 9  # in each smooth piece
KINDS = {"cam_gear_transport", "circular_knife", "cylinder_drive", "drive_train", "elastic_follower", "geneva_transport", "knife_drive",
         "platen_press"}  # fmt: skip

SLOW = ("flat_cylinder_elements", "platen_press_zppt30")
EXAMPLES_AT_HAND = few(
    ON_ARRAYS, keep=lambda path: path.stem != "flat_cylinder_elements"
)  # its curves are also in another


def stem(path: Any) -> str:
    """The name of a test by that of its file."""
    return str(path.stem)


def varied(base: Config, random: np.random.Generator) -> dict[Input, Any]:
    """All numbers that the example gives, each as an array about its value there."""
    found: dict[Input, Any] = {}
    for asked, value in numbers_given(base):
        found[asked] = float(asked.meta.validate(value)) * random.uniform(1 - SPREAD, 1 + SPREAD, COUNT)
    return found


def numbers_given(base: Config) -> Iterator[tuple[Input, Any]]:
    for name, instance in base.instances.items():
        for path in known_paths(base, name) if instance and name != PRESS else ():
            try:
                asked = find_input(base, path)
            except UnknownPath:  # a list that the example does not give
                continue
            value = _given(instance.data, asked.key) if instance else None
            words = getattr(asked.meta, "words", ())  # that stand for a number
            is_number = isinstance(value, int | float | str) and "${" not in str(value) and value not in words
            if is_number and asked.unit and isinstance(asked.meta, Quantity) and not asked.meta.integer:
                yield asked, value


def _given(data: Any, key: Any) -> Any:
    for part in key:
        data = data[part] if isinstance(data, list) else (data or {}).get(part)
    return data


def machines(base: Config, texts: dict[str, str], seed: int) -> dict[str, Calculation]:
    values = varied(base, np.random.default_rng(seed)) | {find_input(base, path): text for path, text in texts.items()}
    return calculated(base, values, COUNT).calculations


def axes(calc: Calculation) -> Iterator[tuple[str, list[str]]]:
    for axis in calc.domains:
        yield axis, [name for name in calc.curves if calc.axis[name] == axis]


def assert_alike(calc: Calculation, axis: str, curves: list[str], seed: int) -> None:
    """The compiled curves are the plain ones to 1e-12 of the greatest term, at random places of random pieces."""
    pieces = calc.table(axis).pieces()
    possible = [row for row in range(len(pieces.left)) if pieces.variant[row] not in calc.flaws]
    middle, variant = pieces.middle[possible], pieces.variant[possible]
    shares = np.random.default_rng(seed).uniform(0.001, 0.999, (len(possible), PLACES))
    x = pieces.left[possible][:, None] + pieces.width[possible][:, None] * shares
    with np.errstate(all="ignore"):
        compiled = Curves(calc, axis, curves, middle, variant)
        assert compiled.program is not None
        plain = calc.sampler_of(axis, x, middle[:, None], variant)
        for name, found in zip(curves, compiled.at(x), strict=True):
            expected = np.broadcast_to(plain[name], x.shape)
            scale = np.nanmax(np.abs(expected), initial=0) + _terms(calc, axis, name, plain)
            np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * scale, err_msg=name)


def _terms(calc: Calculation, axis: str, name: str, plain: Any) -> float:
    """The greatest of what a curve is made of, of any kind of quantity over the abscissa."""
    step = calc.curves[name]
    taken = [n for n in step.takes() if isinstance(n, str)] if isinstance(step, Value | Choice) else []
    sizes = [np.nanmax(np.abs(np.asarray(plain[n], dtype=float)), initial=0) for n in taken if calc.axis.get(n) == axis]
    return max(map(float, sizes), default=0.0)


@pytest.mark.parametrize("path", few(ON_ARRAYS, lambda path: path.stem not in SLOW), ids=stem)
def test_compiled_curves_are_the_plain_formulas(path: Any) -> None:
    base = load_config(path, Discovery([]))
    for seed in range(2):
        found = machines(base, {}, seed)
        assert found
        for calc in found.values():
            assert len(calc.flaws) < COUNT
            for axis, curves in axes(calc):
                assert_alike(calc, axis, curves, seed)


@pytest.mark.parametrize("law", few(LAWS, keep=lambda law: law == "modified_trapezoidal"))
def test_compiled_motion_laws_are_the_plain_formulas(law: str) -> None:
    base = load_config(next(path for path in ON_ARRAYS if path.stem == "flat_cylinder_mechanisms"), Discovery([]))
    calc = machines(base, {"mechanisms.feeder.motion_law": law}, 3)["feeder"]
    assert calc.inputs["motion_law"] == law
    for axis, curves in axes(calc):
        assert_alike(calc, axis, curves, 3)


def test_all_kinds_that_have_curves_are_compared() -> None:
    found = {
        instance.mechanism.kind
        for path in ON_ARRAYS
        for instance in load_config(path, Discovery([])).instances.values()
        if instance and instance.mechanism and instance.mechanism.axes(instance.given)
    }
    assert found >= KINDS


def test_the_comparison_sees_a_wrong_term(monkeypatch: pytest.MonkeyPatch) -> None:
    base = load_config(next(path for path in ON_ARRAYS if path.stem == "flat_cylinder_mechanisms"), Discovery([]))
    calc = machines(base, {}, 0)["drive"]

    class Wrong(Program):
        def _constant(self, value: float) -> str:
            return super()._constant(value * (1 + 1e-9))

    monkeypatch.setattr(curve_evaluation, "program", lambda curves, *rest: Wrong(dict(curves), *rest))
    with pytest.raises(AssertionError):
        assert_alike(calc, "crank_angle", ["rocker_speed_ratio"], 0)
