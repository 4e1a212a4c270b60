"""The command advise: the smallest changes by closed forms, values of a list, what cannot be mended, and which checks conflict."""

from __future__ import annotations

import json
import random
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import linprog

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design.advice import mended, share_told
from diecut_report.design.advised import MendingPath, changeable_choices
from diecut_report.design.answers import quantity
from diecut_report.design.inputs import changeable, demanded, design_input, in_series, is_form, named_input
from diecut_report.design.machines import varied
from diecut_report.press import Press
from diecut_report.report.chapters.front import followed_line
from diecut_report.report.text import Catalogue
from diecut_report.results.model import ResultsRecord
from tests.configs import DISCOVERY, EXAMPLE, GOOD, HEAD, saved
from tests.examples import few
from tests.records import filled

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


def found(capfd: Capture, press: Path, *more: object, code: int = 0) -> dict[str, Any]:
    """What is found, as data."""
    assert advise(press, *more, "--format", "json") == code
    answer: dict[str, Any] = json.loads(capfd.readouterr().out)
    assert (answer["machine"] is None) == bool(code)
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
    answer = found(capfd, press, "--free", "a.arm", "--free", "a.force")
    config = load_config(press, DISCOVERY)
    arm, force = design_input(config, "a.arm").asked, design_input(config, "a.force").asked
    shares = np.array(np.meshgrid(np.linspace(-0.25, 0, 60), np.linspace(-0.25, 0, 60))).reshape(2, -1)
    made = varied(config, {arm: 0.1 * (1 + shares[0]), force: 3000 * (1 + shares[1])}, shares.shape[1])
    best = np.abs(shares).sum(axis=0)[made.status == "pass"].min()
    assert answer["size"] <= best + 0.01 and len(answer["changes"]) == 1


def test_what_a_plugin_advises_is_where_the_search_begins(tmp_path: Path, capfd: Capture) -> None:
    answer = found(capfd, saved(tmp_path, CLUTCH))
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


DAMPER = (
    HEAD
    + """\
  damper: {kind: damper, mass: 104 kg, inertia: 0.74 kg*m**2, rolling_radius: 105.5 mm, velocity: 0.6 m/s, shore_hardness: 56,
           carriage_mass: 0 kg, static_unbalance: 0 kg*m, contact_distance: 0 mm,
           dynamic_stiffness_factor: 1.5, ring_width: 60 mm, pad_height: 60 mm, loss_tangent: 0.15}
"""
)


def test_another_way_is_taken_where_the_first_names_what_is_not_given(tmp_path: Path, capfd: Capture) -> None:
    answer = found(capfd, saved(tmp_path, DAMPER))  # the length is sized: the hardness is advised, too
    assert [each["name"] for each in answer["changes"]] == ["damper.shore_hardness"] and answer["size"] < 0.06


def test_what_is_measured_is_changed_only_where_it_is_named(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, CLUTCH.replace("120 mm", "{value: 120 mm, basis: measured}"))
    assert [each["name"] for each in found(capfd, press)["changes"]] == ["clutch.shoe_width"]
    assert [each["name"] for each in found(capfd, press, "--free", "clutch.shoe_radius")["changes"]] == [
        "clutch.shoe_radius"
    ]


@pytest.mark.nightly
def test_what_steps_do_not_see_is_found_by_one_input_over_its_range(tmp_path: Path, capfd: Capture) -> None:
    answer = found(capfd, saved(tmp_path, DAMPER), "--free", "damper.ring_width")
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
from diecut_report.api import Block, Chapter, Check, Inputs, Mechanism, Quantity, Source, block, m

class Screw(Block):
    preload = Quantity("F_V", "kN", "Preload", gt=0)

class Bracket(Inputs):
    force = Quantity("F", "kN", "Force", gt=0)
    screw = block(Screw, "The screw")

