"""The example press: its phases as the derivation of the cyclogram prints them, and what its lines move, as it calculates them."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np

from diecut_report.config import yaml
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle
from diecut_report.mechanics import four_bar
from diecut_report.mechanics.timing.clearance import Station
from diecut_report.mechanics.timing.engagement import inertia_at_crank
from diecut_report.mechanics.timing.intervals import DrivenLine, Intervals, complement
from diecut_report.results.warm_press import WarmPress
from tests.configs import MECHANISMS
from tests.machines import number

COMMON = Fraction(2)  # two sheets
PERIOD = 4 * np.pi
TURN = 2 * np.pi
CRANK, SHAFT = Fraction(1, 2), Fraction(1)  # turns a sheet: of the cylinder's drive, of the transports

EDGES: dict[str, tuple[tuple[float, float], ...]] = {  # degrees of the line's own shaft
    "forward": ((18.8043, 203.0831),),
    "cutting": ((58.5873, 153.9490), (254.0129, 342.4182)),
    "contact": ((55.8619, 157.0511), (250.7741, 344.7650)),
    "carriage_window": ((5.3076, 32.8088), (184.7527, 221.7606)),
    "cam_dwell": ((0.0, 160.0),),
    "cam_passing": ((242.2268, 277.7732),),
    "geneva_moving": ((-60.0, 60.0),),
    "geneva_passing": ((-16.1740, 16.1740),),
}


def phase(name: str, offset: float = 0.0) -> Intervals:
    """A phase on the main shaft over two sheets, its line at an offset (degrees)."""
    turns = SHAFT if name.startswith(("cam", "geneva")) else CRANK
    own = tuple((np.radians(start), np.radians(end)) for start, end in EDGES[name])
    return DrivenLine(turns, np.radians(offset)).on_main_shaft(own, COMMON)


def dwell(transport: str, offset: float = 0.0) -> Intervals:
    """The dwell of a transport."""
    return phase("cam_dwell", offset) if transport == "cam" else complement(phase("geneva_moving", offset), PERIOD)


def in_degrees(intervals: Intervals) -> list[tuple[float, float]]:
    """The edges in degrees."""
    return [(float(np.degrees(start)), float(np.degrees(end))) for start, end in intervals]


@cache
def calculations() -> dict[str, Calculation]:
    """All mechanisms of the example press, the wheel of the Geneva drive with the inertia that the printed numbers were calculated with."""
    made = yaml.load(MECHANISMS)
    made.data["mechanisms"]["cross"]["driven_inertia"] = "3.57 kg*m**2"
    return WarmPress(is_advised=False).calculate(load_config(made, Discovery([]))).calculations


def of(mechanism: str, name: str) -> float:
    """A number of a mechanism."""
    return number(calculations()[mechanism], name)


def rotation(main_angle: Array) -> Array:
    """The rotation of the cylinder from its outer end."""
    found: Array = of("drive", "sector_ratio") * (
        _motion(main_angle / 2).rocker_direction - of("drive", "outer_direction")
    )
    return found


def _motion(crank_angle: Array) -> four_bar.LinkageMotion:
    ratios = (of("drive", f"inputs.{key}_ratio") for key in ("frame", "coupler", "rocker"))
    return four_bar.motion(crank_angle, *ratios)


def crank_inertia(crank_angle: Array, *, balanced: bool = False) -> Array:
    """The inertia of the cylinder that its crank feels."""
    motion = _motion(np.asarray(crank_angle))
    ratio = of("drive", "sector_ratio")
    unbalance = 0.0 if balanced else of("drive", "inputs.static_unbalance")
    rolling = (of("drive", f"inputs.cylinder_{key}") for key in ("inertia", "mass", "radius"))
    turned = ratio * (motion.rocker_direction - of("drive", "outer_direction"))
    found: Array = inertia_at_crank(*rolling, unbalance, 0.0, turned, ratio * motion.rocker_speed_ratio)
    return found


def dead_centers() -> Array:
    """The crank angles where the cylinder stands."""
    return np.array([of("drive", "dead_center_outer"), of("drive", "dead_center_inner")])


def displacement(transport: str, offset: float, main_angle: Array) -> Array:
    """The way of the carriages, counted from a rest; the offset in degrees."""
    mechanism, start = ("feeder", 0.0) if transport == "cam" else ("cross", of("cross", "sheet_step") / 2)
    turned = (main_angle - np.radians(offset)) / TURN
    share = turned % 1
    handle = CurveHandle(calculations()[mechanism], "sheet_position")
    way = handle.values(share[None], np.clip(share, 1e-9, 1 - 1e-9)[None], None)[0]
    found: Array = way - start + (turned - share) * of("cross", "sheet_step")
    return found


def station(stop: float, *, with_feed: bool = True) -> Station:
    """The cylinder over carriages of 20 mm that stand at a place (m)."""
    radius, height = of("drive", "inputs.cylinder_radius"), of("drive", "inputs.segment_height")
    half_angle = float(np.arccos(1 - height / radius))
    return Station(radius, half_angle, of("drive", "stroke"), with_feed, stop, of("cross", "sheet_step"), 0.020)
