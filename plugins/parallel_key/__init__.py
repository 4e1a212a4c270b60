"""Parallel key: pressure of shaft, hub and key, and shear, DIN 6892 method B, dimensions of DIN 6885-1."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.parallel_key import steps
from diecut_report.plugins.parallel_key.figures import FIGURES
from diecut_report.plugins.parallel_key.steps import JUDGED, LENGTHS, METHOD, ParallelKey, dimensions

# fmt: off

SIZED = ("key_length",)
FLANKS, DISTRIBUTION = ("load_direction_factor", "flank_changes"), "load_distribution_factor"
LONGER = (Vary("key_length", "up", LENGTHS), "key_count")


def _pressure(part: str) -> Check:
    return Check(f"pressure_{part}", "strength", f"Pressure on the {part}", m[f"pressure_{part}"], m[f"allowed_{part}"], needs=JUDGED,
                 founded=(*FLANKS, DISTRIBUTION), sized_unless=SIZED, demand_label="pressure", limit_label="allowed",
                 consequence=f"the {part} yields where the key bears; a thicker shaft or stronger material helps, too.", advise=LONGER)


CHECKS = (
    _pressure("shaft"),
    _pressure("hub"),
    _pressure("key"),
    Check("pressure_peak", "strength", "Pressure under the maximum torque", 1.0, m.safety_peak, founded=(DISTRIBUTION,), sized_unless=SIZED,
        demand_label="required safety factor", limit_label="minimum safety factor", advise=LONGER,
        consequence="a part yields at the peak, governing load case: {peak_case}; a thicker shaft or stronger material helps, too."),
    Check("shear", "strength", "Shear of the key", m.shear_stress, m.allowed_shear, sized_unless=SIZED, demand_label="shear stress",
        limit_label="allowed", consequence="the key is sheared off; a thicker shaft or stronger material helps, too.", advise=LONGER),
    Check("length_ratio", "practice", "Ratio of length to diameter", m.bearing_length, m.longest_wanted, presumed=True, severity="warn",
        demand_label="bearing length", limit_label="1.3 diameters",
        consequence="the load no longer spreads over so long a key; take a thicker shaft, two keys or stronger material."),
    Check("reversing", "practice", "Reversing torque", m.reversal_left_out, 0.0, severity="warn", founded=FLANKS,
        demand_label="reversing torque not considered", source=METHOD,
        consequence="the key works loose where the torque turns round often; give required_life and cycle_speed, by which the changes of flank are "
            "counted, or flank_changes itself."),
    Check("two_keys", "practice", "Two keys in a brittle hub", m.key_count, 1.0, severity="warn", needs=("brittle_hub=true",), demand_label="keys",
        limit_label="accepted in a brittle hub", source=METHOD,
        consequence="a brittle hub does not even out the load of two keys; a hub of steel does.", advise=("key_count",)),
    Check("standard_length", "practice", "Standard length", m.length_off, 0.0, severity="warn", demand_label="off the nearest standard length",
        source="DIN 6885-1", consequence="no key of the shelf is so long; the nearest one has {nearest_length}.",
        advise=(Vary("key_length", series=LENGTHS),)),
    Check("hub_length", "practice", "Key within the hub", m.key_length, m.hub_length, severity="warn", needs=("hub_length",), demand_label="key",
        limit_label="hub", source="geometry", consequence="what stands out of the hub does not bear.",
        advise=("hub_length", Vary("key_length", "down", LENGTHS))),
)


EXAMPLE = ExampleBlock(
    "gear_key",
    {
        "shaft_diameter": Wired("${<shaft>.sections.1.diameter}", otherwise="55 mm"),
        "key_length": "70 mm",
        "torque": Wired("${<cylinder_drive>.crank_torque}", otherwise="500 N*m"),
        "application_factor": Wired(None, needs=("cylinder_drive",), otherwise=1.25),  # a curve holds the dynamics
        "yield_shaft": "650 MPa",
        "yield_hub": "370 MPa",
        "required_life": Wired("20000 h", needs=("cylinder_drive",)),  # the torque reverses in every turn
        "cycle_speed": Wired("${<cylinder_drive>.crank_speed}"),
        "hub_length": "80 mm",
    },
)


MECHANISM = Mechanism(
    kind="parallel_key",
    version="1.0",
    title="Parallel key",
    summary="Pressure on the shaft keyway, the hub keyway and the key, and shear of the key, under the equivalent and the maximum torque. If the "
            "length of the key is omitted, the smallest sufficient standard length is selected.",
    inputs=ParallelKey,
    example=EXAMPLE,
    chapters=(steps.cycle, steps.load, dimensions, steps.allowed, steps.needed, steps.pressures),
    key_results=("key_length", "key_force", "pressure_shaft", "pressure_hub", "safety", "governing"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "Method B of DIN 6892 as public implementations of the 2012 edition state it: support factors at their lower ends, hardness factor 1, no "
        "relief by friction. The load distribution factor of 1.2 is known from one source only; the standard's diagrams give 1 to 2.",
        "The load direction factor follows from the load direction changes; the end of its diagram was not available, and beyond 10⁷ changes it "
        "is extrapolated.",
        "Not covered: the diagrams of load peaks; the notch effect of the keyway on the shaft, sliding hubs, press fits with a key, woodruff and "
        "taper keys, bursting of the hub.",
        "A peak in every revolution is a regular load: it is included in the equivalent torque, not treated with the factor of rare peaks.",
    ),
    sources=(
        Source("DIN 6892", "DIN 6892, Mitnehmerverbindungen ohne Anzug. Passfedern. Berechnung und Gestaltung (parallel keys, calculation)."),
        Source("DIN 6885-1", "DIN 6885-1 (ISO/R 773), parallel keys, high form; dimensions as in Berger's catalogue of standard parts, p. 2079 "
               "(shafts 10 to 44 mm), Siemens Flender MD 31.1, p. 7/3 (38 to 200 mm), and a public table (all)."),
    ),
)  # fmt: skip
