"""The documentation says what the code says."""

from __future__ import annotations

import runpy
import sys
from collections.abc import Callable
from math import pi
from pathlib import Path
from types import ModuleType

import pytest

from diecut_report.contract.inputs import flatten
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.unit_variants import in_form
from diecut_report.engine import CurveHandle, calculate
from diecut_report.results.mechanism import mechanism_results
from diecut_report.testing import check_mechanism
from tests.engine.swing import MECHANISM as SWING
from tests.engine.swings import CLOSED, made, swing

ROOT = Path(__file__).parents[1]


def test_the_mechanism_pages_are_made_from_the_declarations() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_mechanism_pages.py"))
    for file, text in tool["pages"]().items():
        assert file.read_text(encoding="utf-8") == text, "run: python tools/make_mechanism_pages.py"


def example(folder: Path, number: int) -> Mechanism:
    """A plugin of the guide, from a file as anybody would have it."""
    guide = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
    file = folder / f"plugin_{number}_of_the_guide.py"
    file.write_text(guide.split("```python\n")[number].partition("```")[0], encoding="utf-8")
    sys.modules[file.stem] = module = ModuleType(file.stem)
    module.__file__ = str(file)
    exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), module.__dict__)
    found: Mechanism = module.MECHANISM
    check_mechanism(found)
    return found


def test_the_first_plugin_of_the_guide_keeps_the_contract_and_calculates(tmp_path: Path) -> None:
    hook = example(tmp_path, 1)
    calc = calculate(hook, flatten(hook.inputs.model_validate({"force": 2, "arm": "50 mm"})))
    assert calc["stress"][0, 0] == pytest.approx(32 * 2000 * 0.05 / (pi * 0.02**3))


@pytest.mark.parametrize(("key", "unit"), [("inertia", "N*m"), ("mass", "N")])
def test_the_second_plugin_of_the_guide_follows_a_curve_in_either_form(tmp_path: Path, key: str, unit: str) -> None:
    tappet = example(tmp_path, 2)
    source = made(duration=2) if key == "inertia" else swing(inertia=None, mass=1, lift="400 mm", duration=2)
    keys = {key: 3, "motion": CurveHandle(source, "position")}
    calc = calculate(tappet, flatten(in_form(tappet.inputs, keys).model_validate(keys)))
    lift = 1 if key == "inertia" else 0.4
    assert calc["effort_max"][0, 0] == pytest.approx(3 * lift * CLOSED["acceleration"](1 / 4 - 1e-15, 2), rel=1e-9)
    assert mechanism_results(calc, {})["outputs"]["effort_max"]["unit"] == unit


def test_a_page_tells_each_unit_with_its_key_and_lists_spectra() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_mechanism_pages.py"))
    lines = list(tool["page"](SWING))
    assert (
        "| `stiffness` | K | N·m/rad (with mass: N/m) | 100 | > 0 N·m/rad (with mass: > 0 N/m) | Stiffness |" in lines
    )
    assert "| `force` | F | N*m (with mass: N) | Torque or force |  |  |" in lines
    assert "| `amplitude_1` (a curve) | q_1 | 1 | Amplitude 1 | made up |  |" in lines


def test_the_third_plugin_of_the_guide_takes_from_its_tables(tmp_path: Path) -> None:
    pinion = example(tmp_path, 3)
    calc = calculate(pinion, flatten(pinion.inputs.model_validate({"bearing": "6205", "teeth": 18})))
    assert [calc[name][0, 0] for name in ("bore", "rating", "form_factor")] == pytest.approx([0.025, 14800, 0.308])
    plain = calculate(pinion, flatten(pinion.inputs.model_validate({"bore_given": "30 mm", "teeth": 18})))
    assert plain["bore"][0, 0] == pytest.approx(0.03)


def test_the_tests_of_the_guide_pass(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    guide = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8").split("```python\n")
    (tmp_path / "my_plugins").mkdir()
    (tmp_path / "my_plugins" / "hook.py").write_text(guide[1].partition("```")[0], encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    found: dict[str, Callable[[], None]] = {}
    exec(guide[4].partition("```")[0], found)
    found["test_the_declaration"]()
    found["test_the_numbers_of_a_book"]()
