"""The keys of the machine's parts. Dimensions are numbers here, as places, fits and centre distances must be known before anything is calculated."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from diecut_report.mechanism.inputs import Block, Quantity
from diecut_report.mechanism.names import OneOf, Text

# fmt: off

WORDS = ("machine", "shafts", "meshes", "chains", "belts")
"""The keys of a configuration beside ``mechanisms`` that hold the parts; no mechanism has one of these names."""

PART_KINDS = ("bearing", "gear", "pulley", "sprocket", "flywheel", "clutch", "coupling", "brake", "crank", "rocker", "geneva_wheel", "cam", "load")
"""Kinds of parts on a shaft: the key whose value is the part's name."""

LOOSE = ("g6", "h6")
"""Fits in which a ring or a hub slides."""


def size(symbol: str, description: str, **bounds: Any) -> Quantity:
    """Return the declaration of a length in mm."""
    return Quantity(symbol, "mm", description, **bounds)


class Accepted(Block):
    """Who accepts a part without a rating, and why."""

    by: Annotated[str, Text("Who accepts it"), Field(min_length=1)]
    reason: Annotated[str, Text("Why it needs no rating"), Field(min_length=20)]


class GearDefaults(Block):
    """What all gears are made of, unless a mesh says its own."""

    sigma_h_lim: Annotated[float | None, Quantity("σ_Hlim", "MPa", "Allowable contact stress number (ISO 6336-5)", gt=0)] = None
    sigma_f_lim: Annotated[float | None, Quantity("σ_Flim", "MPa", "Nominal bending stress number (ISO 6336-5)", gt=0)] = None
    grade: Annotated[int | None, Quantity("Q", "1", "Grade of accuracy (ISO 1328-1:2013)", ge=3, le=11, integer=True)] = None
    crowned: Annotated[bool, Text("Crowned teeth")] = False
    flanks: Annotated[Literal["through_hardened", "case_hardened", "grey_iron"] | None,
        Text("Flanks, by which they run in; case_hardened also for nitrided ones")] = None
    hub_yield: Annotated[float | None, Quantity("R_eN", "MPa", "Yield strength of the hubs", gt=0)] = None


class MachineKeys(Block):
    """Keys of ``machine``: what holds for all parts, and the axes of the frame."""

    basis: Annotated[Literal["given", "assumed", "measured", "catalogue", "standard", "drawing"] | None,
        Text("Basis of all numbers without their own; but for assumed only of those that ask for none")] = None
    note: Annotated[str | None, Text("Note on that basis")] = None
    owner: Annotated[str | None, Text("Who closes the open items; default: project.prepared_by")] = None
    shaft_material: Annotated[str | None, Text("Steel of the shafts")] = None
    surface: Annotated[Literal["ground", "machined", "hot_rolled", "forged"] | None, Text("Surface finish of the shafts")] = None
    gears: Annotated[GearDefaults, Field(default_factory=GearDefaults)]
    required_life: Annotated[float | None, Quantity("L_h", "h", "Required life", gt=0, plausible=("100 h", "1e6 h"))] = None
    stop: Annotated[Literal["ring", "sleeve", "nut", "press"] | None, Text("What holds a part where no shoulder does")] = None
    service: Annotated[Literal["light", "medium", "heavy"], Text("Service of the belts; with the hours a day it gives c_2")] = "heavy"
    hours_per_day: Annotated[float, Quantity("", "1", "Hours of service a day", gt=0, le=24)] = 16
    anchor: Annotated[str, Text("Shaft that turns once a sheet")]
    frame: Annotated[Any, Text("Axes of the shafts, NAME: [x, y]")] = None


class SectionKeys(Block):
    """A section of a shaft, from left to right."""

    length: Annotated[float, size("l", "Length of the section", gt=0)]
    diameter: Annotated[float, size("d", "Diameter of the section", gt=0)]
    bore: Annotated[float, size("d_i", "Bore of the section", ge=0)] = 0
    fillet_radius: Annotated[float | None, size("r", "Fillet radius at the right end of the section", gt=0)] = None


