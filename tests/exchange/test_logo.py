"""A logo beside the configuration comes into each format, goes with the report, and comes back out of it."""

from __future__ import annotations

import base64
import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.configs import HEAD, SMALL, problems, saved
from tests.exchange.reports import changed, run
from tests.shared import once
from tests.test_pictures import png, svg

LOGO = svg('<circle cx="2" cy="2" r="2" fill="#0b5c8f"/>')
Capture = pytest.CaptureFixture[str]


def with_logo(name: str) -> str:
    return HEAD.replace("press:", f"report: {{logo: {name}}}\npress:") + SMALL.removeprefix(HEAD)


@pytest.fixture
def reported(tmp_path_factory: pytest.TempPathFactory, tmp_path: Path) -> Path:
    """A copy of the folder with a report that has a logo."""

    def make(folder: Path) -> None:
        (folder / "pictures").mkdir()
        (folder / "pictures" / "a.svg").write_bytes(LOGO)
        config = saved(folder, with_logo("pictures/a.svg"))
        assert run("report", config, "-o", folder, "--format", "html,json", "--quiet") == 0

    return shutil.copytree(once(tmp_path_factory, "report_with_a_logo", make), tmp_path, dirs_exist_ok=True)


def test_a_logo_is_in_the_page_goes_with_the_report_and_comes_back(reported: Path, capfd: Capture) -> None:
    data = base64.b64encode(LOGO).decode()
    assert f'src="data:image/svg+xml;base64,{data}"' in (reported / "press.html").read_text("utf-8")
    assert run("extract", reported / "press.html", "-o", reported / "back", "--quiet") == 0
    assert (reported / "back" / "pictures" / "a.svg").read_bytes() == LOGO
    (reported / "alone").mkdir()
    alone = (reported / "press.html").rename(reported / "alone" / "press.html")
    assert run("verify", alone) == 0
    assert "pictures/a.svg" in capfd.readouterr().out
    assert run("render", reported / "press.json", "-o", reported / "again", "--format", "html", "--quiet") == 0
    assert (reported / "again" / "press.html").read_bytes() == alone.read_bytes()


def test_a_logo_that_was_exchanged_in_a_report_is_told(reported: Path, capfd: Capture) -> None:
    def change(data: dict[str, Any]) -> None:
        data["config"]["logo"]["base64"] = base64.b64encode(svg("")).decode()

    assert run("verify", changed(reported / "press.json", reported / "a.json", change)) == 1
    assert "✗ configuration  pictures/a.svg is not the one that the report names" in capfd.readouterr().out


HOSTILE = [
    ({"base64": base64.b64encode(svg("<script/>")).decode()}, "holds <script>"),
    ({"base64": "§"}, "config.logo"),
    ({"base64": base64.b64encode(png()).decode()}, "the logo is not image/svg+xml"),
    ({"media_type": "text/html"}, "the logo is not text/html"),
    ({"file": "../a.svg"}, "The name of the logo is “../a.svg”; a logo lies beside"),
    ({"file": ".bash_aliases"}, "a name that begins with a dot is hidden"),
    ({"file": ".ssh/a.svg"}, "a name that begins with a dot is hidden"),
    ({"file": "a.desktop"}, "the name of a PNG or SVG file is needed"),
]


@pytest.mark.parametrize(("change", "words"), HOSTILE, ids=[words for _, words in HOSTILE])
def test_a_strangers_logo_is_judged_as_ones_own(
    reported: Path, capfd: Capture, change: dict[str, str], words: str
) -> None:
    path = changed(reported / "press.json", reported / "a.json", lambda data: data["config"]["logo"].update(change))
    assert run("render", path, "-o", reported / "out", "--format", "html") == 2
    assert words in capfd.readouterr().err and not (reported / "out").exists()


def test_a_wrong_logo_is_told_with_its_place(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"GIF89a")
    (tmp_path / "folder.png").mkdir()
    told = {
        name: problems(tmp_path, with_logo(name))
        for name in ("a.png", "b.png", "a.sh", ".a.svg", "folder.png", "../a.png", "[1]", "''")
    }
    assert told["a.png"] == [
        "3:16: report.logo: “a.png” is neither a PNG nor an SVG picture, whatever its name ends in"
    ]
    assert "there is no file" in told["b.png"][0] and "3:16: report.logo" in told["b.png"][0]
    assert told["folder.png"] == [f"{tmp_path / 'folder.png'}: This is a folder. Give a PNG or SVG picture."]
    assert "the name of a PNG or SVG file is needed" in told["a.sh"][0] and "hidden" in told[".a.svg"][0]
    assert "without a folder above" in told["../a.png"][0]
    assert "the name of a PNG or SVG file is needed" in " ".join(told["[1]"])
    assert "the name of a PNG or SVG file is needed" in told["''"][0]


def test_a_png_stands_in_the_results_with_its_type(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_bytes(png())  # what it is, its bytes tell, not its name
    assert run("calc", saved(tmp_path, with_logo("a.svg")), "-o", tmp_path / "a.json", "--quiet") == 0
    logo = json.loads((tmp_path / "a.json").read_text("utf-8"))["config"]["logo"]
    assert (logo["file"], logo["media_type"]) == ("a.svg", "image/png")
