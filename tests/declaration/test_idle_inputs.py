"""The author's test tells an input that nothing takes; whatever takes it, switches on it or draws it is a use."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.api import Drawing, Mechanism
from diecut_report.declaration.formula_checks import idle_inputs
from tests import used_inputs
from tests.used_inputs import PLOT, draw, many


def named(mechanism: Mechanism) -> list[str]:
    return [text.partition("input ")[2].partition(":")[0] for text in idle_inputs(mechanism)]


def test_an_input_that_nothing_takes_is_told_with_its_line() -> None:
    found = list(idle_inputs(many(PLOT)))
    assert named(many(PLOT)) == ["parts.depth", "idle"]
    lines = Path(used_inputs.__file__).read_text("utf-8").splitlines()
    line = next(number for number, text in enumerate(lines, 1) if text.strip().startswith("idle ="))
    assert found[1] == (
        f"used_inputs.py:{line}: input idle: nothing uses it, so it affects no result; use it in a step, or remove it"
    )


def test_what_a_figure_names_has_a_use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("diecut_report.declaration.formula_checks.own_files", lambda mechanism: [])
    assert named(many()) == ["drawn", "level", "parts.depth", "idle"]
    assert named(many(PLOT)) == ["drawn", "parts.depth", "idle"]


def test_what_only_a_drawings_code_names_has_a_use() -> None:
    assert "drawn" not in named(many(Drawing("d", "D", "D", build=draw)))
