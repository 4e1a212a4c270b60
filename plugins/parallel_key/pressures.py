"""Chapters on the length, the pressures on shaft, hub and key, and the key's shear."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind, case
from diecut_report.plugins.parallel_key.dimensions import LENGTHS, LONGEST_KEY
from diecut_report.plugins.parallel_key.load import BY_LIFE, CURVE, FACTOR_GIVEN, KNOWN, METHOD

# fmt: off

PARTS = {"shaft": "W", "hub": "N", "key": "P"}
LOADS = {"": ("key_force", "direction_factor", "", "equivalent"), "_peak": ("key_force_peak", "load_peak_factor", "max", "maximum")}
"""Of the regular load and the peak: the force, the factor of what is allowed, the symbol's end, and words."""
CASES = [(part, load) for load in LOADS for part in PARTS]
SIX = ("shaft", "hub", "key", "shaft_peak", "hub_peak", "key_peak")

allowed = Chapter("Allowable stresses",
    text="Each part withstands more than its yield strength because of the support of the material around the loaded face.")
needed = Chapter("Required length",
    text="The smallest bearing length at which all pressures and the shear of the key are within the allowable values.")
allowed.value("support_shaft", "f_SW", "1", "Support factor of the shaft, of steel", lambda: 1.3, source=METHOD, output=False)
allowed.value("support_hub", "f_SN", "1", "Support factor of the hub, of steel", lambda: 1.5, source=METHOD, needs=("brittle_hub=false",),
    output=False)
allowed.value("support_hub", "f_SN", "1", "Support factor of the hub, of cast iron", lambda: 2, source=METHOD, needs=("brittle_hub=true",),
    output=False)
allowed.value("support_key", "f_SP", "1", "Support factor of the key", lambda: 1.1, source=METHOD, output=False)
for part, load in CASES:
    _, factor, end, words = LOADS[load]
    allowed.value(f"allowed_{part}{load}", f"p_{PARTS[part]}zul{end}", "MPa", f"Allowable pressure on the {part}, {words} load",
        bind(lambda factor, support, strength: factor * support * strength, factor=factor, support=f"support_{part}", strength=f"yield_{part}"),
        source=METHOD, output=False)
allowed.value("allowed_shear", "τ_zul", "MPa", "Allowable shear stress of the key", lambda yield_key: yield_key / np.sqrt(3),
    source="strength of materials", output=False)
for part, load in CASES:
    force, _, end, words = LOADS[load]
    needed.value(f"length_{part}{load}", f"l_{PARTS[part]}{end}", "mm", f"Bearing length required by the {part}, {words} load",
        bind(lambda force, height, allowed, load_distribution_factor: load_distribution_factor * force / (height * allowed), force=force,
            height=f"height_{part}", allowed=f"allowed_{part}{load}"), source=METHOD, output=False)
needed.value("length_shear", "l_τ", "mm", "Bearing length required by the shear of the key",
    lambda key_force_peak, width, allowed_shear: key_force_peak / (width * allowed_shear), source="strength of materials", output=False)
needed.value("length_pressed", "l_p", "mm", "Bearing length required by the pressures",
    bind(lambda shaft, hub, key, shaft_peak, hub_peak, key_peak:
            np.maximum(np.maximum(np.maximum(shaft, hub), key), np.maximum(np.maximum(shaft_peak, hub_peak), key_peak)),
        **{name: f"length_{name}" for name in SIX}), source=METHOD, output=False)
needed.value("bearing_length_needed", "l_tr,req", "mm", "Required bearing length",
    lambda length_pressed, length_shear: np.maximum(length_pressed, length_shear), source="this method", output=False)
needed.value("round_ends", "l_r", "mm", "Length of the round ends, which do not carry", lambda width: width, needs=("form=A",), source="DIN 6892",
    output=False)
needed.value("round_ends", "l_r", "mm", "Length of the round ends: square ends carry fully", lambda: 0, needs=("form=B",), source="DIN 6892",
    output=False)
needed.value("least_key_length", "l_min", "mm", "Minimum length of the key",
    lambda bearing_length_needed, round_ends: bearing_length_needed + round_ends, source=METHOD, output=False)
needed.require("standard_key_exists", lambda least_key_length: least_key_length <= LONGEST_KEY, key="shaft_diameter", lacks=("key_length",),
    message="is {shaft_diameter}, on which the key would have to be {least_key_length} long; the longest standard key has 280 mm: take a thicker "
        "shaft, two keys or stronger material")
needed.pick("standard_key_length", "l_std,req", "mm", "Next standard length", "above", of="least_key_length", series=LENGTHS, beyond="last",
    source="DIN 6885-1", output=False)
needed.value("required_key_length", "l_req", "mm", "Smallest sufficient standard length", lambda standard_key_length: standard_key_length,
    exists=lambda least_key_length: least_key_length <= LONGEST_KEY, source="DIN 6885-1")

