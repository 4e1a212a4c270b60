"""The drive line of the results: shafts with their parts and what joins them, each with what rates it. Lengths are metres."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from diecut_report.results.figure_record import Point
from diecut_report.results.record import Record, always, sometimes

PartKind = Literal[
    "bearing", "gear", "pulley", "sprocket", "flywheel", "clutch", "coupling", "brake", "crank", "rocker", "geneva_wheel", "cam", "load",
    "key", "pin", "pin_bearing",
]  # fmt: skip


Few = Field(max_length=60)  # of each list: no machine has more, and its drawing takes time for each
State = Literal["rated", "not_rated", "accepted", "none"]


class RatingRecord(Record):
    """What rates a part."""

    state: State = always(
        "`none`: there is nothing to rate, as of a motor's shaft, which is its maker's, or of a flywheel's rim."
    )
    calculation: str = sometimes("The mechanism of the results that rates it.", "")
    check: str = sometimes("The id of the check that governs it there.", "")


class ShaftSectionRecord(Record):
    """A section of a shaft, from its left end."""

    start: float = always("Where it begins.")
    end: float = always("Where it ends.")
    diameter: float = always("Its diameter.")
    bore: float = sometimes("Its bore.", 0.0)


class PlacedPartRecord(Record):
    """A part on a shaft, or a piece of it that is rated by itself: its key, its pin, the bearing on that."""

    name: str = always("What it is called: SHAFT.PART, with `.key`, `.pin`, `.pin.bearing` of a piece.")
    kind: PartKind = always("Its kind.")
    start: float = always("Where its hub, its ring, or itself begins, from the shaft's left end.")
    end: float = always("Where that ends.")
    seat: float = always("The diameter on which it sits, of a pin its own; 0 where it is not known.")
    radius: float = sometimes("Its pitch radius or outer one; of what sits beside the axis how far off it.", 0.0)
    outside: float = sometimes("The outside diameter of a bearing.", 0.0)
    width: float = sometimes("How wide its body is, where that is not as long as its hub.", 0.0)
    toothed: float = sometimes("Of a sector the part of its circumference that has teeth.", 1.0)
    slots: Annotated[int, Field(le=100)] = sometimes("The number of slots of a Geneva wheel.", 0)
    of: str = sometimes("The port of a mechanism that it stands for, MECHANISM.PORT.", "")
    rating: RatingRecord = always("What rates it.")


class MachineShaftRecord(Record):
    """A shaft with its parts."""

    name: str = always("Its name.")
    axis: Point | None = sometimes("Where its axis stands in the frame; null where that is not given.")
    left: float | None = sometimes("Where its left end stands along the axes; null where no join tells.")
    sections: Annotated[list[ShaftSectionRecord], Few] = always("Its sections from left to right; none of a motor's.")
    parts: Annotated[list[PlacedPartRecord], Field(max_length=160)] = always(
        "Its parts in the order of the file, each followed by its pieces."
    )
    rating: RatingRecord = always("What rates it.")


class JoinRecord(Record):
    """A mesh, a chain or a belt."""

    name: str = always("Its name.")
    kind: Literal["mesh", "chain", "belt"] = always("Its kind.")
    drivers: Annotated[list[str], Few] = always("The driving parts.")
    driven: Annotated[list[str], Few] = always("The driven parts; none where it drives a mechanism.")
    rating: RatingRecord = always("What rates it.")


class DriveLineRecord(Record):
    """The parts of the machine as they stand."""

    shafts: Annotated[list[MachineShaftRecord], Few] = always("The shafts in the order of the file.")
    joins: Annotated[list[JoinRecord], Few] = always("What joins them.")
