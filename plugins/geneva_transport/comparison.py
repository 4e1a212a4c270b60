"""Cam-gear stepper and Geneva drive compared on the same step and cycle time, each with its own dwell."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    POINTS,
    Abscissa,
    Annotated,
    Breakpoints,
    Case,
    Chapter,
    Choice,
    Comparison,
    CurveInput,
    FromCurve,
    Inputs,
    Mechanism,
    Quantity,
    Reduction,
    Step,
    Text,
    Value,
    bind,
)
from diecut_report.mechanics import common
from diecut_report.plugins.geneva_transport import comparison_formulas as related
from diecut_report.plugins.geneva_transport import formulas
from diecut_report.plugins.geneva_transport.comparison_figures import FIGURES

LEAST_RETURN = 0.1  # share of the cycle that the cam-gear's sector needs at least for its return


class TransportComparison(Inputs):
    """What the comparison takes from both drives."""

    dwell_share: Annotated[float, Quantity("T_2", "1", "Cam-gear: share of the dwell")]
    sector_dwell_sweep: Annotated[float, Quantity("γ_32", "deg", "Cam-gear: sweep of the sector in the dwell")]
    sector_stop_sweep: Annotated[
        float, Quantity("γ_3(3+1)", "deg", "Cam-gear: sweep of the sector while it stops and starts")
    ]
    motion_law: Annotated[str, Text("Cam-gear: law of motion", "law")]
    law_peak_velocity: Annotated[float, Quantity("B", "1", "Cam-gear: peak velocity of the law")]
    law_peak_acceleration: Annotated[float, Quantity("A", "1", "Cam-gear: peak acceleration of the law")]
    cycles_per_hour: Annotated[float, Quantity("n", "1/h", "Cam-gear: cycles, one sheet each")]
    gear_speed: Annotated[Any, CurveInput("ω_1", "rad", "Cam-gear: speed of the gear, for each turn of the disc")]
    gear_acceleration: Annotated[Any, CurveInput("ε_1", "rad/s**2", "Cam-gear: acceleration of the gear")]
    cam_step: Annotated[float | None, Quantity("S_c", "mm", "Cam-gear: step of the sheet")] = None
    conveyor_mass: Annotated[float | None, Quantity("m_c", "kg", "Cam-gear: mass that moves with the conveyor")] = None
    slots: Annotated[int, Quantity("z", "1", "Geneva: slots of the wheel", integer=True)]
    crank_speed: Annotated[float, Quantity("ω_g", "rpm", "Geneva: speed of the crank")]
    geneva_step: Annotated[float | None, Quantity("S_g", "mm", "Geneva: step of the sheet")] = None
    n_points: Annotated[int, POINTS] = 720


BASIS = Chapter(
    "What is compared",
    text="Both drives make the same step S in the same time T, each with its own dwell. Velocities are related to the mean velocity S/T, "
    "accelerations to S/T²; so they hold for any step and any productivity.",
    steps=(
        Value(id="cycle_time", symbol="T", unit="ms", description="Time of a cycle, as the cam-gear has it", source="kinematics",
              formula=bind(related.time_of_cycle, cycles="cycles_per_hour")),
        Value(id="geneva_cycle_time", symbol="T_g", unit="ms", description="Time of a turn of the Geneva drive's crank, as given there",
              source="kinematics", formula=formulas.cycle_time),
        Choice(id="cycle_basis", symbol="→", description="Cycle time that is compared",
               cases=(Case("both drives have it", "the cycle times are the same",
                           bind(related.are_alike, one="cycle_time", other="geneva_cycle_time")),
                      Case("the cam-gear's, for both drives", "the Geneva drive has another one"))),
        Choice(id="step_basis", symbol="→", description="Step that is compared", needs=("cam_step", "geneva_step"),
               cases=(Case("both drives have it", "the steps are the same", bind(related.are_alike, one="cam_step", other="geneva_step")),
                      Case("the cam-gear's, for both drives", "the Geneva drive has another one"))),
    ),
)  # fmt: skip

DWELL = Chapter(
    "Dwell",
    steps=(
        Value(id="geneva_dwell", symbol="κ_d", description="Geneva: share of the dwell", source="geometry", formula=formulas.dwell_fraction),
        Value(id="cam_time_dwell", symbol="t_c", unit="ms", description="Cam-gear: time of the dwell", source="kinematics",
              formula=bind(common.product, first="dwell_share", second="cycle_time")),
        Value(id="geneva_time_dwell", symbol="t_g", unit="ms", description="Geneva: time of the dwell", source="kinematics",
              formula=bind(common.product, first="geneva_dwell", second="cycle_time")),
        Value(id="dwell_ratio", symbol="q_d", description="Dwell, Geneva to cam-gear", source="kinematics",
              formula=bind(common.quotient, quantity="geneva_dwell", by="dwell_share")),
    ),
)  # fmt: skip


def _ratio(what: str, symbol: str, title: str) -> Value:
    return Value(id=f"{what}_ratio", symbol=symbol, description=f"{title}, Geneva to cam-gear", source="kinematics",
                 formula=bind(common.quotient, quantity=f"geneva_{what}_peak", by=f"cam_{what}_peak"))  # fmt: skip


IN_SLOT = bind(formulas.holds, flag="engaged")

MOTION = Chapter(
    "Motion of the sheet over a cycle",
    text="The cycle begins with the cam-gear's dwell; the motions of both drives have the same middle. "
    "k and s hold for a whole piece of the cycle and are shown in its middle, all other curves at the one φ that is named.",
    steps=(
        Value(id="crank_ratio", symbol="λ", description="Geneva: crank radius to centre distance", source="geometry", output=False,
              formula=formulas.crank_ratio),
        Value(id="engagement_half_angle", symbol="α_e", unit="deg", description="Geneva: half the angle of the engagement", source="geometry",
              output=False, formula=formulas.engagement_half_angle),
        Value(id="middle", symbol="φ_m", unit="deg", description="Angle of the cycle in the middle of both motions", source="kinematics",
              output=False, formula=related.middle_of_motion),
        Value(id="geneva_entry", symbol="φ_g1", unit="deg", description="Angle of the cycle at the Geneva drive's entry", source="kinematics",
              output=False, formula=bind(common.difference, greater="middle", smaller="engagement_half_angle")),
        Value(id="geneva_exit", symbol="φ_g2", unit="deg", description="Angle of the cycle at the Geneva drive's exit", source="kinematics",
              output=False, formula=bind(common.sum_of, first="middle", second="engagement_half_angle")),
        Abscissa(id="cycle_angle", symbol="φ", unit="deg", description="Angle of the cycle, one turn, from the beginning of the cam-gear's dwell",
                 period=2 * np.pi, shown_at="geneva_acceleration_peak_at"),
        Breakpoints(id="engagement", abscissa="cycle_angle", places=("geneva_entry", "geneva_exit")),
        Choice(id="turns", symbol="k", description="Motion of the Geneva drive that is nearest", output=False, per_piece=True,
               cases=(Case(common.one, "the end of the motion before", bind(related.comes_before, angle="cycle_angle")),
                      Case(common.zero, "the motion of this cycle"))),
        Value(id="geneva_angle", symbol="α", unit="deg", description="Geneva: crank angle from the middle of the motion", source="kinematics",
              output=False, formula=bind(related.from_middle, angle="cycle_angle")),
        Choice(id="engaged", symbol="s", description="Whether the Geneva drive's roller is in a slot (1) or not (0)", output=False, per_piece=True,
               cases=(Case(common.one, "the roller is in a slot",
                           bind(related.is_within, angle="geneva_angle", half="engagement_half_angle")),
                      Case(common.zero, "the locking disc holds the wheel"))),
        FromCurve(id="cam_gear_speed", symbol="ω_1", unit="rad", description="Cam-gear: speed of the gear, for each turn of the disc",
                  output=False, given="gear_speed", abscissa="cycle_angle"),
        FromCurve(id="cam_gear_acceleration", symbol="ε_1", unit="rad/s**2", description="Cam-gear: acceleration of the gear", output=False,
                  given="gear_acceleration", abscissa="cycle_angle"),
        Value(id="cam_velocity", symbol="v_c", description="Cam-gear: velocity of the sheet to the mean velocity S/T", source="kinematics",
              formula=bind(related.cam_velocity, gear_speed="cam_gear_speed")),
        Value(id="cam_acceleration", symbol="a_c", description="Cam-gear: acceleration of the sheet to S/T²", source="kinematics",
              formula=bind(related.cam_acceleration, gear_acceleration="cam_gear_acceleration")),
        Choice(id="geneva_velocity", symbol="v_g", description="Geneva: velocity of the sheet to the mean velocity S/T", source="kinematics",
               cases=(Case(bind(related.geneva_velocity, angle="geneva_angle"), "the roller is in a slot", IN_SLOT),
                      Case(common.zero, "the locking disc holds the wheel"))),
        Choice(id="geneva_acceleration", symbol="a_g", description="Geneva: acceleration of the sheet to S/T²", source="kinematics",
               cases=(Case(bind(related.geneva_acceleration, angle="geneva_angle"), "the roller is in a slot", IN_SLOT),
                      Case(common.zero, "the locking disc holds the wheel"))),
        Value(id="cam_power", symbol="P_c", description="Cam-gear: power to m·S²/T³", source="energy", output=False,
              formula=bind(common.product, first="cam_velocity", second="cam_acceleration")),
        Value(id="geneva_power", symbol="P_g", description="Geneva: power to m·S²/T³", source="energy", output=False,
              formula=bind(common.product, first="geneva_velocity", second="geneva_acceleration")),
        *(Reduction(id=f"{drive}_{what}_peak", symbol=f"{letter}_{drive[0]},max", of=f"{drive}_{what}", operation="abs_max", source="kinematics",
                    description=f"{name}: greatest {told}")
          for what, letter, told in (("velocity", "v", "velocity to S/T"), ("acceleration", "a", "acceleration to S/T²"),
                                     ("power", "P", "power to m·S²/T³, and so torque"))
          for drive, name in (("cam", "Cam-gear"), ("geneva", "Geneva"))),
        Value(id="geneva_jump", symbol="a_g,e", description="Geneva: jump of the acceleration to S/T² at entry and exit", source="kinematics",
              formula=related.geneva_jump),
        _ratio("velocity", "q_v", "Greatest velocity"),
        _ratio("acceleration", "q_a", "Greatest acceleration"),
        Value(id="torque_ratio", symbol="q_M", description="Greatest torque for the same mass, Geneva to cam-gear", source="energy",
              formula=bind(common.quotient, quantity="geneva_power_peak", by="cam_power_peak")),
    ),
)  # fmt: skip


def _in_units(step: str, needs: tuple[str, ...], lacks: tuple[str, ...]) -> tuple[Step, ...]:
    """Peaks of both drives with the step of one of them."""
    own: dict[str, Any] = {"needs": needs, "lacks": lacks}
    heavy: dict[str, Any] = {"needs": (*needs, "conveyor_mass"), "lacks": lacks}
    drives = (("cam", "Cam-gear"), ("geneva", "Geneva"))
    return (
        *(Value(id=f"{drive}_sheet_velocity_max", symbol=f"V_{drive[0]}", unit="m/s", source="kinematics", **own,
                description=f"{name}: greatest velocity of the sheet", formula=bind(related.in_metres, relative=f"{drive}_velocity_peak", step=step))
          for drive, name in drives),
        *(Value(id=f"{drive}_sheet_acceleration_max", symbol=f"W_{drive[0]}", unit="m/s**2", source="kinematics", **own,
                description=f"{name}: greatest acceleration of the sheet",
                formula=bind(related.in_metres_squared, relative=f"{drive}_acceleration_peak", step=step))
          for drive, name in drives),
        *(Value(id=f"{drive}_torque_peak", symbol=f"M_{drive[0]}", unit="N*m", source="energy", **heavy,
                description=f"{name}: greatest torque for the conveyor's mass alone",
                formula=bind(related.in_newton_metres, relative=f"{drive}_power_peak", mass="conveyor_mass", step=step))
          for drive, name in drives),
    )  # fmt: skip


SHEET = Chapter(
    "Velocity, acceleration and torque",
    text="With the step of the cam-gear, or of the Geneva drive where the cam-gear has none, and the conveyor's mass of the cam-gear.",
    steps=(*_in_units("cam_step", ("cam_step",), ()), *_in_units("geneva_step", ("geneva_step",), ("cam_step",))),
)

SAME_DWELL = Chapter(
    "Cam-gear with the Geneva drive's dwell",
    text="A cam-gear stepper with this dwell has little time to stop, return and start. What its stop and start take, its return lacks: a "
    "wide sweep hurries the return, a narrow one makes the stop hard. In between one sweep asks for the same acceleration in both.",
    steps=(
        Value(id="stop_sweep_limit", symbol="γ_lim", unit="deg", source="003 eq. 1–4",
              description="Sweep of stop and start that leaves a tenth of the cycle for the return",
              formula=bind(related.stop_sweep_limit, dwell_sweep="sector_dwell_sweep", peak_velocity="law_peak_velocity",
                           least_return=LEAST_RETURN)),
        Value(id="stop_sweep_best", symbol="γ_b", unit="deg", source="003 eq. 1–4",
              description="Sweep of stop and start with the least acceleration of the sheet",
              formula=bind(related.stop_sweep_best, dwell_sweep="sector_dwell_sweep", peak_velocity="law_peak_velocity")),
        Value(id="best_stop_time", symbol="T_s", description="Share of stop and start with it", source="003 eq. 3",
              formula=bind(related.time_of_stop, stop_sweep="stop_sweep_best", dwell_sweep="sector_dwell_sweep",
                           peak_velocity="law_peak_velocity")),
        Value(id="best_return_time", symbol="T_r", description="Share of the return with it", source="003 eq. 4",
              formula=bind(related.time_of_return, time_of_stop="best_stop_time")),
        Value(id="best_velocity", symbol="v_b", description="Greatest velocity to S/T with it", source="003, after eq. 4",
              formula=bind(related.velocity_of_return, stop_sweep="stop_sweep_best", dwell_sweep="sector_dwell_sweep",
                           peak_velocity="law_peak_velocity", return_time="best_return_time")),
        Value(id="best_acceleration", symbol="a_b", description="Greatest acceleration to S/T² with it", source="motion laws",
              formula=bind(related.acceleration_of_return, stop_sweep="stop_sweep_best", dwell_sweep="sector_dwell_sweep",
                           peak_acceleration="law_peak_acceleration", return_time="best_return_time")),
        Value(id="best_acceleration_ratio", symbol="q_b", description="Acceleration of the Geneva drive to that", source="kinematics",
              formula=bind(common.quotient, quantity="geneva_acceleration_peak", by="best_acceleration")),
    ),
)  # fmt: skip

GENEVA_HAS = "the Geneva drive has"
JUMPS = "its acceleration jumps at entry and exit"
ACCELERATIONS = {"geneva": "geneva_acceleration_peak", "cam": "cam_acceleration_peak"}

VERDICT = Chapter(
    "Verdict",
    text="Beside the peaks counts that the Geneva drive's acceleration jumps at entry and exit, which shakes chain and sheet; the cam-gear "
    "does without a jump where its law of motion has no acceleration in the middle of its time.",
    steps=(
        Choice(id="verdict", symbol="→", description="Peak acceleration and dwell",
               cases=(Case(f"{GENEVA_HAS} lower peak acceleration and the same dwell, but {JUMPS}", "it accelerates the sheet less",
                           bind(related.is_gentle_and_alike, **ACCELERATIONS)),
                      Case(f"{GENEVA_HAS} lower peak acceleration and a longer dwell, but {JUMPS}", "it accelerates the sheet less",
                           bind(related.is_gentle_and_long, **ACCELERATIONS)),
                      Case(f"{GENEVA_HAS} lower peak acceleration, but a shorter dwell, and {JUMPS}", "it accelerates the sheet less",
                           bind(common.is_below, smaller="geneva_acceleration_peak", greater="cam_acceleration_peak")),
                      Case(f"{GENEVA_HAS} no lower peak acceleration and the same dwell, and {JUMPS}", "it does not accelerate the sheet less",
                           bind(related.are_alike, one="geneva_dwell", other="dwell_share")),
                      Case(f"{GENEVA_HAS} a longer dwell, but no lower peak acceleration, and {JUMPS}", "it does not accelerate the sheet less",
                           bind(common.is_at_least, greater="geneva_dwell", smaller="dwell_share")),
                      Case(f"{GENEVA_HAS} no lower peak acceleration and a shorter dwell, and {JUMPS}", "the cam-gear is ahead in both"))),
        Choice(id="peaks_verdict", symbol="→", description="Peak velocity and torque",
               cases=(Case(f"{GENEVA_HAS} lower peak velocity and torque", "both are below the cam-gear's",
                           bind(related.are_both_below_one, first="velocity_ratio", second="torque_ratio")),
                      Case(f"{GENEVA_HAS} lower peak velocity, but no lower torque", "its velocity is below the cam-gear's",
                           bind(common.is_below, smaller="velocity_ratio", greater=1)),
                      Case(f"{GENEVA_HAS} lower peak torque, but no lower velocity", "its torque is below the cam-gear's",
                           bind(common.is_below, smaller="torque_ratio", greater=1)),
                      Case(f"{GENEVA_HAS} no lower peak velocity and torque", "neither is below the cam-gear's"))),
        Choice(id="dwell_verdict", symbol="→", description="Can the cam-gear dwell as long as the Geneva drive",
               cases=(Case("it does already", "its dwell is not shorter",
                           bind(common.is_at_most, smaller="geneva_dwell", greater="dwell_share")),
                      Case("yes, with its sweep of stop and start", "the sweep leaves a tenth of the cycle for the return",
                           bind(common.is_at_most, smaller="sector_stop_sweep", greater="stop_sweep_limit")),
                      Case("only with a smaller sweep of stop and start", "the sweep as it is leaves less than a tenth of the cycle for the "
                           "return; γ_lim is the most that leaves it, and γ_b asks for the least acceleration"))),
    ),
)  # fmt: skip

COMPARISON = Mechanism(
    kind="transport_comparison",
    version="1.0",
    title="Cam-gear stepper and Geneva drive compared",
    summary="Both drives of the sheet conveyor on the same step and cycle time, each with its own dwell: velocity and acceleration of the sheet, "
    "torque for the same mass, dwell, and what the cam-gear would need for the Geneva drive's dwell.",
    inputs=TransportComparison,
    chapters=(BASIS, DWELL, MOTION, SHEET, SAME_DWELL, VERDICT),
    key_results=("verdict", "peaks_verdict", "dwell_verdict", "dwell_ratio", "velocity_ratio", "acceleration_ratio", "torque_ratio",
                 "stop_sweep_limit", "stop_sweep_best"),
    figures=FIGURES,
    assumptions=(
        "Both drives move the same conveyor without losses; torque is that of the conveyor's mass alone, at the shaft that makes a turn a cycle.",
        "For the Geneva drive's dwell the cam-gear keeps its law of motion and its sweep in the dwell; its cams are to be checked again.",
    ),
)  # fmt: skip

CAM, GENEVA = "cam_gear_transport", "geneva_transport"

COMPARED = Comparison(
    kinds=(CAM, GENEVA),
    mechanism=COMPARISON,
    takes={
        "dwell_share": (CAM, "time_dwell"),
        "sector_dwell_sweep": (CAM, "sector_dwell_sweep"),
        "sector_stop_sweep": (CAM, "sector_stop_sweep"),
        "motion_law": (CAM, "motion_law"),
        "law_peak_velocity": (CAM, "law_peak_velocity"),
        "law_peak_acceleration": (CAM, "law_peak_acceleration"),
        "cycles_per_hour": (CAM, "cycles_per_hour"),
        "gear_speed": (CAM, "gear_speed"),
        "gear_acceleration": (CAM, "gear_acceleration"),
        "cam_step": (CAM, "sheet_step"),
        "conveyor_mass": (CAM, "conveyor_mass"),
        "slots": (GENEVA, "slots"),
        "crank_speed": (GENEVA, "crank_speed"),
        "geneva_step": (GENEVA, "sheet_step"),
    },
)
