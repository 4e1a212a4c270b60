"""Where the board must lie and how long a cut may be: what a message advises, rounded so that it is enough as printed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.api import Phrase, joined, outward, phrase, si, told
from diecut_report.plugins.circular_knife import formulas as f

SIZES = ("eccentricity", "edge_radius", "depth", "thickness", "friction", "front_distance", "cut_length")
CLEAR = 1.01e-6  # share of the edge's radius that the geometry asks for between two distances, a little more
ENOUGH = 1e-9  # share by which a limit itself is kept clear of


@dataclass(frozen=True)
class PlaceRange:
    """The board must not begin before ``nearest``, and the cut must not end after ``furthest`` (distances from the axis)."""

    nearest: float
    furthest: float


def _up(length: float) -> float:
    """A length, as it is printed in mm, that is not below another one."""
    return si(outward(length * (1 + ENOUGH) / si(1, "mm"), up=True), "mm")


def _down(length: float) -> float:
    """A length, as it is printed in mm, that is not above another one."""
    return si(outward(length * (1 - ENOUGH) / si(1, "mm"), up=False), "mm")


def _range(given: PlaceRange, length: float) -> str:
    """The distances of the front edge for a cut of this length, in words; empty where there are none."""
    first, last = _up(given.nearest), _down(given.furthest - length)
    return (
        Phrase("a front_distance from {first} to {last}", first=told(first, "mm"), last=told(last, "mm"))
        if first <= last
        else ""
    )


def _shorter(given: PlaceRange, front: float) -> str:
    """The cut that is possible from this front edge, in words; empty where there is none."""
    length = _down(given.furthest - front)
    return (
        Phrase("a cut_length of at most {length}", length=told(length, "mm"))
        if front >= given.nearest and length > 0
        else ""
    )


def placing(given: PlaceRange, front: float, length: float) -> str:
    """What brings the cut into a range: another place, a shorter cut, or both; empty where nothing does."""
    ways = [way for way in (_shorter(given, front), _range(given, length)) if way]
    if ways:
        return joined(ways, " or ")
    nearest = _up(given.nearest)
    both = _shorter(given, nearest)
    return (
        Phrase("a front_distance of {nearest} together with {both}", nearest=told(nearest, "mm"), both=both)
        if both
        else ""
    )


def _end_at(slope: float, eccentricity: float, edge_radius: float, depth: float) -> float:
    """Distance from the axis at which the shear angle has grown to a slope; the greatest reach where it stays below."""
    sine = (depth - edge_radius * np.cos(slope)) / eccentricity
    angle = np.arcsin(np.minimum(sine, depth / (edge_radius + eccentricity)))
    return float(f.edge_position(angle, depth, eccentricity, edge_radius))


def possible(eccentricity: float, edge_radius: float, depth: float, thickness: float) -> PlaceRange:
    """Between what distances the geometry lets the knife cut."""
    at_face = f.lowest_passes(eccentricity, depth - thickness, edge_radius)
    at_counter = f.lowest_passes(eccentricity, depth, edge_radius) + CLEAR * edge_radius
    reach = f.reach(edge_radius, eccentricity, depth) - CLEAR * edge_radius
    return PlaceRange(max(float(at_face), float(at_counter)), float(reach))


def clear_of_blade(eccentricity: float, edge_radius: float, depth: float, thickness: float) -> float:
    """Distance from which the board's upper front edge is outside the edge's circle for a part of the turn."""
    return float(np.sqrt(np.maximum((edge_radius - eccentricity) ** 2 - (depth - thickness) ** 2, 0)))


def sound(eccentricity: float, edge_radius: float, depth: float, thickness: float, friction: float) -> PlaceRange:
    """Between what distances all checks pass; that of the pushing out is left aside where no cut would meet it."""
    sizes = eccentricity, edge_radius, depth
    bounds = possible(*sizes, thickness)
    steep = _end_at(f.least_shear_angle(), *sizes)
    nearest = max(bounds.nearest, steep, clear_of_blade(*sizes, thickness))
    turned = f.reversal_angle(depth - thickness, edge_radius, eccentricity)
    with np.errstate(invalid="ignore"):
        runs_back = np.nan_to_num(f.edge_position(turned, depth, eccentricity, edge_radius), nan=0.0)
    # 0: above a thick board the edge turns back before it gets to the counter-knife, and no cut is sound
    furthest = float(min(bounds.furthest, _end_at(f.greatest_shear_angle(), *sizes), runs_back))
    pushed = _end_at(f.expulsion_angle(friction), *sizes)
    return PlaceRange(nearest, min(furthest, pushed) if _up(nearest) < _down(pushed) else furthest)


def check_advice(*sizes: float) -> str:
    """What makes all checks pass; the sizes are ``SIZES``."""
    return placing(sound(*sizes[:5]), *sizes[5:])


def reach_advice(*sizes: float) -> str:
    """What the edge can cut: where the checks pass, or else where it reaches at all."""
    ways = check_advice(*sizes) or placing(possible(*sizes[:4]), *sizes[5:])
    return (
        Phrase("{ways} is within reach", ways=ways)
        if ways
        else phrase("no cut is within reach of this knife: make its eccentricity greater")
    )


def entering_advice(*knife: float) -> str:
    """The least distance of the front edge; the sizes are the first four."""
    nearest = max(possible(*knife).nearest, clear_of_blade(*knife))
    return Phrase("put the board further from the axis: front_distance at least {up}", up=told(_up(nearest), "mm"))


def shear_advice(least: float, greatest: float, *sizes: float) -> str:
    """What to change where the shear angle leaves what is usual."""
    words = []
    if greatest > f.greatest_shear_angle():
        words.append(
            Phrase(
                "at the end of the cut the edge stands at {greatest}, more than 20°: the travel is long and the "
                "board is pushed forward",
                greatest=told(greatest, "deg"),
            )
        )
    if least < f.least_shear_angle():
        words.append(
            Phrase(
                "at its start the edge stands at {least}, less than 2°, and cuts nearly like a guillotine, with "
                "a high force",
                least=told(least, "deg"),
            )
        )
    ways = check_advice(*sizes)
    remedy = (
        Phrase("{ways} keeps it between 2° and 20°", ways=ways)
        if ways
        else phrase("a greater eccentricity or a smaller depth makes the usable part of the edge longer")
    )
    return joined(words, ", and ") + "; " + remedy + "."


def expulsion_advice(greatest: float, *sizes: float) -> str:
    """What to change where edge and counter-knife push the board out."""
    eccentricity, edge_radius, depth, _, friction, *_ = sizes
    pushed = _end_at(f.expulsion_angle(friction), eccentricity, edge_radius, depth)
    within = sound(*sizes[:5]).furthest <= pushed
    ways = check_advice(*sizes) if within else ""
    least = outward(float(np.tan(greatest / 2)) * (1 + ENOUGH), up=True)
    held = Phrase(
        "the board must be clamped (without a clamp, friction of at least {least} would hold it)",
        least=told(least, "1"),
    )
    return (
        Phrase("{ways} lowers the shear angle enough; otherwise {held}.", ways=ways, held=held) if ways else f"{held}."
    )


def return_advice(*sizes: float) -> str:
    """What to change where the edge runs back in the board."""
    ways = check_advice(*sizes)
    return (
        Phrase("{ways} avoids it.", ways=ways)
        if ways
        else "a thinner board, a greater edge radius or a greater eccentricity helps."
    )
