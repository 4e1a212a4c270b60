"""The diameters of sections: as given, or the least preferred ones with which the shaft holds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    ROUNDING,
    Chapter,
    ListedColumn,
    Phrase,
    Refusal,
    computed,
    joined,
    m,
    phrase,
    si,
    standard_series,
)
from diecut_report.plugins.shaft.body import columns

Array = NDArray[Any]
THICKEST = 250.0  # mm, of the series: the size factor is known up to 254 mm
PREFERRED = standard_series("renard_r40_lengths")
SERIES = np.array([si(value, PREFERRED.unit) for value in PREFERRED.values if value <= THICKEST])
ROUNDS = 6  # through all sections, until none gets thinner: of the first one all sizes, then so many below the own one
WINDOW = 8
HELD = (
    ("required_fatigue_safety", "fatigue_safety", "fatigue"),
    ("required_yield_safety", "yield_safety", "yield"),
    ("bearing_slope_max", "allowable_bearing_slope", "slope at the bearings"),
    ("deflection_max", "allowable_deflection", "deflection"),
    ("twist_by_length", "allowable_twist", "twist"),
    ("twice_speed", "critical_speed", "critical speed"),
)
"""What the diameters settle: the lesser side, the greater side, and what it is called."""
BESIDE = {"allowable_deflection", "allowable_twist", "speed"}  # keys without which a check is not made
SETTLING = tuple(sorted({"required_fatigue_safety", "required_yield_safety", "allowable_bearing_slope"} | BESIDE))


@dataclass(frozen=True)
class Sizes:
    """Hold the diameters of all sections (sections, variants), which were sought, and whether they hold (variants,)."""

    diameter: Array
    sought: tuple[int, ...] = ()
    held: Array | None = None
    again: Any = None
    settled: tuple[tuple[str, str, str], ...] = ()

    @property
    def is_found(self) -> Array:
        """Return for each variant whether it has diameters with which it holds, (variants, 1)."""
        return (
            np.ones((self.diameter.shape[1], 1), dtype=bool) if self.held is None else self.held[:, None].astype(bool)
        )

    @cached_property
    def neighbours(self) -> list[tuple[float | str | None, ...]]:
        """Return of each sought section the next smaller diameter, its own and the next greater one, with what they give."""
        rows = [
            (section, place, own)
            for section, own in self._own
            for place in (own - 1, own, own + 1)
            if 0 <= place < len(SERIES)
        ]
        if not rows:
            return []
        tried = np.repeat(self.diameter[:, :1], len(rows), axis=1)
        for machine, (section, place, _) in enumerate(rows):
            tried[section, machine] = SERIES[place]
        known = _asked(self.again, tried, np.zeros(len(rows), dtype=int), self.settled)
        return [self._told(known, machine, *row) for machine, row in enumerate(rows)]

    @property
    def _own(self) -> Iterator[tuple[int, int]]:
        """The sections that were sought, with the places of their diameters in the series."""
        yield from ((section, int(np.argmin(np.abs(SERIES - self.diameter[section, 0])))) for section in self.sought)

    def _told(
        self, known: Mapping[str, Array], machine: int, section: int, place: int, own: int
    ) -> tuple[float | str | None, ...]:
        shown = (float(known[name][machine]) for name in ("fatigue_safety", "yield_safety", "bearing_slope_max"))
        told = "taken" if place == own else _missed(known, machine, self.settled)
        return (
            Phrase("section {section}", section=section + 1),
            float(SERIES[place]),
            *(each if np.isfinite(each) else None for each in shown),
            told,
        )


def sizes(known: Mapping[str, Any]) -> Sizes:
    """Return the diameters as given, with those found that are left out."""
    if "sections.length" not in known:
        raise Refusal("sections", phrase("is empty; give at least one section"))
    given, count = known.get("sections.diameter"), known["sections.length"].shape[1]
    variants = len(known["bearing_a"])
    found = columns(given, count, variants)
    sought = tuple(int(i) for i in np.flatnonzero(np.isnan(found).all(axis=1)))
    if not sought:
        return Sizes(found)
    _refuse_between(known.get("sections.fillet_radius"), sought, count)
    settled = tuple(each for each in HELD if not _is_left_out(each, known))
    return _found(found, sought, known["again"], settled)


def _is_left_out(pair: tuple[str, str, str], known: Mapping[str, Any]) -> bool:
    keys = {"twice_speed": "speed"}
    return any(keys.get(side, side) in BESIDE and keys.get(side, side) not in known for side in pair[:2])


def _refuse_between(fillets: Any, sought: Sequence[int], count: int) -> None:
    """A fillet needs a step, whose height follows from neither side where both are sought."""
    for section in range(count - 1):
        fillet = fillets is not None and (isinstance(fillets, np.ndarray) or fillets[section] is not None)
        if fillet and section in sought and section + 1 in sought:
            raise Refusal(
                f"sections.{section + 1}.diameter",
                Phrase(
                    "is left out, as that of section {section} before it, but a fillet stands between both, which "
                    "needs a step; give one of the two diameters, or remove the fillet_radius, so that the step "
                    "counts as sharp",
                    section=section + 1,
                ),
            )


def _found(given: Array, sought: tuple[int, ...], again: Any, settled: tuple[tuple[str, str, str], ...]) -> Sizes:
    """First one size for all that are sought, the least that holds; then each as thin as the others let it be."""
    diameter, variants = given.copy(), given.shape[1]
    last = np.full(variants, len(SERIES) - 1)
    first = _least(diameter, sought, last, len(SERIES), again, settled)
    held = first >= 0
    places = {section: np.where(held, first, last) for section in sought}
    diameter[list(sought)] = SERIES[np.where(held, first, last)]
    for turn in range(ROUNDS if len(sought) > 1 else 0):
        before = diameter.copy()
        for section in sought:
            window = int(np.max(places[section])) + 1 if turn == 0 else WINDOW
            found = _least(diameter, (section,), places[section], window, again, settled)
            places[section] = np.where(held & (found >= 0), found, places[section])
            diameter[section] = SERIES[places[section]]
        if np.array_equal(before, diameter):
            break
    return Sizes(diameter, sought, held, again, settled)


def _least(diameter: Array, sought: Sequence[int], own: Array, window: int, again: Any, settled: Any) -> Array:
    """Return the place in the series of the least size of these sections that holds, up to the ``own`` one, -1 where none does, (variants,).

    So many sizes are tried, the own one among them.
    """
    places = np.maximum(own[:, None] - np.arange(window)[::-1], 0)
    tried = np.repeat(diameter, window, axis=1)
    tried[list(sought)] = SERIES[places].ravel()
    known = _asked(again, tried, np.repeat(np.arange(len(own)), window), settled)
    holds = np.all([_holds(known, pair) for pair in settled], axis=0).reshape(places.shape)
    first = np.take_along_axis(places, np.argmax(holds, axis=1)[:, None], axis=1)[:, 0]
    return np.where(holds.any(axis=1), first, -1)


def _asked(again: Any, diameter: Array, rows: Array, settled: Any) -> dict[str, Array]:
    names = {name for pair in settled for name in pair[:2]} | {"fatigue_safety", "yield_safety", "bearing_slope_max"}
    found: dict[str, Array] = again({"sections.diameter": diameter.T}, rows, sorted(names))
    return found


def _holds(known: Mapping[str, Array], pair: tuple[str, str, str]) -> Array:
    lesser, greater, _ = pair
    if lesser == "twist_by_length":  # a shaft without torque has none
        return np.isnan(known[lesser]) & np.isfinite(known["fatigue_safety"]) | (known[lesser] <= known[greater])
    return known[lesser] <= known[greater] * (1 + ROUNDING)


def _missed(known: Mapping[str, Array], machine: int, settled: Any) -> str:
    """Say what a machine does not hold."""
    if not np.isfinite(known["fatigue_safety"][machine]):
        return phrase("cannot be made: bore or fillet do not fit")
    missed = [pair[2] for pair in settled if not _holds(known, pair)[machine]]
    return Phrase("not enough for {missed}", missed=joined(missed, ", ")) if missed else "enough"


# fmt: off

TAKES = ("sections.diameter", "sections.length", "sections.fillet_radius", "bearing_a", *SETTLING)

diameters = Chapter("Diameters",
    text="If the diameter of a section is omitted, the smallest preferred one is selected with which the whole shaft keeps its safety factors "
        "against fatigue and yield, the slope at the bearings and, where they are given, deflection, twist and critical speed: first one size for "
        "all selected sections, then each as thin as the others permit.")
diameters.prepared("sizes", sizes, TAKES, for_many=True, again=True)
diameters.section_diameter = (computed(lambda sizes: sizes.diameter.T, ("sizes",),
    "as given, or the smallest sufficient one of the preferred numbers R40", over="sections"), "d_k", "mm", "Diameter of the section", "ISO 3")
diameters.diameters_found = (computed(lambda sizes: sizes.is_found, ("sizes",), "each size of the series is calculated", output=False), "k_d", "1",
    "Sufficient diameters exist")
diameters.require("diameter_exists", m.diameters_found > 0, key="sections",
    message="leave diameters out, but no preferred one up to 250 mm is enough for them; take a stronger steel, move the bearings nearer to the "
    "loads, or give the diameters to see what is missed")
diameters.listing("size_neighbours", "Selected diameters, with their neighbours in the series", (
        ListedColumn("section", "Section"),
        ListedColumn("diameter", "Diameter", "d_k", "mm"),
        ListedColumn("fatigue_safety", "Safety factor against fatigue", "n_f,min"),
        ListedColumn("yield_safety", "Safety factor against yield", "n_y"),
        ListedColumn("bearing_slope", "Slope at the bearings", "v′_max", "mrad"),
        ListedColumn("verdict", "Verdict"),
    ), lambda known: known["sizes"].neighbours, ("sizes",))
