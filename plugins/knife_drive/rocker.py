"""The motion of the crank-rocker, with the knife's lowest point at the outer or at the inner dead centre of the rocker."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Bound, Formula, Require, Step, Value, Words, bind
from diecut_report.mechanics import common, four_bar, triangle
from diecut_report.plugins.knife_drive import advice, formulas, working
from diecut_report.plugins.knife_drive.drives import GRIP, NO_SPEED

ARM = "crank_rocker.knife_arm"
LINKS = ("crank", "coupler", "rocker", "frame")
OUTER, INNER = ("crank_rocker.lowest_dead_center=outer",), ("crank_rocker.lowest_dead_center=inner",)


def _either(outer: Bound | Formula, inner: Bound | Formula, **declared: Any) -> tuple[Step, ...]:
    """A quantity with one formula for each dead centre that may be the lowest point."""
    return Value(needs=OUTER, formula=outer, **declared), Value(needs=INNER, formula=inner, **declared)


def _ratio(name: str, symbol: str, link: str) -> Value:
    return Value(id=f"{link}_ratio", symbol=symbol, description=f"{name} to crank", source="004 eq. 3", output=False,
                 formula=bind(common.quotient, quantity=f"crank_rocker.{link}", by="crank_rocker.crank"))  # fmt: skip


def _speed_ratio(
    at: str, place: str = "", letter: str = "", when: str = "", lacks: tuple[str, ...] = ()
) -> tuple[Step, ...]:
    """The linkage at a crank angle, up to the rocker's speed; ids begin with ``place``, symbols end with ``letter``."""
    own: dict[str, Any] = {"output": False, "lacks": lacks}
    angle: dict[str, Any] = own | {"unit": "deg"}
    return (
        Value(id=f"{place}diagonal", symbol=f"Δ_{letter}", **own, source="004 eq. 3",
              description=f"Distance of the crank pin from the rocker's pivot{when}, in crank lengths",
              formula=bind(four_bar.diagonal, crank_angle=at)),
        Value(id=f"{place}diagonal_direction", symbol=f"γ_1{letter}", **angle, source="004 eq. 3, over the full turn",
              description=f"Direction from the rocker's pivot to the crank pin{when}", formula=bind(four_bar.diagonal_direction, crank_angle=at)),
        Value(id=f"{place}pin_angle", symbol=f"γ_2{letter}", **angle, source="004 eq. 3",
              description=f"Angle at the crank pin between diagonal and coupler{when}",
              formula=bind(four_bar.pin_angle, diagonal=f"{place}diagonal")),
        Value(id=f"{place}transmission_angle", symbol=f"μ_{letter}", **angle, source="004 eq. 3",
              description=f"Transmission angle{when}", formula=bind(four_bar.transmission_angle, diagonal=f"{place}diagonal")),
        Value(id=f"{place}coupler_direction", symbol=f"δ_{letter}", **angle, source="004 eq. 3",
              description=f"Direction of the coupler{when}",
              formula=bind(four_bar.coupler_direction, diagonal_direction=f"{place}diagonal_direction", pin_angle=f"{place}pin_angle")),
        Value(id=f"{place}rocker_direction", symbol=f"γ_{letter}", **angle, source="004 eq. 3",
              description=f"Direction of the rocker{when}",
              formula=bind(four_bar.rocker_direction, coupler_direction=f"{place}coupler_direction",
                           transmission_angle=f"{place}transmission_angle")),
        Value(id=f"{place}rocker_speed_ratio", symbol=f"ω_3i{letter}", **own, source="004 eq. 3",
              description=f"Angular speed of the rocker to the crank's{when}",
              formula=bind(four_bar.rocker_speed_ratio, crank_angle=at, coupler_direction=f"{place}coupler_direction",
                           rocker_direction=f"{place}rocker_direction")),
    )  # fmt: skip


def _rate(ratio: str, lacks: tuple[str, ...] = (), **declared: Any) -> tuple[Step, ...]:
    """Velocity of the edge from the rocker's speed ratio."""
    given = {"speed_ratio": ratio, "knife_arm": ARM}
    outer, inner = bind(formulas.edge_velocity, **given), bind(formulas.edge_velocity_inner, **given)
    return _either(outer, inner, unit="m/s", lacks=lacks, source="004 eq. 3", **declared)


GEOMETRY: tuple[Step, ...] = (
    _ratio("Frame", "λ_1", "frame"),
    _ratio("Coupler", "λ_2", "coupler"),
    _ratio("Rocker", "λ_3", "rocker"),
    Words(id="link_advice", takes=tuple(f"crank_rocker.{link}" for link in LINKS), function=advice.links),
    Require(id="turns_fully", condition=four_bar.is_crank_rocker, key="crank_rocker.crank",
            message="gives no crank-rocker: with crank = {crank_rocker.crank}, coupler = {crank_rocker.coupler}, rocker = "
            "{crank_rocker.rocker} and frame = {crank_rocker.frame} the crank must be the shortest link, and it and the longest one together "
            "shorter than the other two together (Grashof); {crank_rocker_link_advice}"),
    Value(id="outer_direction", symbol="γ_3", unit="deg", description="Direction of the rocker at its outer dead centre",
          source="law of cosines", output=False, formula=four_bar.outer_rocker_direction),
    Value(id="swing_angle", symbol="ψ_s", unit="deg", description="Swing of the rocker", source="law of cosines", digits=6,
          formula=four_bar.swing_angle),
    Value(id="stroke", symbol="H_", unit="mm", description="Stroke of the edge along its arc", source="004 eq. 3",
          formula=bind(common.product, first="swing_angle", second=ARM)),
    working.reaches(working.CRANK_ROCKER),
    Value(id="dead_center", symbol="φ_d", unit="deg", description="Crank angle of the outer dead centre", source="law of cosines",
          output=False, needs=OUTER, digits=6, formula=four_bar.outer_dead_center),
    *_either(bind(formulas.turn_later, angle="dead_center"), four_bar.inner_dead_center, id="lowest_angle", symbol="φ_0", unit="deg",
             description="Crank angle of the lowest point (counted on over the full turn)", source="dead centre", digits=6),
)  # fmt: skip

