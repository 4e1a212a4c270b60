"""The mark of the greatest size of a curve stands on the curve, below zero where the curve is."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from diecut_report.api import POINTS, Annotated, Chapter, Chart, Inputs, Mark, Mechanism, Panel, Plot, Quantity, Series
from diecut_report.machine.steps.run import calculate
from diecut_report.results.figure_views import figures


class Wave(Inputs):
    shift: Annotated[float, Quantity("c", "m", "Middle of the wave")] = 0
    n_points: Annotated[int, POINTS] = 36


def wave(drawn: str = "height") -> Mechanism:
    """A sine about a shift, and its opposite."""
    chapter = Chapter("Wave")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    chapter.value("height", "h", "m", "Height", lambda shift, angle: shift + np.sin(angle))
    chapter.value("depth", "d", "m", "Depth", lambda height: -height)
    chapter.reduction("size", "h_m", "m", "Greatest size", "abs_max", of="height")
    marks = (Mark(x="size_at", y="size", label="greatest"),)
    panel = Panel(title="Height", unit="m", series=(Series(curve=drawn, label="h"),), marks=marks)
    plot = Plot(id="wave", title="Wave", caption="", abscissa="angle", panels=(panel,))
    return Mechanism(kind="wave", version="1", title="", summary="", inputs=Wave, chapters=(chapter,), figures=(plot,))


def marked(drawn: str, shift: float) -> dict[str, Any]:
    """The mark in the plot."""
    [figure] = figures(calculate(wave(drawn), {"shift": shift, "n_points": 36}))
    [mark] = figure.panels[0].marks
    return dict(mark)


@pytest.mark.parametrize(("shift", "place", "height"), [(0.5, np.pi / 2, 1.5), (-0.5, 3 * np.pi / 2, -1.5)])
def test_the_greatest_size_is_marked_on_the_curve(shift: float, place: float, height: float) -> None:
    assert marked("height", shift) == {
        "x": pytest.approx(place, abs=1e-6),
        "y": pytest.approx(height),
        "label": "greatest",
    }


def test_a_size_beside_another_curve_stays_a_size() -> None:
    assert marked("depth", -0.5)["y"] == pytest.approx(1.5)


def test_a_chart_without_panels_is_left_out() -> None:
    empty = Chart(id="none", title="None", caption="", build=lambda view: [])
    mechanism = replace(wave(), figures=(empty, *wave().figures))
    assert [each.id for each in figures(calculate(mechanism, {"shift": 0.0, "n_points": 36}))] == ["wave"]
