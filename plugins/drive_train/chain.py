"""Chapters on ratios and speeds, the torque over a turn, and torque and power at each shaft."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    abscissa,
    case,
    choice,
    crossings,
    formula,
    from_curve,
    inner,
    m,
    number,
    part,
    pi,
    pick,
    reduction,
    running,
    self_test,
    total,
    value,
)
from diecut_report.plugins.drive_train import vbelt

# fmt: off


@formula
def mean_torque(driving_mean: Any, braking_mean: Any, ratio: Any, efficiency: Any) -> Any:
    """Mean torque of a shaft from the driving and the braking part at the output, with the losses between."""
    return driving_mean / (ratio * efficiency) - braking_mean * efficiency / ratio


speeds = Chapter("Ratios and speeds",
    text="Shafts are numbered from the motor: 1 the motor shaft, 2 the flywheel shaft, 3 and onwards behind each gear pair. The V-belt provides the "
        "remaining ratio, without slip; its driven pulley has a standard diameter, so the speeds are those of the rounded ratio.")
speeds.total_ratio = m.motor_speed / m.inputs.output_speed, "i", "1", "Required ratio from the motor to the output", "kinematics"
speeds.gear_ratio = value(m.gears.driven_teeth / m.gears.driver_teeth, needs=("gears",)), "i_k", "1", "Ratio of the pair", "kinematics"
speeds.gear_ratio_total = total("product", of="gear_ratio", needs=("gears",)), "i_g", "1", "Total ratio of the gears", "kinematics"
speeds.gear_ratio_total = value(1, lacks=("gears",)), "i_g", "1", "Total ratio of the gears: there are none", "kinematics"
speeds.fewest_driving_teeth = (total("min", of="gears.driver_teeth", output=False, needs=("gears",)), "z_1,min", "1",
    "Smallest number of teeth of a driving gear")
speeds.fewest_driven_teeth = (total("min", of="gears.driven_teeth", output=False, needs=("gears",)), "z_2,min", "1",
    "Smallest number of teeth of a driven gear")
speeds.least_teeth = (inner(np.minimum(m.fewest_driving_teeth, m.fewest_driven_teeth), needs=("gears",)), "z_min", "1",
    "Smallest number of teeth of a gear")
speeds.vbelt_ratio = m.total_ratio / m.gear_ratio_total, "i_b", "1", "Required ratio of the V-belt", "this method"
speeds.require("belt_steps_down", m.vbelt_ratio > number(1) - 1e-12, key="output_speed",
    message="is {inputs.output_speed}; with motor_speed = {motor_speed} and the gears' ratio {gear_ratio_total} that leaves the V-belt a ratio of "
    "{vbelt_ratio}, but it cannot speed up: give the gears a ratio of at most {total_ratio:down}, with fewer driven teeth or fewer pairs, or "
    "take a faster motor")
speeds.driven_diameter_exact = (inner(m.vbelt_ratio * m.vbelt.driver_diameter), "d_2′", "mm", "Diameter of the driven pulley for this ratio",
    "kinematics")
speeds.driven_diameter = (value(m.vbelt.driven_diameter, needs=("vbelt.driven_diameter",)), "d_2", "mm",
    "Datum diameter of the driven pulley: as given", "input")
speeds.driven_diameter = (pick("nearest", of="driven_diameter_exact", series=vbelt.PULLEYS, beyond="last", lacks=("vbelt.driven_diameter",)), "d_2",
    "mm", "Datum diameter of the driven pulley", "R40 series")
speeds.vbelt_ratio_actual = m.driven_diameter / m.vbelt.driver_diameter, "i_b′", "1", "Ratio of the V-belt with this diameter", "kinematics"
speeds.shaft_1_speed = m.motor_speed, "ω_1", "rpm", "Speed of shaft 1, the motor shaft"
speeds.shaft_2_speed = m.shaft_1_speed / m.vbelt_ratio_actual, "ω_2", "rpm", "Speed of shaft 2, the flywheel shaft", "kinematics"
speeds.ratio_before = (running("product", of="gear_ratio", output=False, needs=("gears",)), "Πi", "1",
    "Ratio from the flywheel's shaft to the shaft behind the pair", "kinematics")
speeds.gear_shaft_speed = (value(m.shaft_2_speed / m.ratio_before, needs=("gears",), numbered="shaft_{}_speed", first=3), "ω_k", "rpm",
    "Speed of the shaft behind the pair", "kinematics")
speeds.output_speed = part(of="gear_shaft_speed", index=-1, needs=("gears",)), "n", "rpm", "Speed of the output shaft", "kinematics"
speeds.output_speed = value(m.shaft_2_speed, lacks=("gears",)), "n", "rpm", "Speed of the output shaft: it is shaft 2", "kinematics"
speeds.output_speed_error = (abs(m.output_speed - m.inputs.output_speed) / m.inputs.output_speed, "Δn", "%",
    "Deviation of the output speed from the required one", "this method")

turn = Chapter("Torque over the revolutions of the output shaft",
    text="Referred to the flywheel shaft, the efficiency follows the direction of power: the losses add where the motor drives and subtract where "
        "the load drives.", needs=("torque_curve",), absent="not calculated: torque_curve is not given")
turn.output_period = inner(2 * pi * m.torque_curve_turns), "φ_T", "deg", "Angle of the output shaft after which the torque repeats", "kinematics"
turn.output_angle = abscissa("output_period"), "φ", "deg", "Angle of the output shaft"
turn.output_torque = from_curve(given="torque_curve", abscissa="output_angle"), "M", "N*m", "Torque at the output shaft"
turn.power_reversal = crossings(of="output_torque"), "φ_r", "deg", "Angle at which the power changes sign"
turn.breakpoints("losses", "output_angle", "power_reversal")
turn.driving_torque = inner(np.maximum(m.output_torque, 0)), "M_+", "N*m", "Torque at the output while it drives the load"
turn.braking_torque = inner(np.maximum(-m.output_torque, 0)), "M_-", "N*m", "Torque at the output while the load drives"
turn.driving_mean = reduction("mean", of="driving_torque", output=False), "M_d", "N*m", "Mean of the driving part of the torque"
turn.braking_mean = reduction("mean", of="braking_torque", output=False), "M_b", "N*m", "Mean of the part of the torque in which the load drives"
turn.curve_peak = reduction("abs_max", of="output_torque", output=False), "M_c", "N*m", "Maximum absolute torque over the revolution"
turn.flywheel_torque = (choice(case(m.output_torque / (m.gear_ratio_total * m.gears_efficiency),
    "power flows from the motor to the output: divided by the gears' efficiency", m.output_torque >= 0),
    case(m.output_torque * m.gears_efficiency / m.gear_ratio_total, "the load drives, power flows back: multiplied by the gears' efficiency")),
    "M_f", "N*m", "Torque at the flywheel's shaft", "this method")
turn.flywheel_torque_mean = reduction("mean", of="flywheel_torque"), "M_fm", "N*m", "Mean torque at the flywheel's shaft", "this method"
turn.require("motor_drives", m.flywheel_torque_mean >= 0, key="torque_curve",
    message="has the mean {flywheel_torque_mean} at the flywheel's shaft: the load would drive the motor over the whole turn; is its sign the wrong "
    "way round?")
turn.mean_difference = (inner(abs(m.driving_mean - m.braking_mean - m.torque_mean)), "ΔM_mean", "N*m",
    "Deviation of the mean of the curve from the given mean torque")
turn.peak_difference = inner(abs(m.curve_peak - m.torque_peak)), "ΔM_peak", "N*m", "Deviation of the peak of the curve from the given peak torque"
turn.accepted_difference = inner(m.curve_peak / 100), "[ΔM]", "N*m", "Permissible deviation of the curve"

efficiency = Chapter("Efficiency")
efficiency.gears_efficiency = total("product", of="gears.efficiency", needs=("gears",)), "η_g", "1", "Total efficiency of the gears", "mechanics"
efficiency.gears_efficiency = value(1, lacks=("gears",)), "η_g", "1", "Total efficiency of the gears: there are none", "mechanics"
efficiency.efficiency_total = m.vbelt.efficiency * m.gears_efficiency, "η", "1", "Efficiency from the motor to the output", "mechanics"

powers = Chapter("Torque and power at each shaft",
    text="Means over a revolution. Power that drives the load is divided by the efficiencies behind the shaft, power that flows back is multiplied "
        "by them.")
powers.require("peak_above_mean", m.torque_mean <= m.torque_peak * (number(1) + 1e-06), key="torque_peak",
    message="is {torque_peak}, but the mean torque is {torque_mean}, and no mean is above the peak; look at torque_mean, or give a torque_peak of "
    "at least {torque_mean:up}")
powers.driving_mean = inner(m.torque_mean, lacks=("torque_curve",)), "M_d", "N*m", "Mean driving torque at the output"
powers.braking_mean = inner(0, lacks=("torque_curve",)), "M_b", "N*m", "Mean torque with which the load drives: none"
powers.shaft_2_torque = (mean_torque.of(ratio=m.gear_ratio_total, efficiency=m.gears_efficiency), "M_2", "N*m",
    "Mean torque of shaft 2, the flywheel shaft", "mechanics")
powers.shaft_1_torque = (m.shaft_2_torque / (m.vbelt_ratio_actual * m.vbelt.efficiency), "M_1", "N*m", "Mean torque of shaft 1, the motor shaft",
    "mechanics")
powers.efficiency_before = (running("product", of="gears.efficiency", output=False, needs=("gears",)), "Πη", "1",
    "Efficiency from the flywheel's shaft to the shaft behind the pair", "mechanics")
powers.efficiency_behind = (inner(m.gears_efficiency / m.efficiency_before, needs=("gears",)), "η_k′", "1", "Efficiency from there to the output",
    "mechanics")
powers.ratio_behind = inner(m.gear_ratio_total / m.ratio_before, needs=("gears",)), "i_k′", "1", "Ratio from there to the output", "kinematics"
powers.gear_shaft_torque = (value(mean_torque.of(ratio=m.ratio_behind, efficiency=m.efficiency_behind), needs=("gears",), numbered="shaft_{}_torque",
    first=3), "M_k", "N*m", "Mean torque of the shaft behind the pair", "mechanics")
powers.shaft_1_power = m.shaft_1_torque * m.shaft_1_speed, "P_1", "kW", "Mean power of shaft 1", "mechanics"
powers.shaft_2_power = m.shaft_2_torque * m.shaft_2_speed, "P_2", "kW", "Mean power of shaft 2", "mechanics"
powers.gear_shaft_power = (value(m.gear_shaft_torque * m.gear_shaft_speed, needs=("gears",), numbered="shaft_{}_power", first=3), "P_k", "kW",
    "Mean power of the shaft behind the pair", "mechanics")

balance = Chapter("Power balance",
    text="Power input less the losses of belt and gears is the power output; the losses follow from the two directions of power, not from the "
        "torques of the shafts.")
balance.power_output = (m.driving_mean - m.braking_mean) * m.output_speed, "P", "kW", "Mean power taken by the output", "mechanics"
balance.vbelt_loss = m.shaft_1_power * (1 - m.vbelt.efficiency), "P_V,b", "kW", "Mean power lost in the V-belt", "mechanics"
balance.gear_loss = (value(m.output_speed * (1 - m.gears.efficiency) * (m.driving_mean / (m.efficiency_behind * m.gears.efficiency) + m.braking_mean
    * m.efficiency_behind), needs=("gears",)), "P_V,k", "kW", "Mean power lost in the pair", "mechanics")
balance.gears_loss = total("sum", of="gear_loss", needs=("gears",)), "P_V,g", "kW", "Mean power lost in all gears", "mechanics"
balance.gears_loss = value(0, lacks=("gears",)), "P_V,g", "kW", "Mean power lost in gears: there are none", "mechanics"
balance.losses_total = m.vbelt_loss + m.gears_loss, "P_V", "kW", "Mean power lost", "mechanics"
balance.power_missing = (self_test(m.shaft_1_power, m.losses_total + m.power_output, check="power_balance", title="Power balance",
    scale=abs(m.shaft_1_power) + (m.driving_mean + m.braking_mean) * m.output_speed), "r_P", "1",
    "Residual of the power balance, relative to the sum of the powers without their signs", "conservation of energy")
