"""Cam-gear stepper and Geneva drive compared on the same step and cycle time, each with its own dwell."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    BarGroup,
    Bars,
    Chapter,
    Chart,
    Comparison,
    CurveInput,
    Inputs,
    Mechanism,
    Quantity,
    Shape,
    Steps,
    Text,
    View,
    abscissa,
    as_number,
    case,
    chart_panel,
    choice,
    formula,
    from_curve,
    inner,
    level,
    line,
    m,
    mark,
    pi,
    reduction,
    samples,
    value,
    vertical,
)
from diecut_report.plugins.geneva_transport import formulas

# fmt: off


@formula
def are_alike(one: Any, other: Any) -> Any:
    """Whether two quantities are the same, rounding apart."""
    return abs(one - other) <= 1e-6 * abs(one)


@formula
def stop_sweep_best(geneva_dwell: Any, dwell_sweep: Any, peak_velocity: Any) -> Any:
    """Sweep of stop and start with which both ask for the same acceleration as the return, at the Geneva drive's dwell."""
    moved = 1 - geneva_dwell
    reach = peak_velocity * geneva_dwell
    return dwell_sweep * moved**2 / (reach * (reach + 2 * moved))


@formula
def time_of_stop(stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_velocity: Any) -> Any:
    """Share of stop and start."""
    return peak_velocity * geneva_dwell * stop_sweep / dwell_sweep


@formula
def time_of_return(geneva_dwell: Any, time_of_stop: Any) -> Any:
    """Share of the return."""
    return 1 - geneva_dwell - time_of_stop


@formula
def velocity_of_return(
    stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_velocity: Any, return_time: Any
) -> Any:
    """Greatest velocity of the sheet: the disc's part and the returning sector's."""
    return 1 + peak_velocity * geneva_dwell * (1 + stop_sweep / dwell_sweep) / return_time


@formula
def acceleration_of_stop(
    stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_acceleration: Any, stop_time: Any
) -> Any:
    """Greatest acceleration of the sheet while the sector stops and starts."""
    return peak_acceleration * geneva_dwell * stop_sweep / (dwell_sweep * stop_time**2)


@formula
def acceleration_of_return(
    stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_acceleration: Any, return_time: Any
) -> Any:
    """Greatest acceleration of the sheet while the sector returns."""
    return peak_acceleration * geneva_dwell * (1 + stop_sweep / dwell_sweep) / return_time**2


DRIVES = (("cam-gear", "cam"), ("Geneva", "geneva"))
NARROWEST = 0.25  # of the sweeps drawn, to that of the least acceleration


def cycle(view: View) -> list[Shape]:
    """Velocity and acceleration of the sheet over the cycle, both drives; in m/s where the step is known."""
    step, time = view.get("cam_step", view.get("geneva_step", 0.0)), view["cycle_time"]
    if step:
        return [
            _over_cycle(view, "velocity", "Velocity of the sheet", "m/s", step / time),
            _over_cycle(view, "acceleration", "Acceleration of the sheet", "m/s**2", step / time**2),
        ]
    return [
        _over_cycle(view, "velocity", "Velocity in units of S/T", "1", 1.0),
        _over_cycle(view, "acceleration", "Acceleration in units of S/T²", "1", 1.0),
    ]


def _over_cycle(view: View, what: str, title: str, unit: str, factor: float) -> Shape:
    share = np.append(np.array(view.curve("cycle_angle")) / (2 * np.pi), 1.0)
    return chart_panel(
        title,
        unit,
        "Fraction of the cycle",
        "",
        "1",
        lines=[line(share, _closed(view, f"{drive}_{what}") * factor, name) for name, drive in DRIVES],
        verticals=[vertical(view["dwell_share"], "end of the cam-gear's dwell")],
    )


def _closed(view: View, curve: str) -> Any:
    """A curve's samples, and again the first one at the end of the cycle."""
    values = view.curve(curve)
    return np.array([*values, values[0]])


