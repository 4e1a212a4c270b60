"""The motion of planetary drive, crank-slider and crank-rocker: over a turn, at the contact, at the beginning of the grip, at the lowest point.

Each gives ``stroke``, ``lowest_angle``, ``working_angle``, ``contact_angle``, ``contact_rate``, ``grip_rate``,
``acceleration_end`` and the curves ``displacement``, ``velocity``, ``acceleration``, all under the drive's prefix.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Formula, Steps, Vary, as_angle, inner, m, pi, reduction, value
from diecut_report.mechanics import common, four_bar, slider_crank
from diecut_report.plugins.knife_drive import working

# fmt: off

NO_SPEED = ("grip_speed",)
RADIUS = "planetary.carrier_radius"
CRANK, ROD = "crank_slider.crank_radius", "crank_slider.rod_length"
ANGLES = {"contact": "contact_angle", "grip": "grip_begin"}

CONTACT = Steps()
CONTACT.contact_angle = m.lowest_angle - m.working_angle, "φ_t", "deg", "Crank angle of the contact at the table", "kinematics"
CONTACT.leave_angle = inner(m.lowest_angle + m.working_angle), "φ_a", "deg", "Crank angle at which the edge is at the table again", "symmetry"
GRIP = Steps()
GRIP.grip_begin = inner(m.lowest_angle - m.grip_angle), "φ_b", "deg", "Crank angle at which gripping begins", "004, after Fig. 3"

PLANETARY = Steps()
PLANETARY.stroke = 4 * m[RADIUS], "H_", "mm", "Stroke of the edge", "004 eq. 1"
PLANETARY.add(working.reaches(working.PLANETARY))
PLANETARY.displacement = 2 * m[RADIUS] * np.sin(m.crank_angle), "S_", "mm", "Displacement of the edge from the carrier's axis", "004 eq. 1"
PLANETARY.velocity = working.planetary_velocity.of(carrier_radius=m[RADIUS]), "V_", "m/s", "Velocity of the edge", "004 eq. 1"
PLANETARY.acceleration = (value(working.planetary_acceleration.of(carrier_radius=m[RADIUS]), source_symbol="W_"), "a_", "m/s**2",
    "Acceleration of the edge", "004 eq. 1")
PLANETARY.lowest_angle = 3 * pi / 2, "φ_0", "deg", "Crank angle of the lowest point", "004 eq. 1"
PLANETARY.working_angle = (2 * np.arcsin(np.sqrt(m.working_depth / (4 * m[RADIUS]))), "φ_w", "deg", "Crank angle of the working stroke",
    "004 eq. 1, solved")
PLANETARY.add(CONTACT)
PLANETARY.contact_rate = (inner(working.planetary_velocity.of(crank_angle=m.contact_angle, carrier_radius=m[RADIUS])), "v_t", "m/s",
    "Velocity of the edge as it meets the signature", "004 eq. 1")
PLANETARY.acceleration_end = (value(working.planetary_acceleration.of(crank_angle=m.lowest_angle, carrier_radius=m[RADIUS]), source_symbol="W_0"),
    "a_0", "m/s**2", "Acceleration of the edge at its lowest point", "004 eq. 1")
PLANETARY.add(GRIP)
PLANETARY.grip_rate = (inner(working.planetary_velocity.of(crank_angle=m.grip_begin, carrier_radius=m[RADIUS]), lacks=NO_SPEED), "v_g", "m/s",
    "Velocity of the edge when gripping begins", "004 eq. 1")


def _slider_at(chapter: Steps, place: str, symbol: str, when: str, lacks: tuple[str, ...] = ()) -> None:
    """The rod's angle and the edge's velocity at one place."""
    crank_angle = m[ANGLES[place]]
    chapter[f"{place}_rod_angle"] = (inner(slider_crank.coupler_angle.of(crank_angle=crank_angle), lacks=lacks), f"β_{symbol}", "deg",
        f"Angle of the rod to the knife's path {when}", "004 eq. 2")
    chapter[f"{place}_rate"] = (inner(slider_crank.velocity.of(crank_angle=crank_angle, coupler_angle=m[f"{place}_rod_angle"],
        crank_radius=m[CRANK]), lacks=lacks), f"v_{symbol}", "m/s", f"Velocity of the edge {when}", "004 eq. 2")


def _first_order(chapter: Steps, name: str, symbol: str, unit: str, word: str, approximate: Formula) -> None:
    """A curve to the first order of r/l, as textbooks have it, and how far it is from the exact one."""
    chapter[f"{name}_first_order"] = (approximate.of(crank_radius=m[CRANK]), f"{symbol}_1", unit,
        f"{word.capitalize()} of the edge, first-order in r/l", "004 eq. 2, to the first order")
    chapter[f"{name}_error"] = inner(m[name] - m[f"{name}_first_order"]), f"Δ{symbol}_", unit, f"Difference of exact and first-order {word}"
    chapter[f"{name}_difference"] = (reduction("abs_max", of=f"{name}_error"), f"Δ{symbol}_m", unit,
        f"Maximum difference of the first-order {word} from the exact one")


CRANK_SLIDER = Steps()
CRANK_SLIDER.require("rod_longer", m[CRANK] < m[ROD], key=ROD,
    message="is {crank_slider.rod_length}, not longer than the crank_radius of {crank_slider.crank_radius}: the crank cannot turn fully; make the "
    "rod longer than the crank, usually three to six times")
CRANK_SLIDER.rod_ratio = inner(m[ROD] / m[CRANK]), "λ_", "1", "Rod-to-crank ratio", "004 eq. 2"
CRANK_SLIDER.stroke = 2 * m[CRANK], "H_", "mm", "Stroke of the edge", "004 eq. 2"
CRANK_SLIDER.add(working.reaches(working.CRANK_SLIDER))
CRANK_SLIDER.rod_angle = inner(slider_crank.coupler_angle.of()), "β_", "deg", "Angle of the rod to the knife's path", "004 eq. 2"
CRANK_SLIDER.displacement = (slider_crank.displacement.of(coupler_angle=m.rod_angle, crank_radius=m[CRANK]), "S_", "mm",
    "Height of the edge above its lowest point", "004 eq. 2, corrected")
CRANK_SLIDER.velocity = slider_crank.velocity.of(coupler_angle=m.rod_angle, crank_radius=m[CRANK]), "V_", "m/s", "Velocity of the edge", "004 eq. 2"
CRANK_SLIDER.acceleration = (value(slider_crank.acceleration.of(coupler_angle=m.rod_angle, crank_radius=m[CRANK]), source_symbol="W_"), "a_",
    "m/s**2", "Acceleration of the edge", "004 eq. 2")
CRANK_SLIDER.lowest_angle = 2 * pi, "φ_0", "deg", "Crank angle of the lowest point: one revolution after φ = 0", "004 eq. 2"
CRANK_SLIDER.working_angle = (slider_crank.crank_angle_at.of(displacement=m.working_depth, crank_radius=m[CRANK], rod_length=m[ROD]), "φ_w", "deg",
    "Crank angle of the working stroke", "004 eq. 2, solved")
CRANK_SLIDER.add(CONTACT)
_slider_at(CRANK_SLIDER, "contact", "t", "as it meets the signature")
CRANK_SLIDER.acceleration_end = (value(m[CRANK] * m.crank_speed**2 * (1 + 1 / m.rod_ratio), source_symbol="W_0"), "a_0", "m/s**2",
    "Acceleration of the edge at its lowest point", "004 eq. 2 at φ = 0")
CRANK_SLIDER.add(GRIP)
_slider_at(CRANK_SLIDER, "grip", "g", "when gripping begins", NO_SPEED)
_first_order(CRANK_SLIDER, "displacement", "S", "mm", "height", slider_crank.displacement_first_order)
_first_order(CRANK_SLIDER, "velocity", "V", "m/s", "velocity", slider_crank.velocity_first_order)
_first_order(CRANK_SLIDER, "acceleration", "a", "m/s**2", "acceleration", slider_crank.acceleration_first_order)
CRANK_SLIDER.acceleration_difference_share = (m.acceleration_difference / m.acceleration_end, "δ_W", "1",
    "Maximum difference of the first-order acceleration, relative to the acceleration at the lowest point", "this method")


ARM = "crank_rocker.knife_arm"
OUTER, INNER = ("crank_rocker.lowest_dead_center=outer",), ("crank_rocker.lowest_dead_center=inner",)


def _either(
    steps: Steps, id: str, symbol: str, unit: str, description: str, at_outer: Any, at_inner: Any, **options: Any
) -> None:
    """A quantity with one formula for each dead centre that may be the lowest point."""
    steps[id] = value(at_outer, needs=OUTER, **options), symbol, unit, description
    steps[id] = value(at_inner, needs=INNER, **options), symbol, unit, description


def _speed_ratio(
    chapter: Steps,
    at: str, place: str = "", letter: str = "", when: str = "", lacks: tuple[str, ...] = ()
) -> None:
    """The linkage at a crank angle, up to the rocker's speed; ids begin with ``place``, symbols end with ``letter``."""
    own: dict[str, Any] = {"output": False, "lacks": lacks}
    chapter[f"{place}diagonal"] = (value(four_bar.diagonal.of(crank_angle=m[at]), **own), f"Δ_{letter}", "1",
        f"Distance of the crank pin from the rocker's pivot{when}, in crank lengths", "004 eq. 3")
    chapter[f"{place}diagonal_direction"] = (value(four_bar.diagonal_direction.of(crank_angle=m[at]), **own), f"γ_1{letter}", "deg",
        f"Direction from the rocker's pivot to the crank pin{when}", "004 eq. 3, over the full turn")
    chapter[f"{place}pin_angle"] = (value(four_bar.pin_angle.of(diagonal=m[f"{place}diagonal"]), **own), f"γ_2{letter}", "deg",
        f"Angle at the crank pin between diagonal and coupler{when}", "004 eq. 3")
    chapter[f"{place}transmission_angle"] = (value(four_bar.transmission_angle.of(diagonal=m[f"{place}diagonal"]), **own), f"μ_{letter}", "deg",
        f"Transmission angle{when}", "004 eq. 3")
    chapter[f"{place}coupler_direction"] = (value(four_bar.coupler_direction.of(diagonal_direction=m[f"{place}diagonal_direction"],
        pin_angle=m[f"{place}pin_angle"]), **own), f"δ_{letter}", "deg", f"Direction of the coupler{when}", "004 eq. 3")
    chapter[f"{place}rocker_direction"] = (value(four_bar.rocker_direction.of(coupler_direction=m[f"{place}coupler_direction"],
        transmission_angle=m[f"{place}transmission_angle"]), **own), f"γ_{letter}", "deg", f"Direction of the rocker{when}", "004 eq. 3")
    chapter[f"{place}rocker_speed_ratio"] = (value(four_bar.rocker_speed_ratio.of(crank_angle=m[at],
        coupler_direction=m[f"{place}coupler_direction"], rocker_direction=m[f"{place}rocker_direction"]), **own), f"ω_3i{letter}", "1",
        f"Ratio of the rocker's angular speed to the crank's{when}", "004 eq. 3")


