"""The drawings that move with the cursor of their curves, as the page's scripts take them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.quantities.units import pretty, to_display, unit
from diecut_report.report.number_format import tidy
from diecut_report.report.reader_pool import X_DIGITS, Y_DIGITS, ReaderRows, rounded

Data = Mapping[str, Any]
Points = NDArray[Any]
AIR = 0.03  # around all that is ever drawn, of its greater side
LETTER, WIDE = (
    0.024,
    0.56,
)  # the size of labels, of that side, and how wide a letter of them is in the mean, of that size


def moving_data(chapter: str, number: str, figure: Data, curves: Data, pool: ReaderRows) -> dict[str, Any]:
    """Return a moving drawing: its abscissa, the room that it takes, and each shape with its numbers at each place."""
    moving = figure["moving"]
    over = curves[moving["over"]]
    shown, places = over["display_unit"], np.array(moving["places"])
    ends = [to_display(float(places[end]), shown) for end in (0, -1)]
    return {
        "figure": number, "group": pool.over(chapter, over, shown), "title": tidy(figure["title"]),
        "across": {"title": tidy(over["description"]), "symbol": over["symbol"], "unit": pretty(shown), "range": ends},
        "places": pool.row(places / unit(shown).factor, X_DIGITS),
        "room": _room(moving["shapes"]),
        "letter": rounded([_letter(moving["shapes"])])[0],
        "shapes": [{**_shape(shape, pool), **_during(shape, shown)} for shape in moving["shapes"]],
    }  # fmt: skip


def _shape(shape: Data, pool: ReaderRows) -> Data:
    """A shape: its own numbers where it stands still, else those at each place, one that does not change once."""
    kept = {key: shape[key] for key in ("shape", "role", "closed", "anchor") if shape.get(key)}
    if "text" in shape:
        kept["text"] = tidy(shape["text"])
    if "shapes" in shape:
        kept["shapes"] = [_shape(own, pool) for own in shape["shapes"]]
    if "moves" not in shape:
        return kept | {"numbers": _standing(shape)}
    columns = np.array(shape["moves"]).T.copy()
    if "shapes" in shape:
        columns[2] = np.degrees(columns[2])
    return kept | {"rows": [pool.row(row[:1] if (row == row[0]).all() else row, Y_DIGITS) for row in columns]}


def _during(shape: Data, shown: str) -> Data:
    """Between which places of the abscissa a shape is filled."""
    return {"during": [to_display(end, shown) for end in shape["during"]]} if "during" in shape else {}


def _standing(shape: Data) -> list[float | None]:
    if "shapes" in shape:
        return [*rounded(shape["at"]), *rounded([math.degrees(shape["turned"])])]
    return rounded(_own(shape))


def _own(shape: Data) -> list[float]:
    """A shape's numbers: a polyline's points, a circle's centre and radius, a point."""
    if shape["shape"] == "polyline":
        return [number for point in shape["points"] for number in point]
    return [*shape["center"], shape["radius"]] if shape["shape"] == "circle" else list(shape["at"])


def _room(shapes: Sequence[Data]) -> list[float | None]:
    """Left, top, width and height (downwards) of all that is drawn at any place, with some air."""
    size = _letter(shapes)
    ends = [end for shape in shapes for end in _ends(shape)] + [_written(shape, size) for shape in _labels(shapes)]
    low, high = np.concatenate(ends).min(axis=0), np.concatenate(ends).max(axis=0)
    air = AIR * float((high - low).max())
    return rounded([low[0] - air, -high[1] - air, *(high - low + 2 * air)])


def _labels(shapes: Sequence[Data]) -> list[Data]:
    return [shape for shape in shapes if shape["shape"] == "label"]


def _letter(shapes: Sequence[Data]) -> float:
    """The size of labels."""
    ends = np.concatenate([end for shape in shapes for end in _ends(shape)])
    return LETTER * float((ends.max(axis=0) - ends.min(axis=0)).max())


def _written(shape: Data, size: float) -> Points:
    """The corners of a label."""
    wide, (x, y) = WIDE * size * len(shape["text"]), shape["at"]
    left = x - {"left": 0.0, "center": 0.5, "right": 1.0}[shape["anchor"]] * wide
    return np.array([[left, y - size / 2], [left + wide, y + size / 2]])


def _ends(shape: Data) -> list[Points]:
    """Points that a shape reaches at its places, each of shape (any, 2)."""
    if "shapes" not in shape:
        return [_reached(shape["shape"], np.array(shape.get("moves") or [_own(shape)]))]
    x, y, turned = np.array(shape.get("moves") or [[*shape["at"], shape["turned"]]]).T[:, :, None]
    c, s = np.cos(turned), np.sin(turned)
    found = []
    for a, b in ((end[:, 0], end[:, 1]) for own in shape["shapes"] for end in _ends(own)):
        found.append(np.stack([x + c * a - s * b, y + s * a + c * b], axis=-1).reshape(-1, 2))
    return found


def _reached(kind: str, numbers: Points) -> Points:
    """The points of a shape, of a circle the corners about it."""
    if kind != "circle":
        return numbers.reshape(-1, 2)
    centers, radii = numbers[:, :2], numbers[:, 2:]
    return np.concatenate([centers - radii, centers + radii])
