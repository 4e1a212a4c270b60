"""A report made again from its results alone, whoever wrote them: nothing is calculated, and what cannot be set is told in words."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.errors import Problem, UserError
from diecut_report.exchange.carried_results import carried_results
from diecut_report.exchange.other_forms import other_form
from diecut_report.files import write_all
from diecut_report.languages.catalogues import Catalogues
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.limits import MAX_PRINTED_MECHANISMS
from diecut_report.report.house_style import HouseStyle
from diecut_report.results.doubtful_plugins import doubtful

TEMPLATE = "template_sha256"
Contents = dict[str, bytes]
Tell = Callable[[str], None]


def render(
    file: Path,
    folder: Path,
    formats: Sequence[str],
    tell: Tell,
    discovery: Discovery,
    language: str | None = None,
    house: HouseStyle | None = None,
) -> tuple[pipeline.ReportOutcome, list[pipeline.Lost]]:
    """Write the report of a results file, or of a report, as ``STEM.html``, ``STEM.pdf`` and the exports beside it.

    Return what was written, and the figures and exports that could not be drawn. UserError where nothing can be made of the file.
    """
    carried = carried_results(file)
    pipeline.AskedReport(language).told(carried.results)
    if template_of(carried.results) or house:  # the pages are set with other templates than those were
        asked = carried.results.get("report")
        kept = {key: value for key, value in asked.items() if key != TEMPLATE} if isinstance(asked, dict) else {}
        carried.results["report"] = kept | ({TEMPLATE: house.sha256} if house else {})
    catalogues = pipeline.catalogues_of(carried.results, discovery, formats, str(file))
    contents, lost = document(carried.results, formats, tell, str(file), catalogues, house)
    beside, unwritten = pipeline.exported(carried.results, tell)
    files = {folder / f"{file.stem}.{ending}": content for ending, content in (contents | beside).items()}
    write_all(files, keep=file)
    warnings = (*pipeline.untranslated(carried.results, catalogues), *doubtful(carried.results))
    return pipeline.ReportOutcome(carried.results, tuple(files), (), warnings), [*lost, *unwritten]


def template_of(results: dict[str, Any]) -> str:
    """Return the hash of the templates that a report was set with; nothing where they are the program's alone."""
    asked = results.get("report")
    return str(asked.get(TEMPLATE, "")) if isinstance(asked, dict) else ""


def document(
    results: dict[str, Any],
    formats: Sequence[str],
    tell: Tell,
    file: str,
    catalogues: Catalogues | None = None,
    house: HouseStyle | None = None,
) -> tuple[Contents, list[pipeline.Lost]]:
    """Return a document in its formats, and what of it could not be drawn; UserError where these are not results of the program."""
    _refuse_many_sheets(results, formats, file)
    try:
        return pipeline.rendered(results, formats, tell, catalogues, house)
    except UserError:
        raise
    except Exception as cause:  # of any kind: whoever wrote the file may have put anything in any place
        words = Phrase(
            "The report cannot be made of these results: {told}. Give results as the program wrote them.",
            told=_told(cause),
        )
        why = other_form(results)
        raise UserError([Problem(words, file), *([Problem(why, file)] if why else [])]) from cause


def told(lost: Iterable[pipeline.Lost]) -> list[str]:
    """Return in words what could not be drawn."""
    return [
        Phrase(
            "{what} {id} of mechanism {mechanism} cannot be drawn: {words}",
            what=phrase(each.what),
            id=repr(each.id),
            mechanism=repr(each.mechanism),
            words=phrase(each.words),
        )
        for each in lost
    ]


def _told(cause: Exception) -> str:
    if isinstance(cause, KeyError):
        return Phrase("{cause} is missing", cause=cause)
    return f"{type(cause).__name__}: {cause}"


def _refuse_many_sheets(results: dict[str, Any], formats: Sequence[str], file: str) -> None:
    count = len(results["mechanisms"])
    if "pdf" in formats and count > MAX_PRINTED_MECHANISMS:
        words = Phrase(
            "There are {count} mechanisms; a PDF has at most {most}. Leave it out with --format html.",
            count=count,
            most=MAX_PRINTED_MECHANISMS,
        )
        raise UserError(Problem(words, file))
