"""Chapters on the motor, the flywheel and the run-up."""

from __future__ import annotations

from typing import Any

from diecut_report.api import (
    Chapter,
    accumulated,
    as_number,
    formula,
    inner,
    lookup,
    m,
    number,
    pi,
    pick,
    reduction,
    standard_series,
    standard_table,
    value,
)
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
motor.power_required = m.shaft_1_power * m.reserve_factor, "P_req", "kW", "Required motor power, including the reserve", "this method"
motor.motor_power = pick("above", of="power_required", series=RATINGS, beyond="last"), "P_r", "kW", "Rated power of the motor", "IEC 60072-1"
motor.motor_rated_torque = m.motor_power / m.shaft_1_speed, "M_r", "N*m", "Rated torque of the motor", "mechanics"
motor.motor_peak_torque = (value(m.torque_peak / (m.gear_ratio_total * m.vbelt_ratio_actual * m.efficiency_total), lacks=("torque_curve",)),
    "M_1,peak", "N*m", "Peak torque of the output, referred to the motor", "this method")
motor.motor_breakdown_torque = (value(m.breakdown_ratio * m.motor_rated_torque, lacks=("torque_curve",)), "M_br", "N*m",
    "Breakdown torque of the motor", "this method")

flywheel = Chapter("Flywheel",
    text="The motor is assumed to deliver the mean torque; the excess of the load comes from the flywheel and returns to it. This assumes a swing "
        "of the speed that is small compared with the motor's slip; the ratio of the two is given below. The flywheel turns i_g times as far as the "
        "output shaft. It is taken as a disc of steel or cast iron with a width of one fifth of its diameter, and alone: rotor, pulleys and gears "
        "assist it.", needs=("torque_curve",), absent="not calculated: torque_curve is not given")
flywheel.excess_torque = inner(m.flywheel_torque - m.flywheel_torque_mean), "ΔM", "N*m", "Torque in excess of the mean", "this method"
flywheel.excess_integral = accumulated(of="excess_torque", output=False), "A", "J", "Integral of it over the angle of the output shaft", "this method"
flywheel.excess_energy = (m.gear_ratio_total * m.excess_integral, "E", "J", "Energy taken from the flywheel since the start of the revolution",
    "this method")
flywheel.excess_energy_max = reduction("max", of="excess_energy"), "E_max", "J", "Maximum energy taken: the flywheel is slowest"
flywheel.excess_energy_min = reduction("min", of="excess_energy"), "E_min", "J", "Minimum energy taken: the flywheel is fastest"
flywheel.energy_fluctuation = reduction("range", of="excess_energy"), "ΔE", "J", "Energy fluctuation over a revolution", "this method"
flywheel.flywheel_inertia = (m.energy_fluctuation / (m.speed_fluctuation * m.shaft_2_speed**2), "J", "kg*m**2", "Moment of inertia of the flywheel",
    "energy")
flywheel.require("mounted", (m.mounted_inertia <= 2 * m.flywheel_inertia) & (m.flywheel_inertia <= 2 * m.mounted_inertia), key="mounted_inertia",
    needs=("mounted_inertia",),
    message="is less than half or more than twice the {flywheel_inertia} that the energy asks for; mount another flywheel, or change "
    "speed_fluctuation")
flywheel.accepted_inertia = (inner(1.1 * m.flywheel_inertia, needs=("mounted_inertia",)), "[J_F]", "kg*m**2",
    "Inertia of a flywheel without needless weight", "this method")
for given, with_it, without in (("mounted_inertia", ("mounted_inertia",), ()), ("flywheel_inertia", (), ("mounted_inertia",))):
    flywheel.wheel_inertia = (inner(m[given], needs=with_it, lacks=without), "J_w", "kg*m**2", "Moment of inertia of the flywheel on its shaft",
        "this method")
flywheel.synchronous_speed = (value(m.inputs.synchronous_speed, needs=("synchronous_speed",)), "n_s", "rpm",
    "Synchronous speed of the motor: as given", "input")
flywheel.synchronous_speed = (pick("above", of="shaft_1_speed", series=SYNCHRONOUS, beyond="last", lacks=("synchronous_speed",)), "n_s", "rpm",
    "Synchronous speed of the motor, at 50 Hz", "practice")
flywheel.rated_slip = inner(m.synchronous_speed - m.shaft_1_speed), "s_n", "rpm", "Slip of the motor at its rated speed", "mechanics"
SLIPS = m.rated_slip > 0
flywheel.loaded_motor_speed = (value(m.synchronous_speed - m.rated_slip * m.shaft_1_torque / m.motor_rated_torque, exists=SLIPS), "n_L", "rpm",
    "Speed of the motor under the mean torque, with linear slip", "this method")
flywheel.loaded_output_speed = (value(m.output_speed * m.loaded_motor_speed / m.shaft_1_speed, exists=SLIPS), "n_oL", "rpm",
    "Output speed under the mean torque, the belt without creep", "kinematics")
flywheel.swing_to_slip = (value(m.speed_fluctuation * m.shaft_1_speed / m.rated_slip, exists=m.rated_slip > 0), "κ_s", "1",
    "Ratio of the swing of the motor's speed at the accepted fluctuation to its slip at the rated speed", "this method")
flywheel.slip_stiffness = (inner(motor_slip.slip_stiffness.of(rated_torque=m.motor_rated_torque, rated_speed=m.shaft_1_speed), exists=SLIPS), "k",
    "N*m*s/rad", "Torque of the motor per unit of slip speed", "this method")
