"""The site as a whole: its pages are made twice of the same, and each kind has its own."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from diecut_report.config.plugins import Discovery
from tests.plugins.machine_parts import OF_PARTS
from tools.site.__main__ import mechanisms
from tools.site.documents import Links, add_notebooks, places
from tools.site.examples import Example as ConfigExample
from tools.site.examples import configurations, shown_kinds
from tools.site.gallery import page
from tools.site.sources import ROOT, Sources


def test_a_page_of_the_gallery_tells_all_that_is_declared() -> None:
    knife = Discovery().mechanism("circular_knife")
    text = "\n".join(page(knife, None, None))
    for step in ("angle_start", "force_max", "edge_round_shaft"):
        assert f"`{step}`" in text
    assert "| `eccentricity` | <i class=sy>r</i> | mm | required | > 0 mm |" in text
    assert "Круговий ніж" in text and "Must hold, else `edge_radius` is …" in text
    assert text.count("<math") > 40 and "## Checks" in text and "## Sources" in text
    assert "{" not in text.replace("{raw}", "").replace("{.", "").split("## Formulas")[0]


def test_each_kind_has_a_page_and_an_example() -> None:
    files = configurations()
    plain = [ConfigExample(file.stem, text := file.read_text("utf-8"), yaml.safe_load(text)) for file in files]
    shown = shown_kinds(plain)
    compared = {case.mechanism.kind for each in mechanisms() for case in each.comparisons}
    assert set(shown) == {each.kind for each in mechanisms()} - compared - OF_PARTS


def made(folder: Path) -> dict[str, bytes]:
    """The site with the reports of the small examples, by the names of its files."""
    sources, built = folder / "sources", folder / "site"
    for command in (
        ("tools.site", sources, "--quick"),
        ("sphinx", "-q", "-W", "-n", "-b", "html", "-d", folder / "trees", sources, built),
    ):
        subprocess.run([sys.executable, "-m", *map(str, command)], check=True)
    return {file.relative_to(built).as_posix(): file.read_bytes() for file in built.rglob("*") if file.is_file()}


@pytest.mark.nightly
def test_equal_sources_give_an_equal_site(tmp_path: Path) -> None:
    one, other = made(tmp_path / "one"), made(tmp_path / "other")
    assert one.keys() == other.keys() and [name for name in one if one[name] != other[name]] == []


@pytest.mark.nightly
def test_a_page_that_is_in_no_contents_and_a_name_without_a_page_fail(tmp_path: Path) -> None:
    made(tmp_path)
    (tmp_path / "sources" / "orphan.md").write_text("# Nobody leads here\n", encoding="utf-8")
    command = [
        "sphinx",
        "-q",
        "-W",
        "-n",
        "-b",
        "html",
        "-d",
        tmp_path / "trees",
        tmp_path / "sources",
        tmp_path / "again",
    ]
    done = subprocess.run([sys.executable, "-m", *map(str, command)], capture_output=True, text=True, check=False)
    assert done.returncode != 0 and "orphan" in done.stderr and "toctree" in done.stderr
    (tmp_path / "sources" / "orphan.md").unlink()
    (tmp_path / "sources" / "trust.md").unlink()
    done = subprocess.run([sys.executable, "-m", *map(str, command)], capture_output=True, text=True, check=False)
    assert done.returncode != 0 and "trust" in done.stderr


def test_each_notebook_has_a_page_with_its_texts_and_cells_and_its_file() -> None:
    sources = Sources()
    add_notebooks(sources, Links(places()))
    text = sources.files["notebooks/sweep.md"].decode()
    assert text.startswith("\n# A sweep\n") and "[Studies](../studies.md)" in text and 'href="sweep.ipynb"' in text
    assert text.count("``````python") == 5 and 'press = dr.load("../configs/folding_knife.yaml")' in text
    for file in (ROOT / "examples").glob("*.ipynb"):
        assert sources.files[f"_extra/notebooks/{file.name}"] == file.read_bytes()
        assert f"({file.stem}.md)" in sources.files["notebooks/index.md"].decode()
