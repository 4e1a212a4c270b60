"""The command advise where an input takes one of some values: numbers of a list, whole numbers, texts; and where it may calculate few machines."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design.advised import changeable_choices
from diecut_report.design.answers import quantity
from diecut_report.design.inputs import changeable, design_input, in_series, is_form, named_input
from tests.configs import EXAMPLE, GOOD, HEAD, saved

Capture = pytest.CaptureFixture[str]
PLUGIN = """\
from typing import Annotated, Literal

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, Text


class Pin(Inputs):
    bore: Annotated[float, Quantity("d", "mm", "Bore", listed=(10, 12, 15, 17, 20, 25, 30, 35, 40, 45))]
    count: Annotated[int, Quantity("n", "1", "Pins", ge=1, integer=True)] = 2
    grade: Annotated[Literal["soft", "middle", "hard"], Text("Grade")] = "soft"
    force: Annotated[float, Quantity("F", "N", "Force", gt=0)]


pin = Chapter("Pin")
pin.lookup("strength", "[p]", "MPa", "Strength", {"soft": 1.0, "middle": 2.0, "hard": 4.0}, by="grade")
pin.value("pressure", "p", "MPa", "Pressure", lambda force, bore, count: force / (count * bore**2))
MECHANISM = Mechanism(
    kind="pin", version="1", title="Pin", summary="A pin.", inputs=Pin, chapters=(pin,),
    checks=(Check(id="pressure", check_class="strength", title="Pressure", demand="pressure", limit="strength", unit="MPa",
                  demand_label="pressure", limit_label="allowed", consequence="the pin gives way."),),
)
"""
# 1 N/mm² of two pins: 400 N and a bore of 20 mm give 0.5; 1000 N give 1.25: 25 mm, three pins, or the next grade
PRESS = HEAD + "  pin: {kind: pin, bore: 20 mm, count: 2, grade: soft, force: 1000 N}\n"


def advise(folder: Path, capfd: Capture, *more: str, code: int = 0, text: str = PRESS) -> dict[str, Any]:
    (folder / "pins").mkdir(exist_ok=True)
    saved(folder / "pins", PLUGIN, "pin.py")
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
    found = advise(tmp_path, capfd, *(f"--free={name}" for name in free))
    (change,) = found["changes"]
    assert (change["name"], change["after"]) == after
    assert change["share"] == {"pin.bore": 0.25, "pin.count": 0.5, "pin.grade": None}[change["name"]]
    assert found["machine"]["status"] == "pass" and not found["ended"]


NAMED = ('"the pin gives way."', '"the pin gives way.", advise=("grade", "bore")')


def test_a_text_that_the_advice_names_is_followed_without_free(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(globals(), "PLUGIN", PLUGIN.replace(*NAMED))
    kept = PRESS.replace("bore: 20 mm", "bore: {value: 20 mm, basis: standard}")
    found = advise(tmp_path, capfd, text=kept)
    (change,) = found["changes"]
    assert (change["name"], change["before"], change["after"]) == ("pin.grade", "soft", "middle")
    assert found["machine"]["status"] == "pass"


def test_what_would_be_tried_if_it_were_named_is_told(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, PRESS.replace("1000 N", "5 kN"))
    saved(tmp_path, PLUGIN, "pin.py")
    command = ["advise", str(file), "--plugins", str(tmp_path)]
    assert main(command) == 1
    template = "not tried, as --free must name them, and then names all that may be changed: pin.grade, pin.count"
    assert template in capfd.readouterr().out
    assert main([*command, "--free", "pin.bore", "--keep", "pin.bore"]) == 2
    template = "nothing is free to be changed: name inputs by --free, such as --free pin.grade, or keep fewer by --keep; the file has pin.grade"
    assert template in capfd.readouterr().err


def test_several_of_them_are_changed_where_one_is_not_enough(tmp_path: Path, capfd: Capture) -> None:
    text = PRESS.replace("1000 N", "20 kN")  # 45 mm carry 4050 N, the hard grade 16200 N: both, and three pins
    free = ("--free=pin.bore", "--free=pin.grade", "--free=pin.count")
    found = advise(tmp_path, capfd, *free, text=text)
    after = {change["name"]: change["after"] for change in found["changes"]}
    strength = {"soft": 1.0, "middle": 2.0, "hard": 4.0}[after.get("pin.grade", "soft")]
    bore, count = float(after.get("pin.bore", "20 mm").split()[0]), int(after.get("pin.count", "2"))
    assert 20_000 / (count * bore**2) <= strength


def test_what_no_value_mends_is_told(tmp_path: Path, capfd: Capture) -> None:
    found = advise(tmp_path, capfd, "--free=pin.bore", code=1, text=PRESS.replace("1000 N", "5 kN"))
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
