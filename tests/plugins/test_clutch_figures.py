"""The clutch's figures: forces drawn to scale and closing, lines of the chart, unusual machines."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.machine.calculation import Calculation
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
from tests.machines import number
from tests.plugins.clutches import clutch


def drawn(calc: Calculation, name: str) -> FigureRecord:
    """A figure's data by its id."""
    return next(figure for figure in figures(calc) if figure.id == name)


@pytest.mark.parametrize("friction", [0.0, 0.1, 0.3])
def test_the_arrows_of_the_force_triangle_are_the_forces_and_close(friction: float) -> None:
    calc = clutch(wedge_friction=friction)
    arrows = [shape for shape in drawn(calc, "force_triangle").shapes if shape.shape == "arrow"]
    vectors = [np.subtract(shape.end, shape.start) for shape in arrows]
    np.testing.assert_allclose(np.sum(vectors, axis=0), 0, atol=1e-9 * number(calc, "pressing_force"))
    names = [
        "pressing_force",
        "engagement_force",
        "wedge_normal_force",
        *(["wedge_friction_force"] if friction else []),
    ]
    lengths = sorted(float(np.hypot(*vector)) for vector in vectors)
    np.testing.assert_allclose(lengths, sorted(number(calc, name) for name in names))


def test_the_chart_shows_the_chosen_point_and_the_self_locking_limit() -> None:
    calc = clutch(wedge_friction=0.12)
    panel = drawn(calc, "engagement_force").panels[0]
    names = [line.label for line in panel.lines]
    assert names == ["f = 0.05", "f = 0.1", "f = 0.12", "f = 0.15", "f = 0.2", "self-locking limit, f = tan α"]
    pressing = number(calc, "pressing_force")
    for line, friction in zip(panel.lines, [0.05, 0.1, 0.12, 0.15, 0.2], strict=False):
        x, y = (np.array(numbers, dtype=float) for numbers in (line.x, line.y))
        np.testing.assert_allclose(y[np.isfinite(y)], (pressing * np.tan(x + np.arctan(friction)))[np.isfinite(y)])
        assert np.isfinite(y).sum() > 50
    limit = panel.lines[-1]
    np.testing.assert_allclose(limit.y, pressing * np.tan(2 * np.array(limit.x)))
    assert panel.marks[0].x == pytest.approx(np.radians(10))
    assert panel.marks[0].y == number(calc, "engagement_force")
    assert panel.verticals[0].x == pytest.approx(np.arctan(0.12))


def test_the_cone_with_the_gap_open_is_named_where_it_is_drawn_alone() -> None:
    for changes, is_named in (({}, False), ({"radial_gap": "1 mm"}, True), ({"radial_gap": 0}, False)):
        figure = drawn(clutch(**changes), "section")
        assert "dashed" not in figure.caption
        assert any("dashed" in text for text in figure.texts) is is_named


@pytest.mark.parametrize(
    "changes",
    [
        {"wedge_angle": 0.5},
        {"wedge_angle": 0.1},
        {"wedge_angle": 1, "wedge_friction": 0},
        {"wedge_angle": 1, "radial_gap": "5 mm"},
        {"wedge_angle": 75, "wedge_friction": 0.2},
        {"wedge_angle": 45, "wedge_friction": 0.95},
        {"shoe_width": "300 mm"},
        {"radial_gap": "1 mm"},
    ],
)
def test_figures_of_unusual_clutches_have_no_infinite_coordinate(changes: dict[str, Any]) -> None:
    for figure in figures(clutch(**changes)):
        for shape in figure.shapes:
            for key in ("points", "outer", "from", "to", "at", "center"):
                assert np.all(np.isfinite(getattr(shape, key, 0.0)))
        for panel in figure.panels:
            assert all(np.isfinite(np.array(line.y, dtype=float)).sum() > 10 for line in panel.lines)