def _rate(steps: Steps, id: str, symbol: str, description: str, ratio: str, **options: Any) -> None:
    """Velocity of the edge from the rocker's speed ratio."""
    at_outer = m[ratio] * m.crank_speed * m[ARM]
    at_inner = -m[ratio] * m.crank_speed * m[ARM]
    _either(steps, id, symbol, "m/s", description, at_outer, at_inner, source="004 eq. 3", **options)


GEOMETRY = Steps()
for link, symbol in (("frame", "λ_1"), ("coupler", "λ_2"), ("rocker", "λ_3")):
    GEOMETRY[f"{link}_ratio"] = (inner(m[f"crank_rocker.{link}"] / m.crank_rocker.crank), symbol, "1", f"{link.capitalize()}-to-crank ratio",
        "004 eq. 3")
GEOMETRY.require("turns_fully", four_bar.is_crank_rocker, key="crank_rocker.crank",
    message="gives no crank-rocker: with crank = {crank_rocker.crank}, coupler = {crank_rocker.coupler}, rocker = {crank_rocker.rocker} and frame = "
    "{crank_rocker.frame} the crank must be the shortest link, and it and the longest one together shorter than the other two together (Grashof)",
    advise=(Vary("crank_rocker.crank", "down"), "crank_rocker.coupler", "crank_rocker.rocker", "crank_rocker.frame"))
