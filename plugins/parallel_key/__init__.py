"""Parallel key: pressure of shaft, hub and key, and shear, DIN 6892 method B, dimensions of DIN 6885-1."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.parallel_key import load, pressures
from diecut_report.plugins.parallel_key.checks import CHECKS
from diecut_report.plugins.parallel_key.dimensions import dimensions
from diecut_report.plugins.parallel_key.example import EXAMPLE
from diecut_report.plugins.parallel_key.figures import FIGURES
from diecut_report.plugins.parallel_key.inputs import ParallelKey

MECHANISM = Mechanism(
    kind="parallel_key",
    version="1.0",
    title="Parallel key",
    summary="Pressure on the shaft keyway, the hub keyway and the key, and shear of the key, under the equivalent and the maximum torque. If the "
            "length of the key is omitted, the smallest sufficient standard length is selected.",
    inputs=ParallelKey,
    example=EXAMPLE,
    chapters=(load.cycle, load.load, dimensions, pressures.allowed, pressures.needed, pressures.pressures),
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
