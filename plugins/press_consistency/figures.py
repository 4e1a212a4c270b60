"""Figures of the consistency of the press."""

from __future__ import annotations

from diecut_report.api import Level, Mark, Panel, Plot, Series

INERTIA = Plot(
    id="crank_inertia",
    title="Equivalent inertia at the crank",
    caption="The inertia of equal kinetic energy over a revolution of the crank: zero where the cylinder stands, and different in the two "
    "strokes because the unbalance swings. Its mean is used for the run-up.",
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
            title="Equivalent inertia",
            unit="kg*m**2",
            series=(Series(curve="crank_inertia", label="at the crank"),),
            levels=(Level(value="crank_inertia_mean", label="mean"),),
            marks=(Mark(x="crank_inertia_max_at", y="crank_inertia_max", label="maximum"),),
        ),
    ),
)

FIGURES = (INERTIA,)
