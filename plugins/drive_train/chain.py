"""Chapters on ratios and speeds, the torque over a turn, and torque and power at each shaft."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Abscissa,
    Breakpoints,
    Case,
    Chapter,
    Choice,
    Crossings,
    FromCurve,
    Part,
    Pick,
    Reduction,
    Require,
    Running,
    Total,
    Value,
    Words,
    bind,
)
from diecut_report.mechanics import common
from diecut_report.plugins.drive_train import advice, motor_advice, shafts

SPEEDS = Chapter(
    "Ratios and speeds",
    text="Shafts are numbered from the motor: 1 the motor's, 2 the flywheel's, 3 and on behind each pair of gears. The V-belt covers "
    "what the gears leave of the ratio, without slip; its driven pulley is of a standard diameter, so the speeds are those of the "
    "rounded ratio.",
    steps=(
        Value(id="total_ratio", symbol="i", description="Ratio from the motor to the output, as demanded", source="kinematics",
              formula=bind(common.quotient, quantity="motor_speed", by="inputs.output_speed")),
        Value(id="gear_ratio", symbol="i_k", description="Ratio of the pair", source="kinematics", needs=("gears",),
              formula=bind(common.quotient, quantity="gears.driven_teeth", by="gears.driver_teeth")),
        Total(id="gear_ratio_total", symbol="i_g", description="Ratio of all gears", source="kinematics", needs=("gears",),
              of="gear_ratio", operation="product"),
        Value(id="gear_ratio_total", symbol="i_g", description="Ratio of all gears: there are none", source="kinematics",
              lacks=("gears",), formula=common.one),
        Total(id="fewest_driving_teeth", symbol="z_1,min", description="Fewest teeth of a driving gear", output=False, needs=("gears",),
              of="gears.driver_teeth", operation="min"),
        Total(id="fewest_driven_teeth", symbol="z_2,min", description="Fewest teeth of a driven gear", output=False, needs=("gears",),
              of="gears.driven_teeth", operation="min"),
        Value(id="least_teeth", symbol="z_min", description="Fewest teeth of a gear", output=False, needs=("gears",),
              formula=bind(common.smaller_of, first="fewest_driving_teeth", second="fewest_driven_teeth")),
        Value(id="vbelt_ratio", symbol="i_b", description="Ratio that the V-belt must cover", source="this method",
              formula=bind(common.quotient, quantity="total_ratio", by="gear_ratio_total")),
        Require(id="belt_steps_down", condition=shafts.steps_down, key="output_speed",
                message="is {inputs.output_speed}; with motor_speed = {motor_speed} and the gears' ratio {gear_ratio_total} that leaves the "
                "V-belt a ratio of {vbelt_ratio}, but it cannot speed up: give the gears a ratio "
                "of at most {total_ratio:down}, with fewer driven teeth or fewer pairs, or take a faster motor"),
        Value(id="driven_diameter_exact", symbol="d_2′", unit="mm", description="Diameter of the driven pulley for this ratio",
              source="kinematics", output=False, formula=bind(common.product, first="vbelt_ratio", second="vbelt.driver_diameter")),
        Pick(id="driven_diameter", symbol="d_2", unit="mm", description="Datum diameter of the driven pulley", source="R40 series",
             of="driven_diameter_exact", series=advice.PULLEYS, rule="nearest"),
        Value(id="vbelt_ratio_actual", symbol="i_b′", description="Ratio of the V-belt with this diameter", source="kinematics",
              formula=bind(common.quotient, quantity="driven_diameter", by="vbelt.driver_diameter")),
        Value(id="shaft_1_speed", symbol="ω_1", unit="rpm", description="Speed of shaft 1, the motor's",
              formula=bind(common.same, quantity="motor_speed")),
        Value(id="shaft_2_speed", symbol="ω_2", unit="rpm", description="Speed of shaft 2, the flywheel's", source="kinematics",
              formula=bind(common.quotient, quantity="shaft_1_speed", by="vbelt_ratio_actual")),
        Running(id="ratio_before", symbol="Πi", description="Ratio from the flywheel's shaft to the shaft behind the pair",
                source="kinematics", output=False, needs=("gears",), of="gear_ratio", operation="product"),
        Value(id="gear_shaft_speed", symbol="ω_k", unit="rpm", description="Speed of the shaft behind the pair", source="kinematics",
              needs=("gears",), numbered="shaft_{}_speed", first=3,
              formula=bind(common.quotient, quantity="shaft_2_speed", by="ratio_before")),
        Part(id="output_speed", symbol="n", unit="rpm", description="Speed of the output shaft", source="kinematics", needs=("gears",),
             of="gear_shaft_speed", index=-1),
        Value(id="output_speed", symbol="n", unit="rpm", description="Speed of the output shaft: it is shaft 2", source="kinematics",
              lacks=("gears",), formula=bind(common.same, quantity="shaft_2_speed")),
        Value(id="output_speed_error", symbol="Δn", unit="%", description="Deviation of the output's speed from the demanded one",
              source="this method", formula=bind(shafts.relative_deviation, speed="output_speed", demanded="inputs.output_speed")),
    ),
)  # fmt: skip

TURN = Chapter(
    "Torque over a turn of the output shaft",
    text="Carried to the flywheel's shaft, the efficiency follows the direction of power: the losses add where the motor drives and "
    "take away where the load drives.",
    needs=("torque_curve",),
    absent="not calculated: torque_curve is not given",
    steps=(
        Abscissa(id="output_angle", symbol="φ", unit="deg", description="Angle of the output shaft", period=2 * np.pi),
        FromCurve(id="output_torque", symbol="M", unit="N*m", description="Torque at the output shaft", given="torque_curve",
                  abscissa="output_angle"),
        Crossings(id="power_reversal", symbol="φ_r", unit="deg", description="Angle at which the power turns round", of="output_torque"),
        Breakpoints(id="losses", abscissa="output_angle", places=("power_reversal",)),
        Value(id="driving_torque", symbol="M_+", unit="N*m", description="Torque at the output, where it drives the load", output=False,
              formula=bind(shafts.driving_part, torque="output_torque")),
        Value(id="braking_torque", symbol="M_-", unit="N*m", description="Torque at the output, where the load drives", output=False,
              formula=bind(shafts.braking_part, torque="output_torque")),
        Reduction(id="driving_mean", symbol="M_d", unit="N*m", description="Mean of the driving part of the torque", output=False,
                  of="driving_torque", operation="mean"),
        Reduction(id="braking_mean", symbol="M_b", unit="N*m", description="Mean of the part in which the load drives", output=False,
                  of="braking_torque", operation="mean"),
        Reduction(id="curve_peak", symbol="M_c", unit="N*m", description="Greatest size of the torque over the turn", output=False,
                  of="output_torque", operation="abs_max"),
        Choice(id="flywheel_torque", symbol="M_f", unit="N*m", description="Torque at the flywheel's shaft", source="this method",
               cases=(Case(bind(common.over_product, quantity="output_torque", first="gear_ratio_total", second="gears_efficiency"),
                           "power flows from the motor to the output: divided by the gears' efficiency",
                           bind(common.is_positive, quantity="output_torque")),
                      Case(bind(shafts.referred_back, torque="output_torque", ratio="gear_ratio_total", efficiency="gears_efficiency"),
                           "the load drives, power flows back: multiplied by the gears' efficiency"))),
        Reduction(id="flywheel_torque_mean", symbol="M_fm", unit="N*m", description="Mean torque at the flywheel's shaft",
                  source="this method", of="flywheel_torque", operation="mean"),
        Require(id="motor_drives", condition=bind(common.is_positive, quantity="flywheel_torque_mean"), key="torque_curve",
                message="has the mean {flywheel_torque_mean} at the flywheel's shaft: the load would drive the motor over the whole "
                "turn; is its sign the wrong way round?"),
        Value(id="mean_difference", symbol="ΔM_mean", unit="N*m", description="Mean of the curve off the mean torque given", output=False,
              formula=bind(shafts.mean_off, driving_mean="driving_mean", braking_mean="braking_mean", torque_mean="torque_mean")),
        Value(id="peak_difference", symbol="ΔM_peak", unit="N*m", description="Peak of the curve off the peak torque given", output=False,
              formula=bind(shafts.off, one="curve_peak", other="torque_peak")),
        Words(id="mean_advice", description="Which mean torque belongs to the curve", function=motor_advice.mean_advice, output=False,
              takes=("driving_mean", "braking_mean")),
        Value(id="accepted_difference", symbol="[ΔM]", unit="N*m", description="What the curve may differ from them", output=False,
              formula=bind(shafts.hundredth_of, torque="curve_peak")),
    ),
)  # fmt: skip

EFFICIENCY = Chapter(
    "Efficiency",
    steps=(
        Total(id="gears_efficiency", symbol="η_g", description="Efficiency of all gears", source="mechanics", needs=("gears",),
              of="gears.efficiency", operation="product"),
        Value(id="gears_efficiency", symbol="η_g", description="Efficiency of all gears: there are none", source="mechanics",
              lacks=("gears",), formula=common.one),
        Value(id="efficiency_total", symbol="η", description="Efficiency from the motor to the output", source="mechanics",
              formula=bind(common.product, first="vbelt.efficiency", second="gears_efficiency")),
    ),
)  # fmt: skip

POWERS = Chapter(
    "Torque and power at each shaft",
    text="Means over a turn. What drives the load is divided by the efficiencies behind the shaft, what flows back multiplied.",
    steps=(
        Value(id="driving_mean", symbol="M_d", unit="N*m", description="Mean driving torque at the output", output=False,
              lacks=("torque_curve",), formula=bind(common.same, quantity="torque_mean")),
        Value(id="braking_mean", symbol="M_b", unit="N*m", description="Mean torque with which the load drives: none", output=False,
              lacks=("torque_curve",), formula=common.zero),
        Value(id="shaft_2_torque", symbol="M_2", unit="N*m", description="Mean torque of shaft 2, the flywheel's", source="mechanics",
              formula=bind(shafts.mean_torque, ratio="gear_ratio_total", efficiency="gears_efficiency")),
        Value(id="shaft_1_torque", symbol="M_1", unit="N*m", description="Mean torque of shaft 1, the motor's", source="mechanics",
              formula=bind(common.over_product, quantity="shaft_2_torque", first="vbelt_ratio_actual", second="vbelt.efficiency")),
        Running(id="efficiency_before", symbol="Πη", description="Efficiency from the flywheel's shaft to the shaft behind the pair",
                source="mechanics", output=False, needs=("gears",), of="gears.efficiency", operation="product"),
        Value(id="efficiency_behind", symbol="η_k′", description="Efficiency from there to the output", source="mechanics", output=False,
              needs=("gears",), formula=bind(common.quotient, quantity="gears_efficiency", by="efficiency_before")),
        Value(id="ratio_behind", symbol="i_k′", description="Ratio from there to the output", source="kinematics", output=False,
              needs=("gears",), formula=bind(common.quotient, quantity="gear_ratio_total", by="ratio_before")),
        Value(id="gear_shaft_torque", symbol="M_k", unit="N*m", description="Mean torque of the shaft behind the pair",
              source="mechanics", needs=("gears",), numbered="shaft_{}_torque", first=3,
              formula=bind(shafts.mean_torque, ratio="ratio_behind", efficiency="efficiency_behind")),
        Value(id="shaft_1_power", symbol="P_1", unit="kW", description="Mean power of shaft 1", source="mechanics",
              formula=bind(common.product, first="shaft_1_torque", second="shaft_1_speed")),
        Value(id="shaft_2_power", symbol="P_2", unit="kW", description="Mean power of shaft 2", source="mechanics",
              formula=bind(common.product, first="shaft_2_torque", second="shaft_2_speed")),
        Value(id="gear_shaft_power", symbol="P_k", unit="kW", description="Mean power of the shaft behind the pair", source="mechanics",
              needs=("gears",), numbered="shaft_{}_power", first=3,
              formula=bind(common.product, first="gear_shaft_torque", second="gear_shaft_speed")),
    ),
)  # fmt: skip

BALANCE = Chapter(
    "Power balance",
    text="Power in less the losses of belt and gears is the power out; the losses are taken from the two directions of power, not from "
    "the shafts' torques.",
    steps=(
        Value(id="power_output", symbol="P", unit="kW", description="Mean power that the output takes", source="mechanics",
              formula=bind(shafts.net_power, speed="output_speed")),
        Value(id="vbelt_loss", symbol="P_V,b", unit="kW", description="Mean power lost in the V-belt", source="mechanics",
              formula=bind(shafts.lost, power="shaft_1_power", efficiency="vbelt.efficiency")),
        Value(id="gear_loss", symbol="P_V,k", unit="kW", description="Mean power lost in the pair", source="mechanics", needs=("gears",),
              formula=bind(shafts.lost_both_ways, speed="output_speed", behind="efficiency_behind", efficiency="gears.efficiency")),
        Total(id="gears_loss", symbol="P_V,g", unit="kW", description="Mean power lost in all gears", source="mechanics", needs=("gears",),
              of="gear_loss", operation="sum"),
        Value(id="gears_loss", symbol="P_V,g", unit="kW", description="Mean power lost in gears: there are none", source="mechanics",
              lacks=("gears",), formula=common.zero),
        Value(id="losses_total", symbol="P_V", unit="kW", description="Mean power lost", source="mechanics",
              formula=bind(common.sum_of, first="vbelt_loss", second="gears_loss")),
        Value(id="power_missing", symbol="ΔP", unit="W", description="Power missing in the balance", output=False,
              formula=bind(shafts.unbalanced, power_in="shaft_1_power", losses="losses_total", power_out="power_output")),
        Value(id="power_rounding", symbol="[ΔP]", unit="W", description="Power that rounding may take", output=False,
              formula=bind(shafts.accepted_rounding, speed="output_speed")),
    ),
)  # fmt: skip
