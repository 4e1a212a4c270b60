"""The units that pint knows, read only where a unit is none of the everyday ones: it takes about half a second."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pint


@cache
def pint_registry() -> pint.UnitRegistry[Any]:
    """Pint's own definitions with the radian as a base unit, in exact fractions."""
    from fractions import Fraction

    import pint

    folder = Path(pint.__file__).parent
    constants = (folder / "constants_en.txt").read_text(encoding="utf-8")
    text = (folder / "default_en.txt").read_text(encoding="utf-8").replace("@import constants_en.txt", constants)
    return pint.UnitRegistry(text.replace("radian = []", "radian = [angle]").splitlines(), non_int_type=Fraction)
