"""All bearings with what loads them, and their numbers and curves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Phrase, Refusal, joined
from diecut_report.plugins.rolling_bearing.catalogue import CATALOGUES, bore_of, outside_of, row_of
from diecut_report.plugins.rolling_bearing.duty import Duty
from diecut_report.plugins.rolling_bearing.nodes import Nodes
from diecut_report.plugins.rolling_bearing.part import EXPONENTS, ChosenBearing, GivenBearing
from diecut_report.plugins.rolling_bearing.ratings import Ratings

Array = NDArray[Any]
Known = Mapping[str, Any]

KEYS = ("name", "type", "designation", "series", "bore_min", "dynamic_rating", "static_rating", "f0", "x", "y", "e", "x0", "y0", "radial_force",
        "axial_force", "speed", "relative_angle", "cycle_speed", "rolling_elements", "a_iso", "permitted_tilt")  # fmt: skip
TAKEN = (
    *(f"bearings.{key}" for key in KEYS),
    "service_factor",
    "required_life",
    "required_static_safety",
    "reliability_factor",
)

USUAL_ELEMENTS = 8


@dataclass(frozen=True)
class Bearings:
    """Hold all bearings: what loads each, and the bearing that is taken."""

    names: tuple[str, ...]
    types: tuple[str, ...]
    duties: tuple[Duty, ...]
    taken: tuple[ChosenBearing, ...]
    cycle_speed: tuple[Array, ...]
    elements: tuple[Array, ...]
    knows_factors: tuple[bool, ...]
    permitted_tilt: tuple[Array, ...]
    type_tilt: tuple[Array, ...]
    variants: int

    @property
    def ratings(self) -> tuple[Ratings, ...]:
        """Return the ratings of each bearing."""
        return tuple(each.ratings for each in self.taken)

    def designations(self) -> list[str]:
        """Return for each variant what bearings are taken, in words."""
        return [joined((f"{name} {each.designations[variant]}" for name, each in zip(self.names, self.taken, strict=True)), ", ")
                for variant in range(self.variants)]  # fmt: skip

    def bore(self, index: int) -> Array:
        """Return the bore of a bearing by its designation, m, (variants, 1); 0 where that tells none."""
        return np.array([[bore_of(each)] for each in self.taken[index].designations])

    def outside(self, index: int) -> Array:
        """Return the outside diameter of a bearing by its designation, m, (variants, 1); 0 where that tells none."""
        return np.array([[outside_of(each)] for each in self.taken[index].designations])

    def share_of_row(self, column: str, index: int) -> Array:
        """Return a rating that is given as a share of that of its row of the tables, (variants, 1); 1 where there is none."""
        taken, kind = self.taken[index], self.types[index]
        row = None if taken.catalogue else row_of(kind, taken.designations[0])
        rating = taken.ratings.dynamic if column == "C" else taken.ratings.static
        return rating / CATALOGUES[kind].size(column, row) if row else np.ones((self.variants, 1))

    def flag(self, of: Iterable[bool]) -> Array:
        """Return for each bearing and variant 1 where something holds of it, else 0."""
        return np.tile(np.array([float(each) for each in of]), (self.variants, 1))

    def row(self, function: Any) -> Array:
        """Return what a function gives for each bearing, by its index, (variants, bearings)."""
        found = [np.broadcast_to(function(index), (self.variants, 1)) for index in range(len(self.names))]
        return np.concatenate(found, axis=1).astype(float)

    def rating(self, name: str) -> Array:
        """Return a rating or factor of all bearings."""
        return self.row(lambda i: getattr(self.ratings[i], name))

    def is_swinging(self, index: int) -> bool:
        """Return whether the motion is given by an angle."""
        return self.duties[index].angle is not None

    # --- each bearing by its index, numbers (variants, 1) -----------------------------------------------------------------

    @cached_property
    def weighed(self) -> tuple[Nodes, ...]:
        """Return the places of the cycle of each bearing, for its ratings."""
        return tuple(duty.weighed(own) for duty, own in zip(self.duties, self.ratings, strict=True))

    def mean_load(self, index: int, exponent: float | None = None) -> Array:
        """Return the mean load by the life exponent, or by another one."""
        own = EXPONENTS[self.types[index]] if exponent is None else exponent
        return self.duties[index].equivalent(self.ratings[index], own, self.weighed[index])

    def peak(self, index: int, load: str) -> tuple[Array, Array]:
        """Return both forces where a load (the name of a function of the ratings) is greatest."""
        known = "static_load" if not self.duties[index].has_axial else load  # both are then the radial force
        if (index, known) not in self._peaks:
            self._peaks[index, known] = self.duties[index].greatest(
                getattr(self.ratings[index], known), self.weighed[index]
            )
        return self._peaks[index, known]

    @cached_property
    def _peaks(self) -> dict[tuple[int, str], tuple[Array, Array]]:
        return {}

    def turns(self, index: int) -> Array:
        """Return whether the rings turn against each other."""
        return (self.duties[index].travel > 0) * 1.0

    def greatest_speed(self, index: int) -> Array:
        """Return the greatest speed of the rings."""
        return self.duties[index].greatest_speed * self._by_share(index)

    def oscillates(self, index: int) -> Array:
        """Return whether the rings only swing."""
        return np.isfinite(self.duties[index].swing) * 1.0 if self.is_swinging(index) else np.zeros((self.variants, 1))

    def swing_width(self, index: int) -> Array:
        """Return the width of the swing, NaN where there is none."""
        return self.duties[index].swing if self.is_swinging(index) else np.full((self.variants, 1), np.nan)

    def _by_share(self, index: int) -> Array:
        """What makes a speed of what is gained by share of the cycle."""
        return self.cycle_speed[index] / (2 * np.pi) if self.is_swinging(index) else np.ones((self.variants, 1))

    # --- curves, at shares of the cycle (rows, places) ---------------------------------------------------------------------

    def load(self, index: int, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return the equivalent load of a bearing."""
        own = np.arange(self.variants) if rows is None else rows
        return self.ratings[index].of(own).equivalent(*self.duties[index].forces(share, middle, rows))

    def speed(self, index: int, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return the speed of the rings of a bearing."""
        own = np.arange(self.variants) if rows is None else rows
        return self.duties[index].motion(share, middle, rows) * self._by_share(index)[own]

    @property
    def joints(self) -> Array:
        """Return the cycle angles where a load or a motion jumps or has a corner."""
        return 2 * np.pi * np.concatenate([each.joints for each in self.duties], axis=1)


def shares(column: str, known: Bearings) -> Array:
    """Return a rating of all bearings as a share of that of their rows, (variants, bearings)."""
    return known.row(partial(known.share_of_row, column))


def bearings(given: Known) -> Bearings:
    """Return the bearings of what is given; Refusal where they are not sound."""
    names, types = given.get("bearings.name"), given.get("bearings.type")
    if not names:
        raise Refusal("bearings", "is empty; give at least one bearing")
    _of_names(names)
    variants = len(given["service_factor"])
    parts = [GivenBearing(given, index, variants) for index in range(len(names))]
    duties = tuple(each.duty() for each in parts)
    for part, duty in zip(parts, duties, strict=True):
        part.judge(duty)
    return Bearings(
        tuple(names), tuple(types or ()), duties, tuple(part.taken(duty) for part, duty in zip(parts, duties, strict=True)),
        tuple(each.number("cycle_speed", 0.0) for each in parts), tuple(each.number("rolling_elements", USUAL_ELEMENTS) for each in parts),
        tuple(each.knows_factors() for each in parts),
        tuple(each.permitted_tilt() for each in parts), tuple(each.type_tilt() for each in parts), variants,
    )  # fmt: skip


def _of_names(names: tuple[str, ...]) -> None:
    for index, name in enumerate(names):
        if not name.isidentifier() or not name.isascii():
            raise Refusal(
                f"bearings.{index}.name",
                Phrase(
                    "is “{name}”; results are called by it, so take letters, digits and underscores, a letter first",
                    name=name,
                ),
            )
