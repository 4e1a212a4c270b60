"""A press that is calculated again gives what the ordinary way gives, bit for bit, and calculates only what depends on the change."""

from __future__ import annotations

import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import Config, load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design.inputs import design_input, given_numbers
from diecut_report.errors import UserError
from diecut_report.mechanism.names import SI
from diecut_report.results.document import document
from diecut_report.results.model import ResultsRecord
from diecut_report.results.press_run import compute
from diecut_report.results.results_file import results_text
from diecut_report.results.usual import Beside
from diecut_report.results.warm_press import Remembered, Told, WarmPress
from diecut_report.study.definition.base_inputs import find_input, with_values
from tests.configs import BROKEN, DISCOVERY, EXAMPLES, GOOD, HEAD, LEVER, loaded
from tests.examples import few

TWO = HEAD + (
    "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 150}\n"
    "  b: {kind: lever, force: 3 kN, arm: 100 mm}\n"
    '  c: {kind: lever, force: 4 kN, arm: "${a.arm}"}\n'
)
ALL = Discovery([GOOD, BROKEN])


def changed(config: Config, path: str, value: float) -> Config:
    """The config with another SI value of an input."""
    asked = find_input(config, path)
    found, problems = with_values(config, {asked: SI(value, str(asked.unit), path)})
    assert not problems
    return found


def anew(config: Config) -> ResultsRecord:
    """The results of the ordinary way."""
    return document(compute(config, lambda _: None))


def assert_same(press: WarmPress, config: Config) -> None:
    """The press gives the results of the ordinary way; or the same words, where there are none."""
    try:
        wanted = anew(config)
    except UserError as fault:
        with pytest.raises(UserError) as caught:
            press.calculate(config)
        assert caught.value.problems == fault.problems
        return
    run = press.calculate(config)
    assert_parts(run, wanted)
    assert results_text(run.document()) == results_text(wanted)


def assert_parts(run: Any, wanted: ResultsRecord) -> None:
    """What a page shows is what stands in the results."""
    mechanisms = wanted.mechanisms
    assert run.checks == {name: data.checks for name, data in mechanisms.items()}
    assert (run.status, run.governing) == (wanted.status, wanted.governing)
    assert run.summary == wanted.summary
    assert run.errors.keys() == {name for name, data in mechanisms.items() if data.status == "error"}
    for name in run.calculations:
        data = mechanisms[name]
        shown = run.outputs(name), run.curves(name), run.figures(name), run.sections(name)
        keys = {each: output for each, output in data.outputs.items() if output.key}
        assert run.key_outputs(name) == keys and [*run.key_outputs(name)] == [*keys]
        assert shown == (data.outputs, data.curves, data.figures, data.sections)


def asked_anew(press: WarmPress, config: Config) -> list[str]:
    """Which mechanisms are calculated for a config."""
    names: list[str] = []
    press.calculate(config, names.append)
    return names


# --- what is calculated ----------------------------------------------------------------------------------------------


def test_only_what_depends_on_a_change_is_calculated(tmp_path: Path) -> None:
    press, config = WarmPress(), loaded(tmp_path, TWO)
    assert asked_anew(press, config) == ["a", "b", "c"]
    assert asked_anew(press, config) == []
    assert asked_anew(press, loaded(tmp_path, TWO)) == []  # the same file, read again
    assert asked_anew(press, changed(config, "mechanisms.b.force", 2500)) == ["b"]
    assert asked_anew(press, changed(config, "mechanisms.a.arm", 0.2)) == ["a", "c"]
    assert asked_anew(press, config) == []  # the start is remembered


def test_other_units_are_shown_anew(tmp_path: Path) -> None:
    press = WarmPress()
    press.calculate(loaded(tmp_path, LEVER))
    other = loaded(tmp_path, "report: {units: {a.moment: kN*m}}\n" + LEVER)
    assert asked_anew(press, other) == ["a"]
    assert_same(press, other)


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("name", "share", "calculated"),
    few(
        [
            ("drive.carriage_clearance", 1.01, ["drive", "timing", "train", "consistency"]),
            ("drive.cutting_force_per_length", 1.02, None),
        ],
        keep=lambda each: each[2] is not None,
    ),
)
def test_a_curve_that_is_as_it_was_leaves_who_takes_it(
    full_press: tuple[WarmPress, Config], name: str, share: float, calculated: list[str] | None
) -> None:
    """The drive is calculated anew, its curves of unit motion, and those of torque where no force has changed, are the same."""
    press, start = full_press
    config = changed(start, f"mechanisms.{name}", share * (design_input(start, name).present or 0.0))
    names: list[str] = []
    run, cold = press.calculate(config, names.append), WarmPress().calculate(config)
    assert names == calculated or calculated is None
    assert run.checks == cold.checks
    for own in run.calculations:
        assert (run.outputs(own), run.curves(own)) == (cold.outputs(own), cold.curves(own))


@pytest.fixture(scope="module")
def full_press() -> tuple[WarmPress, Config]:
    press, config = WarmPress(), load_config(PRESS, DISCOVERY)
    press.calculate(config)
    return press, config


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (SI(0.0, "m", "a.b"), SI(-0.0, "m", "a.b")),
        (0.0, -0.0), (1, 1.0), (1, True), ((1.0, None), (1.0,)), ((1.0, 0.0), (1.0, -0.0)), ({"a": 1.0}, {"b": 1.0}),
    ],
)  # fmt: skip
def test_inputs_that_are_only_nearly_the_same_are_others(tmp_path: Path, one: Any, other: Any) -> None:
    calculation = WarmPress().calculate(loaded(tmp_path, LEVER)).calculations["a"]
    told = Told(calculation.chosen_units, frozenset(), Beside({}, {}), ())
    known = Remembered(calculation, {"x": one}, told)
    shown = calculation.mechanism, told
    assert known.is_of(shown[0], {"x": one}, shown[1])
    assert not known.is_of(shown[0], {"x": other}, shown[1])
    assert not known.is_of(shown[0], {"x": one}, told._replace(unfounded=frozenset({"x"})))
    assert not known.is_of(shown[0], {"x": one}, told._replace(beside=Beside({}, {("x",): "why it is so"})))


