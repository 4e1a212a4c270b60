"""Figures of the consistency of the press."""

from __future__ import annotations

from diecut_report.api import Level, Mark, Panel, Plot, Series

INERTIA = Plot(
    id="crank_inertia",
    title="Equivalent inertia at the crank",
    caption="The inertia of equal kinetic energy over a turn of the crank: none where the cylinder stands, and of different size in the two "
    "strokes, as the unbalance swings. Its mean is that of the run-up.",
    abscissa="crank_angle",
    needs=(
        "cylinder_mass",
        "cylinder_inertia",
        "cylinder_radius",
        "cylinder_rotation",
        "cylinder_speed",
        "crank_speed",
    ),
    panels=(
        Panel(
            title="Reduced inertia",
            unit="kg*m**2",
            series=(Series(curve="crank_inertia", label="at the crank"),),
            levels=(Level(value="crank_inertia_mean", label="mean"),),
            marks=(Mark(x="crank_inertia_max_at", y="crank_inertia_max", label="greatest"),),
        ),
    ),
)

FIGURES = (INERTIA,)
