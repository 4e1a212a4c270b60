"""What a report says of assumed values: how many they are, and those first that move a governing check."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import load
from diecut_report.results.model import ResultsRecord, SummaryRecord
from diecut_report.results.origins import Assumed, ordered
from diecut_report.study.analysis.variant_config import _place
from tests.configs import GOOD, HEAD, LEVER, saved
from tests.records import filled
from tests.study.studies import varied

# the moment is force times arm, 200 N·m of 250 N·m allowed; nothing judges the width
TEXT = HEAD.replace("thickness: 0.6 mm", "width: {value: 400 mm, basis: assumed}") + (
    "  a: {kind: lever, width: {value: 20 mm, basis: assumed}, teeth: {value: 30, basis: assumed}, "
    "force: {value: 2 kN, basis: assumed, note: from the layout}, arm: '${press.sheet.width} / 4', "
    "allowable_moment: {value: 250 N*m, basis: assumed}}\n"
)


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the report of the lever above."""
    folder = tmp_path_factory.mktemp("assumed")
    config = saved(folder, TEXT)
    arguments = ["report", str(config), "-o", str(folder), "--format", "html,json", "--quiet", "--plugins", str(GOOD)]
    assert main(arguments) == 0
    return folder


def test_those_that_move_a_governing_check_come_first(out: Path) -> None:
    results = ResultsRecord.model_validate_json((out / "press.json").read_bytes())
    found = ordered(results.summary)
    assert [each.path for each in found] == [
        "mechanisms.a.allowable_moment",  # 0.8 / 0.9 - 0.8 = 0.0889
        "press.sheet.width",  # 0.8 · 0.1, through the expression
        "mechanisms.a.force",
        "mechanisms.a.width",  # moves nothing
        "mechanisms.a.teeth",
    ]
    assert [each.change for each in found] == pytest.approx([0.8 / 0.9 - 0.8, 0.08, 0.08, 0, 0], rel=1e-5)
    assert {each.check for each in found[:3]} == {"a.moment"}


def test_page_1_tells_how_many_they_are_and_which_move_a_check(out: Path) -> None:
    page = (out / "press.html").read_text("utf-8")
    line = page[page.index("5 inputs are assumed; the most influential first") :][:400]
    paths = ", ".join(
        f'<span class="key">{path}</span>'
        for path in ("mechanisms.a.allowable_moment", "press.sheet.width", "mechanisms.a.force")
    )
    assert f"{paths} (each affects “Moment”) and 2 more." in line


def test_the_input_table_shows_expression_basis_and_note(out: Path) -> None:
    page = (out / "press.html").read_text("utf-8")
    assert "${press.sheet.width} / 4 assumed" in re.sub("<[^>]*>", "", page)
    assert 'assumed<span class="sub">from the layout</span>' in page


def test_results_without_weights_keep_the_order_of_the_file() -> None:
    assert ordered(filled(SummaryRecord, {"assumed": ["b", "a"]})) == [Assumed("b"), Assumed("a")]
    assert ordered(filled(SummaryRecord, {})) == []


def test_a_variants_value_stands_in_the_block_of_its_quantity(tmp_path: Path) -> None:
    tree = load(saved(tmp_path, TEXT))
    discovery = Discovery([GOOD])
    assert _place(tree, "mechanisms.a.force", discovery) == ("mechanisms", "a", "force", "value")
    assert _place(tree, "mechanisms.a.arm", discovery) == ("mechanisms", "a", "arm")
    assert _place(tree, "mechanisms.a.parts.0.length", discovery) == ("mechanisms", "a", "parts", 0, "length")


@pytest.mark.usefixtures("with_html_summary")
@pytest.mark.parametrize("assumed", [True, False])
def test_a_study_of_a_base_with_assumed_values_passes_no_more_than_it_checks(tmp_path: Path, assumed: bool) -> None:
    force = "{value: 2 kN, basis: assumed}" if assumed else "2 kN"
    saved(tmp_path, LEVER.replace("2 kN", f"{force}, allowable_moment: 9 kN*m"))
    study = saved(tmp_path, varied("[100 mm, 110 mm]", path="mechanisms.a.arm"), "study.yaml")
    assert (
        main(["batch", str(study), "-o", str(tmp_path / "out"), "--plugins", str(GOOD), "--quiet", "--jobs", "1"]) == 0
    )
    told = re.sub(r"<[^>]+>", "", (tmp_path / "out" / "summary.html").read_text("utf-8"))
    assert ("2 of 2 variants pass all checks." in told) != assumed
    assert ("2 of 2 variants pass all performed checks." in told) == assumed
    assert ("1 value of the base is assumed." in told) == assumed
