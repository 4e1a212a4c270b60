"""The kinds of quantities in conditions and expressions, in words."""

from __future__ import annotations

from diecut_report.languages.phrases import phrase
from diecut_report.quantities.units import DIMENSIONS, Kind, Unit, kind_name, si_text, unit

NUMBER: Kind = (0.0,) * len(DIMENSIONS)
LENGTH, ANGLE = DIMENSIONS.index("length"), DIMENSIONS.index("angle")


def alike(one: Kind, other: Kind) -> bool:
    """Return whether two kinds may be equalled: they are the same, or differ by the angle alone beside a length."""
    return one == other or bool(one[LENGTH] and without_angle(one) == without_angle(other))


def without_angle(kind: Kind) -> Kind:
    """Return a kind without its power of the angle."""
    return (*kind[:ANGLE], 0.0, *kind[ANGLE + 1 :])


def told_kind(kind: Kind, own: str = "") -> str:
    """Return what a kind is, in words; the unit ``own`` names it best where it is of that kind."""
    if kind == NUMBER:
        return phrase("a pure number")
    named = unit(own) if own else None
    return phrase(kind_name(named if named and named.kind == kind else Unit("", 1.0, si_text(kind), kind)))
