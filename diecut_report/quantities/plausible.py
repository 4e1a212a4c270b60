"""Plausible sizes of quantities: wider than any machine that is built, and narrow enough to be calculated with.

Hard bounds tell what can exist at all; these tell what no machine has, such as a length of 1e-300 mm. They hold for the size, whatever
its sign, and for zero never: whether zero is allowed is the business of the hard bounds.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np

from diecut_report.quantities.units import Kind, UnitError, number_and_unit, parse_quantity, pretty, unit
from diecut_report.text.phrases import Phrase

SIZES: dict[str, tuple[str, str]] = {
    "1": ("1e-6", "1e6"),
    "m": ("1 um", "100 m"),
    "m**2": ("1e-3 mm**2", "10000 m**2"),
    "m**3": ("1e-3 mm**3", "1000 m**3"),
    "m**4": ("1e-3 mm**4", "10 m**4"),
    "1/m": ("1e-6 1/m", "1e6 1/m"),
    "kg": ("1 mg", "1000 t"),
    "kg/m**3": ("0.1 kg/m**3", "50000 kg/m**3"),
    "kg/m": ("1e-6 kg/m", "1e6 kg/m"),
    "kg/m**2": ("1e-4 kg/m**2", "1e5 kg/m**2"),
    "kg*m**2": ("1e-9 kg*m**2", "1e7 kg*m**2"),
    "kg*m": ("1e-9 kg*m", "1e6 kg*m"),
    "N": ("1 mN", "100 MN"),
    "N/m": ("0.001 N/m", "1e6 MN/m"),
    "N*m": ("1e-6 N*m", "1000 MN*m"),
    "Pa": ("1 Pa", "10000 GPa"),
    "N*m/rad": ("0.001 N*m/rad", "1e12 N*m/rad"),
    "N*m*s/rad": ("1e-9 N*m*s/rad", "1e9 N*m*s/rad"),
    "N*s/m": ("1e-9 N*s/m", "1e9 N*s/m"),
    "m/s": ("0.001 mm/s", "1000 m/s"),
    "m/s**2": ("0.001 mm/s**2", "1e7 m/s**2"),
    "m/s**3": ("1e-6 m/s**3", "1e10 m/s**3"),
    "rad": ("1e-5 deg", "36000 deg"),
    "rad/m": ("1e-6 deg/m", "1e5 deg/m"),
    "rad/s": ("1e-4 rpm", "1e6 rpm"),
    "rad/s**2": ("1e-6 rad/s**2", "1e9 rad/s**2"),
    "rad/s**3": ("1e-6 rad/s**3", "1e12 rad/s**3"),
    "s": ("1 us", "1e6 h"),
    "1/s": ("1e-3 1/h", "1e9 1/h"),
    "W": ("0.001 mW", "1000 MW"),
    "W/m**2": ("1e-3 W/m**2", "1e12 W/m**2"),
    "K": ("1 mK", "10000 K"),
    "J/(kg*K)": ("1 J/(kg*K)", "1e6 J/(kg*K)"),
    "W/(m*K)": ("1e-4 W/(m*K)", "1e5 W/(m*K)"),
    "W/(m**2*K)": ("1e-3 W/(m**2*K)", "1e7 W/(m**2*K)"),
    "m**2/s": ("1e-12 m**2/s", "1e3 m**2/s"),
    "Pa*s": ("1e-9 Pa*s", "1e9 Pa*s"),
}
ANY_OTHER = (1e-12, 1e12)  # in SI, of a kind that has no line above
NOTHING = 1e-3  # share of the least size below which a result is zero but for the rounding of its terms
ROUNDING = 1e-12  # share of an end by which converting units may move a number


@dataclass(frozen=True)
class Plausible:
    """The least and the greatest size, as texts with their unit, that a quantity other than zero may have."""

    least: str
    most: str

    def __post_init__(self) -> None:
        given: tuple[object, ...] = (self.least, self.most)  # by an author, who may have written numbers
        if not all(isinstance(text, str) for text in given):
            template = "{least} and {most} are not plausible sizes; give two texts, such as 1 mm and 10 m."
            raise UnitError(template, least=repr(self.least), most=repr(self.most))

    @cached_property
    def kind(self) -> Kind:
        """The kind of quantity that both ends are of; UnitError where they differ."""
        least, most = (unit(number_and_unit(text)[1] or "1").kind for text in (self.least, self.most))
        if least != most:
            raise UnitError("{least} and {most} are different kinds of quantity.", least=self.least, most=self.most)
        return least

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Both ends in SI; UnitError where the least is not above zero and below the greatest."""
        wanted = [number_and_unit(text)[1] or "1" for text in (self.least, self.most)]
        least, most = (parse_quantity(text, own) for text, own in zip((self.least, self.most), wanted, strict=True))
        if not 0 < least < most:
            template = "{least} to {most} is not a range of sizes; give two above zero, the lesser first."
            raise UnitError(template, least=self.least, most=self.most)
        return least, most

    def holds(self, values: Any, *, calculated: bool = False) -> Any:
        """Return which SI values (a number or an array) are zero or have a plausible size.

        What is ``calculated`` may be smaller than anybody would type it: a slack, a deflection.
        """
        least, most = self.ends
        least *= NOTHING if calculated else 1.0
        size = np.abs(values)
        return (size == 0) | ((size >= least * (1 - ROUNDING)) & (size <= most * (1 + ROUNDING)))

    @property
    def told(self) -> str:
        """The range in words: ``1 µm to 100 m``."""
        return Phrase("{told} to {told_2}", told=_size_text(self.least), told_2=_size_text(self.most))


def without_rounding(values: Any, unit_text: str) -> Any:
    """Return results (a number or an array, SI) with zero for those that are zero but for rounding.

    Terms of a common size, such as 1000 N·m, are known to a ten-millionth of the least plausible one; what is left of them
    where they balance is no size at all. Only results may be so: what is typed is meant.
    """
    return np.where(np.abs(values) < NOTHING * plausible(unit_text).ends[0], 0.0, values)[()]


def _size_text(text: str) -> str:
    number, own = number_and_unit(text)
    return f"{float(number):.7g} {pretty(own or '1')}".rstrip()


@cache
def plausible(unit_text: str) -> Plausible:
    """Return the plausible sizes of quantities in a unit, by its kind."""
    asked = unit(unit_text)
    found = _by_kind().get(asked.kind)
    return found or Plausible(*(f"{end:g} {asked.si}" for end in ANY_OTHER))


@cache
def _by_kind() -> dict[Kind, Plausible]:
    ranges = (Plausible(*ends) for ends in SIZES.values())
    return {each.kind: each for each in ranges}
