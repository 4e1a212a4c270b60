"""Keys, seats and tilts of the flat-cylinder press as it was, against numbers that were worked out beside the program."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from diecut_report.press import Press
from diecut_report.results.press_run import impossible
from tests.configs import DISCOVERY, loaded, saved

PRESS = Path(__file__).parent / "data/press_before_corrections.yaml"


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The results of its mechanisms."""
    return (
        Press.read(saved(tmp_path_factory.mktemp("press"), PRESS.read_text("utf-8")), DISCOVERY)
        .calculate()
        .results.mechanisms
    )


def value(of: Any, name: str) -> float:
    """A number in SI."""
    return float((of.outputs | of.values)[name].value)


def part(of: Any, name: str, place: str) -> float:
    """A number of a place of a shaft."""
    known = of.outputs | of.values
    index = next(i for i, each in enumerate(check_of(of, "fatigue").parts) if each.name == place)
    return float(known[f"{name}.{index}"].value)


def check_of(of: Any, name: str) -> Any:
    """A check by its id."""
    return next(each for each in of.checks if each.id == name)


@pytest.mark.parametrize(("key", "pressure", "status"), [("gear_key", 84.4, "pass"), ("crank_key", 159.2, "fail")])
def test_the_crank_key_is_pressed_too_much_by_a_torque_that_reverses(
    press: Any, key: str, pressure: float, status: str
) -> None:
    """Four changes of flank a turn, 50/min, 20000 h: 2.4·10⁸; f_w 0.2903; 0.2903 · 1.1 · 335 MPa = 107.0 MPa; the hub's 1.5 · 370: 161.2."""
    own = press[key]
    assert value(own, "changes_of_flank") == pytest.approx(2.4e8)
    assert value(own, "pressure_key") / 1e6 == pytest.approx(pressure, rel=2e-3)
    assert value(own, "allowed_key") / 1e6 == pytest.approx(107.0, abs=0.05)
    assert value(own, "allowed_hub") / 1e6 == pytest.approx(161.2, abs=0.1)
    assert check_of(own, "pressure_key").status == status


@pytest.mark.parametrize(
    ("place", "safety"),
    [
        ("notch 1 (keyseat end mill)", 2.378),
        ("notch 2 (keyseat end mill)", 2.104),
        ("bearing B", 1.942),
        ("shoulder 3", 1.985),
    ],
)
def test_the_tight_seat_of_bearing_b_governs_the_crankshaft(press: Any, place: str, safety: float) -> None:
    own = press["crankshaft"]
    assert part(own, "place_safety", place) == pytest.approx(safety, rel=3e-3)
    assert own.outputs["fatigue_place"].value == "bearing B"


def test_the_crank_pin_tilts_with_the_shaft_that_carries_it(press: Any) -> None:
    """By the slopes of two beams: 1.507 mrad of the shaft at the crank, 0.168 mrad of the pin at its bearing."""
    assert value(press["crankshaft"], "crank_slope") * 1e3 == pytest.approx(1.507, rel=3e-3)
    assert value(press["crank_pin"], "coupler_slope") * 1e3 == pytest.approx(0.168, rel=5e-3)
    tilts = {each.id: each.status for each in press["bearings"].checks if "tilt" in each.id}
    assert tilts == {
        "main_a_tilt": "pass",
        "main_b_tilt": "warn",  # 0.918 mrad of a ball bearing
        "crank_pin_tilt": "warn",  # 1.675 mrad of an NU 2208
    }


def test_a_slope_by_the_name_of_its_load_is_found_when_only_feasibility_is_judged(tmp_path: Path) -> None:
    assert impossible(loaded(tmp_path, PRESS.read_text("utf-8")), []) == ([], [])
