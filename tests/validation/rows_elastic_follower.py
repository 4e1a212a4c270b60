"""The worked example of the driven link on an elastic drive: ratios of its peak accelerations to the rigid one.

First paper of Naukovi zapysky (Ukrainian Academy of Printing), 1999, no. 1 (in Ukrainian), of which only the last page is preserved.
That page prints a figure and no numbers; those of the worked example follow from the equation of motion by two computations.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from math import pi

from diecut_report.machine.calculation import Calculation
from tests.machines import number
from tests.plugins.followers import follower
from tests.validation.rows import Row

DAMPINGS = (0, 0.05, 0.2)
TABLE = {  # law and λ: during and after the rise, for each damping
    ("cycloidal", 1.5): (("2.8532", "2.4000"), ("2.4833", "1.7858"), ("1.8443", "0.8823")),
    ("cycloidal", 2.5): (("1.6249", "0.9524"), ("1.5317", "0.6409"), ("1.3460", "0.3618")),
    ("cycloidal", 5): (("1.0825", "0.0000"), ("1.0426", "0.1530"), ("1.0397", "0.1563")),
    ("harmonic", 5): (("2.0202", "2.0202"), ("1.8315", "1.2203"), ("1.5481", "1.0118")),
    ("polynomial_345", 2.5): (("1.7407", "1.2588"), ("1.6306", "0.8484"), ("1.4120", "0.4605")),
}


@cache
def link(law: str, ratio: float, damping: float) -> Calculation:
    """A shaft of 0.8 kg·m² that a rise of 0.2 s drives, as stiff as the ratio asks for."""
    stiffness = 0.8 * (2 * pi * ratio / 0.2) ** 2
    return follower(motion_law=law, stiffness=stiffness, damping_ratio=damping)


def ours(law: str, ratio: float, damping: float, name: str) -> float:
    """A ratio of the example."""
    return number(link(law, ratio, damping), name)


def rows() -> Iterator[Row]:
    """Each cell of the table, during the rise and after it."""
    for (law, ratio), cells in TABLE.items():
        for damping, cell in zip(DAMPINGS, cells, strict=True):
            for name, when, printed in zip(("peak_ratio", "residual_ratio"), ("in", "after"), cell, strict=True):
                quantity = f"peak {when} the rise, {law}, λ = {ratio}, ζ = {damping}"
                yield Row("worked example", quantity, printed, "1", partial(ours, law, ratio, damping, name))


ROWS = tuple(rows())
