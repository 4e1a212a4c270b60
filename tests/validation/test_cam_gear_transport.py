"""What 003 tells of the cam-gear stepper beside its numbers."""

from __future__ import annotations

import pytest

from diecut_report.machine.calculation import Impossible
from tests.plugins.steppers import stepper


def test_the_sources_longest_dwell_leaves_no_return_with_its_sweeps() -> None:
    with pytest.raises(Impossible, match=r"= -0\.04"):
        stepper(dwell_angle="225 deg")
