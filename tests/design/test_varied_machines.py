"""Inputs by their names, many machines in one run, and a chosen one calculated alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from diecut_report.design.inputs import design_input, given_numbers
from diecut_report.design.machines import MARGIN, narrowed, proved, quantities, varied, write_config
from diecut_report.errors import UserError
from diecut_report.press import Press
from tests.configs import DISCOVERY, EXAMPLE, HEAD, loaded, saved

TWO = (
    HEAD
    + """\
  a: {kind: lever, force: 2 kN, arm: 0.1 m, allowable_moment: {value: 250 N*m, basis: assumed}}  # the first
  b: {kind: lever, force: "${a.force}", arm: "${a.arm} / 2", width: "${press.sheet.length}", allowable_moment: 150 N*m}
  c: {kind: lever, force: 1, parts: [{length: 3 mm}]}
"""
)


def test_names_may_be_short_and_references_are_followed(tmp_path: Path) -> None:
    config = loaded(tmp_path, TWO)
    found = {name: design_input(config, name) for name in ("a.force", "mechanisms.a.force", "b.force", "b.width")}
    assert {name: each.name for name, each in found.items()} == {
        "a.force": "a.force",
        "mechanisms.a.force": "a.force",
        "b.force": "a.force",
        "b.width": "press.sheet.length",
    }
    arm = design_input(config, "a.arm")
    assert (arm.present, arm.unit, arm.bounds, arm.typed(0.12), arm.told(0.12)) == (
        0.1,
        "m",
        (0.0, 1.0),
        "0.12 m",
        "0.12 m",
    )
    assert design_input(config, "c.speed").present == pytest.approx(2 * np.pi * 6000 / 3600)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("b.arm", "b.arm follows from an expression, “${a.arm} / 2”"),
        ("a.arn", "'arn' is not an input of a (did you mean 'arm'?)"),
        ("d.arm", "d.arm is not a path of an input"),
        ("a.grade", "a.grade is a text, a choice or a yes/no"),
        ("a.moment", "is an output of a; only inputs"),
    ],
)
def test_what_cannot_be_changed_is_told(tmp_path: Path, name: str, words: str) -> None:
    with pytest.raises(UserError) as error:
        design_input(loaded(tmp_path, TWO), name)
    assert words in str(error.value)


def test_numbers_of_their_own_are_listed_in_order(tmp_path: Path) -> None:
    assert [each.name for each in given_numbers(loaded(tmp_path, TWO))] == [
        "press.productivity", "press.sheet.length", "press.sheet.thickness", "a.force", "a.arm", "a.allowable_moment",
        "b.allowable_moment", "c.force", "c.parts.0.length",
    ]  # fmt: skip


def test_a_run_gives_outputs_checks_and_slack_of_each_machine(tmp_path: Path) -> None:
    config = loaded(tmp_path, TWO)
    arm, force = design_input(config, "a.arm").asked, design_input(config, "a.force").asked
    arms = np.array([0.05, 0.1, 0.125, 0.2, 2.0])
    found = varied(config, {arm: arms}, 5, [arm, force])
    moments = 2000 * arms[:4]
    assert found.values("a.moment")[:4] == pytest.approx(moments)
    assert found.values("b.moment")[:4] == pytest.approx(moments / 2)
    assert found.values("mechanisms.a.arm")[:4] == pytest.approx(arms[:4])
    assert found.values("mechanisms.a.force")[:4] == pytest.approx(2000)
    assert list(found.status) == ["pass", "pass", "pass", "fail", "error"]
    assert "mechanisms.a.arm" in found.errors[4] and np.isnan(found.values("a.moment")[4])
    assert found.failing(3) == ["a.moment", "b.moment"]
    assert found.check("a.moment", MARGIN)[:4] == pytest.approx([150, 50, 0.0, -150], abs=1e-6)  # but for rounding
    sizes = {"a.moment": 500.0}
    least = found.least_slack(sizes)
    assert sizes == {"a.moment": 500.0, "b.moment": 200.0}  # of all machines the greatest side, where none is known
    assert least[:4] == pytest.approx(
        [150 / 500, 50 / 500, 25 / 200, -150 / 500]
    )  # what is at its limit does not count


def test_what_is_not_asked_for_is_not_calculated(tmp_path: Path) -> None:
    config = loaded(tmp_path, TWO)
    assert set(narrowed(config, ["c"]).instances) == {"press", "c"}
    assert set(narrowed(config, ["b"]).instances) == {"press", "a", "b"}
    force = design_input(config, "a.force").asked
    found = varied(narrowed(config, ["b"]), {force: np.array([1000.0, 3000.0])}, 2)
    assert found.values("b.moment") == pytest.approx([50, 150]) and np.isnan(found.values("c.moment")).all()
    assert quantities(config)["b.moment"].unit == "N*m"


def test_a_machine_proved_alone_is_the_one_of_the_run() -> None:
    press = Press.read(EXAMPLE.with_name("circular_knife.yaml"), DISCOVERY)
    depth = design_input(press.config, "knife.depth")
    many = varied(press.config, {depth.asked: np.array([0.110, 0.1115])}, 2)
    alone = proved(press.with_values({depth.stands: depth.typed(0.1115)}))
    assert len(alone.outputs) > 20
    for name, value in alone.outputs.items():
        assert many.values(name)[1] == pytest.approx(value, rel=1e-9), name
    assert list(alone.failing) == many.failing(1)


def test_a_machine_is_written_whole_or_not_at_all(tmp_path: Path) -> None:
    press = Press.read(saved(tmp_path, TWO), DISCOVERY)
    tree, machine = press.config.tree, proved(press.with_values({("mechanisms", "a", "arm"): "0.12 m"}))
    write_config(tree, machine, tmp_path / "new" / "made.yaml")
    assert (tmp_path / "new" / "made.yaml").read_text() == TWO.replace("arm: 0.1 m", "arm: 0.12 m")
    with pytest.raises(UserError, match="would be overwritten"):
        write_config(tree, machine, tmp_path / "press.yaml")
    with pytest.raises(UserError, match=r"mechanisms\.a\.arm: 2 m is out of range"):
        press.with_values({("mechanisms", "a", "arm"): "2 m"})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["new", "press.yaml"]
