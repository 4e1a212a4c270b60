"""The motion of planetary drive, crank-slider and crank-rocker: over a turn, at the contact, at the beginning of the grip, at the lowest point.

Each gives ``stroke``, ``lowest_angle``, ``working_angle``, ``contact_angle``, ``contact_rate``, ``grip_rate``,
``acceleration_end`` and the curves ``displacement``, ``velocity``, ``acceleration``, all under the drive's prefix.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Bound, Formula, Steps, Vary, as_angle, bind, pi
from diecut_report.mechanics import common, four_bar, slider_crank
from diecut_report.plugins.knife_drive import working

# fmt: off

NO_SPEED = ("grip_speed",)
RADIUS = "planetary.carrier_radius"
CRANK, ROD = "crank_slider.crank_radius", "crank_slider.rod_length"
ANGLES = {"contact": "contact_angle", "grip": "grip_begin"}

CONTACT = Steps()
CONTACT.value("contact_angle", "φ_t", "deg", "Crank angle of the contact at the table",
    lambda lowest_angle, working_angle: lowest_angle - working_angle, source="kinematics")
CONTACT.value("leave_angle", "φ_a", "deg", "Crank angle at which the edge is at the table again",
    lambda lowest_angle, working_angle: lowest_angle + working_angle, source="symmetry", output=False)
GRIP = Steps()
GRIP.value("grip_begin", "φ_b", "deg", "Crank angle at which gripping begins", lambda lowest_angle, grip_angle: lowest_angle - grip_angle,
    source="004, after Fig. 3", output=False)

PLANETARY = Steps()
PLANETARY.value("stroke", "H_", "mm", "Stroke of the edge", bind(lambda carrier_radius: 4 * carrier_radius, carrier_radius=RADIUS),
    source="004 eq. 1")
PLANETARY.add(working.reaches(working.PLANETARY))
PLANETARY.value("displacement", "S_", "mm", "Displacement of the edge from the carrier's axis",
    bind(lambda crank_angle, carrier_radius: 2 * carrier_radius * np.sin(crank_angle), carrier_radius=RADIUS), source="004 eq. 1")
PLANETARY.value("velocity", "V_", "m/s", "Velocity of the edge", bind(working.planetary_velocity, carrier_radius=RADIUS), source="004 eq. 1")
PLANETARY.value("acceleration", "a_", "m/s**2", "Acceleration of the edge", bind(working.planetary_acceleration, carrier_radius=RADIUS),
    source="004 eq. 1", source_symbol="W_")
PLANETARY.value("lowest_angle", "φ_0", "deg", "Crank angle of the lowest point", lambda: 3 * pi / 2, source="004 eq. 1")
PLANETARY.value("working_angle", "φ_w", "deg", "Crank angle of the working stroke",
    bind(lambda working_depth, carrier_radius: 2 * np.arcsin(np.sqrt(working_depth / (4 * carrier_radius))), carrier_radius=RADIUS),
    source="004 eq. 1, solved")
PLANETARY.add(CONTACT)
PLANETARY.value("contact_rate", "v_t", "m/s", "Velocity of the edge as it meets the signature",
    bind(working.planetary_velocity, crank_angle="contact_angle", carrier_radius=RADIUS), source="004 eq. 1", output=False)
PLANETARY.value("acceleration_end", "a_0", "m/s**2", "Acceleration of the edge at its lowest point",
    bind(working.planetary_acceleration, crank_angle="lowest_angle", carrier_radius=RADIUS), source="004 eq. 1", source_symbol="W_0")
PLANETARY.add(GRIP)
PLANETARY.value("grip_rate", "v_g", "m/s", "Velocity of the edge when gripping begins",
    bind(working.planetary_velocity, crank_angle="grip_begin", carrier_radius=RADIUS), source="004 eq. 1", output=False, lacks=NO_SPEED)


def _slider_at(chapter: Steps, place: str, symbol: str, when: str, lacks: tuple[str, ...] = ()) -> None:
    """The rod's angle and the edge's velocity at one place."""
    chapter.value(f"{place}_rod_angle", f"β_{symbol}", "deg", f"Angle of the rod to the knife's path {when}",
        bind(slider_crank.coupler_angle, crank_angle=ANGLES[place], rod_ratio="rod_ratio"), source="004 eq. 2", output=False, lacks=lacks)
    chapter.value(f"{place}_rate", f"v_{symbol}", "m/s", f"Velocity of the edge {when}",
        bind(slider_crank.velocity, crank_angle=ANGLES[place], coupler_angle=f"{place}_rod_angle", crank_radius=CRANK), source="004 eq. 2",
        output=False, lacks=lacks)


def _first_order(chapter: Steps, name: str, symbol: str, unit: str, word: str, approximate: Formula) -> None:
    """A curve to the first order of r/l, as textbooks have it, and how far it is from the exact one."""
    chapter.value(f"{name}_first_order", f"{symbol}_1", unit, f"{word.capitalize()} of the edge, first-order in r/l",
        bind(approximate, crank_radius=CRANK), source="004 eq. 2, to the first order")
    chapter.value(f"{name}_error", f"Δ{symbol}_", unit, f"Difference of exact and first-order {word}",
        bind(common.difference, quantity=name, less=f"{name}_first_order"), output=False)
    chapter.reduction(f"{name}_difference", f"Δ{symbol}_m", unit, f"Maximum difference of the first-order {word} from the exact one", "abs_max",
        of=f"{name}_error")


CRANK_SLIDER = Steps()
CRANK_SLIDER.require("rod_longer", bind(common.is_below, smaller=CRANK, greater=ROD), key=ROD,
    message="is {crank_slider.rod_length}, not longer than the crank_radius of {crank_slider.crank_radius}: the crank cannot turn fully; make the "
        "rod longer than the crank, usually three to six times")
CRANK_SLIDER.value("rod_ratio", "λ_", "1", "Rod-to-crank ratio", bind(common.quotient, quantity=ROD, by=CRANK), source="004 eq. 2", output=False)
CRANK_SLIDER.value("stroke", "H_", "mm", "Stroke of the edge", bind(lambda quantity: 2 * quantity, quantity=CRANK), source="004 eq. 2")
CRANK_SLIDER.add(working.reaches(working.CRANK_SLIDER))
CRANK_SLIDER.value("rod_angle", "β_", "deg", "Angle of the rod to the knife's path", bind(slider_crank.coupler_angle), source="004 eq. 2",
    output=False)
CRANK_SLIDER.value("displacement", "S_", "mm", "Height of the edge above its lowest point",
    bind(slider_crank.displacement, coupler_angle="rod_angle", crank_radius=CRANK), source="004 eq. 2, corrected")
CRANK_SLIDER.value("velocity", "V_", "m/s", "Velocity of the edge", bind(slider_crank.velocity, coupler_angle="rod_angle", crank_radius=CRANK),
    source="004 eq. 2")
CRANK_SLIDER.value("acceleration", "a_", "m/s**2", "Acceleration of the edge",
    bind(slider_crank.acceleration, coupler_angle="rod_angle", crank_radius=CRANK), source="004 eq. 2", source_symbol="W_")
CRANK_SLIDER.value("lowest_angle", "φ_0", "deg", "Crank angle of the lowest point: one revolution after φ = 0", lambda: 2 * pi, source="004 eq. 2")
CRANK_SLIDER.value("working_angle", "φ_w", "deg", "Crank angle of the working stroke",
    bind(slider_crank.crank_angle_at, displacement="working_depth", crank_radius=CRANK, rod_length=ROD), source="004 eq. 2, solved")
CRANK_SLIDER.add(CONTACT)
_slider_at(CRANK_SLIDER, "contact", "t", "as it meets the signature")
CRANK_SLIDER.value("acceleration_end", "a_0", "m/s**2", "Acceleration of the edge at its lowest point",
    bind(lambda crank_radius, rod_ratio, crank_speed: crank_radius * crank_speed**2 * (1 + 1 / rod_ratio), crank_radius=CRANK),
    source="004 eq. 2 at φ = 0", source_symbol="W_0")
CRANK_SLIDER.add(GRIP)
_slider_at(CRANK_SLIDER, "grip", "g", "when gripping begins", NO_SPEED)
_first_order(CRANK_SLIDER, "displacement", "S", "mm", "height", slider_crank.displacement_first_order)
_first_order(CRANK_SLIDER, "velocity", "V", "m/s", "velocity", slider_crank.velocity_first_order)
_first_order(CRANK_SLIDER, "acceleration", "a", "m/s**2", "acceleration", slider_crank.acceleration_first_order)
CRANK_SLIDER.value("acceleration_difference_share", "δ_W", "1",
    "Maximum difference of the first-order acceleration, relative to the acceleration at the lowest point",
    lambda acceleration_difference, acceleration_end: acceleration_difference / acceleration_end, source="this method")


ARM = "crank_rocker.knife_arm"
OUTER, INNER = ("crank_rocker.lowest_dead_center=outer",), ("crank_rocker.lowest_dead_center=inner",)


def _either(
    steps: Steps, id: str, symbol: str, unit: str, description: str, outer: Bound | Formula, inner: Bound | Formula, **options: Any
) -> None:
    """A quantity with one formula for each dead centre that may be the lowest point."""
    steps.value(id, symbol, unit, description, outer, needs=OUTER, **options)
    steps.value(id, symbol, unit, description, inner, needs=INNER, **options)


def _speed_ratio(
    chapter: Steps,
    at: str, place: str = "", letter: str = "", when: str = "", lacks: tuple[str, ...] = ()
) -> None:
    """The linkage at a crank angle, up to the rocker's speed; ids begin with ``place``, symbols end with ``letter``."""
    own: dict[str, Any] = {"output": False, "lacks": lacks}
    chapter.value(f"{place}diagonal", f"Δ_{letter}", "1", f"Distance of the crank pin from the rocker's pivot{when}, in crank lengths",
        bind(four_bar.diagonal, crank_angle=at), source="004 eq. 3", **own)
    chapter.value(f"{place}diagonal_direction", f"γ_1{letter}", "deg", f"Direction from the rocker's pivot to the crank pin{when}",
        bind(four_bar.diagonal_direction, crank_angle=at), source="004 eq. 3, over the full turn", **own)
    chapter.value(f"{place}pin_angle", f"γ_2{letter}", "deg", f"Angle at the crank pin between diagonal and coupler{when}",
        bind(four_bar.pin_angle, diagonal=f"{place}diagonal"), source="004 eq. 3", **own)
    chapter.value(f"{place}transmission_angle", f"μ_{letter}", "deg", f"Transmission angle{when}",
        bind(four_bar.transmission_angle, diagonal=f"{place}diagonal"), source="004 eq. 3", **own)
    chapter.value(f"{place}coupler_direction", f"δ_{letter}", "deg", f"Direction of the coupler{when}",
        bind(four_bar.coupler_direction, diagonal_direction=f"{place}diagonal_direction", pin_angle=f"{place}pin_angle"), source="004 eq. 3", **own)
    chapter.value(f"{place}rocker_direction", f"γ_{letter}", "deg", f"Direction of the rocker{when}",
        bind(four_bar.rocker_direction, coupler_direction=f"{place}coupler_direction", transmission_angle=f"{place}transmission_angle"),
        source="004 eq. 3", **own)
    chapter.value(f"{place}rocker_speed_ratio", f"ω_3i{letter}", "1", f"Ratio of the rocker's angular speed to the crank's{when}",
        bind(four_bar.rocker_speed_ratio, crank_angle=at, coupler_direction=f"{place}coupler_direction", rocker_direction=f"{place}rocker_direction"),
        source="004 eq. 3", **own)


