"""Plain code where no formula tells a number: it takes arrays of shape (variants, 1), says in words how, and may refuse a machine."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, Refusal, computed, m


class Gears(Inputs):
    ratio = Quantity("i", "1", "Ratio that is wanted", gt=0, le=10)
    most = Quantity("z_max", "1", "Most teeth of a wheel", ge=20, integer=True, default=100)


def driver_teeth(ratio, most):
    """The driver with which a whole number of teeth comes nearest to the ratio."""
    teeth = np.arange(17, 31)
    driven = np.round(ratio * teeth)
    if not (driven <= most).any(axis=1).all():
        raise Refusal("ratio", "is too great for the wheels that there may be; lower it, or raise most")
    error = np.where(driven <= most, abs(driven / teeth - ratio), np.inf)
    return teeth[np.argmin(error, axis=1)][:, None].astype(float)


search = Chapter("Teeth")
METHOD = "all drivers of 17 to 30 teeth are tried, and the one is taken whose ratio is nearest"
search.driver_teeth = computed(driver_teeth, ("ratio", "most"), METHOD, whole=True), "z_1", "1", "Teeth of the driver"
search.driven_teeth = np.round(m.ratio * m.driver_teeth), "z_2", "1", "Teeth of the driven wheel"

MECHANISM = Mechanism(
    kind="gears", version="1.0", title="Gears", summary="Teeth for a ratio.", inputs=Gears, chapters=(search,)
)

PRESS = """
mechanisms:
  gears: {kind: gears, ratio: 1.2345}
"""
GIVES = {"gears.driver_teeth": "17", "gears.driven_teeth": "21"}
