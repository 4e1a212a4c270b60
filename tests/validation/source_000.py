"""The numbers that 000 prints for the impression cylinder and its drive.

Topolnytskyi P. V., Shustykevych A. I., Kolomiiets A. B., Vatuliak Yu. V. Research of the drive parameters of the pressure
cylinder of a flat-bed type die-cutting machine. 2024. doi: 10.32403/1998-6912-2024-2-69-140-150.
"""

from __future__ import annotations

from functools import cache
from math import pi, sqrt

import numpy as np

from diecut_report.machine.calculation import Calculation
from tests.machines import LOSSLESS, cylinder, drive, number
from tests.validation.rows import Row

R, BORE = 0.105, 0.07


@cache
def published_cylinder() -> Calculation:
    """The cylinder as the paper's numbers have it (its bore is 70 mm, though 80 mm is stated)."""
    return cylinder()


@cache
def published_drive() -> Calculation:
    """The drive without losses at 100 rpm with the paper's mass, inertia and technological moment."""
    arm = number(drive(), "cutting_length")
    return drive(**LOSSLESS, rolling_coefficient=67.83 / (21000 * arm))


def sized(name: str, scale: float = 1.0) -> float:
    """A number of the cylinder."""
    return number(published_cylinder(), name) * scale


def driven(name: str, scale: float = 1.0) -> float:
    """A number of the drive with the board of 0.6 mm."""
    return number(drive(), name) * scale


def inertia_with_the_segment_added() -> float:
    """The paper's own figures of eq. 17, the segment's term added instead of subtracted."""
    return 189 * R**2 / 2 - 84.1 * BORE**2 / 2 + 25.1 * 0.074**2


def unsigned_braking_peak() -> float:
    """Eq. 20 and 21 as printed: the technological moment is added without the sign of the motion. N·m."""
    calc = published_drive()
    phi = np.linspace(0, 2 * pi, 100_001)[None, :]
    middle = calc.domains["crank_angle"].middle_of(phi)
    ratio, inertia = (calc.sample(n, phi, middle)[0] for n in ("rocker_speed_ratio", "inertia_moment"))
    return float(np.min(number(calc, "sector_ratio") * ratio * (inertia + 67.83)))


ROWS = (
    Row("eq. 15", "arc of the segment l (Huygens)", "0.189", "m", lambda: sized("arc_length_huygens")),
    Row("eq. 16", "chord of the segment c", "0.16", "m", lambda: sized("chord"),
        why="0.1649 m; rounded to two decimals, it spoils what follows from it: ρ"),
    Row("before eq. 17", "area of the segment A", "4.6e-3", "m²", lambda: sized("segment_area"),
        why="right, though the printed factors 0.5[0.105·0.189 − 0.16(0.105 − 0.04)] give 4.72·10⁻³ m²"),
    Row("after eq. 16", "mass of the segment m₁", "25.1", "kg", lambda: sized("segment_mass")),
    Row("after eq. 16", "mass of the bore m₂", "84.1", "kg", lambda: sized("bore_mass"),
        why="with the bore radius of 70 mm that the formula holds; the text states 80 mm"),
    Row("after eq. 17", "mass of the full cylinder m′", "189", "kg", lambda: sized("solid_mass")),
    Row("eq. 13", "mass of the cylinder m", "80.0", "kg", lambda: sized("mass"), "mistake",
        lambda: sized("solid_mass") - sized("segment_mass") - sized("bore_mass"),
        "bore and segment overlap (the bore breaks through the flat); the overlap of 0.953 kg was taken away twice"),
    Row("after eq. 17", "distance of the segment's centroid ρ", "0.074", "m", lambda: sized("centroid_distance"), "mistake",
        lambda: 0.16**3 / (12 * 4.6e-3), "follows from the chord of 0.16 m"),
    Row("after eq. 17", "moment of inertia I", "0.973", "kg·m²", lambda: sized("inertia"), "mistake", inertia_with_the_segment_added,
        "1.042 − 0.206 + 0.137: the segment's term was added, though eq. 17 subtracts it; with the printed figures eq. 17 gives 0.698"),
    Row("after eq. 18", "line force q", "30", "N/mm",
        lambda: (driven("cutting_force_per_length") + driven("ejection_force_per_length")) / 1e3),
    Row("after eq. 18", "force of cutting and ejection P_m", "21000", "N", lambda: driven("cutting_force")),
    Row("after eq. 19", "cutting length b", "10.8", "mm", lambda: driven("cutting_length", 1e3), "mistake", lambda: sqrt(116),
        "√(2·105·0.6 − 0.6²) = √125.64; the printed numbers follow from √116"),
    Row("after eq. 19", "rolling arm k", "3.23e-3", "m", lambda: driven("rolling_arm"), "mistake", lambda: 0.3e-3 * sqrt(116),
        "follows from b = √116 mm; 0.3·10.8 is 3.24"),
    Row("after eq. 19", "moment of the technological load M_m", "67.8", "N·m", lambda: driven("cutting_moment"), "mistake",
        lambda: 21000 * 3.23e-3, "follows from k"),
    Row("conclusions", "greatest torque of the drive", "3.4", "kN·m", lambda: abs(number(published_drive(), "crank_torque_peak")) / 1e3,
        "cannot be reproduced", lambda: abs(unsigned_braking_peak()) / 0.544 / 1e3,
        "the paper prints neither the efficiencies nor the ratio u and names the main shaft, not the crank; its unsigned eq. 20 gives "
        "1.85 kN·m without losses, and an efficiency of 0.544 by its own rule would make 3.4 kN·m of it"),
)  # fmt: skip
