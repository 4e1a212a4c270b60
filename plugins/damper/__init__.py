"""Rubber end-of-stroke damper: length, load, stop, buckling (002 eq. 18–23)."""

from __future__ import annotations

from dataclasses import replace

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.damper.figures import FIGURES
from diecut_report.plugins.damper.steps import SECTIONS, SLENDEREST, STOPPED, Damper

EXAMPLE = ExampleBlock(
    "damper",
    {
        "mass": Wired("${<cylinder_sizing>.mass}", otherwise="104 kg"),
        "inertia": Wired("${<cylinder_sizing>.inertia}", otherwise="0.74 kg*m**2"),
        "rolling_radius": Wired("${<cylinder_sizing>.radius}", otherwise="105.5 mm"),
        "velocity": "0.6 m/s",
        "carriage_mass": "40 kg",
        "static_unbalance": Wired("${<cylinder_sizing>.static_unbalance}", otherwise="2 kg*m"),
        "contact_distance": "10 mm",
        "shore_hardness": 70,
        "dynamic_stiffness_factor": 1.5,
        "ring_width": "60 mm",
        "pad_height": "60 mm",
        "loss_tangent": 0.15,
    },
)


RUBBER, PAD = ("elastic_modulus", "shore_hardness"), ("ring_width", "pad_height")
ADVISE = ("adopted_length", *RUBBER, Vary("damper_count", "up"), PAD, (*PAD, "adopted_length"))
LONGER, SOFTER = ("adopted_length", Vary("damper_count", "up")), ("adopted_length", *RUBBER)

CHECKS = (
    Check("strain", "strength", "Strain within the linear law", m.strain, m.max_strain, demand_label="strain", limit_label="linear up to",
        consequence="the rubber is stiffer then than calculated, and the force greater.", advise=ADVISE),
    Check("stress", "strength", "Compressive stress", m.stress, m.allowable_stress, sized_unless=("adopted_length",), demand_label="stress",
        consequence="the block is too short to take up the energy.", advise=ADVISE),
    Check("dynamic_stiffness", "strength", "Stiffness of the rubber at the impact", m.dynamic_stiffness_factor, m.stiffness_borne,
        sized_unless=("adopted_length",), demand_label="ratio of dynamic to static stiffness", limit_label="limit for the allowable stress",
        consequence="at the speed of the impact the rubber is too stiff for the block's length.", advise=ADVISE),
    Check("slenderness", "strength", "Buckling of the block", m.slenderness, SLENDEREST, limit_label="straight up to",
        source="block with clamped ends", consequence="the block buckles before it has taken up the energy.", advise=ADVISE),
    Check("driven_stress", "strength", "Stress with the drive still pushing", m.driven_stress, m.allowable_stress, demand_label="stress",
        source="energy", consequence="the work of the drive adds to the energy; it does not where it is let go before the stop.", advise=ADVISE),
    Check("driven_strain", "strength", "Strain with the drive still pushing", m.driven_strain, m.max_strain, demand_label="strain",
        limit_label="linear up to", source="energy",
        consequence="the work of the drive presses the rubber beyond its linear law; it does not where it is let go before the stop.", advise=ADVISE),
    Check("force", "strength", "Force of a damper", m.peak_force, m.allowable_force, demand_label="maximum force", source="input",
        consequence="carriage or frame yields.", advise=LONGER),
    Check("deceleration", "function", "Deceleration of the stop", m.peak_deceleration, m.allowable_deceleration, source="input",
        consequence="the stop shakes the machine.", advise=SOFTER),
    Check("heat_power", "strength", "Heat of the dampers", m.heat_power, m.allowable_heat_power, demand_label="heat of one end", source="input",
        consequence="the rubber softens and ages; dampers that are met later (with a smaller velocity) or a rubber that loses less help."),
    Check("driven_force", "strength", "Force of a damper with the drive", m.driven_peak_force, m.allowable_force, demand_label="maximum force",
        source="input", consequence="carriage or frame yields; a drive that is let go makes it less.", advise=LONGER),
    Check("driven_deceleration", "function", "Deceleration with the drive", m.driven_peak_deceleration, m.allowable_deceleration,
        demand_label="maximum deceleration", source="input", consequence="the stop shakes the machine.", advise=SOFTER),
)  # fmt: skip

MECHANISM = Mechanism(
    kind="damper",
    version="1.0",
    title="Rubber end-of-stroke damper",
    summary="Rubber blocks on the guides, at both ends of the travel and on both sides of the cylinder, absorb its remaining kinetic energy. "
            "From energy, rubber and pad follow the length of the blocks, their stress, strain and force, the time and deceleration of the stop, "
            "the rebound and the heat; the blocks are checked against buckling, and against a drive that still pushes.",
    inputs=Damper,
    example=EXAMPLE,
    chapters=SECTIONS,
    key_results=("kinetic_energy", "free_length", "adopted_length", "stress", "strain", "deflection", "peak_force", "peak_deceleration",
                 "stop_time", "rebound_velocity", "heat_power", "slenderness", "driven_deflection", "driven_stress"),
    checks=tuple(replace(check, needs=(*check.needs, *known)) for known in (("kinetic_energy",), STOPPED) for check in CHECKS),
    figures=FIGURES,
    assumptions=(
        "The rubber is linear in compression, and its ends are free to bulge: the modulus is that of the material, regardless of the shape of "
        "the block.",
        "The dampers that act at once share the energy equally; all of it is absorbed within one stroke of the damper, and the loss of energy in "
        "the rubber does not reduce the force.",
        "All moving parts stop together: guides, carriage and frame are rigid.",
        "If the carriages, unbalance and contact_distance of a cylinder are not given, the energy is that of mass, inertia and speed alone, "
        "which is too low: nothing that follows from it is checked.",
        "Without dynamic_stiffness_factor the rubber is as stiff as at rest. At an impact it is stiffer, usually by a factor of 1.2 to 2; stress "
        "and force grow with its square root.",
        "A drive that still pushes does so with a constant force in the direction of travel; without drive the stopped body moves freely.",
    ),
    sources=(
        Source("002", "Loizyk V. V., Bryndas A. M., Shelonh N. M., Ternytskyi S. V. Analytical studies of drive mechanism parameters of "
               "flat cylinder die-cutting press. Lviv Polytechnic National University (in Ukrainian)."),
        Source("Gent 1958", "Gent A. N. On the relation between indentation hardness and Young's modulus. "
               "Rubber Chemistry and Technology 31 (1958), 896–906."),
    ),
)  # fmt: skip
