"""A plugin that can only calculate one machine at a time works in a study, and the user is told that it is slow."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.variant_rows import Rows, calculate_rows
from tests.configs import HEAD, LEVER, PLUGINS, saved
from tests.study.studies import study, varied

FOLDER = PLUGINS / "scalar"
BASE = HEAD + "  alley: {kind: ladder}\n"
STUDY = varied("{from: 0.5 m, to: 1.9 m, count: 8}", path="mechanisms.alley.crossing")


def rows_of(known: Study) -> Rows:
    """All variants of a study."""
    given = known.sample.rows(0, known.sample.count).items()
    return calculate_rows(known.base, {known.inputs[path]: values for path, values in given}, known.sample.count)


def with_plugin(folder: Path, text: str, name: str) -> Discovery:
    """What knows a plugin of this text."""
    (folder / "plugins").mkdir()
    saved(folder / "plugins", text, name)
    return Discovery([folder / "plugins"])


def test_each_machine_is_calculated_and_the_kind_is_named(tmp_path: Path) -> None:
    known = study(tmp_path, STUDY, BASE, Discovery([FOLDER]))
    crossing = np.asarray(known.sample.rows(0, 8)["mechanisms.alley.crossing"])
    rows = rows_of(known)
    assert list(rows.slow) == ["ladder"]
    w, is_high = rows.columns["alley.width"], crossing > 12 / 7  # the ladders' feet would have to meet
    assert list(rows.status == "error") == list(is_high)
    inverse = 1 / np.sqrt(16 - w**2) + 1 / np.sqrt(9 - w**2)
    np.testing.assert_allclose(inverse[~is_high], 1 / crossing[~is_high], rtol=1e-9)
    assert list(rows.status[~is_high]) == ["pass" if width >= 2 else "fail" for width in w[~is_high]]


@pytest.mark.usefixtures("with_html_summary")
def test_the_command_and_its_summary_tell_it(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    study(tmp_path, STUDY, BASE, Discovery([FOLDER]))
    out, words = tmp_path / "out", "ladder does not support arrays and was calculated variant by variant, which is slow"
    assert main(["batch", str(tmp_path / "study.yaml"), "-o", str(out), "--plugins", str(FOLDER)]) == 1
    assert words in capfd.readouterr().err
    assert list(json.loads((out / "study.json").read_text())["slow"]) == ["ladder"]
    assert "ladder" in (out / "summary.html").read_text()


def test_machines_that_refer_to_a_calculated_text_are_calculated_one_by_one(tmp_path: Path) -> None:
    base = LEVER + "  b: {kind: lever, force: 1, remark: '${a.size}'}\n"
    rows = rows_of(study(tmp_path, varied("[14, 30]", path="mechanisms.a.teeth"), base))
    assert list(rows.errors) == [None, None]
    assert list(rows.columns["a.size"]) == ["small", "large"]


TEETH = HEAD + "  gears: {kind: gears, ratio: 1.2, most: 50}\n"


def test_a_machine_that_array_code_refuses_costs_no_other(tmp_path: Path) -> None:
    """The example of the reference: 17 to 30 teeth, so that a ratio of 9.9 has no wheel of at most 50 teeth."""
    example = Path(__file__).parents[2] / "docs" / "reference" / "examples" / "Computed.py"
    discovery = with_plugin(tmp_path, example.read_text("utf-8"), "gears.py")
    rows = rows_of(study(tmp_path, varied("[1.2, 2.0, 9.9]", path="mechanisms.gears.ratio"), TEETH, discovery))
    assert [str(each) for each in rows.status] == ["pass", "pass", "error"]
    assert "is too great for the wheels" in rows.errors[2] and list(rows.errors[:2]) == [None, None]
    assert list(rows.columns["gears.driven_teeth"][:2]) == [24, 34]
    assert "it refuses some of many" in rows.slow["gears"]


REACH = """\
import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, computed


class Speeds(Inputs):
    speed = Quantity("n", "1", "Speed", gt=0, default=1.0)


def share(speed):
    return speed / OVER


shares = Chapter("Shares")
shares.share = computed(share, ("speed",), "the speed by the greatest"), "s", "1", "Share"
MECHANISM = Mechanism(kind="reach", version="1.0", title="Reach", summary="A share.", inputs=Speeds, chapters=(shares,))
"""


@pytest.mark.parametrize("over", ["speed.max()", "speed.mean()", "np.maximum.accumulate(speed)"])
def test_a_function_that_reaches_over_the_variants_gives_each_its_own_number(tmp_path: Path, over: str) -> None:
    discovery = with_plugin(tmp_path, REACH.replace("OVER", over), "reach.py")
    text = varied("[1, 4, 2, 3]", path="mechanisms.a.speed")
    rows = rows_of(study(tmp_path, text, HEAD + "  a: {kind: reach}\n", discovery))
    assert list(rows.columns["a.share"]) == [1, 1, 1, 1]
    assert "other results than each alone" in rows.slow["reach"]
