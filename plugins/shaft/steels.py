"""Strengths of steel grades by the greatest diameter of the shaft."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.api import Case, Chapter, StandardTable, bind, case, standard_table
from diecut_report.plugins.shaft.formulas import MEGAPASCAL, MILLIMETRE

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


steel = Chapter("Steel", needs=("material",), text="The least strengths of the grade at the shaft's greatest diameter, of which it is made.")
steel.total("greatest_diameter", "d_max", "mm", "Greatest diameter of the shaft", "max", of="sections.diameter", source="geometry")
for grade, sizes in SIZES.items():
    token = (f"material={grade}",)
    steel.require("size_known", bind(lambda diameter, limit: diameter <= limit * MILLIMETRE, diameter="greatest_diameter", limit=float(sizes[-1])),
                  key="material", needs=token,
                  message=f"is {grade}, whose strengths are known up to {sizes[-1]} mm, but the shaft has {{greatest_diameter}}; give "
                          "tensile_strength and yield_strength in its place, or take another grade")
    for name, symbol, what in (("tensile", "S_ut", "Tensile strength"), ("yield", "S_y", "Yield strength")):
        steel.choice(f"{name}_strength", symbol, "MPa", f"{what} at the shaft's size", *_cases(standard_table(f"steel_{name}_strengths"), grade),
                     source="EN 10083", needs=token)
