"""What a report says of assumed values: how many they are, and those first that move a governing check."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import load
from diecut_report.results.model import ResultsRecord
from diecut_report.study.analysis.variant_config import _place
from tests.configs import GOOD, HEAD, LEVER, saved
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


def test_a_report_lists_the_open_values_with_the_check_that_changes(out: Path) -> None:
    results = ResultsRecord.model_validate_json((out / "press.json").read_bytes())
    found = {each.path: str(each.why) for each in results.summary.open if each.what == "assumed"}
    assert found.keys() <= set(results.summary.assumed) and "mechanisms.a.teeth" not in found  # nothing judges them
    assert set(found.values()) == {"together with other assumed and default values it changes the check a.moment"}
    page = (out / "press.html").read_text("utf-8")
    assert "Open values" in page and "it changes the check a.moment" in page
    # the table of inputs shows expression, basis and note
    assert "${press.sheet.width} / 4 assumed" in re.sub("<[^>]*>", "", page)
    assert 'assumed<span class="sub">from the layout</span>' in page


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
    asked = ["batch", str(study), "-o", str(tmp_path / "out"), "--plugins", str(GOOD), "--quiet", "--jobs", "1"]
    assert main(asked) == 0
    told = re.sub(r"<[^>]+>", "", (tmp_path / "out" / "summary.html").read_text("utf-8"))
    assert "2 of 2 variants pass all performed checks." in told  # the teeth are at their default
    assert ("1 value of the base is assumed." in told) == assumed
