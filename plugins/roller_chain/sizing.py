"""The chain that is left out: the smallest of ISO 606, series B, whose safeties and joints hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Chapter, Curve, case, choice, computed, inner, m, pick, si
from diecut_report.mechanics import drive_line
from diecut_report.plugins.roller_chain import steps
from diecut_report.plugins.roller_chain.chains import CHAINS
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, DRIVE, OVERRIDES
from diecut_report.plugins.roller_chain.steps import INCH, STILL

Array = NDArray[np.float64]
POINTS = 129  # of each smooth piece of a curve over the cycle
SAME = 1e-6  # relative: pitches so near are one
MARGIN = 1e-4  # relative: what the curve may rise between them
TABLE = {column.name: np.array([si(value, column.unit) for value in column.values]) for column in CHAINS.columns}
"""The chains' values, SI, in their order."""
ALWAYS = ("teeth_1", "driven_teeth", "distance_wanted", "links_wanted", "strands", "sag", "inclination", "pretension", "application",
          "required_safety_dynamic", "required_safety_static", "pressure_allowed")  # fmt: skip
CONVEYED = ("moving_mass", "driven_inertia", "friction_coefficient", "process_force")
CURVES = ("torque_curve", "acceleration_curve", "velocity_curve")

Known = Mapping[str, Any]


def least_pitch(known: Known) -> Array:
    """Pitch of the smallest chain that holds, shape (variants, 1); 0 where none does."""
    found = np.zeros(np.shape(known["teeth_1"]))
    for row in reversed(range(len(TABLE["pitch"]))):
        own = {name: values[row] for name, values in TABLE.items()}
        found = np.where(_holds(known, own), own["pitch"], found)
    return found


def _holds(known: Known, own: Known) -> Any:
    """Whether the safeties and the joints of a chain hold, of each machine."""
    peak, static = _tensions(known, own)
    held = own["breaking_load"] >= known["required_safety_dynamic"] * peak
    held = held & (own["breaking_load"] >= known["required_safety_static"] * static)
    area = steps.bearing_area(own["pin_diameter"], own["inner_width"], own["plate_thickness"])
    return held & ((known["pressure_allowed"] == 0) | (peak <= known["pressure_allowed"] * area))


def _tensions(known: Known, own: Known) -> tuple[Array, Array]:
    """Greatest tension and greatest static tension with a chain, each of shape (variants, 1); NaN where it does not go round."""
    pitch, mass = own["pitch"], own["mass_per_length"]
    teeth = known["teeth_1"], known["driven_teeth"]
    diameters = [drive_line.sprocket_diameter(pitch, z) for z in teeth]
    center, links = _loop(known, pitch, teeth)
    useful, velocity, angular = _motion(known, mass, links * pitch, diameters, pitch)
    always = steps.sag_tension(mass, center, known["sag"], known["inclination"])
    round_circles, shock = (
        steps.centrifugal(mass, velocity),
        steps.chordal(mass, center, steps.chordal_step(angular, pitch)),
    )
    fits = center > (diameters[0] + diameters[1]) / 2
    peak = steps.whole_tension(known["application"], useful, round_circles, always, shock, known["pretension"])
    static = steps.quiet_tension(useful, round_circles, always, known["pretension"])
    return _greatest(peak, fits), _greatest(static, fits)


def _greatest(over: Array, fits: Array) -> Array:
    """The greatest value over the cycle, a little more where it is sampled."""
    top = over.max(axis=1, keepdims=True)
    return np.where(fits, top * (1 + MARGIN) if over.shape[1] > 1 else top, np.nan)


def _loop(known: Known, pitch: float, teeth: tuple[Any, Any]) -> tuple[Array, Array]:
    """Distance of the axes and links, one of which is wanted; NaN where the links are too few."""
    wanted = known["distance_wanted"]
    from_distance = steps.even_links(steps.exact_links(np.where(wanted > 0, wanted, np.nan), pitch, *teeth))
    links = np.where(wanted > 0, from_distance, known["links_wanted"])
    free = drive_line.free_links(links, *teeth)
    inner = drive_line.links_discriminant(free, *teeth)
    room = np.where((inner > 0) & (free > 0), inner, np.nan)
    return np.where(wanted > 0, wanted, drive_line.chain_center_distance(pitch, free, room)), links


def _motion(
    known: Known, mass: float, length: Array, diameters: Sequence[Array], pitch: float
) -> tuple[Array, Array, Array]:
    """Useful tension, velocity and angular speed, each a number or over the cycle."""
    if "speed" in known:
        speed = known["speed"]
        torque = known["power"] / speed if "power" in known else _over(known, "torque")
        useful = steps.drive_tension(torque, known["strands"], diameters[0])
        return useful, steps.mean_velocity(known["teeth_1"], pitch, speed), speed
    velocity = _over(known, "velocity")
    hanging = steps.hanging_mass(known["moving_mass"], known["strands"], mass, length)
    total = steps.total_mass(hanging, known["driven_inertia"], diameters[1])
    against = steps.resistance(known["friction_coefficient"], hanging, known["process_force"])
    moving = abs(velocity) > STILL * abs(velocity).max(axis=1, keepdims=True)
    useful = steps.conveyor_tension(total, _over(known, "acceleration"), moving, against, known["strands"])
    return useful, velocity, velocity / (diameters[0] / 2)


