"""Chapters on the motor, the flywheel and the run-up."""

from __future__ import annotations

from diecut_report.api import Accumulated, Chapter, Lookup, Pick, Reduction, Value, Words, bind
from diecut_report.mechanics import common
from diecut_report.plugins.drive_train import belts, inertia, motor_advice

MOTOR = Chapter(
    "Motor",
    steps=(
        Value(id="power_required", symbol="P_req", unit="kW", description="Required power of the motor, with the reserve",
              source="this method", formula=bind(common.product, first="shaft_1_power", second="reserve_factor")),
        Pick(id="motor_power", symbol="P_r", unit="kW", description="Rated power of the motor", source="IEC 60072-1",
             of="power_required", series=motor_advice.RATINGS, rule="above"),
        Value(id="motor_rated_torque", symbol="M_r", unit="N*m", description="Rated torque of the motor", source="mechanics",
              formula=bind(common.quotient, quantity="motor_power", by="shaft_1_speed")),
        Value(id="motor_peak_torque", symbol="M_1,peak", unit="N*m", description="Peak torque of the output, referred to the motor",
              source="this method", lacks=("torque_curve",),
              formula=bind(inertia.peak_at_motor, gear_ratio="gear_ratio_total", belt_ratio="vbelt_ratio_actual",
                           efficiency="efficiency_total")),
        Value(id="motor_breakdown_torque", symbol="M_br", unit="N*m", description="Breakdown torque of the motor", source="this method",
              lacks=("torque_curve",), formula=bind(common.product, first="breakdown_ratio", second="motor_rated_torque")),
        Words(id="motor_advice", description="What a standard motor could give", function=motor_advice.motor_advice, output=False,
              takes=("shaft_1_power",)),
        Words(id="overload_advice", description="Which reserve the motor needs", function=motor_advice.overload_advice, output=False,
              lacks=("torque_curve",), takes=("motor_peak_torque", "breakdown_ratio", "shaft_1_speed", "shaft_1_power")),
    ),
)  # fmt: skip

FLYWHEEL = Chapter(
    "Flywheel",
    text="The motor gives the mean torque; what the load takes beyond it comes from the flywheel and returns to it. The wheel turns "
    "i_g times as far as the output shaft. It is counted as a disc of steel or cast iron, a fifth as wide as its diameter, "
    "and alone: rotor, pulleys and gears help it.",
    needs=("torque_curve",),
    absent="not calculated: torque_curve is not given",
    steps=(
        Value(id="excess_torque", symbol="ΔM", unit="N*m", description="Torque beyond the mean", source="this method", output=False,
              formula=bind(common.difference, greater="flywheel_torque", smaller="flywheel_torque_mean")),
        Accumulated(id="excess_integral", symbol="A", unit="J", description="Integral of it over the angle of the output shaft",
                    source="this method", output=False, of="excess_torque"),
        Value(id="excess_energy", symbol="E", unit="J", description="Energy taken from the flywheel since the turn began",
              source="this method", formula=bind(common.product, first="gear_ratio_total", second="excess_integral")),
        Reduction(id="excess_energy_max", symbol="E_max", unit="J", description="Greatest energy taken: the flywheel is slowest",
                  of="excess_energy", operation="max"),
        Reduction(id="excess_energy_min", symbol="E_min", unit="J", description="Least energy taken: the flywheel is fastest",
                  of="excess_energy", operation="min"),
        Reduction(id="energy_fluctuation", symbol="ΔE", unit="J", description="Fluctuation of the energy over a turn",
                  source="this method", of="excess_energy", operation="range"),
        Value(id="flywheel_inertia", symbol="J", unit="kg*m**2", description="Moment of inertia of the flywheel", source="energy",
              formula=bind(inertia.inertia, energy="energy_fluctuation", speed="shaft_2_speed")),
        Lookup(id="flywheel_density", symbol="ρ", unit="kg/m**3", description="Density of the flywheel", source="material", output=False,
               by="flywheel_material", table=motor_advice.DENSITIES),
        Lookup(id="flywheel_rim_limit", symbol="[v]", unit="m/s", description="Allowed speed of the flywheel's rim", source="material",
               output=False, by="flywheel_material", table=motor_advice.RIM_SPEEDS),
        Value(id="flywheel_diameter", symbol="D", unit="mm", description="Diameter of the flywheel as a disc", source="this method",
              formula=bind(inertia.disc_diameter, inertia="flywheel_inertia", density="flywheel_density")),
        Value(id="flywheel_width", symbol="B", unit="mm", description="Width of the disc", source="this method",
              formula=bind(inertia.disc_width, diameter="flywheel_diameter")),
        Value(id="flywheel_mass", symbol="m_f", unit="kg", description="Mass of the flywheel", source="geometry",
              formula=bind(inertia.disc_mass, density="flywheel_density", diameter="flywheel_diameter", width="flywheel_width")),
        Value(id="flywheel_rim_speed", symbol="v_f", unit="m/s", description="Speed of the flywheel's rim", source="kinematics",
              formula=bind(belts.rim_speed, speed="shaft_2_speed", diameter="flywheel_diameter")),
        Words(id="rim_advice", description="How the flywheel's rim would hold", function=motor_advice.rim_advice, output=False,
              takes=("flywheel_rim_speed", "flywheel_rim_limit", "speed_fluctuation", "flywheel_density")),
    ),
)  # fmt: skip

