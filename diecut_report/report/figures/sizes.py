"""How large figures are: alone on a page that has room for all, alone and lower, one of two side by side, or a sketch."""

from __future__ import annotations

from enum import Enum

from diecut_report.report.figures.style import MM


class Size(Enum):
    """The place that a figure has on the page."""

    LARGE = "large"
    LOW = "low"
    HALF = "half"
    SKETCH = "sketch"


WIDTHS = {  # in points
    Size.LARGE: 172 * MM,
    Size.LOW: 172 * MM,
    Size.HALF: 84 * MM,
    Size.SKETCH: 172 * MM,
}
WIDEST_HALF = 98 * MM  # a drawing with its texts, which is set a little smaller then