def _over(known: Known, name: str) -> Array:
    """A number, or a curve at many places of the cycle, shape (variants, places): all curves at the same ones."""
    curve = known.get(f"{name}_curve")
    if curve is None:
        return np.asarray(known[name], dtype=float)
    places, middles = _places([known[key] for key in CURVES if key in known])
    return np.asarray(curve.values(places, middles, None), dtype=float)


def _places(curves: Sequence[Curve]) -> tuple[Array, Array]:
    """Places of the cycle in each smooth piece of all curves, with the middles of the pieces."""
    inner = _side_by_side([np.clip(curve.breakpoints, 0, 1) for curve in curves])
    ends = np.ones((len(inner), 1))
    edges = np.sort(np.concatenate([0 * ends, inner, ends], axis=1), axis=1)
    share = (1 - np.cos(np.linspace(0, np.pi, POINTS))) / 2
    places = edges[:, :-1, None] + np.diff(edges, axis=1)[:, :, None] * share
    middles = np.broadcast_to(((edges[:, :-1] + edges[:, 1:]) / 2)[:, :, None], places.shape)
    return places.reshape(len(edges), -1), middles.reshape(len(edges), -1)


def _side_by_side(parts: Sequence[Array]) -> Array:
    rows = max(len(part) for part in parts)
    return np.concatenate([np.broadcast_to(part, (rows, part.shape[1])) for part in parts], axis=1)


# fmt: off

WAYS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (DRIVE, ("speed", "torque")), (DRIVE, ("speed", "torque_curve")), (DRIVE, ("speed", "power")),
    *((CONVEYOR, (acceleration, velocity)) for acceleration in ("acceleration", "acceleration_curve") for velocity in ("velocity", "velocity_curve")),
)
"""What the load follows from."""


def _least(*names: str) -> Callable[..., Array]:
    """The choice, of numbers in the order of these names."""
    return lambda *taken: least_pitch(dict(zip(names, taken, strict=True)))


size = Chapter("Selection of the chain",
    text="If chain is omitted, each chain of the table is tried; the smallest one that satisfies both safety factors and the pressure of the joints "
        "is selected.")
size.driven_teeth = inner(m.teeth_2, needs=("teeth_2",), whole=True), "z_2", "1", "Teeth of the driven sprocket: as given", "input"
size.driven_teeth = inner(m.teeth_1, lacks=("teeth_2",), whole=True), "z_2", "1", "Teeth of the driven sprocket: those of the driving one", "input"
size.application = inner(m.application_factor, needs=("application_factor",)), "K_A", "1", "Application factor: as given", "input"
for chosen in ((DRIVE, "torque_curve"), (CONVEYOR,)):
    size.application = (inner(1, needs=chosen, lacks=("application_factor",)), "K_A", "1", "Application factor: the loads are dynamic ones",
        "this method")
WANTED = {"distance_wanted": ("center_distance", "a_w", "mm", "Centre distance"), "links_wanted": ("links", "X_w", "1", "Links"),
          "pressure_allowed": ("allowable_bearing_pressure", "p_w", "MPa", "Allowable pressure of the joints")}
for key, (given, symbol, unit, words) in WANTED.items():
    size[key] = inner(m.inputs[given], needs=(given,), lacks=("chain",)), symbol, unit, f"{words}: as given", "input"
    size[key] = inner(0, lacks=("chain", given)), symbol, unit, f"{words}: 0, since not given", "input"
for use, load in WAYS:
    names = (*ALWAYS, *load, *(CONVEYED if use == CONVEYOR else ()))
    size.pitch_least = (computed(function=_least(*names), takes=tuple(f"inputs.{name}" if name in load else name for name in names),
        method="all tensions below, with each chain of the table in turn, over the cycle where curves are given; 0 where none is sufficient",
        needs=(use, *load), lacks=("chain",), output=False), "p_min", "mm", "Pitch of the smallest sufficient chain")
for key in OVERRIDES:
    size.require(f"{key}_of_a_chain", m.teeth_1 < 0, key=key, needs=(key,), lacks=("chain",),
        message="has no use without a chain; give chain, or set chain to custom with pitch, pin_diameter, bearing_area, breaking_load and "
        "mass_per_length")
size.require("chain_exists", m.pitch_least > 0, key="chain", lacks=("chain",),
    message="is left out, and no chain from 08B to 24B is enough; give more strands, a larger sprocket or less load, or set chain to custom")
size.pitch = (pick("above", of="pitch_least", series=CHAINS.series("pitch"), lacks=("chain",)), "p", "mm", "Pitch: the smallest sufficient chain",
    "ISO 606")
INCHES = {name: pitch / 25.4 for name, pitch in CHAINS.by_name("pitch").items()}
size.designation = (choice(*(case(name, f"its pitch is {round(16 * inches):d}/16 inch",
    m.pitch / INCH <= round(inches + SAME, 6)) for name, inches in list(INCHES.items())[:-1]),
    case(CHAINS.names[-1], "its pitch is the largest"), lacks=("chain",)), "C", "1", "Selected chain", "ISO 606")
