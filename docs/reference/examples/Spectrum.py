"""Curves over a range of their own, the same for every machine: the magnification of a damped oscillator."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, Spectrum, SpectrumLine, m

RATIOS = np.linspace(0.1, 3, 30)


def lines() -> list[SpectrumLine]:
    """A line for each damping."""
    return [
        SpectrumLine(
            id=f"magnification_{round(100 * damping):02d}", symbol="V", description=f"Magnification, damping {damping:g}",
            values=1 / np.sqrt((1 - RATIOS**2) ** 2 + (2 * damping * RATIOS) ** 2),
        )
        for damping in (0.1, 0.3)
    ]  # fmt: skip


class Mount(Inputs):
    ratio = Quantity("η", "1", "Frequency to natural frequency", gt=0)


own = Chapter("Mount")
own.distance = abs(m.ratio - 1), "Δη", "1", "Distance from resonance"

MECHANISM = Mechanism(
    kind="mount", version="1.0", title="Mount", summary="A mount near resonance.", inputs=Mount, chapters=(own,),
    spectra=(Spectrum(id="frequency_ratio", symbol="η", description="Frequency ratio", values=RATIOS, lines=lines),),
)  # fmt: skip

PRESS = """
mechanisms:
  mount: {kind: mount, ratio: 1.4}
"""
GIVES = {"mount.distance": "0.4"}
