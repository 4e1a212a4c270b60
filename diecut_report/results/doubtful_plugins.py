"""What is said of results that a plugin of somebody else gave though its formulas have faults."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from diecut_report.config.discovery import Discovery
from diecut_report.config.source_hashes import plugin_faults
from diecut_report.languages.phrases import Counted, Phrase
from diecut_report.results.plugin_checks import calculated, is_doubtful

TOLD = 3  # faults of a plugin that are told


def doubtful_kinds(results: Mapping[str, Any]) -> list[str]:
    """Return the kinds of a report whose foreign plugins have faults in their formulas."""
    return list(dict.fromkeys(each["kind"] for each in calculated(results) if is_doubtful(each)))


def doubtful(results: Mapping[str, Any], discovery: Discovery | None = None) -> list[str]:
    """Return in words which foreign plugins of a report have faults in their formulas, with the first that are known here."""
    known = discovery.origins if discovery else {}
    found = {
        kind: discovery.mechanism(kind) if discovery and kind in known else None for kind in doubtful_kinds(results)
    }
    return [line for kind, mechanism in found.items() for line in told_faults(kind, plugin_faults(mechanism))]


def told_faults(kind: str, faults: Sequence[str]) -> list[str]:
    """Return what is said of a plugin whose formulas have faults, and below it the first of them with file and line."""
    words = "The formulas of the plugin of {kind} have faults; do not rely on its results."
    lines: list[str] = [Phrase(words, kind=repr(kind)), *(f"  {fault}" for fault in faults[:TOLD])]
    if (more := len(faults) - TOLD) > 0:
        one = "  {n} more fault, which `diecut-report check-plugin {kind}` tells"
        many = "  {n} more faults, which `diecut-report check-plugin {kind}` tells"
        lines.append(Counted(more, one, many, kind=kind))
    return lines
