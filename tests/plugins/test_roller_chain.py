"""Roller chains: numbers of the method, brute force over the loop and the cycle, the choice of a chain."""

from __future__ import annotations

from math import pi, sin
from typing import Any

import numpy as np
import pytest

from diecut_report.plugins.roller_chain import MECHANISM, formulas
from diecut_report.plugins.roller_chain.chains import CHAINS
from diecut_report.testing import check_mechanism
from tests.machines import number
from tests.plugins.chains import CUSTOM, DRIVE, GRIPPERS, RATED, UNEVEN, chain, without

GRAVITY = 9.80665


def test_the_declarations_hold() -> None:
    check_mechanism(MECHANISM)


@pytest.mark.parametrize(
    ("name", "expected"),
    [("sprocket_diameter_1", 0.1157389), ("velocity", 1.80975), ("useful_tension", 3456.054), ("centrifugal_tension", 3.7665),
     ("sag_tension", 42.2912), ("chordal_tension", 6.4866), ("tension_peak", 3508.5986), ("links_exact", 81.992126)],
)  # fmt: skip
def test_the_drive_of_the_method_has_its_numbers(name: str, expected: float) -> None:
    assert number(chain(), name) == pytest.approx(expected, rel=2e-6)


def test_the_bearing_areas_are_those_of_the_method() -> None:
    areas = [number(chain(chain=name), "bearing_area") * 1e6 for name in CHAINS.names]
    assert areas == pytest.approx([48.73, 66.29, 87.97, 209.65, 291.03, 547.16], abs=6e-3)


# --- the loop --------------------------------------------------------------------------------------------------------


def walked(center: float, pitch: float, teeth: tuple[int, int], steps: int = 200_001) -> float:
    """Links over two sprockets by brute force: angle by angle the straight run that touches both circles, then what is wrapped."""
    small, large = (pitch / sin(pi / count) / 2 for count in teeth)
    slopes = np.linspace(-pi / 2, pi / 2, steps)
    heights = small * np.cos(slopes) + center * np.sin(slopes)  # of the far circle's contact, seen across the run
    slope = float(np.interp(0, heights - large * np.cos(slopes) - (small - large) * (np.cos(slopes) - 1) + 0 * slopes, slopes))
    offset = large - small
    touching = float(slopes[np.argmin(abs(center * np.sin(slopes) - offset))])
    assert abs(touching) <= pi / 2 and np.isfinite(slope)
    run = np.hypot(center - offset * np.sin(touching), offset * np.cos(touching))
    return 2 * run / pitch + teeth[0] * (pi - 2 * touching) / (2 * pi) + teeth[1] * (pi + 2 * touching) / (2 * pi)
