"""What two mechanisms of a press must have in common, found in plain code."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    Cell,
    Chapter,
    Curve,
    GivenMechanism,
    ListedColumn,
    Phrase,
    Refusal,
    computed,
    named,
    phrase,
    told,
)
from diecut_report.mechanics.numerics import first
from diecut_report.mechanics.timing.engagement import (
    Slip,
    SlippingClutch,
    inertia_at_crank,
    motor_response,
    slip,
    worst_slip,
)
from diecut_report.mechanics.timing.shaft_curves import PieceRows

# fmt: off

# share by which the driving side of a clutch on the crank's shaft may be faster or slower than the crank
ONE_SHAFT = 0.1
SAME = 1e-6  # relative difference of two speeds that are one
TURN = 2 * np.pi
ROLLED = ("cylinder_inertia", "cylinder_mass", "cylinder_radius", "static_unbalance", "shafts_inertia")
CLUTCH = ("clutch_torque", "clutch_load", "clutch_speed", "clutch_ratio")
TAKES = (
    "cylinder_rotation",
    "cylinder_speed",
    "crank_speed",
    "dead_center_outer",
    "dead_center_inner",
    *ROLLED,
    *CLUTCH,
)
PIECES_OF_CRANK = 16  # of a turn of the crank, at least
TOGETHER = 64  # machines whose engagements are tried together, as each takes many places


def engagement(given: Mapping[str, Any]) -> Slip:
    """Return the engagement of each machine, at the angle that is given, else the one with most heat; shapes (machines,)."""
    series = _inertia(given)
    parts = np.array_split(np.arange(series.count), -(-series.count // TOGETHER))
    found = [_of_part(given, series, part) for part in parts]
    return Slip(*(np.concatenate([getattr(each, name) for each in found]) for name in Slip.__dataclass_fields__))


def _of_part(given: Mapping[str, Any], series: PieceRows, machines: Any) -> Slip:
    """The engagements of some of the machines: of a clutch on another shaft, as of one at the crank."""

    def inertia(angle: Any, machine: Any) -> Any:
        return np.maximum(series.at(angle / TURN % 1, machines[machine]), 0.0)

    torque, load, speed, ratio = (given[name][machines, 0] for name in CLUTCH)
    clutch = SlippingClutch(torque * ratio, load * ratio, speed / ratio)
    ends = np.concatenate([given["dead_center_outer"], given["dead_center_inner"]], axis=1)[machines]
    if "engagement_angle" in given:
        return slip(inertia, ends, clutch, given["engagement_angle"][machines, 0])
    return worst_slip(inertia, ends, clutch)


def _inertia(given: Mapping[str, Any]) -> PieceRows:
    """The inertia at the crank as series on the smooth pieces of its turn: sampled once."""
    rotation, speed = given["cylinder_rotation"], given["cylinder_speed"]
    numbers = [given[name] for name in ROLLED]
    count = len(given["crank_speed"])

    def at(share: Any, middle: Any, machine: Any) -> Any:
        turned, rate = (curve.values(share, middle, machine) for curve in (rotation, speed))
        return inertia_at_crank(*(number[machine] for number in numbers), turned, rate / given["crank_speed"][machine])

    places = [np.broadcast_to(curve.breakpoints, (count, curve.breakpoints.shape[1])) for curve in (rotation, speed)]
    return PieceRows.of(at, np.concatenate(places, axis=1), PIECES_OF_CRANK)


Keys = dict[str, tuple[str, str]]
Judge = Callable[[Any, Any], Any]
ROUNDED = 0.01  # share by which a value may have been rounded where it was typed again
SIZES: Keys = {"cylinder_radius": ("radius", "mm"), "rolling_radius": ("radius", "mm"), "segment_height": ("segment_height", "mm"),
               "cylinder_length": ("generatrix_length", "mm")}
LOADS: Keys = {"cylinder_mass": ("mass", "kg"), "mass": ("mass", "kg"), "cylinder_inertia": ("inertia", "kg*m**2"), "inertia": ("inertia", "kg*m**2"),
               "static_unbalance": ("static_unbalance", "kg*m"), "cutting_arc_fraction": ("cutting_arc_fraction", "1")}
"""By the keys of the others: results of the cylinder that a key is, and those that it is at least, as the carriages are in it, too."""


def _is_another(own: Any, sized: Any) -> Any:
    return np.abs(own - sized) > ROUNDED * np.abs(sized)


def _is_less(own: Any, sized: Any) -> Any:
    return own < sized * (1 - ROUNDED)


def _counted(cylinder: GivenMechanism, *others: GivenMechanism, keys: Keys, is_wrong: Judge) -> Any:
    """How many values of the others are wrong beside those of the cylinder that is sized, of all machines."""
    pairs = ((other.numbers(key), cylinder.numbers(result)) for other in others for key, (result, _) in keys.items())
    wrong = (is_wrong(own, sized) for own, sized in pairs if own is not None and sized is not None)
    return sum(wrong, np.zeros((cylinder.count, 1)))


def _listed(cylinder: GivenMechanism, *others: GivenMechanism, keys: Keys, is_wrong: Judge) -> str:
    """These values in words."""
    found = []
    for other, (key, (result, unit)) in product(others, keys.items()):
        own, sized = other.number(key), cylinder.number(result)
        if own is not None and sized is not None and is_wrong(own, sized):
            found.append(_told(f"{other.name}.{key}", own, sized, unit))
    return Phrase("{values}", values=named(found, ", "))


def _told(key: str, own: float, sized: float, unit: str) -> str:
    return Phrase("{key} {own} (the cylinder: {sized})", key=key, own=told(own, unit, 4), sized=told(sized, unit, 4))


sizes = Chapter("Cylinder of the press", needs=("cylinder",),
    text="The drive and the dampers move the cylinder that is sized; where they are given another one, their results are not those of this press. "
        "What moves with the cylinder may add to its mass and its moments.",
    absent="not calculated: there is no cylinder to use, or there are several")
for needs, lacks in ((("drive", "damper"), ()), (("drive",), ("damper",)), (("damper",), ("drive",))):
    forms: dict[str, Any] = {"needs": needs, "lacks": lacks, "output": False}
    sizes.cylinder_sizes_apart = (computed(partial(_counted, keys=SIZES, is_wrong=_is_another), ("cylinder", *needs), "compared one by one",
        **forms), "N_s", "1", "Number of sizes that are not those of the cylinder")
    sizes.cylinder_loads_short = (computed(partial(_counted, keys=LOADS, is_wrong=_is_less), ("cylinder", *needs), "compared one by one", **forms),
        "N_l", "1", "Number of masses and moments that are less than those of the cylinder")
    sizes.words("cylinder_sizes", partial(_listed, keys=SIZES, is_wrong=_is_another), ("cylinder", *needs), needs=needs, lacks=lacks)
    sizes.words("cylinder_loads", partial(_listed, keys=LOADS, is_wrong=_is_less), ("cylinder", *needs), needs=needs, lacks=lacks)


Array = NDArray[np.float64]
PARTS, LOOKS_CLOSER = 32, 8  # of a bracket, and how often it is looked at closer
LOOKS = 181  # places of a stroke at which its speed is looked at
INNER = ("displacement", "velocity", "stroke", "dead_center_outer", "dead_center_inner")


def _at(curve: Curve, angle: Array) -> Array:
    share = angle / TURN % 1
    return curve.values(share, share, None)


def _first(passed: Callable[[Array], NDArray[np.bool_]], low: Array, high: Array) -> Array:
    """The angle from which a condition holds that does not hold at the low one."""
    return first(lambda angles, _: passed(angles), low[:, 0], high[:, 0], PARTS, LOOKS_CLOSER)[1][:, None]


def speed_at(displacement: Curve, velocity: Curve, start: Array, end: Array, place: Array) -> Array:
    """Speed where a stroke comes to a place."""
    rises = _at(displacement, start) < _at(displacement, end)
    angle = _first(lambda x: (_at(displacement, x) >= place) == rises, start, end)
    return np.abs(_at(velocity, angle))


def way_below(displacement: Curve, velocity: Curve, start: Array, end: Array, speed: Array, stroke: Array) -> Array:
    """Way to the end of a stroke from where its speed last is the given one."""
    angles = start + (end - start) * np.linspace(0, 1, LOOKS)
    fast = np.abs(_at(velocity, angles)) >= speed
    last = LOOKS - 2 - np.argmax(fast[:, -2::-1], axis=1)[:, None]
    low, high = (np.take_along_axis(angles, each, axis=1) for each in (last, last + 1))
    angle = _first(lambda x: np.abs(_at(velocity, x)) < speed, low, high)
    way = np.abs(_at(displacement, end) - _at(displacement, angle))
    return np.where(fast.any(axis=1, keepdims=True), way, stroke)


PIECES_OF_OUTPUT = 8  # of each turn of the drive train's output, at least


def response(given: Mapping[str, Any]) -> PieceRows:
    """Return the torque of each machine's motor at the flywheel's shaft, over shares of the load's period."""
    period, lag = given["load_period"][:, 0], given["time_constant"][:, 0]
    return motor_response(load_of(given["flywheel_torque"], given["load_turns"]), period, lag)


