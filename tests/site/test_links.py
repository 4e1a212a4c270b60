"""Links of the documents lead to pages of the site, and a built site whose links lead nowhere is told of."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.site import documents as module
from tools.site.built_links import judged
from tools.site.documents import PARTS, Links, add_documents, documents, places
from tools.site.sources import Sources


@pytest.fixture
def links() -> Links:
    return Links(places())


@pytest.mark.parametrize(
    ("file", "text", "expected"),
    [
        ("README.md", "see [trust](docs/trust.md#how)", "see [trust](trust.md#how)"),
        ("README.md", "[`shaft`](docs/mechanisms/shaft.md)", "[`shaft`](gallery/shaft.md)"),
        ("docs/python.md", "[sweep](../examples/sweep.ipynb)", "[sweep](notebooks/sweep.md)"),
        ("examples/sweep.ipynb", "[studies](../docs/studies.md)", "[studies](../studies.md)"),
        ("docs/limits.md", "[tables](mechanisms)", "[tables](gallery/index.md)"),
        ("docs/trust.md", "[rules](../CONTRIBUTING.md)", "[rules](contributing.md)"),
        ("docs/trust.md", "[start](../README.md) and [here](#part)", "[start](index.md) and [here](#part)"),
        ("docs/reference/units.md", "[how](../plugins.md)", "[how](../plugins.md)"),
        ("README.md", "[Dask](https://distributed.dask.org)", "[Dask](https://distributed.dask.org)"),
        ("docs/house-style.md", "[the templates](../templates)", "the templates"),  # not part of the site
        ("README.md", "`[a](b.md)` stays", "`[a](b.md)` stays"),
        ("README.md", "```\n[a](b.md)\n```", "```\n[a](b.md)\n```"),
    ],
)
def test_a_link_of_a_document_leads_to_its_page(links: Links, file: str, text: str, expected: str) -> None:
    assert links.rewritten(text, file) == expected


def test_a_link_to_nothing_is_an_error_that_names_the_document(links: Links) -> None:
    with pytest.raises(FileNotFoundError, match=r"docs/trust\.md: the link to gone\.md leads to nothing"):
        links.rewritten("[gone](gone.md)", "docs/trust.md")


def test_a_file_of_the_repository_is_linked_on_the_web_where_the_project_has_an_address(
    links: Links, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert links.rewritten("[study](configs/flat_cylinder_study.yaml)", "README.md") == (
        "study (`configs/flat_cylinder_study.yaml`)"
    )
    monkeypatch.setattr(module, "repository", lambda: "https://example.org/press")
    assert links.rewritten("[study](configs/flat_cylinder_study.yaml)", "README.md") == (
        "[study](https://example.org/press/blob/main/configs/flat_cylinder_study.yaml)"
    )


def test_each_document_is_a_page_and_stands_in_the_contents() -> None:
    sources = Sources()
    add_documents(sources)
    start = sources.files["index.md"].decode()
    listed = {line for line in start.splitlines() if line and not line.startswith((" ", "#", "|", ":", "`", "-"))}
    pages = {page.removesuffix(".md") for page in documents().values()} - {"index"}
    assert {page for page in pages if "/" not in page} | {"how-to/index"} <= listed
    beside = {page.removeprefix("how-to/") for page in pages if page.startswith("how-to/")} - {"index"}
    assert beside and beside <= set(sources.files["how-to/index.md"].decode().splitlines())
    made = {"gallery/index", "notebooks/index", "reports", "reference/index"}
    named = {name for part in PARTS for name in part.names if "*" not in name} - made
    assert named <= pages, "a page that the contents name must be there"


def built(folder: Path, page: str) -> list[str]:
    (folder / "index.html").write_text(page, encoding="utf-8")
    (folder / "other.html").write_text('<h1 id="place">Other</h1>', encoding="utf-8")
    return judged(folder).faults


@pytest.mark.parametrize(
    ("page", "words"),
    [
        ('<a href="gone.html">x</a>', "index.html:1: gone.html: there is no such file"),
        ('<a href="other.html#gone">x</a>', "there is no such place on that page"),
        ('\n<img src="gone.png">', "index.html:2: gone.png: there is no such file"),
        ('<script src="https://cdn.example/x.js"></script>', "a browser would load this from elsewhere"),
        ('<link rel="stylesheet" href="//fonts.example/x.css">', "a browser would load this from elsewhere"),
    ],
)
def test_what_is_wrong_with_a_built_page_is_told_with_its_place(tmp_path: Path, page: str, words: str) -> None:
    (fault,) = built(tmp_path, page)
    assert words in fault


def test_links_within_a_built_site_are_found_and_those_out_of_it_listed(tmp_path: Path) -> None:
    page = (
        '<a href="other.html#place">x</a> <a href="https://example.org">y</a> <a href="#top">z</a> <img src="data:,">'
    )
    assert built(tmp_path, page) == []
    assert judged(tmp_path).outside == {"https://example.org"}


def test_a_style_that_loads_from_elsewhere_is_told(tmp_path: Path) -> None:
    (tmp_path / "site.css").write_text('@font-face { src: url("https://fonts.example/a.woff2") }', encoding="utf-8")
    (fault,) = built(tmp_path, "<p>x</p>")
    assert "site.css: it loads something from elsewhere" in fault


def test_an_empty_folder_is_not_a_site(tmp_path: Path) -> None:
    assert "holds no pages" in judged(tmp_path).faults[0]


def test_sources_are_written_only_where_they_changed_and_old_ones_go(tmp_path: Path) -> None:
    one, other = Sources(), Sources()
    for sources in (one, other):
        sources.page("a.md", ["# A"])
    one.page("old/b.md", ["# B"])
    one.write(tmp_path)
    before = (tmp_path / "a.md").stat().st_mtime_ns
    other.write(tmp_path)
    assert (tmp_path / "a.md").stat().st_mtime_ns == before
    assert [file.name for file in tmp_path.iterdir()] == ["a.md"]
    with pytest.raises(ValueError, match=r"two pages of the site are called a\.md"):
        other.page("a.md", [])