def test_an_impossible_machine_is_told_and_the_last_good_one_is_kept(tmp_path: Path) -> None:
    press, config = WarmPress(), loaded(tmp_path, TWO)
    good = press.calculate(config)
    assert_same(press, changed(config, "mechanisms.a.arm", -1.0))
    assert good.status == "fail"
    assert asked_anew(press, config) == []


# --- the same as the ordinary way ------------------------------------------------------------------------------------


def edits(config: Config, count: int, seed: int) -> Iterator[Config]:
    """Random changes of one number each, from the last one or from the start."""
    chance, numbers, last = random.Random(seed), given_numbers(config), config
    for _ in range(count):
        design = chance.choice(numbers)
        value = design.present or 0.0
        value = round(value) + chance.choice((-1, 1)) if design.is_whole else value * chance.uniform(0.9, 1.1)
        if not design.allows(
            np.array(value)
        ):  # an efficiency above 1; where values are given they are judged before this
            continue
        found, problems = with_values(
            chance.choice((config, last)), {design.asked: SI(value, str(design.asked.unit), design.name)}
        )
        if not problems:
            last = found
            yield found


@pytest.mark.parametrize("path", few(EXAMPLES, lambda path: path.stem == "folding_knife"), ids=lambda path: path.stem)
@pytest.mark.nightly
def test_an_example_and_edits_of_it_give_what_the_ordinary_way_gives(path: Path) -> None:
    press, config = WarmPress(), load_config(path, DISCOVERY)
    assert_same(press, config)
    few_edits = 1 if path.stem == "folding_knife" else 12
    for edited in edits(config, few_edits, seed=len(path.stem)):
        assert_same(press, edited)
    assert_same(press, config)


GEARS = (
    "  a: {kind: gear_pair, module: 4 mm, teeth_1: 35, teeth_2: 212, face_width: 40 mm, torque: 12 N*m, shift_1: 0.1,\n"
    "      sigma_h_lim_1: 767 MPa, sigma_h_lim_2: 767 MPa, sigma_f_lim_1: 314 MPa, sigma_f_lim_2: 314 MPa}\n"
)
PRESS = next(path for path in EXAMPLES if path.stem == "flat_cylinder_press")
TO_AND_FRO = [
    (
        HEAD + GEARS,
        [
            ("12 N*m", "[1, 2, 3, -4]"),
            (" shift_1: 0.1,", ""),
            ("[1, 2, 3, -4]", "11 N*m"),
        ],
    ),
    *few(
        [
            (
                PRESS.read_text("utf-8"),
                [
                    ("6000 1/h", "5900 1/h"),
                    ("cycloidal #", "modified_sine #"),
                    ("5900 1/h", "5950 1/h"),
                    ("    radius: 105 mm #", "    #"),
                    ("driver_teeth: {value: 20", "driver_teeth: {value: 21"),
                    ("shoe_friction: 0.35", "shoe_friction: 0.34"),
                    ("flywheel_material: cast_iron", "flywheel_material: steel"),
                    ("modified_sine #", "cycloidal #"),
                    ("5950 1/h", "6000 1/h"),
                ],
            )
        ],
        lambda _: False,
    ),
]


@pytest.mark.parametrize(("text", "changes"), TO_AND_FRO, ids=["gears", "press"])
def test_changes_one_after_the_other_give_what_the_ordinary_way_gives(
    text: str, changes: list[tuple[str, str]], tmp_path: Path
) -> None:
    """Also such as alter what is calculated: a number becomes a list, a list grows, a key is left out, another text is chosen."""
    press = WarmPress()
    for old, new in [("", ""), *changes]:
        text = text.replace(old, new, 1) if old else text
        assert_same(press, loaded(tmp_path, text, Discovery([])))


BREAKS = TWO + (
    "  x: {kind: breaks_in_calculation}\n"
    "  y: {kind: lever, force: 1, arm: '${x.result}'}\n"
)  # fmt: skip
COMPARED = LEVER + "  x: {kind: breaks_in_comparison}\n"


def test_a_broken_mechanism_is_told_as_it_is_in_the_results(tmp_path: Path) -> None:
    press, config = WarmPress(), loaded(tmp_path, BREAKS, ALL)
    for _ in range(2):
        assert_same(press, config)
    run = press.calculate(config)
    assert (run.errors.keys(), run.skipped.keys(), run.status) == ({"x"}, {"y"}, "error")
    with pytest.raises(KeyError):
        run.outputs("x")


def test_a_broken_comparison_is_in_the_document(tmp_path: Path) -> None:
    config = loaded(tmp_path, COMPARED, ALL)
    run = WarmPress().calculate(config)
    assert run.status == "pass"
    assert results_text(run.document()) == results_text(anew(config))
    assert run.document().status == "error"


def test_what_contradicts_itself_gives_no_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    config = loaded(tmp_path, TWO)
    (check, *_) = (c for c in mechanism(config, "a").checks)
    monkeypatch.setitem(vars(check), "check_class", "numerical")
    press = WarmPress()
    assert_same(press, config)
    assert press.calculate(config).errors.keys() == {"a"}
    assert press.calculate(config).skipped.keys() == {"c"}


def mechanism(config: Config, name: str) -> Any:
    """What a mechanism of a config declares."""
    instance = config.instances[name]
    assert instance is not None
    return instance.mechanism
