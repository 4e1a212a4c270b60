"""Arms of the rocker that pass all checks of the cams, in words: tried over a grid of arm angles and lengths."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from math import acos, cos, pi
from typing import Any, NamedTuple

import numpy as np

from diecut_report.api import Phrase, joined, outward, phrase, si
from diecut_report.mechanics import cam
from diecut_report.mechanics.motion_laws import LAWS, MotionLaw
from diecut_report.plugins.cam_gear_transport import formulas

# The search is the method's own: each arm's angle is for its own cam, with one length and the sweeps; advice keeps one proportion.
FACTORS = np.linspace(1, 0.05, 20)  # of lengths and sweeps that are tried
DEGREE = si(1, "deg")
CLEAR = 0.01 * DEGREE  # by which a pressure angle keeps its limit
DIGITS = 3  # of lengths and sweeps that are named
SOUND = 1.01  # by which radii keep theirs
PLACES = np.linspace(0, 1, 121)  # of the samples over a rise; the laws' joints are among them
TRIED = np.arange(1, 1800) / 10 * DEGREE  # every angle that ``_best`` may try, from the line O₁O₃ on one side of it
EIGHTHS = np.linspace(0, 1, 9)  # where the usual laws jump


def in_degrees(angle: float) -> float:
    """An angle as it is typed and printed."""
    return angle / DEGREE


class Rocker(NamedTuple):
    """What the cams follow from."""

    dwell: float
    held: float
    stop: float
    peak_velocity: float
    peak_acceleration: float
    least_return: float
    center_distance: float
    arm_length: float
    roller_radius: float
    arm_angle_1: float
    arm_angle_2: float
    accepted: float
    module: float = 0.0


TAKES = ("dwell_angle", "sector_dwell_sweep", "sector_stop_sweep", "law_peak_velocity", "law_peak_acceleration", "min_return_time",
         "center_distance", "arm_length", "roller_radius", "arm_angle_1", "arm_angle_2", "max_pressure_angle")  # fmt: skip


class ArmMotion(NamedTuple):
    """Samples over a cycle: the sector's angle, its speed in the cam's frame and its acceleration, both to the disc's."""

    angle: Any
    turn: Any
    bend: Any


def times(rocker: Rocker) -> tuple[float, float]:
    """Shares of stop and start, and of the return."""
    share = formulas.share_of_turn(rocker.dwell)
    stop = formulas.time_stop(rocker.peak_velocity, rocker.stop, formulas.constant_speed(rocker.held, share))
    return float(stop), float(formulas.time_return(share, stop))


def leaves_time(rocker: Rocker) -> bool:
    """Whether the return has its time."""
    return times(rocker)[1] >= rocker.least_return * (1 - 1e-9)


def motion(rocker: Rocker) -> ArmMotion:
    """The sector's motion by its law; by all with these peaks, should several have them."""
    laws = [law for law in LAWS.values() if (rocker.peak_velocity, rocker.peak_acceleration) == (law.B, law.A)]
    return ArmMotion(*map(np.concatenate, zip(*(_by_law(rocker, law) for law in laws), strict=True)))


def _by_law(rocker: Rocker, law: MotionLaw) -> ArmMotion:
    rise, back = times(rocker)
    joints = np.concatenate([EIGHTHS, law.breakpoints])
    sweep, k = (
        rocker.held + rocker.stop,
        np.clip(np.unique(np.concatenate([PLACES, joints - 1e-9, joints + 1e-9])), 0, 1),
    )
    position, velocity, acceleration = (
        np.broadcast_to(part(k), k.shape) for part in (law.position, law.velocity, law.acceleration)
    )
    starting = formulas.starting_angle(rocker.stop, position)
    dwelling = formulas.constant_speed(rocker.held, rocker.dwell) * np.ones_like(PLACES)
    return ArmMotion(
        np.concatenate([rocker.held * PLACES, starting + rocker.held * (k > 0.5),
                        formulas.returning_angle(rocker.held, rocker.stop, sweep, position)]),
        1 + np.concatenate([dwelling, rocker.stop / (2 * pi * rise) * velocity, -sweep / (2 * pi * back) * velocity]),
        np.concatenate([0 * dwelling, rocker.stop / (2 * pi * rise) ** 2 * acceleration, -sweep / (2 * pi * back) ** 2 * acceleration]),
    )  # fmt: skip


