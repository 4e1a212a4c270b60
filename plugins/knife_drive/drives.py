"""The motion of planetary drive and crank-slider: over a turn, at the contact, at the beginning of the grip, at the lowest point.

Each gives ``stroke``, ``lowest_angle``, ``working_angle``, ``contact_angle``, ``contact_rate``, ``grip_rate``,
``acceleration_end`` and the curves ``displacement``, ``velocity``, ``acceleration``, all under the drive's prefix.
"""

from __future__ import annotations

from diecut_report.api import Formula, Reduction, Require, Step, Value, bind
from diecut_report.mechanics import common, slider_crank
from diecut_report.plugins.knife_drive import formulas, working

NO_SPEED = ("grip_speed",)
RADIUS = "planetary.carrier_radius"
CRANK, ROD = "crank_slider.crank_radius", "crank_slider.rod_length"
ANGLES = {"contact": "contact_angle", "grip": "grip_begin"}

CONTACT = Value(id="contact_angle", symbol="φ_t", unit="deg", description="Crank angle of the contact at the table", source="kinematics",
                digits=6, formula=bind(common.difference, greater="lowest_angle", smaller="working_angle"))  # fmt: skip
GRIP = Value(id="grip_begin", symbol="φ_b", unit="deg", description="Crank angle at which gripping begins", source="004, after Fig. 3",
             output=False, formula=bind(common.difference, greater="lowest_angle", smaller="grip_angle"))  # fmt: skip

PLANETARY: tuple[Step, ...] = (
    Value(id="stroke", symbol="H_", unit="mm", description="Stroke of the edge", source="004 eq. 1",
          formula=bind(formulas.planetary_stroke, carrier_radius=RADIUS)),
    working.reaches(working.PLANETARY),
    Value(id="displacement", symbol="S_", unit="mm", description="Displacement of the edge from the carrier's axis", source="004 eq. 1",
          formula=bind(formulas.planetary_displacement, carrier_radius=RADIUS)),
    Value(id="velocity", symbol="V_", unit="m/s", description="Velocity of the edge", source="004 eq. 1",
          formula=bind(formulas.planetary_velocity, carrier_radius=RADIUS)),
    Value(id="acceleration", symbol="W_", unit="m/s**2", description="Acceleration of the edge", source="004 eq. 1",
          formula=bind(formulas.planetary_acceleration, carrier_radius=RADIUS)),
    Value(id="lowest_angle", symbol="φ_0", unit="deg", description="Crank angle of the lowest point", source="004 eq. 1",
          formula=formulas.three_quarter_turn),
    Value(id="working_angle", symbol="φ_w", unit="deg", description="Crank angle of the working stroke", source="004 eq. 1, solved", digits=6,
          formula=bind(formulas.planetary_working_angle, carrier_radius=RADIUS)),
    CONTACT,
    Value(id="contact_rate", symbol="v_t", unit="m/s", description="Velocity of the edge as it meets the signature", source="004 eq. 1",
          output=False, formula=bind(formulas.planetary_velocity, crank_angle="contact_angle", carrier_radius=RADIUS)),
    Value(id="acceleration_end", symbol="W_0", unit="m/s**2", description="Acceleration of the edge at its lowest point", source="004 eq. 1",
          formula=bind(formulas.planetary_acceleration, crank_angle="lowest_angle", carrier_radius=RADIUS)),
    GRIP,
    Value(id="grip_rate", symbol="v_g", unit="m/s", description="Velocity of the edge when gripping begins", source="004 eq. 1", output=False,
          lacks=NO_SPEED, formula=bind(formulas.planetary_velocity, crank_angle="grip_begin", carrier_radius=RADIUS)),
)  # fmt: skip


def _slider_at(place: str, symbol: str, when: str, lacks: tuple[str, ...] = ()) -> tuple[Step, ...]:
    """The rod's angle and the edge's velocity at one place."""
    return (
        Value(id=f"{place}_rod_angle", symbol=f"β_{symbol}", unit="deg", description=f"Angle of the rod to the knife's path {when}",
              source="004 eq. 2", output=False, lacks=lacks,
              formula=bind(slider_crank.coupler_angle, crank_angle=ANGLES[place], rod_ratio="rod_ratio")),
        Value(id=f"{place}_rate", symbol=f"v_{symbol}", unit="m/s", description=f"Velocity of the edge {when}", source="004 eq. 2",
              output=False, lacks=lacks,
              formula=bind(slider_crank.velocity, crank_angle=ANGLES[place], coupler_angle=f"{place}_rod_angle", crank_radius=CRANK)),
    )  # fmt: skip


