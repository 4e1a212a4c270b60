"""What moves in a drawing: each shape once, with the numbers that it has at each place of the abscissa."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin
from typing import Any

import numpy as np

from diecut_report.contract.figures import Shape, circle, point, polyline
from diecut_report.engine.drawable import Undrawable
from diecut_report.engine.numerics.domain import Domain
from diecut_report.languages.phrases import Phrase

FRAMES = 72  # places of a turn, beside the ends of its pieces; a screen draws straight on between them
BEFORE = 1e-9  # of the abscissa: so far before the end of a piece its curves are still those of the piece
MOVABLE = ("polyline", "circle", "point")
STANDING = ("label",)  # what may stand beside them


def frame_places(domain: Domain) -> tuple[float, ...]:
    """Return the places at which a drawing is made: evenly over the abscissa, and on both sides of where its curves jump or have a corner."""
    period, joints = float(domain.period[0, 0]), domain.joints[0]
    found = np.concatenate([np.linspace(0.0, period, FRAMES + 1), joints, joints[1:-1] - BEFORE * period])
    return tuple(float(place) for place in np.unique(found))


def moving_shapes(title: str, frames: Sequence[Sequence[Shape]]) -> list[Shape]:
    """Return the shapes of all frames once: as it is what stands still, others with their numbers in each frame (``moves``)."""
    forms = [[_form(shape) for shape in frame] for frame in frames]
    if any(form != forms[0] for form in forms) or not all(_is_movable(shape) for shape in frames[0]):
        raise Undrawable(
            Phrase(
                "what moves in {title} must be the same {movable} at each place",
                title=repr(title),
                movable=f"{', '.join(MOVABLE)}, rigid",
            )
        )
    return [_moved(shapes) for shapes in zip(*frames, strict=True)]


def laid_out(shapes: Sequence[Shape]) -> list[Shape]:
    """Return shapes with what is rigid where it stands: plain shapes alone."""
    return [own for shape in shapes for own in (_placed(shape) if shape.get("shape") == "rigid" else [shape])]


def _form(shape: Shape) -> tuple[Any, ...]:
    """What must not change from place to place."""
    if shape["shape"] == "rigid":
        return "rigid", shape["shapes"]
    if shape["shape"] in STANDING:
        return shape["shape"], shape["text"], shape["anchor"], *shape["at"]
    return shape["shape"], shape.get("role"), shape.get("closed"), len(shape.get("points", ()))


def _is_movable(shape: Shape) -> bool:
    if shape["shape"] == "rigid":
        return all(own["shape"] in MOVABLE for own in shape["shapes"])
    return shape["shape"] in (*MOVABLE, *STANDING)


def _moved(shapes: Sequence[Shape]) -> Shape:
    """A shape with its numbers at each place; an angle goes on where it would begin anew."""
    rows = np.array([_numbers(shape) for shape in shapes])
    if (rows == rows[0]).all():
        return shapes[0]
    if shapes[0]["shape"] == "rigid":
        rows[:, 2] = np.unwrap(rows[:, 2])
    kept = {key: value for key, value in shapes[0].items() if key in ("shape", "role", "closed", "shapes")}
    return kept | {"moves": rows.tolist()}


def _numbers(shape: Shape) -> list[float]:
    match shape["shape"]:
        case "polyline":
            return [number for each in shape["points"] for number in each]
        case "circle":
            return [*shape["center"], shape["radius"]]
        case "rigid":
            return [*shape["at"], shape["turned"]]
    return list(shape["at"])


def _placed(rigid: Shape) -> list[Shape]:
    """What is rigid, turned and shifted."""
    (x, y), c, s = rigid["at"], cos(rigid["turned"]), sin(rigid["turned"])

    def of(at: Sequence[float]) -> tuple[float, float]:
        return x + c * at[0] - s * at[1], y + s * at[0] + c * at[1]

    placed = []
    for shape in rigid["shapes"]:
        match shape["shape"]:
            case "polyline":
                placed.append(polyline([of(each) for each in shape["points"]], shape["role"], closed=shape["closed"]))
            case "circle":
                placed.append(circle(of(shape["center"]), shape["radius"], shape["role"]))
            case "point":
                placed.append(point(of(shape["at"]), shape["role"], shape.get("label", "")))
            case kind:
                words = "{kind} cannot be part of what is rigid; it takes {movable}"
                raise Undrawable(Phrase(words, kind=repr(kind), movable=", ".join(MOVABLE)))
    return placed
