"""The numbers of parallel keys.

Faires V. M. Design of Machine Elements, problem 521(a): a shaft of 2 in, a square key of ½ in, 87.65 kip·in.
holooly.com, question 8.6 (stress analysis, chapter 8): a shaft of 50 mm, a square key of 12.5 mm, 37.5 mm long.
"""

from __future__ import annotations

from functools import cache

from diecut_report.machine.calculation import Calculation
from tests.machines import number
from tests.plugins.keys import key
from tests.validation.rows import Row

INCH, KIP = 0.0254, 4448.2216152605
STEEL = {"yield_shaft": 455, "yield_hub": 455, "form": "B", "application_factor": 1}


@cache
def faires() -> Calculation:
    """The key of the problem, an inch long."""
    half = f"{INCH / 4!r} m"
    return key(STEEL | {"shaft_diameter": f"{2 * INCH!r} m", "torque": 87.65 * KIP * INCH, "key_length": f"{INCH!r} m",
                        "width": f"{INCH / 2!r} m", "height": f"{INCH / 2!r} m", "depth_shaft": half, "depth_hub": half})  # fmt: skip


@cache
def question() -> Calculation:
    """The key of the question under a newton metre for each of its millimetres of shaft."""
    return key(
        STEEL
        | {
            "shaft_diameter": 50,
            "torque": 50,
            "key_length": 37.5,
            "width": 12.5,
            "height": 12.5,
            "depth_shaft": 6.25,
            "depth_hub": 6.5,
        }
    )


def length_for_shear() -> float:
    """Length in inches at which the shear stress is 39.6 ksi."""
    return number(faires(), "shear_stress") / (39.6e3 * KIP / 1e3 / INCH**2)


def torque_for_shear() -> float:
    """Torque in kN·m at which the shear stress is 200 MPa."""
    return 50 * 200e6 / number(question(), "shear_stress") / 1e3


ROWS = (
    Row("Faires, problem 521(a)", "length for shear at 39.6 ksi", "4.43", "in", length_for_shear),
    Row("question 8.6", "torque at a shear stress of 200 MPa", "2.344", "kN·m", torque_for_shear),
)
