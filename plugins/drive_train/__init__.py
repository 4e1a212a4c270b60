"""Drive train: motor, V-belt, flywheel, gears, toothed belt (002 eq. 7–11, 000 Fig. 1)."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.drive_train import chain, motor, vbelt
from diecut_report.plugins.drive_train.checks import CHECKS
from diecut_report.plugins.drive_train.example import EXAMPLE
from diecut_report.plugins.drive_train.figures import FIGURES
from diecut_report.plugins.drive_train.inputs import DriveTrain
from diecut_report.plugins.drive_train.toothed_belt import (
    TOOTHED_BELT,
    TOOTHED_BELT_ASSUMPTIONS,
    TOOTHED_BELT_CHECKS,
    TOOTHED_BELT_ERRATA,
)

MECHANISM = Mechanism(
    kind="drive_train",
    version="1.0",
    title="Drive train: motor, V-belt, flywheel, gears, toothed belt",
    summary="The motor drives the flywheel shaft through a V-belt; gear pairs drive the output shaft, normally the crank's. The calculation "
            "gives ratios, speeds, torques and powers of all shafts, the belt with a standard length, the motor and its run-up, the flywheel "
            "from the torque over a revolution, and, where there is one, the toothed belt that rolls the cylinder.",
    inputs=DriveTrain,
    example=EXAMPLE,
    chapters=(chain.speeds, vbelt.vbelt, chain.efficiency, chain.turn, chain.powers, chain.balance, motor.motor, vbelt.count,
              vbelt.tensions, motor.flywheel, motor.run_up, *TOOTHED_BELT),
    key_results=("output_speed", "driven_diameter", "vbelt_standard_length", "center_distance", "vbelt_count", "power_required",
                 "motor_power", "energy_fluctuation", "flywheel_inertia", "flywheel_diameter", "flywheel_mass", "run_up_time",
                 "driving_pulley_radius", "toothed_belt_length", "toothed_belt_teeth"),
    checks=(*CHECKS, *TOOTHED_BELT_CHECKS),
    figures=FIGURES,
    assumptions=(
        "Belts do not slip and shafts do not twist; the torque of the output is periodic.",
        "One efficiency per transmission, the same in both directions of power; bearings and fan of the motor are not included.",
        "The flywheel is sized as if the motor delivered the mean torque throughout. This holds only where the swing "
        "of the speed is small compared with the motor's slip (swing_to_slip much less than 1); otherwise the motor "
        "takes part of the load's swing itself: its torque over the revolution, its heating and the resulting speed "
        "are checked in the consistency check of the press.",
        "V-belts are checked against the power rating of the manufacturer, given as power_per_belt: no table of ratings is built in, since only "
        "one manufacturer's was available. The service factor and the factors of wrap and length are Optibelt's and those of ISO 5292; the "
        "increase of power with the ratio is neglected, on the safe side.",
        "During run-up, the motor's torque is its mean and the load torque is constant.",
        *TOOTHED_BELT_ASSUMPTIONS,
    ),
    sources=(
        Source("002", "Loizyk V. V., Bryndas A. M., Shelonh N. M., Ternytskyi S. V. Analytical studies of drive mechanism parameters of "
               "flat cylinder die-cutting press. Lviv Polytechnic National University (in Ukrainian)."),
        Source("000", "Topolnytskyi P. V., Shustykevych A. I., Kolomiiets A. B., Vatuliak Yu. V. Research of the drive parameters "
               "of the pressure cylinder of a flat-bed type die-cutting machine. 2024. "
               "doi: 10.32403/1998-6912-2024-2-69-140-150."),
    ),
    errata=TOOTHED_BELT_ERRATA,
)  # fmt: skip
