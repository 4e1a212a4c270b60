"""The report of a results file is the report; results of strangers are data, and what cannot be made of them is told in words."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from diecut_report.errors import UserError
from diecut_report.exchange.results_form import results_of
from tests.configs import EXAMPLES
from tests.examples import few
from tests.exchange.reports import changed, run

Capture = pytest.CaptureFixture[str]
Data = dict[str, Any]


@pytest.mark.parametrize("ending", few(["html", "pdf"], keep=lambda ending: ending == "html"))
def test_a_rendered_report_is_the_report_byte_for_byte(small_report: Path, tmp_path: Path, ending: str) -> None:
    assert run("render", small_report / "small.json", "-o", tmp_path, "--format", ending, "--quiet") == 0
    assert (tmp_path / f"small.{ending}").read_bytes() == (small_report / f"small.{ending}").read_bytes()
    assert run("render", small_report / "small.json", "-o", tmp_path, "--format", ending, "--strict") == 1


def test_a_page_of_a_calculation_verifies(tmp_path: Path, capfd: Capture) -> None:
    """Its values were not tried as a report tries them, which it says of each."""
    knife = next(path for path in EXAMPLES if path.stem == "circular_knife")
    assert run("calc", knife, "-o", tmp_path / "knife.json") == 0
    assert run("render", tmp_path / "knife.json", "-o", tmp_path, "--format", "html", "--quiet") == 0
    capfd.readouterr()
    assert run("verify", tmp_path / "knife.html") == 0
    assert "Everything agrees." in capfd.readouterr().out


def no_sections(data: Data) -> None:
    del data["mechanisms"]["clutch"]["sections"]


def section_of_nonsense(data: Data) -> None:
    data["mechanisms"]["clutch"]["sections"] = [{"title": "T", "items": [{"type": "value", "symbol": 3}]}]


def figure_of_nonsense(data: Data) -> None:
    data["mechanisms"]["clutch"]["figures"] = [{"id": "f", "type": "chart", "title": "T", "caption": ""}]


def way_out(data: Data) -> None:
    data["mechanisms"]["../../up"] = data["mechanisms"].pop("clutch")


def export_out(data: Data) -> None:
    data["mechanisms"]["clutch"]["exports"] = [{"id": "../../up", "type": "profile", "title": "T"}]


def hidden_letter(data: Data) -> None:
    data["project"]["title"] = "A\u202e"


def unknown_language(data: Data) -> None:
    data["project"]["language"] = "xx"


def endless_wheel(data: Data) -> None:
    """A Geneva wheel whose slots nobody could draw."""
    rating = {"state": "none"}
    part = {
        "name": "s.w",
        "kind": "geneva_wheel",
        "start": 0.0,
        "end": 0.03,
        "seat": 0.05,
        "radius": 0.2,
        "slots": 10**9,
        "rating": rating,
    }
    shaft = {"name": "s", "axis": [0.0, 0.0], "left": 0.0, "sections": [], "parts": [part], "rating": rating}
    data["drive_line"] = {"shafts": [shaft], "joins": []}


def endless_shafts(data: Data) -> None:
    shaft = {"name": "s", "axis": [0.0, 0.0], "left": 0.0, "sections": [], "parts": [], "rating": {"state": "none"}}
    data["drive_line"] = {"shafts": 61 * [shaft], "joins": []}


NONSENSE = [
    endless_wheel,
    endless_shafts,
    no_sections,
    section_of_nonsense,
    way_out,
    export_out,
    hidden_letter,
    unknown_language,
]


@pytest.mark.parametrize("change", NONSENSE, ids=lambda change: change.__name__)
def test_results_that_are_not_the_programs_are_refused_in_words(
    small_report: Path, tmp_path: Path, capfd: Capture, change: Callable[[Data], None]
) -> None:
    (tmp_path / "in").mkdir()
    file = changed(small_report / "small.json", tmp_path / "in" / "a.json", change)
    assert run("render", file, "-o", tmp_path / "in" / "out", "--format", "html") == 2
    told = capfd.readouterr().err
    assert "Traceback" not in told and str(file) in told
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["a.json"]


def test_a_figure_that_cannot_be_drawn_is_told_and_the_rest_is_written(
    small_report: Path, tmp_path: Path, capfd: Capture
) -> None:
    file = changed(small_report / "small.json", tmp_path / "a.json", figure_of_nonsense)
    assert run("render", file, "-o", tmp_path, "--format", "html") == 3
    assert "figure 'f' of mechanism 'clutch' cannot be drawn" in capfd.readouterr().err
    assert (tmp_path / "a.html").exists()


MARKED = "</title><script>alert(1)</script><img src=x onerror=alert(1)>"


def test_texts_of_a_stranger_are_texts_in_the_page(small_report: Path, tmp_path: Path) -> None:
    def change(data: Data) -> None:
        data["project"]["title"] = data["press"]["name"] = data["mechanisms"]["clutch"]["title"] = MARKED
        for group in ("inputs", "outputs"):
            for row in data["mechanisms"]["clutch"][group].values():
                row["symbol"] = row["description"] = MARKED
        for check in data["mechanisms"]["clutch"]["checks"]:
            check["title"] = check["message"] = MARKED

    file = changed(small_report / "small.json", tmp_path / "a.json", change)
    assert run("render", file, "-o", tmp_path, "--format", "html", "--quiet") == 0
    page = (tmp_path / "a.html").read_text("utf-8")
    assert "<script>alert" not in page and "<img" not in page and "&lt;script&gt;" in page


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"[]", "does not hold results"),
        (b'{"a": NaN}', "NaN"),
        (b'{"a": 1e999}', "beyond the range"),
        (b'{"a": ' + 5000 * b"9" + b"}", "too many digits"),
        (b'{"a": ' + 200_000 * b"[" + 200_000 * b"]" + b"}", "nested too deeply"),
        (b'{"a": "\xff"}', "not UTF-8"),
        (b'{"schema_version": 1}', "program: is missing"),
        (b'{"a": [' + 10_000_001 * b"0," + b"0]}", "more than 10,000,000 values"),
    ],
    ids=["list", "nan", "overflow", "digits", "deep", "not UTF-8", "keys", "many"],
)
def test_a_json_file_that_holds_no_results_is_refused_in_words(content: bytes, words: str) -> None:
    with pytest.raises(UserError, match=words):
        results_of(content, "a.json")
