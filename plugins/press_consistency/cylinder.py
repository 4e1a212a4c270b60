"""The one cylinder of the press: what its drive and the dampers take it to be, against what is sized."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.api import Chapter, GivenMechanism, Phrase, named, told

# fmt: off

ROUNDED = 0.01  # share by which a value may have been rounded where it was typed again
SIZES = {"cylinder_radius": ("radius", "mm"), "rolling_radius": ("radius", "mm"), "segment_height": ("segment_height", "mm"),
         "cylinder_length": ("generatrix_length", "mm")}
LOADS = {"cylinder_mass": ("mass", "kg"), "mass": ("mass", "kg"), "cylinder_inertia": ("inertia", "kg*m**2"), "inertia": ("inertia", "kg*m**2"),
         "static_unbalance": ("static_unbalance", "kg*m"), "cutting_arc_fraction": ("cutting_arc_fraction", "1")}
"""By the keys of the others: results of the cylinder that a key is, and those that it is at least, as the carriages are in it, too."""


def sizes_apart(cylinder: GivenMechanism, *others: GivenMechanism) -> int:
    """Return how many sizes of the cylinder are others than those that are sized."""
    return len(list(_sizes(cylinder, others)))


def sizes_listed(cylinder: GivenMechanism, *others: GivenMechanism) -> str:
    """Return them in words."""
    return Phrase("{sizes}", sizes=named(list(_sizes(cylinder, others)), ", "))


def loads_short(cylinder: GivenMechanism, *others: GivenMechanism) -> int:
    """Return how many masses, inertias and the like are less than those of the cylinder that is sized."""
    return len(list(_loads(cylinder, others)))


def loads_listed(cylinder: GivenMechanism, *others: GivenMechanism) -> str:
    """Return them in words."""
    return Phrase("{loads}", loads=named(list(_loads(cylinder, others)), ", "))


def _sizes(cylinder: GivenMechanism, others: tuple[GivenMechanism, ...]) -> Iterator[str]:
    for key, own, sized, unit in _shared(cylinder, others, SIZES):
        if abs(own - sized) > ROUNDED * abs(sized):
            yield _told(key, own, sized, unit)


def _loads(cylinder: GivenMechanism, others: tuple[GivenMechanism, ...]) -> Iterator[str]:
    for key, own, sized, unit in _shared(cylinder, others, LOADS):
        if own < sized * (1 - ROUNDED):
            yield _told(key, own, sized, unit)


def _shared(
    cylinder: GivenMechanism, others: tuple[GivenMechanism, ...], keys: dict[str, tuple[str, str]]
) -> Iterator[tuple[str, float, float, str]]:
    for other in others:
        for key, (result, unit) in keys.items():
            own, sized = other.number(key), cylinder.number(result)
            if own is not None and sized is not None:
                yield f"{other.name}.{key}", own, sized, unit


def _told(key: str, own: float, sized: float, unit: str) -> str:
    return Phrase("{key} {own} (the cylinder: {sized})", key=key, own=told(own, unit, 4), sized=told(sized, unit, 4))


CYLINDER = Chapter("Cylinder of the press", needs=("cylinder",),
    text="The drive and the dampers move the cylinder that is sized; where they are given another one, their results are not those of this press. "
        "What moves with the cylinder may add to its mass and its moments.",
    absent="not calculated: there is no cylinder to use, or there are several")
for needs, lacks in ((("drive", "damper"), ()), (("drive",), ("damper",)), (("damper",), ("drive",))):
    forms = {"needs": needs, "lacks": lacks, "output": False}
    CYLINDER.computed("cylinder_sizes_apart", "N_s", "1", "Number of sizes that are not those of the cylinder", sizes_apart, ("cylinder", *needs),
        "compared one by one", **forms)
    CYLINDER.computed("cylinder_loads_short", "N_l", "1", "Number of masses and moments that are less than those of the cylinder", loads_short,
        ("cylinder", *needs), "compared one by one", **forms)
    CYLINDER.words("cylinder_sizes", sizes_listed, ("cylinder", *needs), needs=needs, lacks=lacks)
    CYLINDER.words("cylinder_loads", loads_listed, ("cylinder", *needs), needs=needs, lacks=lacks)
