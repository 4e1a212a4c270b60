"""Chapters on motion, force and torque over the knife's turn, and the comparison with a guillotine."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Abscissa, Binding, Breakpoints, Case, Chapter, Choice, Reduction, Value, bind
from diecut_report.mechanics import circular_segment, common
from diecut_report.plugins.circular_knife import formulas as f
from diecut_report.plugins.circular_knife.geometry import OWN

CUTTING = bind(f.holds, flag="cutting")
INSIDE, OUTSIDE = "the knife is in its cut", "the knife is outside its cut"


def _in_cut(
    name: str, symbol: str, unit: str, description: str, formula: Binding, *, source: str = OWN, output: bool = True
) -> Choice:
    """A curve that is zero outside the cut."""
    return Choice(id=name, symbol=symbol, unit=unit, description=description, source=source, output=output,
                  cases=(Case(formula, INSIDE, CUTTING), Case(common.zero, OUTSIDE)))  # fmt: skip


MOTION = Chapter(
    "Motion over a turn of the knife",
    text="The curves run over a full turn, so that a drive can take them over. Outside the cut, cutting point and shear angle stay as they are at "
    "its start; speed, sliding, force and torque are zero. At the cutting point the edge's normal and its centre's direction include the angle φ "
    "+ τ: hence the speeds of the edge along itself, ω·(R + r·sin(φ + τ)), and square to itself, ω·r·cos(φ + τ).",
    steps=(
        Abscissa(id="knife_angle", symbol="φ", unit="deg", description="Knife angle, one turn", period=2 * np.pi, shown_at="torque_max_at"),
        Value(id="parting_angle", symbol="φ_s", unit="deg", description="Knife angle that parts the cut for integration: a flat edge makes it "
              "begin steeply",
              source=OWN, output=False, formula=f.parting_angle),
        Breakpoints(id="ends_of_cut", abscissa="knife_angle", places=("angle_start", "parting_angle", "angle_end")),
        Value(id="middle_angle", symbol="φ_m", unit="deg", description="Knife angle in the middle of the cut", source="kinematics", output=False,
              formula=bind(f.middle_of, first="angle_start", second="angle_end")),
        Choice(id="cutting", symbol="c", description="Whether the knife is in its cut (1) or not (0)", output=False, per_piece=True,
               cases=(Case(common.one, INSIDE, bind(f.is_within, angle="knife_angle", middle="middle_angle", sweep="cut_angle")),
                      Case(common.zero, OUTSIDE))),
        Choice(id="cut_place", symbol="φ_c", unit="deg", description="Knife angle in the cut, or at its start", output=False,
               cases=(Case(bind(common.same, quantity="knife_angle"), INSIDE, CUTTING),
                      Case(bind(common.same, quantity="angle_start"), OUTSIDE))),
        Value(id="cut_position", symbol="x_c", unit="mm", description="Distance of the cutting point from the axis", source=OWN,
              formula=bind(f.edge_position, angle="cut_place")),
        Value(id="shear_angle", symbol="τ", unit="deg", description="Shear angle between edge and counter-knife", source=OWN,
              formula=bind(f.edge_slope, angle="cut_place")),
        _in_cut("cut_speed", "v_c", "m/s", "Speed of the cutting point along the counter-knife", bind(f.cut_speed, angle="cut_place"),
                source="kinematics"),
        _in_cut("sliding_ratio", "k", "1", "Sliding ratio: speed of the edge along itself to that square to itself",
                bind(f.sliding_ratio, angle="cut_place")),
        Reduction(id="cut_speed_max", symbol="v_c,max", unit="m/s", description="Greatest speed of the cutting point", source="kinematics",
                  of="cut_speed", operation="max"),
        Reduction(id="sliding_ratio_max", symbol="k_max", description="Greatest sliding ratio", source=OWN, of="sliding_ratio", operation="max"),
        Value(id="effective_sharpening_angle_min", symbol="δ_e", unit="deg", description="Least effective sharpening angle, in the direction of "
              "motion",
              source=OWN, formula=bind(f.effective_angle, sliding_ratio="sliding_ratio_max")),
    ),
)  # fmt: skip

FORCES = Chapter(
    "Force and torque",
    text="Over the length a of the working front the board is partly cut through; the edge bows out of its chord by the area A_b. Each millimetre "
    "of the edge in the board carries σ times the thickness that it has still to cut, square to the edge: σ·h where it enters, nothing where the "
    "board is cut through. So each unit of area cut takes the work σ·h/2. Added up, these loads press down with F_w and push along the cut with "
    "F_h; they all point to the edge's centre, and their torque about the shaft is M_u. By virtual work it is so: M_u·dφ is the sum of the loads "
    "times the ways by which they move the edge into the board, and F_w·dy the same if the knife sinks by dy. F_v counts the thickness already "
    "passed instead of that left. For a straight edge both are σ·h²/(2·tan τ); for this edge F_v is greater by 2·σ·A_b. The greatest force, the "
    "guillotine ratio and the friction are taken with F_v, on the safe side; the work of cutting belongs to F_w. Both areas are integrals over "
    "the board's thickness, in closed form by the segment of the edge's arc.",
    steps=(
        Value(id="face_angle", symbol="τ_h", unit="deg", description="Slope of the edge in the board's upper face", source=OWN, output=False,
              formula=bind(f.edge_slope, angle="cut_place", depth="face_depth")),
        Value(id="front_half_angle", symbol="α", unit="deg", description="Half the arc of the working front", source=OWN, output=False,
              formula=bind(f.half_between, first="shear_angle", second="face_angle")),
        _in_cut("front_length", "a", "mm", "Length of the working front", bind(f.front_length), output=False),
        Value(id="bow_area", symbol="A_b", unit="mm**2", description="Area between the working front and its chord", source=OWN, output=False,
              formula=bind(circular_segment.area, radius="edge_radius", half_angle="front_half_angle")),
        _in_cut("force", "F_v", "N", "Force down on the board", bind(f.force), source=OWN),
        _in_cut("working_force", "F_w", "N", "Force down by virtual work", bind(f.working_force), source="energy", output=False),
        Value(id="thrust", symbol="F_h", unit="N", description="Force along the cut by virtual work", source="energy", formula=f.thrust),
        _in_cut("useful_torque", "M_u", "N*m", "Torque of cutting", bind(f.useful_torque, angle="cut_place"), source="statics", output=False),
        _in_cut("friction_torque", "M_f", "N*m", "Torque of friction", bind(f.friction_torque, angle="cut_place"), source=OWN),
        Value(id="torque", symbol="M", unit="N*m", description="Torque at the knife's shaft", source="statics",
              formula=bind(common.sum_of, first="useful_torque", second="friction_torque")),
        Reduction(id="front_length_max", symbol="a_max", unit="mm", description="Greatest length of the working front", source=OWN,
                  of="front_length", operation="max"),
        Reduction(id="force_max", symbol="F_max", unit="N", description="Greatest force down on the board", source=OWN, of="force", operation="max"),
        Reduction(id="working_force_max", symbol="F_w,max", unit="N", description="Greatest force down by virtual work", source="energy",
                  of="working_force", operation="max"),
        Reduction(id="torque_max", symbol="M_max", unit="N*m", description="Greatest torque at the knife's shaft", source="statics", of="torque",
                  operation="max"),
        Reduction(id="useful_work", symbol="W_u", unit="J", description="Work of cutting, from φ_1 to φ_2", source="energy", of="useful_torque",
                  operation="integral"),
        Reduction(id="work", symbol="W", unit="J", description="Work of a cut, with friction", source="energy", of="torque", operation="integral"),
        Value(id="power_mean", symbol="N_mean", unit="W", description="Mean power over a turn with one cut", source="energy", formula=f.mean_power),
        Value(id="power_peak", symbol="N_max", unit="W", description="Greatest power", source="energy",
              formula=bind(common.product, first="torque_max", second="speed")),
    ),
)  # fmt: skip

GUILLOTINE = Chapter(
    "Compared with a guillotine",
    text="A straight blade parallel to the counter-knife cuts the same length at once. Its work is not quite the work of cutting W_u: at φ_1 a part "
    "of the board is cut into already, and at φ_2 the edge has cut into it beyond the end.",
    steps=(
        Value(id="guillotine_force", symbol="F_g", unit="N", description="Force of a guillotine for the same length", source=OWN,
              formula=f.guillotine_force),
        Value(id="guillotine_work", symbol="W_g", unit="J", description="Its work, without friction", source="energy", formula=f.guillotine_work),
        Value(id="guillotine_force_ratio", symbol="q_F", description="Greatest force to the guillotine's", source=OWN,
              formula=bind(common.quotient, quantity="force_max", by="guillotine_force")),
    ),
)  # fmt: skip
