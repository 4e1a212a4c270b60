"""What to change, in words with values that pass: roller, locking arc, clearance and speed."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np

from diecut_report.api import Phrase, below, phrase, told
from diecut_report.mechanics import common
from diecut_report.plugins.geneva_transport import formulas, loads

ACCEPTED_OVERLAP = 5e-6  # m, of the arms' tips and the disc: half of what the check accepts
THIN = 0.1  # share of the roller's radius that walls and tips keep, share of the room that a locking arc keeps from its ends
DIGITS = 3  # of a radius or a clearance that is named
POINTS = 361  # of the engagement, at which the overlap is tried


def usual_radius(crank: Any, roller: Any, flank: Any, rim: Any) -> Any:
    """Radius of the locking arcs where none is given."""
    deep = np.where(loads.is_deep_enough(crank, flank, rim), loads.half_crank(crank), loads.halfway(flank, rim))
    return np.where(loads.leaves_thick_tip(crank, roller, flank, rim), loads.thick_tip(crank, roller), deep)


def gaps(slots: float, center: float, rim: Any, locking: Any, disc: Any, alpha: Any) -> Any:
    """Gap between an arm's corner and the disc at angles from the middle of the motion, for arrays of drives."""
    ratio, step = formulas.crank_ratio(slots), formulas.step_angle(slots)
    tip = loads.tip_half_angle(center, rim, locking)
    place = loads.corner_place(formulas.wheel_angle(alpha, 0, step, ratio), 0, step, tip, slots)
    distance = common.third_side(center, rim, place)
    crank = formulas.crank_radius(ratio, center)
    hollow, radius = (loads.scaled(length, disc, crank) for length in (center, formulas.wheel_radius(slots, center)))
    along = loads.corner_along(center, rim, place, alpha)
    return loads.corner_gap(distance, disc, radius, loads.corner_to_hollow(distance, hollow, along))


def greatest_overlap(slots: float, center: float, rim: Any, locking: Any, disc: Any) -> Any:
    """Overlap of the arms' tips and the disc over the engagement, for arrays of drives; searched again around the least gap."""
    half = formulas.engagement_half_angle(slots)
    alpha = np.linspace(-half, half, POINTS)[:, None]
    least = alpha[np.argmin(gaps(slots, center, rim, locking, disc, alpha), axis=0), 0]
    near = least + np.linspace(-2, 2, POINTS)[:, None] * half / POINTS * 2
    return loads.overlap(gaps(slots, center, rim, locking, disc, np.clip(near, -half, half)).min(axis=0))


def passes(slots: float, center: float, clearance: float, roller: Any, locking: Any = None) -> Any:
    """Whether walls, tips, locking and cut-out are sound, for arrays of drives; the locking arc is the usual one where none is given."""
    ratio = formulas.crank_ratio(slots)
    crank, rim = formulas.crank_radius(ratio, center), formulas.rim_radius(formulas.wheel_radius(slots, center), roller)
    flank, edge = loads.flank_distance(crank, roller), loads.rim_distance(center, rim)
    arc = usual_radius(crank, roller, flank, edge) if locking is None else locking
    nearest = formulas.nearest_roller(center, ratio)
    wall = formulas.slot_spacing(slots, nearest) - 2 * roller
    sound = (
        (wall > THIN * roller)
        & (flank - arc > THIN * roller)
        & (arc - clearance > edge)
        & (roller < np.minimum(crank, nearest))
    )
    return sound & (greatest_overlap(slots, center, rim, arc, arc - clearance) <= ACCEPTED_OVERLAP)


def roller_that_fits(slots: float, center: float, clearance: float, roller: float, locking: float | None = None) -> str:
    """Words on the greatest smaller roller with which all is sound, among steps of a hundredth."""
    tried = np.array([below(roller * 1000 * share, DIGITS) for share in np.linspace(1, 0.02, 99)])
    fit = tried[passes(slots, center, clearance, tried / 1000, locking)]
    return Phrase("a roller_radius of {fit} mm", fit=f"{fit[0]:g}") if len(fit) else phrase("a greater center_distance")


def arc_that_fits(slots: float, center: float, clearance: float, roller: float, locking: float) -> str:
    """Words on the locking arc nearest to the present one with which all is sound."""
    ratio = formulas.crank_ratio(slots)
    flank = loads.flank_distance(formulas.crank_radius(ratio, center), roller)
    edge = loads.rim_distance(center, formulas.rim_radius(formulas.wheel_radius(slots, center), roller)) + clearance
    tried = np.array(
        [float(f"{1000 * (edge + (flank - edge) * share):.4g}") for share in np.linspace(THIN, 1 - THIN, 81)]
    )
    fit = tried[passes(slots, center, clearance, roller, tried / 1000)] if flank > edge else tried[:0]
    if not len(fit):
        return ""
    best = fit[np.argmin(abs(fit - locking * 1000))]
    return Phrase(
        "a locking_radius of {best} mm (tips {flank} thick), or ",
        best=f"{best:g}",
        flank=told(flank - best / 1000, "mm", 3),
    )


def clearance_that_fits(slots: float, center: float, roller: float, locking: float) -> str:
    """Words on the clearance that lets the locking disc reach the wheel."""
    room = locking - loads.rim_distance(center, formulas.rim_radius(formulas.wheel_radius(slots, center), roller))
    return (
        Phrase("take at most {room} mm", room=f"{below(room * 1000, DIGITS):g}")
        if room > 0
        else phrase("this arc does not reach the wheel")
    )


def slower_crank(speed: float, peak: float, allowed: float) -> str:
    """Words on the crank's speed at which the sheet keeps its allowed acceleration, which grows with its square."""
    return Phrase("a crank_speed of at most {speed}", speed=told(speed * sqrt(allowed / peak), "rpm", up=False))