GEOMETRY.outer_direction = inner(four_bar.outer_rocker_direction), "γ_3", "deg", "Direction of the rocker at its outer dead centre", "law of cosines"
GEOMETRY.swing_angle = four_bar.swing_angle, "ψ_s", "deg", "Swing of the rocker", "law of cosines"
GEOMETRY.stroke = m.swing_angle * m[ARM], "H_", "mm", "Stroke of the edge along its arc", "004 eq. 3"
GEOMETRY.add(working.reaches(working.CRANK_ROCKER))
GEOMETRY.dead_center = inner(four_bar.outer_dead_center, needs=OUTER), "φ_d", "deg", "Crank angle of the outer dead centre", "law of cosines"
_either(GEOMETRY, "lowest_angle", "φ_0", "deg", "Crank angle of the lowest point (may exceed a full turn)",
        m.dead_center + 2 * pi, four_bar.inner_dead_center, source="dead centre")

CURVES = Steps()
_speed_ratio(CURVES, "crank_angle")
CURVES.coupler_speed_ratio = (inner(four_bar.coupler_speed_ratio.of()), "ω_2i", "1", "Ratio of the coupler's angular speed to the crank's",
    "004 eq. 3, corrected")
CURVES.rocker_acceleration_ratio = (inner(four_bar.rocker_acceleration_ratio.of()), "ε_3i", "1",
    "Ratio of the rocker's angular acceleration to the square of the crank's speed", "004 eq. 3, corrected")
