"""Figures of the shaft."""

from __future__ import annotations

from itertools import accumulate

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Panel,
    Phrase,
    Plot,
    Point,
    Series,
    Shape,
    View,
    arrow,
    chart_panel,
    dimension,
    label,
    level,
    line,
    mark,
    phrase,
    point,
    polyline,
)

SHARE = 0.06  # of the length, by which marks stand off


def shaft(view: View) -> list[Shape]:
    """Draw sections, bearings, loads and notches, seen from the side."""
    length = view["length"]
    sizes = view.row("section_diameter")
    ends = [0.0, *accumulate(view.row("sections.length"))]
    highest = max(sizes) / 2
    shapes = [polyline([(-SHARE * length, 0), ((1 + SHARE) * length, 0)], "centerline")]
    for i, (size, bore) in enumerate(zip(sizes, view.row("sections.bore"), strict=True)):
        shapes.append(polyline(_rectangle(ends[i], ends[i + 1], size / 2), closed=True))
        if bore > 0:
            shapes.append(polyline(_rectangle(ends[i], ends[i + 1], bore / 2), "hidden", closed=True))
    for name, here in (("a", "A"), ("b", "B")):
        shapes += _bearing(view, name, here, highest)
    for name, x in zip(view.words("loads.name"), view.row("loads.position"), strict=True):
        radius = _radius(ends, sizes, x)
        shapes.append(arrow((x, radius + 2 * SHARE * length), (x, radius), "mark", name))
    if "notches.position" in view:
        for i, x in enumerate(view.row("notches.position")):
            radius = _radius(ends, sizes, x)
            shapes.append(point((x, radius), "mark", Phrase("notch {i}", i=i + 1)))
    return [*shapes, dimension((0, -highest), (length, -highest), -4 * SHARE * length, view.text("length"))]


def _rectangle(left: float, right: float, height: float) -> list[Point]:
    return [(left, -height), (right, -height), (right, height), (left, height)]


def _radius(ends: list[float], sizes: list[float], x: float) -> float:
    """The shaft's radius at a place."""
    inside = [
        size for left, right, size in zip(ends, ends[1:], sizes, strict=False) if left - 1e-9 <= x <= right + 1e-9
    ]
    return max(inside) / 2


def _bearing(view: View, name: str, told: str, highest: float) -> list[Shape]:
    x, width = view[f"bearing_{name}"], SHARE * view["length"] / 2
    foot = -highest - 2 * width
    triangle = [(x, -highest), (x - width, foot), (x + width, foot)]
    axial = view.word("locating") == name
    return [
        polyline(triangle, "link" if axial else "outline", closed=True),
        label(
            (x, foot - width), Phrase("bearing {told}, locating" if axial else "bearing {told}", told=told), "center"
        ),
    ]


ALONG = Plot(
    "along",
    "Moments, torque, stress and deflection along the shaft",
    "The bending moment in both planes at the instant of its maximum; the maximum bending moment and the maximum absolute torque over "
    "the cycle at each position; the maximum stress without notches; the deflection at the instant of its maximum.",
    abscissa="position",
    panels=(
        Panel(
            "Bending moment",
            "N*m",
            series=(
                Series("bending_moment", "maximum over the cycle"),
                Series("moment_xy", "in x–y at its instant"),
                Series("moment_xz", "in x–z at its instant"),
            ),
        ),
        Panel("Torque", "N*m", series=(Series("torque", "maximum over the cycle"),)),
        Panel("Nominal stress", "MPa", series=(Series("stress_along", "maximum over the cycle"),)),
        Panel("Deflection", "um", series=(Series("deflection", "at its maximum"),)),
    ),
)
REACTIONS = Plot(
    "reactions",
    "Reactions over the cycle",
    "Forces of the bearings on the shaft, as they load the bearings over a cycle.",
    abscissa="cycle_angle",
    panels=(Panel("Reaction", "kN", series=(Series("reaction_a", "bearing A"), Series("reaction_b", "bearing B"))),),
)
TOLD = 20.0  # a safety above that is drawn there


