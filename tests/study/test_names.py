"""A study is called as its file: what no document can show stands in none."""

from __future__ import annotations

from pathlib import Path

from diecut_report.config.yaml import FORBIDDEN_IN_KEY
from tests.configs import saved
from tests.exchange.reports import run
from tests.study.studies import BASE, STUDY

NAME = "\x1b[31mred\u202e.yaml"


def test_the_name_of_a_study_acts_on_no_terminal_and_turns_no_letters_round(tmp_path: Path) -> None:
    saved(tmp_path, BASE)
    out = tmp_path / "\x1b[2Jout"
    assert run("batch", saved(tmp_path, STUDY, NAME), "-o", out, "--jobs", 1, "--quiet") in (0, 1)
    page = (out / "summary.html").read_text("utf-8")
    assert "�[31mred�.yaml" in page and not FORBIDDEN_IN_KEY.search(page.translate({9: None, 10: None}))


def test_a_variant_of_such_a_study_has_a_report(tmp_path: Path) -> None:
    saved(tmp_path, BASE)
    run("batch", saved(tmp_path, STUDY, NAME), "-o", tmp_path / "out", "--jobs", 1, "--quiet")
    assert run("report", f"{tmp_path / 'out'}#1", "-o", tmp_path / "made", "--format", "html", "--quiet") in (0, 1)