FOR_RUN_UP = ("allowable_run_up_time", "shaft_1_speed", "shaft_1_power", "run_up_torque", "run_up_torque_ratio", "run_up_load",
              "shaft_1_torque", "run_up_inertia", "load_inertia", "gear_ratio_total", "gears_efficiency", "vbelt_ratio_actual",
              "vbelt.efficiency")  # fmt: skip

RUN_UP = Chapter(
    "Run-up of the motor",
    text="From rest the motor brings rotor, flywheel and load to their speeds with its mean run-up torque, less what the load takes. "
    "Without torque_curve there is no flywheel; the time is then calculated where motor_inertia or load_inertia is above 0.",
    steps=(
        Value(id="flywheel_shaft_inertia", symbol="J_2", unit="kg*m**2", description="Inertia at the flywheel's shaft", source="energy",
              output=False, needs=("torque_curve",),
              formula=bind(inertia.inertia_before, own="flywheel_inertia", behind="load_inertia", ratio="gear_ratio_total",
                           efficiency="gears_efficiency")),
        Value(id="flywheel_shaft_inertia", symbol="J_2", unit="kg*m**2", description="Inertia at shaft 2, which has no flywheel",
              source="energy", output=False, lacks=("torque_curve",),
              formula=bind(inertia.referred, behind="load_inertia", ratio="gear_ratio_total", efficiency="gears_efficiency")),
        Value(id="run_up_inertia", symbol="J_1", unit="kg*m**2", description="Inertia at the motor's shaft, belt and gear losses included",
              source="energy", formula=bind(inertia.inertia_before, own="motor_inertia", behind="flywheel_shaft_inertia",
                                            ratio="vbelt_ratio_actual", efficiency="vbelt.efficiency")),
        Value(id="run_up_torque", symbol="M_a", unit="N*m", description="Mean torque of the motor while it runs up", source="this method",
              formula=bind(common.product, first="run_up_torque_ratio", second="motor_rated_torque")),
        Value(id="run_up_load_torque", symbol="M_l", unit="N*m", description="Load at the motor while it runs up", source="this method",
              formula=bind(common.product, first="run_up_load", second="shaft_1_torque")),
        Value(id="accelerating_torque", symbol="M_acc", unit="N*m", description="Torque left to accelerate", source="mechanics",
              formula=bind(common.difference, greater="run_up_torque", smaller="run_up_load_torque")),
        Value(id="run_up_time", symbol="t_a", unit="s", description="Run-up time of the motor", source="mechanics",
              exists=bind(inertia.accelerates, inertia="run_up_inertia"),
              formula=bind(inertia.run_up_time, inertia="run_up_inertia", speed="shaft_1_speed")),
        Words(id="run_up_advice", description="How the motor would run up in time", function=motor_advice.run_up_advice,
              output=False, needs=("torque_curve",), takes=(*FOR_RUN_UP, "flywheel_inertia", "speed_fluctuation")),
        Words(id="run_up_advice", description="How the motor would run up in time", function=motor_advice.run_up_advice, output=False,
              lacks=("torque_curve",), takes=FOR_RUN_UP),
    ),
)  # fmt: skip