def load_of(torque: Curve, turns: Any) -> PieceRows:
    """Return the load of each machine over shares of its period; its turns (machines, 1)."""
    count = len(turns)
    places = np.broadcast_to(torque.breakpoints, (count, torque.breakpoints.shape[1]))
    return PieceRows.of(torque.values, places, PIECES_OF_OUTPUT * int(np.nanmax(turns)))


TIMES = (
    ListedColumn("what", "Quantity"), ListedColumn("time", "At the productivity", "t", "ms"),
    ListedColumn("actual_time", "At the rate given by the gears", "t_a", "ms"),
)  # fmt: skip
DWELL, MOVING = "dwell", "moving"  # phases of a Geneva wheel
PHASE, MARGIN_START, MARGIN_END, PHASE_TIME = 1, 5, 6, 7  # columns of the cyclogram's tables


def lines_out_of_step(drives: tuple[str, ...], single_position: bool, timing: GivenMechanism) -> float:
    """Return how many lines lose their offset to the others where the clutch engages; Refusal where one is named that is not a line."""
    lines = timing.texts("lines.mechanism")
    strange = next((name for name in drives if name not in lines), None)
    if strange is not None:
        raise Refusal(
            "clutch_drives",
            Phrase(
                "names {strange}, which is not a line of {name}; these are {lines}",
                strange=strange,
                name=timing.name,
                lines=named(lines, ", "),
            ),
        )
    return 0.0 if single_position or set(drives) == set(lines) else float(len(set(drives)))


