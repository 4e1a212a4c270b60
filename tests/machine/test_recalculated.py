"""A machine calculated again with another input has the numbers of a whole calculation: what stays is what does not follow from it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from diecut_report.machine.calculation import Calculation, Impossible, Unproven
from diecut_report.machine.steps.needed import needed_again
from diecut_report.machine.steps.run import calculate, recalculated
from diecut_report.mechanism.inputs import Quantity
from tests.examples import few
from tests.machines import UNBALANCED, drive
from tests.plugins.bearings import BALL, ROLLER, bearings
from tests.plugins.gears import GRADED, pair
from tests.plugins.keys import TURNING, key
from tests.plugins.shafts import LAYSHAFT, shaft

MACHINES: dict[str, Callable[[], Calculation]] = {
    "gears": lambda: pair(GRADED),
    "key": lambda: key(TURNING),
    "drive": lambda: drive(**UNBALANCED, pinion_inertia=0.03, rocker_inertia=1.2, pinion_radius=0.07, n_points=72),
    "shaft": lambda: shaft(LAYSHAFT),
    "bearings": lambda: bearings(BALL, ROLLER, required_life=20000, service_factor=1.2),
    "one bearing": lambda: bearings(BALL, required_life=20000, service_factor=1.2),
}  # fmt: skip


@pytest.mark.parametrize("which", few(MACHINES, lambda which: which != "drive"))
def test_each_number_that_a_check_compares_is_that_of_the_whole_calculation(which: str) -> None:
    calc = MACHINES[which]()
    names = [name for check in calc.mechanism.checks for name in check.named if name in calc.values]
    tried = 0
    for name, value in calc.inputs.items():
        meta = calc.meta.get(name)
        if (
            not isinstance(meta, Quantity)
            or not isinstance(value, np.ndarray)
            or value.shape != (1, 1)
            or not value.any()
        ):
            continue
        changed = {name: np.array([value[0, 0] * 1.03])}
        again = recalculated(calc, changed, 1, names)
        inputs = {each: own[0, 0] if isinstance(own, np.ndarray) and own.shape == (1, 1) else own for each, own in calc.inputs.items()
                  if each in calc.given}  # fmt: skip
        try:
            whole = calculate(calc.mechanism, inputs | changed)
        except (Impossible, Unproven):
            assert again is None
            continue
        assert again is not None
        for quantity in names:
            assert again[quantity] == pytest.approx(whole[quantity], rel=1e-12, abs=1e-15, nan_ok=True), (
                name,
                quantity,
            )
        tried += 1
    assert tried


def test_what_does_not_follow_from_an_input_stays() -> None:
    calc = pair(GRADED)
    numbers = frozenset(name for name, value in calc.values.items() if value.shape == (1, 1) and value.dtype != object)
    only, stays = needed_again(calc.mechanism, calc.given, ("pitting_safety_1",), frozenset({"sigma_h_lim_1"}), numbers)
    assert {"contact_ratio", "working_pressure_angle", "mesh_stiffness", "dynamic_factor"} <= stays
    assert {"run_in_share_1", "face_load_factor", "pitting_safety_1"} <= only and not stays & {
        "face_load_factor",
        "pitting_safety_1",
    }
    assert "working_pressure_angle" not in only
