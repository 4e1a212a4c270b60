"""The chapter of the report on what matters: closed forms of a lever, both languages, and what is wrong with what it asks for."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from scipy.stats import norm

from diecut_report.cli.main import main
from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ResultsRecord
from tests.configs import GOOD, HEAD, saved

Capture = pytest.CaptureFixture[str]
ASKED = "{of: [a.moment], by: 5 %, tolerances: {a.arm: 20 mm}, count: 1000, seed: 2}"
LEVER = "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 210 N*m}\n"


def config(asked: str, language: str = "en") -> str:
    head = HEAD.replace("{title: Test}", f"{{title: Test, language: {language}}}\nreport: {{influence: {asked}}}")
    return head + LEVER


def report(folder: Path, text: str, formats: str = "html,json") -> int:
    return main(["report", str(saved(folder, text)), "-o", str(folder), "--format", formats, "--plugins", str(GOOD)])


def test_the_report_holds_the_chapter_and_can_be_verified(tmp_path: Path, capfd: Capture) -> None:
    assert report(tmp_path, config(ASKED)) == 0
    found = json.loads((tmp_path / "press.json").read_text("utf-8"))["influence"]
    (tornado,) = found["tornados"]
    bars = {bar["name"]: (bar["lowered"], bar["low"], bar["raised"], bar["high"]) for bar in tornado["bars"]}
    assert bars["a.force"] == pytest.approx((1.9, 190, 2.1, 210)) and bars["a.arm"] == pytest.approx(
        (80, 160, 120, 240)
    )
    (check,) = found["tolerances"]["checks"]
    # the moment is linear in the arm: 2 kN by at most 105 mm, of a normal distribution about 100 mm with a deviation of 20/3 mm
    assert check["low"] < norm.cdf((105 - 100) / (20 / 3)) < check["high"]
    page = (tmp_path / "press.html").read_text("utf-8")
    assert "Influence of inputs" in page and "Lever · Moment" in page and 'id="fig-1.1"' in page
    capfd.readouterr()
    assert main(["verify", str(tmp_path / "press.html"), "--numbers", "--plugins", str(GOOD)]) == 0


def test_all_formats_hold_it_and_equal_results_give_equal_bytes(tmp_path: Path) -> None:
    assert report(tmp_path, config(ASKED), "json") == 0
    results = ResultsRecord.model_validate_json((tmp_path / "press.json").read_bytes())
    results = results.with_(project=results.project.with_(language="uk"))
    pages, words = ([Rendering(results).html() for _ in range(2)], [Rendering(results).docx() for _ in range(2)])
    assert pages[0] == pages[1] and "Вплив вхідних даних" in pages[0] and "Імовірність виконання" in pages[0]
    assert words[0] == words[1] and len(Rendering(results.with_(influence=None)).docx()) < len(words[0])


def test_without_names_the_governing_checks_are_looked_at(tmp_path: Path) -> None:
    assert report(tmp_path, config("{}"), "json") == 0
    found = json.loads((tmp_path / "press.json").read_text("utf-8"))["influence"]
    assert [each["name"] for each in found["tornados"]] == ["a.checks.moment.utilisation"] and "tolerances" not in found


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (
            "{tolerances: {a.n_points: 1}}",
            "press.yaml:3:35: report.influence.tolerances.a.n_points: a.n_points only sets how densely",
        ),
        ("{of: [a.momemt]}", "press.yaml:3:27: report.influence.of.0: a.momemt is neither a number that a gives"),
        ("{tolerances: {a.arn: 1 mm}}", "report.influence.tolerances.a.arn: a.arn 'arn' is not an input of a"),
        ("{tolerances: {a.arm: 1 kg}}", "report.influence.tolerances.a.arm: 1 kg is a mass"),
        ("{tolerances: {a.arm: -1 mm}}", "report.influence.tolerances.a.arm: a.arm: -1 mm is not above zero"),
        (
            "{tolerances: {a.arm: 1 mm, mechanisms.a.arm: 2 mm}}",
            "report.influence.tolerances: a.arm is given more than one tolerance",
        ),
        ("{tolerances: [1 mm]}", "report.influence.tolerances: must be written as keys and sizes"),
        ("{by: 0}", "report.influence.by: 0"),
        ("{share: 1}", "report.influence.share: is an unknown key"),
        ("{distribution: cauchy}", "report.influence.distribution"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(tmp_path: Path, capfd: Capture, asked: str, words: str) -> None:
    assert report(tmp_path, config(asked)) == 2
    _, err = capfd.readouterr()
    assert words in err and list(tmp_path.iterdir()) == [tmp_path / "press.yaml"]


def test_validate_tells_all_that_is_wrong_with_it_at_once(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, config("{of: [a.moment, a.momemt, b.moment], tolerances: {a.arn: 1 mm, a.arm: 1 kg}}"))
    assert main(["validate", str(file), "--plugins", str(GOOD)]) == 2
    _, err = capfd.readouterr()
    assert [line.split(" ")[1] for line in err.splitlines()] == [
        f"report.influence.{key}:" for key in ("of.1", "of.2", "tolerances.a.arn", "tolerances.a.arm")
    ]
    assert err.splitlines()[0].startswith(f"{file}:3:37: ") and "did you mean 'moment'?" in err
    assert f"{file}:3:71: report.influence.tolerances.a.arn" in err and "did you mean 'arm'?" in err
    file.write_text(config(ASKED), encoding="utf-8")
    assert main(["validate", str(file), "--plugins", str(GOOD)]) == 0


def test_the_schema_knows_it(capfd: Capture) -> None:
    assert main(["schema"]) == 0
    report_block = json.loads(capfd.readouterr().out)["properties"]["report"]["properties"]["influence"]
    assert {"of", "by", "tolerances", "distribution", "count", "seed"} <= set(json.dumps(report_block).split('"'))


@pytest.mark.parametrize(("asked", "told"), [("{}", True), ("{defaults: true}", False)])
def test_the_chapter_tells_of_inputs_at_their_default(tmp_path: Path, asked: str, told: bool) -> None:
    assert report(tmp_path, config(asked, "uk")) == 0
    template = "вхідна величина має типове значення і не змінюється; report.influence.defaults змінює і її."
    assert (template in (tmp_path / "press.html").read_text("utf-8")) == told