def pressure_angles(rocker: Rocker, cycle: ArmMotion, length: float, arms: Any) -> Any:
    """Greatest pressure angle of each arm angle; infinite where the arm crosses the line O₁O₃ or its cam undercuts or turns back."""
    direction = arms[:, None] + cycle.angle
    lowest = formulas.lowest_direction(arms, rocker.stop)
    beside = formulas.stays_on_one_side(lowest, formulas.highest_direction(lowest, rocker.held + rocker.stop))
    # an arm on the line O₁O₃, a roller that stands still: they do not pass
    with np.errstate(divide="ignore", invalid="ignore"):
        found = cam.pressure_angle(rocker.center_distance, length, direction, cycle.turn).max(axis=1)
        return np.where(beside & _sound(rocker, cycle, length, direction), found, np.inf)


def _sound(rocker: Rocker, cycle: ArmMotion, length: float, direction: Any) -> Any:
    """Whether the roller touches the profile of each arm angle once."""
    path = cam.roller_path(rocker.center_distance, length, direction, cycle.turn)
    swing = cam.swing_part(direction, cycle.turn, cycle.bend)
    curvature = cam.curvature(rocker.center_distance, length, cycle.turn, swing, path).max(axis=1)
    distance = cam.tangent_distance(rocker.center_distance, length, direction, cycle.turn, path).min(axis=1)
    return (SOUND * rocker.roller_radius * curvature < 1) & (distance > SOUND * rocker.roller_radius)


def _ends_allow(rocker: Rocker, cycle: ArmMotion, length: float, arms: Any) -> bool:
    """Whether any of these arm angles keeps the accepted pressure angle where the rocker moves with the disc alone.

    These are a few samples of the cycle, so that where none does the search over all of it is spared.
    """
    ends = np.unique(cycle.angle[cycle.turn == 1])
    with np.errstate(divide="ignore"):  # an arm on the line O₁O₃
        found = cam.pressure_angle(rocker.center_distance, length, arms[:, None] + ends, 1.0).max(axis=1)
    return bool(found.min() <= rocker.accepted)


def _best(rocker: Rocker, cycle: ArmMotion, length: float, arm: float, left: bool) -> tuple[float, float]:
    """An arm's angle that passes, in °, and its pressure angle: as it is, or the best; infinite where none passes."""
    limit = rocker.accepted - CLEAR
    if (np.sin(arm + rocker.held / 2) > 0) == left:
        own = float(pressure_angles(rocker, cycle, length, np.array([arm]))[0])
        if own <= limit:
            return in_degrees(arm), own
    if not _ends_allow(rocker, cycle, length, TRIED + (0 if left else pi)):
        return np.nan, np.inf
    angles = np.arange(1.0, 180.0) + (0 if left else 180) - 360 * (arm < 0)
    found = pressure_angles(rocker, cycle, length, angles * DEGREE)
    near = angles[np.argmin(found)] + np.arange(-9, 10) / 10
    fine = pressure_angles(rocker, cycle, length, near * DEGREE)
    angles, found = (angles, found) if found.min() <= limit else (near, fine)
    least = float(found.min())
    return float(round(angles[np.argmin(found)], 1)), least if least <= limit else np.inf


