"""Numbers of tables in a whole config: in its report, in a study of it, and the diagram with its range."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.press import Press
from diecut_report.report.figures.labels import Across, Line, Note, PanelData
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows
from tests.configs import HEAD, loaded, saved
from tests.machine.geared import FACTORS

MECHANISM = "  a: {kind: geared, bearing: '6204', teeth: 17}\n"
AS_GIVEN = "  a: {kind: geared, bore_given: 30 mm, teeth: 17}\n"


@pytest.fixture
def plugins(tmp_path: Path) -> Discovery:
    folder = tmp_path / "plugins"
    folder.mkdir()
    (folder / "geared.py").write_text("from tests.machine.geared import MECHANISM\n", "utf-8")
    return Discovery([folder])


def test_the_report_prints_rows_sources_and_the_line_between(tmp_path: Path, plugins: Discovery) -> None:
    outcome = Press.read(saved(tmp_path, HEAD + MECHANISM), plugins).calculate().report(tmp_path / "out", ["html"])
    text = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert outcome.broken == ()
    assert text.count("From “Bearings” for 6204<") == 1  # of the bore and of the capacity together
    assert text.count("Bearings: List one; List two") == 1
    plain = re.sub("<[^>]*>", "", text).replace("\u00a0", " ")
    assert "Rows of the table: z1 = 15, Y1 = 0.29; z2 = 20, Y2 = 0.32." in plain
    assert plain.count("Factors of teeth: Book one; Book two") == 1


def test_the_report_says_what_is_as_given(tmp_path: Path, plugins: Discovery) -> None:
    Press.read(saved(tmp_path, HEAD + AS_GIVEN), plugins).calculate().report(tmp_path / "out", ["html"])
    text = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert "Bore: as given" in text and "From “Bearings”" not in text


def test_in_a_study_what_is_outside_of_a_table_is_marked_in_words(tmp_path: Path, plugins: Discovery) -> None:
    base = loaded(tmp_path, HEAD + MECHANISM, plugins)
    teeth = [12.0, 13.0, 31.0, 30.0]
    rows = calculate_rows(base, {find_input(base, "mechanisms.a.teeth"): np.array(teeth)}, 4)
    assert list(rows.status) == ["pass", "pass", "error", "pass"]
    assert "mechanisms.a.teeth: is z = 31, outside of the table “Factors of teeth”" in rows.errors[2]
    wanted = np.interp(teeth, *(column.values for column in FACTORS.columns))
    assert rows.columns["a.factor"][[0, 1, 3]] == pytest.approx(wanted[[0, 1, 3]])
    assert rows.slow == {}


def test_in_a_study_what_may_be_given_is_given_for_all(tmp_path: Path, plugins: Discovery) -> None:
    base = loaded(tmp_path, HEAD + AS_GIVEN, plugins)
    rows = calculate_rows(base, {find_input(base, "mechanisms.a.bore_given"): np.array([0.01, 0.02])}, 2)
    assert rows.columns["a.bore"] == pytest.approx([0.01, 0.02])


def diagram(
    limits: tuple[float | None, float | None] | None, heights: list[float], *, zero: bool = True
) -> tuple[float, float]:
    line = Line(np.arange(len(heights)), np.array(heights), "v")
    return PanelData(title="v", unit="1", across=Across("t", "t", "s", 0, 1), lines=[line], levels=[Note(0, heights[0], "")],
                 zero=zero, limits=limits).heights  # fmt: skip


def test_a_diagram_has_the_range_that_is_given_and_room_at_a_free_end() -> None:
    assert diagram((0, 2), [0.99, 1.01]) == (0, 2)
    low, high = diagram((0, None), [0.99, 1.01], zero=False)
    assert low == 0 and high == pytest.approx(1.01 * 1.08)
    low, high = diagram((None, None), [0.99, 1.01])
    assert (low, high) == pytest.approx((0.99 - 0.0016, 1.01 + 0.0016))  # tight, where zero would be shown without it
    assert diagram(None, [0.99, 1.01])[0] < 0
