"""Involute teeth of external cylindrical gears: angles by ISO 21771, and the form that a rack with rounded tips cuts.

The form lies in a plane: the transverse section (``helix_angle`` is that of the gear) or the normal section of the virtual gear
(``helix_angle`` 0). There lengths are in normal modules, and angles are counted from the tooth's own centre line: half the tooth's
thickness at a radius, as an angle at the gear's axis. The rack is the basic rack of ISO 53: straight flanks at ``pressure_angle``,
its tips rounded with ``tip_radius``, ``dedendum`` from its datum line to the tips.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import as_angle, as_number, pi
from diecut_report.formulas.formula import formula

ROUNDING = 160  # points of a rack's rounded tip


@formula(printed_as="inv")
def involute(alpha: Any) -> Any:
    """Involute function: the angle by which an involute has turned where its pressure angle is ``alpha``."""
    return np.tan(alpha) - as_number(alpha)


@formula
def transverse_pressure_angle(pressure_angle: Any, helix_angle: Any) -> Any:
    """Pressure angle in the transverse section."""
    return np.arctan(np.tan(pressure_angle) / np.cos(helix_angle))


@formula
def working_involute(alpha: Any, pressure_angle: Any, shift_1: Any, shift_2: Any, teeth_1: Any, teeth_2: Any) -> Any:
    """Involute function of the working pressure angle of a pair without backlash; ``alpha`` is the transverse angle."""
    return involute(alpha) + 2 * np.tan(pressure_angle) * (shift_1 + shift_2) / (teeth_1 + teeth_2)


@formula
def tip_pressure_angle(teeth: Any, alpha: Any, helix_angle: Any, tip_height: Any) -> Any:
    """Transverse pressure angle at the tip, ``tip_height`` above the reference circle in normal modules."""
    return np.arccos(teeth * np.cos(alpha) / (teeth + 2 * tip_height * np.cos(helix_angle)))


@formula
def contact_ratio(teeth_1: Any, teeth_2: Any, tip_angle_1: Any, tip_angle_2: Any, working_angle: Any) -> Any:
    """Transverse contact ratio: length of the path of contact in base pitches."""
    approach = teeth_2 * (np.tan(tip_angle_2) - np.tan(working_angle))
    recess = teeth_1 * (np.tan(tip_angle_1) - np.tan(working_angle))
    return (recess + approach) / (2 * as_number(pi))


@formula
def least_shift(teeth: Any, alpha: Any, helix_angle: Any, pressure_angle: Any, dedendum: Any, tip_radius: Any) -> Any:
    """Profile shift below which the straight flank of the rack's tip undercuts the involute."""
    straight = dedendum - tip_radius * (1 - np.sin(pressure_angle))
    return straight - teeth * np.sin(alpha) ** 2 / (2 * np.cos(helix_angle))


@formula
def half_thickness(teeth: Any, shift: Any, pressure_angle: Any, alpha: Any, alpha_there: Any) -> Any:
    """Half the thickness of the involute tooth as an angle at the axis, where its pressure angle is ``alpha_there``."""
    at_reference = (as_number(pi) / 2 + 2 * shift * np.tan(pressure_angle)) / teeth
    return as_angle(at_reference + involute(alpha) - involute(alpha_there))


@dataclass(frozen=True)
class RackCutTooth:
    """A tooth of a gear that a rack has cut, in normal modules: its involute flank and the trochoid of its root."""

    teeth: float
    shift: float
    dedendum: float
    tip_radius: float
    pressure_angle: float
    helix_angle: float = 0.0

    @property
    def reference_radius(self) -> float:
        """Return the radius of the reference circle."""
        return float(self.teeth / (2 * np.cos(self.helix_angle)))

    @property
    def root_radius(self) -> float:
        """Return the radius of the root circle."""
        return self.reference_radius - self.dedendum + self.shift

    @property
    def alpha(self) -> float:
        """Return the pressure angle in the section."""
        return float(transverse_pressure_angle(self.pressure_angle, self.helix_angle))

    def flank(self, radii: Array) -> Array:
        """Return half the thickness of the involute as angles; infinite within the base circle, where there is none."""
        base = self.reference_radius * np.cos(self.alpha)
        there = np.arccos(base / np.maximum(radii, base))
        found = half_thickness(self.teeth, self.shift, self.pressure_angle, self.alpha, there)
        return np.where(radii < base * (1 - 1e-12), np.inf, found)

    @property
    def is_undercut(self) -> bool:
        """Return whether the rack's tip cuts away some of the involute above the base circle."""
        least = least_shift(
            self.teeth, self.alpha, self.helix_angle, self.pressure_angle, self.dedendum, self.tip_radius
        )
        return bool(self.shift < least)

    def trochoid(self, points: int = ROUNDING) -> tuple[Array, Array]:
        """Return radii and angles of the root that the rack's rounded tip cuts, from the root circle upwards.

        A point of the rack cuts where its normal goes through the pitch point, on which reference circle and rack roll.
        """
        turned = np.linspace(np.pi / 2, self.pressure_angle, points)  # of the tip's normal against the datum line
        height = -(self.dedendum - self.tip_radius) - self.tip_radius * np.sin(turned) + self.shift
        along = (self._tip_center - self.tip_radius * np.cos(turned)) / np.cos(self.helix_angle)
        across = height / np.tan(turned) * np.cos(self.helix_angle)
        rolled = (across - along) / self.reference_radius
        radii, angles = np.hypot(across, self.reference_radius + height), self._direction(across, height) - rolled
        rising = np.maximum.accumulate(radii) <= radii * (1 + 1e-12)
        return radii[rising], angles[rising]

    def half_angles(self, radii: Array) -> Array:
        """Return half the thickness of the tooth as angles: root, then flank; where the tooth is undercut the thinner of both."""
        low, angles = self.trochoid()
        root = np.interp(radii, low, angles, left=np.pi / self.teeth, right=np.inf)
        flank = self.flank(radii)
        if not self.is_undercut:
            flank = np.where(radii < low[-1], np.inf, flank)
        return np.minimum(np.minimum(flank, root), np.pi / self.teeth)

    @property
    def _tip_center(self) -> float:
        """Distance of the rounding's centre from the tooth's centre line, along the datum line in the normal section."""
        straight = (self.dedendum - self.tip_radius) * np.tan(self.pressure_angle)
        return float(np.pi / 4 + straight + self.tip_radius / np.cos(self.pressure_angle))

    def _direction(self, across: Array, height: Array) -> Array:
        return np.asarray(np.arctan2(across, self.reference_radius + height))
