"""Chapters on the bearings, their equivalent load over the cycle and their static load."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Chapter, Recipe, abscissa, case, choice, computed, computed_curve, lookup, m, value
from diecut_report.plugins.rolling_bearing import ratings as f
from diecut_report.plugins.rolling_bearing.bearings import EXPONENTS, TAKEN, Bearings, bearings, shares
from diecut_report.plugins.rolling_bearing.figures import CHOICE, neighbours
from diecut_report.plugins.rolling_bearing.ratings import between

# fmt: off

Array = NDArray[Any]
NAMES = "bearings.name"
TABLE_3, STATIC = "ISO 281, table 3", "ISO 76"
SEARCH = "maximum over the cycle, by search; both limits at jumps are considered"


def row(function: Any, method: str, **options: Any) -> Recipe:
    """Say how plain code gives a row over the bearings."""
    return computed(function, ("all_bearings",), method, over="bearings", named_by=NAMES, **options)


def each(formula: Any, **options: Any) -> Recipe:
    """Say how a formula gives a row over the bearings."""
    return value(formula, named_by=NAMES, **options)


def forces(load: str, part: int) -> Any:
    """Return one of both forces where a load of a bearing is greatest."""
    return lambda known: known.row(lambda i: known.peak(i, load)[part])


def load_over(index: int, known: Bearings, angle: Array, middle: Array, rows: Array | None) -> Array:
    """Return the equivalent load of a bearing at cycle angles."""
    return known.load(index, angle / (2 * np.pi), middle / (2 * np.pi), rows)


def speed_over(index: int, known: Bearings, angle: Array, middle: Array, rows: Array | None) -> Array:
    """Return the speed of the rings of a bearing at cycle angles."""
    return known.speed(index, angle / (2 * np.pi), middle / (2 * np.pi), rows)


ratings = Chapter("Bearings",
    text="If neither ratings nor a designation are given, the smallest bearing of the series that reaches the required life and static safety is "
        "selected.")
ratings.reliability_factor = (choice(case(1, "90 %", m.reliability < 0.925), case(0.64, "95 %", m.reliability < 0.955),
    case(0.55, "96 %", m.reliability < 0.965), case(0.47, "97 %", m.reliability < 0.975), case(0.37, "98 %", m.reliability < 0.985),
    case(0.25, "99 %")), "a_1", "1", "Life modification factor for reliability", "ISO 281:2007, table 12")
ratings.prepared("all_bearings", bearings, TAKEN, for_many=True)
ratings.exponent = lookup(EXPONENTS, by="bearings.type", output=False, named_by=NAMES), "p", "1", "Life exponent", "ISO 281, 5.2"
ratings.holds = (row(lambda known: known.row(lambda i: known.taken[i].holds),
    "life and static safety of each bearing of the series in turn; 1 where none is selected", output=False), "s", "1",
    "Bearing selected from the table is found (1)")
ratings.require("found", m.holds > 0, key="bearings.{index}.series",
    message="has no bearing in the table, up to 100 mm bore, that reaches the required life and static safety; take a heavier series, or give "
    "dynamic_rating and static_rating of a larger bearing")
ratings.designations = (computed(lambda known: known.designations(), ("all_bearings",), "as given, or from the table", is_text=True), "D", "1",
    "Selected bearings")
ratings.dynamic_rating = row(lambda known: known.rating("dynamic"), "as given, or from the table"), "C", "kN", "Basic dynamic load rating"
ratings.static_rating = row(lambda known: known.rating("static"), "as given, or from the table"), "C_0", "kN", "Basic static load rating"
ratings.bore = (row(lambda known: known.row(known.bore), "by the designation (ISO 15)", output=False), "d", "mm",
    "Bore, 0 where the designation does not tell it")
ratings.outside = (row(lambda known: known.row(known.outside), "by the designation (ISO 15)", output=False), "D_o", "mm",
    "Outside diameter, 0 where the designation does not tell it")
ratings.mean_diameter = each((m.bore + m.outside) / 2, exists=m.outside > 0, output=False), "d_m", "mm", "Mean diameter", "ISO 15"
for column, key, symbol, words in (("C", "dynamic_rating", "C/C_t", "Basic dynamic load rating as a share of that in the table"),
                                   ("C0", "static_rating", "C_0/C_0t", "Basic static load rating as a share of that in the table")):
    ratings[f"{key}_share"] = row(partial(shares, column), "1 where the table has no such bearing", output=False), symbol, "1", words
    ratings.require(f"{key}_of_table", (m[f"{key}_share"] >= 0.5) & (m[f"{key}_share"] <= 1.25), key="bearings.{index}." + key,
        message=f"is {{{key}_share:up}} times that of the table for this designation, where makers differ by 0.5 to 1.25; correct it, or its unit, "
        "or the designation")
ratings.axial_base = (row(lambda known: known.rating("f0"), "as given, or from the table", output=False), "f_0", "1",
    "Factor of the deep groove ball bearing, 0 where it is not required")
ratings.part_table("ratings_table", "Ratings", "bearings", ("exponent", "dynamic_rating", "static_rating", "axial_base"))
ratings.listing("choice", "Bearings selected from the table, with their neighbours", CHOICE, neighbours, ("all_bearings",))

loads = Chapter("Equivalent load",
    text="The forces and their factors are shown for the position of the cycle where the equivalent load is largest; elsewhere it follows in the "
        "same way. The mean load P_m is the p-th root of the mean of P to the power p; each position is weighted by the relative motion of the "
        "rings: by |n|, or by |dθ/dφ| of a relative angle. Time is uniform over the cycle.")
loads.cycle_angle = abscissa(2 * np.pi), "φ", "deg", "Cycle angle: one revolution is one cycle of the loads"
loads.load = (computed_curve(load_over, "all_bearings", "cycle_angle", "from the forces at each position of the cycle",
    joints=lambda known: known.joints, named_by=NAMES), "P_φ", "N", "Equivalent load over the cycle", "ISO 281, 5.3")
loads.speed = (computed_curve(speed_over, "all_bearings", "cycle_angle", "as given, or the derivative of the relative angle times the cycle rate",
    named_by=NAMES), "n_φ", "rpm", "Relative speed of the rings over the cycle", "kinematics")
loads.axial_greatest = (row(lambda known: known.row(lambda i: known.duties[i].greatest_axial), SEARCH, output=False), "F_a,max", "N",
    "Maximum axial force over the cycle")
loads.factors_given = (row(lambda known: known.flag(known.knows_factors), "from the given keys", output=False), "x", "1",
    "Factors for axial force are known (1)")
loads.require("factors_known", (m.factors_given > 0) | (m.axial_greatest <= 0), key="bearings.{index}.axial_force",
    message="acts, but the factors by which it counts are missing; give f0 of a deep groove ball bearing, x, y, e, x0 and y0 of another one, all of "
    "the maker's catalogue (cylindrical rollers bear no axial force: let another bearing take it)")
loads.radial_at_peak = row(forces("equivalent", 0), SEARCH, output=False), "F_r", "N", "Radial force at the maximum equivalent load"
loads.axial_at_peak = row(forces("equivalent", 1), SEARCH, output=False), "F_a", "N", "Axial force at the maximum equivalent load"
loads.relative_axial = (each(f.relative_axial.of(f0=m.axial_base, axial=m.axial_at_peak), output=False), "k", "1",
    "Relative axial force (deep groove)", TABLE_3)
loads.held_axial = (each(f.held.of(relative=m.relative_axial), output=False), "k_t", "1", "Relative axial force, limited to the range of the table",
    TABLE_3)
loads.add(between)
loads.by_table = (row(lambda known: known.flag(each.by_table for each in known.ratings), "of deep groove ball bearings", output=False), "b", "1",
    "X, Y and e from the table (1) or given (0)")
loads.radial_factor = (row(lambda known: known.rating("x"), "0.56 of a deep groove ball bearing, else as given", output=False), "X", "1",
    "Radial factor")
loads.given_y = row(lambda known: known.rating("y"), "as given", output=False), "Y_1", "1", "Axial factor as given, 0 where none is"
loads.given_e = row(lambda known: known.rating("e"), "as given", output=False), "e_1", "1", "Limit of F_a/F_r as given, 0 where none is"
loads.axial_factor = each(np.where(m.by_table > 0, m.table_y, m.given_y), output=False), "Y", "1", "Axial factor", TABLE_3
loads.axial_limit = each(np.where(m.by_table > 0, m.table_e, m.given_e), output=False), "e", "1", "Limit of F_a/F_r", TABLE_3
loads.equivalent_load_max = (each(f.equivalent_load.of(radial=m.radial_at_peak, axial=m.axial_at_peak, x=m.radial_factor, y=m.axial_factor,
    e=m.axial_limit)), "P_max", "N", "Maximum equivalent load over the cycle", "ISO 281, 5.3")
loads.turned = (row(lambda known: known.row(known.turns), "from the speed or the relative angle", output=False), "G", "1",
    "Rings turn relative to each other (1) or stand (0)")
loads.equivalent_load = (row(lambda known: known.row(known.mean_load), "Gauss–Legendre between the breakpoints, reversals and changes of X and Y",
    exists=m.turned > 0), "P_m", "N", "Mean equivalent load over the cycle by the life exponent", "linear damage")
loads.arithmetic_load = (row(lambda known: known.row(lambda i: known.mean_load(i, 1.0)), "as P_m, with the exponent 1", exists=m.turned > 0,
    output=False), "P_a", "N", "Arithmetic mean of the equivalent load with the same weights")
loads.load_ratio = each(m.dynamic_rating / m.equivalent_load, exists=m.equivalent_load > 0), "C/P", "1", "Load ratio", "ISO 281"
loads.axial_overload = (each(f.relative_axial.of(f0=m.axial_base, axial=m.axial_greatest), exists=m.axial_base * m.axial_greatest > 0, output=False),
    "k_max", "1", "Maximum relative axial force (deep groove)", TABLE_3)

loads.part_table("load_table", "Loads of all bearings", "bearings", ("radial_at_peak", "axial_at_peak", "relative_axial", "axial_limit",
        "radial_factor", "axial_factor", "equivalent_load_max", "equivalent_load", "arithmetic_load", "load_ratio"))

static = Chapter("Static load")
static.static_radial = row(forces("static_load", 0), SEARCH, output=False), "F_r0", "N", "Radial force at the maximum static load"
static.static_axial = row(forces("static_load", 1), SEARCH, output=False), "F_a0", "N", "Axial force at the maximum equivalent load"
static.static_radial_factor = (row(lambda known: known.rating("x0"), "as given; 0.6 of a deep groove ball bearing, 1 where no axial force acts",
    output=False), "X_0", "1", "Static radial factor")
static.static_axial_factor = (row(lambda known: known.rating("y0"), "as given; 0.5 of a deep groove ball bearing, 0 where no axial force acts",
    output=False), "Y_0", "1", "Static axial factor")
static.static_load = (each(f.static_load.of(radial=m.static_radial, axial=m.static_axial, x0=m.static_radial_factor, y0=m.static_axial_factor)),
    "P_0", "N", "Maximum static equivalent load over the cycle", STATIC)
static.require("loaded", m.static_load > 0, key="bearings.{index}.radial_force",
    message="is 0 all over the cycle, and so is the axial force; give the force that the bearing bears, or leave the bearing out")
static.static_safety = each(m.static_rating / m.static_load), "s_0", "1", "Static safety factor", STATIC
static.part_table("static_table", "Static safety factors of all bearings", "bearings",
    ("static_radial", "static_axial", "static_radial_factor", "static_axial_factor", "static_load", "static_safety"))