def _same_dwell(view: View) -> list[Shape]:
    """What a cam-gear with the Geneva drive's dwell asks of the sheet, over its sweep of stop and start."""
    dwell, held, peak = view["geneva_dwell"], view["sector_dwell_sweep"], view["law_peak_velocity"]
    best, limit = view["stop_sweep_best"], view["stop_sweep_limit"]
    sweep = np.linspace(NARROWEST * best, limit, 181)
    stop = time_of_stop(sweep, dwell, held, peak)
    back = time_of_return(dwell, stop)
    hard = view["law_peak_acceleration"]
    stopping = acceleration_of_stop(sweep, dwell, held, hard, stop)
    returning = acceleration_of_return(sweep, dwell, held, hard, back)
    over = ("Sweep of stop and start", "γ_3(3+1)", "deg")
    return [
        chart_panel("Maximum acceleration in units of S/T²", "1", *over,
                    lines=[line(sweep, stopping, "stop and start"), line(sweep, returning, "return")],
                    marks=[mark(best, view["best_acceleration"], "minimum")],
                    levels=[level(view["geneva_acceleration_peak"], "Geneva")]),
        chart_panel("Maximum velocity in units of S/T", "1", *over,
                    lines=[line(sweep, velocity_of_return(sweep, dwell, held, peak, back), "cam-gear")],
                    marks=[mark(best, view["best_velocity"], "with the lowest acceleration")],
                    levels=[level(view["geneva_velocity_peak"], "Geneva")]),
    ]  # fmt: skip


def _both(label: str, unit: str, cam: str, geneva: str) -> BarGroup:
    return BarGroup(label, unit, bars=(("cam-gear", cam), ("Geneva", geneva)))


FIGURES = (
    Bars(
        "peaks",
        "Dwell and peaks",
        "Dwell as a fraction of the cycle, maximum velocity in units of S/T, maximum acceleration in units of S/T², and maximum power in "
        "units of m·S²/T³, which is also the ratio of the torques.",
        groups=(
            _both("Dwell", "%", "dwell_share", "geneva_dwell"),
            _both("Velocity", "1", "cam_velocity_peak", "geneva_velocity_peak"),
            _both("Acceleration", "1", "cam_acceleration_peak", "geneva_acceleration_peak"),
            _both("Power", "1", "cam_power_peak", "geneva_power_peak"),
        ),
    ),
    Chart(
        "cycle",
        "Motion of the sheet by both drives",
        "Over a cycle that begins with the cam-gear's dwell; both motions have the same middle.",
        build=cycle,
    ),
    Chart(
        "same_dwell",
        "Cam-gear with the Geneva drive's dwell",
        "Acceleration of the sheet versus the sweep of stop and start, up to the sweep that leaves a tenth of the cycle for the return.",
        build=_same_dwell,
    ),
)


LEAST_RETURN = 0.1  # share of the cycle that the cam-gear's sector needs at least for its return


class TransportComparison(Inputs):
    """What the comparison takes from both drives."""

    dwell_share = Quantity("T_2", "1", "Cam-gear: dwell fraction of the cycle")
    sector_dwell_sweep = Quantity("γ_32", "deg", "Cam-gear: sweep of the sector in the dwell")
    sector_stop_sweep = Quantity("γ_3(3+1)", "deg", "Cam-gear: sweep of the sector while it stops and starts")
    motion_law = Text("Cam-gear: law of motion")
    law_peak_velocity = Quantity("B", "1", "Cam-gear: peak velocity of the law")
    law_peak_acceleration = Quantity("A", "1", "Cam-gear: peak acceleration of the law")
    cycles_per_hour = Quantity("n", "1/h", "Cam-gear: cycle rate, one sheet per cycle")
    gear_speed = CurveInput("ω_1", "rad", "Cam-gear: speed of the gear, per revolution of the disc")
    gear_acceleration = CurveInput("ε_1", "rad/s**2", "Cam-gear: acceleration of the gear")
    cam_step = Quantity("S_c", "mm", "Cam-gear: step of the sheet", optional=True)
    conveyor_mass = Quantity("m_c", "kg", "Cam-gear: mass that moves with the conveyor", optional=True)
    slots = Quantity("z", "1", "Geneva: number of slots of the wheel", integer=True)
    crank_speed = Quantity("ω_g", "rpm", "Geneva: speed of the crank")
    geneva_step = Quantity("S_g", "mm", "Geneva: step of the sheet", optional=True)
    n_points = samples(720)


