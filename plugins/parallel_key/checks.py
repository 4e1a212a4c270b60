"""Checks of the parallel key."""

from __future__ import annotations

from diecut_report.api import Check, Vary
from diecut_report.plugins.parallel_key.dimensions import LENGTHS
from diecut_report.plugins.parallel_key.load import JUDGED, METHOD

# fmt: off

SIZED = ("key_length",)
FLANKS, DISTRIBUTION = ("load_direction_factor", "flank_changes"), "load_distribution_factor"
LONGER = (Vary("key_length", "up", LENGTHS), "key_count")


def _pressure(part: str) -> Check:
    return Check(id=f"pressure_{part}", check_class="strength", title=f"Pressure on the {part}", demand=f"pressure_{part}", limit=f"allowed_{part}",
                 unit="MPa", needs=JUDGED, founded=(*FLANKS, DISTRIBUTION), sized_unless=SIZED, demand_label="pressure",
                 limit_label="allowed", source=METHOD,
                 consequence=f"the {part} yields where the key bears; a thicker shaft or stronger material helps, too.", advise=LONGER)


CHECKS = (
    _pressure("shaft"),
    _pressure("hub"),
    _pressure("key"),
    Check(id="pressure_peak", check_class="strength", title="Pressure under the maximum torque", demand=1.0, limit="safety_peak", unit="1",
        founded=(DISTRIBUTION,), sized_unless=SIZED, demand_label="required safety factor", limit_label="minimum safety factor",
        source=METHOD, advise=LONGER,
        consequence="a part yields at the peak, governing load case: {peak_case}; a thicker shaft or stronger material helps, too."),
    Check(id="shear", check_class="strength", title="Shear of the key", demand="shear_stress", limit="allowed_shear", unit="MPa",
        sized_unless=SIZED, demand_label="shear stress", limit_label="allowed", source="strength of materials",
        consequence="the key is sheared off; a thicker shaft or stronger material helps, too.", advise=LONGER),
    Check(id="length_ratio", check_class="practice", presumed=True, title="Ratio of length to diameter", demand="bearing_length",
        limit="longest_wanted", unit="mm", severity="warn", demand_label="bearing length", limit_label="1.3 diameters",
        source=METHOD, consequence="the load no longer spreads over so long a key; take a thicker shaft, two keys or stronger material."),
    Check(id="reversing", check_class="practice", title="Reversing torque", demand="reversal_left_out", limit=0.0, unit="1", severity="warn",
        founded=FLANKS, demand_label="reversing torque not considered", limit_label="accepted", source=METHOD,
        consequence="the key works loose where the torque turns round often; give required_life and cycle_speed, by which the changes of flank are "
            "counted, or flank_changes itself."),
    Check(id="two_keys", check_class="practice", title="Two keys in a brittle hub", demand="key_count", limit=1.0, unit="1", severity="warn",
        needs=("brittle_hub=true",), demand_label="keys", limit_label="accepted in a brittle hub", source=METHOD,
        consequence="a brittle hub does not even out the load of two keys; a hub of steel does.", advise=("key_count",)),
    Check(id="standard_length", check_class="practice", title="Standard length", demand="length_off", limit=0.0, unit="mm", severity="warn",
        demand_label="off the nearest standard length", limit_label="accepted", source="DIN 6885-1",
        consequence="no key of the shelf is so long; the nearest one has {nearest_length}.", advise=(Vary("key_length", series=LENGTHS),)),
    Check(id="hub_length", check_class="practice", title="Key within the hub", demand="key_length", limit="hub_length", unit="mm", severity="warn",
        needs=("hub_length",), demand_label="key", limit_label="hub", source="geometry",
        consequence="what stands out of the hub does not bear.", advise=("hub_length", Vary("key_length", "down", LENGTHS))),
)