class PinKeys(Block):
    """The pin of a crank or a rocker."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("held",), ("span_start", "span_end")),)
    spread: ClassVar[Mapping[str, tuple[str, ...]]] = {"span": ("span_start", "span_end")}

    diameter: Annotated[float, size("d", "Diameter of the pin", gt=0)]
    held: Annotated[float | None, size("l_h", "Length of the pin within the disc", gt=0)] = None
    span_start: Annotated[float | None, size("x_1", "First support, from the pin's end", ge=0)] = None
    span_end: Annotated[float | None, size("x_2", "Second support, from the pin's end", gt=0)] = None
    plane: Annotated[float, size("x_p", "Middle of the bearing: beyond the disc's outer face, or from the pin's end", ge=0)]
    bearing: Annotated[str | None, Text("Designation of the pin's bearing")] = None
    limiting_speed: Annotated[float | None, Quantity("n_lim", "rpm", "Limiting speed of the pin's bearing", gt=0)] = None
    rolling_elements: Annotated[int | None, Quantity("Z_g", "1", "Rolling elements per row of the pin's bearing", ge=5, integer=True)] = None
    allowable_deflection: Annotated[float | None, size("[y]", "Allowable deflection of the pin", gt=0)] = None

    @property
    def supports(self) -> tuple[float, float]:
        """Return its supports from its end, m: the faces of the disc that holds it, or those of its span."""
        return (0.0, self.held) if self.held is not None else (self.span_start or 0.0, self.span_end or 0.0)

    @property
    def middle(self) -> float:
        """Return the middle of its bearing from its end, m."""
        return self.plane if self.held is None else self.held + self.plane

    @property
    def length(self) -> float:
        """Return its length, m: as far beyond the bearing's middle as that is beyond the disc, or beyond both supports alike."""
        return sum(self.supports) if self.held is None else self.held + 2 * self.plane


class MotorKeys(Block):
    """A motor, whose shaft and bearings are its maker's."""

    speed: Annotated[float, Quantity("n_m", "rpm", "Speed of the motor under load", gt=0)]
    radial_force: Annotated[float | None, Quantity("[F_r]", "N", "Radial force that the maker allows on its shaft", gt=0)] = None


