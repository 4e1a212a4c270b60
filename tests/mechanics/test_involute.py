"""Involute teeth: against a rack that cuts them point by point, against each other rolling, and the tangent at 30° found by search."""

from __future__ import annotations

from math import cos, hypot, pi, radians, sin, tan

import numpy as np
import pytest
from scipy.optimize import brentq

from diecut_report.formulas import Array
from diecut_report.mechanics import involute
from diecut_report.mechanics.involute import RackCutTooth

TWENTY = radians(20)
TEETH = {
    "plain": RackCutTooth(35, 0.0, 1.25, 0.38, TWENTY),
    "shifted": RackCutTooth(19, 0.5, 1.25, 0.25, TWENTY),
    "negative": RackCutTooth(40, -0.3, 1.25, 0.38, TWENTY),
    "helical": RackCutTooth(22, 0.1, 1.25, 0.38, TWENTY, radians(25)),
    "undercut": RackCutTooth(8, 0.0, 1.25, 0.3, TWENTY),
    "steep": RackCutTooth(14, 0.3, 1.35, 0.2, radians(25)),
}
each_tooth = pytest.mark.parametrize("tooth", TEETH.values(), ids=TEETH)


def within_rack(tooth: RackCutTooth, along: Array, height: Array) -> Array:
    """Whether points (from the middle of a gap of the rack, above its datum line) lie in the rack's material."""
    pitch = pi / cos(tooth.helix_angle)
    along = abs((along + pitch / 2) % pitch - pitch / 2) * cos(
        tooth.helix_angle
    )  # to the nearest gap, in the normal section
    to_middle = pi / 2 - along  # from the middle of the rack's tooth
    alpha, rho, depth = tooth.pressure_angle, tooth.tip_radius, tooth.dedendum
    center_height = -(depth - rho)
    center = pi / 4 - (depth - rho) * tan(alpha) - rho / cos(alpha)  # of the rounding, from the middle of the tooth
    beyond = (to_middle - center) * cos(alpha) - (height - center_height) * sin(alpha)
    on_flank = beyond <= rho  # on the material's side of the straight flank
    in_corner = (to_middle > center) & (height < center_height)
    past = (to_middle - center) * sin(alpha) + (height - center_height) * cos(
        alpha
    ) < 0  # below where flank and rounding meet
    in_circle = np.hypot(to_middle - center, height - center_height) <= rho
    return np.where(in_corner & past, in_circle, on_flank) & (height >= -depth)


def cut_by_rack(tooth: RackCutTooth, radius: float) -> float:
    """Half the thickness that a rack leaves at a radius, as an angle: all its positions tried, the edge found by halving."""
    rolls = np.linspace(-1.6, 1.6, 3201)

    def is_cut(angle: float) -> bool:
        turned = angle + rolls  # the gear turns, the rack moves on by the arc of the reference circle
        along = radius * np.sin(turned) - tooth.reference_radius * rolls
        height = radius * np.cos(turned) - tooth.reference_radius - tooth.shift
        return bool(within_rack(tooth, along, height).any())

    low, high = 0.0, pi / tooth.teeth
    for _ in range(24):
        middle = (low + high) / 2
        low, high = (low, middle) if is_cut(middle) else (middle, high)
    return high


@each_tooth
def test_the_form_is_what_a_rack_leaves(tooth: RackCutTooth) -> None:
    radii = np.linspace(tooth.root_radius + 0.01, tooth.reference_radius + tooth.shift + 0.9, 17)
    expected = [cut_by_rack(tooth, radius) for radius in radii]
    np.testing.assert_allclose(tooth.half_angles(radii) * radii, expected * radii, atol=5e-5)


@each_tooth
def test_only_the_small_pinion_is_undercut(tooth: RackCutTooth) -> None:
    assert tooth.is_undercut is (tooth.teeth == 8)


def test_the_root_passes_into_the_flank_without_a_corner() -> None:
    tooth = TEETH["plain"]
    radii, angles = tooth.trochoid(2000)
    assert tooth.flank(radii[-1:])[0] == pytest.approx(angles[-1], rel=1e-12)
    ahead = tooth.flank(radii[-1:] + 1e-6)[0] - angles[-1]
    assert ahead / 1e-6 == pytest.approx((angles[-1] - angles[-2]) / (radii[-1] - radii[-2]), rel=1e-2)


