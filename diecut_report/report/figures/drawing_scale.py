"""How large a drawing is on paper: its scale, and the size of the text in its boxes."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.report.figures.shapes import extent
from diecut_report.report.figures.style import FONT_SIZE, LINE, MM, marked, text_size

Array = NDArray[Any]
Shape = Mapping[str, Any]
PAGE = np.array([172 * MM, 222 * MM])  # what a figure may take, in points
LARGEST = np.array([130 * MM, 80 * MM])  # of the shapes, their texts come beside them
TALL = 1.2  # a tall drawing may be so many times as high as others
SIZES = (FONT_SIZE, 8.0, 7.5, 7.0, 6.5)  # of text in boxes, the least last
PAD = np.array([8.0, 6.0])  # between a box and its text, both sides together
ROOMY = 2.5  # a schematic gives its boxes no more than so many times what their text needs


class Scale(NamedTuple):
    """Points a metre, across and upwards; how round things are scaled; the size of the text in boxes."""

    across: float
    upwards: float
    text: float

    @property
    def both(self) -> Array:
        """Across and upwards."""
        return np.array([self.across, self.upwards])

    @property
    def round(self) -> float:
        """For radii, which stay round."""
        return min(self.across, self.upwards)


def scaled(shapes: Sequence[Shape], room: Array, *, schematic: bool) -> Scale:
    """As large as the room lets it be; a schematic is stretched, where it must be, until the text fits its boxes."""
    corners = np.concatenate([extent(shape) for shape in shapes])
    size = np.maximum(np.ptp(corners, axis=0), 1e-12)
    tall = float(np.clip(size[1] / size[0] / 1.1, 1.0, TALL))
    limits = room * np.array([1.0, tall]) / size
    scale = float(limits.min())
    boxes = [shape for shape in shapes if shape["shape"] == "box"]
    needs = {text: needed(boxes, text) for text in SIZES}
    if not boxes or not schematic:
        fitting = [text for text in SIZES if (needs[text] <= scale).all()]
        return Scale(scale, scale, fitting[0] if fitting else SIZES[-1])
    scale = min(scale, ROOMY * float(needs[FONT_SIZE].max()))
    limits = np.maximum(limits * (PAGE / LARGEST) ** [1, 0], scale)
    fitting = [text for text in SIZES if (needs[text] <= limits).all()]
    text = fitting[0] if fitting else SIZES[-1]
    across, upwards = np.clip(needs[text], scale, limits)
    return Scale(float(across), float(upwards), text)


def needed(boxes: Sequence[Shape], text: float) -> Array:
    """The scales, across and upwards, at which the text of a size fits all boxes."""
    scales = [(content(box["lines"], text) + PAD) / (box["width"], box["height"]) for box in boxes]
    found: Array = np.max(scales, axis=0) if scales else np.zeros(2)
    return found


def content(lines: Sequence[str], text: float) -> Array:
    """Width and height of the lines in a box."""
    wide = max((text_size(marked(line), text)[0] for line in lines), default=0.0)
    return np.array([wide, text * (1.08 + LINE * (len(lines) - 1)) if lines else 0.0])


def filled(shape: Shape, scale: Scale) -> tuple[list[str], Array]:
    """A box on paper: its lines and its size; lines that are too wide are folded, and at last it grows about its text."""
    size = np.array([shape["width"], shape["height"]]) * scale.both
    lines = list(shape["lines"])
    if (content(lines, scale.text) + PAD > size * (1 + 1e-9)).any():
        widest = content([part for line in lines for part in folded(line, 0.0, scale.text)], scale.text)[0]
        lines = [part for line in lines for part in folded(line, max(size[0] - PAD[0], widest), scale.text)]
    return lines, np.maximum(size, content(lines, scale.text) + PAD)


_BREAKS = (re.compile(r"(?<=[,;:]) "), re.compile(r"(?<![=<>·\d]) (?![=<>·\d])"))  # no unit is torn from its number


def folded(text: str, width: float, size: float = FONT_SIZE) -> list[str]:
    """A text in lines no wider than ``width``, as far as its parts let it: broken behind commas, else between words."""
    if text_size(marked(text), size)[0] <= width:
        return [text]
    for breaks in _BREAKS:
        parts = breaks.split(text)
        if len(parts) > 1:
            return [line for part in _gathered(parts, width, size) for line in folded(part, width, size)]
    return [text]


def _gathered(parts: list[str], width: float, size: float) -> list[str]:
    """Parts of a text, as many in a line as fit it, though not all in one."""
    lines = [parts[0]]
    for part in parts[1:]:
        longer = f"{lines[-1]} {part}"
        if text_size(marked(longer), size)[0] <= width:
            lines[-1] = longer
        else:
            lines.append(part)
    return lines