def _rate(steps: Steps, id: str, symbol: str, description: str, ratio: str, **options: Any) -> None:
    """Velocity of the edge from the rocker's speed ratio."""
    given = {"speed_ratio": ratio, "knife_arm": ARM}
    outer = bind(lambda speed_ratio, crank_speed, knife_arm: speed_ratio * crank_speed * knife_arm, **given)
    inner = bind(lambda speed_ratio, crank_speed, knife_arm: -speed_ratio * crank_speed * knife_arm, **given)
    _either(steps, id, symbol, "m/s", description, outer, inner, source="004 eq. 3", **options)


GEOMETRY = Steps()
for link, symbol in (("frame", "λ_1"), ("coupler", "λ_2"), ("rocker", "λ_3")):
    GEOMETRY.value(f"{link}_ratio", symbol, "1", f"{link.capitalize()}-to-crank ratio",
        bind(common.quotient, quantity=f"crank_rocker.{link}", by="crank_rocker.crank"), source="004 eq. 3", output=False)
GEOMETRY.require("turns_fully", four_bar.is_crank_rocker, key="crank_rocker.crank",
    message="gives no crank-rocker: with crank = {crank_rocker.crank}, coupler = {crank_rocker.coupler}, rocker = {crank_rocker.rocker} and frame = "
        "{crank_rocker.frame} the crank must be the shortest link, and it and the longest one together shorter than the other two together (Grashof)",
    advise=(Vary("crank_rocker.crank", "down"), "crank_rocker.coupler", "crank_rocker.rocker", "crank_rocker.frame"))
