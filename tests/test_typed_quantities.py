"""A decimal comma and Cyrillic signs of units: read wherever a person types a single quantity, and written with a point."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

import diecut_report as dr
from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.live.session import LiveSession
from tests.configs import GOOD, HEAD, SMALL, problems, saved
from tests.study.studies import study

LATIN = """\
  a: {kind: lever, force: 2.5 kN, arm: 0.1005 m, allowable_moment: 300 N*m}
  b: {kind: lever, force: 1.25 kN, arm: "${a.arm} + 10 mm"}
"""
CYRILLIC = """\
  a:
    kind: lever
    force: 2,5 кН
    arm: {value: "0,1005 м", basis: drawing}
    allowable_moment: 300 Н·м
  b:
    kind: lever
    force: 1,25
    arm: ${a.arm} + 10 мм
"""
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary:
  mechanisms.a.force: {from: "1,5 кН", to: "2,5 кН", count: 3}
  mechanisms.a.arm:
  - 90,5 мм
  - 100,5
constraints: ["a.moment <= '0,2 кН·м'"]
"""


def values(text: str) -> list[float]:
    results = dr.loads(HEAD + text, plugins=[GOOD]).calculate()
    return [results[name].moment.si for name in ("a", "b")]


def test_a_configuration_means_the_same_in_both_spellings() -> None:
    assert values(CYRILLIC) == values(LATIN)


def test_the_same_press_gives_the_same_results_in_both_spellings(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    saved(tmp_path, HEAD.replace("700 mm", "'700,5 мм'").replace("6000 1/h", "6000 1/год") + CYRILLIC)
    assert main(["calc", str(tmp_path / "press.yaml"), "--plugins", str(GOOD), "--quiet"]) == 0
    assert "2,5 кН" in capfd.readouterr().out


def test_questions_read_them(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = str(saved(tmp_path, HEAD + LATIN))
    common = ["--plugins", str(GOOD), "--quiet"]
    asked = ["--vary", "a.force", "--for", "a.moment = 0,2 кН·м", "--from", "0,5 кН", "--to", "2,5 кН"]
    assert main(["solve", file, *asked, *common]) == 0
    assert "a.force = 1.99" in capfd.readouterr().out
    assert main(["influence", file, "--of", "a.moment", "--tolerance", "a.arm=0,5 мм", *common]) == 0
    assert "± 0.0005 m" in capfd.readouterr().out


def test_a_study_reads_them(tmp_path: Path) -> None:
    values = study(tmp_path, STUDY, HEAD + LATIN).sample.rows(0, 6)
    assert sorted(set(values["mechanisms.a.force"])) == pytest.approx([1500, 2000, 2500])
    assert sorted(set(values["mechanisms.a.arm"])) == pytest.approx([0.0905, 0.1005])


def test_the_live_page_reads_them_and_saves_a_point(tmp_path: Path) -> None:
    session = LiveSession(saved(tmp_path, SMALL), Discovery([]))
    session.change({"clutch.torque": "250,5 Н·м"})
    session.change({"clutch.shoe_radius": "120,5"})
    session.write()
    kept = yaml.safe_load((tmp_path / "press.yaml").read_text("utf-8"))["mechanisms"]["clutch"]
    assert (kept["torque"], kept["shoe_radius"]) == ("250.5 N·m", "120.5 mm")


def test_python_reads_them() -> None:
    press = dr.loads(HEAD + LATIN, plugins=[GOOD])
    other = press.with_values({"a.arm": "90,5 мм", "b.force": "1,5"})
    assert other.calculate()["a"].inputs["arm"].si == pytest.approx(0.0905)
    assert other.calculate()["a"].moment < "0,3 кН·м"
    assert "arm: 90.5 mm" in other.text and 'force: "1.5"' in other.text


@pytest.mark.parametrize(
    ("typed", "readings"), [("1,000 mm", "1000 mm or 1.000 mm"), ("6 000 mm", "6000 mm or 6.000 mm")]
)
def test_what_can_be_read_in_two_ways_is_asked_with_file_and_line(typed: str, readings: str, tmp_path: Path) -> None:
    (problem,) = problems(tmp_path, HEAD + f"  a: {{kind: lever, force: 2 kN, arm: '{typed}'}}\n")
    assert problem == f"5:38: mechanisms.a.arm: '{typed}' may be {readings}; write the one that is meant."
