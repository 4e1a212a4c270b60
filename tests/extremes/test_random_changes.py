"""Some given numbers of an example are changed at random: a machine comes out or words why it cannot be, and nothing is left unproved."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.yaml import load
from diecut_report.errors import UserError
from diecut_report.results.warm_press import WarmPress, WarmRun
from tests.configs import DISCOVERY, EXAMPLES, PARTS
from tests.examples import few
from tests.extremes.random_machines import FILES, faults

FEW, ALL = 4, 2000  # machines of each example


@pytest.mark.parametrize(
    ("file", "count"),
    few(
        [(file, count) for file in FILES for count in (FEW, ALL)],
        lambda each: each[1] == FEW and each[0].stem not in (*PARTS, "flat_cylinder_press", "elastic_transport"),
    ),
    ids=lambda each: each.stem if isinstance(each, Path) else str(each),
)
def test_no_machine_is_left_unproved_and_no_check_vanishes(file: Path, count: int) -> None:
    found, made = faults(file, count, seed=count)
    assert made > 0 and not found, "\n".join(f"{each.told}\n    {each.changes}" for each in found)


def changed(example: str, *keys: str, to: str) -> WarmRun:
    """An example with a value typed in the place of another."""
    tree = load(next(file for file in EXAMPLES if file.stem == example))
    home = tree.data["mechanisms"]
    for key in keys[:-1]:
        home = home[int(key) if isinstance(home, list) else key]
    home[keys[-1]] = to
    return WarmPress(is_advised=False).calculate(load_config(tree, DISCOVERY))


def test_an_extreme_between_the_first_two_points_of_a_piece_is_found() -> None:
    """With this mass a torque is greatest just after a switch, half-way to the next point of its grid."""
    run = changed("flat_cylinder_press_mended", "drive", "cylinder_mass", to="130 kg")
    assert run.errors == {} and run.skipped == {} and run.checks["timing"]


@pytest.mark.parametrize(
    ("example", "shaft", "keys", "to"),
    [
        ("platen_press_zppt30", "crank", ("loads", "0", "position"), "30 mm"),
        ("platen_press_zppt30", "crank", ("bearing_a",), "155 mm"),
        ("flat_cylinder_press_mended", "rocker_pin", ("bearing_a",), "45 mm"),
    ],
)
def test_a_load_that_stands_on_a_bearing_leaves_a_shaft_proved(
    example: str, shaft: str, keys: tuple[str, ...], to: str
) -> None:
    """Its energy and the work of its loads are rounding, of which neither is a share of the other."""
    run = changed(example, shaft, *keys, to=to)
    assert run.errors == {} and run.skipped == {} and run.checks[shaft]


@pytest.mark.nightly
def test_a_linkage_that_folds_flat_is_refused_in_words() -> None:
    """70 mm and 120 mm are as long as 110 mm and 80 mm; rounding would let it turn."""
    with pytest.raises(UserError, match="gives no crank-rocker"):
        changed("folding_knife", "knife", "crank_rocker", "crank", to="70 mm")
