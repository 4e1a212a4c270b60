"""What changed between two calculations: each change once, with its size, and what matters first."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from diecut_report.report.chapters.front import printed_changes, relative
from diecut_report.report.text import Catalogue
from diecut_report.results.changes import changes
from diecut_report.results.model import ChangesRecord, ResultsRecord
from tests.configs import HEAD, saved
from tests.exchange.reports import run
from tests.records import filled

Capture = pytest.CaptureFixture[str]
Data = dict[str, Any]
LIMITED = (
    HEAD
    + "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 250 N*m}\n  b: {kind: lever, force: '${a.force}'}\n"
)


def results(folder: Path, text: str, name: str) -> Data:
    assert run("calc", saved(folder, text, f"{name}.yaml"), "-o", folder / f"{name}.json", "--quiet") in (0, 1)
    found: Data = json.loads((folder / f"{name}.json").read_text("utf-8"))
    return found


def between(folder: Path, old: str, new: str) -> Data:
    return changed_between(folder, old, new).data()


def changed_between(folder: Path, old: str, new: str) -> ChangesRecord:
    sides = (ResultsRecord.model_validate(results(folder, *side)) for side in ((old, "old"), (new, "new")))
    return changes(*sides)


def test_a_calculation_has_no_changes_against_itself(tmp_path: Path, capfd: Capture) -> None:
    found = between(tmp_path, LIMITED, LIMITED + "\n# a word more\n")
    assert [found[key] for key in ("mechanisms", "checks", "inputs", "outputs", "code")] == [[], [], [], [], []]
    assert run("diff", tmp_path / "old.yaml", tmp_path / "new.yaml") == 0
    assert capfd.readouterr().out.splitlines()[-1] == "Nothing changed."


def test_inputs_outputs_and_checks_that_changed_are_listed_with_their_change(tmp_path: Path) -> None:
    found = between(tmp_path, LIMITED, LIMITED.replace("2 kN", "3 kN"))
    (force, follower) = found["inputs"]
    assert (force["path"], force["relative"], force["follows"]) == ("a.force", 0.5, "")
    assert (force["old"]["display"], force["new"]["display"]) == (
        {"text": "2", "unit": "kN"},
        {"text": "3", "unit": "kN"},
    )
    assert (follower["path"], follower["relative"], follower["follows"]) == ("b.force", 0.5, "a.force")
    # 2 kN × 100 mm = 200 N·m, 3 kN × 100 mm = 300 N·m, allowed 250 N·m
    moments = [row for row in found["outputs"] if row["path"] == "a.moment"]
    assert [(row["old"]["value"], row["new"]["value"], row["relative"]) for row in moments] == [(200, 300, 0.5)]
    (check,) = found["checks"]
    assert (check["mechanism"], check["id"], check["change"]) == ("a", "moment", "worse")
    assert [check[side]["status"] for side in ("old", "new")] == ["pass", "fail"]
    assert [check[side]["utilisation"] for side in ("old", "new")] == [0.8, 1.2]


def test_what_a_user_writes_anew_is_no_follower(tmp_path: Path) -> None:
    found = between(tmp_path, LIMITED, LIMITED.replace("'${a.force}'", "'1.5 * ${a.force}'"))
    assert [(row["path"], row["relative"], row["follows"]) for row in found["inputs"]] == [("b.force", 0.5, "")]


def test_data_of_the_press_that_a_user_changes_follow_nothing(tmp_path: Path) -> None:
    found = between(tmp_path, LIMITED, LIMITED.replace("thickness: 0.6 mm", "thickness: 0.5 mm"))
    [thickness] = (row for row in found["inputs"] if row["path"] == "press.sheet.thickness")
    assert thickness["follows"] == ""


def test_the_basis_of_a_value_is_a_change(tmp_path: Path) -> None:
    found = changed_between(tmp_path, LIMITED, LIMITED.replace("force: 2 kN", "force: {value: 2 kN, basis: measured}"))
    (row, *_) = printed_changes(found, Catalogue("en")).inputs
    assert (row.path, row.change, row.note) == ("a.force", "", "given → measured")


def test_mechanisms_that_come_or_go_are_told_as_such(tmp_path: Path) -> None:
    found = between(tmp_path, LIMITED, LIMITED.replace("  b:", "  c:"))
    told = [(row["name"], row["old"], row["new"]) for row in found["mechanisms"]]
    assert told == [("b", "lever", ""), ("c", "", "lever")]
    assert found["inputs"] == found["outputs"] == []
    assert [(row["mechanism"], row["change"]) for row in found["checks"]] == [("c", "added")]


def test_values_that_print_alike_get_digits_that_tell_them_apart(tmp_path: Path) -> None:
    found = between(tmp_path, LIMITED, LIMITED.replace("arm: 100 mm", "arm: 100.0001 mm"))
    (row,) = (row for row in found["outputs"] if row["path"] == "a.moment")
    assert (row["old"]["display"]["text"], row["new"]["display"]["text"]) == ("200", "200.0002")
    assert row["relative"] == pytest.approx(1e-6)


CHECKED = [  # status and utilisation before and after, from the most important on
    (("pass", 0.5), ("fail", 1.5)), (("not_checked", None), ("fail", 1.1)), (("pass", 0.5), ("warn", 1.01)), (("pass", 0.5), ("not_checked", None)),
    (("fail", 1.5), ("pass", 0.5)), (("warn", 1.2), ("pass", 0.9)), (("not_checked", None), ("pass", 0.9)),
    (("fail", 1.5), ("fail", 1.8)), (("pass", 0.2), ("pass", 0.6)), (("pass", 0.2), ("pass", 0.3)), (("pass", 0.6), ("pass", 0.1)),
]  # fmt: skip


def test_checks_stand_in_the_order_of_their_importance(tmp_path: Path) -> None:
    whole = results(tmp_path, LIMITED, "old")
    sides: list[Data] = []
    for side in (0, 1):
        judged = [{"id": f"c{number}", "title": "C", "class": "strength", "status": pair[side][0], "utilisation": pair[side][1]}
                  for number, pair in enumerate(CHECKED)]  # fmt: skip
        mechanism = whole["mechanisms"]["a"] | {"checks": judged[:: 1 if side else -1]}
        sides.append(whole | {"mechanisms": {"a": mechanism}, "governing": {"mechanism": "a", "check": "c0"}})
    found = changes(*(filled(ResultsRecord, side) for side in sides)).checks
    assert [row.id for row in found] == [f"c{number}" for number in range(len(CHECKED))]


@pytest.mark.parametrize(
    ("share", "told"),
    [
        (0.5, "+50 %"),
        (-0.2143, "−21.4 %"),
        (2.1, "+210 %"),
        (99.0, "× 100"),
        (1e-6, "+0.0001 %"),
        (None, ""),
        (0.0, ""),
    ],
)
def test_a_change_is_told_as_people_say_it(share: float | None, told: str) -> None:
    assert " ".join(relative(share, ".").split()) == told


@pytest.mark.wheel
def test_the_exit_code_is_the_verdict_on_the_new_one(tmp_path: Path, capfd: Capture) -> None:
    good, bad = saved(tmp_path, LIMITED, "good.yaml"), saved(tmp_path, LIMITED.replace("2 kN", "3 kN"), "bad.yaml")
    assert [run("diff", *pair) for pair in ((good, bad), (bad, good), (bad, bad))] == [1, 0, 1]
    out = " ".join(capfd.readouterr().out.split())
    assert "worse a: Moment pass 80.0 % → fail 120.0 %" in out and "a.force 2 kN → 3 kN +50 %" in out
    assert run("diff", good, tmp_path / "nowhere.yaml") == 2


def test_a_report_its_results_and_its_configuration_are_the_same_side(tmp_path: Path, capfd: Capture) -> None:
    good, bad = saved(tmp_path, LIMITED, "good.yaml"), saved(tmp_path, LIMITED.replace("2 kN", "3 kN"), "bad.yaml")
    assert run("report", good, "-o", tmp_path, "--format", "html,json", "--quiet") == 0
    told = []
    for old in (good, tmp_path / "good.html", tmp_path / "good.json"):
        assert run("diff", old, bad, "--format", "json") == 1
        told.append(json.loads(capfd.readouterr().out))
    assert told[0] == told[1] == told[2] and told[0]["checks"]


def test_a_machine_whose_checks_hold_is_called_no_pass(tmp_path: Path, capfd: Capture) -> None:
    """Something may be open of it, of which changes tell nothing."""
    good, bad = saved(tmp_path, LIMITED, "good.yaml"), saved(tmp_path, LIMITED.replace("2 kN", "3 kN"), "bad.yaml")
    assert run("diff", bad, good) == 0
    old, new = (" ".join(line.split()) for line in capfd.readouterr().out.splitlines()[:2])
    assert "bad.yaml fail 1 fail" in old and "good.yaml 1 pass" in new
    assert results(tmp_path, LIMITED, "good")["summary"]["verdict"] == "conditional"
    assert run("diff", bad, good, "--format", "html", "-o", tmp_path / "page.html") == 0
    sides = (tmp_path / "page.html").read_text("utf-8").partition("</table>")[0]
    assert 'class="badge fail"' in sides and 'class="badge pass"' not in sides and "1 pass" in sides


def test_a_page_of_changes_needs_neither_network_nor_scripts(tmp_path: Path) -> None:
    good, bad = saved(tmp_path, LIMITED, "good.yaml"), saved(tmp_path, LIMITED.replace("2 kN", "3 kN"), "bad.yaml")
    pages = []
    for name in ("a.html", "b.html"):
        assert run("diff", good, bad, "--format", "html", "-o", tmp_path / name) == 1
        pages.append((tmp_path / name).read_text("utf-8"))
    assert pages[0] == pages[1]
    assert "<script" not in pages[0]
    assert "default-src &#39;none&#39;" in pages[0]
    assert "http" not in pages[0].split("</style>")[1]
    assert "a.force" in pages[0] and "+50" in pages[0]
    before = bad.read_bytes()
    assert run("diff", good, bad, "-o", bad) == 2 and bad.read_bytes() == before
    before = good.read_bytes()
    assert run("diff", good, bad, "-o", good) == 2 and good.read_bytes() == before


def test_what_is_shown_as_beyond_a_size_of_interest_is_compared_as_that(tmp_path: Path, capfd: Capture) -> None:
    """The critical speed of a short shaft, "> 30000" r/min: a little more is no change, and is no number."""
    old = tmp_path / "old.yaml"
    assert run("new", "shaft", "-o", old) == 0
    text = old.read_text("utf-8")
    (tmp_path / "new.yaml").write_text(text.replace("value: 45 mm", "value: 46 mm", 1), "utf-8")
    assert run("diff", old, tmp_path / "new.yaml") in (0, 1)
    told = capfd.readouterr().out
    assert "sections.0.diameter" in told and "> 30 000" not in told
