"""The page on Python, the notebooks and the script do what they say."""

from __future__ import annotations

import ast
import doctest
import re
import runpy
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbclient import NotebookClient

from tests.examples import every

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


NOTEBOOKS = sorted(EXAMPLES.glob("*.ipynb"))
FIRST = EXAMPLES / "first_calculation.ipynb"  # the one that runs in a kernel, which takes seconds to start


def read(file: Path) -> Any:
    found: Any = nbformat.read(file, as_version=4)
    nbformat.validate(found)
    return found


def test_the_notebooks_are_kept_without_outputs_and_the_page_names_each() -> None:
    for file in NOTEBOOKS:
        cells = [cell for cell in read(file).cells if cell.cell_type == "code"]
        assert not any(cell.outputs or cell.execution_count for cell in cells), f"keep {file.name} without outputs"
    named = set(re.findall(r"examples/(\w+\.ipynb)", (ROOT / "docs" / "python.md").read_text(encoding="utf-8")))
    assert len(NOTEBOOKS) > 4 and named == {file.name for file in NOTEBOOKS}


@pytest.mark.nightly
def test_the_notebook_runs_and_shows_what_it_promises() -> None:
    notebook = read(FIRST)
    own = (
        "import matplotlib.pyplot as plt; assert 'inline' in plt.get_backend()  # what the reader draws is still shown"
    )
    notebook.cells.append(nbformat.v4.new_code_cell(own))
    made: Any = NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(EXAMPLES)}}
    ).execute()
    cells = [cell for cell in made.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in cells] == list(range(1, len(cells) + 1))
    given = [[part.get("data", {}) for part in cell.outputs] for cell in cells]
    shown = ["".join(part.get("text/html", "") for part in parts) for parts in given]
    assert "knife.eccentricity" in shown[0] and "No check fails, but " in shown[1] and "not checked" in shown[1]
    assert "image/png" in given[3][0], "the figure of a curve is shown without pyplot"
    assert shown[4].count("<math") > 10 and shown[4].count("<svg") == 5
    assert not any("<script" in html for html in shown)


def answer(code: str, name: str, space: dict[str, Any]) -> Any:
    """Run a cell; return the value of its last line, as a kernel would show it."""
    body = ast.parse(code, name).body
    last = body.pop() if isinstance(body[-1], ast.Expr) else None
    exec(compile(ast.Module(body, []), name, "exec"), space)
    return eval(compile(ast.Expression(last.value), name, "eval"), space) if isinstance(last, ast.Expr) else None


@pytest.mark.parametrize("file", every(2, [file for file in NOTEBOOKS if file != FIRST]), ids=lambda file: file.stem)
@pytest.mark.usefixtures("without_advice")
def test_a_notebook_runs_in_this_process(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(EXAMPLES)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    space: dict[str, Any] = {}
    answers = [answer(cell.source, file.name, space) for cell in read(file).cells if cell.cell_type == "code"]
    pages = [page() for page in (getattr(each, "_repr_html_", None) for each in answers) if page]
    pictures = [picture() for picture in (getattr(each, "_repr_png_", None) for each in answers) if picture]
    assert pages or pictures
    assert not any("<script" in page for page in pages if page) and all(len(each) > 5000 for each in pictures)