@pytest.mark.parametrize(
    ("tooth", "module", "chord", "radius"),
    [("plain", 4, 8.40861, 2.15513), ("shifted", 4, 8.74921, 1.31613)],
)
def test_the_tangent_at_30_degrees_touches_where_the_sheet_says(
    tooth: str, module: float, chord: float, radius: float
) -> None:
    """Critical chord and curvature, found on the points of the root alone."""
    radii, angles = TEETH[tooth].trochoid(20001)
    x, y = radii * np.sin(angles), radii * np.cos(angles)
    slope = np.arctan2(-np.gradient(x), np.gradient(y))  # of the right flank against the tooth's centre line
    at = int(np.argmin(abs(slope - pi / 6)))
    assert 2 * x[at] * module == pytest.approx(chord, abs=2e-3)
    assert _curvature_radius(x, y, at) * module == pytest.approx(radius, rel=2e-3)


def _curvature_radius(x: Array, y: Array, at: int) -> float:
    """Radius of the circle through three points of a curve."""
    (ax, ay), (bx, by), (cx, cy) = ((x[i], y[i]) for i in (at - 300, at, at + 300))
    area = abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2
    return float(hypot(bx - ax, by - ay) * hypot(cx - bx, cy - by) * hypot(cx - ax, cy - ay) / (4 * area))


def flank(tooth: RackCutTooth, tip: float) -> tuple[Array, Array]:
    """Radii from the involute's start to the tip, and half the tooth's thickness there."""
    radii = np.linspace(tooth.trochoid()[0][-1], tip, 4001)
    return radii, tooth.half_angles(radii)


@pytest.mark.parametrize(
    ("teeth", "shifts", "helix"),
    [((35, 80), (0.0, 0.0), 0.0), ((19, 50), (0.5, 0.15), 0.0), ((22, 45), (0.2, -0.1), 20.0)],
)
def test_flanks_roll_without_gap_or_overlap(teeth: tuple[int, int], shifts: tuple[float, float], helix: float) -> None:
    """At any angle of the pinion the wheel stands at u times less, and the distance of the flanks is zero."""
    beta = radians(helix)
    pinion, wheel = (RackCutTooth(z, x, 1.25, 0.3, TWENTY, beta) for z, x in zip(teeth, shifts, strict=True))
    wanted = float(involute.working_involute(pinion.alpha, TWENTY, *shifts, *teeth))
    alpha = brentq(lambda angle: tan(angle) - angle - wanted, 1e-6, 1.4, xtol=1e-15)
    distance = (pinion.reference_radius + wheel.reference_radius) * cos(pinion.alpha) / cos(alpha)
    working = [distance * z / sum(teeth) for z in teeth]
    halves = [
        float(gear.half_angles(np.array([radius]))[0]) for gear, radius in zip((pinion, wheel), working, strict=True)
    ]
    mine, other = (flank(gear, gear.reference_radius + 1 + x) for gear, x in zip((pinion, wheel), shifts, strict=True))
    for turn in np.linspace(-0.4, 0.4, 9) * 2 * pi / teeth[0]:
        own = mine[1] - halves[0] + turn  # of the right flank, clockwise from the line of centres
        across = mine[0] * np.sin(own), distance - mine[0] * np.cos(own)  # seen from the wheel's axis, which is above
        there = (
            halves[1] + turn * teeth[0] / teeth[1] - other[1]
        )  # of the left flank of the wheel's tooth, towards the same side
        reach = np.hypot(*across)
        meets = (reach >= other[0][0]) & (reach <= other[0][-1])
        gap = np.min(np.interp(reach[meets], other[0], there) - np.arctan2(*across)[meets])
        assert abs(gap) < 2e-6


def test_half_the_tooth_and_half_the_gap_make_the_pitch() -> None:
    """On the working circles of a pair without backlash the teeth fill each other's gaps."""
    alpha, teeth, shifts = TWENTY, (12, 24), (0.6, 0.36)
    inv_wt = float(involute.working_involute(alpha, TWENTY, *shifts, *teeth))
    working = brentq(lambda angle: tan(angle) - angle - inv_wt, 1e-6, 1.4, xtol=1e-15)
    halves = [involute.half_thickness(z, x, TWENTY, alpha, working) for z, x in zip(teeth, shifts, strict=True)]
    assert halves[0] * teeth[0] + halves[1] * teeth[1] == pytest.approx(pi, rel=1e-12)
