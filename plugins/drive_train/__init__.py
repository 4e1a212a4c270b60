"""Drive train: motor, V-belt, flywheel, gears, toothed belt (002 eq. 7–11, 000 Fig. 1)."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.drive_train import chain, motor, vbelt
from diecut_report.plugins.drive_train.figures import FIGURES
from diecut_report.plugins.drive_train.inputs import DriveTrain
from diecut_report.plugins.drive_train.toothed_belt import (
    TOOTHED_BELT,
    TOOTHED_BELT_ASSUMPTIONS,
    TOOTHED_BELT_CHECKS,
    TOOTHED_BELT_ERRATA,
)
from diecut_report.plugins.drive_train.vbelt import FASTEST_BELT, LARGEST_DEVIATION, LARGEST_RATIO, LEAST_WRAP, PULLEYS

DRIVER = "vbelt.driver_diameter"
MOUNTED = ("torque_curve", "mounted_inertia")
STRONGER = (Vary("run_up_load", "down"), Vary("reserve_factor", "up"))
RUN_UP = (Vary("load_inertia", "down"), Vary("speed_fluctuation", "up"), *STRONGER)

CHECKS = (
    Check("vbelt_speed", "practice", "Speed of the V-belt", m.vbelt_speed, FASTEST_BELT, demand_label="belt speed", limit_label="allowed",
        source="practice", consequence="the centrifugal force lifts the belt out of the grooves; a slower motor helps, too.",
        advise=(Vary(DRIVER, "down", PULLEYS), Vary(DRIVER, "down"))),
    Check("vbelt_wrap", "practice", "Wrap on the smaller pulley", LEAST_WRAP, m.vbelt_wrap, demand_label="required", limit_label="wrap",
        source="practice", consequence="the belt slips; a larger vbelt.section has longer belts.",
        advise=("vbelt.center_distance", Vary(DRIVER, "up", PULLEYS))),
    Check("vbelt_ratio", "practice", "Ratio of the V-belt", m.vbelt_ratio_actual, LARGEST_RATIO, demand_label="ratio", limit_label="allowed",
        source="practice", consequence="too much for one V-belt; the gears can take more of it, whose ratio is {gear_ratio_total}.",
        advise=(Vary("gears.driven_teeth", "up"),)),
    Check("vbelt_count", "strength", "Number of belts", m.vbelt_share, m.vbelt_count, needs=("power_per_belt",),
        demand_label="required for the power", limit_label="mounted", sized_unless=("vbelt.count",),
        consequence="the belts are overloaded and wear out; another driving pulley has another power_per_belt.",
        advise=(Vary("vbelt.count", "up"), Vary(DRIVER, "up", PULLEYS))),
    Check("vbelt_slip", "function", "Slip of the V-belt", m.vbelt_pull, m.vbelt_slip_pull, needs=("vbelt.tension",),
        founded=("vbelt.groove_friction",), demand_label="maximum pull", limit_label="slip limit", source="Euler",
        consequence="the belts slip when the motor runs up or is overloaded; check the shafts for the load that a higher tension puts on them.",
        advise=(Vary("vbelt.tension", "up"),)),
    Check("vbelt_bendings", "practice", "Bending frequency of the V-belt", m.vbelt_bendings, 100.0, severity="warn", demand_label="bending frequency",
        limit_label="allowed", source="Optibelt", consequence="the belt heats and ages.",
        advise=(Vary("vbelt.center_distance", "up"), Vary(DRIVER, "down", PULLEYS))),
    Check("output_speed_error", "function", "Output speed", m.output_speed_error, LARGEST_DEVIATION, demand_label="deviation", limit_label="allowed",
        consequence="the output turns at {output_speed}, not at {inputs.output_speed}; other gears may meet it, too.",
        advise=(Vary(DRIVER, series=PULLEYS), Vary("vbelt.driven_diameter", series=PULLEYS), DRIVER)),
    Check("motor_power", "function", "Motor", m.power_required, m.motor_power, demand_label="required power", limit_label="rated power",
        sized_unless=(), source="IEC 60072-1",
        consequence="no standard motor is so large; less torque or speed of the output needs less, or several motors.",
        advise=(Vary("reserve_factor", "down"),)),
    Check("motor_overload", "function", "Overload of the motor", m.motor_peak_torque, m.motor_breakdown_torque,
        demand_label="peak torque at the motor", limit_label="breakdown torque",
        consequence="no flywheel smooths the peak, so the motor stalls; with torque_curve a flywheel is sized that takes it.",
        advise=(Vary("reserve_factor", "up"),)),
    Check("motor_radial_force", "strength", "Radial force on the motor's shaft", m.shaft_load, m.allowable_radial_force,
        needs=("allowable_radial_force",), demand_label="load of the belts", limit_label="allowed by the maker",
        consequence="the motor's bearings wear out, or its shaft breaks; a larger pulley needs less tension.",
        advise=(Vary(DRIVER, "up", PULLEYS), Vary("vbelt.tension", "down"))),
    Check("flywheel_rim_speed", "strength", "Flywheel rim", m.flywheel_rim_speed, m.flywheel_rim_limit, only_with=("torque_curve",),
        demand_label="rim speed", limit_label="allowed for the material", source="material",
        consequence="the wheel may burst; gears of a smaller ratio let it turn slower.",
        advise=("flywheel_material", Vary("speed_fluctuation", "up"))),
    Check("mounted_rim_speed", "strength", "Rim of the mounted flywheel", m.mounted_rim_speed, m.flywheel_rim_limit, only_with=MOUNTED,
        needs=("mounted_diameter",), demand_label="rim speed", limit_label="allowed for the material", source="material",
        consequence="the wheel may burst; gears of a smaller ratio let it turn slower.", advise=("flywheel_material",)),
    Check("flywheel", "function", "Inertia of the flywheel", m.flywheel_inertia, m.wheel_inertia, only_with=MOUNTED, demand_label="required",
        limit_label="mounted", consequence="the speed swings further than speed_fluctuation, and the motor takes more of the peak.",
        advise=("mounted_inertia",)),
    Check("heavy_flywheel", "function", "Flywheel heavier than needed", m.wheel_inertia, m.accepted_inertia, severity="warn", only_with=MOUNTED,
        demand_label="mounted", limit_label="1.1 × the required", consequence="the motor takes longer to run up, and the machine to stop.",
        advise=("mounted_inertia",)),
    Check("run_up_torque", "function", "Torque during run-up", m.run_up_load_torque, m.run_up_torque, operator="<",
        demand_label="load torque at the motor", limit_label="torque of the motor", consequence="the motor does not run up.", advise=STRONGER),
    *(Check("run_up_time", "function", "Run-up time", time, m.allowable_run_up_time, at_best=at_best, demand_label=label, source="this method",
        consequence="the motor's protection trips; one for heavy starting allows a longer allowable_run_up_time.", advise=RUN_UP)
      for time, label, at_best in (("run_up_time", "run-up", ()), ("run_up_time_least", "minimum run-up", ("motor_inertia", "load_inertia")))),
    Check("gear_teeth", "practice", "Number of teeth of the gears", 17.0, m.least_teeth, severity="warn", demand_label="teeth without undercut",
        limit_label="smallest number of teeth", source="practice",
        consequence="gears below 17 teeth are undercut; a shift of their profile avoids it, too.",
        advise=(("gears.driver_teeth", "gears.driven_teeth"),)),
    Check("torque_mean", "practice", "Mean torque and torque curve", m.mean_difference, m.accepted_difference, severity="warn",
        only_with=("torque_curve",), demand_label="difference of the means", limit_label="accepted", source="this method",
        consequence="they do not belong together, and the curve is used; take both from the same mechanism.", advise=("torque_mean",)),
    Check("torque_peak", "practice", "Peak torque and torque curve", m.peak_difference, m.accepted_difference, severity="warn",
        only_with=("torque_curve",), demand_label="difference of the peaks", limit_label="accepted", source="this method",
        consequence="they do not belong together, and the curve is used; take both from the same mechanism.", advise=("torque_peak",)),
)  # fmt: skip


EXAMPLE = ExampleBlock(
    "train",
    {
        "motor_speed": Wired("1420 rpm", needs=("platen_press", "cyclogram"), otherwise="1450 rpm"),
        "output_speed": Wired(
            "${<cyclogram>.main_shaft_speed}", otherwise=Wired("${<cylinder_drive>.crank_speed}", otherwise="100 rpm")
        ),
        "torque_mean": Wired(
            "${<cyclogram>.torque_mean}", otherwise=Wired("${<cylinder_drive>.crank_torque_mean}", otherwise="75 N*m")
        ),
        "torque_peak": Wired(
            "${<cyclogram>.torque_peak}", otherwise=Wired("${<cylinder_drive>.crank_torque_peak}", otherwise="150 N*m")
        ),
        "torque_curve": Wired("${<cyclogram>.main_shaft_torque}", otherwise=Wired("${<cylinder_drive>.crank_torque}")),
        "torque_curve_turns": Wired("${<cyclogram>.torque_curve_turns}"),
        "vbelt": {"driver_diameter": "125 mm", "center_distance": "600 mm"},
        "power_per_belt": "3.5 kW",
        "gears": [
            {"driver_teeth": 18, "driven_teeth": 87},
            # a platen is slower
            Wired({"driver_teeth": 20, "driven_teeth": 77}, needs=("platen_press", "cyclogram")),
            # from the main shaft to the crank's
            Wired(
                None,
                needs=("cyclogram",),
                otherwise=Wired({"driver_teeth": 24, "driven_teeth": 48}, needs=("cylinder_drive",)),
            ),
        ],
        # a platen takes its torque at once: a soft motor, which starts with the clutch open
        "reserve_factor": Wired(1.6, needs=("platen_press", "cyclogram"), otherwise=1.3),
        "run_up_load": Wired(0, needs=("platen_press", "cyclogram")),
        "flywheel_material": "cast_iron",
    },
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
