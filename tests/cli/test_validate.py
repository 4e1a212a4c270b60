"""The command validate: studies too, and what else only a calculation finds, with all faults of a file at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.configs import GOOD, HEAD, LEVER, YAML, saved
from tests.study.studies import BASE, STUDY

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
