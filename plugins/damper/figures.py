"""Figures of the rubber damper: the block to scale, its force over the deflection, its length over the allowed stress."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Phrase,
    Point,
    Shape,
    View,
    chart_panel,
    dimension,
    fill,
    label,
    level,
    line,
    mark,
    phrase,
    polyline,
    region,
    vertical,
)

MOST_DRAWN = 0.9  # strain above which no pressed block is drawn
BEYOND = 1.08  # how far the line of the force runs on, for the eye


def _bulge(strain: float) -> float:
    """How much wider the middle is than the ends of a block that keeps its volume and bulges as a parabola."""
    grown = 1 / (1 - strain)  # ∫(1 + 4βs(1 − s))² ds = 1 + 4β/3 + 8β²/15
    return float((-4 / 3 + np.sqrt(16 / 9 + 32 / 15 * (grown - 1))) / (16 / 15))


def _outline(length: float, width: float, bulge: float) -> list[Point]:
    """Outline of a block that lies along x from its foot at 0, thicker in the middle."""
    s = np.linspace(0, 1, 41)
    half = width / 2 * (1 + 4 * bulge * s * (1 - s))
    upper = [(float(a), float(b)) for a, b in zip(length * s, half, strict=True)]
    return upper + [(x, -y) for x, y in reversed(upper)]


def _laid(view: View, length: float, strain: float, level: float) -> list[Shape]:
    """The block in one of its states, between the wall that carries it and the plate that presses it."""
    height = view["pad_height"]
    wall = 0.8 * height
    return [
        region([(x, y + level) for x, y in _outline(length, height, _bulge(strain))]),
        polyline([(0.0, level + wall), (0.0, level - wall)], "ground"),
        polyline([(length, level + wall), (length, level - wall)], "link"),
    ]


def _end(view: View, left: float, away: float) -> list[Shape]:
    """The pad as seen along the damper, with its sides."""
    width, half = view["ring_width"], view["pad_height"] / 2
    corners: list[Point] = [(left, -half), (left + width, -half), (left + width, half), (left, half)]
    return [
        region(corners),
        dimension(corners[3], corners[2], away, view.text("ring_width")),
        dimension(corners[1], corners[2], -away, view.text("pad_height")),
    ]


def _compressed(view: View, level: float, away: float) -> list[Shape]:
    """The block at its greatest deflection, and where the drive presses it to."""
    length, half = view["adopted_length"], view["pad_height"] / 2
    if view["strain"] > MOST_DRAWN:
        return [label((0.0, -half - 2.2 * away), "no block can be pressed together as far as calculated")]
    pressed = length - view["deflection"]
    is_driven = "driven_deflection" in view and view["driven_strain"] <= MOST_DRAWN
    shapes = [
        *_laid(view, pressed, view["strain"], level),
        polyline([(length, 0.8 * half), (length, level - half)], "centerline"),
        dimension((pressed, level - half), (length, level - half), -away, view.text("deflection")),
        label(
            (length + 0.4 * away, level),
            phrase("pressed together") + ("; dashed: by the drive too" if is_driven else ""),
        ),
    ]
    if is_driven:
        driven = length - view["driven_deflection"]
        shapes += [
            polyline([(driven, level + 1.6 * half), (driven, level - 1.6 * half)], "hidden"),
            dimension((driven, level - half), (length, level - half), -2 * away, view.text("driven_deflection")),
        ]
    return shapes


def block(view: View) -> list[Shape]:
    """The damper free and pressed together, and its pad."""
    length, height = view["adopted_length"], view["pad_height"]
    away = max(0.07 * (length + view["ring_width"]), 0.25 * height)  # of a dimension line
    return [
        *_laid(view, length, 0.0, 0.0),
        dimension((0.0, height / 2), (length, height / 2), away, view.text("adopted_length")),
        label((0.02 * length, -height / 2 - 0.6 * away), "free"),
        *_end(view, length + 2 * away, away),
        *_compressed(view, -2 * height - 1.5 * away, away),
    ]


def force(view: View) -> list[dict[str, Any]]:
    """Force of all dampers over their deflection, the energy as the area below it."""
    count = view["damper_count"]
    reach, peak = view["deflection"], count * view["peak_force"]
    marks = [mark(reach, peak, "at rest")]
    fills = [
        fill(
            [0.0, reach],
            [0.0, peak],
            Phrase("kinetic energy {kinetic_energy}", kinetic_energy=view.text("kinetic_energy")),
        )
    ]
    levels = []
    if "driven_deflection" in view:
        first = reach, peak
        reach, peak = view["driven_deflection"], count * view["driven_peak_force"]
        marks.append(mark(reach, peak, "at rest with the drive"))
        fills.append(
            fill(
                [first[0], reach],
                [first[1], peak],
                Phrase("work of the drive {driving_work}", driving_work=view.text("driving_work")),
            )
        )
        levels.append(level(view["driving_force"], "drive"))
    return [
        chart_panel(
            "Force of all dampers", "N", "Deflection", "h", "mm",
            lines=[line([0.0, BEYOND * reach], [0.0, BEYOND * peak], "dampers together")],
            fills=fills,
            marks=marks,
            levels=levels,
        )
    ]  # fmt: skip


def length(view: View) -> list[dict[str, Any]]:
    """Length over the stress that it leads to, with the adopted one and the limits of stress, buckling and linear law."""
    allowed, reached = view["allowable_stress"], view["stress"]
    stresses = np.linspace(min(0.5 * allowed, 0.8 * reached), max(2.0 * allowed, 1.2 * reached), 181)
    names = ("free_length", *(("driven_free_length",) if "driven_free_length" in view else ()))
    found = view.varied({"allowable_stress": stresses}, *names)
    free = found["free_length"]
    lines = [line(stresses, free, "free length")]
    if "driven_free_length" in found:
        driven = found["driven_free_length"]
        lines.append(
            line(stresses, np.where(driven <= free.max(), driven, np.nan), "with the drive, within the linear law")
        )
    linear = view["elastic_modulus"] * view["max_strain"]
    verticals = [vertical(allowed, "allowed")]
    if linear != allowed and stresses[0] <= linear <= stresses[-1]:
        verticals.append(vertical(linear, "linear law ends"))
    return [
        chart_panel(
            "Length", "mm", "Maximum stress", "σ", "MPa",
            lines=lines,
            marks=[mark(reached, view["adopted_length"], "adopted")],
            levels=[level(view["length_limit"], "buckles above")],
            verticals=verticals,
        )
    ]  # fmt: skip


FIGURES = (
    Drawing(
        "block",
        "Damper block",
        "The block to scale, free and at its maximum deflection, with its pad on the right. A compressed block is drawn with constant "
        "volume.",
        build=block,
    ),
    Chart(
        "force",
        "Force versus deflection",
        "Total force of the dampers; the area below the line is the energy absorbed.",
        build=force,
    ),
    Chart(
        "length",
        "Length versus stress",
        "Length that absorbs the energy at a given stress; marked: the adopted length and the resulting stress. Above the level the "
        "block buckles.",
        build=length,
    ),
)