def fitting(rocker: Rocker) -> tuple[dict[str, str], float] | None:
    """Arm length and angles that pass, as they are to be given, only what changes; and the greatest pressure angle with them.

    At both ends of its swing the rocker moves with the disc alone; there no arm keeps the accepted angle over a swing of more
    than twice that angle.
    """
    if rocker.held + rocker.stop > 2 * rocker.accepted:
        return None
    cycle = motion(rocker)
    left = bool(np.sin(rocker.arm_angle_1 + rocker.held / 2) > 0)
    for factor in FACTORS:
        length = rocker.arm_length if factor == 1 else outward(rocker.arm_length * 1000 * factor, False, DIGITS) / 1000
        if factor < 1 and length <= rocker.roller_radius:
            return None  # the roller would cover the pin
        one, first = _best(rocker, cycle, length, rocker.arm_angle_1, left)
        if first == np.inf:
            continue
        other, second = _best(rocker, cycle, length, rocker.arm_angle_2, not left)
        if second < np.inf:
            values = (("arm_length", length * 1000, rocker.arm_length * 1000, " mm"), ("arm_angle_1", one, in_degrees(rocker.arm_angle_1), "°"),
                      ("arm_angle_2", other, in_degrees(rocker.arm_angle_2), "°"))  # fmt: skip
            changed = {key: f"{new:.6g}{sign}" for key, new, old, sign in values if new != old}
            if changed:
                return changed, max(first, second)
    return None


def narrower(rocker: Rocker) -> Iterator[tuple[dict[str, str], Rocker]]:
    """The same machine with both sweeps narrower at about the same shares of the turn, and what is to be given for that."""
    for factor in FACTORS[1:]:
        held = outward(in_degrees(rocker.held) * factor, False, DIGITS)
        stop = outward(held * rocker.stop / rocker.held, False, DIGITS)
        turned = held * DEGREE
        if rocker.module:
            together = formulas.teeth_together(rocker.center_distance, rocker.module)
            teeth = np.maximum(formulas.gear_teeth(together, turned, rocker.dwell), 1)
            turned = float(formulas.sweep_of_teeth(rocker.dwell, teeth, formulas.other_teeth(together, teeth)))
        tried = rocker._replace(held=turned, stop=stop * DEGREE)
        if leaves_time(tried):
            yield {"sector_dwell_sweep": f"{held:g}°", "sector_stop_sweep": f"{stop:g}°"}, tried


def _told(values: dict[str, str], greatest: float) -> str:
    forms = {True: "an {key} of {value}", False: "a {key} of {value}"}
    words = [Phrase(forms[key[0] == "a"], key=key, value=value) for key, value in values.items()]
    loaded = phrase(" (shorter arms raise the roller forces)") if "arm_length" in values else ""
    return Phrase(
        "take {words}: the greatest pressure angle is then {in_degrees}°{loaded}",
        words=joined(words, ", "),
        in_degrees=f"{in_degrees(greatest):.3g}",
        loaded=loaded,
    )


@lru_cache(maxsize=64)  # three checks ask for the same words
def arms_that_fit(*numbers: float) -> str:
    """Words on arms with which pressure angles, curvature and the way round the shaft pass; on narrower sweeps where none do."""
    rocker = Rocker(*numbers)
    if not leaves_time(rocker):
        return phrase("leave the return its time first")
    found = fitting(rocker)
    if found:
        return _told(*found)
    for sweeps, tried in narrower(rocker):
        found = fitting(tried)
        if found:
            return Phrase(
                "no arms pass with this dwell and these sweeps; {told}, and the gear is smaller, which raises "
                "the forces on teeth and rollers",
                told=_told(sweeps | found[0], found[1]),
            )
    return phrase("no arms pass with this dwell; take a shorter dwell_angle")


def angles_at_the_ends(center_distance: float, arm_length: float, held: float, sweep: float) -> str:
    """Words on the two arm angles with which the pressure angles at both ends of the swing are the least.

    There the rocker turns with the disc, and |cos ψ + a/R|/|sin ψ| is the same at both ends where the middle of the swing, at c,
    has cos c = −a/R·cos(sweep/2).
    """
    middle = in_degrees(acos(-min(arm_length / center_distance, 0.99) * cos(sweep / 2)))
    left, right = (angle - in_degrees(held) / 2 for angle in (middle, 360 - middle))
    return Phrase(
        "{left}° and {right}°, with which the pressure angles at both ends of the swings are the least",
        left=f"{left:.1f}",
        right=f"{right:.1f}",
    )
