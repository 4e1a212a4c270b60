"""Cross-sections of bars and beams, as expressions of their sizes or numbers of these: ``tube(m.diameter, m.bore).modulus``.

Bending counts about the axis y, along the width b, as by forces along the height h; ``_z`` is about the axis along the height (axes of EN
1993). Sources: Roark's Formulas for Stress and Strain, appendix A (areas, second moments, moduli) and chapter 10 (torsion; Bredt's
formulas for thin walls).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.formulas.expression import as_number, number, pi


@dataclass(frozen=True)
class CrossSection:
    """Hold a section's area, second moments and moduli about both axes, least second moment, and those of torsion."""

    area: Any
    second_moment: Any
    second_moment_z: Any
    second_moment_min: Any
    modulus: Any
    modulus_z: Any
    torsion_moment: Any
    torsion_modulus: Any

    @property
    def gyration_radius(self) -> Any:
        """Return the least radius of gyration, √(I_min/A), by which a strut buckles."""
        return np.sqrt(self.second_moment_min / self.area)


def round_bar(diameter: Any) -> CrossSection:
    """Return a full circle."""
    square, cube, fourth = (as_number(pi) * diameter**power for power in (2, 3, 4))
    return _of_circle(square / 4, fourth / 64, cube / 32, fourth / 32, cube / 16)


def tube(diameter: Any, bore: Any) -> CrossSection:
    """Return a circle with a round bore; a bore of zero is none."""
    fourth = as_number(pi) * (diameter**4 - bore**4)
    area = as_number(pi) * (diameter**2 - bore**2) / 4
    return _of_circle(area, fourth / 64, fourth / (32 * diameter), fourth / 32, fourth / (16 * diameter))


def _of_circle(area: Any, bending: Any, modulus: Any, torsion: Any, torsion_modulus: Any) -> CrossSection:
    return CrossSection(area, bending, bending, bending, modulus, modulus, torsion, torsion_modulus)


def rectangle(width: Any, height: Any) -> CrossSection:
    """Return a full rectangle; its torsion is within 0.5 % of the exact series."""
    long, short = np.maximum(width, height), np.minimum(width, height)
    ratio = short / long
    torsion = long * short**3 * (number(1) / 3 - 0.21 * ratio * (1 - ratio**4 / 12))
    stress = 3 * (1 + 0.6095 * ratio + 0.8865 * ratio**2 - 1.8023 * ratio**3 + 0.91 * ratio**4)
    return CrossSection(
        width * height, width * height**3 / 12, height * width**3 / 12, long * short**3 / 12, width * height**2 / 6, height * width**2 / 6,
        torsion, long * short**2 / stress,
    )  # fmt: skip


def box(width: Any, height: Any, wall: Any) -> CrossSection:
    """Return a rectangular hollow section with sharp corners; its torsion is that of a thin wall."""
    inner_width, inner_height = width - 2 * wall, height - 2 * wall
    about_y = (width * height**3 - inner_width * inner_height**3) / 12
    about_z = (height * width**3 - inner_height * inner_width**3) / 12
    enclosed = (width - wall) * (height - wall)
    return CrossSection(
        width * height - inner_width * inner_height, about_y, about_z, np.minimum(about_y, about_z), about_y / (height / 2), about_z / (width / 2),
        2 * wall * enclosed**2 / (width + height - 2 * wall), 2 * wall * enclosed,
    )  # fmt: skip
