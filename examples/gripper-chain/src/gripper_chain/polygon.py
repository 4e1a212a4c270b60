"""Chapters on the chain, on the bars, and on the polygon that the chain forms on its sprockets."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Chapter,
    abscissa,
    as_number,
    inner,
    lookup,
    m,
    pi,
    reduction,
    standard_table,
    table_beside,
    value,
)

# fmt: off

CHAINS = table_beside(__file__, "chains.csv")

chain = Chapter(
    "Chain", text="Dimensions of the chain by ISO 606, series B. Two chains run side by side, and the bars join them."
)
for id, symbol, name, table in (
    ("pitch", "p", "Pitch", "iso_606_pitches"),
    ("pin_diameter", "d_p", "Diameter of the pins", "iso_606_pin_diameters"),
    ("inner_width", "b_1", "Width between the inner plates", "iso_606_inner_widths"),
):
    chain[id] = lookup(standard_table(table), by="chain", output=id == "pitch"), symbol, "mm", name, "ISO 606"
for id, symbol, unit, name in (
    ("plate_thickness", "t", "mm", "Thickness of a plate"),
    ("breaking_load", "F_B", "kN", "Breaking load of a chain"),
    ("mass_per_length", "q", "kg/m", "Mass per length of a chain"),
):
    chain[id] = lookup(CHAINS, by="chain", column=id, output=id != "plate_thickness"), symbol, unit, name, "catalogue"
chain.joint_area = (m.pin_diameter * (m.inner_width + 2 * m.plate_thickness),
    "A", "mm**2", "Bearing area of a joint: pin and bush", "geometry")

bars = Chapter(
    "Bars and speed",
    text="Each bar brings one sheet, so the chain runs one spacing of the bars in the time of a sheet.",
)
bars.links_whole = (inner(m.bar_links * np.ceil(m.links / m.bar_links), whole=True),
    "X_k", "1", "Next number of links that is a multiple of the spacing")
bars.require("bars_fit", m.links == m.links_whole, key="links",
    message="is {links}, not a multiple of bar_links = {bar_links}, so that one gap between bars would be shorter; take {links_whole}")
bars.bar_count = value(m.links / m.bar_links, whole=True), "N_b", "1", "Gripper bars"
bars.bar_spacing = m.bar_links * m.pitch, "L", "mm", "Distance of the bars along the chain"
bars.chain_speed = m.sheet_rate * m.bar_spacing, "v", "m/s", "Mean speed of the chain"
bars.sprocket_speed = (2 * pi * m.chain_speed / (m.teeth * m.pitch),
    "ω", "rpm", "Speed of the sprockets", "Shigley, 17-5")
bars.pitch_radius = (m.pitch / (2 * np.sin(pi / m.teeth)),
    "R", "mm", "Radius of the circle through the joints", "Shigley, 17-5")

polygon = Chapter(
    "Polygon effect",
    text="On the sprocket the chain forms a polygon. While the sprocket turns by one tooth, the joint that engaged last pulls the upper strand: "
    "from θ = 0, where it engages, to θ = τ, where the next one does. The strand moves along its own line, so only that component of the "
    "joint's velocity counts.",
)
polygon.half_tooth = inner(pi / m.teeth), "α", "deg", "Half the pitch angle of the sprocket"
polygon.tooth_angle = 2 * pi / m.teeth, "τ", "deg", "Pitch angle of the sprocket"
polygon.sprocket_angle = (abscissa("tooth_angle", speed="sprocket_speed", shown_at="tension_max_at"),
    "θ", "deg", "Angle of the sprocket since the last joint engaged")
from_middle = m.sprocket_angle - m.half_tooth
polygon.velocity = (m.pitch_radius * m.sprocket_speed * np.cos(from_middle),
    "v_θ", "m/s", "Velocity of the upper strand", "Roloff/Matek")
polygon.acceleration = (-m.pitch_radius * as_number(m.sprocket_speed) ** 2 * np.sin(from_middle),
    "a_θ", "m/s**2", "Acceleration of the upper strand", "kinematics")
polygon.advance = (m.pitch_radius * (np.sin(m.half_tooth) + np.sin(from_middle)),
    "x_θ", "mm", "Displacement of the strand since the joint engaged", "kinematics")
polygon.ripple = (m.advance - m.pitch * m.sprocket_angle / m.tooth_angle,
    "δ_θ", "mm", "Lead of the strand over its mean motion")
polygon.velocity_max = reduction("max", of="velocity"), "v_max", "m/s", "Maximum velocity"
polygon.velocity_min = reduction("min", of="velocity"), "v_min", "m/s", "Minimum velocity"
polygon.acceleration_max = (reduction("abs_max", of="acceleration"),
    "a_max", "m/s**2", "Maximum acceleration, of either sign")
polygon.ripple_max = reduction("abs_max", of="ripple"), "δ_max", "mm", "Maximum deviation from the mean motion"
polygon.unevenness = (1 - m.velocity_min / m.velocity_max,
    "u", "%", "Relative drop in velocity within a tooth", "Shigley, 17-5")
