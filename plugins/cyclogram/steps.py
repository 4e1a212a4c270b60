"""Chapters of the cyclogram."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    GivenMechanism,
    Phrase,
    Refusal,
    abscissa,
    accumulated,
    computed,
    computed_curve,
    inner,
    m,
    pi,
    reduction,
    total,
    value,
)
from diecut_report.plugins.cyclogram import listings
from diecut_report.plugins.cyclogram.clearances import clearance_of
from diecut_report.plugins.cyclogram.listings import verdicts
from diecut_report.plugins.cyclogram.passing import stretches
from diecut_report.plugins.cyclogram.timing import timing_of
from diecut_report.plugins.cyclogram.torques import motions_of, torques_of

# fmt: off

LINES = ("mechanism", "turns_per_sheet", "offset", "path_efficiency", "torque_curve", "passing")
INTERLOCKS = ("name", "phase", "within", "apart_from", "margin")
FRICTION = ("name", "torque", "power", "turns_per_sheet", "path_efficiency")
STATION = ("cylinder", "transport", "carriage_stop", "carriage_width", "forward_direction")
PHASES = "phases of the lines over the common period of the main shaft"
LARGEST_RATE_ERROR = 1e-6  # relative
TIMING, SUM = ("timing",), ("sum",)

shaft = Chapter("Main shaft", text="One revolution of the main shaft is one sheet. After the common period all lines are back at their start.")
shaft.prepared("stretches", stretches, ("lines.mechanism", "lines.passing"), for_many=True)
shaft.prepared("timing", timing_of, ("productivity", "stretches", *(f"lines.{key}" for key in LINES), *(f"interlocks.{key}" for key in INTERLOCKS)))
shaft.sheet_time = 1 / m.productivity, "T_s", "ms", "Time per sheet, one revolution of the main shaft", "kinematics"
shaft.main_shaft_speed = 2 * pi * m.productivity, "ω_m", "rpm", "Speed of the main shaft", "kinematics"
shaft.sheets_per_period = (computed(lambda timing: float(timing.common), TIMING, "least common multiple of the periods of all phases", digits=6),
    "N_s", "1", "Sheets in the common period")
shaft.main_period = 2 * pi * m.sheets_per_period, "P", "deg", "Common period of the main shaft"
shaft.period_time = m.sheets_per_period * m.sheet_time, "T_P", "ms", "Time of the common period"
shaft.line_turns = (computed(lambda timing: np.array([[float(each.line.turns) for each in timing.lines]]), TIMING, "as given", over="lines",
    output=False), "i_k", "1", "Revolutions of each line per sheet")
shaft.line_offset = (computed(lambda timing: np.array([[each.line.offset for each in timing.lines]]), TIMING,
    "as given; an automatic one maximises the minimum slack of all interlocks", over="lines", digits=6), "Φ_k", "deg",
    "Main-shaft angle of each line's zero")
shaft.is_moved = computed(lambda timing: timing.moved is not None, TIMING, "as given", output=False), "k_a", "1", "Solution of the offset of a line"
shaft.offset_found = (computed(lambda timing: 0.0 if timing.moved is None else timing.lines[timing.moved].line.offset, TIMING,
    "where the minimum slack of all interlocks is largest", digits=6, exists=m.is_moved > 0), "Φ_f", "deg",
    "Solved offset: main-shaft angle of the zero of that line")
shaft.listing("main_phases", "Phases on the main shaft", listings.PHASES, listings.phases, TIMING)
shaft.words("line_name", lambda timing: tuple(each.name for each in timing.lines), TIMING, each_part=True)


def _worst(name: str) -> Any:
    return lambda timing: timing.row(getattr(each, name) for each in timing.worst)

interlocks = Chapter("Interlocks",
    text="A phase lies within another with the margins at its start and at its end; a negative margin is the overlap. Of several intervals the one "
        "with the smallest margin is given.")
for name, symbol, words, function in (
    ("margin_start", "m_1", "Margin at the start", _worst("start")),
    ("margin_end", "m_2", "Margin at the end", _worst("end")),
    ("margin_required", "m_r", "Required margin", lambda timing: timing.row(timing.required(each) for each in timing.final)),
    ("margin_least", "g", "Smaller of both margins", _worst("least")),
    ("slack", "g_s", "Slack: excess of the smaller margin over the required one",
     lambda timing: timing.row(pair.least - timing.required(each) for pair, each in zip(timing.worst, timing.final, strict=True))),
    ("held_length", "l_A", "Length of what must be contained", _worst("inner_length")),
):
    interlocks[name] = computed(function, TIMING, PHASES, over="interlocks"), symbol, "deg", words
for name, symbol, words, of in (("margin_start_time", "t_1", "Margin at the start, as a time", "margin_start"),
                                ("margin_end_time", "t_2", "Margin at the end, as a time", "margin_end")):
    interlocks[name] = m[of] / m.main_shaft_speed, symbol, "ms", words
interlocks.length_demand = inner(m.held_length + 2 * m.margin_required), "l_d", "deg", "Required length, margins included"
interlocks.length_available = inner(m.held_length + 2 * m.margin_least), "l_v", "deg", "Available length"
interlocks.best_margin = total("min", of="slack"), "g_min", "deg", "Minimum slack of all interlocks"
interlocks.best_margin_time = m.best_margin / m.main_shaft_speed, "t_g", "ms", "Minimum slack as a time"

interlocks.is_limited = (computed(lambda timing: timing.limit.value is not None, TIMING, "a margin is a time, and is kept at some speed",
    output=False), "k_n", "1", "Margins of time limit the productivity")
interlocks.productivity_limit = (computed(lambda timing: timing.limit.value or 0.0, TIMING,
    "angles remain, times take a larger angle the faster the shaft turns; torques and accelerations are not considered", digits=5,
    exists=m.is_limited > 0), "n_max", "1/h", "Maximum productivity that the margins of time allow; for information only")
interlocks.is_feasible = (computed(lambda timing: bool(timing.best and timing.best.feasible), TIMING, PHASES, output=False), "k_Φ", "1",
    "The solved offset keeps all margins")
interlocks.offset_feasible_start = (computed(lambda timing: timing.feasible[0], TIMING, PHASES, digits=6, exists=m.is_feasible > 0), "Φ_a", "deg",
    "Lower limit of the offsets around the solved one that keep all margins")
interlocks.offset_feasible_end = (computed(lambda timing: timing.feasible[1], TIMING, PHASES, digits=6, exists=m.is_feasible > 0), "Φ_b", "deg",
    "Upper limit of the offsets around the solved one that keep all margins")
interlocks.rate_error = (computed(lambda timing: np.array([timing.rate_errors]), TIMING,
    "own revolutions per second divided by revolutions per sheet, compared with the productivity", over="lines", output=False), "Δn", "1",
    "Relative deviation of each line's own rate from that of the press")
interlocks.worst_rate_error = total("max", of="rate_error", output=False), "Δn_max", "1", "Maximum of these deviations"


interlocks.is_window = (computed(lambda timing: np.isfinite([timing.needed_lengths]), TIMING, PHASES, over="interlocks", output=False), "k_w", "1",
    "A single interval per period contains it, so that a length can be given")
interlocks.needed_length = (computed(lambda timing: np.nan_to_num([timing.needed_lengths]), TIMING,
    "length of the one interval less twice the largest slack", over="interlocks", exists=m.is_window > 0), "l_n", "deg",
    "Required length of the containing phase, for the interlock alone at its best offset")
interlocks.listing("margins", "Margins of each interval", listings.MARGINS, listings.margins, TIMING)
interlocks.listing("offsets", "Offsets that keep all margins", listings.OFFSETS, listings.offsets, TIMING)
interlocks.listing("lacking", "Not checked", listings.LACKING, listings.lacking, ("timing", "station.transport"))
interlocks.words("interlock_verdict", verdicts, TIMING, each_part=True)

station = Chapter("Clearance of the carriages", needs=("station",), absent="not calculated: station is not given",
    text="The minimum height over all carriages, standing and moving, from the shape of the cylinder with its flat.")
station.prepared("clearance", clearance_of, ("timing", "main_period", *(f"lines.{key}" for key in LINES), *(f"station.{key}" for key in STATION)),
    for_many=True)
station.prepared("least", lambda given: given["clearance"].least, ("clearance",), for_many=True)
CLEARANCE = "search over the common period, refined to 1e-13 of it"


def _needed(cylinder: GivenMechanism) -> Any:
    height = cylinder.numbers("carriage_clearance")
    if height is None:
        template = "is {name}, which has no carriage_clearance to hold the room against; give it there"
        raise Refusal("station.cylinder", Phrase(template, name=cylinder.name))
    return height


station.is_below = (computed(lambda least: np.isfinite(least.height)[:, None], ("least",), "minimum height over the period", output=False), "k_Y",
    "1", "A carriage is below the cylinder at some time")
station.clearance_least = (computed(lambda least: np.where(np.isfinite(least.height), least.height, 0.0)[:, None], ("least",), CLEARANCE,
    exists=m.is_below > 0), "Y_min", "mm", "Minimum clearance height for the carriages")
station.clearance_angle = (computed(lambda least: least.angle[:, None], ("least",), CLEARANCE, exists=m.is_below > 0), "Φ_Y", "deg",
    "Main-shaft angle of this minimum")
station.carriage_clearance = (computed(_needed, ("station.cylinder",), "as given in the cylinder's drive"), "c_r", "mm",
    "Clearance required by the carriages")

interlocks.fact("rates_agree", m.worst_rate_error <= LARGEST_RATE_ERROR,
    "not calculated: a line runs at another rate than the press, so nothing can be summed over the main shaft")

motions = Chapter("Motions over the main shaft", needs=("rates_agree",))
motions.prepared("motions", motions_of, ("timing", "main_period", *(f"lines.{key}" for key in LINES)), for_many=True)
motions.main_angle = abscissa("main_period", speed="main_shaft_speed", intervals=16), "Φ", "deg", "Main-shaft angle"
OWN = "from the line's own calculation"
motions.part_curves("way", "s", "mm", "Displacement of the line", lambda motions: motions.ways.names,
    lambda motions, *asked: motions.ways.one(*asked), "motions", "main_angle", OWN, joints=lambda motions: motions.joints)
motions.moving_lines = (computed(lambda motions: float(len(motions.energies.names)), ("motions",), "as given", output=False), "N_E", "1",
    "Number of lines whose kinetic energy is known")
motions.fact("energy_known", m.moving_lines > 0, "not calculated: moving masses are not known for any line")
motions.clearance_over = (computed_curve(lambda clearance, *asked: clearance.over(*asked), "clearance", "main_angle",
    "shape of the cylinder with its flat", needs=("station",)), "Y", "mm",
    "Minimum height over all carriages; the cylinder's radius where none is below it")

energies = Chapter("Kinetic energies", needs=("rates_agree", "energy_known"))
energies.part_curves("kinetic_energy", "E", "J", "Kinetic energy of the line", lambda motions: motions.energies.names,
    lambda motions, *asked: motions.energies.one(*asked), "motions", "main_angle", OWN, joints=lambda motions: motions.joints)
energies.kinetic_energy_total = (computed_curve(lambda motions, *asked: motions.energies.total(*asked), "motions", "main_angle",
    "sum of the lines' kinetic energies", joints=lambda motions: motions.joints), "E_Σ", "J",
    "Total kinetic energy of all lines for which it is known")
energies.kinetic_energy_max = reduction("max", of="kinetic_energy_total"), "E_max", "J", "Maximum kinetic energy of all lines together"
energies.kinetic_energy_mean = reduction("mean", of="kinetic_energy_total"), "E_m", "J", "Mean kinetic energy of all lines together"
energies.kinetic_energy_range = (reduction("range", of="kinetic_energy_total", output=False), "ΔE_k", "J",
    "Range of the kinetic energy of all lines together")
energies.kinetic_energy_ranges = (computed(lambda motions: motions.ranges, ("motions",), "searched over a revolution of each line", output=False),
    "ΣΔE_k", "J", "Sum of the ranges of the kinetic energies of the lines")
energies.energy_exchange = np.maximum(m.kinetic_energy_ranges - m.kinetic_energy_range, 0), "E_e", "J", "Energy exchanged between drives"

torques = Chapter("Sum of the torques at the main shaft", needs=("rates_agree", "takes_torque"),
    text="The torque of a line is i·M/η at the main shaft where the shaft drives the line, and i·M·η where the line drives the shaft.")
motions.prepared("sum", torques_of,
    ("timing", "main_period", "main_shaft_speed", *(f"lines.{key}" for key in LINES), *(f"friction.{key}" for key in FRICTION)), for_many=True)
motions.words("torque_missing", lambda sum: ", ".join(sum.without) or "none", SUM)
motions.consumers = (computed(lambda sum: float(len(sum.consumers)), SUM, "as given", output=False), "N_c", "1",
    "Number of consumers whose torque is known")
motions.fact("takes_torque", m.consumers > 0, "not calculated: no line has a known torque, and no friction is given")
torques.part_curves("line_torque", "M", "N*m", "Torque of the line at the main shaft", lambda sum: sum.together.names,
    lambda sum, *asked: sum.together.one(*asked), "sum", "main_angle", OWN, joints=lambda sum: sum.joints)
torques.main_shaft_torque = (computed_curve(lambda sum, *asked: sum.together.total(*asked), "sum", "main_angle",
    "sum of the torques of all lines, each from its own calculation", joints=lambda sum: sum.joints), "M_Σ", "N*m", "Torque at the main shaft")
torques.greatest_torque = (computed_curve(lambda sum, *asked: sum.of_greatest(*asked), "sum", "main_angle",
    "the consumer with the largest mean torque at the main shaft"), "M_g", "N*m", "Torque of the largest consumer alone")
torques.torque_peak = reduction("abs_max", of="main_shaft_torque"), "M_peak", "N*m", "Maximum absolute torque"
torques.torque_max = reduction("max", of="main_shaft_torque"), "M_max", "N*m", "Maximum driving torque"
torques.torque_min = reduction("min", of="main_shaft_torque"), "M_min", "N*m", "Maximum braking torque"
torques.torque_mean = reduction("mean", of="main_shaft_torque"), "M_mean", "N*m", "Mean torque"
torques.torque_rms = reduction("rms", of="main_shaft_torque"), "M_rms", "N*m", "Root mean square torque"
for name, symbol, unit, words, figure in (
    ("greatest_mean", "M_g,mean", "N*m", "Mean torque of the largest consumer alone", "mean"),
    ("greatest_rms", "M_g,rms", "N*m", "Root mean square torque of the largest consumer alone", "rms"),
    ("greatest_max", "M_g,max", "N*m", "Maximum driving torque of the largest consumer alone", "largest"),
    ("greatest_min", "M_g,min", "N*m", "Maximum braking torque of the largest consumer alone", "least"),
    ("greatest_fluctuation", "ΔE_g", "J", "Range of the excess energy of the largest consumer alone", "fluctuation"),
):
    torques[name] = (computed(lambda sum, figure=figure: sum.figure_of_greatest(figure), SUM,
        "Gauss–Legendre between the breakpoints; extremes within each smooth piece"), symbol, unit, words)
torques.greatest_peak = np.maximum(m.greatest_max, -m.greatest_min), "M_g,peak", "N*m", "Maximum absolute torque of the largest consumer alone"
torques.power_mean = m.torque_mean * m.main_shaft_speed, "P_mean", "kW", "Mean power at the main shaft"
torques.power_peak = m.torque_peak * m.main_shaft_speed, "P_peak", "kW", "Peak power at the main shaft"
torques.greatest_power_mean = m.greatest_mean * m.main_shaft_speed, "P_g,mean", "kW", "Mean power of the largest consumer alone"
torques.greatest_power_peak = m.greatest_peak * m.main_shaft_speed, "P_g,peak", "kW", "Peak power of the largest consumer alone"
torques.torque_excess = inner(m.main_shaft_torque - m.torque_mean), "ΔM", "N*m", "Torque in excess of its mean"
torques.excess_energy = accumulated(of="torque_excess"), "E_x", "J", "Energy taken in excess of the mean, from the start of the period"
torques.energy_fluctuation = reduction("range", of="excess_energy"), "ΔE", "J", "Range of the excess energy over the common period"
for name, symbol, words, quantity, by in (
    ("mean_ratio", "k_mean", "Ratio of the mean torque to that of the largest consumer", "torque_mean", "greatest_mean"),
    ("rms_ratio", "k_rms", "Ratio of the root mean square torque to that of the largest consumer", "torque_rms", "greatest_rms"),
    ("peak_ratio", "k_peak", "Ratio of the peak torque to that of the largest consumer", "torque_peak", "greatest_peak"),
    ("fluctuation_ratio", "k_E", "Ratio of the range of the excess energy to that of the largest consumer", "energy_fluctuation",
     "greatest_fluctuation"),
):
    torques[name] = value(m[quantity] / m[by], exists=m[by] > 0), symbol, "1", words
torques.torque_curve_turns = m.sheets_per_period, "N_t", "1", "Revolutions of the main shaft spanned by the torque curve"
