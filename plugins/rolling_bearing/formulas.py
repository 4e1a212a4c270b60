"""Formulas of ISO 281 and ISO 76."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def equivalent_load(radial: Any, axial: Any, x: Any, y: Any, e: Any) -> Any:
    """Return the dynamic equivalent load, not below the radial force."""
    return np.where(axial <= e * radial, radial, np.maximum(x * radial + y * axial, radial))


@formula
def static_load(radial: Any, axial: Any, x0: Any, y0: Any) -> Any:
    """Return the static equivalent load."""
    return np.maximum(radial, x0 * radial + y0 * axial)


@formula
def relative_axial(f0: Any, axial: Any, static_rating: Any) -> Any:
    """Return by what the factors of deep groove ball bearings go."""
    return f0 * axial / static_rating


@formula
def held(relative: Any) -> Any:
    """Return the same, held at the ends of the table."""
    return np.clip(relative, 0.172, 6.89)


@formula
def revolutions(rating: Any, load: Any, exponent: Any) -> Any:
    """Return the basic rating life in revolutions."""
    return 1e6 * (rating / load) ** exponent


@formula
def duration(turns: Any, speed: Any) -> Any:
    """Return how long so many revolutions last."""
    return 2 * np.pi * turns / speed


@formula
def modified(reliability: Any, a_iso: Any, life: Any) -> Any:
    """Return the modified rating life."""
    return reliability * a_iso * life
