"""Files that are written beside a report, by what the results say of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

ENDINGS = ("dxf", "csv")


def suffixes(instance: str, export: Mapping[str, Any]) -> dict[str, str]:
    """What follows the report's name in the names of an export's files, by their endings: ``feeder.cam_1.dxf``; a table has no drawing."""
    endings = ENDINGS[1:] if export["type"] == "table" else ENDINGS
    return {ending: f"{instance}.{export['id']}.{ending}" for ending in endings}