flywheel.flywheel_stiffness = (inner(motor_slip.stiffness_at_flywheel.of(ratio=m.vbelt_ratio_actual, efficiency=m.vbelt.efficiency), exists=SLIPS),
    "k_f", "N*m*s/rad", "The same at the flywheel's shaft", "energy")
flywheel.motor_time_constant = (value(motor_slip.time_constant.of(inertia=m.wheel_inertia, stiffness_at_flywheel=m.flywheel_stiffness),
    exists=SLIPS), "τ_M", "ms", "Time constant with which the motor's torque follows the load's", "this method")
flywheel.flywheel_density = lookup(DENSITIES, by="flywheel_material", output=False), "ρ", "kg/m**3", "Density of the flywheel", "material"
flywheel.flywheel_rim_limit = (lookup(RIM_SPEEDS, by="flywheel_material", output=False), "[v]", "m/s", "Allowable rim speed of the flywheel",
    "material")
flywheel.flywheel_diameter = ((160 * m.flywheel_inertia / (pi * m.flywheel_density)) ** (number(1) / 5), "D", "mm",
    "Diameter of the flywheel as a disc", "this method")
flywheel.flywheel_width = m.flywheel_diameter / 5, "B", "mm", "Width of the disc", "this method"
flywheel.flywheel_mass = (m.flywheel_density * as_number(pi) * m.flywheel_diameter ** 2 / 4 * m.flywheel_width, "m_f", "kg", "Mass of the flywheel",
    "geometry")
flywheel.flywheel_rim_speed = (value(vbelt.rim_speed.of(speed=m.shaft_2_speed, diameter=m.flywheel_diameter), lacks=("mounted_inertia",)), "v_f",
    "m/s", "Rim speed of the flywheel", "kinematics")
flywheel.mounted_rim_speed = (value(vbelt.rim_speed.of(speed=m.shaft_2_speed, diameter=m.mounted_diameter), needs=("mounted_diameter",)), "v_F",
    "m/s", "Rim speed of the mounted flywheel", "kinematics")

run_up = Chapter("Run-up of the motor",
    text="From rest the motor accelerates rotor, flywheel and load to their speeds with its mean run-up torque less the load torque. Without "
        "torque_curve there is no flywheel. Without motor_inertia or load_inertia the time is that of the remaining inertias alone.")
INERTIAS = {"rotor_inertia": ("motor_inertia", "J_m1", "Moment of inertia of the motor's rotor and pulley"),
            "moved_inertia": ("load_inertia", "J_l1", "Moment of inertia that runs up with the output shaft")}
for name, (given, symbol, words) in INERTIAS.items():
    run_up[name] = inner(m[given], needs=(given,)), symbol, "kg*m**2", f"{words}: as given", "input"
    run_up[name] = inner(0, lacks=(given,)), symbol, "kg*m**2", f"{words}: neglected, since it is not given", "this method"
run_up.own_inertia = (inner(m.wheel_inertia + m.shaft_2_inertia, needs=("torque_curve",)), "J_o2", "kg*m**2",
    "Moment of inertia of the flywheel with its shaft", "mechanics")
run_up.own_inertia = (inner(m.shaft_2_inertia, lacks=("torque_curve",)), "J_o2", "kg*m**2", "Moment of inertia of shaft 2, which has no flywheel",
    "mechanics")
run_up.output_inertia = inner(m.moved_inertia + m.output_shafts_inertia), "J_o3", "kg*m**2", "Moment of inertia at the output shaft", "mechanics"
run_up.flywheel_shaft_inertia = (inner(inertia_before.of(own=m.own_inertia, behind=m.output_inertia, ratio=m.gear_ratio_total,
    efficiency=m.gears_efficiency)), "J_2", "kg*m**2", "Moment of inertia at the flywheel's shaft", "energy")
run_up.run_up_inertia = (inertia_before.of(own=m.rotor_inertia, behind=m.flywheel_shaft_inertia, ratio=m.vbelt_ratio_actual,
    efficiency=m.vbelt.efficiency), "J_1", "kg*m**2", "Equivalent inertia at the motor's shaft, belt and gear losses included", "energy")
run_up.shafts_energy = (inner((m.rotor_inertia * m.shaft_1_speed**2 + m.shaft_2_inertia * m.shaft_2_speed**2 + m.output_shafts_inertia
    * m.output_speed**2) / 2), "E_s", "J", "Kinetic energy of rotor and shafts, beside that of the flywheel and of what the output moves", "energy")
run_up.run_up_torque = m.run_up_torque_ratio * m.motor_rated_torque, "M_a", "N*m", "Mean torque of the motor during run-up", "this method"
run_up.run_up_load_torque = m.run_up_load * m.shaft_1_torque, "M_l", "N*m", "Load torque at the motor during run-up", "this method"
run_up.accelerating_torque = m.run_up_torque - m.run_up_load_torque, "M_acc", "N*m", "Accelerating torque", "mechanics"
run_up.run_up_time = (value(run_up_time, exists=(m.accelerating_torque > 0) & (m.run_up_inertia > 0), needs=("motor_inertia", "load_inertia")),
    "t_a", "s", "Run-up time of the motor", "mechanics")
for needs, lacks in (((), ("load_inertia",)), (("load_inertia",), ("motor_inertia",))):
    run_up.run_up_time_least = (value(run_up_time, exists=(m.accelerating_torque > 0) & (m.run_up_inertia > 0), needs=needs, lacks=lacks), "t_a1",
        "s", "Run-up time of the given inertias: the actual time is longer", "mechanics")