def _first_order(name: str, symbol: str, unit: str, word: str, approximate: Formula) -> tuple[Step, ...]:
    """A curve to the first order of r/l, as textbooks have it, and how far it is from the exact one."""
    return (
        Value(id=f"{name}_first_order", symbol=f"{symbol}_1", unit=unit, description=f"{word.capitalize()} of the edge to the first order of r/l",
              source="004 eq. 2, to the first order", formula=bind(approximate, crank_radius=CRANK)),
        Value(id=f"{name}_error", symbol=f"Δ{symbol}_", unit=unit, description=f"Exact {word} less the first-order one", output=False,
              formula=bind(common.difference, greater=name, smaller=f"{name}_first_order")),
        Reduction(id=f"{name}_difference", symbol=f"Δ{symbol}_m", unit=unit, of=f"{name}_error", operation="abs_max",
                  description=f"Greatest difference of the first-order {word} from the exact one"),
    )  # fmt: skip


CRANK_SLIDER: tuple[Step, ...] = (
    Require(id="rod_longer", condition=bind(common.is_below, smaller=CRANK, greater=ROD), key=ROD,
            message="is {crank_slider.rod_length}, not longer than the crank_radius of {crank_slider.crank_radius}: the crank cannot turn "
            "fully; make the rod longer than the crank, usually three to six times"),
    Value(id="rod_ratio", symbol="λ_", description="Rod to crank", source="004 eq. 2", output=False,
          formula=bind(common.quotient, quantity=ROD, by=CRANK)),
    Value(id="stroke", symbol="H_", unit="mm", description="Stroke of the edge", source="004 eq. 2",
          formula=bind(common.twice, quantity=CRANK)),
    working.reaches(working.CRANK_SLIDER),
    Value(id="rod_angle", symbol="β_", unit="deg", description="Angle of the rod to the knife's path", source="004 eq. 2", output=False,
          formula=bind(slider_crank.coupler_angle)),
    Value(id="displacement", symbol="S_", unit="mm", description="Height of the edge above its lowest point", source="004 eq. 2, corrected",
          formula=bind(slider_crank.displacement, coupler_angle="rod_angle", crank_radius=CRANK)),
    Value(id="velocity", symbol="V_", unit="m/s", description="Velocity of the edge", source="004 eq. 2",
          formula=bind(slider_crank.velocity, coupler_angle="rod_angle", crank_radius=CRANK)),
    Value(id="acceleration", symbol="W_", unit="m/s**2", description="Acceleration of the edge", source="004 eq. 2",
          formula=bind(slider_crank.acceleration, coupler_angle="rod_angle", crank_radius=CRANK)),
    Value(id="lowest_angle", symbol="φ_0", unit="deg", description="Crank angle of the lowest point: a turn after φ = 0", source="004 eq. 2",
          formula=formulas.full_turn),
    Value(id="working_angle", symbol="φ_w", unit="deg", description="Crank angle of the working stroke", source="004 eq. 2, solved", digits=6,
          formula=bind(slider_crank.crank_angle_at, displacement="working_depth", crank_radius=CRANK, rod_length=ROD)),
    CONTACT,
    *_slider_at("contact", "t", "as it meets the signature"),
    Value(id="acceleration_end", symbol="W_0", unit="m/s**2", description="Acceleration of the edge at its lowest point",
          source="004 eq. 2 at φ = 0", formula=bind(formulas.slider_end_acceleration, crank_radius=CRANK)),
    GRIP,
    *_slider_at("grip", "g", "when gripping begins", NO_SPEED),
    *_first_order("displacement", "S", "mm", "height", slider_crank.displacement_first_order),
    *_first_order("velocity", "V", "m/s", "velocity", slider_crank.velocity_first_order),
    *_first_order("acceleration", "W", "m/s**2", "acceleration", slider_crank.acceleration_first_order),
    Value(id="acceleration_difference_share", symbol="δ_W", source="this method", formula=bind(
              common.quotient, quantity="acceleration_difference", by="acceleration_end"),
          description="Greatest difference of the first-order acceleration, to the acceleration at the lowest point"),
)  # fmt: skip