def _places(view: View) -> list[Shape]:
    """The safety of each place over its position."""
    x, safety, names = view.row("place_x"), view.row("place_safety"), view.words("places")
    order = np.argsort(x, kind="stable")
    least: dict[float, tuple[float, str]] = {}
    for i in order:
        found = least.get(round(x[i], 9))
        if found is None or safety[i] < found[0]:
            least[round(x[i], 9)] = (safety[i], names[i])
    shown = [
        (place, min(each, TOLD), Phrase("{place}, above", place=phrase(name)) if each > TOLD else name)
        for place, (each, name) in least.items()
    ]
    stems = np.array([end for place, height, _ in shown for end in ((place, 0.0), (place, height), (place, np.nan))])
    return [
        chart_panel(
            "Safety factor against fatigue", "1", "Position", "x", "mm",
            lines=[line(stems[:, 0], stems[:, 1], "minimum safety factor at each location")],
            marks=[mark(place, height, name) for place, height, name in shown],
            levels=[level(view["required_fatigue_safety"], "required")],
        )
    ]  # fmt: skip


def _goodman(view: View) -> list[Shape]:
    """The governing place in the diagram of Goodman."""
    index = int(view["governing_place"])
    alternating, mean = (
        float(
            np.hypot(
                view.row("k_f")[index] * view.row(f"sigma_{part}")[index],
                3**0.5 * view.row("k_fs")[index] * view.row(f"tau_{part}")[index],
            )
        )
        for part in "am"
    )
    limit, strength, required = view["endurance_limit"], view["tensile_strength"], view["required_fatigue_safety"]
    return [
        chart_panel(
            "Equivalent amplitude", "MPa", "Equivalent mean", "σ_m′", "MPa",
            lines=[
                line([0, strength], [limit, 0], "Goodman's line"),
                line([0, strength / required], [limit / required, 0], "with the required safety factor"),
                line([0, mean], [0, alternating], view.words("places")[index]),
            ],
            marks=[mark(mean, alternating, "stress at this location")],
        )
    ]  # fmt: skip


def _amplitudes(view: View) -> list[Shape]:
    """Amplitudes of normal and shear stress with the notch, at all places."""
    normal, shear = (
        [factor * stress for factor, stress in zip(view.row(k), view.row(name), strict=True)]
        for k, name in (("k_f", "sigma_a"), ("k_fs", "tau_a"))
    )
    index = int(view["governing_place"])
    turn = np.linspace(0, np.pi / 2, 91)
    size = view["endurance_limit"] / view["required_fatigue_safety"]
    return [
        chart_panel(
            "Amplitude of the shear stress, with its notch factor", "MPa", "Amplitude of the normal stress, with its notch factor", "", "MPa",
            lines=[line(size * np.cos(turn), size * np.sin(turn) / 3**0.5, "endurance limit divided by the required safety factor, without mean "
                                                                           "stress")],
            marks=[mark(x, y, view.words("places")[i] if i == index else "") for i, (x, y) in enumerate(zip(normal, shear, strict=True))],
        )
    ]  # fmt: skip


FIGURES = (
    Drawing(
        "shaft",
        "Shaft",
        "To scale: sections with their bore, bearings (triangles; the locating one filled), loads (arrows) and notches (marks).",
        build=shaft,
    ),
    ALONG,
    REACTIONS,
    Chart(
        "safety",
        "Safety factor against fatigue at each location",
        "Of several locations at one position the minimum; values above 20 are drawn at 20.",
        build=_places,
    ),
    Chart(
        "amplitudes",
        "Stress amplitudes",
        "Each location with its notch factors; the named one has the minimum safety factor.",
        build=_amplitudes,
    ),
    Chart(
        "goodman",
        "Goodman diagram of the governing location",
        "Equivalent amplitude over equivalent mean stress, both with the notch factors.",
        build=_goodman,
    ),
)
