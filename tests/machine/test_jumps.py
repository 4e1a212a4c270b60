"""Curves that are said not to jump, at the very ends of their pieces and a rounding inside: every mechanism of the examples."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.numerics.conditions import conditions_of
from diecut_report.machine.numerics.samples import JUMP
from tests.configs import ON_ARRAYS
from tests.machine.test_compiled import EXAMPLES_AT_HAND, axes, machines, stem


def jumps(calc: Calculation, axis: str) -> frozenset[str]:
    known = tuple(calc.curves.items())
    return frozenset(
        name for name in calc.curves if calc.axis[name] == axis and conditions_of(known, axis, name).may_jump
    )


@pytest.mark.parametrize("path", EXAMPLES_AT_HAND, ids=stem)
def test_what_does_not_jump_is_the_same_at_the_end_and_just_inside(path: Any) -> None:
    for calc in machines(load_config(path, Discovery([])), {}, 5).values():
        for axis, curves in axes(calc):
            pieces = calc.table(axis).pieces()
            row = np.array([i for i, variant in enumerate(pieces.variant) if variant not in calc.flaws])
            ends = np.stack([pieces.left[row], pieces.right[row]], axis=1)
            places = np.concatenate([pieces.inside(ends, row), pieces.grid(row)], axis=1)
            with np.errstate(all="ignore"):
                known = calc.sampler_of(axis, places, pieces.middle[row][:, None], pieces.variant[row])
                for name in set(curves) - jumps(calc, axis):
                    values = np.broadcast_to(known[name], places.shape).astype(float)
                    apart = np.abs(values[:, :2] - values[:, [2, -1]])
                    assert (apart <= JUMP * np.abs(values).max()).all(), name


def test_the_drive_jumps_only_where_the_direction_of_power_decides() -> None:
    base = load_config(next(path for path in ON_ARRAYS if path.stem == "flat_cylinder_mechanisms"), Discovery([]))
    calc = machines(base, {}, 6)["drive"]
    assert jumps(calc, "crank_angle") == {
        "rocker_torque", "crank_torque", "coupler_force", "rocker_bearing_force", "crank_bearing_force_x", "crank_bearing_force_y",
    }  # fmt: skip
