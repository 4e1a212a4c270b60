"""The one cylinder of the press: what its drive and the dampers take it to be, against what is sized."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np

from diecut_report.api import Chapter, GivenMechanism, Phrase, named, told

# fmt: off

Keys = dict[str, tuple[str, str]]
Judge = Callable[[Any, Any], Any]
ROUNDED = 0.01  # share by which a value may have been rounded where it was typed again
SIZES: Keys = {"cylinder_radius": ("radius", "mm"), "rolling_radius": ("radius", "mm"), "segment_height": ("segment_height", "mm"),
               "cylinder_length": ("generatrix_length", "mm")}
LOADS: Keys = {"cylinder_mass": ("mass", "kg"), "mass": ("mass", "kg"), "cylinder_inertia": ("inertia", "kg*m**2"), "inertia": ("inertia", "kg*m**2"),
               "static_unbalance": ("static_unbalance", "kg*m"), "cutting_arc_fraction": ("cutting_arc_fraction", "1")}
"""By the keys of the others: results of the cylinder that a key is, and those that it is at least, as the carriages are in it, too."""


def sizes_apart(cylinder: GivenMechanism, *others: GivenMechanism) -> Any:
    """Return how many sizes of the cylinder are others than those that are sized, of all machines."""
    return _counted(cylinder, others, SIZES, _is_another)


def sizes_listed(cylinder: GivenMechanism, *others: GivenMechanism) -> str:
    """Return them in words."""
    return _listed(cylinder, others, SIZES, _is_another)


def loads_short(cylinder: GivenMechanism, *others: GivenMechanism) -> Any:
    """Return how many masses, inertias and the like are less than those of the cylinder that is sized, of all machines."""
    return _counted(cylinder, others, LOADS, _is_less)


def loads_listed(cylinder: GivenMechanism, *others: GivenMechanism) -> str:
    """Return them in words."""
    return _listed(cylinder, others, LOADS, _is_less)


def _is_another(own: Any, sized: Any) -> Any:
    return np.abs(own - sized) > ROUNDED * np.abs(sized)


def _is_less(own: Any, sized: Any) -> Any:
    return own < sized * (1 - ROUNDED)


def _counted(cylinder: GivenMechanism, others: tuple[GivenMechanism, ...], keys: Keys, is_wrong: Judge) -> Any:
    pairs = ((other.numbers(key), cylinder.numbers(result)) for other in others for key, (result, _) in keys.items())
    wrong = (is_wrong(own, sized) for own, sized in pairs if own is not None and sized is not None)
    return sum(wrong, np.zeros((cylinder.count, 1)))


def _listed(cylinder: GivenMechanism, others: tuple[GivenMechanism, ...], keys: Keys, is_wrong: Judge) -> str:
    found = []
    for other, (key, (result, unit)) in product(others, keys.items()):
        own, sized = other.number(key), cylinder.number(result)
        if own is not None and sized is not None and is_wrong(own, sized):
            found.append(_told(f"{other.name}.{key}", own, sized, unit))
    return Phrase("{values}", values=named(found, ", "))


def _told(key: str, own: float, sized: float, unit: str) -> str:
    return Phrase("{key} {own} (the cylinder: {sized})", key=key, own=told(own, unit, 4), sized=told(sized, unit, 4))


CYLINDER = Chapter("Cylinder of the press", needs=("cylinder",),
    text="The drive and the dampers move the cylinder that is sized; where they are given another one, their results are not those of this press. "
        "What moves with the cylinder may add to its mass and its moments.",
    absent="not calculated: there is no cylinder to use, or there are several")
for needs, lacks in ((("drive", "damper"), ()), (("drive",), ("damper",)), (("damper",), ("drive",))):
    forms: dict[str, Any] = {"needs": needs, "lacks": lacks, "output": False}
    CYLINDER.computed("cylinder_sizes_apart", "N_s", "1", "Number of sizes that are not those of the cylinder", sizes_apart, ("cylinder", *needs),
        "compared one by one", **forms)
    CYLINDER.computed("cylinder_loads_short", "N_l", "1", "Number of masses and moments that are less than those of the cylinder", loads_short,
        ("cylinder", *needs), "compared one by one", **forms)
    CYLINDER.words("cylinder_sizes", sizes_listed, ("cylinder", *needs), needs=needs, lacks=lacks)
    CYLINDER.words("cylinder_loads", loads_listed, ("cylinder", *needs), needs=needs, lacks=lacks)
