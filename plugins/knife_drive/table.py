"""The comparison as a table: a line for each quantity, a column for each drive."""

from __future__ import annotations

from diecut_report.api import Shape, View, box, told
from diecut_report.plugins.knife_drive.working import ALL

LINES = (
    ("Stroke", "stroke", "mm"),
    ("Working stroke", "working_angle", "deg"),
    ("Its duration", "working_time", "ms"),
    ("Speed at contact", "contact_velocity", "m/s"),
    ("Greatest acceleration", "acceleration_peak", "m/s**2"),
    ("Acceleration at the end", "acceleration_end", "m/s**2"),
    ("Acceleration in the grip", "grip_acceleration", "m/s**2"),
    ("Time on the table", "table_time", "ms"),
)
FIRST, OTHER, HIGH = 1.5, 1.6, 0.3  # widths of the columns, height of a line
GAP = 0.06  # between boxes


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
    return shapes


def _cell(view: View, name: str, unit: str) -> str:
    """A number, and its ratio to the best drive's where there is one; the time on the table beside what there is of it."""
    if name.endswith("table_time"):
        return f"{told(view[name], unit)} of {told(view['signature_interval'], unit)}"
    ratio = view.get(f"{name}_ratio", 0.0)
    return f"{told(view[name], unit)} (× {ratio:.2f})" if ratio else told(view[name], unit)
