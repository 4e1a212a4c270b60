"""The shaft as a body: its sections, and the places that are judged, which follow from sections, notches, bearings and loads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Phrase, Refusal, phrase
from diecut_report.mechanics.beams import SAME_PLACE

Array = NDArray[Any]
NO_NOTCH = "none"
FILLET, SHARP, PRESS_FIT, SLED_RUNNER = "fillet", "sharp", "press_fit", "keyseat_sled_runner"
KEYSEATS = {"keyseat_end_mill": 1.0, "keyseat_pair": 1.15}  # factor of one keyseat, and of two opposite each other
BY_STRENGTH = (PRESS_FIT, *KEYSEATS)  # their fatigue factors follow from the steel's strength


class Factors(NamedTuple):
    """What a type of notch brings: K_t, K_ts, and its radius as a share of the diameter, or in metres."""

    k_t: float
    k_ts: float
    share: float = 0.0
    radius: float = 0.0


TYPES = {
    NO_NOTCH: Factors(1.0, 1.0),
    FILLET: Factors(1.0, 1.0),  # these follow from the fits
    SHARP: Factors(2.7, 2.2, share=0.02),
    **dict.fromkeys(BY_STRENGTH, Factors(1.0, 1.0)),
    SLED_RUNNER: Factors(1.0, 1.0, share=0.02),  # sources differ (1.6, 1.7): its factors are given
    "groove_ring": Factors(5.0, 3.0, radius=0.25e-3),
    "custom": Factors(1.0, 1.0),
}


def columns(given: Any, parts: int, variants: int, default: float = np.nan) -> Array:
    """Return what is given of repeated parts as an array (parts, variants): numbers, None for what is left out, or columns."""
    if given is None:
        return np.full((parts, variants), default)
    if isinstance(given, np.ndarray):
        return np.broadcast_to(given.T, (parts, variants)).astype(float)
    filled = [default if each is None else each for each in given]
    return np.stack([np.broadcast_to(np.asarray(each, dtype=float), (variants,)) for each in filled])


@dataclass(frozen=True)
class Body:
    """Sections (sections, variants) and places (places, variants), in m; ``ends`` are the sections' ends from 0 on."""

    ends: Array
    diameter: Array
    bore: Array
    names: tuple[str, ...]
    kinds: tuple[str, ...]
    x: Array
    radius: Array
    k_t: Array
    k_ts: Array
    k_f: Array
    k_fs: Array

    @property
    def length(self) -> Array:
        """Return the shaft's length, (variants,)."""
        return np.asarray(self.ends[-1])

    def section_of(self, x: Array, *, behind: bool) -> Array:
        """Return which section places (places, variants) are in; at a step the one behind or before it."""
        shift = SAME_PLACE if behind else -SAME_PLACE
        found: Array = np.clip(np.sum(self.ends[None, 1:-1] <= x[:, None] + shift, axis=1), 0, len(self.diameter) - 1)
        return found

    @property
    def weakest(self) -> Array:
        """Return for each place the section that is judged there: of two at a step the smaller one."""
        before, behind = self.section_of(self.x, behind=False), self.section_of(self.x, behind=True)
        sizes = [np.take_along_axis(self.diameter, each, axis=0) for each in (before, behind)]
        return np.where(sizes[0] <= sizes[1], before, behind)

    def at_places(self, values: Array) -> Array:
        """Return what sections have, for each place, (places, variants)."""
        return np.take_along_axis(values, self.weakest, axis=0)

    @property
    def greater(self) -> Array:
        """Return the greater diameter at each place: at a step that of the other section."""
        sizes = [
            np.take_along_axis(self.diameter, self.section_of(self.x, behind=each), axis=0) for each in (False, True)
        ]
        return np.asarray(np.maximum(*sizes))

    @property
    def is_fillet(self) -> Array:
        """Return where a fillet's factors follow from the fits: at steps with a radius, (places, variants)."""
        return self.is_kind(FILLET) & (self.greater > self.at_places(self.diameter) + SAME_PLACE)

    def is_kind(self, kind: str) -> Array:
        """Return which places are of a kind, (places, 1)."""
        return np.array([each == kind for each in self.kinds])[:, None]

    @property
    def keyseats(self) -> Array:
        """Return the factor of the keyseats at each place, 0 where there is none, (places, variants)."""
        return np.array([KEYSEATS.get(kind, 0.0) for kind in self.kinds])[:, None] * np.ones_like(self.x)

    def greatest_here(self, row: Array) -> Array:
        """Return of a row (variants, places) the greatest among the places that stand at one position."""
        x = self.x.T
        same = np.abs(x[:, :, None] - x[:, None, :]) <= SAME_PLACE
        return np.asarray(np.max(np.where(same, row[:, None, :], -np.inf), axis=2))


