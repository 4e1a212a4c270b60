"""Chapters on the key's dimensions: by the shaft from DIN 6885-1, or as given."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from diecut_report.api import Chapter, Constant, bind, si, standard_series, standard_table

# fmt: off

KEYS = standard_table("parallel_keys")
SHAFTS = np.array([si(value, "mm") for value in KEYS.column("d").values])
THINNEST = si(10, "mm")
LENGTHS = standard_series("din_6885_lengths")
LONGEST = si(LENGTHS.values[-1], LENGTHS.unit)
GIVEN = ("width",)
DIMENSIONS = {"width": ("b", "b", "Width of the key"), "height": ("h", "h", "Height of the key"),
              "depth_shaft": ("t_1", "t1", "Depth of the shaft keyway"), "depth_hub": ("t_2", "t2", "Depth of the hub keyway")}
ROUNDING = 1e-9  # relative: a diameter at the end of a row belongs to it
LEAST_SHAFT = Constant(THINNEST, "d_0", "m")
GREATEST_SHAFT = Constant(float(SHAFTS[-1]) * (1 + ROUNDING), "d_1", "m")
LONGEST_KEY = Constant(LONGEST, "l_1", "m")


def of_shaft(column: str) -> Callable[[Any], Any]:
    """Return what gives a column of the table by shaft diameters of shape (variants, 1); NaN outside of the table."""
    values = np.array([si(value, "mm") for value in KEYS.column(column).values])

    def found(diameter: Any) -> Any:
        row = np.searchsorted(SHAFTS, diameter * (1 - ROUNDING))
        inside = (diameter > THINNEST) & (row < len(SHAFTS))
        return np.where(inside, values[np.minimum(row, len(SHAFTS) - 1)], np.nan)

    return found


dimensions = Chapter("Dimensions")
dimensions.require("in_table", lambda shaft_diameter: (shaft_diameter > LEAST_SHAFT) & (shaft_diameter <= GREATEST_SHAFT), key="shaft_diameter",
    lacks=GIVEN,
    message="is {shaft_diameter}, for which the table of DIN 6885-1 has no key: it goes from above 10 to 200 mm; give width, height, depth_shaft "
        "and depth_hub")
for name, (symbol, column, words) in DIMENSIONS.items():
    dimensions.computed(name, symbol, "mm", words, function=of_shaft(column), takes=("shaft_diameter",), lacks=GIVEN, source="DIN 6885-1",
        method="the row of the table whose range of diameters holds the shaft, its upper end included")
    dimensions.value(name, symbol, "mm", f"{words}: as given", bind(lambda given: given, given=f"inputs.{name}"), needs=GIVEN, source="input")
dimensions.value("height_shaft", "h_W", "mm", "Bearing height in the shaft", lambda depth_shaft, chamfer: depth_shaft - chamfer, source="geometry",
    output=False)
dimensions.value("height_hub", "h_N", "mm", "Bearing height in the hub", lambda height, depth_shaft, chamfer: height - depth_shaft - chamfer,
    source="geometry", output=False)
dimensions.value("height_key", "h_P", "mm", "Smaller bearing height, which governs the pressure on the key",
    lambda height_shaft, height_hub: np.minimum(height_shaft, height_hub), source="geometry", output=False)
dimensions.require("key_stands_out", lambda height, depth_shaft: depth_shaft < height, key="depth_shaft", needs=GIVEN,
    message="is {depth_shaft}, in which a key of height {height} sinks whole; take a keyway that is less deep")
dimensions.require("bears", lambda height_key: height_key > 0, key="chamfer",
    message="is {chamfer}, which leaves no height to bear of the {height} high key; take a smaller chamfer")
