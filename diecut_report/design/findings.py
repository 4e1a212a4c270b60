"""What a report adds to a calculation: which assumed values are harmless, what comes of the advice, and how inputs move results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from diecut_report.config.loader import Config
from diecut_report.press import CalculatedPress
from diecut_report.results.conclusion import VALUES, rejudged
from diecut_report.results.model import ResultsRecord
from diecut_report.text.phrases import phrase


def with_findings(made: CalculatedPress) -> CalculatedPress:
    """Return a calculated press with what its report adds; one of which a plugin broke as it is."""
    press = made.press
    return made if made.has_broken else replace(made, results=findings(press.config, made.results, press.tell))


def decided(made: CalculatedPress) -> CalculatedPress:
    """Return a calculated press with what is proved harmless, where nothing else keeps its verdict from a pass."""
    summary = made.results.summary
    if made.broken or summary.verdict != "conditional" or any(each.what not in VALUES for each in summary.open):
        return made
    return replace(made, results=_proved(made.press.config, made.results, made.press.tell))


def _proved(config: Config, results: ResultsRecord, tell: Callable[[str], None]) -> ResultsRecord:
    """The results without the open values that are harmless."""
    from diecut_report.design.harmless import without_harmless

    tell(phrase("trying assumed and default values"))
    found = results.with_(summary=results.summary.with_(open=without_harmless(config, results), tried=True))
    return found.with_(summary=rejudged(found))


def findings(config: Config, results: ResultsRecord, tell: Callable[[str], None]) -> ResultsRecord:
    """Return the results of a configuration with what their report adds."""
    from diecut_report.design.advised import followed  # with searches, which a calculation alone does not need
    from diecut_report.design.influence import influenced

    # once: of values that only together change a check the others were proved with these as they are;
    # of a machine that fails all stay open, as what it is changed into has other checks near their limits
    if not (results.summary.fail or results.summary.tried):
        results = _proved(config, results, tell)
    summary = results.summary
    if summary.fail:
        tell(phrase("applying the advice"))
        summary = summary.with_(advice=followed(config, results))
    if not config.report.influence:
        return results.with_(summary=summary)
    tell(phrase("varying one input at a time"))
    return results.with_(summary=summary, influence=influenced(config))
