"""Platen press: torque at the main shaft with elastic rods and friction in the joints (001, Banakh, eq. 1–17)."""

from __future__ import annotations

from diecut_report.api import Erratum, Mechanism, Source
from diecut_report.plugins.platen_press import motion, torque
from diecut_report.plugins.platen_press.checks import CHECKS
from diecut_report.plugins.platen_press.example import EXAMPLE
from diecut_report.plugins.platen_press.figures import FIGURES
from diecut_report.plugins.platen_press.inputs import PlatenPress

MECHANISM = Mechanism(
    kind="platen_press",
    version="1.0",
    title="Platen press: torque with elastic rods and joint friction",
    summary="A crank pulls the platen by two rods against the die, near its inner dead centre. The rods elongate while the board is cut, and "
            "relax after the dead centre while the platen stands. The calculation gives contact and dwell, the platen's ideal and true motion, "
            "the force of the rods, the torque at the main shaft split into useful torque and friction, and work and power of a cycle.",
    inputs=PlatenPress,
    example=EXAMPLE,
    chapters=(motion.machine, motion.contact, motion.motion, motion.window, torque.forces, torque.friction, torque.guides,
              torque.torque,
              torque.returning,
              torque.work, *torque.PRESSURES, torque.rods),
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