basis = Chapter("Basis of comparison",
    text="Both drives make the same step S in the same time T, each with its own dwell. Velocities are related to the mean velocity S/T, "
        "accelerations to S/T²; so they hold for any step and any productivity.")
basis.cycle_time = 1 / m.cycles_per_hour, "T", "ms", "Cycle time of the cam-gear", "kinematics"
basis.geneva_cycle_time = 2 * pi / m.crank_speed, "T_g", "ms", "Time of a revolution of the Geneva drive's crank, as given there", "kinematics"
basis.cycle_basis = (choice(case("both drives have it", "the cycle times are the same", are_alike.of(one=m.cycle_time, other=m.geneva_cycle_time)),
    case("the cam-gear's, for both drives", "the Geneva drive has another one")), "→", "1", "Cycle time of the comparison")
basis.step_basis = (choice(case("both drives have it", "the steps are the same", are_alike.of(one=m.cam_step, other=m.geneva_step)),
    case("the cam-gear's, for both drives", "the Geneva drive has another one"), needs=("cam_step", "geneva_step")), "→", "1",
    "Step of the comparison")

dwell = Chapter("Dwell")
dwell.geneva_dwell = formulas.dwell_fraction, "κ_d", "1", "Geneva: dwell fraction of the cycle", "geometry"
dwell.cam_time_dwell = m.dwell_share * m.cycle_time, "t_c", "ms", "Cam-gear: time of the dwell", "kinematics"
dwell.geneva_time_dwell = m.geneva_dwell * m.cycle_time, "t_g", "ms", "Geneva: time of the dwell", "kinematics"
dwell.dwell_ratio = m.geneva_dwell / m.dwell_share, "q_d", "1", "Dwell, ratio of Geneva to cam-gear", "kinematics"

IN_SLOT = m.engaged == 1

motion = Chapter("Motion of the sheet over a cycle",
    text="The cycle begins with the cam-gear's dwell; the motions of both drives have the same middle. k and s hold for a whole piece of the cycle "
        "and are shown in its middle, all other curves at the stated φ.")
motion.crank_ratio = inner(formulas.crank_ratio), "λ", "1", "Geneva: ratio of crank radius to centre distance", "geometry"
motion.engagement_half_angle = inner(formulas.engagement_half_angle), "α_e", "deg", "Geneva: half the angle of the engagement", "geometry"
motion.middle = inner(pi * (1 + m.dwell_share)), "φ_m", "deg", "Cycle angle in the middle of both motions", "kinematics"
motion.geneva_entry = inner(m.middle - m.engagement_half_angle), "φ_g1", "deg", "Cycle angle at the Geneva drive's entry", "kinematics"
motion.geneva_exit = inner(m.middle + m.engagement_half_angle), "φ_g2", "deg", "Cycle angle at the Geneva drive's exit", "kinematics"
motion.cycle_angle = (abscissa(2 * np.pi, shown_at="geneva_acceleration_peak_at"), "φ", "deg",
    "Cycle angle, one revolution, from the beginning of the cam-gear's dwell")
motion.breakpoints("engagement", "cycle_angle", "geneva_entry", "geneva_exit")
motion.turns = (choice(case(1, "the end of the previous motion", m.cycle_angle < m.middle - pi), case(0, "the motion of this cycle"), output=False,
    per_piece=True), "k", "1", "Nearest motion of the Geneva drive")
