"""Chapters on the bearings, their equivalent load over the cycle and their static load."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Chapter, bind, case
from diecut_report.plugins.rolling_bearing import ratings as f
from diecut_report.plugins.rolling_bearing.bearings import EXPONENTS, TAKEN, Bearings, bearings, shares
from diecut_report.plugins.rolling_bearing.figures import CHOICE, choice
from diecut_report.plugins.rolling_bearing.ratings import between

# fmt: off

Array = NDArray[Any]
NAMES = "bearings.name"
TABLE_3, STATIC = "ISO 281, table 3", "ISO 76"
SEARCH = "maximum over the cycle, by search; both limits at jumps are considered"


def row(chapter: Chapter, id: str, symbol: str, unit: str, description: str, function: Any, method: str, **options: Any) -> None:
    """Declare a row over the bearings that plain code gives."""
    chapter.computed(id, symbol, unit, description, function, ("all_bearings",), method, over="bearings", named_by=NAMES, **options)


def value(chapter: Chapter, id: str, symbol: str, unit: str, description: str, formula: Any, **options: Any) -> None:
    """Declare a closed formula, a row over the bearings."""
    chapter.value(id, symbol, unit, description, formula, named_by=NAMES, **options)


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
ratings.choice("reliability_factor", "a_1", "1", "Life modification factor for reliability",
    case(lambda: 1, "90 %", lambda reliability: reliability < 0.925), case(lambda: 0.64, "95 %", lambda reliability: reliability < 0.955),
    case(lambda: 0.55, "96 %", lambda reliability: reliability < 0.965), case(lambda: 0.47, "97 %", lambda reliability: reliability < 0.975),
    case(lambda: 0.37, "98 %", lambda reliability: reliability < 0.985), case(lambda: 0.25, "99 %"), source="ISO 281:2007, table 12")
ratings.prepared("all_bearings", bearings, TAKEN, for_many=True)
ratings.lookup("exponent", "p", "1", "Life exponent", EXPONENTS, by="bearings.type", source="ISO 281, 5.2", output=False, named_by=NAMES)
row(ratings, "holds", "s", "1", "Bearing selected from the table is found (1)", lambda known: known.row(lambda i: known.taken[i].holds),
    "life and static safety of each bearing of the series in turn; 1 where none is selected", output=False)
ratings.require("found", lambda holds: holds > 0, key="bearings.{index}.series",
    message="has no bearing in the table, up to 100 mm bore, that reaches the required life and static safety; take a heavier series, or give "
        "dynamic_rating and static_rating of a larger bearing")
ratings.computed("designations", "D", "1", "Selected bearings", lambda known: known.designations(), ("all_bearings",), "as given, or from the table",
    is_text=True)
row(ratings, "dynamic_rating", "C", "kN", "Basic dynamic load rating", lambda known: known.rating("dynamic"), "as given, or from the table")
row(ratings, "static_rating", "C_0", "kN", "Basic static load rating", lambda known: known.rating("static"), "as given, or from the table")
row(ratings, "bore", "d", "mm", "Bore, 0 where the designation does not tell it", lambda known: known.row(known.bore),
    "by the designation (ISO 15)", output=False)
row(ratings, "outside", "D_o", "mm", "Outside diameter, 0 where the designation does not tell it", lambda known: known.row(known.outside),
    "by the designation (ISO 15)", output=False)
value(ratings, "mean_diameter", "d_m", "mm", "Mean diameter", lambda bore, outside: (bore + outside) / 2, exists=lambda outside: outside > 0,
    source="ISO 15", output=False)
for column, key, symbol, words in (("C", "dynamic_rating", "C/C_t", "Basic dynamic load rating as a share of that in the table"),
                                   ("C0", "static_rating", "C_0/C_0t", "Basic static load rating as a share of that in the table")):
    row(ratings, f"{key}_share", symbol, "1", words, partial(shares, column),
        "1 where the table has no such bearing", output=False)
    ratings.require(f"{key}_of_table", bind(lambda share: (share >= 0.5) & (share <= 1.25), share=f"{key}_share"), key="bearings.{index}." + key,
        message=f"is {{{key}_share:up}} times that of the table for this designation, where makers differ by 0.5 to 1.25; correct it, or its unit, "
            "or the designation")
row(ratings, "axial_base", "f_0", "1", "Factor of the deep groove ball bearing, 0 where it is not required", lambda known: known.rating("f0"),
    "as given, or from the table", output=False)
ratings.part_table("ratings_table", "Ratings", "bearings", ("exponent", "dynamic_rating", "static_rating", "axial_base"))
ratings.listing("choice", "Bearings selected from the table, with their neighbours", CHOICE, choice, ("all_bearings",))

loads = Chapter("Equivalent load",
    text="The forces and their factors are shown for the position of the cycle where the equivalent load is largest; elsewhere it follows in the "
        "same way. The mean load P_m is the p-th root of the mean of P to the power p; each position is weighted by the relative motion of the "
        "rings: by |n|, or by |dθ/dφ| of a relative angle. Time is uniform over the cycle.")
loads.abscissa("cycle_angle", "φ", "deg", "Cycle angle: one revolution is one cycle of the loads", 2 * np.pi)
loads.computed_curve("load", "P_φ", "N", "Equivalent load over the cycle", load_over, "all_bearings", "cycle_angle",
    "from the forces at each position of the cycle", joints=lambda known: known.joints, named_by=NAMES, source="ISO 281, 5.3")
loads.computed_curve("speed", "n_φ", "rpm", "Relative speed of the rings over the cycle", speed_over, "all_bearings", "cycle_angle",
    "as given, or the derivative of the relative angle times the cycle rate", named_by=NAMES, source="kinematics")
row(loads, "axial_greatest", "F_a,max", "N", "Maximum axial force over the cycle", lambda known: known.row(lambda i: known.duties[i].greatest_axial),
    SEARCH, output=False)
row(loads, "factors_given", "x", "1", "Factors for axial force are known (1)", lambda known: known.flag(known.knows_factors), "from the given keys",
    output=False)
loads.require("factors_known", lambda factors_given, axial_greatest: (factors_given > 0) | (axial_greatest <= 0), key="bearings.{index}.axial_force",
    message="acts, but the factors by which it counts are missing; give f0 of a deep groove ball bearing, x, y, e, x0 and y0 of another one, all of "
        "the maker's catalogue (cylindrical rollers bear no axial force: let another bearing take it)")
row(loads, "radial_at_peak", "F_r", "N", "Radial force at the maximum equivalent load", forces("equivalent", 0), SEARCH, output=False)
row(loads, "axial_at_peak", "F_a", "N", "Axial force at the maximum equivalent load", forces("equivalent", 1), SEARCH, output=False)
value(loads, "relative_axial", "k", "1", "Relative axial force (deep groove)", bind(f.relative_axial, f0="axial_base", axial="axial_at_peak"),
    source=TABLE_3, output=False)
value(loads, "held_axial", "k_t", "1", "Relative axial force, limited to the range of the table", bind(f.held, relative="relative_axial"),
    source=TABLE_3, output=False)
loads.add(between)
row(loads, "by_table", "b", "1", "X, Y and e from the table (1) or given (0)", lambda known: known.flag(each.by_table for each in known.ratings),
    "of deep groove ball bearings", output=False)
row(loads, "radial_factor", "X", "1", "Radial factor", lambda known: known.rating("x"), "0.56 of a deep groove ball bearing, else as given",
    output=False)
row(loads, "given_y", "Y_1", "1", "Axial factor as given, 0 where none is", lambda known: known.rating("y"), "as given", output=False)
row(loads, "given_e", "e_1", "1", "Limit of F_a/F_r as given, 0 where none is", lambda known: known.rating("e"), "as given", output=False)
value(loads, "axial_factor", "Y", "1", "Axial factor", lambda by_table, table_y, given_y: np.where(by_table > 0, table_y, given_y), source=TABLE_3,
    output=False)
value(loads, "axial_limit", "e", "1", "Limit of F_a/F_r", lambda by_table, table_e, given_e: np.where(by_table > 0, table_e, given_e), source=TABLE_3,
    output=False)
value(loads, "equivalent_load_max", "P_max", "N", "Maximum equivalent load over the cycle",
    bind(f.equivalent_load, radial="radial_at_peak", axial="axial_at_peak", x="radial_factor", y="axial_factor", e="axial_limit"),
    source="ISO 281, 5.3")
row(loads, "turned", "G", "1", "Rings turn relative to each other (1) or stand (0)", lambda known: known.row(known.turns),
    "from the speed or the relative angle", output=False)
row(loads, "equivalent_load", "P_m", "N", "Mean equivalent load over the cycle by the life exponent", lambda known: known.row(known.mean_load),
    "Gauss–Legendre between the breakpoints, reversals and changes of X and Y", exists=lambda turned: turned > 0, source="linear damage")
row(loads, "arithmetic_load", "P_a", "N", "Arithmetic mean of the equivalent load with the same weights",
    lambda known: known.row(lambda i: known.mean_load(i, 1.0)), "as P_m, with the exponent 1", exists=lambda turned: turned > 0, output=False)
value(loads, "load_ratio", "C/P", "1", "Load ratio", lambda dynamic_rating, equivalent_load: dynamic_rating / equivalent_load,
    exists=lambda equivalent_load: equivalent_load > 0, source="ISO 281")
value(loads, "axial_overload", "k_max", "1", "Maximum relative axial force (deep groove)",
    bind(f.relative_axial, f0="axial_base", axial="axial_greatest"), exists=lambda axial_base, axial_greatest: axial_base * axial_greatest > 0,
    source=TABLE_3, output=False)

loads.part_table("load_table", "Loads of all bearings", "bearings", ("radial_at_peak", "axial_at_peak", "relative_axial", "axial_limit",
        "radial_factor", "axial_factor", "equivalent_load_max", "equivalent_load", "arithmetic_load", "load_ratio"))

static = Chapter("Static load")
row(static, "static_radial", "F_r0", "N", "Radial force at the maximum static load", forces("static_load", 0), SEARCH, output=False)
row(static, "static_axial", "F_a0", "N", "Axial force at the maximum equivalent load", forces("static_load", 1), SEARCH, output=False)
row(static, "static_radial_factor", "X_0", "1", "Static radial factor", lambda known: known.rating("x0"),
    "as given; 0.6 of a deep groove ball bearing, 1 where no axial force acts", output=False)
row(static, "static_axial_factor", "Y_0", "1", "Static axial factor", lambda known: known.rating("y0"),
    "as given; 0.5 of a deep groove ball bearing, 0 where no axial force acts", output=False)
value(static, "static_load", "P_0", "N", "Maximum static equivalent load over the cycle",
    bind(f.static_load, radial="static_radial", axial="static_axial", x0="static_radial_factor", y0="static_axial_factor"), source=STATIC)
static.require("loaded", lambda static_load: static_load > 0, key="bearings.{index}.radial_force",
    message="is 0 all over the cycle, and so is the axial force; give the force that the bearing bears, or leave the bearing out")
value(static, "static_safety", "s_0", "1", "Static safety factor", lambda static_rating, static_load: static_rating / static_load, source=STATIC)
static.part_table("static_table", "Static safety factors of all bearings", "bearings",
    ("static_radial", "static_axial", "static_radial_factor", "static_axial_factor", "static_load", "static_safety"))
