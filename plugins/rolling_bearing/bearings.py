"""All bearings as they are given, with what loads them, the bearing that is taken, and their numbers and curves."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Curve, Phrase, Refusal, joined, told
from diecut_report.plugins.rolling_bearing import ratings
from diecut_report.plugins.rolling_bearing.catalogue import (
    CATALOGUES,
    DEEP_GROOVE,
    ROLLER,
    BearingTable,
    bore_of,
    outside_of,
    row_of,
    written,
)
from diecut_report.plugins.rolling_bearing.duty import Duty, Nodes, is_curve, of_one_cycle
from diecut_report.plugins.rolling_bearing.ratings import RADIAL_FACTOR, STATIC_FACTORS, Ratings

Array = NDArray[Any]
Known = Mapping[str, Any]

EXPONENTS = {DEEP_GROOVE: 3.0, "ball": 3.0, ROLLER: 10 / 3}
STATIC_SAFETIES = {DEEP_GROOVE: 1.0, "ball": 1.0, ROLLER: 1.5}
# rad, 2′ and 1′: the least of the makers, of needles
PERMITTED_TILTS = {DEEP_GROOVE: 0.58e-3, "ball": 0.58e-3, ROLLER: 0.29e-3}
CYLINDRICAL, CYLINDRICAL_TILT = re.compile(r"(N|NJ|NU)[0-9]"), 0.87e-3  # rad, 3′; with ribs on both rings (NUP) less
TYPE_TILTS = (
    (DEEP_GROOVE, "", 2.91e-3),  # 10′
    ("ball", "7", 0.58e-3),  # angular contact, 2′
    ("ball", "", 35e-3),  # self-aligning
    (ROLLER, "R?N[JU]?2[23]", 0.87e-3),  # 3′
    (ROLLER, "R?N[JU]?[0-9]", 1.16e-3),  # 4′
    (ROLLER, "R?NUP", 0.58e-3),
    (ROLLER, "R?NA|NK|NQ|HK|BK|K[0-9]", 0.29e-3),  # needles, 1′
    (ROLLER, "", 26e-3),  # spherical
)  # rad, by makers: the most that any bearing of a type and designation takes; of several the first that fits
ONE_SPEED = 1e-3  # relative difference of two speeds that are one
MARGIN = 1e-6  # by which a bearing must hold that is chosen with fewer places of the cycle


class ChosenBearing(NamedTuple):
    """Hold a bearing: its ratings, its designation for each variant, whether it holds where it was sized, and the table that it is of."""

    ratings: Ratings
    designations: tuple[str, ...]
    holds: Array
    catalogue: BearingTable | None = None


@dataclass(frozen=True)
class GivenBearing:
    """What is given of one bearing."""

    given: Known
    index: int
    variants: int

    def key(self, name: str) -> str:
        return f"bearings.{self.index}.{name}"

    def raw(self, name: str) -> Any:
        """What is given: a number of all variants, (variants, 1), a curve, a text or None."""
        known = self.given.get(f"bearings.{name}")
        if known is None:
            return None
        own = known[:, [self.index]] if isinstance(known, np.ndarray) else known[self.index]
        if own is None or isinstance(own, str) or is_curve(own):
            return own
        return np.broadcast_to(np.asarray(own, dtype=float).reshape(-1, 1), (self.variants, 1))

    def number(self, name: str, default: float) -> Array:
        found = self.raw(name)
        return np.full((self.variants, 1), default) if found is None else np.asarray(found)

    def text(self, name: str) -> str | None:
        found = self.raw(name)
        return found if isinstance(found, str) else None

    def duty(self) -> Duty:
        return Duty(self.raw("radial_force"), self.raw("axial_force"), self.raw("speed"), self.raw("relative_angle"),
                    self.given["service_factor"], self.variants)  # fmt: skip

    def judge(self, duty: Duty) -> None:
        """Refuse what does not fit together."""
        if duty.angle is not None and not is_curve(duty.angle):
            raise Refusal(
                self.key("relative_angle"),
                "is a number; refer to the curve of the angle over the cycle, or give speed in its place",
            )
        if duty.angle is not None:
            self._require_one_speed(duty.angle)
        curves = {
            key: value
            for key in ("radial_force", "axial_force", "speed", "relative_angle")
            if is_curve(value := self.raw(key))
        }
        other = of_one_cycle([(self.key(key), curve) for key, curve in curves.items()])
        if other:
            raise Refusal(
                other,
                "runs over another cycle than the other curves of this bearing; give all over one cycle, or one as a number",
            )

    def _require_one_speed(self, angle: Curve) -> None:
        """Refuse a cycle rate that is not the one with which the angle comes again."""
        own, rate = self.number("cycle_speed", 0.0), angle.rate
        if ((rate > 0) & (np.abs(own - rate) > ONE_SPEED * rate)).any():
            template = (
                "is not the {rate} with which the curve of relative_angle comes again; refer to the speed with which that "
                "curve is calculated"
            )
            raise Refusal(self.key("cycle_speed"), Phrase(template, rate=told(float(np.max(rate)), "rpm")))

    def knows_factors(self) -> bool:
        """Return whether it is known by which factors an axial force counts."""
        if self.text("type") == DEEP_GROOVE:
            return self.raw("f0") is not None or self.raw("dynamic_rating") is None
        return self.raw("x") is not None and self.raw("x0") is not None

    def permitted_tilt(self) -> Array:
        """Return the tilt that is permitted: as given, else the least of the bearings that it may be."""
        kind, name = str(self.text("type")), written(self.text("designation") or self.text("series") or "")
        cylindrical = kind == ROLLER and CYLINDRICAL.match(name)
        return self.number("permitted_tilt", CYLINDRICAL_TILT if cylindrical else PERMITTED_TILTS[kind])

    def type_tilt(self) -> Array:
        """Return the most that any bearing of its type takes."""
        kind, name = str(self.text("type")), written(self.text("designation") or self.text("series") or "")
        tilt = next(tilt for own, pattern, tilt in TYPE_TILTS if own == kind and re.match(pattern, name))
        return np.full((self.variants, 1), tilt)

    # --- ratings ------------------------------------------------------------------------------------------------------------

    def taken(self, duty: Duty) -> ChosenBearing:
        """Return the bearing that is taken."""
        designation = self.text("designation")
        known = np.ones((self.variants, 1))
        if self.raw("dynamic_rating") is not None:
            own = self._with(self.raw("dynamic_rating"), self.raw("static_rating"), self.raw("f0"))
            return ChosenBearing(own, (designation or "own",) * self.variants, known)
        catalogue = self.catalogue()
        if designation is not None:
            name = self._found(designation, catalogue)
            return ChosenBearing(self.of(name), (name,) * self.variants, known, catalogue)
        return self._sized(duty, catalogue)

    def catalogue(self) -> BearingTable:
        """Return the table of bearings of this kind; Refusal where there is none."""
        known = CATALOGUES.get(str(self.text("type")))
        if known is None:
            raise Refusal(self.key("dynamic_rating"), "is missing; give dynamic_rating and static_rating of the maker's catalogue: only deep groove "
                          "ball bearings and cylindrical roller bearings stand in the tables")  # fmt: skip
        return known

    def _found(self, designation: str, catalogue: BearingTable) -> str:
        """Return the designation as the table has it; Refusal where it is not in it."""
        name = written(designation)
        if name in catalogue.names:
            return name
        if name + catalogue.suffix in catalogue.names:
            raise Refusal(self.key("designation"), Phrase(
                "is {designation}; the table has the reinforced design {names}, which bears more. Write {names} if it is that one, else give "
                "dynamic_rating and static_rating of the maker's catalogue beside it",
                designation=designation, names=name + catalogue.suffix))  # fmt: skip
        series = Phrase(
            "{names} to {names_2}, series {series}", names=catalogue.names[0], names_2=catalogue.names[-1],
            series=", ".join(catalogue.series),
        )  # fmt: skip
        raise Refusal(
            self.key("designation"),
            Phrase(
                "is {designation}, which is not in the table ({series}); give dynamic_rating and static_rating "
                "of the maker's catalogue beside it",
                designation=designation,
                series=series,
            ),
        )

    def _with(self, dynamic: Array, static: Array, f0: Array | None) -> Ratings:
        ones, kind = np.ones((self.variants, 1)), self.text("type")
        by_table = kind == DEEP_GROOVE
        usual = STATIC_FACTORS if by_table else (1.0, 0.0)
        x0, y0 = (
            default * ones if self.raw(key) is None else self.raw(key)
            for key, default in zip(("x0", "y0"), usual, strict=True)
        )
        x, y, e = (default * ones if by_table or self.raw(key) is None else self.raw(key)
                   for key, default in (("x", RADIAL_FACTOR if by_table else 1.0), ("y", 0.0), ("e", 0.0)))  # fmt: skip
        return Ratings(dynamic * ones, static * ones, 0 * ones if f0 is None else f0 * ones, x, y, e, x0, y0, by_table)

    def of(self, designation: str) -> Ratings:
        """Return the ratings of a bearing of the table."""
        size = self.catalogue().size
        dynamic, static, f0 = (np.full((self.variants, 1), size(name, designation)) for name in ("C", "C0", "f0"))
        own = self.raw("f0")
        return self._with(dynamic, static, f0 if own is None else own)

    def candidates(self, catalogue: BearingTable) -> tuple[str, ...]:
        """Return the bearings of the series, the smallest first; Refusal of a series of another kind."""
        series = self.text("series") or catalogue.usual
        if series not in catalogue.series:
            raise Refusal(self.key("series"), Phrase(
                "is {series}, a series of another kind of bearing; bearings of this type are sought in {known}",
                series=series, known=", ".join(catalogue.series)))  # fmt: skip
        return catalogue.of_series(series)

    def _sized(self, duty: Duty, catalogue: BearingTable) -> ChosenBearing:
        """The smallest bearing of the series that holds, for each variant; the largest where none does."""
        names = self.candidates(catalogue)
        static_forces = duty.greatest(self.of(names[0]).static_load)
        held = np.concatenate([self.holds(duty, name, static_forces) for name in names], axis=1)
        enough = np.asarray(held.any(axis=1))
        taken = tuple(names[index] for index in np.where(enough, np.argmax(held, axis=1), len(names) - 1))
        dynamic, static, f0 = (
            np.array([[catalogue.size(column, name)] for name in taken]) for column in ("C", "C0", "f0")
        )
        own = self._with(dynamic, static, f0 if self.raw("f0") is None else self.raw("f0"))
        return ChosenBearing(own, taken, enough[:, None] * 1.0, catalogue)

    def holds(self, duty: Duty, name: str, static_forces: tuple[Array, Array]) -> Array:
        """Return whether a bearing of the table reaches life and static safety, (variants, 1)."""
        own = self.of(name)
        life, safety = self.life(duty, own), own.static / own.static_load(*static_forces)
        wanted = self.given.get("required_static_safety")
        required = STATIC_SAFETIES[str(self.text("type"))] if wanted is None else wanted
        is_long = np.isnan(life) | (life >= self.given["required_life"] * (1 + MARGIN))
        fits = self.catalogue().size("d", name) >= self.raw("bore_min") * (1 - MARGIN)
        return np.asarray(is_long & (safety >= required * (1 + MARGIN)) & fits)

    def life(self, duty: Duty, own: Ratings) -> Array:
        """Return the modified life; NaN where the rings do not turn, or bear nothing."""
        exponent = EXPONENTS[str(self.text("type"))]
        mean = duty.equivalent(own, exponent, duty.first)
        speed = duty.mean_speed if duty.angle is None else self.number("cycle_speed", 0.0) * duty.travel / (2 * np.pi)
        turns = ratings.revolutions.function(own.dynamic, np.where(mean > 0, mean, np.nan), exponent)
        lasts = ratings.duration.function(turns, np.where(speed > 0, speed, np.nan))
        found: Array = np.asarray(
            ratings.modified.function(self.given["reliability_factor"], self.raw("a_iso"), lasts), dtype=float
        )
        return found


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
