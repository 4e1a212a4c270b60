"""The V-belt drive to scale."""

from __future__ import annotations

from diecut_report.api import Drawing, Shape, View, arrow, dimension, polyline
from diecut_report.plugins.drive_train.layout import layout


def vbelt_layout(view: View) -> list[Shape]:
    """Both pulleys with the belt, the motor's on the left and turning counter-clockwise: the upper run is tight."""
    wraps = [view.text("vbelt_wrap"), view.text("vbelt_wrap_large")]
    r1, r2, a = view["vbelt.driver_diameter"] / 2, view["driven_diameter"] / 2, view["center_distance"]
    return [
        polyline([(-1.15 * r1, 0.0), (a + 1.1 * r2, 0.0)], "centerline"),
        *layout([0.0, a], [0.0, 0.0], [r1, r2], [1.0, 1.0], wraps if r1 <= r2 else wraps[::-1]),
        dimension((0.0, 0.0), (a, 0.0), -1.3 * max(r1, r2), view.text("center_distance")),
        dimension((0.0, -r1), (0.0, r1), 1.4 * r1, view.text("vbelt.driver_diameter")),
        dimension((a, -r2), (a, r2), -1.2 * r2, view.text("driven_diameter")),
        *_loads(view, a),
    ]


def _loads(view: View, a: float) -> list[Shape]:
    """The load of the belts at rest on both shafts, along the line of centres."""
    if view["shaft_load"] == 0:
        return []
    size = 0.25 * a
    return [
        arrow((0.0, 0.0), (size, 0.0), text=view.text("shaft_load")),
        arrow((a, 0.0), (a - size, 0.0)),
    ]


VBELT_LAYOUT = Drawing(
    id="vbelt_layout",
    title="V-belt",
    caption="The belt drive to scale with the wraps: 1 the motor pulley, 2 the flywheel pulley. With the direction of rotation shown by the "
    "arrow beside the belt, the upper span is the tight side; the arrows at the axes are the static loads of the belts on the shafts.",
    build=vbelt_layout,
)