class PartKeys(Block):
    """A part on a shaft: the first key is its kind, and that key's value its name."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(*((kind,) for kind in PART_KINDS)),)

    bearing: Annotated[str | None, Text("Name of a bearing")] = None
    gear: Annotated[str | None, Text("Name of a gear")] = None
    pulley: Annotated[str | None, Text("Name of a pulley")] = None
    sprocket: Annotated[str | None, Text("Name of a sprocket")] = None
    flywheel: Annotated[str | None, Text("Name of a flywheel")] = None
    clutch: Annotated[str | None, Text("Name of a clutch")] = None
    coupling: Annotated[str | None, Text("Name of a coupling")] = None
    brake: Annotated[str | None, Text("Name of a brake")] = None
    crank: Annotated[str | None, Text("Name of a crank")] = None
    rocker: Annotated[str | None, Text("Name of a rocker")] = None
    geneva_wheel: Annotated[str | None, Text("Name of a Geneva wheel")] = None
    cam: Annotated[str | None, Text("Name of a cam")] = None
    load: Annotated[str | None, Text("Name of a free force")] = None
    at: Annotated[float, size("x", "Middle of the hub or bearing, from the shaft's left end", ge=0)]
    hub: Annotated[float | None, size("l_H", "Length of the hub", gt=0)] = None
    key: Annotated[float | None, size("l", "Length of the parallel key", gt=0)] = None
    key_count: Annotated[int, Quantity("i", "1", "Number of keys around the shaft", ge=1, le=2, integer=True)] = 1
    key_form: Annotated[Literal["A", "B"], Text("Form of the key's ends")] = "A"
    integral: Annotated[bool, Text("Cut on the shaft")] = False
    bolted: Annotated[bool, Text("Bolted to a flange")] = False
    interference: Annotated[float | None, size("U", "Interference of a press fit", gt=0)] = None
    brake_torque: Annotated[float | None, Quantity("M_b", "N*m", "Torque of a brake, on its shaft", gt=0)] = None
    stops_per_hour: Annotated[float | None, Quantity("z_b", "1/h", "Stops of the machine by the brake", ge=0)] = None
    rides_on: Annotated[str | None, Text("Part that carries it, so that it is fixed to the shaft by nothing")] = None
    fit: Annotated[str, Text("Fit of the seat")] = "k6"
    stop: Annotated[Literal["shoulder", "ring", "sleeve", "nut", "press"] | None, Text("What holds it along the shaft")] = None
    designation: Annotated[str | None, Text("Designation of the bearing")] = None
    floating: Annotated[bool, Text("Bearing that does not hold the shaft along its axis")] = False
    of: Annotated[str | None, Text("Port of a mechanism, such as drive.crank")] = None
    pin: PinKeys | None = None
    plane: Annotated[float | None, size("x_p", "Plane of its force, beyond the disc's outer face")] = None
    width: Annotated[float | None, size("b", "Width of the body; of a bearing without a catalogue its own", gt=0)] = None
    bore: Annotated[float | None, size("d_i", "Bore of the body; of a bearing without a catalogue its own", ge=0)] = None
    outside: Annotated[float | None, size("D", "Outside diameter; of a bearing without a catalogue its own", gt=0)] = None
    corner: Annotated[float | None, size("r_s", "Least corner of the inner ring of a bearing without a catalogue", gt=0)] = None
    fill: Annotated[float, Quantity("k_f", "1", "Share of a full disc", gt=0, le=1)] = 1
    accepted: Accepted | None = None


class ShaftKeys(Block):
    """A shaft with its parts."""

    sections: Annotated[list[SectionKeys], Text("Sections from left to right")] = []  # noqa: RUF012
    left: Annotated[float | None, size("x_0", "Axial place of the left end")] = None
    motor: MotorKeys | None = None
    parts: Annotated[list[PartKeys], Text("Parts on the shaft")]


class MeshKeys(Block):
    """A pair of gears."""

    pair: Annotated[list[str], Text("Driving and driven gear, as SHAFT.GEAR"), Field(min_length=2, max_length=2)]
    teeth_1: Annotated[int, Quantity("z_1", "1", "Teeth of the driving gear", ge=5, integer=True)]
    teeth_2: Annotated[int, Quantity("z_2", "1", "Teeth of the driven gear", ge=5, integer=True)]
    module: Annotated[float, size("m", "Normal module", gt=0)]
    width: Annotated[float, size("b", "Common face width", gt=0)]
    helix_angle: Annotated[float, Quantity("β", "deg", "Helix angle, positive where the driving gear is right-handed", ge=-30, le=30)] = 0
    efficiency: Annotated[float, Quantity("η", "1", "Efficiency of the mesh", ge=0.85, le=1)] = 0.97
    teeth_present: Annotated[int | None, Quantity("z_p", "1", "Teeth of a sector", ge=1, integer=True)] = None
    accepted: Accepted | None = None


class ChainKeys(Block):
    """Chains between two shafts, or from sprockets to what a mechanism moves."""

    sprockets: Annotated[list[str], Text("Driving sprockets side by side, as SHAFT.SPROCKET"), Field(min_length=1, max_length=4)]
    to: Annotated[list[str], Text("Driven sprockets")] = []  # noqa: RUF012
    teeth_1: Annotated[int, Quantity("z_1", "1", "Teeth of the driving sprocket", ge=6, le=150, integer=True)]
    teeth_2: Annotated[int | None, Quantity("z_2", "1", "Teeth of the driven sprocket", ge=6, le=150, integer=True)] = None
    chain: Annotated[Literal["08B", "10B", "12B", "16B", "20B", "24B"], Text("Chain of ISO 606, series B")]
    links: Annotated[int, Quantity("X", "1", "Number of links", ge=8, le=100_000, integer=True)]
    direction: Annotated[float | None,
        Quantity("α_c", "deg", "Direction in the frame in which a chain over idlers pulls its sprocket, from x", ge=-360, le=360)] = None
    moves: Annotated[str | None, Text("What the chains move: MECHANISM.cylinder or MECHANISM.conveyor")] = None
    accepted: Accepted | None = None


class BeltKeys(Block):
    """A V-belt drive."""

    spread: ClassVar[Mapping[str, tuple[str, ...]]] = {}

    pulleys: Annotated[list[str], Text("Driving and driven pulley, as SHAFT.PULLEY"), Field(min_length=2, max_length=2)]
    section: Annotated[Literal["SPZ", "SPA", "SPB", "SPC"], Text("Section of the belt")]
    diameter_1: Annotated[float, size("d_1", "Datum diameter of the driving pulley", gt=0)]
    diameter_2: Annotated[float, size("d_2", "Datum diameter of the driven pulley", gt=0)]
    length: Annotated[float, size("L", "Datum length of the belt (ISO 4184)", gt=0)]
    count: Annotated[int | None, Quantity("z", "1", "Number of belts", ge=1, le=32, integer=True)] = None
    tension: Annotated[float | None, Quantity("F_T", "N", "Static tension of one belt", gt=0)] = None
    accepted: Accepted | None = None
