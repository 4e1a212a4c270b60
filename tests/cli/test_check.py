"""The command check: many machines side by side, their verdicts in one table and one summary."""

from __future__ import annotations

import csv
import io
import json
import re
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from pypdf import PdfReader

from diecut_report.cli.main import main
from diecut_report.results.model import ResultsRecord
from tests.cli.test_cli import run
from tests.configs import BROKEN, GOOD, HEAD, LEVER, YAML, saved
from tests.records import filled
from tests.study.studies import BASE, STUDY

Capture = pytest.CaptureFixture[str]
LIMITED = LEVER.replace("force: 2 kN", "force: 2 kN, allowable_moment: 150 N*m")


def check(*arguments: object, jobs: int = 1) -> int:
    return main(["check", *map(str, arguments), "--plugins", str(GOOD), "--jobs", str(jobs)])


@pytest.fixture
def firm(tmp_path: Path) -> Path:
    """A folder with a machine that passes, one that fails, a study, and in a folder below it one that passes."""
    folder = tmp_path / "firm"
    (folder / "old").mkdir(parents=True)
    saved(folder, LIMITED.replace("150", "250"), "good.yaml")
    saved(folder, LIMITED, "weak.yaml")
    saved(folder / "old", LIMITED.replace("150", "400").replace("2 kN", "3 kN"), "good.yaml")
    saved(folder, "base: good.yaml\nsample: {method: grid}\n", "study.yaml")
    return folder


def test_a_folder_gives_one_table(firm: Path, capfd: Capture) -> None:
    assert check(firm, jobs=2) == 1
    out, err = capfd.readouterr()
    assert [line.split() for line in out.splitlines()[1:]] == [
        ["firm/good", "pass", "a.moment", "80.0", "%", "0", "0", "0", "0"],
        ["old/good", "pass", "a.moment", "75.0", "%", "0", "0", "0", "0"],
        ["firm/weak", "fail", "a.moment", "133.3", "%", "1", "0", "0", "0"],
    ]
    template = "skipped: it is a study, which batch calculates"
    assert err == f"{firm / 'study.yaml'}: {template}\n3 machines: 2 pass, 1 fail.\n"


def test_a_machine_that_passes_on_what_is_assumed_is_conditional(tmp_path: Path, capfd: Capture) -> None:
    folder, text = tmp_path / "firm", LIMITED.replace("150", "250")
    folder.mkdir()
    saved(folder, text, "good.yaml")
    saved(folder, text.replace("2 kN", "{value: 2 kN, basis: assumed}").replace("250", "210"), "guessed.yaml")
    assert check(folder, "-o", tmp_path / "out", "--format", "json,csv,html") == 0
    out, err = capfd.readouterr()
    assert [line.split()[:2] + line.split()[-1:] for line in out.splitlines()[1:]] == [
        ["good", "pass", "0"],
        ["guessed", "conditional", "1"],
    ]
    assert "2 machines: 1 pass, 1 conditional.\n" in err
    stored = json.loads((tmp_path / "out" / "machines.json").read_text("utf-8"))["machines"]
    assert [each["conclusion"] for each in stored] == [
        "All checks pass.",
        "No check fails, but 1 assumed value is open and 1 default value is open.",
    ]
    assert [each["verdict"] for each in stored] == ["pass", "conditional"]
    page = (tmp_path / "out" / "machines.html").read_text("utf-8")
    assert '<span class="conditional">conditional' in page
    assert "verdict,Verdict,1,pass,conditional" in (tmp_path / "out" / "machines.csv").read_text("utf-8")


def test_all_pass_ends_with_0(firm: Path) -> None:
    assert check(firm / "good.yaml", firm / "old") == 0


def test_a_bad_file_is_told_and_the_others_go_on(firm: Path, capfd: Capture) -> None:
    saved(firm, LEVER.replace("2 kN", "2 kg, arm: -1"), "bad.yaml")
    assert check(firm) == 2
    out, err = capfd.readouterr()
    assert out.splitlines()[1].split() == ["firm/bad", "bad", "file"]
    assert len(out.splitlines()) == 5
    assert "bad.yaml:5:27: mechanisms.a.force: 2 kg is a mass" in err and "bad.yaml:5:38: mechanisms.a.arm" in err