joint = Chapter("Joint")
joint.opening = 5 * m.force, "F_o", "kN", "Force that opens the joint", "lever"
MECHANISM = Mechanism(
    kind="bracket", version="1.0", title="Bracket", summary="A screw holds a bracket.", inputs=Bracket, chapters=(joint,), key_results=("opening",),
    checks=(Check("joint", "strength", "Joint", m.opening, m.screw.preload, demand_label="force", limit_label="preload",
                  consequence="the joint opens.", advise=("screw.preload",)),),
    sources=(Source("lever", "Lever arms, by measure."),),
)
'''


def test_advice_on_a_key_of_a_block_is_followed(tmp_path: Path, capfd: Capture) -> None:
    """Nothing else mends it: a preload is neither a size nor an angle, and is freed because the check names it."""
    (tmp_path / "bracket.py").write_text(SCREWED, "utf-8")
    press = saved(tmp_path, HEAD + "  b: {kind: bracket, force: 50 kN, screw: {preload: 40 kN}}\n")
    assert main(["advise", str(press), "--plugins", str(tmp_path), "--format", "json"]) == 0
    changes = json.loads(capfd.readouterr().out)["changes"]
    assert [(each["name"], each["after"]) for each in changes] == [("b.screw.preload", "250 kN")]


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


# The line of page 1 on the advice of all failing checks together, and that a report with it can be verified.


def test_a_report_says_that_its_advice_gives_a_pass(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    config = saved(tmp_path, CLUTCH)
    assert main(["report", str(config), "-o", str(tmp_path), "--format", "html,json"]) == 1
    results = ResultsRecord.model_validate_json((tmp_path / "press.json").read_bytes())
    advice = results.summary.advice
    assert advice is not None and advice.failing == [] and advice.error is None
    assert [each.path for each in advice.changes] == ["clutch.shoe_width"]
    (line,) = followed_line(results, Catalogue("en"))
    assert line.startswith("Applying the advice of all failing checks together gives a pass: clutch.shoe_width ")
    assert line.rstrip(".") in (tmp_path / "press.html").read_text("utf-8")
    assert main(["verify", str(tmp_path / "press.html"), "--numbers"]) == 0


def test_other_outcomes_are_told_in_words() -> None:
    changes = [{"path": "a.b", "value": "5 mm"}]
    results = filled(ResultsRecord, {"summary": {"advice": {"changes": changes, "failing": ["c.d"], "error": None}}})
    assert list(followed_line(results, Catalogue("en"))) == [
        "Applying the advice of all failing checks together (a.b 5 mm) leaves other checks failing: c.d."
    ]
    results = filled(ResultsRecord, {"summary": {"advice": {"changes": changes, "failing": [], "error": "no"}}})
    assert "gives a machine that cannot be built" in next(followed_line(results, Catalogue("en")))
    assert list(followed_line(filled(ResultsRecord, {}), Catalogue("en"))) == []


# An input takes one of some values: numbers of a list, whole numbers, texts; and few machines may be calculated.


PIN = """\
from typing import Annotated, Literal

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, Text, lookup, m


class Pin(Inputs):
    bore = Quantity("d", "mm", "Bore", listed=(10, 12, 15, 17, 20, 25, 30, 35, 40, 45))
    count = Quantity("n", "1", "Pins", ge=1, integer=True, default=2)
    grade = Text("Grade", ("soft", "middle", "hard"), default="soft")
    force = Quantity("F", "N", "Force", gt=0)


pin = Chapter("Pin")
pin.strength = lookup({"soft": 1.0, "middle": 2.0, "hard": 4.0}, by="grade"), "[p]", "MPa", "Strength"
pin.pressure = m.force / (m.count * m.bore**2), "p", "MPa", "Pressure"
MECHANISM = Mechanism(
    kind="pin", version="1", title="Pin", summary="A pin.", inputs=Pin, chapters=(pin,),
    checks=(Check("pressure", "strength", "Pressure", m.pressure, m.strength, limit_label="allowed", consequence="the pin gives way."),),
)
"""
# 1 N/mm² of two pins: 400 N and a bore of 20 mm give 0.5; 1000 N give 1.25: 25 mm, three pins, or the next grade
PINS = HEAD + "  pin: {kind: pin, bore: 20 mm, count: 2, grade: soft, force: 1000 N}\n"


def of_pins(
    folder: Path, capfd: Capture, *more: str, code: int = 0, text: str = PINS, plugin: str = PIN
) -> dict[str, Any]:
    (folder / "pins").mkdir(exist_ok=True)
    saved(folder / "pins", plugin, "pin.py")
    file = saved(folder, text)
    assert main(["advise", str(file), *more, "--format", "json", "--plugins", str(folder / "pins")]) == code
    answer: dict[str, Any] = json.loads(capfd.readouterr().out)
    return answer


@pytest.mark.parametrize(
    ("free", "after"),
    [
        ([], ("pin.bore", "25 mm")),  # a size, whatever the list is that it is of
        (["pin.bore"], ("pin.bore", "25 mm")),
        (["pin.count"], ("pin.count", "3")),
        (["pin.grade"], ("pin.grade", "middle")),
    ],
)
def test_the_nearest_of_the_values_that_it_may_have_is_found(
    tmp_path: Path, capfd: Capture, free: list[str], after: tuple[str, str]
) -> None:
    found = of_pins(tmp_path, capfd, *(f"--free={name}" for name in free))
    (change,) = found["changes"]
    assert (change["name"], change["after"]) == after
    assert change["share"] == {"pin.bore": 0.25, "pin.count": 0.5, "pin.grade": None}[change["name"]]
    assert found["machine"]["status"] == "pass" and not found["ended"]


NAMED = ('"the pin gives way."', '"the pin gives way.", advise=("grade", "bore")')


def test_a_text_that_the_advice_names_is_followed_without_free(tmp_path: Path, capfd: Capture) -> None:
    kept = PINS.replace("bore: 20 mm", "bore: {value: 20 mm, basis: standard}")
    found = of_pins(tmp_path, capfd, text=kept, plugin=PIN.replace(*NAMED))
    (change,) = found["changes"]
    assert (change["name"], change["before"], change["after"]) == ("pin.grade", "soft", "middle")
    assert found["machine"]["status"] == "pass"


def test_what_would_be_tried_if_it_were_named_is_told(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, PINS.replace("1000 N", "5 kN"))
    saved(tmp_path, PIN, "pin.py")
    command = ["advise", str(file), "--plugins", str(tmp_path)]
    assert main(command) == 1
    template = "not tried, as --free must name them, and then names all that may be changed: pin.grade, pin.count"
    assert template in capfd.readouterr().out
    assert main([*command, "--free", "pin.bore", "--keep", "pin.bore"]) == 2
    template = "nothing is free to be changed: name inputs by --free, such as --free pin.grade, or keep fewer by --keep; the file has pin.grade"
    assert template in capfd.readouterr().err


def test_several_of_them_are_changed_where_one_is_not_enough(tmp_path: Path, capfd: Capture) -> None:
    text = PINS.replace("1000 N", "20 kN")  # 45 mm carry 4050 N, the hard grade 16200 N: both, and three pins
    free = ("--free=pin.bore", "--free=pin.grade", "--free=pin.count")
    found = of_pins(tmp_path, capfd, *free, text=text)
    after = {change["name"]: change["after"] for change in found["changes"]}
    strength = {"soft": 1.0, "middle": 2.0, "hard": 4.0}[after.get("pin.grade", "soft")]
    bore, count = float(after.get("pin.bore", "20 mm").split()[0]), int(after.get("pin.count", "2"))
    assert 20_000 / (count * bore**2) <= strength


def test_what_no_value_mends_is_told(tmp_path: Path, capfd: Capture) -> None:
    found = of_pins(tmp_path, capfd, "--free=pin.bore", code=1, text=PINS.replace("1000 N", "5 kN"))
    assert found["machine"] is None and found["left"] == ["pin.pressure"] and found["free"] == 1
    assert found["calculated"] >= 9  # the other bores, at least


def test_a_search_ends_with_the_machines_that_it_may_calculate_and_says_so(tmp_path: Path, capfd: Capture) -> None:
    lever = "  a: {kind: lever, force: 3 kN, arm: 100 mm, allowable_moment: 250 N*m}\n"
    held = '  b: {kind: lever, force: 3 kN, arm: "300 mm - ${a.arm}", allowable_moment: 500 N*m}\n'
    file = saved(tmp_path, HEAD + lever + held)
    command = ["advise", str(file), "--free", "a.arm", "--most", "60", "--plugins", str(GOOD)]
    assert main(command) == 1
    out = capfd.readouterr().out
    assert "the search stopped at its limit and has not converged; increase --most" in out
    assert int(out.split("none of the ")[1].split()[0]) <= 60 and "in the best of them" in out
    assert main([*command, "--format", "json"]) == 1
    assert json.loads(capfd.readouterr().out)["ended"]


def test_what_stands_at_a_value_of_its_series_is_changed_in_that_series_alone() -> None:
    """A pulley of R40 becomes another one of R40; one that is of no series, and what has none, any size."""
    config = load_config(EXAMPLE, Discovery([]))
    pulley, radius = (
        in_series(config, design_input(config, name)) for name in ("train.vbelt.driver_diameter", "cylinder.radius")
    )
    assert {"118 mm", "125 mm", "132 mm"} <= set(pulley.among) and "126 mm" not in pulley.among and pulley.is_stepped
    assert min(pulley.listed) >= 0.125 / 3 and max(pulley.listed) <= 3 * 0.125
    assert radius.among == () and not radius.is_stepped
    assert "train.vbelt.driver_diameter" not in [each.name for each in changeable(config, [], set(), [])]
    choices = changeable_choices(config, [], set())
    assert choices["mechanisms.train.vbelt.driver_diameter"][1]["132 mm"] == pytest.approx(7 / 125)


def test_a_number_of_a_part_is_of_no_series_of_a_mechanism() -> None:
    config = load_config(EXAMPLE.parent / "machines" / "flat_cylinder.yaml", Discovery([]))
    diameter = named_input(config, "shafts.main.sections.2.diameter")
    assert in_series(config, diameter) is diameter and not is_form(config, diameter)


@pytest.mark.parametrize(
    ("name", "stands_for"),
    [
        ("shafts.conveyor.sections.1.diameter", "shafts_conveyor_body.discs.1.diameter"),
        ("shafts.main.parts.wheel.key", "shafts_main_wheel_key.key_length"),
    ],
)
def test_a_number_of_a_part_is_asked_for_by_the_name_by_which_it_is_varied(name: str, stands_for: str) -> None:
    config = load_config(EXAMPLE.parent / "machines" / "flat_cylinder.yaml", Discovery([]))
    assert quantity(config, name).name == stands_for


# What a check demands of a machine is not lowered to mend it, whichever side of the check it is, unless it is named.


SLIDE = """
from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, m


class Slide(Inputs):
    crank = Quantity("r", "mm", "Radius of the crank", gt=0)
    base = Quantity("b", "mm", "Base of the slide", gt=0, default=60)
    stroke_needed = Quantity("H_n", "mm", "Stroke that is needed", gt=0, default=100)
    room = Quantity("H_r", "mm", "Room of the stroke", gt=0, default=200)


chapter = Chapter("Stroke")
chapter.stroke = m.crank + m.base, "H", "mm", "Stroke"
chapter.share = m.stroke_needed / m.stroke, "s", "1", "Share of the stroke that is used"
checks = (
    Check("stroke", "function", "Stroke", m.stroke_needed, m.stroke, demand_label="needed", consequence="the sheet does not arrive."),
    Check("room", "function", "Room", m.stroke, m.room, limit_label="room", consequence="the slide runs against the frame."),
    Check("crank", "practice", "Crank", m.crank, m.base, severity="warn", consequence="the slide stands badly."),
)

MECHANISM = Mechanism(kind="slide", version="1.0", title="Slide", summary="Slides", inputs=Slide, chapters=(chapter,), checks=checks)
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    saved(tmp_path, SLIDE, "slide.py")
    return tmp_path


def changes(folder: Path, keys: str, capfd: Capture, *more: str) -> dict[str, Any]:
    """What advise changes at a slide with a crank of 60 mm, whose stroke is 120 mm, by the inputs' names."""
    press = saved(folder, HEAD + f"  a: {{kind: slide, crank: 60 mm, base: 60 mm, {keys}}}\n")
    assert main(["advise", str(press), "--plugins", str(folder), "--keep", "a.base", "--format", "json", *more]) == 0
    return {each["name"]: each["after"] for each in json.loads(capfd.readouterr().out)["changes"]}


# with less change of its own, the demand could be brought down to 120 mm, or the room up to it
@pytest.mark.parametrize(("keys", "crank"), [("stroke_needed: 125 mm", "65 mm"), ("room: 115 mm", "55 mm")])
def test_a_side_of_a_check_stays(folder: Path, keys: str, crank: str, capfd: Capture) -> None:
    assert changes(folder, keys, capfd) == {"a.crank": crank}


def test_a_demand_that_is_named_is_changed(folder: Path, capfd: Capture) -> None:
    press = saved(folder, HEAD + "  a: {kind: slide, crank: 60 mm, base: 60 mm, stroke_needed: 125 mm}\n")
    more = ["--free", "a.stroke_needed", "--format", "json", "--plugins", str(folder)]
    assert main(["advise", str(press), *more]) == 0
    [change] = json.loads(capfd.readouterr().out)["changes"]
    assert (change["name"], change["after"]) == ("a.stroke_needed", "120 mm")


def test_a_size_from_which_other_checks_follow_is_not_a_demand() -> None:
    """The bore and radius of the cylinder, the width of a gear: each is a side of a check, and the strength follows from it."""
    for kind, keys in {"cylinder_sizing": {"bore_radius", "radius"}, "gear_pair": {"face_width"}}.items():
        assert not keys & demanded(DISCOVERY.mechanism(kind))
    assert "min_wall" in demanded(DISCOVERY.mechanism("cylinder_sizing"))


# Which checks conflict where nothing passes: arms that depend on each other, against inequalities solved by hand and by HiGHS.


# moments: a: 3 kN·A ≤ 250 N·m, A ≤ 83.3 mm; b: 3 kN·(300 mm − A) ≤ 500 N·m, A ≥ 133.3 mm; c: mended by itself
TIED = (
    HEAD
    + """\
  a: {kind: lever, force: 3 kN, arm: 100 mm, allowable_moment: 250 N*m}
  b: {kind: lever, force: 3 kN, arm: "300 mm - ${a.arm}", allowable_moment: 500 N*m}
  c: {kind: lever, force: 3 kN, arm: 100 mm, allowable_moment: 250 N*m}
"""
)


@pytest.mark.nightly
def test_the_least_set_that_conflicts_is_told_and_what_is_not_proved(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, TIED), "--free", "a.arm", "--free", "c.arm") == 1
    out = capfd.readouterr().out
    template = "no machine was found that satisfies all of these; this does not prove that none exists: {}\n"
    assert template.format("a.moment, b.moment") in out
    assert "if any one of them is dropped, a calculated machine satisfies the others" in out


def test_a_check_that_no_free_input_can_change_is_proved_to_fail(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, TIED), "--free", "c.arm") == 1
    out = capfd.readouterr().out
    assert "proved: a.moment, b.moment do not depend on any free input and fail for all of their values" in out
    assert found(capfd, tmp_path / "press.yaml", "--free", "b.force", code=1)["conflict"] == {
        "checks": ["a.moment", "c.moment"], "proved": True, "least": False,
    }  # fmt: skip


@pytest.mark.nightly
def test_one_check_alone_may_be_out_of_reach(tmp_path: Path, capfd: Capture) -> None:
    text = TIED.replace("300 mm - ${a.arm}", "500 mm + ${a.arm}")  # 3 kN·500 mm is above 500 N·m whatever is added
    answer = found(capfd, saved(tmp_path, text), "--free", "a.arm", "--free", "c.arm", code=1)
    assert answer["conflict"] == {"checks": ["b.moment"], "proved": False, "least": True}


@pytest.mark.parametrize("seed", few(range(40), lambda _: False))
def test_conflicts_are_those_that_linear_programming_tells(seed: int, tmp_path: Path, capfd: Capture) -> None:
    """Each moment is one kilonewton by an arm that is linear in two free ones: c0 + c1·p + c2·q, all below the limit of 250 mm."""
    draw = random.Random(seed)
    rows = [[draw.randint(1, 9) * 50, *(draw.choice((-2, -1, 0, 1, 2)) for _ in range(2))] for _ in range(4)]
    free = "  p: {kind: lever, force: 1 kN, arm: 150 mm}\n  q: {kind: lever, force: 1 kN, arm: 150 mm}\n"
    arms = [f'"{c0} mm + {c1} * ${{p.arm}} + {c2} * ${{q.arm}}"' for c0, c1, c2 in rows]
    text = HEAD + free + "".join(
        f"  l{index}: {{kind: lever, force: 1 kN, arm: {arm}, allowable_moment: 250 N*m}}\n" for index, arm in enumerate(arms)
    )  # fmt: skip
    code = advise(saved(tmp_path, text), "--free", "p.arm", "--free", "q.arm", "--format", "json")
    out = capfd.readouterr().out
    if code == 2:  # an arm below zero or above its bounds: no machine to begin with
        return
    answer = json.loads(out)
    if answer["conflict"] is None:
        assert code == 0 and _can_hold(rows, range(4), rows)
        return
    checks = [int(name[1]) for name in answer["conflict"]["checks"]]
    assert not _can_hold(rows, checks, rows)
    if answer["conflict"]["least"]:
        assert all(_can_hold(rows, fewer, rows) for fewer in combinations(checks, len(checks) - 1))


def _can_hold(rows: list[list[int]], checks: Any, every: list[list[int]]) -> bool:
    """Whether arms p and q above zero and up to 1 m exist with these moments below their limit and all arms within their bounds."""
    limits = [(row[1:], 250 - row[0]) for row in (rows[each] for each in checks)]
    limits += [([-part for part in row[1:]], row[0] - 1e-3) for row in every] + [
        (row[1:], 1000 - row[0]) for row in every
    ]
    found = linprog([0, 0], [row for row, _ in limits], [limit for _, limit in limits], bounds=[(1e-3, 1000)] * 2)
    return bool(found.status == 0)
