"""A drawing that moves, as a browser draws it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.docs.pages import ROOT
from tests.hostile.test_pages import CHROMIUM, browsed

PAGE = ROOT / "docs" / "how-to" / "moving-drawings.md"
PRESS = """\
schema_version: 1
project: {title: Cam}
press: {name: Press}
mechanisms:
  cam: {kind: cam_drive}
"""


@pytest.mark.nightly
@pytest.mark.skipif(CHROMIUM is None, reason="needs Chromium")
def test_the_frame_has_its_strokes_on_a_screen_too(tmp_path: Path) -> None:
    code = re.search(r"<!-- file my_plugins/cam_drive.py -->\n```python\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)
    assert code
    (tmp_path / "cam_drive.py").write_text(code[1], "utf-8")
    (tmp_path / "cam.yaml").write_text(PRESS, "utf-8")
    command = ["report", tmp_path / "cam.yaml", "--plugins", tmp_path, "--format", "html", "-o", tmp_path, "--quiet"]
    assert main([*map(str, command)]) == 0
    shown = browsed(tmp_path, (tmp_path / "cam.html").read_text("utf-8"), "--dump-dom").stdout
    ways = re.findall(r'class="m-ground" d="([^"]*)"', shown)
    assert ways and all(way.startswith("M-0.06 0.06l0.12 0M") and way.count("l") > 15 for way in ways)
