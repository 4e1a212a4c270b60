"""The motion of planetary drive and crank-slider: over a turn, at the contact, at the beginning of the grip, at the lowest point.

Each gives ``stroke``, ``lowest_angle``, ``working_angle``, ``contact_angle``, ``contact_rate``, ``grip_rate``,
``acceleration_end`` and the curves ``displacement``, ``velocity``, ``acceleration``, all under the drive's prefix.
"""

from __future__ import annotations

import numpy as np

from diecut_report.api import Formula, Steps, bind
from diecut_report.mechanics import common, slider_crank
from diecut_report.plugins.knife_drive import formulas, working

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
PLANETARY.value("velocity", "V_", "m/s", "Velocity of the edge", bind(formulas.planetary_velocity, carrier_radius=RADIUS), source="004 eq. 1")
PLANETARY.value("acceleration", "a_", "m/s**2", "Acceleration of the edge", bind(formulas.planetary_acceleration, carrier_radius=RADIUS),
    source="004 eq. 1", source_symbol="W_")
PLANETARY.value("lowest_angle", "φ_0", "deg", "Crank angle of the lowest point", lambda: 3 * np.pi / 2, source="004 eq. 1")
PLANETARY.value("working_angle", "φ_w", "deg", "Crank angle of the working stroke",
    bind(lambda working_depth, carrier_radius: 2 * np.arcsin(np.sqrt(working_depth / (4 * carrier_radius))), carrier_radius=RADIUS),
    source="004 eq. 1, solved")
PLANETARY.add(CONTACT)
PLANETARY.value("contact_rate", "v_t", "m/s", "Velocity of the edge as it meets the signature",
    bind(formulas.planetary_velocity, crank_angle="contact_angle", carrier_radius=RADIUS), source="004 eq. 1", output=False)
PLANETARY.value("acceleration_end", "a_0", "m/s**2", "Acceleration of the edge at its lowest point",
    bind(formulas.planetary_acceleration, crank_angle="lowest_angle", carrier_radius=RADIUS), source="004 eq. 1", source_symbol="W_0")
PLANETARY.add(GRIP)
PLANETARY.value("grip_rate", "v_g", "m/s", "Velocity of the edge when gripping begins",
    bind(formulas.planetary_velocity, crank_angle="grip_begin", carrier_radius=RADIUS), source="004 eq. 1", output=False, lacks=NO_SPEED)


def _slider_at(place: str, symbol: str, when: str, lacks: tuple[str, ...] = ()) -> Steps:
    """The rod's angle and the edge's velocity at one place."""
    steps = Steps()
    steps.value(f"{place}_rod_angle", f"β_{symbol}", "deg", f"Angle of the rod to the knife's path {when}",
        bind(slider_crank.coupler_angle, crank_angle=ANGLES[place], rod_ratio="rod_ratio"), source="004 eq. 2", output=False, lacks=lacks)
    steps.value(f"{place}_rate", f"v_{symbol}", "m/s", f"Velocity of the edge {when}",
        bind(slider_crank.velocity, crank_angle=ANGLES[place], coupler_angle=f"{place}_rod_angle", crank_radius=CRANK), source="004 eq. 2",
        output=False, lacks=lacks)
    return steps


def _first_order(name: str, symbol: str, unit: str, word: str, approximate: Formula) -> Steps:
    """A curve to the first order of r/l, as textbooks have it, and how far it is from the exact one."""
    steps = Steps()
    steps.value(f"{name}_first_order", f"{symbol}_1", unit, f"{word.capitalize()} of the edge, first-order in r/l",
        bind(approximate, crank_radius=CRANK), source="004 eq. 2, to the first order")
    steps.value(f"{name}_error", f"Δ{symbol}_", unit, f"Difference of exact and first-order {word}",
        bind(common.difference, quantity=name, less=f"{name}_first_order"), output=False)
    steps.reduction(f"{name}_difference", f"Δ{symbol}_m", unit, f"Maximum difference of the first-order {word} from the exact one", "abs_max",
        of=f"{name}_error")
    return steps


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
CRANK_SLIDER.value("lowest_angle", "φ_0", "deg", "Crank angle of the lowest point: one revolution after φ = 0", lambda: 2 * np.pi, source="004 eq. 2")
CRANK_SLIDER.value("working_angle", "φ_w", "deg", "Crank angle of the working stroke",
    bind(slider_crank.crank_angle_at, displacement="working_depth", crank_radius=CRANK, rod_length=ROD), source="004 eq. 2, solved")
CRANK_SLIDER.add(CONTACT)
CRANK_SLIDER.add(_slider_at("contact", "t", "as it meets the signature"))
CRANK_SLIDER.value("acceleration_end", "a_0", "m/s**2", "Acceleration of the edge at its lowest point",
    bind(lambda crank_radius, rod_ratio, crank_speed: crank_radius * crank_speed**2 * (1 + 1 / rod_ratio), crank_radius=CRANK),
    source="004 eq. 2 at φ = 0", source_symbol="W_0")
CRANK_SLIDER.add(GRIP)
CRANK_SLIDER.add(_slider_at("grip", "g", "when gripping begins", NO_SPEED))
CRANK_SLIDER.add(_first_order("displacement", "S", "mm", "height", slider_crank.displacement_first_order))
CRANK_SLIDER.add(_first_order("velocity", "V", "m/s", "velocity", slider_crank.velocity_first_order))
CRANK_SLIDER.add(_first_order("acceleration", "a", "m/s**2", "acceleration", slider_crank.acceleration_first_order))
CRANK_SLIDER.value("acceleration_difference_share", "δ_W", "1",
    "Maximum difference of the first-order acceleration, relative to the acceleration at the lowest point",
    lambda acceleration_difference, acceleration_end: acceleration_difference / acceleration_end, source="this method")
