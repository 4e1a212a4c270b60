"""Questions to a press: the answers of the commands, as quantities and presses."""

from __future__ import annotations

import json
from typing import Any

import pytest

import diecut_report as dr
from diecut_report.cli.main import main
from tests.configs import GOOD, HEAD, saved

TEXT = (
    HEAD
    + """\
  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 190 N*m}
  b: {kind: lever, force: 1 kN, arm: 200 mm}
"""
)


@pytest.fixture(scope="module")
def press() -> dr.LoadedPress:
    return dr.loads(TEXT, plugins=[GOOD])


def asked(command: str, tmp_path: Any, capfd: pytest.CaptureFixture[str], *more: str) -> Any:
    """What the command gives as JSON."""
    main([command, str(saved(tmp_path, TEXT)), *more, "--format", "json", "--plugins", str(GOOD), "--quiet"])
    return json.loads(capfd.readouterr().out)


def test_one_input_is_solved_for(press: dr.LoadedPress, tmp_path: Any, capfd: pytest.CaptureFixture[str]) -> None:
    solution = press.solve("a.arm", "a.moment = 150 N*m", high="0.12 m")
    assert solution.found and solution.values[0] == dr.QuantityValue(75, "mm") and str(solution.values[0]) == "75 mm"
    assert solution.press is not None and solution.press.calculate()["a"].moment.si == pytest.approx(150)
    assert solution.data == asked(
        "solve", tmp_path, capfd, "--vary", "a.arm", "--for", "a.moment = 150 N*m", "--to", "0.12 m"
    )
    assert "a.arm = 75 mm" in str(solution)


def test_what_is_out_of_reach_tells_the_nearest(press: dr.LoadedPress) -> None:
    solution = press.solve("a.arm", "a.moment >= 900 N*m", high="200 mm")
    assert not solution.found and solution.press is None and solution.nearest == dr.QuantityValue(200, "mm")


def test_a_press_that_fails_is_mended(press: dr.LoadedPress, tmp_path: Any, capfd: pytest.CaptureFixture[str]) -> None:
    mended = press.advise(free=["a.arm"])
    assert list(mended.changes) == ["a.arm"] and mended.press is not None and mended.press.calculate().status == "pass"
    assert mended.data == asked("advise", tmp_path, capfd, "--free", "a.arm")


def test_inputs_are_ranked_by_what_they_move(press: dr.LoadedPress) -> None:
    rows = press.influence("a.moment", share=0.2).bars()
    assert {row["path"] for row in rows} == {"mechanisms.a.force", "mechanisms.a.arm"}
    assert [sorted((row["low"], row["high"])) for row in rows] == [pytest.approx([160, 240])] * 2


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda p: p.solve("a.ar", "a.moment = 1 N*m"), "is not an input of a (did you mean 'arm'?)"),
        (lambda p: p.solve("a.arm", "a.moment = 1 kg"), "a.moment: 1 kg is a mass"),
        (lambda p: p.solve("a.grade", "a.moment = 1 N*m", low="1"), "is a text; name those that are to be tried"),
        (lambda p: p.solve("a.arm", "a.moment = 1 N*m", low="1 kg"), "low of a.arm: 1 kg is a mass"),
        (lambda p: p.influence("a.momen"), "did you mean 'moment'?"),
        (lambda p: p.influence(share=2), "share: 2 is not a share between 0 and 1"),
    ],
)  # fmt: skip
def test_a_question_that_cannot_be_asked_is_told_in_words(press: dr.LoadedPress, ask: Any, words: str) -> None:
    with pytest.raises(dr.ConfigError) as caught:
        ask(press)
    assert words in str(caught.value)
