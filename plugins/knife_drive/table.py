"""The comparison as a table: a line for each quantity, a column for each drive, the verdict in words below."""

from __future__ import annotations

from textwrap import wrap

from diecut_report.api import Phrase, Shape, View, box, phrase, told
from diecut_report.plugins.knife_drive.working import ALL

LINES = (
    (phrase("Working stroke"), "working_angle", "deg"),
    (phrase("Its duration"), "working_time", "ms"),
    (phrase("Speed at contact"), "contact_velocity", "m/s"),
    (phrase("Maximum acceleration"), "acceleration_peak", "m/s**2"),
    (phrase("Acceleration at the end"), "acceleration_end", "m/s**2"),
    (phrase("Stroke"), "stroke", "mm"),
    (phrase("Factor"), "end_factor", "1"),
    (phrase("Acceleration in the grip"), "grip_size", "m/s**2"),
    (phrase("Time on the table"), "table_time", "ms"),
)
FIRST, OTHER, HIGH = 1.5, 1.6, 0.3  # widths of the columns, height of a line
GAP = 0.06  # between boxes
LETTERS = 15  # on a width of one


def table(view: View) -> list[Shape]:
    """Boxes of a table."""
    drives = [drive for drive in ALL if f"{drive.key}_stroke" in view]
    rows = [("", [drive.name for drive in drives])]
    rows += [(title, [_cell(view, f"{drive.key}_{name}", unit) for drive in drives]) for title, name, unit in LINES
             if f"{drives[0].key}_{name}" in view]  # fmt: skip
    shapes = []
    for index, (title, cells) in enumerate(rows):
        y, role = -index * HIGH, "body" if index == 0 else "outline"
        shapes.append(box((FIRST / 2, y), FIRST - GAP, HIGH - GAP, [title] if title else ["Drive"], "body"))
        shapes += [
            box((FIRST + (i + 0.5) * OTHER, y), OTHER - GAP, HIGH - GAP, [cell], role) for i, cell in enumerate(cells)
        ]
    width = FIRST + OTHER * len(drives)
    words = _verdicts(view)
    high = HIGH * sum(len(wrap(text, int(width * LETTERS))) for text in words)
    below = -HIGH * (len(rows) - 0.5) - high / 2
    return [*shapes, box((width / 2, below), width - GAP, high - GAP, words, "body")]


def _verdicts(view: View) -> list[str]:
    """Which drive is best, and why the planetary drive differs from the best other one."""
    found: list[str] = [Phrase("Verdict: {verdict}.", verdict=view.word("verdict"))]
    if "acceleration_ratio_planetary" in view:
        stroke, factor = view["stroke_ratio_planetary"], view["factor_ratio_planetary"]
        found.append(
            Phrase(
                "Planetary drive compared with the best other one at the end: {stroke} = {stroke_2} (stroke) × "
                "{factor} (factor); {reason}.",
                stroke=f"{stroke * factor:.2f}",
                stroke_2=f"{stroke:.2f}",
                factor=f"{factor:.2f}",
                reason=view.word("reason"),
            )
        )
    return found


def _cell(view: View, name: str, unit: str) -> str:
    """A number, and its ratio to the best drive's where there is one; the time on the table beside what there is of it."""
    if name.endswith("table_time"):
        return Phrase(
            "{time} of {interval}", time=told(view[name], unit), interval=told(view["signature_interval"], unit)
        )
    ratio = view.get(f"{name}_ratio", 0.0)
    return f"{told(view[name], unit)} (× {ratio:.2f})" if ratio else told(view[name], unit)
