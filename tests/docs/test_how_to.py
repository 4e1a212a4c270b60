"""Each how-to page is true: its plugin is sound and gives what the page shows."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.testing.machines import load
from tests.docs.pages import ROOT, PageRun

FOLDER = ROOT / "docs" / "how-to"
PAGES = sorted(page.stem for page in FOLDER.glob("*.md") if page.stem != "README")


@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_true(tmp_path: Path, page: str) -> None:
    PageRun(FOLDER / f"{page}.md", tmp_path).execute()
    listed = tmp_path / "my_plugins" / "kinds.yaml"
    for file in (tmp_path / "my_plugins").glob("*.py") if not listed.exists() else ():
        check_mechanism(load(file.stem, tmp_path / "my_plugins"))


@pytest.mark.nightly
def test_the_page_about_comparing_is_true(tmp_path: Path) -> None:
    assert PageRun(ROOT / "docs" / "comparing-machines.md", tmp_path).execute() == 4


def test_the_index_names_each_page() -> None:
    index = (FOLDER / "README.md").read_text("utf-8")
    assert [page for page in PAGES if f"({page}.md)" not in index] == []
