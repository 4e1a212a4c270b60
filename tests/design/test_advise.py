"""The command advise: the smallest changes of levers by closed forms, what is advised by a plugin, and what cannot be mended."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design.advice import mended, share_told
from diecut_report.design.advised import MendingPath
from diecut_report.design.inputs import design_input
from diecut_report.design.machines import varied
from diecut_report.press import Press
from tests.configs import DISCOVERY, EXAMPLE, GOOD, HEAD, saved
from tests.examples import few

Capture = pytest.CaptureFixture[str]
TEXT = (
    HEAD
    + """\
  a: {kind: lever, force: 3 kN, arm: 100 mm, allowable_moment: 250 N*m}  # too strong
  b: {kind: lever, force: "${a.force}", arm: "${a.arm} + 20 mm", allowable_moment: 320 N*m}
"""
)
CLUTCH = (
    HEAD
    + """\
  clutch: {kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg, shoe_width: 30 mm, allowable_pressure: 0.2 MPa}
"""
)


@pytest.fixture
def press(tmp_path: Path) -> Path:
    return saved(tmp_path, TEXT)


def advise(press: Path, *more: object) -> int:
    return main(["advise", str(press), *map(str, more), "--plugins", str(GOOD)])


def found(capfd: Capture) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(capfd.readouterr().out)
    return answer


def test_the_smallest_change_is_found_and_typed_shortly(press: Path, capfd: Capture, tmp_path: Path) -> None:
    assert advise(press, "-o", tmp_path / "new.yaml") == 0
    # a: 3 kN · arm ≤ 250 N·m gives 83.3 mm; b: 3 kN · (arm + 20 mm) ≤ 320 N·m gives 86.7 mm
    assert (tmp_path / "new.yaml").read_text() == TEXT.replace("arm: 100 mm", "arm: 83 mm")
    out, err = capfd.readouterr()
    assert out.splitlines()[:3] == [
        "2 checks fail at present: a.moment, b.moment",
        "with 1 change no check fails, recalculated as a single machine:",
        "  a.arm  100 mm → 83 mm  (-17 %)",
    ]
    assert err == f"written: {tmp_path / 'new.yaml'}\n"


def test_two_free_inputs_are_changed_as_little_as_a_grid_of_all_tells(press: Path, capfd: Capture) -> None:
    assert advise(press, "--free", "a.arm", "--free", "a.force", "--format", "json") == 0
    answer = found(capfd)
    config = load_config(press, DISCOVERY)
    arm, force = design_input(config, "a.arm").asked, design_input(config, "a.force").asked
    shares = np.array(np.meshgrid(np.linspace(-0.25, 0, 60), np.linspace(-0.25, 0, 60))).reshape(2, -1)
    made = varied(config, {arm: 0.1 * (1 + shares[0]), force: 3000 * (1 + shares[1])}, shares.shape[1])
    best = np.abs(shares).sum(axis=0)[made.status == "pass"].min()
    assert answer["size"] <= best + 0.01 and len(answer["changes"]) == 1


def test_what_a_plugin_advises_is_where_the_search_begins(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, CLUTCH), "--format", "json") == 0
    answer = found(capfd)
    assert answer["failing"] == ["clutch.pressure"] and answer["machine"]["status"] in ("pass", "warn")
    assert [each["name"] for each in answer["changes"]] in (["clutch.shoe_radius"], ["clutch.shoe_width"])


def test_what_passes_is_left_alone(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, TEXT.replace("3 kN", "2 kN")), "-o", tmp_path / "new.yaml") == 0
    assert "no check fails: nothing to fix (governing: a.moment)" in capfd.readouterr().out
    assert not (tmp_path / "new.yaml").exists()


def test_what_cannot_be_mended_names_the_checks(press: Path, capfd: Capture, tmp_path: Path) -> None:
    text = TEXT.replace('arm: "${a.arm} + 20 mm", allowable_moment: 320 N*m', "arm: 100 mm, allowable_moment: 400 N*m")
    assert advise(saved(tmp_path, text), "--free", "b.arm", "-o", tmp_path / "new.yaml") == 1
    out, err = capfd.readouterr()
    assert "in the best of them" not in out  # nothing had to be tried
    assert "proved: a.moment does not depend on any free input and fails for all of their values" in out
    assert err.endswith(f"not written: {tmp_path / 'new.yaml'}\n") and not (tmp_path / "new.yaml").exists()


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--free", "a.arm", "--keep", "a.arm"], "nothing is free to be changed"),
        (["--free", "a.arn"], "did you mean 'arm'?"),
        (["--free", "b.arm"], "b.arm follows from an expression"),
        (["--free", "a.width"], "a.width has no value at present, or is zero"),
        (["--free", "a.remark"], "nothing is free to be changed"),
        (["--free", "a.n_points"], "a.n_points only sets how densely curves are listed"),
    ],
)
def test_bad_input_is_told_and_ends_with_2(press: Path, capfd: Capture, more: list[str], words: str) -> None:
    assert advise(press, *more) == 2
    out, err = capfd.readouterr()
    assert out == "" and words in err


DAMPER = (
    HEAD
    + """\
  damper: {kind: damper, mass: 104 kg, inertia: 0.74 kg*m**2, rolling_radius: 105.5 mm, velocity: 0.6 m/s, shore_hardness: 56,
           carriage_mass: 0 kg, static_unbalance: 0 kg*m, contact_distance: 0 mm,
           dynamic_stiffness_factor: 1.5, ring_width: 60 mm, pad_height: 60 mm, loss_tangent: 0.15}
