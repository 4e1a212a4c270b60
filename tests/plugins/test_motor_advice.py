"""What a motor needs whose load drives it as much as it brakes it: the advice looks at the size of the torque, not at its sign."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from diecut_report.plugins.press_consistency.motor_advice import peak


@dataclass
class Pulse:
    """A torque of so many newton metres over a tenth of the period, none elsewhere."""

    size: float
    cycle: str = "turn"

    def values(self, share: Any, middle: Any, rows: Any) -> Any:
        return np.where(np.mod(middle, 1.0) < 0.1, self.size, 0.0) + 0.0 * share

    @property
    def breakpoints(self) -> Any:
        return np.array([[0.1]])

    joints = breakpoints


# one turn a period of 0.6 s, lag 0.1 s, flywheel, rated torque, ratio, efficiency, speeds (rad/s), what the motor may carry
NUMBERS = (1.0, 0.6, 0.1, 2.0, 30.0, 5.0, 0.95, 150.0, 157.0, 1.8)


@pytest.mark.parametrize("size", [800.0, 2000.0])
def test_a_torque_and_its_mirror_image_need_the_same_motor(size: float) -> None:
    driven, driving = str(peak(Pulse(size), *NUMBERS)), str(peak(Pulse(-size), *NUMBERS))
    assert driven == driving and "a flywheel of at least" in driven
