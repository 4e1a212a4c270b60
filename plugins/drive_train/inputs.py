"""Inputs of the drive train."""

from __future__ import annotations

from diecut_report.api import Block, CurveInput, Inputs, Quantity, Text, block, parts, samples
from diecut_report.plugins.drive_train.toothed_belt import ToothedBelt

# fmt: off

Section = ("SPZ", "SPA", "SPB", "SPC")  # those with confirmed standard lengths


class GearPair(Block):
    """A pair of gears, in the order from the flywheel's shaft to the output."""

    driver_teeth = Quantity("z_1", "1", "Number of teeth of the driving gear", ge=12, integer=True)
    driven_teeth = Quantity("z_2", "1", "Number of teeth of the driven gear", ge=12, integer=True)
    efficiency = Quantity("η_k", "1", "Efficiency of the pair", gt=0, le=1, default=0.97)
    form = Text("Type of the pair: parallel shafts, or shafts crossing at a right angle", ("spur", "bevel"), default="spur")


class VBelt(Block):
    """The V-belt drive from the motor's shaft to the flywheel's."""

    section = Text("Section of the V-belt (ISO 4184)", Section, default="SPA")
    driver_diameter = Quantity("d_1", "mm", "Datum diameter of the motor pulley, not less than the section's minimum", gt=0)
    driven_diameter = Quantity("d_2g", "mm", "Datum diameter of the driven pulley; default: the size of the R40 series for the output speed", gt=0,
        optional=True)
    center_distance = Quantity("a_0", "mm", "Wanted centre distance of the shafts; it is corrected for a standard belt", gt=0)
    efficiency = Quantity("η_b", "1", "Efficiency of the V-belt", gt=0, le=1, default=0.95)
    groove_friction = Quantity("μ_g", "1",
        "Effective coefficient of friction in the grooves, μ/sin(half the groove angle), for the belt tension; 0.5123 gives tensions "
        "of 5 : 1 at half a turn of wrap, the usual reserve against slip",
        gt=0, le=2, default=0.5123)
    service_factor = Quantity("c_2", "1",
        "Service factor on the motor's power: light 1.1, medium 1.2, heavy duty 1.3 at up to 16 hours per day (Optibelt)", ge=1, le=2, default=1.3)
    count = Quantity("z_g", "1", "Number of belts mounted, if not the minimum number", ge=1, le=32, integer=True, optional=True)
    tension = Quantity("F_Tg", "N", "Static tension of one belt as set; default: the required tension", gt=0, optional=True)


class DriveTrain(Inputs):
    """Keys of ``drive_train``."""

    motor_speed = Quantity("n_m", "rpm", "Speed of the motor under load", gt=0)
    output_speed = Quantity("n_0", "rpm", "Required speed of the output shaft, normally the crank shaft", gt=0)
    torque_mean = Quantity("M_mean", "N*m", "Mean torque at the output shaft; if a torque curve is given, its mean is used", ge=0)
    torque_peak = Quantity("M_peak", "N*m", "Maximum absolute torque at the output shaft", ge=0)
    torque_curve = CurveInput("M", "N*m",
        "Torque over the revolutions of the output shaft after which it repeats, negative where the load drives; required for sizing a flywheel",
        optional=True)
    torque_curve_turns = Quantity("k_T", "1", "Revolutions of the output shaft that torque_curve spans", ge=1, le=64, integer=True, default=1)
    gears = parts(GearPair, "Gear pairs between the flywheel's shaft and the output shaft", optional=True)
    vbelt = block(VBelt, "V-belt from the motor to the flywheel's shaft")
    speed_fluctuation = Quantity("δ", "1", "Acceptable speed fluctuation of the flywheel: (maximum − minimum)/mean", gt=0, lt=1, default=0.1)
    power_per_belt = Quantity("P_0", "kW",
        "Power rating of one belt, from the manufacturer's table for pulley and speed at half a turn of wrap and the reference length; "
        "required for the number of belts",
        gt=0, optional=True)
    flywheel_material = Text("Material of the flywheel", ("steel", "cast_iron"), default="steel")
    reserve_factor = Quantity("k_r", "1", "Reserve factor on the motor's power", ge=1, default=1.2)
    synchronous_speed = Quantity("n_s", "rpm", "Synchronous speed of the motor; default: the next above motor_speed at 50 Hz", gt=0, optional=True)
    breakdown_ratio = Quantity("k_b", "1", "Ratio of breakdown torque to rated torque of the motor", ge=1, default=2.2)
    run_up_torque_ratio = Quantity("k_a", "1", "Ratio of mean run-up torque to rated torque of the motor", gt=0, default=1.6)
    run_up_load = Quantity("k_l", "1", "Fraction of the mean torque that loads the motor during run-up (0: disengaged)", ge=0, default=1.0)
    motor_inertia = Quantity("J_m", "kg*m**2", "Moment of inertia of the motor's rotor and pulley", ge=0, optional=True)
    allowable_radial_force = Quantity("[F_r]", "N", "Radial force that the maker of the motor allows on its shaft, at the middle of the pulley", gt=0,
        optional=True)
    load_inertia = Quantity("J_l", "kg*m**2", "Moment of inertia that runs up with the output shaft, referred to that shaft", ge=0, optional=True)
    mounted_inertia = Quantity("J_F", "kg*m**2", "Moment of inertia of the flywheel that is mounted; without it the calculated one", gt=0,
        optional=True)
    mounted_diameter = Quantity("D_F", "mm", "Outer diameter of the flywheel that is mounted", gt=0, optional=True)
    shaft_2_inertia = Quantity("J_s2", "kg*m**2", "Moment of inertia of the flywheel's shaft with its parts, without the flywheel; 0: neglected",
        ge=0, default=0)
    output_shafts_inertia = Quantity("J_so", "kg*m**2",
        "Moment of inertia of the shafts behind it that turn steadily, at the output shaft; 0: neglected, or in J_l", ge=0, default=0)
    allowable_run_up_time = Quantity("[t_a]", "s", "Maximum run-up time permitted by the motor's protection (trip class 10)", gt=0, default=10)
    toothed_belt = block(ToothedBelt, "Toothed belt that rolls the cylinder", optional=True)
    n_points = samples(720)
