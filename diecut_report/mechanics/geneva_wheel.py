"""The body of a Geneva wheel: what slots and locking arcs leave of the disc."""

from __future__ import annotations

from functools import lru_cache
from math import acos, asin, cos, hypot, pi, sin


def crank_radius(center_distance: float, slots: float) -> float:
    """Return the radius (m) of the roller's circle, with which it enters the slots without a shock."""
    return center_distance * sin(pi / slots)


@lru_cache(maxsize=256)  # of one wheel it is asked for again and again
def area_and_polar(
    slots: int, center_distance: float, roller_radius: float, locking_radius: float | None, bore: float
) -> tuple[float, float]:
    """Return the area (m²) and the polar second moment of area (m⁴) of the wheel, between its bore and the rim.

    Lengths in m. Without a ``locking_radius`` the arm between arc and slot is as thick as the roller. The rim is where both flanks of a slot
    guide the roller from its entry on.
    """
    from scipy.integrate import quad  # a third of the program's start, which only a machine with such a wheel needs

    crank = crank_radius(center_distance, slots)
    arc = crank - 3 * roller_radius if locking_radius is None else locking_radius
    rim, end = hypot(center_distance * cos(pi / slots), roller_radius), center_distance - crank
    full = hypot(end, roller_radius)  # from where on a slot has its whole width

    def left(radius: float) -> float:
        """The angle that slots and arcs leave of the circle of a radius."""
        slot = asin(roller_radius / radius) if radius > full else _within(radius, end, roller_radius)
        return 2 * pi - 2 * slots * (slot + _within(radius, center_distance, arc))

    corners = sorted({min(max(each, bore / 2), rim) for each in (end - roller_radius, full, center_distance - arc)})
    area, polar = (quad(lambda r, n=n: left(r) * r**n, bore / 2, rim, points=corners)[0] for n in (1, 3))
    return float(area), float(polar)


def _within(radius: float, distance: float, own: float) -> float:
    """Half the angle of the circle of a radius that lies within a circle of its own radius at a distance."""
    if radius <= abs(distance - own) or radius >= distance + own:
        return 0.0
    return acos((radius**2 + distance**2 - own**2) / (2 * radius * distance))
