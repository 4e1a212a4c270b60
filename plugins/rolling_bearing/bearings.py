"""The bearings with what loads them, made of what is given; their ratings as given, by their designation, or of the series."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Refusal, si, table_beside
from diecut_report.plugins.rolling_bearing import formulas as f
from diecut_report.plugins.rolling_bearing.duty import Duty, Nodes, Ratings, is_curve, of_one_cycle
from diecut_report.plugins.rolling_bearing.factors import RADIAL_FACTOR, STATIC_FACTORS

Array = NDArray[Any]
Known = Mapping[str, Any]

DEEP_GROOVE = "deep_groove"
EXPONENTS = {DEEP_GROOVE: 3.0, "ball": 3.0, "roller": 10 / 3}
STATIC_SAFETIES = {DEEP_GROOVE: 1.0, "ball": 1.0, "roller": 1.5}
KEYS = ("name", "type", "designation", "series", "bore_min", "dynamic_rating", "static_rating", "f0", "x", "y", "e", "x0", "y0", "radial_force",
        "axial_force", "speed", "relative_angle", "cycle_speed", "rolling_elements", "a_iso")  # fmt: skip
TAKEN = (*(f"bearings.{key}" for key in KEYS), "service_factor", "required_life", "required_static_safety", "reliability_factor")

CATALOGUE = table_beside(__file__, "ball_bearings.yaml")
SIZES = {
    column.name: dict(zip(CATALOGUE.names, (si(value, column.unit) for value in column.values), strict=True))
    for column in CATALOGUE.columns
}
USUAL_ELEMENTS = 8
MARGIN = 1e-6  # by which a bearing must hold that is chosen with fewer places of the cycle
OWN_RESULTS = ("system", "life")  # names with which results of a bearing would be called as those of all


@dataclass(frozen=True)
class Bearings:
    """Hold all bearings: what loads each, its ratings, and the designation that is taken, for each variant."""

    names: tuple[str, ...]
    types: tuple[str, ...]
    duties: tuple[Duty, ...]
    ratings: tuple[Ratings, ...]
    designations: tuple[tuple[str, ...], ...]
    cycle_speed: tuple[Array, ...]
    rolling: tuple[Array, ...]
    of_table: tuple[bool, ...]
    variants: int

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

    def elements(self, index: int) -> Array:
        """Return how many rolling elements there are."""
        return self.rolling[index]

    def is_of_table(self, index: int) -> bool:
        """Return whether the ratings are those of the table."""
        return self.of_table[index]

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


def bearings(given: Known) -> Bearings:
    """Return the bearings of what is given; Refusal where they are not sound."""
    names, types = given.get("bearings.name"), given.get("bearings.type")
    if not names:
        raise Refusal("bearings", "is empty; give at least one bearing")
    _of_names(names)
    variants = len(given["service_factor"])
    parts = [_Part(given, index, variants) for index in range(len(names))]
    duties = tuple(each.duty() for each in parts)
    for part, duty in zip(parts, duties, strict=True):
        part.judge(duty)
    found = [part.ratings(duty) for part, duty in zip(parts, duties, strict=True)]
    return Bearings(
        tuple(names), tuple(types or ()), duties, tuple(each for each, _ in found), tuple(each for _, each in found),
        tuple(each.number("cycle_speed", 0.0) for each in parts), tuple(each.number("rolling_elements", USUAL_ELEMENTS) for each in parts),
        tuple(each.raw("dynamic_rating") is None for each in parts), variants,
    )  # fmt: skip


def _of_names(names: tuple[str, ...]) -> None:
    for index, name in enumerate(names):
        key = f"bearings.{index}.name"
        if not name.isidentifier() or not name.isascii():
            raise Refusal(key, f"is “{name}”; results are called by it, so take letters, digits and underscores, a letter first")
        if name in names[:index]:
            raise Refusal(key, f"is {name}, as that of another bearing; give each its own name")
        if name in OWN_RESULTS:
            raise Refusal(key, f"is {name}, so that its results would be called as those of all bearings; take another name")


@dataclass(frozen=True)
class _Part:
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
            raise Refusal(self.key("relative_angle"), "is a number; refer to the curve of the angle over the cycle, or give speed in its place")
        curves = {key: value for key in ("radial_force", "axial_force", "speed", "relative_angle") if is_curve(value := self.raw(key))}
        other = of_one_cycle([(self.key(key), curve) for key, curve in curves.items()])
        if other:
            raise Refusal(other, "runs over another cycle than the other curves of this bearing; give all over one cycle, or one as a number")
        if not np.any(duty.first.radial) and not duty.has_axial:
            raise Refusal(self.key("radial_force"), "is 0 everywhere, and so is the axial force; give the force that the bearing bears")
        if duty.has_axial:
            self._factors_known()

    def _factors_known(self) -> None:
        """An axial force needs the factors by which it counts."""
        kind = self.text("type")
        if kind == DEEP_GROOVE:
            if self.raw("f0") is None and self.raw("dynamic_rating") is not None:
                raise Refusal(self.key("f0"), "is missing, but the bearing has an axial force; give f0 of the maker's catalogue (about 12 to 16)")
            return
        for keys in (("x", "y", "e"), ("x0", "y0")):
            if self.raw(keys[0]) is None:
                told = f"{', '.join(keys[:-1])} and {keys[-1]}"
                raise Refusal(self.key(keys[0]), f"is missing, but the bearing has an axial force; give {told} of the maker's catalogue, or let "
                              "another bearing take the axial force (cylindrical rollers take none)")  # fmt: skip

    # --- ratings ------------------------------------------------------------------------------------------------------------

    def ratings(self, duty: Duty) -> tuple[Ratings, tuple[str, ...]]:
        """Return the ratings and the designation for each variant."""
        designation = self.text("designation")
        if self.raw("dynamic_rating") is not None:
            return self._with(self.raw("dynamic_rating"), self.raw("static_rating"), self.raw("f0")), (designation or "–",) * self.variants
        if self.text("type") != DEEP_GROOVE:
            raise Refusal(self.key("dynamic_rating"), "is missing; give dynamic_rating and static_rating of the maker's catalogue: only deep groove "
                          "ball bearings stand in the table")  # fmt: skip
        if designation is not None:
            if designation not in CATALOGUE.names:
                series = f"{CATALOGUE.names[0]} to {CATALOGUE.names[-1]}, series 60, 62 and 63"
                raise Refusal(self.key("designation"), f"is {designation}, which is not in the table ({series}); give dynamic_rating and "
                              "static_rating of the maker's catalogue beside it")  # fmt: skip
            return self.of(designation), (designation,) * self.variants
        return self._sized(duty)

    def _with(self, dynamic: Array, static: Array, f0: Array | None) -> Ratings:
        ones, kind = np.ones((self.variants, 1)), self.text("type")
        by_table = kind == DEEP_GROOVE
        usual = STATIC_FACTORS if by_table else (1.0, 0.0)
        x0, y0 = (default * ones if self.raw(key) is None else self.raw(key) for key, default in zip(("x0", "y0"), usual, strict=True))
        x, y, e = (default * ones if by_table or self.raw(key) is None else self.raw(key)
                   for key, default in (("x", RADIAL_FACTOR if by_table else 1.0), ("y", 0.0), ("e", 0.0)))  # fmt: skip
        return Ratings(dynamic * ones, static * ones, 0 * ones if f0 is None else f0 * ones, x, y, e, x0, y0, by_table)

    def of(self, designation: str) -> Ratings:
        """Return the ratings of a bearing of the table."""
        dynamic, static, f0 = (np.full((self.variants, 1), SIZES[name][designation]) for name in ("C", "C0", "f0"))
        own = self.raw("f0")
        return self._with(dynamic, static, f0 if own is None else own)

    def candidates(self) -> Iterator[str]:
        """Yield the bearings of the series, the smallest first."""
        yield from (name for name in CATALOGUE.names if name.startswith(str(self.text("series"))))

    def _sized(self, duty: Duty) -> tuple[Ratings, tuple[str, ...]]:
        """The smallest bearing of the series that holds, for each variant."""
        names = list(self.candidates())
        static_forces = duty.greatest(self.of(names[0]).static_load)[:2]
        held = np.concatenate([self.holds(duty, name, static_forces) for name in names], axis=1)
        first, any_holds = np.argmax(held, axis=1), held.any(axis=1)
        if not any_holds.all():
            raise Refusal(self.key("series"), f"is {self.text('series')}, of which no bearing of the table (up to {names[-1]}) holds; take a heavier "
                          "series or more bearings, or give dynamic_rating and static_rating of a larger bearing")  # fmt: skip
        taken = tuple(names[index] for index in first)
        dynamic, static, f0 = (np.array([[SIZES[column][name]] for name in taken]) for column in ("C", "C0", "f0"))
        return self._with(dynamic, static, f0 if self.raw("f0") is None else self.raw("f0")), taken

    def holds(self, duty: Duty, name: str, static_forces: tuple[Array, Array]) -> Array:
        """Return whether a bearing of the table reaches life and static safety, (variants, 1)."""
        own = self.of(name)
        life, safety = self.life(duty, own), own.static / own.static_load(*static_forces)
        wanted = self.given.get("required_static_safety")
        required = STATIC_SAFETIES[DEEP_GROOVE] if wanted is None else wanted
        is_long = np.isnan(life) | (life >= self.given["required_life"] * (1 + MARGIN))
        fits = SIZES["d"][name] >= self.raw("bore_min") * (1 - MARGIN)
        found: Array = is_long & (safety >= required * (1 + MARGIN)) & fits
        return found

    def life(self, duty: Duty, own: Ratings) -> Array:
        """Return the modified life; NaN where the rings do not turn, or bear nothing."""
        exponent = EXPONENTS[str(self.text("type"))]
        mean = duty.equivalent(own, exponent, duty.first)
        speed = duty.mean_speed if duty.angle is None else self.number("cycle_speed", 0.0) * duty.travel / (2 * np.pi)
        turns = f.revolutions.function(own.dynamic, np.where(mean > 0, mean, np.nan), exponent)
        lasts = f.duration.function(turns, np.where(speed > 0, speed, np.nan))
        found: Array = np.asarray(f.modified.function(self.given["reliability_factor"], self.raw("a_iso"), lasts), dtype=float)
        return found
