"""Closed solutions of a driven link on an elastic, damped drive, for laws whose acceleration is one wave."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanics.motion_laws import MotionLaw


class Wave(NamedTuple):
    """A law whose acceleration is the real part of size·e^(iΩk) from end to end."""

    size: complex
    frequency: float


WAVES = {"cycloidal": Wave(-2j * np.pi, 2 * np.pi), "harmonic": Wave(np.pi**2 / 2 + 0j, np.pi)}


def response(wave: Wave, ratio: float, damping: float, k: Array) -> tuple[Array, Array]:
    """ẍ of the driven link and its time derivative: the steady swing, and the free one that starts both from rest."""
    omega, forced = 2 * np.pi * ratio, 1j * wave.frequency
    pole = omega * (-damping + 1j * np.sqrt(1 - damping**2))
    steady = -wave.size / (forced**2 + 2 * damping * omega * forced + omega**2)
    rest, speed = -steady.real, -(forced * steady).real
    free = rest + 1j * (pole.real * rest - speed) / pole.imag
    part = -(2 * damping * omega * forced + omega**2) * steady * np.exp(forced * k)
    total = (part + pole**2 * free * np.exp(pole * k)).real
    return total, (forced * part + pole**3 * free * np.exp(pole * k)).real


def after(law: MotionLaw, start: float, rate: float, ratio: float, damping: float, k: Array) -> Array:
    """ẍ of the free decay from its value and its time derivative before the end of the rise, where the input's ÿ drops to 0."""
    omega = 2 * np.pi * ratio
    damped = omega * np.sqrt(1 - damping**2)
    free = rate - 2 * damping * omega * float(law.acceleration(1.0))
    sine = (free + damping * omega * start) / damped
    return np.asarray(np.exp(-damping * omega * k) * (start * np.cos(damped * k) + sine * np.sin(damped * k)))


def undamped_cycloidal(ratio: float) -> tuple[float, float]:
    """Peaks of ẍ/A = λ²/(λ² − 1)·(sin 2πk − sin(2πλk)/λ), which stands still at k = n/(λ ± 1), and of what swings on."""
    if (
        ratio == 1
    ):  # the limit (sin 2πk − 2πk·cos 2πk)/2, which stands still at 1/2 (π/2) and 1 (−π), as does what swings on
        return np.pi, np.pi
    below, above = abs(ratio - 1), ratio + 1
    k = np.concatenate([np.arange(int(below) + 1) / below, np.arange(int(above) + 1) / above, [1.0]])
    factor = ratio**2 / abs(ratio**2 - 1)
    size = factor * np.abs(np.sin(2 * np.pi * k) - np.sin(2 * np.pi * ratio * k) / ratio)
    return float(size.max(where=k <= 1, initial=0)), float(2 * factor / ratio * abs(np.sin(np.pi * ratio)))