GEOMETRY.value("outer_direction", "γ_3", "deg", "Direction of the rocker at its outer dead centre", four_bar.outer_rocker_direction,
    source="law of cosines", output=False)
GEOMETRY.value("swing_angle", "ψ_s", "deg", "Swing of the rocker", four_bar.swing_angle, source="law of cosines")
GEOMETRY.value("stroke", "H_", "mm", "Stroke of the edge along its arc", bind(common.product, first="swing_angle", second=ARM), source="004 eq. 3")
GEOMETRY.add(working.reaches(working.CRANK_ROCKER))
GEOMETRY.value("dead_center", "φ_d", "deg", "Crank angle of the outer dead centre", four_bar.outer_dead_center, source="law of cosines", output=False,
    needs=OUTER)
_either(GEOMETRY, "lowest_angle", "φ_0", "deg", "Crank angle of the lowest point (may exceed a full turn)",
        bind(lambda angle: angle + 2 * pi, angle="dead_center"), four_bar.inner_dead_center, source="dead centre")

CURVES = Steps()
_speed_ratio(CURVES, "crank_angle")
CURVES.value("coupler_speed_ratio", "ω_2i", "1", "Ratio of the coupler's angular speed to the crank's", bind(four_bar.coupler_speed_ratio),
    source="004 eq. 3, corrected", output=False)
