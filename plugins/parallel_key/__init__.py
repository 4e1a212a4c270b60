"""Parallel key: pressure of shaft, hub and key, and shear, in the manner of DIN 6892 method C, dimensions of DIN 6885-1."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.parallel_key import load, pressures
from diecut_report.plugins.parallel_key.checks import CHECKS, advice
from diecut_report.plugins.parallel_key.dimensions import dimensions
from diecut_report.plugins.parallel_key.example import EXAMPLE
from diecut_report.plugins.parallel_key.figures import FIGURES
from diecut_report.plugins.parallel_key.inputs import ParallelKey

MECHANISM = Mechanism(
    kind="parallel_key",
    version="1.0",
    title="Parallel key",
    summary="Pressure of the shaft's keyway, the hub's and the key, and shear of the key, under the equivalent and the greatest torque. Where the "
    "key's length is left out, the least standard one is taken that is enough.",
    inputs=ParallelKey,
    example=EXAMPLE,
    chapters=(load.cycle, load.load, dimensions, pressures.allowed, pressures.needed, pressures.pressures, advice),
    key_results=("key_length", "key_force", "pressure_shaft", "pressure_hub", "safety", "governing"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "Method C of DIN 6892 uses one mean pressure on the hub's height for all parts; here each part has its own height. The shaft's is the "
        "greater, so that the pressure of the hub, which governs, is unchanged.",
        "The limit of 0.9 times the strength and the share of 0.75 of the second key were confirmed by a public implementation of method C only, not "
        "in the standard itself.",
        "Not covered (method B): support and hardness factors, friction between shaft and hub, uneven spread of the load over the length, diagrams "
        "of load peaks. Nor the notch that the keyway makes in the shaft, sliding hubs, press fits with a key, woodruff and taper keys, bursting of "
        "the hub.",
        "A peak of every turn is a regular load: it counts in the equivalent torque, not with the factor of rare peaks.",
    ),
    sources=(
        Source("DIN 6892", "DIN 6892, Mitnehmerverbindungen ohne Anzug. Passfedern. Berechnung und Gestaltung (parallel keys, calculation)."),
        Source("DIN 6885-1", "DIN 6885-1 (ISO/R 773), parallel keys, high form; dimensions as in Berger's catalogue of standard parts, p. 2079 "
               "(shafts 10 to 44 mm), Siemens Flender MD 31.1, p. 7/3 (38 to 200 mm), and a public table (all)."),
    ),
)  # fmt: skip
