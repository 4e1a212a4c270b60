"""The sources of a machine: a plugin's own, but those that only steps and checks name which this machine does not have."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from diecut_report.contract.chapters import Chapter
from diecut_report.contract.mechanism import Source
from diecut_report.contract.steps import Step
from diecut_report.engine import Calculation
from diecut_report.results.checks import applies, checks_of


def cited_sources(calc: Calculation) -> list[dict[str, Any]]:
    """Return the works that the calculation rests on; papers, which are numbered, and what no step names, always."""
    mechanism = calc.mechanism
    every = {step.source for _, step in mechanism.steps} | {check.source for check in mechanism.checks}
    used = {text for chapter, step in mechanism.active(calc.given) for text in _texts(chapter, step)}
    used |= {check.source for check in checks_of(calc) if applies(calc, check)} | {
        *mechanism.assumptions,
        mechanism.summary,
    }
    kept = [
        each for each in mechanism.sources if _is_named(each, used) or not _is_named(each, every) or each.id.isdigit()
    ]
    return [{"id": source.id, "citation": source.citation} for source in kept]


def _is_named(source: Source, texts: Collection[str]) -> bool:
    return any(source.id in text for text in texts)


def _texts(chapter: Chapter, step: Step) -> tuple[str, ...]:
    """What is said of a step that may name a source."""
    return chapter.text, step.source, step.description, getattr(step, "method", "")