CURVES.value("rocker_acceleration_ratio", "ε_3i", "1", "Ratio of the rocker's angular acceleration to the square of the crank's speed",
    bind(four_bar.rocker_acceleration_ratio), source="004 eq. 3, corrected", output=False)
_either(CURVES, "rocker_angle", "δ_3", "deg", "Angle of the rocker from the dead centre of the lowest point",
        bind(common.difference, quantity="rocker_direction", less="outer_direction"),
        bind(lambda outer_direction, swing_angle, rocker_direction: outer_direction + swing_angle - rocker_direction),
        source="004 eq. 3", output=False)
CURVES.value("displacement", "S_", "mm", "Height of the edge above its lowest point, along its arc",
    bind(common.product, first="rocker_angle", second=ARM), source="004 eq. 3")
_rate(CURVES, "velocity", "V_", "Velocity of the edge along its arc", "rocker_speed_ratio")
_either(CURVES, "acceleration", "a_", "m/s**2", "Acceleration of the edge along its arc",
        bind(lambda acceleration_ratio, crank_speed, knife_arm: acceleration_ratio * crank_speed**2 * knife_arm,
            acceleration_ratio="rocker_acceleration_ratio", knife_arm=ARM),
        bind(lambda acceleration_ratio, crank_speed, knife_arm: -acceleration_ratio * crank_speed**2 * knife_arm,
            acceleration_ratio="rocker_acceleration_ratio", knife_arm=ARM), source="004 eq. 3", source_symbol="W_")

