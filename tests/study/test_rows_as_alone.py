"""Each row of a study is judged as its machine is alone: what stands at its default, what is open, what a basis is of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from diecut_report.config.loader import Config
from diecut_report.design.inputs import design_input
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import Rows, calculate_rows
from tests.configs import DISCOVERY, EXAMPLES, saved

PLATEN, KNIFE = (
    next(path for path in EXAMPLES if path.stem == stem) for stem in ("platen_press_zppt30", "circular_knife")
)


def rows(config: Config, path: str, *values: float) -> Rows:
    """A study of one number, SI."""
    return calculate_rows(config, {find_input(config, f"mechanisms.{path}"): np.array(values)}, len(values))


def require_as_alone(press: Press, path: str, *values: float) -> Rows:
    """Hold each row against the file with its value."""
    found, asked = rows(press.config, path, *values), design_input(press.config, path)
    for row, value in enumerate(values):
        try:
            alone = press.with_values({asked.stands: asked.typed(value)}).calculate().results
        except UserError:
            assert found.status[row] == "error"
            continue
        assert found.verdict[row] == alone.summary.verdict, (row, path)
        for name, mechanism in alone.mechanisms.items():
            for check in mechanism.checks:
                column = found.columns.get(f"{name}.checks.{check.id}.status")
                assert column is None or column[row] == check.status, (row, name, check.id)
    return found


@pytest.mark.parametrize(
    ("path", "values"),
    [
        ("crank.reliability", (0.90, 0.99)),
        ("wheel_key.load_distribution_factor", (1.2, 1.3)),
        ("wheel_key.load_distribution_factor", (1.3, 1.1, 1.2)),
    ],
)
def test_a_row_at_its_default_is_checked_whatever_stands_beside_it(path: str, values: tuple[float, ...]) -> None:
    require_as_alone(Press.read(PLATEN, DISCOVERY), path, *values)


def knife(folder: Path, friction: str) -> Press:
    """The circular knife, all but its friction on a drawing, with limits."""
    text = KNIFE.read_text("utf-8").replace("basis: assumed", "basis: drawing")
    head, _, rest = text.partition("    friction: ")
    limits = "".join(
        f'    {key}: {{value: {value}, basis: drawing, note: "drawing 12-345, strength of the knife holder"}}\n'
        for key, value in (("allowable_force", "100 N"), ("allowable_torque", "5 N*m"))
    )
    return Press.read(saved(folder, f"{head}    friction: {friction}\n{limits}{rest.partition(chr(10))[2]}"), DISCOVERY)


@pytest.mark.parametrize(
    ("friction", "verdicts"),
    [
        ("0.28", ["conditional", "conditional", "conditional"]),  # nothing says where it comes from; 0.3 is the default
        (
            '{value: 0.28, basis: measured, note: "protocol 17"}',
            ["pass", "conditional", "conditional"],
        ),  # one value was measured
        ("{value: 0.28, basis: drawing}", ["pass", "conditional", "pass"]),  # a drawing is the designer's own
    ],
)
def test_what_is_open_is_so_in_each_row(tmp_path: Path, friction: str, verdicts: list[str]) -> None:
    press = knife(tmp_path, friction)
    found = require_as_alone(press, "knife.friction", 0.28, 0.3, 0.27)
    assert found.verdict.tolist() == verdicts


def test_a_number_in_place_of_a_measured_one_is_assumed_in_the_file(tmp_path: Path) -> None:
    press = knife(tmp_path, '{value: 0.28, basis: measured, note: "protocol 17"}')
    asked = design_input(press.config, "knife.friction")
    after = press.with_values({asked.stands: "0.29"})
    assert '{value: 0.29, basis: assumed, note: "protocol 17"}' in after.config.tree.text
    assert press.with_values({asked.stands: "0.28"}).config.tree.text == press.config.tree.text
    drawn = knife(tmp_path, "{value: 0.28, basis: drawing}")
    assert "{value: 0.29, basis: drawing}" in drawn.with_values({asked.stands: "0.29"}).config.tree.text


# A torque of a load and the place of a notch, among other rows.

CRANKSHAFT = """\
schema_version: 1
project: {title: T}
press: {name: P, productivity: 6000 1/h, sheet: {length: 700 mm, width: 470 mm, thickness: 0.6 mm}}
mechanisms:
  crankshaft:
    kind: shaft
    sections: [{length: 100 mm, diameter: 50 mm}, {length: 300 mm, diameter: 55 mm}]
    bearing_a: 20 mm
    bearing_b: 380 mm
    loads:
      - {name: wheel, position: 130 mm, torque: 0 N*m, force_y: 1 kN}
      - {name: disc, position: 320 mm, torque: balance}
    notches: [{position: 240 mm, type: keyseat_end_mill}, {position: 305 mm, type: keyseat_end_mill}]
    tensile_strength: 900 MPa
    yield_strength: 650 MPa
    speed: 100 rpm
"""


def test_a_torque_in_one_row_is_none_in_another(tmp_path: Path) -> None:
    config = Press.read(saved(tmp_path, CRANKSHAFT), DISCOVERY).config
    found = rows(config, "crankshaft.loads.0.torque", 0.0, 500.0, 0.0)
    assert found.status.tolist()[0] != "error" and found.status.tolist()[2] != "error" and found.status[1] == "error"
    assert "the nearest keyseat or press fit is at 240 mm" in str(found.errors[1])


def test_the_place_of_one_of_two_notches_is_varied(tmp_path: Path) -> None:
    text = CRANKSHAFT.replace("position: 130 mm, torque: 0 N*m", "position: 230 mm, torque: 90 N*m")
    config = Press.read(saved(tmp_path, text), DISCOVERY).config
    found = rows(config, "crankshaft.notches.1.position", 0.305, 0.310, 0.385)
    assert [status == "error" for status in found.status] == [False, False, True]
