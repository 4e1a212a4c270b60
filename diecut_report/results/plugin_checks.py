"""Whether the plugin of somebody else that gave results was found sound: what ``plugin_check`` of a mechanism's results says."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

FOUND = ("passed", "failed")


def found_check(mechanism: Mapping[str, Any]) -> str:
    """Return ``passed`` or ``failed``; nothing for what was not judged, as what comes with the program."""
    found = mechanism.get("plugin_check", "")
    return found if found in FOUND else ""


def is_doubtful(mechanism: Mapping[str, Any]) -> bool:
    """Return whether the formulas of a mechanism's (or comparison's) plugin have faults."""
    return found_check(mechanism) == "failed"


def calculated(results: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return all that plugins gave of a press: its mechanisms and comparisons."""
    return [*results["mechanisms"].values(), *results.get("comparisons", {}).values()]
