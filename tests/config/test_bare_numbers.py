"""Bare numbers that are absurd in their key's unit and usual in another one are asked about; with its unit a number is taken as it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from tests.configs import DISCOVERY, EXAMPLES, MECHANISMS, loaded, problems

TEXT = MECHANISMS.read_text("utf-8")
CRANK, SPAN, BELT = (
    "{value: 100 mm, basis: assumed}",
    "{value: 600 mm, basis: assumed}",
    "{value: 3.5 kW, basis: assumed",
)


@pytest.mark.parametrize(
    ("typed", "instead", "question"),
    [
        (CRANK, "0.16", "crank_length: is 0.16 without a unit, which is 0.16 mm here; 0.16 m is usual. Write the one that is meant"),
        (CRANK, "'0,16'", "crank_length: is 0.16 without a unit, which is 0.16 mm here; 0.16 m is usual"),
        (CRANK, "{value: 0.16, basis: drawing}", "crank_length.value: is 0.16 without a unit"),
        ("segment_height: 40 mm", "segment_height: 0.04", "segment_height: is 0.04 without a unit, which is 0.04 mm here; 0.04 m is usual"),
        (SPAN, "0.6", "train.vbelt.center_distance: is 0.6 without a unit, which is 0.6 mm here; 0.6 m is usual"),
        (BELT, "{value: 3500, basis: assumed", "power_per_belt.value: is 3500 without a unit, which is 3500 kW here; 3500 W is usual"),
        ("{value: 210 GPa, basis: assumed", "{value: 210000, basis: assumed",
         "is 210000 without a unit, which is 210000 GPa here; 210000 MPa is usual"),
    ],
)  # fmt: skip
def test_a_bare_number_of_another_unit_is_asked_about(typed: str, instead: str, question: str, tmp_path: Path) -> None:
    (told,) = problems(tmp_path, TEXT.replace(typed, instead, 1))
    assert question in told


@pytest.mark.parametrize("instead", ["0.16 mm", "16", "1000", "${cylinder.radius} / 600"])
def test_a_number_with_its_unit_or_near_what_is_usual_is_not(instead: str, tmp_path: Path) -> None:
    loaded(tmp_path, TEXT.replace(CRANK, instead, 1), Discovery())


def test_a_question_hides_no_other_fault_of_the_file(tmp_path: Path) -> None:
    told = problems(tmp_path, TEXT.replace(CRANK, "0.16", 1).replace("bore_radius: 70 mm", "bore_radius: 70 kg", 1))
    assert len(told) == 2 and "is a mass" in told[0] and "0.16 m is usual" in told[1]


def test_a_kind_without_example_and_default_is_not_asked(tmp_path: Path) -> None:
    loaded(tmp_path, TEXT.partition("mechanisms:")[0] + "mechanisms:\n  a: {kind: lever, force: 0.0001}\n", DISCOVERY)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_no_example_is_asked(example: Path) -> None:
    load_config(example, Discovery())