motion.geneva_angle = (inner(m.cycle_angle - m.middle + 2 * pi * m.turns), "α", "deg", "Geneva: crank angle from the middle of the motion",
    "kinematics")
motion.engaged = (choice(case(1, "the roller is in a slot", abs(m.geneva_angle) <= m.engagement_half_angle),
    case(0, "the locking disc holds the wheel"), output=False, per_piece=True), "s", "1", "Geneva drive's roller in a slot (1) or not (0)")
motion.cam_gear_speed = (from_curve(given="gear_speed", abscissa="cycle_angle", output=False), "ω_1", "rad",
    "Cam-gear: speed of the gear, per revolution of the disc")
motion.cam_gear_acceleration = (from_curve(given="gear_acceleration", abscissa="cycle_angle", output=False), "ε_1", "rad/s**2",
    "Cam-gear: acceleration of the gear")
motion.cam_velocity = m.cam_gear_speed / (2 * pi), "v_c", "1", "Cam-gear: ratio of the sheet's velocity to the mean velocity S/T", "kinematics"
motion.cam_acceleration = (m.cam_gear_acceleration * m.cycle_time ** 2 / (2 * pi), "a_c", "1", "Cam-gear: sheet acceleration in units of S/T²",
    "kinematics")
motion.geneva_velocity = (choice(case(m.slots * formulas.speed_ratio(m.geneva_angle, m.crank_ratio), "the roller is in a slot", IN_SLOT),
    case(0, "the locking disc holds the wheel")), "v_g", "1", "Geneva: ratio of the sheet's velocity to the mean velocity S/T", "kinematics")
motion.geneva_acceleration = (choice(case(as_number(2 * pi) * m.slots * formulas.acceleration_ratio(m.geneva_angle, m.crank_ratio),
    "the roller is in a slot", IN_SLOT), case(0, "the locking disc holds the wheel")), "a_g", "1", "Geneva: sheet acceleration in units of S/T²",
    "kinematics")
motion.cam_power = inner(m.cam_velocity * m.cam_acceleration), "P_c", "1", "Cam-gear: power in units of m·S²/T³", "energy"
motion.geneva_power = inner(m.geneva_velocity * m.geneva_acceleration), "P_g", "1", "Geneva: power in units of m·S²/T³", "energy"
for what, letter, told in (("velocity", "v", "velocity in units of S/T"), ("acceleration", "a", "acceleration in units of S/T²"),
                           ("power", "P", "power in units of m·S²/T³, and so torque")):
    for drive, name in (("cam", "Cam-gear"), ("geneva", "Geneva")):
        motion[f"{drive}_{what}_peak"] = (reduction("abs_max", of=f"{drive}_{what}"), f"{letter}_{drive[0]},max", "1", f"{name}: maximum {told}",
            "kinematics")
motion.geneva_jump = (as_number(2 * pi) * m.slots * np.tan(pi / m.slots), "a_g,e", "1",
    "Geneva: jump of the acceleration at entry and exit in units of S/T²", "kinematics")
for what, symbol in (("velocity", "q_v"), ("acceleration", "q_a")):
    motion[f"{what}_ratio"] = (m[f"geneva_{what}_peak"] / m[f"cam_{what}_peak"], symbol, "1", f"Maximum {what}, ratio of Geneva to cam-gear",
        "kinematics")
motion.torque_ratio = m.geneva_power_peak / m.cam_power_peak, "q_M", "1", "Maximum torque for the same mass, ratio of Geneva to cam-gear", "energy"


