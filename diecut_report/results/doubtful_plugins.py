"""What is said of results that a plugin of somebody else gave though its formulas have faults."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from diecut_report.languages.phrases import Phrase


def doubtful(results: Mapping[str, Any]) -> list[str]:
    """Return in words which foreign plugins of a report have faults in their formulas, and what tells them."""
    mechanisms = results["mechanisms"].values()
    kinds = dict.fromkeys(each["kind"] for each in mechanisms if each.get("plugin_check") == "failed")
    words = "The formulas of the plugin of {kind} have faults, which `diecut-report check-plugin {name}` tells."
    return [Phrase(words, kind=repr(kind), name=kind) for kind in kinds]