CURVES: tuple[Step, ...] = (
    *_speed_ratio("crank_angle"),
    Value(id="coupler_speed_ratio", symbol="ω_2i", description="Angular speed of the coupler to the crank's", source="004 eq. 3, corrected",
          output=False, formula=bind(four_bar.coupler_speed_ratio)),
    Value(id="rocker_acceleration_ratio", symbol="ε_3i", description="Angular acceleration of the rocker to the crank's speed squared",
          source="004 eq. 3, corrected", output=False, formula=bind(four_bar.rocker_acceleration_ratio)),
    *_either(bind(common.difference, greater="rocker_direction", smaller="outer_direction"), formulas.angle_from_inner, id="rocker_angle",
             symbol="δ_3", unit="deg", description="Angle of the rocker from the dead centre of the lowest point", source="004 eq. 3", output=False),
    Value(id="displacement", symbol="S_", unit="mm", description="Height of the edge above its lowest point, along its arc",
          source="004 eq. 3", formula=bind(common.product, first="rocker_angle", second=ARM)),
    *_rate("rocker_speed_ratio", id="velocity", symbol="V_", description="Velocity of the edge along its arc"),
    *_either(bind(formulas.edge_acceleration, acceleration_ratio="rocker_acceleration_ratio", knife_arm=ARM),
             bind(formulas.edge_acceleration_inner, acceleration_ratio="rocker_acceleration_ratio", knife_arm=ARM),
             id="acceleration", symbol="W_", unit="m/s**2", description="Acceleration of the edge along its arc", source="004 eq. 3"),
)  # fmt: skip

PLACES: tuple[Step, ...] = (
    *_either(bind(formulas.raised_direction, knife_arm=ARM), bind(formulas.lowered_direction, knife_arm=ARM), id="table_direction",
             symbol="γ_h", unit="deg", description="Direction of the rocker with the edge at the table", source="geometry", output=False),
    Value(id="table_distance", symbol="e_h", description="Distance of the rocker's joint from the crank's pivot there, in crank lengths",
          source="law of cosines", output=False, formula=bind(four_bar.joint_distance, rocker_direction="table_direction")),
    *_either(bind(four_bar.crank_angle_return, rocker_direction="table_direction", joint_distance="table_distance"),
             bind(four_bar.crank_angle_forward, rocker_direction="table_direction", joint_distance="table_distance"),
             id="contact_angle", symbol="φ_t", unit="deg", description="Crank angle of the contact at the table", source="law of cosines", digits=6),
    Value(id="working_angle", symbol="φ_w", unit="deg", description="Crank angle of the working stroke", source="kinematics", digits=6,
          formula=bind(common.difference, greater="lowest_angle", smaller="contact_angle")),
    *_speed_ratio("contact_angle", "contact_", "t", " at contact"),
    *_rate("contact_rocker_speed_ratio", id="contact_rate", symbol="v_t", output=False,
           description="Velocity of the edge as it meets the signature"),
    *_either(bind(formulas.longer_by_one, ratio="coupler_ratio"), bind(formulas.shorter_by_one, ratio="coupler_ratio"), id="dead_span",
             symbol="λ_d", description="Crank and coupler in line at the lowest point, in crank lengths", source="geometry", output=False),
    Value(id="dead_transmission_angle", symbol="μ_0", unit="deg", description="Transmission angle at the lowest point",
          source="law of cosines", formula=bind(triangle.enclosed_angle, one_side="dead_span", other_side="rocker_ratio",
                                                opposite_side="frame_ratio")),
    *_either(bind(formulas.end_acceleration_outer, knife_arm=ARM, dead_angle="dead_transmission_angle"),
             bind(formulas.end_acceleration_inner, knife_arm=ARM, dead_angle="dead_transmission_angle"), id="acceleration_end", symbol="W_0",
             unit="m/s**2", description="Acceleration of the edge at its lowest point", source="004 eq. 3 at the dead centre"),
    GRIP,
    *_speed_ratio("grip_begin", "grip_", "g", " when gripping begins", NO_SPEED),
    *_rate("grip_rocker_speed_ratio", NO_SPEED, id="grip_rate", symbol="v_g", output=False,
           description="Velocity of the edge when gripping begins"),
)  # fmt: skip

CRANK_ROCKER = (*GEOMETRY, *CURVES, *PLACES)