def _in_units(chapter: Steps, step: str, needs: tuple[str, ...], lacks: tuple[str, ...]) -> None:
    """Peaks of both drives with the step of one of them."""
    drives = (("cam", "Cam-gear"), ("geneva", "Geneva"))
    for drive, name in drives:
        chapter[f"{drive}_sheet_velocity_max"] = (value(m[f"{drive}_velocity_peak"] * m[step] / m.cycle_time, needs=needs, lacks=lacks),
            f"V_{drive[0]}", "m/s", f"{name}: maximum velocity of the sheet", "kinematics")
    for drive, name in drives:
        chapter[f"{drive}_sheet_acceleration_max"] = (value(m[f"{drive}_acceleration_peak"] * m[step] / m.cycle_time**2, needs=needs, lacks=lacks),
            f"a_s{drive[0]}", "m/s**2", f"{name}: maximum acceleration of the sheet", "kinematics")
    for drive, name in drives:
        chapter[f"{drive}_torque_peak"] = (value(m[f"{drive}_power_peak"] * m.conveyor_mass * (m[step] / m.cycle_time) ** 2 / (2 * pi),
            needs=(*needs, "conveyor_mass"), lacks=lacks), f"M_{drive[0]}", "N*m", f"{name}: maximum torque for the conveyor's mass alone", "energy")


sheet = Chapter("Velocity, acceleration and torque",
    text="With the step of the cam-gear, or of the Geneva drive where the cam-gear has none, and with the conveyor's mass of the cam-gear.")
_in_units(sheet, "cam_step", ("cam_step",), ())
_in_units(sheet, "geneva_step", ("geneva_step",), ("cam_step",))

same_dwell = Chapter("Cam-gear with the Geneva drive's dwell",
    text="A cam-gear stepper with this dwell has little time to stop, return and start. The time for stop and start is lost to the return: a wide "
        "sweep shortens the return, a narrow one makes the stop abrupt. In between there is one sweep with the same acceleration in both.")
same_dwell.stop_sweep_limit = ((1 - LEAST_RETURN - m.geneva_dwell) * m.sector_dwell_sweep / (m.law_peak_velocity * m.geneva_dwell), "γ_lim", "deg",
    "Sweep of stop and start that leaves a tenth of the cycle for the return", "003 eq. 1–4")
same_dwell.stop_sweep_best = (stop_sweep_best.of(dwell_sweep=m.sector_dwell_sweep, peak_velocity=m.law_peak_velocity), "γ_b", "deg",
    "Sweep of stop and start with the lowest acceleration of the sheet", "003 eq. 1–4")
same_dwell.best_stop_time = (time_of_stop.of(stop_sweep=m.stop_sweep_best, dwell_sweep=m.sector_dwell_sweep, peak_velocity=m.law_peak_velocity),
    "T_s", "1", "Fraction of the cycle for stop and start with this sweep", "003 eq. 3")
same_dwell.best_return_time = (time_of_return.of(time_of_stop=m.best_stop_time), "T_r", "1", "Fraction of the cycle for the return with this sweep",
    "003 eq. 4")
same_dwell.best_velocity = (velocity_of_return.of(stop_sweep=m.stop_sweep_best, dwell_sweep=m.sector_dwell_sweep, peak_velocity=m.law_peak_velocity,
    return_time=m.best_return_time), "v_b", "1", "Maximum velocity with this sweep in units of S/T", "003, after eq. 4")
same_dwell.best_acceleration = (acceleration_of_return.of(stop_sweep=m.stop_sweep_best, dwell_sweep=m.sector_dwell_sweep,
    peak_acceleration=m.law_peak_acceleration, return_time=m.best_return_time), "a_b", "1", "Maximum acceleration with this sweep in units of S/T²",
    "motion laws")
same_dwell.best_acceleration_ratio = (m.geneva_acceleration_peak / m.best_acceleration, "q_b", "1",
    "Ratio of the Geneva drive's acceleration to this value", "kinematics")

GENEVA_HAS = "the Geneva drive has"
JUMPS = "its acceleration jumps at entry and exit"
ACCELERATIONS = {"geneva": "geneva_acceleration_peak", "cam": "cam_acceleration_peak"}