def test_a_broken_plugin_ends_with_3(firm: Path, capfd: Capture) -> None:
    saved(firm, LEVER + "  x: {kind: breaks_in_calculation}\n", "broken.yaml")
    assert main(["check", str(firm), "--plugins", str(GOOD), "--plugins", str(BROKEN), "--jobs", "1"]) == 3
    assert "plugin 'breaks_in_calculation'" in capfd.readouterr().err


def test_an_empty_folder_is_told(tmp_path: Path, capfd: Capture) -> None:
    assert check(tmp_path) == 2
    assert capfd.readouterr().err.startswith("There is no configuration in")


def test_the_summary_has_all_formats_with_the_same_numbers(firm: Path, tmp_path: Path, capfd: Capture) -> None:
    assert check(firm, "-o", tmp_path / "out") == 1
    out = tmp_path / "out"
    assert sorted(path.name for path in out.iterdir()) == [
        f"machines.{e}" for e in ("csv", "html", "json", "pdf", "xlsx")
    ]
    data = json.loads((out / "machines.json").read_text("utf-8"))
    moment = {"firm/good": 0.8, "old/good": 0.75, "firm/weak": 200 / 150}
    assert {name: cell["utilisation"] for name, cell in data["checks"][0]["machines"].items()} == pytest.approx(moment)
    differing = {row["path"]: list(row["machines"].values()) for row in data["own_changes"]}
    assert differing == {"a.force": [2, 3, 2], "a.allowable_moment": [250, 400, 150]}
    advice = "Moment 200 N·m, allowed 150 N·m: shorten the arm."
    assert data["advice"] == [{"machine": "firm/weak", "check": "a.moment", "text": advice}]
    rows = list(csv.reader(io.StringIO((out / "machines.csv").read_text("utf-8"))))
    assert ["a.checks.moment.utilisation", "Moment", "1", "0.8", "0.75", "1.3333333333333333"] in rows
    assert ["a.checks.moment.status", "Moment", "", "pass", "pass", "fail"] in rows
    book = openpyxl.load_workbook(out / "machines.xlsx")
    assert book.sheetnames == ["comparison", "differences", "checks", "advice"]
    assert book["comparison"]["B4"].value == "fail"
    page = (out / "machines.html").read_text("utf-8")
    assert "133.3\N{NO-BREAK SPACE}%" in page and "shorten the arm" in page and "<script" not in page
    document = PdfReader(out / "machines.pdf")
    assert re.search(rf"\b1\s+of\s+{len(document.pages)}\b", document.pages[0].extract_text())


def test_what_is_passed_over_in_a_folder_is_told(firm: Path, tmp_path: Path, capfd: Capture) -> None:
    saved(firm, "- 1\n", "list.yml")
    check(firm)
    err = capfd.readouterr().err
    assert f"{firm / 'list.yml'}: skipped: it has no key mechanisms, and so is not a configuration\n" in err
    assert f"{firm / 'study.yaml'}: skipped: it is a study, which batch calculates\n" in err
    check(firm, "--quiet")
    assert ": skipped: " not in capfd.readouterr().err
    other = tmp_path / "other"
    other.mkdir()
    saved(other, "a: 1\n", "no.yaml")
    assert check(other) == 2
    err = capfd.readouterr().err
    assert "There is no configuration in" in err and "no.yaml: skipped: it has no key" in err


def test_only_the_asked_formats_are_written(firm: Path, tmp_path: Path) -> None:
    check(firm, "-o", tmp_path / "out", "--format", "csv,json", "--quiet")
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["machines.csv", "machines.json"]


def test_strict_ends_with_1_where_something_is_not_checked() -> None:
    from diecut_report.cli.checking import _code
    from diecut_report.study.comparison import Verdict

    for verdict, codes in (("pass", (0, 0)), ("conditional", (0, 1)), ("fail", (1, 1))):
        judged = [Verdict("a", "a.yaml", "pass", verdict=verdict)]
        assert (_code(judged, strict=False), _code(judged, strict=True)) == codes


def test_what_is_not_checked_is_counted_from_the_results() -> None:
    from diecut_report.study.comparison import verdict
    from diecut_report.study.machines import CheckedMachine

    results = filled(ResultsRecord, {"summary": {"not_checked": 7}})
    assert verdict(CheckedMachine("a.yaml", "pass", results), "a").not_checked == 7