def dwell_margins(timing: GivenMechanism, wheel: GivenMechanism) -> list[float]:
    """The margins of what must lie within the dwell, or apart from the motion, of the wheel, whichever of both is named first."""
    turns = dict(zip(timing.texts("lines.mechanism"), timing.parts("line_turns"), strict=True))
    sides = (timing.texts(f"interlocks.{side}") for side in ("phase", "within", "apart_from"))
    rests = [
        _of(within, wheel.name) == DWELL or (apart and MOVING in (_of(phase, wheel.name), _of(apart, wheel.name)))
        for phase, within, apart in zip(*sides, strict=True)
    ]
    return [
        turns[wheel.name] * margin for rest, margin in zip(rests, timing.parts("margin_least"), strict=True) if rest
    ]


def _of(named: str, line: str) -> str:
    """The phase that a name means, be it of all its turns or of a numbered one; empty where it is another line's."""
    home, _, phase = named.partition(".")
    return phase.partition(".")[0] if home == line else ""


def listed(drives: tuple[str, ...]) -> str:
    """Return the lines that a clutch drives, by their names."""
    return Phrase("{names}", names=", ".join(drives))  # a text alone would be translated where it is a word, too


def times(given: Mapping[str, Any]) -> Iterator[tuple[Cell, ...]]:
    """Return the times of a sheet, of all phases and of all margins, at the productivity and at the actual rate."""
    timing: GivenMechanism = given["timing"]
    slower = float(given["productivity"][0, 0] / given["actual_rate"][0, 0])
    for what, time in _times(timing):
        yield what, time, None if time is None else time * slower


def _times(timing: GivenMechanism) -> Iterator[tuple[str, float | None]]:
    yield phrase("sheet"), timing.number("sheet_time")
    yield phrase("common period"), timing.number("period_time")
    for row in timing.listing("main_phases"):
        yield phrase(str(row[PHASE])), _number(row[PHASE_TIME])
    for row in timing.listing("margins"):
        yield Phrase("{row}, margin at the start", row=row[0]), _number(row[MARGIN_START])
        yield Phrase("{row}, margin at the end", row=row[0]), _number(row[MARGIN_END])


def _number(cell: Cell) -> float | None:
    return cell if isinstance(cell, float) else None
