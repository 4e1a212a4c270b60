"""The page on Python, the notebook and the script do what they say."""

from __future__ import annotations

import doctest
import runpy
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbclient import NotebookClient

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"


def test_the_session_of_the_page_answers_as_it_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    failed, tried = doctest.testfile(str(ROOT / "docs" / "python.md"), module_relative=False, encoding="utf-8")
    assert (failed, tried > 20) == (0, True)


@pytest.mark.nightly  # what it asks for the page and the notebook ask, too; its types are checked by scripts/check.sh
def test_the_script_runs(capfd: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    script = runpy.run_path(str(EXAMPLES / "press_script.py"))
    script["main"].__globals__["HERE"] = tmp_path / "examples"
    (tmp_path / "configs").symlink_to(ROOT / "configs")
    script["main"]()
    assert capfd.readouterr().out == "1891 N·mm, pass, governing: <check knife.reach: pass 99.8 %>\n"
    assert (tmp_path / "examples" / "build" / "knife.html").stat().st_size > 10_000


def test_the_notebook_runs_and_shows_what_it_promises() -> None:
    notebook: Any = nbformat.read(EXAMPLES / "press_in_python.ipynb", as_version=4)
    assert not any(cell.outputs or cell.execution_count for cell in notebook.cells if cell.cell_type == "code"), (
        "keep it without outputs"
    )
    made: Any = NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(EXAMPLES)}}
    ).execute()
    cells = [cell for cell in made.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in cells] == list(range(1, len(cells) + 1))
    shown = ["".join(part.get("data", {}).get("text/html", "") for part in cell.outputs) for cell in cells]
    assert "knife.eccentricity" in shown[0] and "No check fails, but " in shown[1] and "not checked" in shown[1]
    assert shown[4].count("<math") > 10 and shown[4].count("<svg") == 5
    assert not any("<script" in html for html in shown)
