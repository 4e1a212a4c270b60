"""The chapters on sections, places and notches."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, case, choice, computed, inner, lookup, m, number, total, value
from diecut_report.mechanics.sections import tube
from diecut_report.plugins.shaft import formulas
from diecut_report.plugins.shaft.body import PRESS_FIT, body

# fmt: off

BODY = ("sections.length", "section_diameter", "sections.bore", "sections.fillet_radius", "notches.position", "notches.type",
        "notches.radius", "notches.k_t", "notches.k_ts", "notches.k_f", "notches.k_fs", "loads.name", "loads.position", "loads.seat",
        "bearing_a", "bearing_b", "seat_a", "seat_b")
BEARINGS = 2
GIVEN = "as given, or from the type of notch"

sections = Chapter("Sections", text="x is measured from the shaft's left end; y and z are transverse, rotation and torque are positive from y to z.")
sections.prepared("body", lambda given: body(*map(given.get, BODY)), BODY, for_many=True)
sections.length = total("sum", of="sections.length"), "L", "mm", "Length of the shaft", "geometry"
sections.require("sections_add_up", abs(m.length - m.total_length) <= 1e-6 * m.total_length, key="sections", needs=("total_length",),
    message="add up to {length}, but total_length is {total_length}; correct the length of a section, or total_length")
sections.require("bores_inside", m.sections.bore < m.section_diameter, key="sections.{index}.bore",
    message="is not smaller than the diameter of section {part}; take a smaller bore")
sections.require("bearings_apart", m.bearing_a < m.bearing_b, key="bearing_b",
    message="is {bearing_b}, not beyond bearing_a at {bearing_a}; bearing A is the left one, so exchange or move them")
sections.require("bearings_on_shaft", m.bearing_b <= m.length * (number(1) + 1e-9), key="bearing_b",
    message="is {bearing_b}, but the sections are {length} long in all: the bearing would stand beside the shaft; set bearing_b to at most "
    "{length:down}, or lengthen the sections")
sections.require("loads_on_shaft", m.loads.position <= m.length * (number(1) + 1e-9), key="loads.{index}.position",
    message="is beyond the shaft, whose sections are {length} long in all; move the load to at most {length:down} (a force beyond the end, as on a "
    "crank pin, has its offset), or lengthen the sections")
sections.require("notches_on_shaft", m.notches.position <= m.length * (number(1) + 1e-9), key="notches.{index}.position", needs=("notches",),
    message="is beyond the shaft, whose sections are {length} long in all; move the notch to at most {length:down}")
sections.section_mass = (inner(m.density * tube(m.section_diameter, m.sections.bore).area * m.sections.length), "m_k", "kg",
    "Mass of the section", "geometry")
sections.shaft_mass = total("sum", of="section_mass"), "m", "kg", "Mass of the shaft without mounted parts", "geometry"

places = Chapter("Locations",
    text="Stresses are checked at the shoulders, notches, bearings and loads; at a step on the smaller diameter. Formulas are shown for the "
        "location of the minimum safety factor against fatigue; all locations are listed in the table of the chapter on fatigue.")
places.part_names("places", "Checked locations", lambda body: list(body.names), ("body",), shown_at="governing_place",
    count=lambda length: length("sections") - 1 + length("notches") + BEARINGS + length("loads"))


def _row(id: str, symbol: str, unit: str, description: str, function, method: str = GIVEN) -> None:  # type: ignore[no-untyped-def]
    """A row of what the body has at its places."""
    places[id] = computed(lambda body: function(body).T, ("body",), method, over="places", output=False), symbol, unit, description


_row("place_x", "x", "mm", "Position from the left end", lambda body: body.x, "sections, notches, bearings and loads as they are given")
_row("place_diameter", "d_p", "mm", "Diameter; at a step the smaller one", lambda body: body.at_places(body.diameter))
_row("place_bore", "d_ip", "mm", "Bore at this location", lambda body: body.at_places(body.bore))
_row("place_greater", "D", "mm", "Diameter; at a step the larger one", lambda body: body.greater)
_row("place_radius", "r_p", "mm", "Radius of the notch, 0 without one", lambda body: body.radius)
_row("is_fillet", "s_r", "1", "Step with fillet (1) or without (0)", lambda body: body.is_fillet * 1.0)
_row("is_press_fit", "s_p", "1", "Press fit or tight seat (1) or not (0)", lambda body: body.is_kind(PRESS_FIT) * np.ones_like(body.x))
_row("keyseats", "s_k", "1", "Factor of keyseats: 1 for one, 1.15 for two, 0 for none", lambda body: body.keyseats)
_row("type_k_t", "K_t0", "1", "Stress concentration factor in bending of the type", lambda body: body.k_t)
_row("type_k_ts", "K_ts0", "1", "Stress concentration factor in torsion of the type", lambda body: body.k_ts)
_row("given_k_f", "K_f0", "1", "Fatigue notch factor in bending where it is given, else 0", lambda body: body.k_f)
_row("given_k_fs", "K_fs0", "1", "Fatigue notch factor in torsion where it is given, else 0", lambda body: body.k_fs)
places.place_step = inner((m.place_greater - m.place_diameter) / 2), "t", "mm", "Height of the step", "geometry"
places.require("fillets_fit", np.where(m.is_fillet > 0, m.place_radius, 0) <= m.place_step * (number(1) + 1e-9),
    key="sections.{index}.fillet_radius",
    message="is greater than the height of the step at the section's right end, so that it does not fit; take a smaller radius")
places.place_area = inner(tube(m.place_diameter, m.place_bore).area), "A", "mm**2", "Area of the section", "Shigley 3-11"
places.place_modulus = (inner(tube(m.place_diameter, m.place_bore).modulus), "W_b", "mm**3",
    "Section modulus in bending; in torsion twice this value", "Shigley 3-24")

notches = Chapter("Notches")
notches.neuber_bending = formulas.neuber_bending, "a_N", "mm", "Neuber's length in bending", "Shigley 6-35a"
notches.neuber_torsion = formulas.neuber_torsion, "a_Ns", "mm", "Neuber's length in torsion", "Shigley 6-35b"
BY_STRENGTH = (("press_fit", "K_fp", "of a press fit", formulas.press_fit_factor, lambda press_fit_factor: 0.65 * press_fit_factor),
               ("keyseat", "K_fk", "of a keyseat", formulas.keyseat_factor, lambda keyseat_factor: 0.56 * keyseat_factor + 0.1))
for kind, symbol, told, in_bending, in_torsion in BY_STRENGTH:
    notches[f"{kind}_factor"] = inner(in_bending), symbol, "1", f"Fatigue notch factor {told} in bending, of 40 mm", "DIN 743-2, table 1"
    notches[f"{kind}_torsion"] = inner(in_torsion), f"{symbol}s", "1", f"Fatigue notch factor {told} in torsion, of 40 mm", "DIN 743-2, table 1"
    for end, load in (("factor", "bending"), ("torsion", "torsion")):
        notches[f"sized_{kind}_{end}"] = (inner(m[f"{kind}_{end}"] * formulas.size_of_notch(m[f"{kind}_{end}"],
            formulas.SIZE_OF_TABLE) / formulas.size_of_notch(m[f"{kind}_{end}"], m.place_diameter)), f"{symbol}{'s' if load == 'torsion' else ''}d",
            "1", f"Fatigue notch factor {told} in {load}", "DIN 743-2")
AT_FILLETS: dict[str, Any] = {"exists": lambda is_fillet: is_fillet > 0, "output": False}
notches.fillet_ratio = value(m.place_step / m.place_radius, **AT_FILLETS), "t/r", "1", "Ratio of step to fillet radius", "Peterson"
notches.fillet_root = value(np.sqrt(m.fillet_ratio), **AT_FILLETS), "w", "1", "Its square root", "Peterson"
notches.fillet_share = value(2 * m.place_step / m.place_greater, **AT_FILLETS), "z", "1", "Ratio of both steps to the larger diameter", "Peterson"
for index, (low, high) in enumerate(formulas.BENDING, 1):
    notches[f"bending_{index}"] = (value(np.where(m.fillet_ratio <= 2, formulas.quadratic(*low, m.fillet_root),
        formulas.quadratic(*high, m.fillet_root)), **AT_FILLETS), f"C_{index}", "1", f"Coefficient {index} of the chart for bending",
        "Peterson, chart 3.10")
for index, terms in enumerate(formulas.TORSION, 1):
    notches[f"torsion_{index}"] = (value(formulas.quadratic(*terms, m.fillet_root), **AT_FILLETS), f"C_s{index}", "1",
        f"Coefficient {index} of the chart for torsion", "Peterson, chart 3.12")
for name, symbol, told, chart, chart_name in (("k_t", "K_t", "bending", "bending", "3.10"), ("k_ts", "K_ts", "torsion", "torsion", "3.12")):
    notches[f"charted_{name}"] = (value(np.maximum(m[f"{chart}_1"] + m[f"{chart}_2"] * m.fillet_share + m[f"{chart}_3"] * m.fillet_share**2
        + m[f"{chart}_4"] * m.fillet_share**3, 1), **AT_FILLETS), f"{symbol}c", "1", f"Stress concentration factor of the fillet in {told}",
        f"Peterson, chart {chart_name}")
    notches[name] = (computed(lambda is_fillet, of_chart, of_type: np.where(is_fillet > 0, of_chart, of_type),
        ("is_fillet", f"charted_{name}", f"type_{name}"), "from the chart for a fillet, otherwise from the type of notch", over="places",
        output=False), symbol, "1", f"Stress concentration factor in {told}")
notches.sensitivity = (inner(formulas.notch_sensitivity.of(radius=m.place_radius, neuber=m.neuber_bending)), "q", "1",
    "Notch sensitivity in bending", "Shigley 6-34")
notches.sensitivity_torsion = (inner(formulas.notch_sensitivity.of(radius=m.place_radius, neuber=m.neuber_torsion)), "q_s", "1",
    "Notch sensitivity in torsion", "Shigley 6-34")
for suffix, sign, end, told in (("", "f", "factor", "bending"), ("s", "fs", "torsion", "torsion")):
    notches[f"own_k_{sign}"] = (inner(np.where(m.is_press_fit > 0, m[f"sized_press_fit_{end}"],
        np.where(m.keyseats > 0, m.keyseats * m[f"sized_keyseat_{end}"], np.where(m[f"given_k_{sign}"] > 0, m[f"given_k_{sign}"],
        formulas.fatigue_factor(m["sensitivity_torsion" if suffix else "sensitivity"], m[f"k_t{suffix}"]))))), f"K_{sign}1", "1",
        f"Fatigue notch factor in {told} of the notch itself", "Shigley 6-32; DIN 743-2")
    notches[f"k_{sign}"] = (computed(lambda body, row: body.greatest_here(row), ("body", f"own_k_{sign}"),
        "the maximum of the notches at one location, not their product", over="places", output=False), f"K_{sign}", "1",
        f"Fatigue notch factor in {told}")
notches.bore_ratio = (inner(m.place_bore / m.place_diameter, exists=(m.is_fillet > 0) & (m.place_bore > 0)), "d_i/d", "1",
    "Ratio of bore to diameter at a fillet of a hollow shaft", "Peterson")

endurance = Chapter("Endurance limit")
endurance.require("yield_below", m.yield_strength <= m.tensile_strength, key="yield_strength",
    message="is {yield_strength}, above the tensile strength of {tensile_strength}; no steel yields above what it bears")
SPECIMEN = ("S_e′", "MPa", "Endurance limit of the polished specimen")
endurance.specimen_endurance = (value(formulas.endurance_of_specimen, lacks=("fatigue_strength", "strengths.fatigue_strength")), *SPECIMEN,
    "Shigley 6-8")
endurance.specimen_endurance = value(m.fatigue_strength, needs=("fatigue_strength",)), *SPECIMEN, "input"
endurance.specimen_endurance = value(m.own_fatigue_strength, needs=("strengths.fatigue_strength",), lacks=("fatigue_strength",)), *SPECIMEN, "input"
endurance.require("endurance_below", m.specimen_endurance < m.tensile_strength, key="fatigue_strength",
    message="is {specimen_endurance}, not below the tensile strength of {tensile_strength}; no steel bears so much for ever")
endurance.surface_a = (lookup({"ground": 1.58, "machined": 4.51, "hot_rolled": 57.7, "forged": 272}, by="surface", output=False), "a", "1",
    "Factor a of the surface finish", "Shigley table 6-2")
endurance.surface_b = (lookup({"ground": -0.085, "machined": -0.265, "hot_rolled": -0.718, "forged": -0.995}, by="surface", output=False), "b", "1",
    "Exponent b of the surface finish", "Shigley table 6-2")
endurance.surface_factor = formulas.surface_factor, "k_a", "1", "Surface factor", "Shigley 6-19"
endurance.reliability_factor = (choice(case(1, "half of all shafts", m.reliability < 0.7), case(0.897, "90 %", m.reliability < 0.92),
    case(0.868, "95 %", m.reliability < 0.97), case(0.814, "99 %", m.reliability < 0.995), case(0.753, "99.9 %", m.reliability < 0.9995),
    case(0.702, "99.99 %")), "k_e", "1", "Reliability factor", "Shigley table 6-5")
endurance.size_share = (computed(lambda rotation, length: np.full_like(length, 0.37 if isinstance(rotation,
    np.ndarray) or rotation == "none" else 1.0), ("rotation", "length"),
    "1 for a shaft that rotates or oscillates, 0.37 for one that stands (Shigley 6-24)", output=False), "d_e/d", "1",
    "Ratio of effective diameter to diameter")
endurance.size_factor = inner(formulas.size_factor.of(diameter=m.place_diameter)), "k_b", "1", "Size factor", "Shigley 6-20"
endurance.place_endurance = (inner(m.surface_factor * m.size_factor * m.reliability_factor * m.specimen_endurance), "S_e", "MPa",
    "Endurance limit at this location", "Shigley 6-18")
