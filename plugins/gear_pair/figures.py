"""Figures of the gear pair."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    BarGroup,
    Bars,
    Chart,
    Drawing,
    Panel,
    Plot,
    Series,
    Shape,
    View,
    chart_panel,
    level,
    line,
    mark,
)
from diecut_report.plugins.gear_pair import drawing
from diecut_report.plugins.gear_pair.checks import GEARS
from diecut_report.plugins.gear_pair.load_factors import DYNAMIC_KNOWN
from diecut_report.plugins.gear_pair.sizing import MODULES, SAFETIES, SERIES

TOLD = {"pitting_safety": "flank, ", "root_safety": "root, "}
SHARES = np.linspace(0.4, 2.0, 33)  # of the face width
NEIGHBOURS = 4  # modules of the series on each side of the chosen one


def reserves(view: View) -> list[Shape]:
    """What the safeties reach of those required, over the module; over the face width where the distance of the axes is given."""
    if "module_least" in view:
        chosen, title, symbol, key = view["module"], "Normal module", "m_n", "module"
        nearest = int(np.argmin(abs(SERIES - chosen)))
        values = np.unique([*SERIES[max(nearest - NEIGHBOURS, 0) : nearest + NEIGHBOURS + 1], chosen])
    else:
        chosen, title, symbol, key = view["face_width"], "Face width", "b", "face_width"
        values = SHARES * chosen
    found = view.varied({key: values}, *SAFETIES)
    lines = [line(values, found[name] / view[required], _told(name)) for name, required in SAFETIES.items()]
    least = min(view[name] / view[required] for name, required in SAFETIES.items())
    return [
        chart_panel("Ratio of safety factor to the required one", "1", title, symbol, MODULES.unit, lines=lines,
                    marks=[mark(chosen, least, "chosen")], levels=[level(1.0, "required")])
    ]  # fmt: skip


def _told(name: str) -> str:
    kind, gear = name[:-2], int(name[-1])
    return TOLD[kind] + GEARS[gear]


FIGURES = (
    Drawing(
        id="mesh",
        title="Teeth in mesh",
        caption="Transverse section to scale, the pinion below: involutes, and roots as cut by the rounded tips of the rack. Dash-dotted: the "
                "working pitch circles and the line of action; dashed: the base circles; light: the tip circles. The path of contact runs from A "
                "to E; here contact is at the pitch point C.",
        build=drawing.mesh,
    ),
    Drawing(
        id="roots",
        title="Critical sections of the tooth roots",
        caption="Normal section of the virtual spur gears, to scale. Light: the tangents at 30°, which touch the root fillet at its critical "
                "section; the load acts at the outer point of single pair tooth contact, h_Fe is its moment arm about that section.",
        build=drawing.roots,
    ),
    Bars(
        id="stresses",
        title="Stresses and safety factors",
        caption="Contact and tooth root stresses of both gears, and their safety factors.",
        groups=(
            BarGroup(
                label="Contact stress",
                unit="MPa",
                bars=(("nominal", "nominal_contact_stress"), ("pinion", "contact_stress_1"), ("wheel", "contact_stress_2")),
            ),
            BarGroup(label="Tooth root stress", unit="MPa", bars=(("pinion", "root_stress_1"), ("wheel", "root_stress_2"))),
            BarGroup(
                label="Safety",
                unit="1",
                bars=(
                    ("flank, pinion", "pitting_safety_1"),
                    ("flank, wheel", "pitting_safety_2"),
                    ("root, pinion", "root_safety_1"),
                    ("root, wheel", "root_safety_2"),
                ),
            ),
        ),
        needs=(DYNAMIC_KNOWN,),
    ),
    Chart(
        id="reserves",
        title="Safety factors versus module",
        caption="Ratio of the safety factors of flank and root to the required ones, with other modules of the preferred series and all else "
                "unchanged; where the centre distance is given, with other face widths.",
        build=reserves,
        needs=(DYNAMIC_KNOWN,),
    ),
    Plot(
        id="force_over_cycle",
        title="Force and contact stress over the cycle",
        caption="Tangential force at the reference circle, with the sign of the torque, and the pinion's contact "
                "stress.",
        abscissa="cycle_angle",
        panels=(
            Panel(title="Tangential force", unit="N", series=(Series(curve="tangential_force_curve", label="F_t"),)),
            Panel(title="Contact stress of the pinion", unit="MPa", series=(Series(curve="contact_stress_curve", label="σ_H1"),)),
        ),
        needs=("torque_curve", DYNAMIC_KNOWN),
    ),
)  # fmt: skip
