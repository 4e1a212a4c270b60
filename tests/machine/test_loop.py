"""Rows in blocks, texts that choose, running integrals, sweeps and comparisons, on a made-up mechanism."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.printing.substitution import printed
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.press import Press
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import MechanismRecord
from tests.configs import problems, saved
from tests.machine.loop import COMPARED, MECHANISM, Loop

POSTS = [{"x": "-1 m"}, {"x": "3 m", "grip": "rough"}, {"x": "4 m"}]
HEAD = "schema_version: 1\nproject: {title: T}\npress: {name: P}\nmechanisms:\n"


def loop(**keys: Any) -> Calculation:
    return calculate(MECHANISM, flatten(Loop.model_validate({"pull": 1, "fence": {"posts": POSTS}} | keys)))


def told(**keys: Any) -> MechanismRecord:
    return mechanism_results(loop(**keys), {})


@pytest.fixture
def plugins(tmp_path: Path) -> Discovery:
    """The loop as a plugin of a folder."""
    folder = tmp_path / "plugins"
    folder.mkdir()
    (folder / "loop.py").write_text("from tests.machine.loop import MECHANISM\n", "utf-8")
    return Discovery([folder])


def test_the_declarations_keep_the_plugin_contract() -> None:
    check_mechanism(MECHANISM)
    check_mechanism(COMPARED)


def test_a_row_takes_its_neighbours_around_the_loop() -> None:
    calc = loop()
    np.testing.assert_allclose(calc["x_next"], [[3, 4, -1]])
    np.testing.assert_allclose(calc["gap"], [[4, 1, 5]])
    np.testing.assert_allclose(calc["way"], [[4, 5, 10]])
    assert [calc[n][0, 0] for n in ("length", "narrowest", "first_gaps", "last_gap")] == [10, 1, 5, 5]
    assert calc["friction"].tolist() == [[0.1, 0.4, 0.1]] and calc["friction_max"][0, 0] == 0.4


def test_the_parts_of_a_row_have_names() -> None:
    outputs = told().outputs
    assert [outputs[n].value for n in ("way_2", "way_3", "way_4")] == [4, 5, 10]
    assert [outputs[f"gap.{i}"].value for i in range(3)] == [4, 1, 5]
    assert MECHANISM.results_of(frozenset({"fence", "pull"}))["way_3"] == ("m", False)
    assert loop(fence={"posts": POSTS[:1] + POSTS[2:]})["way_2"][0, 0] == 5


def test_the_only_part_of_a_list_is_still_a_part(plugins: Discovery) -> None:
    with pytest.raises(Impossible):  # its neighbour is itself
        loop(fence={"posts": POSTS[:1]})


def test_inputs_in_a_list_in_a_block_keep_their_path() -> None:
    assert told().inputs["fence.posts.1.x"].value == 3
    assert told().inputs["fence.posts.1.grip"].value == "rough"


def test_the_part_that_cannot_be_is_named() -> None:
    with pytest.raises(Impossible, match="post 2 stands at 4 m, where post 3 stands") as refused:
        loop(fence={"posts": [{"x": 0}, {"x": 4}, {"x": 4}]})
    assert refused.value.key == "fence.posts.1.x"


def test_parts_that_clash_are_named() -> None:
    with pytest.raises(Impossible, match="posts 1 and 3 stand at one place") as refused:
        loop(fence={"posts": [{"x": 2}, {"x": 5}, {"x": 2}, {"x": 7}]})
    assert refused.value.key == "fence.posts.0"


def test_a_clash_marks_its_variant_and_leaves_its_neighbours_alone() -> None:
    values = flatten(Loop.model_validate({"pull": 1, "fence": {"posts": [{"x": 0}, {"x": 1}, {"x": 2}, {"x": 3}]}}))
    values["fence.posts.x"] = np.array([[0, 1, 2, 3], [0, 1, 0, 3], [0, 1, 4, 3]], dtype=float)
    calc = calculate(MECHANISM, values, 3)
    assert set(calc.flaws) == {1} and calc["length"][2, 0] == 8


def test_a_standard_value_comes_from_the_series_that_a_text_names() -> None:
    assert loop()["stock"][0, 0] == 10 and loop(material="chain")["stock"][0, 0] == 16
    item = next(i for s in told().sections for i in s.items if i.operation == "pick")
    assert "adjacent values not chosen: 5 m, 20 m" in item.method and item.series == "Rope lengths"
    assert item.note == "Rope lengths: Table one; Table two"


def test_a_number_is_looked_up_by_a_text() -> None:
    assert loop()["weight"][0, 0] == 0.5
    item = next(i for s in told(material="chain").sections for i in s.items if i.type == "lookup" and i.id == "weight")
    assert (item.key, item.table, item.result.text) == ("chain", "Weights", "2000")


def test_a_text_switches_steps_and_formulas() -> None:
    assert "chained" not in told().outputs and told(material="chain").outputs["chained"].value == 0
    assert min(told().curves["height"].values) < -0.9
    assert min(told(material="chain").curves["height"].values) == 0


def test_words_are_made_of_numbers_and_are_no_output() -> None:
    assert printed(loop(), "told") == "short" and "told" not in told().outputs


def test_a_running_integral_is_the_primitive() -> None:
    curves = told().curves
    turn = np.array(curves["turn"].values)
    np.testing.assert_allclose(curves["area"].values, 1 - np.cos(turn), atol=1e-14)
    assert told().outputs["area_range"].value == pytest.approx(2, rel=1e-12)


def test_a_running_integral_of_variants_is_that_of_each() -> None:
    calc = calculate(MECHANISM, {"pull": 1.0, "material": "rope", "n_points": 90, "swing": np.array([1.0, 3.0])}, 2)
    np.testing.assert_allclose(calc["area_range"][:, 0], [2, 6], rtol=1e-12)


def test_a_running_integral_of_listed_values_goes_from_corner_to_corner() -> None:
    wave = [0.0, 1.0, 0.0, -1.0] * 12
    curves = told(wave=wave).curves
    step = 2 * np.pi / 48
    places = np.arange(49) * step
    whole = np.concatenate([[0], np.cumsum((np.array(wave) + np.roll(wave, -1)) / 2 * step)])
    turn = np.array(curves["turn"].values)
    k = np.minimum((turn / step).astype(int), 47)
    inside = (turn - places[k]) / step
    rise = np.array(wave)[k] * inside + (np.roll(wave, -1) - np.array(wave))[k] * inside**2 / 2
    np.testing.assert_allclose(curves["wave_area"].values, whole[k] + rise * step, atol=1e-13)


def test_a_sweep_calculates_the_machine_again() -> None:
    first, second = told().figures[0].panels
    assert [line.y for line in first.lines] == [pytest.approx([0.5, 1, 1.5, 2])] * 2
    assert second.lines[0].y == pytest.approx([0, 1, 0, 1, 0], abs=1e-14)


def test_an_export_names_its_curves() -> None:
    assert [each.data() for each in told().exports] == [
        {"id": "rope", "title": "Rope", "type": "profile", "abscissa": "turn", "columns": ["height", "area"]}
    ]


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("", "pull, or mass and gravity is needed"),
        (", mass: 2 kg", "gravity is missing beside mass; give pull, or mass and gravity"),
        (", gravity: 9.8", "mass is missing beside gravity; give pull, or mass and gravity"),
        (", pull: 1, gravity: 9.8", "gravity has no use beside pull; remove it, or give pull, or mass and gravity"),
        (", pull: 1, mass: 2, gravity: 9.8", "pull and mass are both given"),
    ],
)
def test_one_group_of_inputs_is_needed(tmp_path: Path, plugins: Discovery, keys: str, words: str) -> None:
    (problem,) = problems(tmp_path, HEAD + f"  a: {{kind: loop{keys}}}\n", plugins)
    assert words in problem and problem.startswith("5:3: mechanisms.a")


def results(tmp_path: Path, text: str, plugins: Discovery) -> dict[str, Any]:
    made = Press.read(saved(tmp_path, text), plugins).calculate()
    assert not made.broken
    return dict(json.loads(made.text))


def test_an_optional_default_of_the_press_may_be_absent(tmp_path: Path, plugins: Discovery) -> None:
    without = HEAD + "  a: {kind: loop, pull: 1}\n"
    assert "visited" not in results(tmp_path, without, plugins)["mechanisms"]["a"]["outputs"]
    with_it = without.replace("{name: P}", "{name: P, productivity: 7200 1/h}")
    assert results(tmp_path, with_it, plugins)["mechanisms"]["a"]["outputs"]["visited"]["value"] == 2


def test_what_depends_on_an_absent_default_cannot_be_referred_to(tmp_path: Path, plugins: Discovery) -> None:
    text = HEAD + "  a: {kind: loop, pull: 1}\n  b: {kind: loop, pull: 1, visits: '${a.visited}'}\n"
    assert "calculated only if visits is given in a" in problems(tmp_path, text, plugins)[0]


def test_a_part_of_a_row_can_be_referred_to_by_its_name(tmp_path: Path, plugins: Discovery) -> None:
    posts = "{posts: [{x: 0}, {x: 2}]}"
    text = HEAD + f"  a: {{kind: loop, pull: 1, fence: {posts}}}\n  b: {{kind: loop, pull: 1, swing: '${{a.way_3}}'}}\n"
    assert results(tmp_path, text, plugins)["mechanisms"]["b"]["inputs"]["swing"]["value"] == 4


def test_a_whole_row_cannot_be_referred_to(tmp_path: Path, plugins: Discovery) -> None:
    text = (
        HEAD
        + "  a: {kind: loop, pull: 1, fence: {posts: [{x: 0}, {x: 2}]}}\n  b: {kind: loop, pull: 1, swing: '${a.gap}'}\n"
    )
    (problem,) = problems(tmp_path, text, plugins)
    assert "${a.gap} has a value for each of fence.posts; refer to one, as in ${a.gap.0}." in problem


def test_of_numbered_parts_the_first_is_suggested(tmp_path: Path, plugins: Discovery) -> None:
    text = (
        HEAD
        + "  a: {kind: loop, pull: 1, fence: {posts: [{x: 0}, {x: 2}]}}\n  b: {kind: loop, pull: 1, swing: '${a.way_}'}\n"
    )
    assert "(did you mean 'way_2'?)" in problems(tmp_path, text, plugins)[0]


def test_the_list_of_a_row_is_told(tmp_path: Path) -> None:
    assert told().lists == {"fence.posts": "Posts in order"} and told().outputs["gap.1"].list == "fence.posts"


def test_a_comparison_is_run_last_for_each_choice_of_instances(tmp_path: Path, plugins: Discovery) -> None:
    text = HEAD + "  a: {kind: loop, pull: 1, fence: {posts: [{x: 0}, {x: 2}]}}\n  b: {kind: loop, pull: 1, swing: 3}\n"
    found = results(tmp_path, text, plugins)["comparisons"]
    assert list(found) == ["loop_comparison-a", "loop_comparison-b"]
    first, second = found.values()
    assert (first["between"], first["outputs"]["ratio"]["value"]) == (["a"], 3)
    assert "ratio" not in second["outputs"] and second["outputs"]["height"]["value"] == 3
    assert first["inputs"]["one"]["path"] == "a.length"


def test_a_comparison_that_breaks_is_named(tmp_path: Path, plugins: Discovery, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(MECHANISM.comparisons[0].takes, "other", ("loop", "force"))  # type: ignore[arg-type]
    outcome = Press.read(saved(tmp_path, HEAD + "  a: {kind: loop, pull: 1}\n"), plugins).calculate()
    (error,) = outcome.broken
    assert "loop_comparison-a" in str(error) and outcome.results.status == "error"
