"""The worked example of the rubber damper, with the formulas of 002.

Loizyk V. V., Bryndas A. M., Shelonh N. M., Ternytskyi S. V. Analytical studies of drive mechanism parameters of flat cylinder
die-cutting press. Lviv Polytechnic National University (in Ukrainian). The paper prints no numbers for the damper; those of the
worked example follow from its eq. 18–23 by hand.
"""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.damper import MECHANISM
from tests.machines import inputs, number
from tests.validation.rows import Row

WORKED: dict[str, Any] = {
    "kinetic_energy": "150 J",
    "velocity": "0.5 m/s",
    "elastic_modulus": "8 MPa",
    "allowable_stress": "1.2 MPa",
    "ring_width": "50 mm",
    "pad_height": "30 mm",
    "damper_count": 2,
}


def damper(**changes: Any) -> Calculation:
    """The damper of the worked example with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, WORKED | changes))


def adopted(name: str, scale: float = 1.0) -> float:
    """A number of the damper at the length rounded up."""
    return number(damper(), name) * scale


def unrounded(name: str, scale: float = 1.0) -> float:
    """A number of the damper at the length that the formula gives."""
    return number(damper(adopted_length=f"{number(damper(), 'free_length')!r} m"), name) * scale


def row(quantity: str, printed: str, unit: str, ours: Any) -> Row:
    """A number of the worked example."""
    return Row("worked example", quantity, printed, unit, ours)


ROWS = (
    row("area S", "1.5e-3", "m²", lambda: adopted("area")),
    row("free length H", "555.56", "mm", lambda: adopted("free_length", 1e3)),
    row("strain ε at H", "0.15", "", lambda: unrounded("strain")),
    row("deflection h at H", "83.33", "mm", lambda: unrounded("deflection", 1e3)),
    row("force P at H", "1800", "N", lambda: unrounded("peak_force")),
    row("adopted length H_a", "560", "mm", lambda: adopted("adopted_length", 1e3)),
    row("stress σ at H_a", "1.19523", "MPa", lambda: adopted("stress", 1e-6)),
    row("strain ε at H_a", "0.149404", "", lambda: adopted("strain")),
    row("deflection h at H_a", "83.666", "mm", lambda: adopted("deflection", 1e3)),
    row("force P at H_a", "1792.84", "N", lambda: adopted("peak_force")),
)  # fmt: skip
