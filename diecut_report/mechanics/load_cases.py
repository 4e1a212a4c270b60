"""Load cases of a drive beside its run: what they are called, and which of them governs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.text.phrases import phrase

CASE_NAMES = {"engage": phrase("engagement of the clutch"), "start": phrase("start of the motor"), "stop": phrase("stop by the brake")}  # fmt: skip
"""What load cases are called, by their names in a configuration."""
RUN = phrase("run")
GREATEST = "that with the greatest torque"
"""How the governing load case is found."""


def called(index: int, names: Sequence[str] = ()) -> str:
    """Return what a load case is called, by its place among their names; 0 is the run."""
    return CASE_NAMES[names[index - 1].partition("_")[0]] if index else RUN  # numbered where there are several


def governing_case(run: NDArray[Any], names: Sequence[str] = (), torques: NDArray[Any] | None = None) -> list[str]:
    """Return of each machine the load case with the greatest torque (machines, cases); the run where none exceeds its (machines, 1)."""
    every = run if torques is None else np.concatenate([run, np.broadcast_to(torques, (len(run), len(names)))], axis=1)
    return [called(int(index), names) for index in np.argmax(every, axis=1)]
