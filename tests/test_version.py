"""The version stands in one place, and all else that tells it agrees."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import yaml

import diecut_report as dr

ROOT = Path(__file__).parents[1]


def test_the_package_takes_its_version_from_the_program() -> None:
    found = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert "version" not in found["project"] and found["project"]["dynamic"] == ["version"]
    assert found["tool"]["setuptools"]["dynamic"]["version"] == {"attr": "diecut_report.__version__"}


def test_citation_and_changelog_name_the_version_and_its_day() -> None:
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert cited["cff-version"] == "1.2.0" and {"title", "authors", "message", "license"} <= cited.keys()
    latest = re.search(r"^## \[(\d[^]]*)\] - (\S+)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert latest is not None
    assert (cited["version"], str(cited["date-released"])) == latest.groups() == (dr.__version__, latest[2])
