"""What would be enough: by how much the shaft must grow, for the messages of checks, found by calculating thicker shafts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Chapter, Phrase

Array = NDArray[Any]
GREATEST = 50.0  # times the given size
COARSE, FINE = 120, 40  # sizes that are tried at first, and between the last that is not enough and the first that is
DIGITS = 3  # behind the point, of the growth that is told
ROUNDING = 1e-9
LIMITS = {
    "fatigue": ("required_fatigue_safety", "fatigue_safety"),
    "yield": ("required_yield_safety", "yield_safety"),
    "slope": ("bearing_slope_max", "allowable_bearing_slope"),
    "deflection": ("deflection_max", "allowable_deflection"),
    "twist": ("twist_by_length", "allowable_twist"),
}
"""What growth settles: the lesser side and the greater one."""


@dataclass(frozen=True)
class Growth:
    """Hold the sizes of a shaft's sections, and what calculates it with others."""

    again: Any
    sizes: Mapping[str, Any]

    def told(self, limit: str) -> str:
        """Say by how much a single shaft must grow for a limit."""
        found = self.least(limit)
        if found is None:
            return Phrase(
                "no thicker shaft of this steel is enough, up to {greatest} times its size; take a stronger "
                "steel, or bearings nearer to the loads.",
                greatest=f"{GREATEST:g}",
            )
        return Phrase(
            "with all diameters, bores and fillet radii {found} times as great it is met.", found=f"{found:.{DIGITS}f}"
        )

    def least(self, limit: str) -> float | None:
        """Return the least growth that meets a limit; None where there is none."""
        coarse = np.geomspace(1, GREATEST, COARSE)
        first = self._first(limit, coarse)
        if first is None:
            return None
        fine = np.linspace(coarse[max(first - 1, 0)], coarse[first], FINE)
        rounded = np.ceil(fine * 10**DIGITS) / 10**DIGITS
        found = self._first(limit, rounded)
        return None if found is None else float(rounded[found])

    def _first(self, limit: str, scales: Array) -> int | None:
        """Return which of some growths is the first that meets a limit."""
        lesser, greater = LIMITS[limit]
        changed = {name: _scaled(given, scales) for name, given in self.sizes.items()}
        known = self.again(changed, np.zeros(len(scales), dtype=int), [lesser, greater])
        held = np.flatnonzero(known[lesser] <= known[greater] * (1 + ROUNDING))
        return int(held[0]) if len(held) else None


def _scaled(given: Any, scales: Array) -> Any:
    """The sizes of the first machine (a row, or a tuple of what parts have) times each of some scales."""
    if isinstance(given, np.ndarray):
        return given[:1] * scales[:, None]
    return tuple(None if each is None else np.ravel(each)[0] * scales for each in given)


def _growth(known: Mapping[str, Any]) -> Growth:
    sizes = {name: known[name] for name in ("sections.bore", "sections.fillet_radius") if name in known}
    return Growth(known["again"], {"sections.diameter": known["section_diameter"], **sizes})


# fmt: off

enough = Chapter("Sizes that would be enough")
enough.prepared("growth", _growth, ("section_diameter", "sections.bore", "sections.fillet_radius"), for_many=True, again=True)
for limit, needs in (("fatigue", ()), ("yield", ()), ("slope", ()), ("deflection", ("allowable_deflection",)), ("twist", ("allowable_twist",))):
    enough.words(f"{limit}_growth", lambda growth, limit=limit: growth.told(limit), ("growth",), needs=needs, output=False)
enough.total("notch_yield", "S_y,n", "MPa", "Yield strength that no notch passes", "max", of="notch_stress", source="Shigley 7-16", output=False)
enough.value("half_critical", "n_crit/2", "rpm", "Speed that is far enough from the critical one", lambda critical_speed: critical_speed / 2,
             source="Shigley 7-6", output=False)
enough.value("effective_diameter", "d_e", "mm", "Effective diameter there", lambda size_share, place_diameter: size_share * place_diameter,
             source="Shigley 6-24", output=False)
enough.total("greatest_effective", "d_e,max", "mm", "Greatest effective diameter", "max", of="effective_diameter", source="Shigley 6-24",
             output=False)