"""
)


def test_another_way_is_taken_where_the_first_names_what_is_not_given(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, DAMPER), "--format", "json") == 0  # the length is sized: the hardness is advised, too
    answer = found(capfd)
    assert [each["name"] for each in answer["changes"]] == ["damper.shore_hardness"] and answer["size"] < 0.06


def test_what_is_measured_is_changed_only_where_it_is_named(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, CLUTCH.replace("120 mm", "{value: 120 mm, basis: measured}"))
    assert advise(press, "--format", "json") == 0
    assert [each["name"] for each in found(capfd)["changes"]] == ["clutch.shoe_width"]
    assert advise(press, "--free", "clutch.shoe_radius", "--format", "json") == 0
    assert [each["name"] for each in found(capfd)["changes"]] == ["clutch.shoe_radius"]


@pytest.mark.nightly
def test_what_steps_do_not_see_is_found_by_one_input_over_its_range(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, DAMPER), "--free", "damper.ring_width", "--format", "json") == 0
    answer = found(capfd)
    config = load_config(saved(tmp_path, DAMPER), DISCOVERY)
    width = design_input(config, "damper.ring_width").asked
    x = np.linspace(0.06, 0.12, 500)
    best = (x[np.isin(varied(config, {width: x}, 500).status.astype(str), ["pass", "warn"])] / 0.06 - 1).min()
    assert answer["size"] <= best * 1.05 + 0.005


@pytest.mark.parametrize("config", few([EXAMPLE], lambda _: False))
def test_the_published_press_is_mended_by_advice_alone(config: Path) -> None:
    made = mended(Press.read(config, Discovery([])))
    assert made.machine is not None and made.machine.failing == () and len(made.changes) <= 20


@pytest.mark.parametrize(
    ("share", "told"),
    [(2.579, "+258 %"), (0.9994, "+100 %"), (-0.167, "-17 %"), (0.003142, "+0.31 %"), (12.0, "+1200 %")],
)
def test_a_share_of_any_size_is_told_without_a_power_of_ten(share: float, told: str) -> None:
    assert share_told(share) == told


SCREWED = '''
"""A screw that holds a bracket."""
from diecut_report.api import Annotated, Block, Chapter, Check, Inputs, Mechanism, Quantity, Source, bind

class Screw(Block):
    preload: Annotated[float, Quantity("F_V", "kN", "Preload", gt=0)]

class Bracket(Inputs):
    force: Annotated[float, Quantity("F", "kN", "Force", gt=0)]
    screw: Annotated[Screw, "The screw"]

joint = Chapter("Joint")
joint.value("opening", "F_o", "kN", "Force that opens the joint", lambda force: 5 * force, source="lever")
MECHANISM = Mechanism(
    kind="bracket", version="1.0", title="Bracket", summary="A screw holds a bracket.", inputs=Bracket, chapters=(joint,), key_results=("opening",),
    checks=(Check(id="joint", check_class="strength", title="Joint", demand="opening", limit="screw.preload", unit="kN", demand_label="force",
                  limit_label="preload", source="lever", consequence="the joint opens.", advise=("screw.preload",)),),
    sources=(Source("lever", "Lever arms, by measure."),),
)
'''


def test_advice_on_a_key_of_a_block_is_followed(tmp_path: Path, capfd: Capture) -> None:
    """Nothing else mends it: a preload is neither a size nor an angle, and is freed because the check names it."""
    (tmp_path / "bracket.py").write_text(SCREWED, "utf-8")
    press = saved(tmp_path, HEAD + "  b: {kind: bracket, force: 50 kN, screw: {preload: 40 kN}}\n")
    assert main(["advise", str(press), "--plugins", str(tmp_path), "--format", "json"]) == 0
    answer = found(capfd)
    assert [(each["name"], each["after"]) for each in answer["changes"]] == [("b.screw.preload", "250 kN")]


def test_ctrl_c_ends_the_search_with_the_best_machine_so_far(
    press: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def go(path: MendingPath) -> None:
        path.share = np.full(len(path.share), -0.1)
        path.made = path.run(path.share[None])
        raise KeyboardInterrupt

    monkeypatch.setattr(MendingPath, "go", go)
    assert advise(press) == 130
    out = capfd.readouterr().out.splitlines()
    assert "the search was stopped before it converged" in out
    # 3 kN · 90 mm is 270 N·m, 3 kN · 110 mm 330 N·m
    assert "in the best of them 2 checks fail: a.moment, b.moment" in out
    assert "the changes of the best of them:" in out and "  a.arm  100 mm → 90 mm  (-10 %)" in out
