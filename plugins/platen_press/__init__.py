"""Platen press: torque at the main shaft with elastic rods and friction in the joints (001, Banakh, eq. 1–17)."""

from __future__ import annotations

from diecut_report.api import Check, Erratum, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.platen_press import steps
from diecut_report.plugins.platen_press.figures import FIGURES
from diecut_report.plugins.platen_press.steps import PlatenPress


def _pressure(name: str, key: str, demand: str, pins: str) -> Check:
    """The pressure of one kind of pins against what is allowed."""
    return Check(f"contact_stress_{name}", "strength", f"Pressure on the {pins}", demand, m.allowable_pin_pressure, demand_label="pressure",
                 source="input", needs=(key, "allowable_pin_pressure"),
                 consequence=f"the {pins} squeeze out their oil and seize; thicker ones bear more, at the price of more friction.",
                 advise=(Vary(key, "up"),))  # fmt: skip


CHECKS = (
    Check("torque_sign", "function", "Relaxing rods never drive the crank", m.elastic_arm, m.friction_arm, operator="<",
        demand_label="arm of the relaxing rods", limit_label="friction arm", source="001, conclusion 1",
        consequence="the relaxing rods drive the crank ahead and the play of the drive changes sides with a blow.",
        advise=(Vary("drive_deformation", "down"), Vary("rod_area", "up"))),
    Check("inertia", "function", "Inertia of the platen at the dead centre", m.inertia_dead_center, m.cutting_force_max, unit="kN", operator="<",
        demand_label="inertia force", limit_label="cutting force", source="this method",
        consequence="the platen presses on the die by its inertia, and the rods push it instead of pulling: the calculation does not hold about the "
            "dead centre.", advise=(Vary("cycles_per_hour", "down"), Vary("platen_mass", "down"))),
    Check("torque_max", "strength", "Torque at the main shaft", m.torque_max, m.allowable_torque, source="input", needs=("allowable_torque",),
        consequence="the main shaft and its drive are overloaded; shorter rules or softer board lowers the force, and a stiffer drive the torque.",
        advise=(Vary("cutting_force_max", "down"), Vary("drive_deformation", "down"), Vary("cycles_per_hour", "down"))),
    _pressure("journal", "journal_length", "journal_pressure", "journals"),
    _pressure("crank_pin", "crank_pin_length", "crank_pin_pressure", "crank pins"),
    _pressure("platen_pin", "platen_pin_length", "platen_pin_pressure", "platen's pins"),
    Check("rod_stress", "strength", "Stress in the rods", m.rod_stress, m.allowable_rod_stress, demand_label="tensile stress", source="input",
        needs=("rod_net_area", "allowable_rod_stress"), consequence="the rods crack at their weakest section.", advise=(Vary("rod_net_area", "up"),)),
)  # fmt: skip


EXAMPLE = ExampleBlock(
    "platen",
    {
        "cycles_per_hour": "${press.productivity}",
        "material_thickness": "${press.sheet.thickness}",
        "cutting_force_max": "500 kN",
        "platen_mass": "306 kg",
        "drive_deformation": "0.45 mm",
        "crank_radius": "110 mm",
        "rod_length": "635 mm",
        "journal_radius": "50.25 mm",
        "crank_pin_radius": "47.5 mm",
        "platen_pin_radius": "60 mm",
        "journal_length": "120 mm",
        "crank_pin_length": "110 mm",
        "platen_pin_length": "90 mm",
        "allowable_pin_pressure": "30 MPa",
        "carriage_clearance": Wired("40 mm", needs=("cyclogram",)),  # of which the cyclogram takes the window
    },
    press={"productivity": "1200 1/h", "sheet.thickness": "0.5 mm"},
)


MECHANISM = Mechanism(
    kind="platen_press",
    version="1.0",
    title="Platen press: torque with elastic rods and joint friction",
    summary="A crank pulls the platen by two rods against the die, near its inner dead centre. The rods elongate while the board is cut, and "
            "relax after the dead centre while the platen stands. The calculation gives contact and dwell, the platen's ideal and true motion, "
            "the force of the rods, the torque at the main shaft split into useful torque and friction, and work and power of a cycle.",
    inputs=PlatenPress,
    example=EXAMPLE,
    chapters=(steps.machine, steps.contact, steps.motion, steps.window, steps.forces, steps.friction, steps.guides,
              steps.torque,
              steps.returning,
              steps.work, *steps.PRESSURES, steps.rods),
    key_results=("cutting_start_angle", "dwell_end_angle", "velocity_at_contact", "friction_arm", "torque_dead_center", "torque_max",
                 "torque_max_angle", "torque_max_source", "return_arm_min", "friction_limit", "inertia_force_max", "work_per_cycle", "friction_work",
                 "friction_share", "power_mean"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The crank rotates at constant speed; only the rods' direction is elastic: their elongation under load represents that of all parts of "
        "the drive.",
        "The cutting force acts from contact on, increases in proportion to the platen's travel, and vanishes when the platen begins to open.",
        "While the platen moves, its inertia is that of its ideal motion; the rods' own mass, and their elongation under inertia, are not "
        "included.",
        "Friction in the joints follows the force from cutting, elongation and inertia. The thrust of the inclined rods on the guides is not "
        "included (at contact it is tan β_c of the force); nor is the elongation of the rods due to the guides' friction.",
        "The coefficient of friction is a single value. The torque increases with it, and that the relaxing rods do not drive the crank depends "
        "on its not being smaller, as it may be in well lubricated joints.",
        "The stress in the rods is that of tension alone: their bending by the joints' friction and the stress concentration of their eyes are "
        "not included and have to be covered by the allowable stress. Guides and frame are not calculated.",
    ),
    reactions=("crank_pin_force_x", "crank_pin_force_y", "torque"),
    sources=(
        Source("001", "Banakh Yu. O. Estimation of torques during die-cutting, with the compliance of the press, on a machine of the platen type. "
               "Naukovi zapysky (Ukrainian Academy of Printing), 1999, no. 1 (in Ukrainian)."),
    ),
    errata=(
        Erratum("001", "Eq. 14 takes the platen's true speed for the arm of the rods' force. The arm is that of crank and rods, V/ω with the ideal "
                "speed; eq. 14 loses the strain energy of the rods (112.5 J a cycle with the data of the source), which the return gives back.",
                ("torque", "torque_source")),
        Erratum("001", "The scan of eq. 5, 6 and 9 seems to read √(λ² + sin²φ); with λ = l/r it must be √(λ² − sin²φ).",
                ("rod_speed_ratio", "moving_joint_arm")),
        Erratum("001", "The printed maximum torque of 5100 N·m follows from neither formula. With the data of the source eq. 14 rises from 4995 "
                       "N·m at the dead centre to 5496 N·m 2.24° before it and is above 5100 N·m from 4.02° to 0.27° before it; the corrected "
                       "torque reaches 6409 N·m at 3.12° and is above 5100 N·m from 5.62° to 0.13°. 5100 N·m is 2 % above P_max·X = 4996 N·m: it "
                       "leaves the cutting force of 500 kN an arm of 0.21 mm beside friction's 9.99 mm, as at the dead centre itself.",
                ("torque_max", "torque_max_source")),
        Erratum("001", "Conclusion 2 says that a thicker board does not change the maximum torque. It does: with a board of 1 mm instead of 0.5 "
                       "mm cutting begins sooner, where the arm is longer, and the peak rises from 6409 to 6923 N·m (by eq. 14 from 5496 to 6102 "
                       "N·m).",
                ("torque_max",)),
    ),
)  # fmt: skip