# What a run says on the whole: what is not checked, --strict, and a calculation that contradicts itself.


FREE = HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm}\n"
WITH_LIMIT = HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 300 N*m}\n"
CONTRADICTORY = """
from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, m


class Twice(Inputs):
    length = Quantity("L", "mm", "Length", gt=0)
    beside = Quantity("B", "mm", "Beside", gt=0, default=10)


sizes = Chapter("Sizes")
sizes.doubled = 2 * m.length, "D", "mm", "Doubled"
sizes.residual = abs(m.doubled - m.length - m.beside), "R", "mm", "Residual"

MECHANISM = Mechanism(
    kind="twice", version="1", title="Twice", summary="", inputs=Twice, chapters=(sizes,),
    checks=(Check("balance", "numerical", "Balance", m.residual, 1e-6, consequence="do not use it."),),
)
"""
CHAIN = (
    HEAD
    + "  a: {kind: twice, length: 20}\n  b: {kind: twice, length: '${a.doubled}', beside: 40}\n  c: {kind: twice, length: 10}\n"
)


def results(config: Path, *more: object) -> tuple[int, dict[str, Any]]:
    code = run("calc", config, "-o", config.with_suffix(".json"), *more)
    found: dict[str, Any] = json.loads(config.with_suffix(".json").read_text("utf-8"))
    return code, found


def test_a_check_without_its_limit_is_told_and_counted(tmp_path: Path, capfd: Capture) -> None:
    code, found = results(saved(tmp_path, FREE))
    err = capfd.readouterr().err
    assert code == 0 and found["status"] == "pass"
    told = found["summary"].pop("conclusion")
    left = found["summary"].pop("open")
    assert found["summary"] == {"pass": 0, "warn": 0, "fail": 0, "not_checked": 1, "numerical": {"pass": 0, "fail": 0},
                                "governing": None, "assumed": [], "verdict": "conditional"}  # fmt: skip
    assert [(each["what"], each["path"], each["owner"]) for each in left] == [
        ("not_checked", "mechanisms.a.checks.moment", ""),
        ("default", "mechanisms.a.arm", ""),  # typed, but what it would be if nobody typed it
        ("default", "mechanisms.a.teeth", ""),
    ]
    assert told["text"] == "Nothing was checked, and 1 check is not made and 2 default values are open."
    assert told["template"] == "Nothing was checked, and {left}."
    assert told["values"]["left"]["values"]["first"]["count"] == 1
    assert err.splitlines() == [
        "not checked a: Moment. Moment 200 N·m, but allowable_moment is not given.",
        "Nothing was checked, and 1 check is not made and 2 default values are open.",
    ]


@pytest.mark.parametrize("command", ["calc", "report"])
@pytest.mark.parametrize(("text", "code"), [(FREE, 1), (WITH_LIMIT, 0)])
def test_strict_is_for_one_machine_too(tmp_path: Path, command: str, text: str, code: int) -> None:
    config = saved(tmp_path, text)
    where = ["-o", tmp_path / "out", "--format", "json"] if command == "report" else ["-o", tmp_path / "press.json"]
    assert run(command, config, *where) == 0
    assert run(command, config, *where, "--strict") == code


def test_page_1_does_not_say_that_all_checks_pass_where_one_is_not_made(tmp_path: Path) -> None:
    pages = []
    for text in (FREE, WITH_LIMIT):
        assert run("report", saved(tmp_path, text), "-o", tmp_path, "--format", "html", "--quiet") == 0
        pages.append((tmp_path / "press.html").read_text("utf-8"))
    assert "All checks pass" not in pages[0] and "Nothing was checked, and 1 check is not made." in pages[0]
    assert ">allowable_moment</span>" in pages[0]
    assert "All checks pass" in pages[1] and "1 check is not made" not in pages[1]


