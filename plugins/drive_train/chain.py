"""Chapters on ratios and speeds, the torque over a turn, and torque and power at each shaft."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, bind, case, formula, number, pi
from diecut_report.plugins.drive_train import vbelt

# fmt: off


@formula
def mean_torque(driving_mean: Any, braking_mean: Any, ratio: Any, efficiency: Any) -> Any:
    """Mean torque of a shaft from the driving and the braking part at the output, with the losses between."""
    return driving_mean / (ratio * efficiency) - braking_mean * efficiency / ratio


speeds = Chapter("Ratios and speeds",
    text="Shafts are numbered from the motor: 1 the motor shaft, 2 the flywheel shaft, 3 and onwards behind each gear pair. The V-belt provides the "
        "remaining ratio, without slip; its driven pulley has a standard diameter, so the speeds are those of the rounded ratio.")
speeds.value("total_ratio", "i", "1", "Required ratio from the motor to the output",
    bind(lambda motor_speed, output_speed: motor_speed / output_speed, output_speed="inputs.output_speed"), source="kinematics")
speeds.value("gear_ratio", "i_k", "1", "Ratio of the pair",
    bind(lambda driven_teeth, driver_teeth: driven_teeth / driver_teeth, driven_teeth="gears.driven_teeth", driver_teeth="gears.driver_teeth"),
    source="kinematics", needs=("gears",))
speeds.total("gear_ratio_total", "i_g", "1", "Total ratio of the gears", "product", of="gear_ratio", source="kinematics", needs=("gears",))
speeds.value("gear_ratio_total", "i_g", "1", "Total ratio of the gears: there are none", lambda: 1, source="kinematics", lacks=("gears",))
speeds.total("fewest_driving_teeth", "z_1,min", "1", "Smallest number of teeth of a driving gear", "min", of="gears.driver_teeth", output=False,
    needs=("gears",))
speeds.total("fewest_driven_teeth", "z_2,min", "1", "Smallest number of teeth of a driven gear", "min", of="gears.driven_teeth", output=False,
    needs=("gears",))
speeds.value("least_teeth", "z_min", "1", "Smallest number of teeth of a gear",
    lambda fewest_driving_teeth, fewest_driven_teeth: np.minimum(fewest_driving_teeth, fewest_driven_teeth), output=False, needs=("gears",))
speeds.value("vbelt_ratio", "i_b", "1", "Required ratio of the V-belt", lambda total_ratio, gear_ratio_total: total_ratio / gear_ratio_total,
    source="this method")
speeds.require("belt_steps_down", lambda vbelt_ratio: vbelt_ratio > number(1) - 1e-12, key="output_speed",
    message="is {inputs.output_speed}; with motor_speed = {motor_speed} and the gears' ratio {gear_ratio_total} that leaves the V-belt a ratio of "
        "{vbelt_ratio}, but it cannot speed up: give the gears a ratio of at most {total_ratio:down}, with fewer driven teeth or fewer pairs, or "
        "take a faster motor")
speeds.value("driven_diameter_exact", "d_2′", "mm", "Diameter of the driven pulley for this ratio",
    bind(lambda vbelt_ratio, driver_diameter: vbelt_ratio * driver_diameter, driver_diameter="vbelt.driver_diameter"), source="kinematics",
    output=False)
speeds.value("driven_diameter", "d_2", "mm", "Datum diameter of the driven pulley: as given",
    bind(lambda given: given, given="vbelt.driven_diameter"), source="input", needs=("vbelt.driven_diameter",))
speeds.pick("driven_diameter", "d_2", "mm", "Datum diameter of the driven pulley", "nearest", of="driven_diameter_exact", series=vbelt.PULLEYS,
    beyond="last", source="R40 series", lacks=("vbelt.driven_diameter",))
speeds.value("vbelt_ratio_actual", "i_b′", "1", "Ratio of the V-belt with this diameter",
    bind(lambda driven_diameter, driver_diameter: driven_diameter / driver_diameter, driver_diameter="vbelt.driver_diameter"), source="kinematics")
speeds.value("shaft_1_speed", "ω_1", "rpm", "Speed of shaft 1, the motor shaft", lambda motor_speed: motor_speed)
speeds.value("shaft_2_speed", "ω_2", "rpm", "Speed of shaft 2, the flywheel shaft",
    lambda shaft_1_speed, vbelt_ratio_actual: shaft_1_speed / vbelt_ratio_actual, source="kinematics")
speeds.running("ratio_before", "Πi", "1", "Ratio from the flywheel's shaft to the shaft behind the pair", "product", of="gear_ratio",
    source="kinematics", output=False, needs=("gears",))
speeds.value("gear_shaft_speed", "ω_k", "rpm", "Speed of the shaft behind the pair", lambda shaft_2_speed, ratio_before: shaft_2_speed / ratio_before,
    source="kinematics", needs=("gears",), numbered="shaft_{}_speed", first=3)
speeds.part("output_speed", "n", "rpm", "Speed of the output shaft", of="gear_shaft_speed", index=-1, source="kinematics", needs=("gears",))
speeds.value("output_speed", "n", "rpm", "Speed of the output shaft: it is shaft 2", lambda shaft_2_speed: shaft_2_speed, source="kinematics",
    lacks=("gears",))
speeds.value("output_speed_error", "Δn", "%", "Deviation of the output speed from the required one",
    bind(lambda speed, demanded: abs(speed - demanded) / demanded, speed="output_speed", demanded="inputs.output_speed"), source="this method")

turn = Chapter("Torque over the revolutions of the output shaft",
    text="Referred to the flywheel shaft, the efficiency follows the direction of power: the losses add where the motor drives and subtract where "
        "the load drives.", needs=("torque_curve",), absent="not calculated: torque_curve is not given")
turn.value("output_period", "φ_T", "deg", "Angle of the output shaft after which the torque repeats",
    lambda torque_curve_turns: 2 * pi * torque_curve_turns, source="kinematics", output=False)
turn.abscissa("output_angle", "φ", "deg", "Angle of the output shaft", "output_period")
turn.from_curve("output_torque", "M", "N*m", "Torque at the output shaft", given="torque_curve", abscissa="output_angle")
turn.crossings("power_reversal", "φ_r", "deg", "Angle at which the power changes sign", of="output_torque")
turn.breakpoints("losses", "output_angle", "power_reversal")
turn.value("driving_torque", "M_+", "N*m", "Torque at the output while it drives the load", lambda output_torque: np.maximum(output_torque, 0),
    output=False)
turn.value("braking_torque", "M_-", "N*m", "Torque at the output while the load drives", lambda output_torque: np.maximum(-output_torque, 0),
    output=False)
turn.reduction("driving_mean", "M_d", "N*m", "Mean of the driving part of the torque", "mean", of="driving_torque", output=False)
turn.reduction("braking_mean", "M_b", "N*m", "Mean of the part of the torque in which the load drives", "mean", of="braking_torque", output=False)
turn.reduction("curve_peak", "M_c", "N*m", "Maximum absolute torque over the revolution", "abs_max", of="output_torque", output=False)
turn.choice("flywheel_torque", "M_f", "N*m", "Torque at the flywheel's shaft",
    case(lambda output_torque, gear_ratio_total, gears_efficiency: output_torque / (gear_ratio_total * gears_efficiency),
        "power flows from the motor to the output: divided by the gears' efficiency", lambda output_torque: output_torque >= 0),
    case(lambda output_torque, gear_ratio_total, gears_efficiency: output_torque * gears_efficiency / gear_ratio_total,
        "the load drives, power flows back: multiplied by the gears' efficiency"), source="this method")
turn.reduction("flywheel_torque_mean", "M_fm", "N*m", "Mean torque at the flywheel's shaft", "mean", of="flywheel_torque", source="this method")
turn.require("motor_drives", lambda flywheel_torque_mean: flywheel_torque_mean >= 0, key="torque_curve",
    message="has the mean {flywheel_torque_mean} at the flywheel's shaft: the load would drive the motor over the whole turn; is its sign the wrong "
        "way round?")
turn.value("mean_difference", "ΔM_mean", "N*m", "Deviation of the mean of the curve from the given mean torque",
    lambda driving_mean, braking_mean, torque_mean: abs(driving_mean - braking_mean - torque_mean), output=False)
turn.value("peak_difference", "ΔM_peak", "N*m", "Deviation of the peak of the curve from the given peak torque",
    lambda curve_peak, torque_peak: abs(curve_peak - torque_peak), output=False)
turn.value("accepted_difference", "[ΔM]", "N*m", "Permissible deviation of the curve", lambda curve_peak: curve_peak / 100, output=False)

efficiency = Chapter("Efficiency")
efficiency.total("gears_efficiency", "η_g", "1", "Total efficiency of the gears", "product", of="gears.efficiency", source="mechanics",
    needs=("gears",))
efficiency.value("gears_efficiency", "η_g", "1", "Total efficiency of the gears: there are none", lambda: 1, source="mechanics", lacks=("gears",))
efficiency.value("efficiency_total", "η", "1", "Efficiency from the motor to the output",
    bind(lambda efficiency, gears_efficiency: efficiency * gears_efficiency, efficiency="vbelt.efficiency"), source="mechanics")

powers = Chapter("Torque and power at each shaft",
    text="Means over a revolution. Power that drives the load is divided by the efficiencies behind the shaft, power that flows back is multiplied "
        "by them.")
powers.require("peak_above_mean", lambda torque_mean, torque_peak: torque_mean <= torque_peak * (number(1) + 1e-06), key="torque_peak",
    message="is {torque_peak}, but the mean torque is {torque_mean}, and no mean is above the peak; look at torque_mean, or give a torque_peak of "
        "at least {torque_mean:up}")
powers.value("driving_mean", "M_d", "N*m", "Mean driving torque at the output", lambda torque_mean: torque_mean, output=False,
    lacks=("torque_curve",))
powers.value("braking_mean", "M_b", "N*m", "Mean torque with which the load drives: none", lambda: 0, output=False, lacks=("torque_curve",))
powers.value("shaft_2_torque", "M_2", "N*m", "Mean torque of shaft 2, the flywheel shaft",
    bind(mean_torque, ratio="gear_ratio_total", efficiency="gears_efficiency"), source="mechanics")
powers.value("shaft_1_torque", "M_1", "N*m", "Mean torque of shaft 1, the motor shaft",
    bind(lambda shaft_2_torque, vbelt_ratio_actual, efficiency: shaft_2_torque / (vbelt_ratio_actual * efficiency), efficiency="vbelt.efficiency"),
    source="mechanics")
powers.running("efficiency_before", "Πη", "1", "Efficiency from the flywheel's shaft to the shaft behind the pair", "product", of="gears.efficiency",
    source="mechanics", output=False, needs=("gears",))
powers.value("efficiency_behind", "η_k′", "1", "Efficiency from there to the output",
    lambda gears_efficiency, efficiency_before: gears_efficiency / efficiency_before, source="mechanics", output=False, needs=("gears",))
powers.value("ratio_behind", "i_k′", "1", "Ratio from there to the output", lambda gear_ratio_total, ratio_before: gear_ratio_total / ratio_before,
    source="kinematics", output=False, needs=("gears",))
powers.value("gear_shaft_torque", "M_k", "N*m", "Mean torque of the shaft behind the pair",
    bind(mean_torque, ratio="ratio_behind", efficiency="efficiency_behind"), source="mechanics", needs=("gears",), numbered="shaft_{}_torque",
    first=3)
powers.value("shaft_1_power", "P_1", "kW", "Mean power of shaft 1", lambda shaft_1_torque, shaft_1_speed: shaft_1_torque * shaft_1_speed,
    source="mechanics")
powers.value("shaft_2_power", "P_2", "kW", "Mean power of shaft 2", lambda shaft_2_torque, shaft_2_speed: shaft_2_torque * shaft_2_speed,
    source="mechanics")
powers.value("gear_shaft_power", "P_k", "kW", "Mean power of the shaft behind the pair",
    lambda gear_shaft_torque, gear_shaft_speed: gear_shaft_torque * gear_shaft_speed, source="mechanics", needs=("gears",), numbered="shaft_{}_power",
    first=3)

balance = Chapter("Power balance",
    text="Power input less the losses of belt and gears is the power output; the losses follow from the two directions of power, not from the "
        "torques of the shafts.")
balance.value("power_output", "P", "kW", "Mean power taken by the output",
    lambda driving_mean, braking_mean, output_speed: (driving_mean - braking_mean) * output_speed, source="mechanics")
balance.value("vbelt_loss", "P_V,b", "kW", "Mean power lost in the V-belt",
    bind(lambda shaft_1_power, efficiency: shaft_1_power * (1 - efficiency), efficiency="vbelt.efficiency"), source="mechanics")
balance.value("gear_loss", "P_V,k", "kW", "Mean power lost in the pair",
    bind(lambda driving_mean, braking_mean, output_speed, efficiency_behind, efficiency:
            output_speed * (1 - efficiency) * (driving_mean / (efficiency_behind * efficiency) + braking_mean * efficiency_behind),
        efficiency="gears.efficiency"), source="mechanics", needs=("gears",))
balance.total("gears_loss", "P_V,g", "kW", "Mean power lost in all gears", "sum", of="gear_loss", source="mechanics", needs=("gears",))
balance.value("gears_loss", "P_V,g", "kW", "Mean power lost in gears: there are none", lambda: 0, source="mechanics", lacks=("gears",))
balance.value("losses_total", "P_V", "kW", "Mean power lost", lambda vbelt_loss, gears_loss: vbelt_loss + gears_loss, source="mechanics")
balance.value("power_missing", "ΔP", "W", "Residual of the power balance",
    lambda shaft_1_power, losses_total, power_output: abs(shaft_1_power - losses_total - power_output), output=False)
balance.value("power_rounding", "[ΔP]", "W", "Residual permitted for rounding",
    lambda shaft_1_power, losses_total, driving_mean, braking_mean, output_speed:
        1e-12 * (abs(shaft_1_power) + losses_total + (driving_mean + braking_mean) * output_speed), output=False, printed=False)