pressures = Chapter("Pressures",
    text="Shaft and hub each bear on their own height of the key; the pressure on the key is highest where this height is smaller.")
pressures.value("key_length", "l", "mm", "Length of the key: as given", bind(lambda given: given, given="inputs.key_length"), needs=("key_length",),
    source="input")
pressures.value("key_length", "l", "mm", "Length of the key: the smallest sufficient standard length",
    lambda required_key_length: required_key_length, lacks=("key_length",), source="this method")
pressures.require("longer_than_wide", lambda key_length, round_ends: key_length > round_ends, key="key_length", needs=("key_length", "form=A"),
    message="is {key_length}, of which the round ends of the {width} wide key leave nothing to bear; take a longer key, or form B")
BEARING = ("bearing_length", "l_tr", "mm")
pressures.value(*BEARING, "Bearing length, no longer than the hub",
    lambda key_length, round_ends, hub_length: np.minimum(key_length - round_ends, hub_length), needs=("hub_length",), source=METHOD)
pressures.value(*BEARING, "Bearing length", lambda key_length, round_ends: key_length - round_ends, lacks=("hub_length",), source=METHOD)
for part, load in CASES:
    force, _, end, words = LOADS[load]
    pressures.value(f"pressure_{part}{load}", f"p_{PARTS[part]}{end}", "MPa", f"Pressure on the {part}, {words} load",
        bind(lambda force, height, length, load_distribution_factor: load_distribution_factor * force / (height * length), force=force,
            height=f"height_{part}", length="bearing_length"), source=METHOD)
pressures.value("shear_stress", "τ", "MPa", "Shear stress of the key, maximum load",
    lambda key_force_peak, width, bearing_length: key_force_peak / (width * bearing_length), source="strength of materials")
for part, load in CASES:
    pressures.value(f"safety_{part}{load}", f"S_{PARTS[part]}{LOADS[load][2]}", "1", f"Safety factor of the {part}, {LOADS[load][3]} load",
        bind(lambda limit, pressure: limit / pressure, limit=f"allowed_{part}{load}", pressure=f"pressure_{part}{load}"), source=METHOD,
        output=False)
pressures.value("safety", "S", "1", "Minimum safety factor", bind(lambda shaft, hub, key, shaft_peak, hub_peak, key_peak:
        np.minimum(np.minimum(np.minimum(shaft, hub), key), np.minimum(np.minimum(shaft_peak, hub_peak), key_peak)),
    **{name: f"safety_{name}" for name in SIX}), source=METHOD)
pressures.value("safety_peak", "S_max", "1", "Minimum safety factor under the maximum load",
    lambda safety_shaft_peak, safety_hub_peak, safety_key_peak: np.minimum(np.minimum(safety_shaft_peak, safety_hub_peak), safety_key_peak),
    source=METHOD, output=False)
pressures.choice("governing", "G", "1", "Governing part and load",
    *(case(f"{part}, {LOADS[load][3]} load", f"the {part} has the lowest safety factor, under the {LOADS[load][3]} load",
           bind(lambda own, safety: own <= safety, own=f"safety_{part}{load}")) for part, load in CASES[:-1]),
    case("key, maximum load", "the key has the lowest safety factor, under the maximum load"), source=METHOD)
pressures.value("longest_wanted", "l_max", "mm", "Maximum bearing length over which the load still distributes",
    lambda shaft_diameter: 1.3 * shaft_diameter, source=METHOD, output=False)
pressures.pick("nearest_length", "l_std", "mm", "Nearest standard length", "nearest", of="key_length", series=LENGTHS, beyond="last",
    source="DIN 6885-1", output=False)
pressures.value("length_off", "Δl", "mm", "Deviation from it", lambda key_length, nearest_length: abs(key_length - nearest_length),
    source="this method", output=False)
pressures.choice("reversal_left_out", "n_w", "1", "Reversing torque not considered (1) or considered (0)",
    case(lambda: 1, "the torque reverses, and the number of reversals in the life is not known", lambda reversing: reversing > 0),
    case(lambda: 0, "the torque keeps its sign"), source="this method", output=False, lacks=KNOWN)
for needs, lacks in ((BY_LIFE, ()), (("flank_changes",), ()), (FACTOR_GIVEN, CURVE)):
    pressures.value("reversal_left_out", "n_w", "1", "Reversing torque not considered: no, the factor includes it", lambda: 0, source="this method",
        output=False, needs=needs, lacks=lacks)
pressures.choice("reversal_left_out", "n_w", "1", "Reversing torque not considered (1) or considered (0)",
    case(lambda: 1, "the factor is greater than with the load direction changes that the curve has at least",
        lambda load_direction_factor, factor_of_least: load_direction_factor > factor_of_least), case(lambda: 0, "the factor includes it"),
    source="this method", output=False, needs=(*CURVE, *FACTOR_GIVEN))