def test_a_calculation_that_contradicts_itself_is_an_error_and_what_refers_to_it_is_skipped(
    tmp_path: Path, capfd: Capture
) -> None:
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "twice.py").write_text(CONTRADICTORY, encoding="utf-8")
    code, found = results(saved(tmp_path, CHAIN), "--plugins", tmp_path / "plugins")
    assert code == 3 and found["status"] == "error"
    assert [found["mechanisms"][name]["status"] for name in "abc"] == ["error", "skipped", "pass"]
    assert found["summary"]["numerical"] == {"pass": 1, "fail": 1} and found["mechanisms"]["a"]["outputs"] == {}
    told = found["mechanisms"]["a"]["error"]
    assert told in capfd.readouterr().err and told.endswith(": do not use it.")
    assert "The calculation contradicts itself, and its numbers must not be used. Balance: Residual 10" in told


# The command validate: studies too, and what else only a calculation finds, with all faults of a file at once.


IMPOSSIBLE = """\
  cylinder: {kind: cylinder_sizing, working_length: 470 mm, segment_height: 40 mm, generatrix_length: '${press.sheet.length}',
    bore_radius: 50 mm, radius: 105 mm, bearing_span: '${press.sheet.length} - 10 mm'}
  knife: {kind: knife_drive, cylinder_rate: 25000 1/h, working_depth: 40 mm, crank_slider: {crank_radius: 35 mm, rod_length: 20 mm}}
"""
WRONG = "  clutch: {kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg, radial_gap: 0,5 mm}\n"


def told(folder: Path, text: str, capfd: pytest.CaptureFixture[str]) -> list[str]:
    assert main(["validate", str(saved(folder, text)), "--plugins", str(GOOD)]) == 2
    return [line.removeprefix(f"{folder / 'press.yaml'}:") for line in capfd.readouterr().err.splitlines()]


def test_what_cannot_be_and_what_is_wrong_is_told_at_once(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    found = told(tmp_path, HEAD + IMPOSSIBLE + WRONG, capfd)
    assert found[0].startswith("6:55: mechanisms.cylinder.bearing_span: is 690 mm, but the bearings stand outside")
    assert found[1].startswith(
        "7:126: mechanisms.knife.crank_slider.rod_length: is 20 mm, not longer than the crank_radius"
    )
    assert found[2].startswith("8:99: mechanisms.clutch.5 mm: is the remainder of a number with a decimal comma")
    assert len(found) == 3


def test_the_examples_are_valid(
    capfd: pytest.CaptureFixture[str],
) -> None:  # among them one that takes mechanisms whole
    files = [str(path) for path in YAML if path.stem in ("flat_cylinder_press", "flat_cylinder_study")]
    assert main(["validate", *files]) == 0
    assert capfd.readouterr().err.splitlines() == [f"{file}: valid" for file in files]


def test_what_refers_to_what_is_wrong_is_left_alone(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text = LEVER.replace("2 kN", "2 kg") + "  b: {kind: lever, force: 1, allowable_moment: '${a.moment}'}\n"
    assert len(told(tmp_path, text, capfd)) == 1


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (HEAD + "  \u0441lutch: {kind: lever, force: 1}\n", "“\u0441lutch” holds letters that only look Latin: “\u0441” (cyrillic small letter es)."),
        (HEAD + "  a: {kind: l\u0435ver, force: 1}\n", "“l\u0435ver” holds letters that only look Latin: “\u0435” (cyrillic small letter ie)."),
        (HEAD + "  a: {kind: lev\u03b5r, force: 1}\n", "lev\u03b5r"),  # an epsilon does not look Latin
        (LEVER + "  b: {kind: lever, force: '${\u0430.force}'}\n", "${\u0430.force}: “\u0430” holds letters that only look Latin"),
    ],
)  # fmt: skip
def test_a_name_in_letters_that_only_look_latin_is_told_as_such(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], text: str, words: str
) -> None:
    assert words in "\n".join(told(tmp_path, text, capfd))


def test_a_study_is_validated_too(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    saved(tmp_path, BASE)
    study = saved(tmp_path, STUDY, "study.yaml")
    assert main(["validate", str(study), "--plugins", str(GOOD)]) == 0
    assert capfd.readouterr().err == f"{study}: valid\n"
    saved(tmp_path, STUDY.replace("a.force", "a.forc"), "study.yaml")
    assert main(["validate", str(study), "--plugins", str(GOOD)]) == 2
    assert "did you mean" in capfd.readouterr().err
