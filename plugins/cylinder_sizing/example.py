"""Example of an impression cylinder: that of source 000, with the bore that it needs, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock

EXAMPLE = ExampleBlock(
    "cylinder",
    {
        "working_length": "${press.sheet.width}",
        "segment_height": "40 mm",
        "generatrix_length": "${press.sheet.length}",
        "bore_radius": "60 mm",
        "bearing_span": {"value": "${press.sheet.length} + 160 mm", "basis": "assumed"},
        "allowable_deflection": "0.05 mm",
    },
)
