"""Inputs of the circular knife."""

from __future__ import annotations

from diecut_report.api import POINTS, Annotated, Inputs, Quantity

# fmt: off


class CircularKnife(Inputs):
    """Keys of ``circular_knife``."""

    eccentricity: Annotated[float, Quantity("r", "mm", "Eccentricity: distance of the edge's centre from the shaft's axis", gt=0)]
    edge_radius: Annotated[float, Quantity("R", "mm", "Radius of the edge about its centre (above the eccentricity)", gt=0)]
    depth: Annotated[float, Quantity("H", "mm", "Distance of the counter-knife from the shaft's axis, between R − r and R + r", gt=0)]
    front_distance: Annotated[float, Quantity("b", "mm", "Distance of the board's front edge from the shaft's axis, along the counter-knife", ge=0)]
    thickness: Annotated[float, Quantity("h", "mm", "Thickness of the board (below the depth)", gt=0)]
    cut_length: Annotated[float, Quantity("L", "mm", "Length of the cut, measured from the board's front edge", gt=0)]
    sharpening_angle: Annotated[float, Quantity("δ", "deg", "Sharpening angle of the edge", gt=0, lt=90)]
    speed: Annotated[float, Quantity("ω", "rpm", "Speed of the knife's shaft; one cut per revolution", gt=0)]
    shear_resistance: Annotated[float,
        Quantity("σ", "N/mm**2",
            "Shear resistance: shear stress on the full thickness where the edge enters, falling to zero where it has cut through", gt=0)] = 10
    rule_force: Annotated[float | None,
        Quantity("q_a", "N/mm", "Force per unit length with which a straight rule cuts this board, for comparison with σ", gt=0)] = None
    friction: Annotated[float, Quantity("f", "1", "Coefficient of friction of the board on edge and counter-knife", ge=0)] = 0.3
    allowable_force: Annotated[float | None, Quantity("[F]", "N", "Allowable force on knife and counter-knife", gt=0)] = None
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Allowable torque at the knife's shaft", gt=0)] = None
    n_points: Annotated[int, POINTS] = 720
