"""Code of a plugin's inputs that breaks is told as the plugin's fault, and the other mechanisms keep their results."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from diecut_report.api import Quantity
from diecut_report.cli.main import main
from tests.configs import GOOD

LEVER = (GOOD / "lever.py").read_text("utf-8")
PRESS = "def turn_for_each_sheet(productivity: Any) -> Any:\n    return 2 * np.pi * productivity\n"
CONFIG = """\
schema_version: 1
project: {title: Test}
press: {name: P, productivity: 5000 1/h}
mechanisms:
  a: {kind: lever, force: 2 kN, speed: 1 rpm}
  b: {kind: breaking, force: 2 kN}
"""
LISTED = """\
schema_version: 1
project: {title: Test}
press: {name: P}
mechanisms:
  a: {kind: lever, force: 2 kN, speed: 1 rpm}
  b: {kind: lever, force: 2 kN, speed: 1 rpm, load: [1 N*m, "${a.moment}", 1 N*m, 2 N*m]}
  c: {kind: lever, force: 2 kN, speed: 1 rpm, load: "${b.load}"}
"""


def test_what_breaks_gives_3_and_the_results_of_the_others(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    sound, breaking = "@formula\n" + PRESS, PRESS.replace("return", "raise KeyError('nothing')  #")
    assert sound in LEVER
    text = LEVER.replace('kind="lever"', 'kind="breaking"').replace(sound, breaking)
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "breaking.py").write_text(text, "utf-8")
    (tmp_path / "press.yaml").write_text(CONFIG, "utf-8")
    options = ["--plugins", str(GOOD), "--plugins", str(tmp_path / "own")]
    assert main(["calc", str(tmp_path / "press.yaml"), *options]) == 3
    out, err = capfd.readouterr()
    found = json.loads(out)["mechanisms"]
    assert found["a"]["outputs"]["moment"]["value"] == 200 and found["b"]["status"] == "error"
    assert err.startswith("mechanism 'b' of plugin 'breaking':") and "KeyError: 'nothing' (breaking.py:" in err


def test_a_default_of_an_unknown_field_of_the_press_is_told(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text = LEVER.replace('kind="lever"', 'kind="breaking"').replace('"press.productivity"', '"press.productivty"')
    (tmp_path / "breaking.py").write_text(text, "utf-8")
    (tmp_path / "press.yaml").write_text(CONFIG, "utf-8")
    assert main(["calc", str(tmp_path / "press.yaml"), "--plugins", str(GOOD), "--plugins", str(tmp_path)]) == 3
    err = capfd.readouterr().err
    assert (
        "input speed: takes press.productivty, which is not a number of the press (did you mean 'press.productivity'?)"
        in err
    )


def test_a_reference_to_a_list_that_holds_references_is_told(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "press.yaml").write_text(LISTED, "utf-8")
    assert main(["calc", str(tmp_path / "press.yaml"), "--plugins", str(GOOD)]) == 2
    err = capfd.readouterr().err
    assert "mechanisms.c.load: ${b.load} is a list that holds references itself (${a.moment})" in err


@pytest.mark.parametrize("unit", ["%", "deg", "rpm", "mm", "1/h"])
def test_a_number_typed_as_its_bound_is_allowed(unit: str) -> None:
    for bound in range(1, 100):
        quantity = Quantity("x", unit, "X", ge=bound, le=bound)
        for given in (bound, f"{bound} {unit}", f"{bound}.0 {unit}"):
            quantity.validate(given)
        with pytest.raises(ValueError, match="out of range"):
            quantity.validate(bound * (1 + 1e-12))
