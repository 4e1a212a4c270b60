"""The documentation says what the code says."""

from __future__ import annotations

import runpy
import sys
from math import pi
from pathlib import Path
from types import ModuleType

import pytest

from diecut_report.contract.inputs import flatten
from diecut_report.engine import calculate
from diecut_report.testing import check_mechanism

ROOT = Path(__file__).parents[1]


@pytest.mark.repository
def test_the_mechanism_pages_are_made_from_the_declarations() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_mechanism_pages.py"))
    for file, text in tool["pages"]().items():
        assert file.read_text(encoding="utf-8") == text, "run: python tools/make_mechanism_pages.py"


@pytest.mark.repository
def test_the_plugin_of_the_guide_keeps_the_contract_and_calculates(tmp_path: Path) -> None:
    guide = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
    file = tmp_path / "hook.py"
    file.write_text(guide.partition("```python\n")[2].partition("```")[0], encoding="utf-8")
    sys.modules["hook_of_the_guide"] = module = ModuleType("hook_of_the_guide")
    module.__file__ = str(file)
    exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), module.__dict__)
    check_mechanism(module.MECHANISM)
    keys = {"force": 2, "arm": "50 mm"}
    calc = calculate(module.MECHANISM, flatten(module.MECHANISM.inputs.model_validate(keys)))
    assert calc["stress"][0, 0] == pytest.approx(32 * 2000 * 0.05 / (pi * 0.02**3))
