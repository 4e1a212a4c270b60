"""What a foreign plugin with faults in its formulas calculates is told with them, wherever its verdict stands."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from diecut_report.api import GRAVITY, Chapter, Check, Inputs, Mechanism, Quantity, Source, m, pi
from diecut_report.cli.main import main
from diecut_report.declaration.formula_checks import doubts
from tests.testing.test_check_plugin import toggle

Capture = pytest.CaptureFixture[str]
WRONG = ("wire**4 / (8", "wire**5 / (8")  # springs that are too soft, so that no check fails
SAID = "The formulas of the plugin of 'toggle' have faults; do not rely on its results."
FAULT = "  toggle.py:57: spring_rate: "


def run(home: Path, *arguments: str) -> int:
    """The exit code of a command with the plugins of a project."""
    return main([*arguments, "--plugins", str(home / "plugins")])


def text(page: Path) -> str:
    """A page without its marks."""
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", page.read_text("utf-8")))


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """The project of a new mechanism that has a wrong formula, and no failing check."""
    return toggle(tmp_path, WRONG)


def test_a_report_tells_the_faults_and_is_not_whole(tmp_path: Path, home: Path, capfd: Capture) -> None:
    asked = ("report", str(home / "examples" / "toggle.yaml"), "--format", "html,json", "-o", str(tmp_path))
    assert run(home, *asked) == 0
    told = capfd.readouterr().err
    assert SAID in told and FAULT in told and "1 check warns" in told
    results = json.loads((tmp_path / "toggle.json").read_text("utf-8"))
    page = text(tmp_path / "toggle.html")
    assert results["mechanisms"]["toggle"]["plugin_check"] == "failed"
    assert "The formulas of the plugin of toggle have faults" in page
    assert "? conditional" in page
    assert "All checks pass" not in page and "NOT RELEASED" in page
    assert run(home, *asked, "--strict") == 1


def test_check_and_calc_are_strict_and_tell_it(tmp_path: Path, home: Path, capfd: Capture) -> None:
    config = home / "examples" / "toggle.yaml"
    assert run(home, "check", str(config), "-o", str(tmp_path), "--format", "html") == 0
    told = capfd.readouterr()
    assert "conditional, formulas with faults" in told.out and SAID in told.err and FAULT in told.err
    assert SAID in text(tmp_path / "machines.html").replace("&#39;", "'")
    for command in ("check", "calc"):
        assert run(home, command, str(config)) == 0
        assert run(home, command, str(config), "--strict") == 1
        capfd.readouterr()


@pytest.mark.usefixtures("with_html_summary")
@pytest.mark.nightly
def test_a_study_tells_it_at_its_end_and_on_its_page(tmp_path: Path, home: Path, capfd: Capture) -> None:
    assert run(home, "batch", str(home / "examples" / "toggle_study.yaml"), "-o", str(tmp_path / "s")) in (0, 1)
    told = capfd.readouterr().err
    assert SAID in told and FAULT in told
    assert "The formulas of the plugin of toggle have faults" in text(tmp_path / "s" / "summary.html")


@pytest.mark.nightly
def test_a_search_tells_it_at_its_end_and_on_its_page(tmp_path: Path, home: Path, capfd: Capture) -> None:
    study = home / "examples" / "toggle_study.yaml"
    head = study.read_text("utf-8").partition("sample:")[0]
    search = "optimise: {objectives: [{minimise: toggle.force}], evaluations: 8, population: 4}\n"
    study.write_text(head + "vary: {mechanisms.toggle.travel: {from: 6 mm, to: 18 mm}}\n" + search, "utf-8")
    assert run(home, "optimise", str(study), "-o", str(tmp_path / "o"), "--jobs", "1") == 0
    told = capfd.readouterr().err
    assert SAID in told and FAULT in told
    assert "The formulas of the plugin of toggle have faults" in text(tmp_path / "o" / "optimisation.html")


# What may be a mistake is noted: a unit that a formula converts by hand, a chapter that nothing depends on.


class Drum(Inputs):
    rate = Quantity("n", "1/min", "Rate", gt=0, default=60)
    allowed = Quantity("[n]", "1/min", "Allowed", gt=0, default=60)
    mass = Quantity("m", "kg", "Mass", gt=0, default=1)


BOTH = ("found", "twi" + "ce")  # the file itself names it once, at its step: code that names a result may take it


def made(formula: Any, key_results: tuple[str, ...] = ("found",)) -> Mechanism:
    first, other = Chapter("First"), Chapter("Other")
    first.found = formula, "f", "1/s", "Found"
    other.weight = m.mass * GRAVITY, "G", "N", "Weight"
    other.twice = 2 * m.weight, "H", "N", "Twice"
    return Mechanism(
        kind="drum",
        version="1",
        title="Drum",
        summary="",
        inputs=Drum,
        chapters=(first, other),
        key_results=key_results,
    )


DOUBTFUL = {
    "60": lambda rate: rate / 60,
    "1000": lambda rate: 1000 * rate,
    "100": lambda rate: rate * 100,
    "180": lambda rate: rate * 180 / pi,
    "9.81": lambda rate: 9.81 * rate,
    "3.14": lambda rate: rate * 3.14 * 2,
    "1e6": lambda rate: 1e6 * rate,
    "30": lambda rate: pi * rate / 30,
    "0.104719755": lambda rate: 0.104719755 * rate,
    "57.29577951": lambda rate: 57.29577951 * rate,
    "0.0174533": lambda rate: 0.0174533 * rate,
    "9550": lambda rate: 9550 * rate,
}
NOT_DOUBTFUL = [
    lambda rate: 2 * pi * rate,
    lambda rate: 30 * rate - 12 * rate,  # of a polynomial
    lambda rate: rate * pi / 4,
    lambda rate: rate**100 / rate**99,
    lambda rate: 1.5 * rate,
]
WORKED_OUT = {
    "1000": lambda rate: rate * 10**3,
    "60": lambda rate: (3 * 20) * rate,
    "0.01745329": lambda rate: pi / 180 * rate,
}


@pytest.mark.parametrize("number", DOUBTFUL)
def test_a_number_that_may_stand_for_a_unit_is_noted(number: str) -> None:
    (note,) = doubts(made(DOUBTFUL[number], BOTH))
    assert f"found: holds {number}, a number without a unit; formulas are in SI and convert nothing" in note
    assert note.startswith("test_formulas_with_faults.py:")


@pytest.mark.parametrize("number", WORKED_OUT)
def test_a_number_worked_out_of_others_may_stand_for_a_unit_too(number: str) -> None:
    assert any(
        f"found: holds {number}, a number without a unit" in note for note in doubts(made(WORKED_OUT[number], BOTH))
    )


@pytest.mark.parametrize("formula", NOT_DOUBTFUL)
def test_a_number_that_stands_for_none_is_not_noted(formula: Any) -> None:
    assert [note for note in doubts(made(formula, BOTH)) if "without a unit" in note] == []


def test_a_check_whose_sides_are_exchanged_is_noted() -> None:
    mechanism = made(lambda rate: 2 * rate, BOTH)
    right = Check("c", "strength", "C", "found", "allowed", unit="1/s", demand_label="d", limit_label="l",
                  consequence="no.")  # fmt: skip
    assert list(doubts(replace(mechanism, checks=(right,)))) == []
    (note,) = doubts(replace(mechanism, checks=(replace(right, demand="allowed", limit="found"),)))
    assert (
        "check c: its demand allowed ([n]) has the symbol of what is allowed, and its limit found is calculated" in note
    )


def test_other_numbers_are_not_noted() -> None:
    assert list(doubts(made(lambda rate: 2 * rate + rate**60 * 0.5 + 32 * rate / 3, BOTH))) == []


def test_a_chapter_that_nothing_depends_on_is_noted() -> None:
    (note,) = doubts(made(lambda rate: 2 * rate))
    assert "chapter 'Other': no check, key result, figure or other chapter uses its results" in note
    assert list(doubts(replace(made(lambda rate: 2 * rate), key_results=()))) == []  # nothing is asked of it at all


@pytest.mark.parametrize(
    ("source", "name"),
    [
        ("zz999 eq. 4", "zz999"),
        ("017, Fig. 2", "017"),
        ("statics; S2", "S2"),
        ("ISO 281", None),
        ("DIN 743-2, table 1", None),
        ("R40 series", None),
        ("this method", None),
        ("Shigley 7-6", None),
        ("001 eq. 3", None),
    ],
)
def test_a_paper_that_is_not_among_the_sources_is_noted(source: str, name: str | None) -> None:
    step = Chapter("Cited")
    step.cited = m.mass * GRAVITY, "G", "N", "Weight", source
    mechanism = replace(made(lambda rate: 2 * rate, BOTH), chapters=(step,), key_results=("cited",))
    listed = replace(mechanism, sources=(Source("001", "A paper."),))
    for each in (listed,) if name is None else (mechanism, listed):
        notes = list(doubts(each))
        assert len(notes) == (name is not None)
        assert name is None or f"step cited cites {name}, which is not a source; list it" in notes[0]