verdict = Chapter("Verdict",
    text="Apart from the peaks, the acceleration of the Geneva drive jumps at entry and exit, which excites vibration of chain and sheet; the "
        "cam-gear has no jump if its law of motion has no acceleration at half its time.")
verdict.verdict = (choice(case(f"{GENEVA_HAS} lower peak acceleration and the same dwell, but {JUMPS}", "it accelerates the sheet less",
    (m.geneva_acceleration_peak < m.cam_acceleration_peak) & are_alike(m.geneva_dwell, m.dwell_share)),
    case(f"{GENEVA_HAS} lower peak acceleration and a longer dwell, but {JUMPS}", "it accelerates the sheet less",
    (m.geneva_acceleration_peak < m.cam_acceleration_peak) & (m.geneva_dwell >= m.dwell_share)),
    case(f"{GENEVA_HAS} lower peak acceleration, but a shorter dwell, and {JUMPS}", "it accelerates the sheet less",
    m.geneva_acceleration_peak < m.cam_acceleration_peak), case(f"{GENEVA_HAS} no lower peak acceleration and the same dwell, and {JUMPS}",
    "it does not accelerate the sheet less", are_alike.of(one=m.geneva_dwell, other=m.dwell_share)),
    case(f"{GENEVA_HAS} a longer dwell, but no lower peak acceleration, and {JUMPS}", "it does not accelerate the sheet less",
    m.geneva_dwell >= m.dwell_share), case(f"{GENEVA_HAS} no lower peak acceleration and a shorter dwell, and {JUMPS}",
    "the cam-gear is better in both")), "→", "1", "Peak acceleration and dwell")
verdict.peaks_verdict = (choice(case(f"{GENEVA_HAS} lower peak velocity and torque", "both are below the cam-gear's",
    (m.velocity_ratio < 1) & (m.torque_ratio < 1)), case(f"{GENEVA_HAS} lower peak velocity, but no lower torque",
    "its velocity is below the cam-gear's", m.velocity_ratio < 1), case(f"{GENEVA_HAS} lower peak torque, but no lower velocity",
    "its torque is below the cam-gear's", m.torque_ratio < 1), case(f"{GENEVA_HAS} no lower peak velocity and torque",
    "neither is below the cam-gear's")), "→", "1", "Peak velocity and torque")
verdict.dwell_verdict = (choice(case("it does already", "its dwell is not shorter", m.geneva_dwell <= m.dwell_share),
    case("yes, with its sweep of stop and start", "the sweep leaves a tenth of the cycle for the return", m.sector_stop_sweep <= m.stop_sweep_limit),
    case("only with a smaller sweep of stop and start",
    "the present sweep leaves less than a tenth of the cycle for the return; γ_lim is the largest that leaves it, and γ_b gives the lowest "
    "acceleration")), "→", "1", "Can the cam-gear dwell as long as the Geneva drive?")

COMPARISON = Mechanism(
    kind="transport_comparison",
    version="1.0",
    title="Comparison of cam-gear stepper and Geneva drive",
    summary="Both drives of the sheet conveyor for the same step and cycle time, each with its own dwell: velocity and acceleration of the "
            "sheet, torque for the same mass, dwell, and what the cam-gear would need for the Geneva drive's dwell.",
    inputs=TransportComparison,
    chapters=(basis, dwell, motion, sheet, same_dwell, verdict),
    key_results=("verdict", "peaks_verdict", "dwell_verdict", "dwell_ratio", "velocity_ratio", "acceleration_ratio", "torque_ratio",
                 "stop_sweep_limit", "stop_sweep_best"),
    figures=FIGURES,
    assumptions=(
        "Both drives move the same conveyor without losses; torque is that of the conveyor's mass alone, at the shaft that makes one revolution "
        "per cycle.",
        "For the Geneva drive's dwell the cam-gear keeps its law of motion and its sweep in the dwell; its cams must be checked again.",
        "A press has one of the two: the cyclogram, and then motor and flywheel, use the one that is a line there.",
    ),
)

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