_either(CURVES, "rocker_angle", "δ_3", "deg", "Angle of the rocker from the dead centre of the lowest point",
        m.rocker_direction - m.outer_direction,
        m.outer_direction + m.swing_angle - m.rocker_direction,
        source="004 eq. 3", output=False)
CURVES.displacement = m.rocker_angle * m[ARM], "S_", "mm", "Height of the edge above its lowest point, along its arc", "004 eq. 3"
_rate(CURVES, "velocity", "V_", "Velocity of the edge along its arc", "rocker_speed_ratio")
_either(CURVES, "acceleration", "a_", "m/s**2", "Acceleration of the edge along its arc",
        m.rocker_acceleration_ratio * m.crank_speed**2 * m[ARM],
        -m.rocker_acceleration_ratio * m.crank_speed**2 * m[ARM], source="004 eq. 3", source_symbol="W_")

PLACES = Steps()
_either(PLACES, "table_direction", "γ_h", "deg", "Direction of the rocker with the edge at the table",
        m.outer_direction + as_angle(m.working_depth / m[ARM]),
        m.outer_direction + m.swing_angle - as_angle(m.working_depth / m[ARM]), source="geometry", output=False)
PLACES.table_distance = (inner(four_bar.joint_distance.of(rocker_direction=m.table_direction)), "e_h", "1",
    "Distance of the rocker's joint from the crank's pivot there, in crank lengths", "law of cosines")
_either(PLACES, "contact_angle", "φ_t", "deg", "Crank angle of the contact at the table",
        four_bar.crank_angle_return.of(rocker_direction=m.table_direction, joint_distance=m.table_distance),
        four_bar.crank_angle_forward.of(rocker_direction=m.table_direction, joint_distance=m.table_distance), source="law of cosines")
_either(PLACES, "leave_angle", "φ_a", "deg", "Crank angle at which the edge is at the table again",
        four_bar.crank_angle_forward.of(rocker_direction=m.table_direction, joint_distance=m.table_distance),
        four_bar.crank_angle_return.of(rocker_direction=m.table_direction, joint_distance=m.table_distance), source="law of cosines",
        output=False)
PLACES.working_angle = m.lowest_angle - m.contact_angle, "φ_w", "deg", "Crank angle of the working stroke", "kinematics"
_speed_ratio(PLACES, "contact_angle", "contact_", "t", " at contact")
_rate(PLACES, "contact_rate", "v_t", "Velocity of the edge as it meets the signature", "contact_rocker_speed_ratio", output=False)
_either(PLACES, "dead_span", "λ_d", "1", "Crank and coupler in line at the lowest point, in crank lengths",
        m.coupler_ratio + 1, m.coupler_ratio - 1, source="geometry", output=False)
PLACES.dead_transmission_angle = (common.enclosed_angle.of(one_side=m.dead_span, other_side=m.rocker_ratio, opposite_side=m.frame_ratio), "μ_0",
    "deg", "Transmission angle at the lowest point", "law of cosines")
_either(PLACES, "acceleration_end", "a_0", "m/s**2", "Acceleration of the edge at its lowest point",
        m[ARM] * m.crank_speed**2 * (1 + 1 / m.coupler_ratio) / (m.rocker_ratio * np.sin(m.dead_transmission_angle)),
        m[ARM] * m.crank_speed**2 * (1 - 1 / m.coupler_ratio) / (m.rocker_ratio * np.sin(m.dead_transmission_angle)),
        source="004 eq. 3 at the dead centre", source_symbol="W_0")
PLACES.add(GRIP)
_speed_ratio(PLACES, "grip_begin", "grip_", "g", " when gripping begins", NO_SPEED)
_rate(PLACES, "grip_rate", "v_g", "Velocity of the edge when gripping begins", "grip_rocker_speed_ratio", output=False, lacks=NO_SPEED)

CRANK_ROCKER = (*GEOMETRY, *CURVES, *PLACES)
