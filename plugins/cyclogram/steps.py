"""Chapters of the cyclogram."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, GivenMechanism, Phrase, Refusal, bind
from diecut_report.mechanics import common
from diecut_report.mechanics.timing.clearance import LeastClearance
from diecut_report.plugins.cyclogram import listings
from diecut_report.plugins.cyclogram.clearances import clearance_of
from diecut_report.plugins.cyclogram.passing import stretches
from diecut_report.plugins.cyclogram.timing import Timing, timing_of
from diecut_report.plugins.cyclogram.torques import motions_of, torques_of
from diecut_report.plugins.cyclogram.words import verdicts

# fmt: off

LINES = ("mechanism", "turns_per_sheet", "offset", "path_efficiency", "torque_curve", "passing")
INTERLOCKS = ("name", "phase", "within", "apart_from", "margin")
FRICTION = ("name", "torque", "power", "turns_per_sheet", "path_efficiency")
STATION = ("cylinder", "transport", "carriage_stop", "carriage_width", "forward_direction")
PHASES = "phases of the lines over the common period of the main shaft"
LARGEST_RATE_ERROR = 1e-6  # relative
TIMING, SUM = ("timing",), ("sum",)


def _found(timing: Timing) -> float:
    return 0.0 if timing.moved is None else float(timing.lines[timing.moved].line.offset)


shaft = Chapter("Main shaft", text="One turn of the main shaft is a sheet. All lines are where they were after the common period.")
shaft.prepared("stretches", stretches, ("lines.mechanism", "lines.passing"), for_many=True)
shaft.prepared("timing", timing_of, ("productivity", "stretches", *(f"lines.{key}" for key in LINES), *(f"interlocks.{key}" for key in INTERLOCKS)))
shaft.value("sheet_time", "T_s", "ms", "Time of a sheet, a turn of the main shaft", lambda productivity: 1 / productivity, source="kinematics")
shaft.value("main_shaft_speed", "ω_m", "rpm", "Speed of the main shaft", lambda productivity: 2 * np.pi * productivity, source="kinematics")
shaft.computed("sheets_per_period", "N_s", "1", "Sheets in the common period", lambda timing: float(timing.common), TIMING,
               "least common multiple of the periods of all phases", digits=6)
shaft.value("main_period", "P", "deg", "Common period of the main shaft", lambda sheets_per_period: 2 * np.pi * sheets_per_period)
shaft.value("period_time", "T_P", "ms", "Time of the common period", lambda sheets_per_period, sheet_time: sheets_per_period * sheet_time)
shaft.computed("line_turns", "i_k", "1", "Turns of each line for each sheet",
               lambda timing: np.array([[float(each.line.turns) for each in timing.lines]]), TIMING, "as given", over="lines", output=False)
shaft.computed("line_offset", "Φ_k", "deg", "Main-shaft angle of each line's zero",
               lambda timing: np.array([[each.line.offset for each in timing.lines]]), TIMING,
               "as given; an automatic one is where the least slack of all interlocks is greatest", over="lines", digits=6)
shaft.computed("is_moved", "k_a", "1", "Whether the offset of a line is to be found", lambda timing: timing.moved is not None, TIMING, "as given",
               output=False)
shaft.computed("offset_found", "Φ_f", "deg", "Offset that is found: main-shaft angle at which the zero of that line comes", _found, TIMING,
               "where the least slack of all interlocks is greatest", digits=6, exists=lambda is_moved: is_moved > 0)
shaft.listing("main_phases", "Phases on the main shaft", listings.PHASES, listings.phases, TIMING)
shaft.words("line_name", lambda timing: tuple(each.name for each in timing.lines), TIMING, each_part=True)


def _worst(name: str) -> Any:
    return lambda timing: timing.row(getattr(each, name) for each in timing.worst)


def _slack(timing: Timing) -> Any:
    return timing.row(pair.least - timing.required(each) for pair, each in zip(timing.worst, timing.final, strict=True))


interlocks = Chapter("Interlocks", text="A phase lies within another with the margins at its start and at its end; negative is the overlap by which "
                                        "it does not. Of several intervals the one with the least margin is told.")
for name, symbol, words, function in (
    ("margin_start", "m_1", "Margin at the start", _worst("start")),
    ("margin_end", "m_2", "Margin at the end", _worst("end")),
    ("margin_required", "m_r", "Margin that is required", lambda timing: timing.row(timing.required(each) for each in timing.final)),
    ("margin_least", "g", "Lesser of both margins", _worst("least")),
    ("slack", "g_s", "Excess of the smaller margin over the required one", _slack),
    ("held_length", "l_A", "Length of what must be held", _worst("inner_length")),
):
    interlocks.computed(name, symbol, "deg", words, function, TIMING, PHASES, over="interlocks")
for name, symbol, words, of in (("margin_start_time", "t_1", "Margin at the start, as a time", "margin_start"),
                                ("margin_end_time", "t_2", "Margin at the end, as a time", "margin_end")):
    interlocks.value(name, symbol, "ms", words, bind(lambda angle, main_shaft_speed: angle / main_shaft_speed, angle=of))
interlocks.value("length_demand", "l_d", "deg", "Length that is needed, margins included",
                 lambda held_length, margin_required: held_length + 2 * margin_required, output=False)
interlocks.value("length_available", "l_v", "deg", "Length that there is", lambda held_length, margin_least: held_length + 2 * margin_least,
                 output=False)
interlocks.total("best_margin", "g_min", "deg", "Least slack of all interlocks", "min", of="slack")
interlocks.value("best_margin_time", "t_g", "ms", "The same as a time", bind(common.quotient, quantity="best_margin", by="main_shaft_speed"))


def _limit(timing: Timing) -> float:
    return timing.limit.value or 0.0


interlocks.computed("is_limited", "k_n", "1", "Whether margins of time limit the productivity", lambda timing: timing.limit.value is not None,
                    TIMING, "a margin is a time, and holds at some speed", output=False)
interlocks.computed("productivity_limit", "n_max", "1/h",
                    "Largest productivity that the margins of time allow; nothing else is judged by it", _limit, TIMING,
                    "angles stay, times take more angle the faster the shaft turns; torques and accelerations are not judged", digits=5,
                    exists=lambda is_limited: is_limited > 0)
interlocks.computed("is_feasible", "k_Φ", "1", "Whether the solved offset keeps all margins",
                    lambda timing: bool(timing.best and timing.best.feasible), TIMING, PHASES, output=False)
interlocks.computed("offset_feasible_start", "Φ_a", "deg", "Least of the offsets about the one found that leave all margins",
                    lambda timing: timing.feasible[0], TIMING, PHASES, digits=6, exists=lambda is_feasible: is_feasible > 0)
interlocks.computed("offset_feasible_end", "Φ_b", "deg", "Greatest of the offsets about the one found that leave all margins",
                    lambda timing: timing.feasible[1], TIMING, PHASES, digits=6,
                    exists=lambda is_feasible: is_feasible > 0)
interlocks.computed("rate_error", "Δn", "1", "Own rate of each line off the press's, relative", lambda timing: np.array([timing.rate_errors]), TIMING,
                    "own turns a second over turns for each sheet, held against the productivity", over="lines", output=False)
interlocks.total("worst_rate_error", "Δn_max", "1", "Greatest of these rates", "max", of="rate_error", output=False)


interlocks.computed("is_window", "k_w", "1", "Whether one interval of each period holds it, so that a length can be told",
                    lambda timing: np.isfinite([timing.needed_lengths]), TIMING, PHASES, over="interlocks", output=False)
interlocks.computed("needed_length", "l_n", "deg", "Length that what holds it must have, for the interlock alone at its best offset",
                    lambda timing: np.nan_to_num([timing.needed_lengths]), TIMING, "length of the one interval less twice the greatest slack",
                    over="interlocks", exists=lambda is_window: is_window > 0)
interlocks.listing("margins", "Margins of each interval", listings.MARGINS, listings.margins, TIMING)
interlocks.listing("offsets", "Offsets that leave all margins", listings.OFFSETS, listings.offsets, TIMING)
interlocks.listing("lacking", "Not checked", listings.LACKING, listings.lacking, ("timing", "station.transport"))
interlocks.words("interlock_verdict", verdicts, TIMING, each_part=True)

station = Chapter("Clearance of the carriages", needs=("station",), absent="not calculated: station is not given",
                  text="The least height over all carriages, standing and moving, from the shape of the cylinder with its flat.")
station.prepared("clearance", clearance_of, ("timing", "main_period", *(f"lines.{key}" for key in LINES), *(f"station.{key}" for key in STATION)),
                 for_many=True)
station.prepared("least", lambda given: given["clearance"].least, ("clearance",), for_many=True)
CLEARANCE = "search over the common period, refined to 1e-13 of it"


def _is_below(least: LeastClearance) -> Any:
    return np.isfinite(least.height)[:, None]


def _least(least: LeastClearance) -> Any:
    return np.where(np.isfinite(least.height), least.height, 0.0)[:, None]


def _needed(cylinder: GivenMechanism) -> Any:
    height = cylinder.numbers("carriage_clearance")
    if height is None:
        words = "is {name}, which has no carriage_clearance to hold the room against; give it there"
        raise Refusal("station.cylinder", Phrase(words, name=cylinder.name))
    return height


station.computed("is_below", "k_Y", "1", "Whether a carriage is ever below the cylinder", _is_below, ("least",), "least height over the period",
                 output=False)
station.computed("clearance_least", "Y_min", "mm", "Least clearance height for the carriages", _least, ("least",), CLEARANCE,
                 exists=lambda is_below: is_below > 0)
station.computed("clearance_angle", "Φ_Y", "deg", "Main-shaft angle at which that is", lambda least: least.angle[:, None], ("least",), CLEARANCE,
                 exists=lambda is_below: is_below > 0)
station.computed("carriage_clearance", "c_r", "mm", "Clearance that the carriages need",
                 _needed, ("station.cylinder",), "as given to the cylinder's drive")

interlocks.fact("rates_agree", bind(common.is_at_most, smaller="worst_rate_error", greater=LARGEST_RATE_ERROR),
                "not calculated: a line runs at another rate than the press, so that nothing can be added up over the main shaft")

motions = Chapter("Motions over the main shaft", needs=("rates_agree",))
motions.prepared("motions", motions_of, ("timing", "main_period", *(f"lines.{key}" for key in LINES)), for_many=True)
motions.abscissa("main_angle", "Φ", "deg", "Angle of the main shaft", "main_period", speed="main_shaft_speed", intervals=16)
OWN = "from the line's own calculation"
motions.part_curves("way", "s", "mm", "Displacement of the line", lambda motions: motions.ways.names,
                    lambda motions, *asked: motions.ways.one(*asked), "motions", "main_angle", OWN, joints=lambda motions: motions.joints)
motions.computed("moving_lines", "N_E", "1", "Lines whose kinetic energy is known", lambda motions: float(len(motions.energies.names)), ("motions",),
                 "as given", output=False)
motions.fact("energy_known", lambda moving_lines: moving_lines > 0, "not calculated: of no line is it known what moves, and how heavy it is")
motions.computed_curve("clearance_over", "Y", "mm", "Least height over all carriages; the cylinder's radius where none is below it",
                       lambda clearance, *asked: clearance.over(*asked), "clearance", "main_angle", "shape of the cylinder with its flat",
                       needs=("station",))

energies = Chapter("Kinetic energies", needs=("rates_agree", "energy_known"))
energies.part_curves("kinetic_energy", "E", "J", "Kinetic energy of the line", lambda motions: motions.energies.names,
                    lambda motions, *asked: motions.energies.one(*asked), "motions", "main_angle", OWN, joints=lambda motions: motions.joints)
energies.computed_curve("kinetic_energy_total", "E_Σ", "J", "Kinetic energy of all lines of which it is known",
                       lambda motions, *asked: motions.energies.total(*asked), "motions", "main_angle",
                        "sum of the lines' kinetic energies", joints=lambda motions: motions.joints)
energies.reduction("kinetic_energy_max", "E_max", "J", "Greatest kinetic energy of all lines together", "max", of="kinetic_energy_total")
energies.reduction("kinetic_energy_mean", "E_m", "J", "The same in the mean", "mean", of="kinetic_energy_total")
energies.reduction("kinetic_energy_range", "ΔE_k", "J", "Range of it", "range", of="kinetic_energy_total", output=False)
energies.computed("kinetic_energy_ranges", "ΣΔE_k", "J", "Ranges of the kinetic energies of the lines, added up", lambda motions: motions.ranges,
                 ("motions",), "searched over a turn of each line", output=False)
energies.value("energy_exchange", "E_e", "J", "Energy exchanged between drives",
              lambda kinetic_energy_ranges, kinetic_energy_range: np.maximum(kinetic_energy_ranges - kinetic_energy_range, 0))

torques = Chapter("Sum of the torques at the main shaft", needs=("rates_agree", "takes_torque"),
                  text="A line's torque is i·M/η at the main shaft where the shaft drives, i·M·η where the line drives back.")
motions.prepared("sum", torques_of, ("timing", "main_period", "main_shaft_speed", *(f"lines.{key}" for key in LINES),
                                     *(f"friction.{key}" for key in FRICTION)), for_many=True)
motions.words("torque_missing", lambda sum: ", ".join(sum.without) or "none", SUM)
motions.computed("consumers", "N_c", "1", "Consumers whose torque is known", lambda sum: float(len(sum.consumers)), SUM, "as given", output=False)
motions.fact("takes_torque", lambda consumers: consumers > 0, "not calculated: no line has a torque that is known, and no friction is given")
torques.part_curves("line_torque", "M", "N*m", "Torque of the line at the main shaft", lambda sum: sum.together.names,
                    lambda sum, *asked: sum.together.one(*asked), "sum", "main_angle", OWN, joints=lambda sum: sum.joints)
torques.computed_curve("main_shaft_torque", "M_Σ", "N*m", "Torque at the main shaft",
                       lambda sum, *asked: sum.together.total(*asked), "sum", "main_angle",
                       "sum of the torques of all lines, each from its own calculation", joints=lambda sum: sum.joints)
torques.computed_curve("greatest_torque", "M_g", "N*m", "Torque of the greatest consumer alone", lambda sum, *asked: sum.of_greatest(*asked), "sum",
                       "main_angle", "the consumer that takes most from the main shaft, in the mean")
torques.reduction("torque_peak", "M_peak", "N*m", "Greatest size of the torque", "abs_max", of="main_shaft_torque")
torques.reduction("torque_max", "M_max", "N*m", "Greatest driving torque", "max", of="main_shaft_torque")
torques.reduction("torque_min", "M_min", "N*m", "Greatest braking torque", "min", of="main_shaft_torque")
torques.reduction("torque_mean", "M_mean", "N*m", "Mean torque", "mean", of="main_shaft_torque")
torques.reduction("torque_rms", "M_rms", "N*m", "Root mean square torque", "rms", of="main_shaft_torque")
for name, symbol, unit, words, figure in (
    ("greatest_mean", "M_g,mean", "N*m", "Mean torque of the greatest consumer alone", "mean"),
    ("greatest_rms", "M_g,rms", "N*m", "Root mean square torque of the greatest consumer alone", "rms"),
    ("greatest_max", "M_g,max", "N*m", "Its greatest driving torque", "largest"),
    ("greatest_min", "M_g,min", "N*m", "Its greatest braking torque", "least"),
    ("greatest_fluctuation", "ΔE_g", "J", "Range of its excess energy", "fluctuation"),
):
    torques.computed(name, symbol, unit, words, lambda sum, figure=figure: sum.figure_of_greatest(figure), SUM,
                     "Gauss–Legendre between the breakpoints; extremes within each smooth piece")
torques.value("greatest_peak", "M_g,peak", "N*m", "Greatest size of the torque of the greatest consumer alone",
              lambda greatest_max, greatest_min: np.maximum(greatest_max, -greatest_min))
torques.value("power_mean", "P_mean", "kW", "Mean power at the main shaft", lambda torque_mean, main_shaft_speed: torque_mean * main_shaft_speed)
torques.value("power_peak", "P_peak", "kW", "Peak power at the main shaft", lambda torque_peak, main_shaft_speed: torque_peak * main_shaft_speed)
torques.value("greatest_power_mean", "P_g,mean", "kW", "Mean power of the greatest consumer alone",
              lambda greatest_mean, main_shaft_speed: greatest_mean * main_shaft_speed)
torques.value("greatest_power_peak", "P_g,peak", "kW", "Peak power of the greatest consumer alone",
              lambda greatest_peak, main_shaft_speed: greatest_peak * main_shaft_speed)
torques.value("torque_excess", "ΔM", "N*m", "Torque above its mean", lambda main_shaft_torque, torque_mean: main_shaft_torque - torque_mean,
              output=False)
torques.accumulated("excess_energy", "E_x", "J", "Energy taken above the mean, from the start of the period", of="torque_excess")
torques.reduction("energy_fluctuation", "ΔE", "J", "Range of the excess energy over the common period", "range", of="excess_energy")
for name, symbol, words, quantity, by in (
    ("mean_ratio", "k_mean", "Mean of the sum to that of the greatest consumer", "torque_mean", "greatest_mean"),
    ("rms_ratio", "k_rms", "Root mean square of the sum to that of the greatest consumer", "torque_rms", "greatest_rms"),
    ("peak_ratio", "k_peak", "Peak of the sum to that of the greatest consumer", "torque_peak", "greatest_peak"),
    ("fluctuation_ratio", "k_E", "Range of the excess energy to that of the greatest consumer", "energy_fluctuation", "greatest_fluctuation"),
):
    torques.value(name, symbol, "1", words, bind(common.quotient, quantity=quantity, by=by), exists=bind(common.is_positive, quantity=by))
torques.value("torque_curve_turns", "N_t", "1", "Turns of the main shaft that the curve of the torque spans",
              lambda sheets_per_period: sheets_per_period)
