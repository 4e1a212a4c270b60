"""What moves in a drawing, as the results hold it: each shape once, with its numbers at each place; marks stand on their curve."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Chapter,
    Chart,
    Inputs,
    Mark,
    Mechanism,
    Panel,
    Plot,
    Quantity,
    Series,
    abscissa,
    circle,
    label,
    m,
    point,
    polyline,
    reduction,
    rigid,
    samples,
)
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.steps.run import calculate
from diecut_report.results.figure_views import MachineView, Undrawable, figures, frame_places, laid_out, moving_shapes
from tests.machines import drive


class Wave(Inputs):
    shift = Quantity("c", "m", "Middle of the wave", default=0)
    n_points = samples(36)


def wave(drawn: str = "height") -> Mechanism:
    """A sine about a shift, and its opposite."""
    chapter = Chapter("Wave")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.height = m.shift + np.sin(m.angle), "h", "m", "Height"
    chapter.depth = -m.height, "d", "m", "Depth"
    chapter.size = reduction("abs_max", of="height"), "h_m", "m", "Greatest size"
    marks = (Mark("size_at", "size", "greatest"),)
    panel = Panel("Height", "m", series=(Series(drawn, "h"),), marks=marks)
    plot = Plot("wave", "Wave", "", abscissa="angle", panels=(panel,))
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
    empty = Chart("none", "None", "", build=lambda view: [])
    mechanism = replace(wave(), figures=(empty, *wave().figures))
    assert [each.id for each in figures(calculate(mechanism, {"shift": 0.0, "n_points": 36}))] == ["wave"]


SPOKE = [polyline([(0.0, 0.0), (1.0, 0.0)], "body")]
TURNED = (0.0, pi / 2, pi, -pi / 2)


def test_what_stands_still_is_kept_as_it_is_and_what_moves_once_with_its_numbers() -> None:
    pins = [(1.0, 0.0), (0.0, 1.0)]
    ring, link, pin = moving_shapes(
        "T", [[circle((0.0, 0.0), 2.0), polyline([(0.0, 0.0), at], "link"), point(at, "joint")] for at in pins]
    )
    assert ring == circle((0.0, 0.0), 2.0)
    assert link["moves"] == [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]] and "points" not in link
    assert pin["moves"] == [[1.0, 0.0], [0.0, 1.0]]


def test_the_angle_of_what_is_rigid_goes_on_where_it_would_begin_anew() -> None:
    (wheel,) = moving_shapes("T", [[rigid(SPOKE, (3.0, 0.0), angle)] for angle in TURNED])
    assert wheel["shapes"] == SPOKE
    assert np.allclose(wheel["moves"], [[3.0, 0.0, angle] for angle in (0.0, pi / 2, pi, 3 * pi / 2)])


def test_what_is_rigid_lies_turned_and_then_shifted_in_a_still_drawing() -> None:
    own = [*SPOKE, circle((1.0, 0.0), 0.1, "mark"), point((0.0, 1.0), "joint", "A")]
    spoke, eye, joint = laid_out([rigid(own, (3.0, 1.0), pi / 2)])
    assert np.allclose(spoke["points"], [[3.0, 1.0], [3.0, 2.0]]) and not spoke["closed"]
    assert np.allclose(eye["center"], [3.0, 2.0]) and eye["radius"] == 0.1
    assert np.allclose(joint["at"], [2.0, 1.0]) and joint["label"] == "A"


@pytest.mark.parametrize("frames", [
    [SPOKE, [*SPOKE, *SPOKE]], [SPOKE, [polyline([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)], "body")]], [SPOKE, [circle((0.0, 0.0), 1.0, "body")]],
    [[rigid(SPOKE)], [rigid([circle((0.0, 0.0), 1.0)])]],
    [[label((0.0, 0.0), "A")], [label((0.0, 0.0), "B")]], [[label((0.0, 0.0), "A")], [label((1.0, 0.0), "A")]], [[rigid([label((0.0, 0.0), "A")])]],
])  # fmt: skip
def test_what_changes_but_for_its_place_is_refused_in_words(frames: list[list[dict[str, Any]]]) -> None:
    with pytest.raises(Undrawable, match="must be the same polyline, circle, point, rigid at each place"):
        moving_shapes("T", frames)


def test_no_text_is_part_of_what_is_rigid() -> None:
    with pytest.raises(Undrawable, match="'label' cannot be part of what is rigid"):
        laid_out([rigid([label((0.0, 0.0), "A")])])


def test_both_sides_of_a_jump_are_shown() -> None:
    domain = Domain(np.array([[2 * pi]]), np.zeros((1, 1)))
    domain.cut(np.array([[1.0]]))
    places = frame_places(domain)
    assert 1.0 in places and any(0 < 1.0 - place < 1e-8 for place in places)
    assert places[0] == 0.0 and places[-1] == 2 * pi and list(places) == sorted(places)


def test_curves_are_taken_at_all_places_at_once_and_what_is_made_once_is_kept() -> None:
    calc, places, made = drive(), (0.0, 1.0, 2.0), []
    view, alone = MachineView(calc, places), MachineView(calc)
    assert [view.at("displacement", place) for place in places] == pytest.approx(
        [alone.at("displacement", place) for place in places]
    )
    assert len(view._heights["displacement"]) == 3 and view.at("displacement", 0.5) == alone.at("displacement", 0.5)

    def outline(own: MachineView) -> object:
        made.append(own)
        return object()

    assert view.once(outline) is view.once(outline) and made == [view]