PLACES = Steps()
_either(PLACES, "table_direction", "γ_h", "deg", "Direction of the rocker with the edge at the table",
        bind(lambda outer_direction, working_depth, knife_arm: outer_direction + as_angle(working_depth / knife_arm), knife_arm=ARM),
        bind(lambda outer_direction, swing_angle, working_depth, knife_arm: outer_direction + swing_angle - as_angle(working_depth / knife_arm),
            knife_arm=ARM), source="geometry", output=False)
PLACES.value("table_distance", "e_h", "1", "Distance of the rocker's joint from the crank's pivot there, in crank lengths",
    bind(four_bar.joint_distance, rocker_direction="table_direction"), source="law of cosines", output=False)
_either(PLACES, "contact_angle", "φ_t", "deg", "Crank angle of the contact at the table",
        bind(four_bar.crank_angle_return, rocker_direction="table_direction", joint_distance="table_distance"),
        bind(four_bar.crank_angle_forward, rocker_direction="table_direction", joint_distance="table_distance"), source="law of cosines")
_either(PLACES, "leave_angle", "φ_a", "deg", "Crank angle at which the edge is at the table again",
        bind(four_bar.crank_angle_forward, rocker_direction="table_direction", joint_distance="table_distance"),
        bind(four_bar.crank_angle_return, rocker_direction="table_direction", joint_distance="table_distance"), source="law of cosines",
        output=False)
PLACES.value("working_angle", "φ_w", "deg", "Crank angle of the working stroke", lambda lowest_angle, contact_angle: lowest_angle - contact_angle,
    source="kinematics")
_speed_ratio(PLACES, "contact_angle", "contact_", "t", " at contact")
_rate(PLACES, "contact_rate", "v_t", "Velocity of the edge as it meets the signature", "contact_rocker_speed_ratio", output=False)
_either(PLACES, "dead_span", "λ_d", "1", "Crank and coupler in line at the lowest point, in crank lengths",
        bind(lambda ratio: ratio + 1, ratio="coupler_ratio"), bind(lambda ratio: ratio - 1, ratio="coupler_ratio"), source="geometry", output=False)
PLACES.value("dead_transmission_angle", "μ_0", "deg", "Transmission angle at the lowest point",
    bind(common.enclosed_angle, one_side="dead_span", other_side="rocker_ratio", opposite_side="frame_ratio"), source="law of cosines")
_either(PLACES, "acceleration_end", "a_0", "m/s**2", "Acceleration of the edge at its lowest point",
        bind(lambda knife_arm, crank_speed, coupler_ratio, rocker_ratio, dead_angle:
                knife_arm * crank_speed**2 * (1 + 1 / coupler_ratio) / (rocker_ratio * np.sin(dead_angle)), knife_arm=ARM,
            dead_angle="dead_transmission_angle"),
        bind(lambda knife_arm, crank_speed, coupler_ratio, rocker_ratio, dead_angle:
                knife_arm * crank_speed**2 * (1 - 1 / coupler_ratio) / (rocker_ratio * np.sin(dead_angle)), knife_arm=ARM,
            dead_angle="dead_transmission_angle"), source="004 eq. 3 at the dead centre", source_symbol="W_0")
PLACES.add(GRIP)
_speed_ratio(PLACES, "grip_begin", "grip_", "g", " when gripping begins", NO_SPEED)
_rate(PLACES, "grip_rate", "v_g", "Velocity of the edge when gripping begins", "grip_rocker_speed_ratio", output=False, lacks=NO_SPEED)

CRANK_ROCKER = (*GEOMETRY, *CURVES, *PLACES)
