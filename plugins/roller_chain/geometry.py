"""Chapters on the chain and its loop over two sprockets."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind
from diecut_report.mechanics import drive_line
from diecut_report.plugins.roller_chain import formulas as f
from diecut_report.plugins.roller_chain.chains import BY_PITCH, CHAINS
from diecut_report.plugins.roller_chain.inputs import CUSTOM

# fmt: off

SHIGLEY = "Shigley, eq. 17-34 … 17-36"
TEETH = {1: "teeth_1", 2: "driven_teeth"}
BOTH = {"teeth_1": "teeth_1", "teeth_2": "driven_teeth"}
GIVEN_DISTANCE = ("center_distance",)

TAKEN = {
    "pitch": ("p", "mm", "Pitch"), "pin_diameter": ("d_p", "mm", "Diameter of the pins"),
    "breaking_load": ("F_B", "kN", "Breaking load of one strand"),
    "mass_per_length": ("q", "kg/m", "Mass per unit length of one strand"),
}
MEASURED = {"inner_width": ("b_1", "mm", "Width between the inner plates"), "plate_thickness": ("t_i", "mm", "Thickness of the inner plates")}
SHARES = {"pitch": (0.999, 1.001), "pin_diameter": (0.8, 1.25), "bearing_area": (0.5, 1.25), "breaking_load": (0.5, 1.25),
          "mass_per_length": (0.5, 1.25)}
"""Within what share of its row of the table a value of a chain can be, whoever makes it."""

chain = Chapter("Chain", text="All values are those of one strand.")
for key, (symbol, unit, words) in TAKEN.items():
    chain.lookup(key, symbol, unit, words, CHAINS, by="chain", column=key, given=key, needs=("chain",), source="ISO 606")
    if key != "pitch":
        chain.interpolated(key, symbol, unit, f"{words} of this pitch", BY_PITCH, of="pitch", column=key, key="chain", lacks=("chain",),
            source="ISO 606")
for key, (symbol, unit, words) in MEASURED.items():
    chain.lookup(key, symbol, unit, words, CHAINS, by="chain", column=key, needs=("chain",), lacks=(CUSTOM,), source="ISO 606", output=False)
    chain.interpolated(key, symbol, unit, f"{words} of this pitch", BY_PITCH, of="pitch", column=key, key="chain", lacks=("chain", "bearing_area"),
        source="ISO 606", output=False)
chain.value("bearing_area", "A", "mm**2", "Bearing area of a joint: pin and bush, whose length is the width of the inner link", f.bearing_area,
    lacks=("bearing_area",), source="geometry")
chain.value("bearing_area", "A", "mm**2", "Bearing area of a joint: as given", bind(lambda given: given, given="inputs.bearing_area"),
    needs=("bearing_area",), source="input")
for key, (symbol, unit, words) in TAKEN.items():
    chain.lookup(f"{key}_of_table", f"{symbol},t", unit, f"{words}: that of the table", CHAINS, by="chain", column=key, needs=("chain",),
        lacks=(CUSTOM,), source="ISO 606", output=False)
chain.value("bearing_area_of_table", "A_t", "mm**2", "Bearing area of a joint: that of the table",
    bind(f.bearing_area, pin_diameter="pin_diameter_of_table"), needs=("chain",), lacks=(CUSTOM,), source="geometry", output=False)
for key, (least, most) in SHARES.items():
    chain.require(f"{key}_as_table", bind(lambda given, own, least, most: (given >= least * own) & (given <= most * own),
        given=f"inputs.{key}", own=f"{key}_of_table", least=least, most=most), key=key,
        needs=("chain", key), lacks=(CUSTOM,),
        message=f"is {{inputs.{key}}}, but the table has {{{key}_of_table}} for this designation, and no maker less than {least:g} or more than "
            f"{most:g} times that; correct it, or its unit, or the designation, or set chain to custom with all its values")

loop = Chapter("Loop over the sprockets",
    text="The number of links follows from the centre distance and is even, so that no link is cranked; with whole links the distance is adjusted. "
        "The catalogue formulas are compared with the exact polygon.")
loop.value("teeth_small", "z_s", "1", "Number of teeth of the smaller sprocket", lambda teeth_1, driven_teeth: np.minimum(teeth_1, driven_teeth),
    source="geometry", whole=True, output=False)
for g, teeth in TEETH.items():
    loop.value(f"sprocket_diameter_{g}", f"d_{g}", "mm", f"Pitch circle diameter of the {'driving' if g == 1 else 'driven'} sprocket",
        bind(drive_line.sprocket_diameter, teeth=teeth), source="geometry", digits=6)
loop.value("center_least", "a_min", "mm", "Centre distance at which the sprockets touch",
    lambda sprocket_diameter_1, sprocket_diameter_2: (sprocket_diameter_1 + sprocket_diameter_2) / 2, source="geometry", output=False)
loop.require("sprockets_apart", lambda center_distance, center_least: center_distance > center_least, key="center_distance", needs=GIVEN_DISTANCE,
    message="is {center_distance}, at which sprockets of {sprocket_diameter_1} and {sprocket_diameter_2} overlap; give more than {center_least:up}")
loop.value("links_exact", "X_0", "1", "Number of links required by the centre distance", bind(f.exact_links, center="center_distance", **BOTH),
    needs=GIVEN_DISTANCE, source=SHIGLEY, digits=7)
loop.value("links", "X", "1", "Links: the next even number", bind(f.even_links, exact="links_exact"), needs=GIVEN_DISTANCE, source=SHIGLEY,
    whole=True)
loop.value("links", "X", "1", "Links: as given", bind(lambda given: given, given="inputs.links"), lacks=GIVEN_DISTANCE, source="input", whole=True)
loop.value("links_free", "B", "1", "Links that are not on the sprockets", bind(drive_line.free_links, **BOTH), source=SHIGLEY, output=False, digits=6)
loop.value("links_discriminant", "D_X", "1", "Condition for a whole number of links (positive)",
    bind(drive_line.links_discriminant, free="links_free", **BOTH), source=SHIGLEY, output=False, digits=6)
loop.require("long_enough", lambda links_free, links_discriminant: (links_free > 0) & (links_discriminant > 0), key="links", lacks=GIVEN_DISTANCE,
    message="is {inputs.links}, too few to go round sprockets of {teeth_1} and {driven_teeth} teeth; give more links or fewer teeth")
loop.value("center_distance_adjusted", "a_X", "mm", "Centre distance for this number of links",
    bind(drive_line.chain_center_distance, free="links_free", root_of="links_discriminant"), source=SHIGLEY, digits=7)
loop.require("adjusted_apart", lambda center_distance_adjusted, center_least: center_distance_adjusted > center_least, key="links",
    lacks=GIVEN_DISTANCE,
    message="is {inputs.links}, with which the sprockets overlap: the centre distance would be {center_distance_adjusted}, and they touch at "
        "{center_least}; give more links")
loop.value("center", "a", "mm", "Centre distance, for the tensions: as given", lambda center_distance: center_distance, needs=GIVEN_DISTANCE,
    source="input", output=False)
loop.value("center", "a", "mm", "Centre distance, for the tensions", lambda center_distance_adjusted: center_distance_adjusted, lacks=GIVEN_DISTANCE,
    source=SHIGLEY, output=False)
loop.value("chain_length", "L", "m", "Length of the chain", lambda links, pitch: links * pitch, source="geometry")
loop.value("links_polygon", "X_e", "1", "Number of links at the adjusted distance by the exact polygon",
    bind(f.polygon_links, center="center_distance_adjusted", diameter_1="sprocket_diameter_1", diameter_2="sprocket_diameter_2", **BOTH),
    source="geometry", output=False, digits=8)
loop.value("links_residual", "ΔX", "1", "Deviation of the formula from the exact polygon, in links",
    lambda links_polygon, links: abs(links_polygon - links), source="geometry", output=False)
loop.value("wrap_small", "β_s", "deg", "Wrap of the smaller sprocket",
    lambda sprocket_diameter_1, sprocket_diameter_2, center: np.pi - 2 * np.arcsin(abs(sprocket_diameter_2 - sprocket_diameter_1) / (2 * center)),
    source="geometry")
loop.value("center_in_pitches", "a_p", "1", "Centre distance in pitches", lambda center, pitch: center / pitch, source="geometry", output=False)
loop.value("links_odd", "X_2", "1", "Links in excess of an even number", lambda links: links - 2 * np.floor(links / 2), source="this method",
    output=False)
