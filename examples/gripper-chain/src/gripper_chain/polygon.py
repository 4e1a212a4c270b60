"""Chapters on the chain, on the bars, and on the polygon that the chain forms on its sprockets."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_number, standard_table, table_beside

CHAINS = table_beside(__file__, "chains.csv")

chain = Chapter(
    "Chain", text="Dimensions of the chain by ISO 606, series B. Two chains run side by side, and the bars join them."
)
for id, symbol, name, table in (
    ("pitch", "p", "Pitch", "iso_606_pitches"),
    ("pin_diameter", "d_p", "Diameter of the pins", "iso_606_pin_diameters"),
    ("inner_width", "b_1", "Width between the inner plates", "iso_606_inner_widths"),
):
    chain.lookup(id, symbol, "mm", name, standard_table(table), by="chain", source="ISO 606", output=id == "pitch")
for id, symbol, unit, name in (
    ("plate_thickness", "t", "mm", "Thickness of a plate"),
    ("breaking_load", "F_B", "kN", "Breaking load of a chain"),
    ("mass_per_length", "q", "kg/m", "Mass per length of a chain"),
):
    chain.lookup(
        id, symbol, unit, name, CHAINS, by="chain", column=id, source="catalogue", output=id != "plate_thickness"
    )
chain.value(
    "joint_area",
    "A",
    "mm**2",
    "Bearing area of a joint: pin and bush",
    lambda pin_diameter, inner_width, plate_thickness: pin_diameter * (inner_width + 2 * plate_thickness),
    source="geometry",
)

bars = Chapter(
    "Bars and speed",
    text="Each bar brings one sheet, so the chain runs one spacing of the bars in the time of a sheet.",
)
bars.value(
    "links_whole",
    "X_k",
    "1",
    "Next number of links that is a multiple of the spacing",
    lambda links, bar_links: bar_links * np.ceil(links / bar_links),
    output=False,
    whole=True,
)
bars.require(
    "bars_fit",
    lambda links, links_whole: links == links_whole,
    key="links",
    message="is {links}, not a multiple of bar_links = {bar_links}, so that one gap between bars would be shorter; take {links_whole}",
)
bars.value("bar_count", "N_b", "1", "Gripper bars", lambda links, bar_links: links / bar_links, whole=True)
bars.value("bar_spacing", "L", "mm", "Distance of the bars along the chain", lambda bar_links, pitch: bar_links * pitch)
bars.value(
    "chain_speed", "v", "m/s", "Mean speed of the chain", lambda sheet_rate, bar_spacing: sheet_rate * bar_spacing
)
bars.value(
    "sprocket_speed",
    "ω",
    "rpm",
    "Speed of the sprockets",
    lambda chain_speed, teeth, pitch: 2 * np.pi * chain_speed / (teeth * pitch),
    source="Shigley, 17-5",
)
bars.value(
    "pitch_radius",
    "R",
    "mm",
    "Radius of the circle through the joints",
    lambda pitch, teeth: pitch / (2 * np.sin(np.pi / teeth)),
    source="Shigley, 17-5",
)

polygon = Chapter(
    "Polygon effect",
    text="On the sprocket the chain forms a polygon. While the sprocket turns by one tooth, the joint that engaged last pulls the upper strand: "
    "from θ = 0, where it engages, to θ = τ, where the next one does. The strand moves along its own line, so only that component of the "
    "joint's velocity counts.",
)
polygon.value(
    "half_tooth", "α", "deg", "Half the pitch angle of the sprocket", lambda teeth: np.pi / teeth, output=False
)
polygon.value("tooth_angle", "τ", "deg", "Pitch angle of the sprocket", lambda teeth: 2 * np.pi / teeth)
polygon.abscissa(
    "sprocket_angle",
    "θ",
    "deg",
    "Angle of the sprocket since the last joint engaged",
    period="tooth_angle",
    speed="sprocket_speed",
    shown_at="tension_max_at",
)
polygon.value(
    "velocity",
    "v_θ",
    "m/s",
    "Velocity of the upper strand",
    lambda pitch_radius, sprocket_speed, sprocket_angle, half_tooth: (
        pitch_radius * sprocket_speed * np.cos(sprocket_angle - half_tooth)
    ),
    source="Roloff/Matek",
)
polygon.value(
    "acceleration",
    "a_θ",
    "m/s**2",
    "Acceleration of the upper strand",
    lambda pitch_radius, sprocket_speed, sprocket_angle, half_tooth: (
        -pitch_radius * as_number(sprocket_speed) ** 2 * np.sin(sprocket_angle - half_tooth)
    ),
    source="kinematics",
)
polygon.value(
    "advance",
    "x_θ",
    "mm",
    "Displacement of the strand since the joint engaged",
    lambda pitch_radius, half_tooth, sprocket_angle: (
        pitch_radius * (np.sin(half_tooth) + np.sin(sprocket_angle - half_tooth))
    ),
    source="kinematics",
)
polygon.value(
    "ripple",
    "δ_θ",
    "mm",
    "Lead of the strand over its mean motion",
    lambda advance, pitch, sprocket_angle, tooth_angle: advance - pitch * sprocket_angle / tooth_angle,
)
polygon.reduction("velocity_max", "v_max", "m/s", "Maximum velocity", "max", of="velocity")
polygon.reduction("velocity_min", "v_min", "m/s", "Minimum velocity", "min", of="velocity")
polygon.reduction(
    "acceleration_max", "a_max", "m/s**2", "Maximum acceleration, of either sign", "abs_max", of="acceleration"
)
polygon.reduction("ripple_max", "δ_max", "mm", "Maximum deviation from the mean motion", "abs_max", of="ripple")
polygon.value(
    "unevenness",
    "u",
    "%",
    "Relative drop in velocity within a tooth",
    lambda velocity_max, velocity_min: 1 - velocity_min / velocity_max,
    source="Shigley, 17-5",
)
