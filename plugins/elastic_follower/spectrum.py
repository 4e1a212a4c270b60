"""The spectrum: peaks of the driven link over the natural periods within the rise, for all laws of motion and five dampings."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np

from diecut_report.api import Spectrum, SpectrumLine
from diecut_report.mechanics.followers import Peaks, peaks
from diecut_report.mechanics.motion_laws import LAWS

FIRST, LAST = 0.5, 10.0  # natural periods within the rise
RATIOS = np.linspace(FIRST, LAST, 96)
DAMPINGS = (0.0, 0.02, 0.05, 0.1, 0.2)


@cache
def of_law(name: str) -> Peaks:
    """Peaks of a law over ``RATIOS``, a row for each of ``DAMPINGS``."""
    return peaks(LAWS[name], RATIOS, np.array(DAMPINGS)[:, None])


def lines() -> Sequence[SpectrumLine]:
    """The peak in the rise for each law and damping."""
    return [
        SpectrumLine(
            id=f"peak_ratio_{name}_damping_{round(100 * damping):02d}",
            symbol="q",
            description=f"Peak acceleration in the rise, to the rigid one: {law.title[0].lower()}{law.title[1:]}, ζ = {damping:g}",
            values=row,
            source="001, first paper",
        )
        for name, law in LAWS.items()
        for damping, row in zip(DAMPINGS, of_law(name).rise, strict=True)
    ]


SPECTRUM = Spectrum(
    id="tuning_ratio", symbol="λ", description="Natural periods within the rise", values=RATIOS, lines=lines
)
