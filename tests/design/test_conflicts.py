"""Which checks conflict where nothing passes: levers whose arms depend on each other, against inequalities solved by hand and by HiGHS."""

from __future__ import annotations

import json
import random
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from scipy.optimize import linprog

from diecut_report.cli.main import main
from tests.configs import GOOD, HEAD, saved
from tests.examples import few

Capture = pytest.CaptureFixture[str]
# moments: a: 3 kN·A ≤ 250 N·m, A ≤ 83.3 mm; b: 3 kN·(300 mm − A) ≤ 500 N·m, A ≥ 133.3 mm; c: mended by itself
TEXT = (
    HEAD
    + """\
  a: {kind: lever, force: 3 kN, arm: 100 mm, allowable_moment: 250 N*m}
  b: {kind: lever, force: 3 kN, arm: "300 mm - ${a.arm}", allowable_moment: 500 N*m}
  c: {kind: lever, force: 3 kN, arm: 100 mm, allowable_moment: 250 N*m}
"""
)


def advise(press: Path, *more: object) -> int:
    return main(["advise", str(press), *map(str, more), "--plugins", str(GOOD)])


def found(capfd: Capture, press: Path, *more: object) -> dict[str, Any]:
    code = advise(press, *more, "--format", "json")
    answer: dict[str, Any] = json.loads(capfd.readouterr().out)
    assert code == (1 if answer["machine"] is None else 0)
    return answer


@pytest.mark.nightly
def test_the_least_set_that_conflicts_is_told_and_what_is_not_proved(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, TEXT), "--free", "a.arm", "--free", "c.arm") == 1
    out = capfd.readouterr().out
    template = "no machine was found that satisfies all of these; this does not prove that none exists: {}\n"
    assert template.format("a.moment, b.moment") in out
    assert "if any one of them is dropped, a calculated machine satisfies the others" in out


def test_a_check_that_no_free_input_can_change_is_proved_to_fail(tmp_path: Path, capfd: Capture) -> None:
    assert advise(saved(tmp_path, TEXT), "--free", "c.arm") == 1
    out = capfd.readouterr().out
    assert "proved: a.moment, b.moment do not depend on any free input and fail for all of their values" in out
    assert found(capfd, tmp_path / "press.yaml", "--free", "b.force")["conflict"] == {
        "checks": ["a.moment", "c.moment"], "proved": True, "least": False,
    }  # fmt: skip


@pytest.mark.nightly
def test_one_check_alone_may_be_out_of_reach(tmp_path: Path, capfd: Capture) -> None:
    text = TEXT.replace("300 mm - ${a.arm}", "500 mm + ${a.arm}")  # 3 kN·500 mm is above 500 N·m whatever is added
    answer = found(capfd, saved(tmp_path, text), "--free", "a.arm", "--free", "c.arm")
    assert answer["conflict"] == {"checks": ["b.moment"], "proved": False, "least": True}


@pytest.mark.parametrize("seed", few(range(40), lambda _: False))
def test_conflicts_are_those_that_linear_programming_tells(seed: int, tmp_path: Path, capfd: Capture) -> None:
    """Each moment is one kilonewton by an arm that is linear in two free ones: c0 + c1·p + c2·q, all below the limit of 250 mm."""
    draw = random.Random(seed)
    rows = [[draw.randint(1, 9) * 50, *(draw.choice((-2, -1, 0, 1, 2)) for _ in range(2))] for _ in range(4)]
    free = "  p: {kind: lever, force: 1 kN, arm: 150 mm}\n  q: {kind: lever, force: 1 kN, arm: 150 mm}\n"
    arms = [f'"{c0} mm + {c1} * ${{p.arm}} + {c2} * ${{q.arm}}"' for c0, c1, c2 in rows]
    text = HEAD + free + "".join(
        f"  l{index}: {{kind: lever, force: 1 kN, arm: {arm}, allowable_moment: 250 N*m}}\n" for index, arm in enumerate(arms)
    )  # fmt: skip
    code = advise(saved(tmp_path, text), "--free", "p.arm", "--free", "q.arm", "--format", "json")
    out = capfd.readouterr().out
    if code == 2:  # an arm below zero or above its bounds: no machine to begin with
        return
    answer = json.loads(out)
    if answer["conflict"] is None:
        assert code == 0 and _can_hold(rows, range(4), rows)
        return
    checks = [int(name[1]) for name in answer["conflict"]["checks"]]
    assert not _can_hold(rows, checks, rows)
    if answer["conflict"]["least"]:
        assert all(_can_hold(rows, fewer, rows) for fewer in combinations(checks, len(checks) - 1))


def _can_hold(rows: list[list[int]], checks: Any, every: list[list[int]]) -> bool:
    """Whether arms p and q above zero and up to 1 m exist with these moments below their limit and all arms within their bounds."""
    limits = [(row[1:], 250 - row[0]) for row in (rows[each] for each in checks)]
    limits += [([-part for part in row[1:]], row[0] - 1e-3) for row in every] + [
        (row[1:], 1000 - row[0]) for row in every
    ]
    found = linprog([0, 0], [row for row, _ in limits], [limit for _, limit in limits], bounds=[(1e-3, 1000)] * 2)
    return bool(found.status == 0)
