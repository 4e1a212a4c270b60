"""One side of a comparison: the results of a report or a results file as they stand, those of a configuration by calculating it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.errors import PluginError
from diecut_report.exchange.carried_results import MOST, carried_results, form_of
from diecut_report.exchange.results_form import parsed
from diecut_report.given_files import content
from diecut_report.languages.phrases import phrase
from diecut_report.results.results_file import encoded


def side(
    given: pipeline.Source, discovery: Discovery, tell: Callable[[str], None]
) -> tuple[dict[str, Any], tuple[PluginError, ...]]:
    """Return the results of one side, and the plugins that broke where it was calculated; UserError where it cannot be read."""
    if isinstance(given, Path) and _carries_results(given):
        return carried_results(given).results, ()
    outcome, text = pipeline.calc(given, discovery, tell)
    return parsed(encoded(text), ""), outcome.broken


def _carries_results(path: Path) -> bool:
    """Whether a file is a report or a results file; a configuration may be written as JSON too."""
    whole = content(path, MOST, phrase("a configuration, a results file or a report"))
    form = form_of(whole)
    return form in ("pdf", "html") or (form == "json" and b'"program"' in whole and b'"mechanisms"' in whole)
