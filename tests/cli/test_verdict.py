"""What a run says on the whole: what is not checked, --strict, and a calculation that contradicts itself."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.cli.test_cli import HEAD, Capture, run, saved

FREE = HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm}\n"
LIMITED = HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 300 N*m}\n"
CONTRADICTORY = """
from diecut_report.api import Annotated, Chapter, Check, Inputs, Mechanism, Quantity


class Twice(Inputs):
    length: Annotated[float, Quantity("L", "mm", "Length", gt=0)]
    beside: Annotated[float, Quantity("B", "mm", "Beside", gt=0)] = 10


sizes = Chapter("Sizes")
sizes.value("doubled", "D", "mm", "Doubled", lambda length: 2 * length)
sizes.value("residual", "R", "mm", "Residual", lambda doubled, length, beside: abs(doubled - length - beside))

MECHANISM = Mechanism(
    kind="twice", version="1", title="Twice", summary="", inputs=Twice, chapters=(sizes,),
    checks=(Check(id="balance", check_class="numerical", title="Balance", demand="residual", limit=1e-6, unit="mm", demand_label="rest",
                  limit_label="accepted", consequence="do not use it."),),
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
@pytest.mark.parametrize(("text", "code"), [(FREE, 1), (LIMITED, 0)])
def test_strict_ends_with_1_where_something_is_not_checked(tmp_path: Path, command: str, text: str, code: int) -> None:
    config = saved(tmp_path, text)
    where = ["-o", tmp_path / "out", "--format", "json"] if command == "report" else ["-o", tmp_path / "press.json"]
    assert run(command, config, *where) == 0
    assert run(command, config, *where, "--strict") == code


def test_page_1_does_not_say_that_all_checks_pass_where_one_is_not_made(tmp_path: Path) -> None:
    pages = []
    for text in (FREE, LIMITED):
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
    assert "The calculation contradicts itself, and its numbers must not be used. Balance: Rest 10" in told
