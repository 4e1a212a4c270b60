"""What a report adds to a calculation: which assumed values matter, what comes of the advice, and how inputs move results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from diecut_report.config.loader import Config
from diecut_report.press import CalculatedPress
from diecut_report.results.model import ResultsRecord
from diecut_report.text.phrases import phrase


def with_findings(made: CalculatedPress) -> CalculatedPress:
    """Return a calculated press with what its report adds; one of which a plugin broke as it is."""
    press = made.press
    return made if made.has_broken else replace(made, results=findings(press.config, made.results, press.tell))


def findings(config: Config, results: ResultsRecord, tell: Callable[[str], None]) -> ResultsRecord:
    """Return the results of a configuration with what their report adds."""
    from diecut_report.design.advised import followed  # with searches, which a calculation alone does not need
    from diecut_report.design.influence import influenced
    from diecut_report.study.analysis.answers import moves

    summary = results.summary
    if summary.assumed:
        tell(phrase("evaluating the influence of assumed inputs"))
        summary = summary.with_(moves=moves(config, results))
    if summary.fail:
        tell(phrase("applying the advice"))
        summary = summary.with_(advice=followed(config, results))
    if not config.report.influence:
        return results.with_(summary=summary)
    tell(phrase("varying one input at a time"))
    return results.with_(summary=summary, influence=influenced(config))
