"""A drawing as it moves on a screen, for tests: the places of its abscissa, and where points of its shapes are at each."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.figures import Drawing
from diecut_report.results.figure_views import MachineView, _listed, _moving, laid_out

Shape = dict[str, Any]


def drawing_of(calc: Calculation, name: str) -> Drawing:
    """A declared drawing of a machine's kind."""
    return next(each for each in calc.mechanism.figures if isinstance(each, Drawing) and each.id == name)


class MovingDrawing:
    """A drawing of a machine at all its places."""

    def __init__(self, calc: Calculation, name: str) -> None:
        self.calc, self.drawing = calc, drawing_of(calc, name)
        moving = _moving(calc, self.drawing)["moving"]
        self.shapes: list[Shape] = moving["shapes"]
        self.places = np.array(moving["places"])

    def curve(self, name: str) -> Array:
        """A curve of the results at the places, beside their ends from the right."""
        x = self.places[None, :]
        return self.calc.sample(name, x, self.calc.domains[self.drawing.over].middle_of(x))[0]

    def of(self, shape: str, role: str, number: int = 0) -> Array:
        """Numbers of the n-th shape of a kind and role at each place (places, any)."""
        found = [each for each in self.shapes if (each["shape"], each.get("role")) == (shape, role)][number]
        return np.array(found["moves"])

    def links(self, number: int = 0) -> Array:
        """Joints of the n-th chain of links (places, joints, 2)."""
        return self.of("polyline", "link", number).reshape(len(self.places), -1, 2)

    def pose(self, number: int) -> tuple[Array, Array]:
        """Where the n-th rigid part is at each place (places, 2), and how far it is turned (places)."""
        moves = np.array([each for each in self.shapes if each["shape"] == "rigid"][number]["moves"])
        return moves[:, :2], moves[:, 2]

    def own(self, number: int, part: int = 0) -> Array:
        """The points of a shape of the n-th rigid part, in the part's own frame (any, 2)."""
        shape = [each for each in self.shapes if each["shape"] == "rigid"][number]["shapes"][part]
        return np.array(shape["points"] if shape["shape"] == "polyline" else [shape.get("center", shape.get("at"))])

    def still(self) -> list[Shape]:
        """The shapes of the drawing on paper."""
        return laid_out(_listed(self.drawing.build, MachineView(self.calc)))

    def at(self, place: float) -> list[Shape]:
        """The shapes at any place."""
        assert self.drawing.moving is not None
        return laid_out(self.drawing.moving(MachineView(self.calc), place))


def complex_points(points: Array) -> Array:
    """Points of the plane as complex numbers."""
    found: Array = points[..., 0] + 1j * points[..., 1]
    return found


def lengths(joints: Array) -> Array:
    """Distances from joint to joint (places, links)."""
    found: Array = np.abs(np.diff(complex_points(joints), axis=1))
    return found
