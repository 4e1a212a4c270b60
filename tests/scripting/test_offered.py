"""What ``import diecut_report`` offers: loaded when it is asked for, and known to type checkers as what it is."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import diecut_report

TREE = ast.parse(Path(diecut_report.__file__).read_text("utf-8"))


def typed() -> dict[str, str]:
    """The names that type checkers see, each with the module that it is imported from."""
    (block,) = (node for node in TREE.body if isinstance(node, ast.If))
    found = [
        (alias.name, node.module) for node in block.body if isinstance(node, ast.ImportFrom) for alias in node.names
    ]
    return {name: str(module) for name, module in found}


def test_importing_it_loads_nothing_that_takes_time() -> None:
    code = (
        "import sys, typing; before = set(sys.modules); import diecut_report; assert set(sys.modules) - before == {'diecut_report'}\n"
        "diecut_report.load; assert 'matplotlib' not in sys.modules and 'pyarrow' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("name", sorted(set(diecut_report.__all__) - {"__version__"}))
def test_each_name_is_what_type_checkers_take_it_for(name: str) -> None:
    assert getattr(diecut_report, name).__module__ == typed()[name]


def test_all_names_are_offered_and_completed() -> None:
    assert {*typed(), "__version__"} == set(diecut_report.__all__) == set(dir(diecut_report))


def test_another_name_is_refused_as_of_any_module() -> None:
    with pytest.raises(AttributeError, match="no attribute 'lod'"):
        diecut_report.lod  # noqa: B018
