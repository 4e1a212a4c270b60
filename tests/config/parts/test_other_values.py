"""Other values in a machine of parts: what is varied is what its parts do not depend on, and each variant is the file with that value."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import parse
from diecut_report.design.inputs import free_input, given_numbers, untied
from diecut_report.design.machines import varied
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.study.definition.base_inputs import UnknownPath, varied_input
from tests.config.parts.test_parts import FILE
from tests.examples import few

MADE_WITH = "is what parts of the machine are made with"
FOLLOWS = "follows from the parts of the machine"
TIED = [
    ("drive.crank_length", MADE_WITH), ("drive.frame_ratio", MADE_WITH), ("cross.roller_width", MADE_WITH), ("cross.roller_radius", MADE_WITH),
    ("cross.locking_radius", MADE_WITH), ("clutch.shoe_radius", MADE_WITH), ("timing.lines.0.turns_per_sheet", MADE_WITH),
    ("drive.pinion_radius", FOLLOWS), ("train.vbelt.count", FOLLOWS), ("shafts_main.sections.0.diameter", FOLLOWS), ("meshes_sector.module", FOLLOWS),
]  # fmt: skip


@cache
def press() -> Press:
    return Press.read(FILE.with_stem("flat_cylinder_corrected"), Discovery([]))


@pytest.mark.parametrize(("name", "why"), TIED, ids=[name for name, _ in TIED])
def test_what_follows_from_the_parts_or_they_from_it_is_not_varied(name: str, why: str) -> None:
    with pytest.raises(UnknownPath, match=why):
        varied_input(press().config, f"mechanisms.{name}")
    if name not in ("timing.lines.0.turns_per_sheet", "drive.pinion_radius"):  # a text, and one that refers
        with pytest.raises(UserError, match=why):
            free_input(press().config, name)


def test_a_place_in_a_list_is_the_same_with_a_leading_zero() -> None:
    text = FILE.with_stem("flat_cylinder_corrected").read_text("utf-8")
    text = text.replace(
        "of: cross.crank, at: 52", 'of: cross.crank, at: "${timing.lines.01.path_efficiency} / 0.95 * 52 mm"'
    )
    config = Press.read(parse(text, "a.yaml"), Discovery([])).config
    with pytest.raises(UnknownPath, match=MADE_WITH):
        varied_input(config, "mechanisms.timing.lines.1.path_efficiency")


@pytest.mark.nightly
def test_a_number_that_parts_are_made_with_makes_them_anew_where_it_is_typed() -> None:
    """The roller of the Geneva drive cuts its wheel: the inertia of the wheel's shaft is that of the changed file."""
    before, place = press(), ("mechanisms", "cross", "roller_radius", "value")
    after = before.with_values({place: "20 mm"})
    inertias = [varied(each.config, {}, 1).columns["shafts_geneva_body.inertia"][0] for each in (before, after)]
    assert inertias[1] > inertias[0] * 1.02
    with pytest.raises(UserError, match="wants the axes of crank and rocker 600 mm apart"):
        before.with_values({("mechanisms", "drive", "crank_length", "value"): "120 mm"})
    with pytest.raises(UserError, match=FOLLOWS):
        before.with_values({("mechanisms", "shafts_main", "sections", 0, "diameter"): "90 mm"})


@pytest.mark.parametrize("file", few([FILE.with_stem("flat_cylinder_corrected"), FILE.parents[1] / "flat_cylinder_press_mended.yaml"],
    keep=lambda file: "mended" in file.stem), ids=["parts", "blocks"])  # fmt: skip
def test_a_variant_is_the_file_with_its_value(file: Path) -> None:
    """The linkage moves the timing, and that the play of the Geneva wheel, which plain code asks of the cyclogram."""
    found = Press.read(file, Discovery([]))
    design = next(
        each for each in untied(found.config, given_numbers(found.config)) if each.name == "drive.coupler_ratio"
    )
    values = np.array([5.0, 5.1, 5.2])
    rows = varied(found.config, {design.asked: values}, 3)
    for row, value in enumerate(values):
        alone = varied(found.with_values({design.stands: str(value)}).config, {}, 1)
        assert alone.exists[0] and rows.exists[row]
        assert rows.columns.keys() == alone.columns.keys()
        for name, column in rows.columns.items():
            own, other = column[row], alone.columns[name][0]
            if own is None or isinstance(own, str):
                assert own == other, name
            elif name != "timing.clearance_angle":  # which is a place where a curve is flat; residuals are rounding
                assert own == pytest.approx(other, rel=1e-9, abs=1e-9, nan_ok=True), name
