"""Strengths of steel grades by the greatest diameter of the shaft."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Case, Chapter, Refusal, StandardTable, bind, case, standard_table
from diecut_report.plugins.shaft.formulas import MEGAPASCAL, MILLIMETRE

Array = NDArray[Any]
ROUNDING = 1e-9  # relative: a diameter at the end of a size belongs to it


def by_size(sizes: Array, values: Any, diameter: Array) -> Array:
    """Return the value of the least size (variants, sizes) that holds the diameter (variants, 1); of a thicker shaft the last."""
    if isinstance(values, tuple):
        raise Refusal(
            "strengths", "gives the fatigue strength of some diameters and not of others; give it for all, or for none"
        )
    index = np.minimum(np.sum(diameter > sizes * (1 + ROUNDING), axis=1, keepdims=True), sizes.shape[1] - 1)
    found: Array = np.take_along_axis(values, index, axis=1)
    return found


def ascends(sizes: Array) -> Array:
    """Return whether sizes (variants, sizes) ascend, (variants, 1)."""
    found: Array = np.all(np.diff(sizes, axis=1) > 0, axis=1, keepdims=True).astype(float)
    return found


# fmt: off

SIZES = {"42CrMo4+QT": (16, 40, 100, 160, 250), "C45E+QT": (16, 40, 100), "C45E+N": (16, 100, 250)}  # mm, each up to and with it


def _cases(table: StandardTable, grade: str) -> Iterator[Case]:
    """The strengths of a grade by its sizes; the last one for what is greater than the others."""
    *others, last = SIZES[grade]
    for size in others:
        yield case(bind(lambda strength: strength * MEGAPASCAL, strength=_strength(table, grade, size)), f"{grade} up to {size} mm",
                   bind(lambda diameter, limit: diameter <= limit * MILLIMETRE, diameter="greatest_diameter", limit=float(size)))
    yield case(bind(lambda strength: strength * MEGAPASCAL, strength=_strength(table, grade, last)), f"{grade} up to {last} mm")


def _strength(table: StandardTable, grade: str, size: float) -> float:
    return table.values[f"{grade} ≤ {size} mm"]  # MPa


steel = Chapter("Steel", needs=("material",), text="The minimum strengths of the grade at the maximum diameter of the shaft, from which it is made.")
steel.total("greatest_diameter", "d_max", "mm", "Maximum diameter of the shaft", "max", of="section_diameter", source="geometry")
for grade, sizes in SIZES.items():
    token = (f"material={grade}",)
    steel.require("size_known", bind(lambda diameter, limit: diameter <= limit * MILLIMETRE, diameter="greatest_diameter", limit=float(sizes[-1])),
        key="material", needs=token,
        message=f"is {grade}, whose strengths are known up to {sizes[-1]} mm, but the shaft has {{greatest_diameter}}; give tensile_strength and "
            "yield_strength in its place, or take another grade")
    for name, symbol, what in (("tensile", "S_ut", "Tensile strength"), ("yield", "S_y", "Yield strength")):
        steel.choice(f"{name}_strength", symbol, "MPa", f"{what} at the shaft's size", *_cases(standard_table(f"steel_{name}_strengths"), grade),
            source="EN 10083", needs=token)

own_steel = Chapter("Steel", needs=("strengths",), text="The given strengths, at the maximum diameter of the shaft, from which it is made.")
own_steel.total("greatest_diameter", "d_max", "mm", "Maximum diameter of the shaft", "max", of="section_diameter", source="geometry")
own_steel.total("greatest_size", "d_R,max", "mm", "Maximum diameter with known strengths", "max", of="strengths.diameter", source="input",
    output=False)
own_steel.computed("sizes_ascend", "k_R", "1", "Diameters of the strengths ascend (1) or not (0)", ascends, ("strengths.diameter",),
    "each is compared with the one before it", output=False)
own_steel.require("sizes_in_order", lambda sizes_ascend: sizes_ascend > 0, key="strengths",
    message="are not in the order of their diameters; begin with the minimum one, each diameter once")
own_steel.require("own_size_known", lambda greatest_diameter, greatest_size: greatest_diameter <= greatest_size * (1 + 1e-9), key="strengths",
    message="are known up to {greatest_size}, but the shaft has {greatest_diameter}; give the strengths of that size too, or take another steel")
BY_SIZE = "for the smallest diameter of the list that covers the shaft's maximum one"
for name, symbol, what in (("tensile", "S_ut", "Tensile strength"), ("yield", "S_y", "Yield strength")):
    own_steel.computed(f"{name}_strength", symbol, "MPa", f"{what} at the shaft's size", by_size,
        ("strengths.diameter", f"strengths.{name}_strength", "greatest_diameter"), BY_SIZE, source="input")
own_steel.computed("own_fatigue_strength", "σ_D,d", "MPa", "Fatigue strength at the shaft's size", by_size,
    ("strengths.diameter", "strengths.fatigue_strength", "greatest_diameter"), BY_SIZE, needs=("strengths.fatigue_strength",), source="input",
    output=False)
