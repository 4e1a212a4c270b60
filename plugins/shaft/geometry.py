"""The chapters on sections, places and notches."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, bind, case, number
from diecut_report.mechanics import beams
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
sections.total("length", "L", "mm", "Length of the shaft", "sum", of="sections.length", source="geometry")
sections.require("sections_add_up", lambda length, total_length: abs(length - total_length) <= 1e-6 * total_length, key="sections",
    needs=("total_length",), message="add up to {length}, but total_length is {total_length}; correct the length of a section, or total_length")
sections.require("bores_inside", bind(lambda bore, diameter: bore < diameter, bore="sections.bore", diameter="section_diameter"),
    key="sections.{index}.bore", message="is not smaller than the diameter of section {part}; take a smaller bore")
sections.require("bearings_apart", lambda bearing_a, bearing_b: bearing_a < bearing_b, key="bearing_b",
    message="is {bearing_b}, not beyond bearing_a at {bearing_a}; bearing A is the left one, so exchange or move them")
sections.require("bearings_on_shaft", lambda bearing_b, length: bearing_b <= length * (number(1) + 1e-9), key="bearing_b",
    message="is {bearing_b}, but the sections are {length} long in all: the bearing would stand beside the shaft; set bearing_b to at most "
        "{length:down}, or lengthen the sections")
sections.require("loads_on_shaft", bind(lambda position, length: position <= length * (number(1) + 1e-9), position="loads.position"),
    key="loads.{index}.position",
    message="is beyond the shaft, whose sections are {length} long in all; move the load to at most {length:down} (a force beyond the end, as on a "
        "crank pin, has its offset), or lengthen the sections")
sections.require("notches_on_shaft", bind(lambda position, length: position <= length * (number(1) + 1e-9), position="notches.position"),
    key="notches.{index}.position", needs=("notches",),
    message="is beyond the shaft, whose sections are {length} long in all; move the notch to at most {length:down}")
sections.value("section_mass", "m_k", "kg", "Mass of the section",
    bind(lambda density, diameter, bore, length: density * beams.circle_area(diameter, bore) * length, diameter="section_diameter",
        bore="sections.bore", length="sections.length"), source="geometry", output=False)
sections.total("shaft_mass", "m", "kg", "Mass of the shaft without mounted parts", "sum", of="section_mass", source="geometry")

places = Chapter("Locations",
    text="Stresses are checked at the shoulders, notches, bearings and loads; at a step on the smaller diameter. Formulas are shown for the "
        "location of the minimum safety factor against fatigue; all locations are listed in the table of the chapter on fatigue.")
places.part_names("places", "Checked locations", lambda body: list(body.names), ("body",), shown_at="governing_place",
    count=lambda length: length("sections") - 1 + length("notches") + BEARINGS + length("loads"))


def _row(id: str, symbol: str, unit: str, description: str, function, method: str = GIVEN) -> None:  # type: ignore[no-untyped-def]
    """A row of what the body has at its places."""
    places.computed(id, symbol, unit, description, lambda body: function(body).T, ("body",), method, over="places", output=False)


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
places.value("place_step", "t", "mm", "Height of the step", lambda place_greater, place_diameter: (place_greater - place_diameter) / 2,
    source="geometry", output=False)
places.require("fillets_fit", lambda is_fillet, place_radius, place_step: np.where(is_fillet > 0, place_radius, 0) <= place_step * (number(1) + 1e-9),
    key="sections.{index}.fillet_radius",
    message="is greater than the height of the step at the section's right end, so that it does not fit; take a smaller radius")
places.value("place_area", "A", "mm**2", "Area of the section", bind(beams.circle_area, diameter="place_diameter", bore="place_bore"),
    source="Shigley 3-11", output=False)
places.value("place_modulus", "W_b", "mm**3", "Section modulus in bending; in torsion twice this value",
    bind(lambda diameter, bore: 2 * beams.second_moment(diameter, bore) / diameter, diameter="place_diameter", bore="place_bore"),
    source="Shigley 3-24", output=False)

notches = Chapter("Notches")
notches.value("neuber_bending", "a_N", "mm", "Neuber's length in bending", formulas.neuber_bending, source="Shigley 6-35a")
notches.value("neuber_torsion", "a_Ns", "mm", "Neuber's length in torsion", formulas.neuber_torsion, source="Shigley 6-35b")
BY_STRENGTH = (("press_fit", "K_fp", "of a press fit", formulas.press_fit_factor, lambda press_fit_factor: 0.65 * press_fit_factor),
               ("keyseat", "K_fk", "of a keyseat", formulas.keyseat_factor, lambda keyseat_factor: 0.56 * keyseat_factor + 0.1))
for kind, symbol, told, in_bending, in_torsion in BY_STRENGTH:
    notches.value(f"{kind}_factor", symbol, "1", f"Fatigue notch factor {told} in bending, of 40 mm", in_bending, source="DIN 743-2, table 1",
        output=False)
    notches.value(f"{kind}_torsion", f"{symbol}s", "1", f"Fatigue notch factor {told} in torsion, of 40 mm", in_torsion, source="DIN 743-2, table 1",
        output=False)
    for end, load in (("factor", "bending"), ("torsion", "torsion")):
        notches.value(f"sized_{kind}_{end}", f"{symbol}{'s' if load == 'torsion' else ''}d", "1", f"Fatigue notch factor {told} in {load}",
            bind(lambda factor, diameter:
                    factor * formulas.size_of_notch(factor, formulas.SIZE_OF_TABLE) / formulas.size_of_notch(factor, diameter),
                factor=f"{kind}_{end}", diameter="place_diameter"), source="DIN 743-2", output=False)
AT_FILLETS: dict[str, Any] = {"exists": lambda is_fillet: is_fillet > 0, "output": False}
notches.value("fillet_ratio", "t/r", "1", "Ratio of step to fillet radius", lambda place_step, place_radius: place_step / place_radius,
    source="Peterson", **AT_FILLETS)
notches.value("fillet_root", "w", "1", "Its square root", lambda fillet_ratio: np.sqrt(fillet_ratio), source="Peterson", **AT_FILLETS)
notches.value("fillet_share", "z", "1", "Ratio of both steps to the larger diameter",
    lambda place_step, place_greater: 2 * place_step / place_greater, source="Peterson", **AT_FILLETS)
for index, (low, high) in enumerate(formulas.BENDING, 1):
    names = {f"{term}{end}": value for end, terms in (("", low), ("_above", high)) for term, value in zip("abc", terms, strict=True)}
    notches.value(f"bending_{index}", f"C_{index}", "1", f"Coefficient {index} of the chart for bending",
        bind(lambda ratio, root, a, b, c, a_above, b_above, c_above:
                np.where(ratio <= 2, formulas.quadratic(a, b, c, root), formulas.quadratic(a_above, b_above, c_above, root)), ratio="fillet_ratio",
            root="fillet_root", **names), source="Peterson, chart 3.10", **AT_FILLETS)
for index, terms in enumerate(formulas.TORSION, 1):
    names = dict(zip(("constant", "linear", "square"), terms, strict=True))
    notches.value(f"torsion_{index}", f"C_s{index}", "1", f"Coefficient {index} of the chart for torsion",
        bind(formulas.quadratic, root="fillet_root", **names), source="Peterson, chart 3.12", **AT_FILLETS)
for name, symbol, told, chart, chart_name in (("k_t", "K_t", "bending", "bending", "3.10"), ("k_ts", "K_ts", "torsion", "torsion", "3.12")):
    notches.value(f"charted_{name}", f"{symbol}c", "1", f"Stress concentration factor of the fillet in {told}",
        bind(lambda first, second, third, fourth, share: np.maximum(first + second * share + third * share**2 + fourth * share**3, 1),
            first=f"{chart}_1", second=f"{chart}_2", third=f"{chart}_3", fourth=f"{chart}_4", share="fillet_share"),
        source=f"Peterson, chart {chart_name}", **AT_FILLETS)
    notches.computed(name, symbol, "1", f"Stress concentration factor in {told}",
        lambda is_fillet, of_chart, of_type: np.where(is_fillet > 0, of_chart, of_type), ("is_fillet", f"charted_{name}", f"type_{name}"),
        "from the chart for a fillet, otherwise from the type of notch", over="places", output=False)
notches.value("sensitivity", "q", "1", "Notch sensitivity in bending",
    bind(formulas.notch_sensitivity, radius="place_radius", neuber="neuber_bending"), source="Shigley 6-34", output=False)
notches.value("sensitivity_torsion", "q_s", "1", "Notch sensitivity in torsion",
    bind(formulas.notch_sensitivity, radius="place_radius", neuber="neuber_torsion"), source="Shigley 6-34", output=False)
for suffix, sign, end, told in (("", "f", "factor", "bending"), ("s", "fs", "torsion", "torsion")):
    notches.value(f"own_k_{sign}", f"K_{sign}1", "1", f"Fatigue notch factor in {told} of the notch itself",
        bind(lambda press, of_press, keys, of_key, given, sensitivity, concentration:
                 np.where(press > 0, of_press, np.where(keys > 0, keys * of_key, np.where(given > 0, given,
                     formulas.fatigue_factor(sensitivity, concentration)))), press="is_press_fit", of_press=f"sized_press_fit_{end}", keys="keyseats",
            of_key=f"sized_keyseat_{end}", given=f"given_k_{sign}", sensitivity="sensitivity_torsion" if suffix else "sensitivity",
            concentration=f"k_t{suffix}"), source="Shigley 6-32; DIN 743-2", output=False)
    notches.computed(f"k_{sign}", f"K_{sign}", "1", f"Fatigue notch factor in {told}", lambda body, row: body.greatest_here(row),
        ("body", f"own_k_{sign}"), "the maximum of the notches at one location, not their product", over="places", output=False)
notches.value("bore_ratio", "d_i/d", "1", "Ratio of bore to diameter at a fillet of a hollow shaft",
    lambda place_bore, place_diameter: place_bore / place_diameter, exists=lambda is_fillet, place_bore: (is_fillet > 0) & (place_bore > 0),
    source="Peterson", output=False)

endurance = Chapter("Endurance limit")
endurance.require("yield_below", lambda yield_strength, tensile_strength: yield_strength <= tensile_strength, key="yield_strength",
    message="is {yield_strength}, above the tensile strength of {tensile_strength}; no steel yields above what it bears")
SPECIMEN = ("specimen_endurance", "S_e′", "MPa", "Endurance limit of the polished specimen")
endurance.value(*SPECIMEN, formulas.endurance_of_specimen, source="Shigley 6-8", lacks=("fatigue_strength", "strengths.fatigue_strength"))
endurance.value(*SPECIMEN, lambda fatigue_strength: fatigue_strength, source="input", needs=("fatigue_strength",))
endurance.value(*SPECIMEN, lambda own_fatigue_strength: own_fatigue_strength, source="input", needs=("strengths.fatigue_strength",),
    lacks=("fatigue_strength",))
endurance.require("endurance_below", lambda specimen_endurance, tensile_strength: specimen_endurance < tensile_strength, key="fatigue_strength",
    message="is {specimen_endurance}, not below the tensile strength of {tensile_strength}; no steel bears so much for ever")
endurance.lookup("surface_a", "a", "1", "Factor a of the surface finish", {"ground": 1.58, "machined": 4.51, "hot_rolled": 57.7, "forged": 272},
    by="surface", source="Shigley table 6-2", output=False)
endurance.lookup("surface_b", "b", "1", "Exponent b of the surface finish",
    {"ground": -0.085, "machined": -0.265, "hot_rolled": -0.718, "forged": -0.995}, by="surface", source="Shigley table 6-2", output=False)
endurance.value("surface_factor", "k_a", "1", "Surface factor", formulas.surface_factor, source="Shigley 6-19")
endurance.choice("reliability_factor", "k_e", "1", "Reliability factor", case(lambda: 1, "half of all shafts", lambda reliability: reliability < 0.7),
    case(lambda: 0.897, "90 %", lambda reliability: reliability < 0.92), case(lambda: 0.868, "95 %", lambda reliability: reliability < 0.97),
    case(lambda: 0.814, "99 %", lambda reliability: reliability < 0.995), case(lambda: 0.753, "99.9 %", lambda reliability: reliability < 0.9995),
    case(lambda: 0.702, "99.99 %"), source="Shigley table 6-5")
endurance.computed("size_share", "d_e/d", "1", "Ratio of effective diameter to diameter",
    lambda rotation, length: np.full_like(length, 0.37 if isinstance(rotation, np.ndarray) or rotation == "none" else 1.0), ("rotation", "length"),
    "1 for a shaft that rotates or oscillates, 0.37 for one that stands (Shigley 6-24)", output=False)
endurance.value("size_factor", "k_b", "1", "Size factor", bind(formulas.size_factor, diameter="place_diameter"), source="Shigley 6-20", output=False)
endurance.value("place_endurance", "S_e", "MPa", "Endurance limit at this location",
    lambda surface_factor, size_factor, reliability_factor, specimen_endurance:
        surface_factor * size_factor * reliability_factor * specimen_endurance, source="Shigley 6-18", output=False)