def body(
    lengths: Any, diameters: Any, bores: Any, fillets: Any, notch_x: Any, types: Any, radii: Any, k_t: Any, k_ts: Any, k_f: Any, k_fs: Any,
    names: Any, load_x: Any, hub_seats: Any, bearing_a: Array, bearing_b: Array, *seats: str,
) -> Body:  # fmt: skip
    """Return the body of what is given; Refusal where a list is empty, or a notch does not say what it is."""
    if names is None:
        raise Refusal("loads", "is empty; give at least one load")
    variants, count, notches = len(bearing_a), lengths.shape[1], len(types or ())
    length, diameter = columns(lengths, count, variants), columns(diameters, count, variants)
    ends = np.concatenate([np.zeros((1, variants)), np.cumsum(length, axis=0)])
    fillet = columns(fillets, count, variants)
    if np.isfinite(fillet[-1]).any():
        raise Refusal(
            f"sections.{count - 1}.fillet_radius", "belongs to no step: there is no section to the right; remove it"
        )
    own = [columns(each, notches, variants) for each in (radii, k_t, k_ts, k_f, k_fs)]
    _complete(types or (), own)
    steps = [FILLET if np.isfinite(fillet[i]).all() else SHARP for i in range(count - 1)]
    rest = 2 + len(names)
    seated = (PRESS_FIT if seat == "tight" else NO_NOTCH for seat in (*seats, *hub_seats))
    kinds = (*steps, *(types or ()), *seated)
    told = (
        *(Phrase("shoulder {i}", i=i + 1) for i in range(count - 1)),
        *(
            Phrase("notch {i} ({kind})", i=i + 1, kind=phrase(kind.replace("_", " ")))
            for i, kind in enumerate(types or ())
        ),
        phrase("bearing A"),
        phrase("bearing B"),
        *(Phrase("load {name}", name=name) for name in names),
    )
    places = [
        ends[1:-1],
        columns(notch_x, notches, variants),
        bearing_a.T,
        bearing_b.T,
        columns(load_x, len(names), variants),
    ]
    full = [_filled(fillet[:-1], each, rest) if i == 0 else _filled(np.full((count - 1, variants), np.nan), each, rest)
            for i, each in enumerate(own)]  # fmt: skip
    made = Body(ends, diameter, columns(bores, count, variants, 0.0), told, kinds, np.concatenate(places), *full)
    return _with_types(made)


def _filled(shoulders: Array, notches: Array, rest: int) -> Array:
    return np.concatenate([shoulders, notches, np.full((rest, shoulders.shape[1]), np.nan)])


def _complete(types: tuple[str, ...], own: list[Array]) -> None:
    """A custom notch gives its stress concentrations with the radius, or its fatigue factors; others have their own."""
    for index, kind in enumerate(types):
        radius, *factors = (bool(np.isfinite(each[index]).any()) for each in own)
        by_shape, by_fatigue = all((radius, *factors[:2])), all(factors[2:])
        if kind == "custom" and (by_shape == by_fatigue or (by_fatigue and any((radius, *factors[:2])))):
            raise Refusal(f"notches.{index}", "is a custom notch; give it either k_t, k_ts and radius, or k_f and k_fs")
        if kind == "custom" and by_shape and any(factors[2:]):
            raise Refusal(
                f"notches.{index}", "gives both k_t and k_f; a custom notch has k_t, k_ts and radius, or k_f and k_fs"
            )
        if kind == SLED_RUNNER and not (all(factors[:2]) and not any(factors[2:])):
            raise Refusal(
                f"notches.{index}",
                "is a sled runner keyseat, on whose factors the sources differ; give its k_t and k_ts",
            )
        if kind not in ("custom", SLED_RUNNER) and any(factors):
            raise Refusal(
                f"notches.{index}",
                Phrase(
                    "has factors of its own, but is of the type {kind}; remove them, or give it the type custom",
                    kind=kind,
                ),
            )
        if kind in BY_STRENGTH and radius:
            raise Refusal(
                f"notches.{index}.radius",
                "has no use for a press fit or a keyseat, whose fatigue factors stand in a table; remove it",
            )


def _with_types(made: Body) -> Body:
    """The factors and radii that the types bring where none are given."""
    size = made.at_places(made.diameter)
    types = [TYPES[kind] for kind in made.kinds]

    def column(name: str) -> Array:
        return np.array([getattr(each, name) for each in types])[:, None]

    radius = np.where(np.isfinite(made.radius), made.radius, column("radius") + column("share") * size)
    flat = made.is_kind(SHARP) & (made.greater <= size + SAME_PLACE)  # sections of one diameter: no step at all
    k_t, k_ts = (
        np.where(flat, 1.0, np.where(np.isfinite(own), own, column(name)))
        for name, own in (("k_t", made.k_t), ("k_ts", made.k_ts))
    )
    k_f, k_fs = (np.where(np.isfinite(own), own, 0.0) for own in (made.k_f, made.k_fs))
    return Body(made.ends, made.diameter, made.bore, made.names, made.kinds, made.x, radius, k_t, k_ts, k_f, k_fs)
