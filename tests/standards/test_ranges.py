"""The table of plausible values: every quantity key of every kind stands in it, each row in the unit of what it bounds."""

from __future__ import annotations

import subprocess
import sys
from collections import Counter
from collections.abc import Mapping

import pytest

from diecut_report.config.model import PRESS, PressBlock
from diecut_report.config.plugins import Discovery
from diecut_report.formulas.condition_parts import Name, read_expression
from diecut_report.mechanism.inputs import Quantity, fields
from diecut_report.quantities.units import unit
from diecut_report.standards.ranges import EVERY, range_of, range_table, ranges_of

DISCOVERY = Discovery()
KINDS = tuple(DISCOVERY.origins)


def quantities(kind: str) -> dict[str, Quantity]:
    model = PressBlock if kind == PRESS else DISCOVERY.mechanism(kind).inputs
    return {path: meta for path, meta in fields(model) if isinstance(meta, Quantity)}


def units_in(kind: str) -> Mapping[str, str]:
    """The units of all that an expression may name: keys, results, and keys of the press."""
    found = {f"{PRESS}.{path}": meta.unit for path, meta in quantities(PRESS).items()}
    if kind != PRESS:
        found |= {step.id: step.unit for _, step in DISCOVERY.mechanism(kind).steps}
    return found | {path: meta.unit for path, meta in quantities(kind).items()}


def kind_of(kind: str, of: str) -> object:
    units = units_in(kind)
    return read_expression(of, lambda name: Name(name, "number", unit(units[name[2:-1]]).si)).kind


ROWS = [(kind, path) for kind in (PRESS, *KINDS) for path in ranges_of(kind)]


@pytest.mark.parametrize("kind", [PRESS, *KINDS])
def test_every_quantity_key_has_a_row_or_a_reason_for_none_and_not_both(kind: str) -> None:
    without = {key for group in range_table().without for of in (EVERY, kind) for key in group.keys.get(of, ())}
    listed = Counter([*ranges_of(kind), *without])
    keys = quantities(kind).keys()
    own = set(ranges_of(kind)) | {key for key in without if key in keys or key != "n_points"}
    assert [key for key in keys if listed[key] != 1] == []
    assert own <= keys, "a row or reason of a key that the kind does not have"


@pytest.mark.parametrize(("kind", "path"), ROWS)
def test_a_row_is_in_a_unit_of_what_it_bounds_and_its_hard_range_holds_the_usual_one(kind: str, path: str) -> None:
    for row in ranges_of(kind)[path]:
        assert row.hard[0] <= row.usual[0] <= row.usual[1] <= row.hard[1]
        bounded = kind_of(kind, row.of) if row.of else quantities(kind)[path].parsed_unit.kind
        assert bounded == unit(row.unit).kind


@pytest.mark.parametrize(("kind", "path"), ROWS)
def test_a_default_lies_within_the_hard_range(kind: str, path: str) -> None:
    row, model = range_of(kind, path), PressBlock if kind == PRESS else DISCOVERY.mechanism(kind).inputs
    default = None if "." in path else model.model_fields[path].default
    if row and not row.of and isinstance(default, int | float):
        value = default * unit(quantities(kind)[path].unit).factor
        assert value == 0 or row.hard[0] <= value <= row.hard[1]


def test_all_units_are_everyday_ones_that_need_no_registry() -> None:
    code = (
        "import sys; from diecut_report.standards.ranges import range_table, ranges_of; "
        "[ranges_of(kind) for row in range_table().ranges for kind in row.keys]; print('pint' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"


def test_a_range_is_in_si_and_names_its_source() -> None:
    found = range_of("gear_pair", "sigma_h_lim_1")
    assert found is not None
    assert (found.usual, found.hard) == ((300e6, 1500e6), (200e6, 1650e6))
    assert (found.source, found.needs_basis) == ("ISO 6336-5", True)


def test_of_several_rows_the_one_of_the_key_itself_is_its_range() -> None:
    assert len(ranges_of("drive_train")["run_up_torque_ratio"]) == 2
    found = range_of("drive_train", "run_up_torque_ratio")
    assert found is not None and found.of == ""


def test_a_key_without_a_row_and_a_kind_of_somebody_else_have_no_range() -> None:
    assert range_of("gear_pair", "teeth_1") is None
    assert range_of("gripper_chain_of_somebody", "efficiency") is None
