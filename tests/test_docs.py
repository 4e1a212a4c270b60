"""The documentation says what the code says."""

from __future__ import annotations

import runpy
from math import pi
from pathlib import Path

import pytest

from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import CurveHandle
from diecut_report.machine.steps.run import calculate as engine_calculate
from diecut_report.mechanism.chapters import in_form
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.results.mechanism import mechanism_results
from diecut_report.testing.machines import calculate, load
from tests.docs.pages import ROOT, PageRun
from tests.machine.swing import MECHANISM as SWING
from tests.machine.swings import CLOSED, made, swing


def test_the_mechanism_pages_are_made_from_the_declarations() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_mechanism_pages.py"))
    for file, text in tool["pages"]().items():
        assert file.read_text(encoding="utf-8") == text, "run: python tools/make_mechanism_pages.py"


def example(folder: Path) -> Mechanism:
    """The plugin of the guide, from a file as anybody would have it."""
    guide = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
    file = folder / "hook.py"
    file.write_text(guide.split("```python\n")[1].partition("```")[0], encoding="utf-8")
    found = load("hook", folder)
    check_mechanism(found)
    return found


def test_the_plugin_of_the_guide_keeps_the_contract_and_calculates(tmp_path: Path) -> None:
    found = calculate(example(tmp_path), {"force": 2, "arm": "50 mm"})
    assert found["stress"].value == pytest.approx(32 * 2000 * 0.05 / (pi * 0.02**3))


@pytest.mark.parametrize(("key", "unit"), [("inertia", "N*m"), ("mass", "N")])
def test_the_tappet_of_the_references_follows_a_curve_in_either_form(tmp_path: Path, key: str, unit: str) -> None:
    PageRun(ROOT / "docs" / "how-to" / "references-and-blocks.md", tmp_path).execute()
    tappet = load("tappet", tmp_path / "my_plugins")
    source = made(duration=2) if key == "inertia" else swing(inertia=None, mass=1, lift="400 mm", duration=2)
    keys = {key: 3, "motion": CurveHandle(source, "position"), "rate": "30 1/min"}
    calc = engine_calculate(tappet, flatten(in_form(tappet.inputs, keys).model_validate(keys)))
    lift = 1 if key == "inertia" else 0.4
    assert calc["effort_max"][0, 0] == pytest.approx(3 * lift * CLOSED["acceleration"](1 / 4 - 1e-15, 2), rel=1e-9)
    assert mechanism_results(calc, {}).outputs["effort_max"].unit == unit


def test_a_page_tells_each_unit_with_its_key_and_lists_spectra() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_mechanism_pages.py"))
    lines = list(tool["page"](SWING))
    assert (
        "| `stiffness` | K | N·m/rad (with mass: N/m) | 100 | > 0 N·m/rad (with mass: > 0 N/m) | Stiffness |" in lines
    )
    assert "| `force` | F | N*m (with mass: N) | Torque or force |  |  |" in lines
    assert "| `amplitude_1` (a curve) | q_1 | 1 | Amplitude 1 | made up |  |" in lines
