"""Self-tests: the energy of a thrown body by two ways, and the work of a spring against what its force does along the way."""

from __future__ import annotations

from diecut_report.api import (
    CURVE_ROUNDING,
    GRAVITY,
    ROUNDING,
    Chapter,
    Inputs,
    Mechanism,
    Quantity,
    abscissa,
    m,
    reduction,
    samples,
    self_test,
)


class Spring(Inputs):
    rate = Quantity("c", "N/mm", "Rate of the spring", gt=0)
    travel = Quantity("s", "mm", "Travel of the spring", gt=0)
    mass = Quantity("m", "kg", "Mass that it throws up", gt=0)
    n_points = samples(36)


energy = Chapter("Energy")
energy.work = m.rate * m.travel**2 / 2, "W", "J", "Work of the spring"
energy.height = m.work / (m.mass * GRAVITY), "h", "m", "Height of the throw"
energy.speed = (2 * m.work / m.mass) ** 0.5, "v", "m/s", "Speed at the start"
energy.height_error = (
    self_test(m.height, m.speed**2 / (2 * GRAVITY), within=ROUNDING),
    "e_h",
    "1",
    "Height of the throw by its energy and by its speed",
)
energy.way = abscissa(m.travel), "x", "mm", "Way of the spring"
energy.force = m.rate * m.way, "F", "N", "Force of the spring"
energy.work_done = reduction("integral", of="force"), "W_F", "J", "Work that the force does"
energy.work_error = (
    self_test(m.work_done, m.work, within=CURVE_ROUNDING),
    "e_W",
    "1",
    "Work of the spring by its force",
    "energy",
)

MECHANISM = Mechanism(
    kind="thrower", version="1.0", title="Thrower", summary="A spring throws.", inputs=Spring, chapters=(energy,)
)

PRESS = """
mechanisms:
  thrower: {kind: thrower, rate: 2 N/mm, travel: 50 mm, mass: 0.5 kg}
"""
GIVES = {"thrower.work_done": "2.5 J", "thrower.height": "0.5099 m"}
