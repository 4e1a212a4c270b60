"""Chapters on the motor, the flywheel and the run-up."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, as_number, bind, formula, number, pi, standard_series, standard_table
from diecut_report.mechanics import common
from diecut_report.mechanics.timing import engagement as motor_slip
from diecut_report.plugins.drive_train import vbelt


@formula
def inertia_before(own: Any, behind: Any, ratio: Any, efficiency: Any) -> Any:
    """Inertia that a shaft feels: its own, and what turns slower behind a ratio, with the losses between."""
    return own + behind / (ratio**2 * efficiency)


@formula
def run_up_time(run_up_inertia: Any, shaft_1_speed: Any, accelerating_torque: Any) -> Any:
    """Time in which a torque brings an inertia to its speed."""
    return run_up_inertia * as_number(shaft_1_speed) / accelerating_torque


RATINGS = standard_series("iec_60072_ratings")
SYNCHRONOUS = tuple(
    sorted(speed for name, speed in standard_table("motor_synchronous_speeds").values.items() if name.endswith("50 Hz"))
)
DENSITIES = {"steel": 7850.0, "cast_iron": 7200.0}  # kg/m³
RIM_SPEEDS = {"steel": 60.0, "cast_iron": 35.0}  # m/s

# fmt: off

motor = Chapter("Motor")
motor.value("power_required", "P_req", "kW", "Required motor power, including the reserve",
    lambda shaft_1_power, reserve_factor: shaft_1_power * reserve_factor, source="this method")
motor.pick("motor_power", "P_r", "kW", "Rated power of the motor", "above", of="power_required", series=RATINGS, beyond="last", source="IEC 60072-1")
motor.value("motor_rated_torque", "M_r", "N*m", "Rated torque of the motor", lambda motor_power, shaft_1_speed: motor_power / shaft_1_speed,
    source="mechanics")
motor.value("motor_peak_torque", "M_1,peak", "N*m", "Peak torque of the output, referred to the motor",
    lambda torque_peak, gear_ratio_total, vbelt_ratio_actual, efficiency_total:
        torque_peak / (gear_ratio_total * vbelt_ratio_actual * efficiency_total), source="this method", lacks=("torque_curve",))
motor.value("motor_breakdown_torque", "M_br", "N*m", "Breakdown torque of the motor",
    lambda breakdown_ratio, motor_rated_torque: breakdown_ratio * motor_rated_torque, source="this method", lacks=("torque_curve",))

flywheel = Chapter("Flywheel",
    text="The motor is assumed to deliver the mean torque; the excess of the load comes from the flywheel and returns to it. This assumes a swing "
        "of the speed that is small compared with the motor's slip; the ratio of the two is given below. The flywheel turns i_g times as far as the "
        "output shaft. It is taken as a disc of steel or cast iron with a width of one fifth of its diameter, and alone: rotor, pulleys and gears "
        "assist it.", needs=("torque_curve",), absent="not calculated: torque_curve is not given")
flywheel.value("excess_torque", "ΔM", "N*m", "Torque in excess of the mean",
    lambda flywheel_torque, flywheel_torque_mean: flywheel_torque - flywheel_torque_mean, source="this method", output=False)
flywheel.accumulated("excess_integral", "A", "J", "Integral of it over the angle of the output shaft", of="excess_torque", source="this method",
    output=False)
flywheel.value("excess_energy", "E", "J", "Energy taken from the flywheel since the start of the revolution",
    lambda gear_ratio_total, excess_integral: gear_ratio_total * excess_integral, source="this method")
flywheel.reduction("excess_energy_max", "E_max", "J", "Maximum energy taken: the flywheel is slowest", "max", of="excess_energy")
flywheel.reduction("excess_energy_min", "E_min", "J", "Minimum energy taken: the flywheel is fastest", "min", of="excess_energy")
flywheel.reduction("energy_fluctuation", "ΔE", "J", "Energy fluctuation over a revolution", "range", of="excess_energy", source="this method")
flywheel.value("flywheel_inertia", "J", "kg*m**2", "Moment of inertia of the flywheel",
    lambda energy_fluctuation, speed_fluctuation, shaft_2_speed: energy_fluctuation / (speed_fluctuation * shaft_2_speed**2), source="energy")
flywheel.require("mounted",
    lambda mounted_inertia, flywheel_inertia: (mounted_inertia <= 2 * flywheel_inertia) & (flywheel_inertia <= 2 * mounted_inertia),
    key="mounted_inertia", needs=("mounted_inertia",),
    message="is less than half or more than twice the {flywheel_inertia} that the energy asks for; mount another flywheel, or change "
        "speed_fluctuation")
flywheel.value("accepted_inertia", "[J_F]", "kg*m**2", "Inertia of a flywheel without needless weight",
    lambda flywheel_inertia: 1.1 * flywheel_inertia, source="this method", output=False, needs=("mounted_inertia",))
for given, with_it, without in (("mounted_inertia", ("mounted_inertia",), ()), ("flywheel_inertia", (), ("mounted_inertia",))):
    flywheel.value("wheel_inertia", "J_w", "kg*m**2", "Moment of inertia of the flywheel on its shaft", bind(lambda given: given, given=given),
        source="this method", output=False, needs=with_it, lacks=without)
flywheel.value("synchronous_speed", "n_s", "rpm", "Synchronous speed of the motor: as given",
    bind(lambda synchronous_speed: synchronous_speed, synchronous_speed="inputs.synchronous_speed"), source="input", needs=("synchronous_speed",))
flywheel.pick("synchronous_speed", "n_s", "rpm", "Synchronous speed of the motor, at 50 Hz", "above", of="shaft_1_speed", series=SYNCHRONOUS,
    beyond="last", source="practice", lacks=("synchronous_speed",))
flywheel.value("rated_slip", "s_n", "rpm", "Slip of the motor at its rated speed",
    lambda synchronous_speed, shaft_1_speed: synchronous_speed - shaft_1_speed, source="mechanics", output=False)
SLIPS = bind(common.is_below, smaller=0, greater="rated_slip")
flywheel.value("loaded_motor_speed", "n_L", "rpm", "Speed of the motor under the mean torque, with linear slip",
    lambda synchronous_speed, rated_slip, shaft_1_torque, motor_rated_torque: synchronous_speed - rated_slip * shaft_1_torque / motor_rated_torque,
    source="this method", exists=SLIPS)
flywheel.value("loaded_output_speed", "n_oL", "rpm", "Output speed under the mean torque, the belt without creep",
    lambda output_speed, loaded_motor_speed, shaft_1_speed: output_speed * loaded_motor_speed / shaft_1_speed, source="kinematics", exists=SLIPS)
flywheel.value("swing_to_slip", "κ_s", "1", "Ratio of the swing of the motor's speed at the accepted fluctuation to its slip at the rated speed",
    lambda speed_fluctuation, shaft_1_speed, rated_slip: speed_fluctuation * shaft_1_speed / rated_slip, source="this method",
    exists=lambda rated_slip: rated_slip > 0)
flywheel.value("slip_stiffness", "k", "N*m*s/rad", "Torque of the motor per unit of slip speed",
    bind(motor_slip.slip_stiffness, rated_torque="motor_rated_torque", rated_speed="shaft_1_speed"), source="this method", output=False, exists=SLIPS)
flywheel.value("flywheel_stiffness", "k_f", "N*m*s/rad", "The same at the flywheel's shaft",
    bind(motor_slip.stiffness_at_flywheel, ratio="vbelt_ratio_actual", efficiency="vbelt.efficiency"), source="energy", output=False, exists=SLIPS)
flywheel.value("motor_time_constant", "τ_M", "ms", "Time constant with which the motor's torque follows the load's",
    bind(motor_slip.time_constant, inertia="wheel_inertia", stiffness_at_flywheel="flywheel_stiffness"), source="this method", exists=SLIPS)
flywheel.lookup("flywheel_density", "ρ", "kg/m**3", "Density of the flywheel", DENSITIES, by="flywheel_material", source="material", output=False)
flywheel.lookup("flywheel_rim_limit", "[v]", "m/s", "Allowable rim speed of the flywheel", RIM_SPEEDS, by="flywheel_material", source="material",
    output=False)
flywheel.value("flywheel_diameter", "D", "mm", "Diameter of the flywheel as a disc",
    lambda flywheel_inertia, flywheel_density: (160 * flywheel_inertia / (pi * flywheel_density)) ** (number(1) / 5), source="this method")
flywheel.value("flywheel_width", "B", "mm", "Width of the disc", lambda flywheel_diameter: flywheel_diameter / 5, source="this method")
flywheel.value("flywheel_mass", "m_f", "kg", "Mass of the flywheel",
    lambda flywheel_density, flywheel_diameter, flywheel_width: flywheel_density * as_number(pi) * flywheel_diameter ** 2 / 4 * flywheel_width,
    source="geometry")
flywheel.value("flywheel_rim_speed", "v_f", "m/s", "Rim speed of the flywheel",
    bind(vbelt.rim_speed, speed="shaft_2_speed", diameter="flywheel_diameter"), source="kinematics", lacks=("mounted_inertia",))
flywheel.value("mounted_rim_speed", "v_F", "m/s", "Rim speed of the mounted flywheel",
    bind(vbelt.rim_speed, speed="shaft_2_speed", diameter="mounted_diameter"), source="kinematics", needs=("mounted_diameter",))

run_up = Chapter("Run-up of the motor",
    text="From rest the motor accelerates rotor, flywheel and load to their speeds with its mean run-up torque less the load torque. Without "
        "torque_curve there is no flywheel. Without motor_inertia or load_inertia the time is that of the remaining inertias alone.")
INERTIAS = {"rotor_inertia": ("motor_inertia", "J_m1", "Moment of inertia of the motor's rotor and pulley"),
            "moved_inertia": ("load_inertia", "J_l1", "Moment of inertia that runs up with the output shaft")}
for name, (given, symbol, words) in INERTIAS.items():
    run_up.value(name, symbol, "kg*m**2", f"{words}: as given", bind(lambda given: given, given=given), source="input", output=False, needs=(given,))
    run_up.value(name, symbol, "kg*m**2", f"{words}: neglected, since it is not given", lambda: 0, source="this method", output=False, lacks=(given,))
run_up.value("own_inertia", "J_o2", "kg*m**2", "Moment of inertia of the flywheel with its shaft",
    lambda wheel_inertia, shaft_2_inertia: wheel_inertia + shaft_2_inertia, source="mechanics", output=False, needs=("torque_curve",))
run_up.value("own_inertia", "J_o2", "kg*m**2", "Moment of inertia of shaft 2, which has no flywheel", lambda shaft_2_inertia: shaft_2_inertia,
    source="mechanics", output=False, lacks=("torque_curve",))
run_up.value("output_inertia", "J_o3", "kg*m**2", "Moment of inertia at the output shaft",
    lambda moved_inertia, output_shafts_inertia: moved_inertia + output_shafts_inertia, source="mechanics", output=False)
run_up.value("flywheel_shaft_inertia", "J_2", "kg*m**2", "Moment of inertia at the flywheel's shaft",
    bind(inertia_before, own="own_inertia", behind="output_inertia", ratio="gear_ratio_total", efficiency="gears_efficiency"),
    source="energy", output=False)
run_up.value("run_up_inertia", "J_1", "kg*m**2", "Equivalent inertia at the motor's shaft, belt and gear losses included",
    bind(inertia_before, own="rotor_inertia", behind="flywheel_shaft_inertia", ratio="vbelt_ratio_actual", efficiency="vbelt.efficiency"),
    source="energy")
run_up.value("shafts_energy", "E_s", "J", "Kinetic energy of rotor and shafts, beside that of the flywheel and of what the output moves",
    lambda rotor_inertia, shaft_1_speed, shaft_2_inertia, shaft_2_speed, output_shafts_inertia, output_speed:
        (rotor_inertia * shaft_1_speed**2 + shaft_2_inertia * shaft_2_speed**2 + output_shafts_inertia * output_speed**2) / 2,
    source="energy", output=False)
run_up.value("run_up_torque", "M_a", "N*m", "Mean torque of the motor during run-up",
    lambda run_up_torque_ratio, motor_rated_torque: run_up_torque_ratio * motor_rated_torque, source="this method")
run_up.value("run_up_load_torque", "M_l", "N*m", "Load torque at the motor during run-up",
    lambda run_up_load, shaft_1_torque: run_up_load * shaft_1_torque, source="this method")
run_up.value("accelerating_torque", "M_acc", "N*m", "Accelerating torque",
    lambda run_up_torque, run_up_load_torque: run_up_torque - run_up_load_torque, source="mechanics")
run_up.value("run_up_time", "t_a", "s", "Run-up time of the motor", run_up_time, source="mechanics",
    exists=lambda accelerating_torque, run_up_inertia: (accelerating_torque > 0) & (run_up_inertia > 0), needs=("motor_inertia", "load_inertia"))
for needs, lacks in (((), ("load_inertia",)), (("load_inertia",), ("motor_inertia",))):
    run_up.value("run_up_time_least", "t_a1", "s", "Run-up time of the given inertias: the actual time is longer", run_up_time,
        source="mechanics", exists=lambda accelerating_torque, run_up_inertia: (accelerating_torque > 0) & (run_up_inertia > 0), needs=needs,
        lacks=lacks)
