"""The results that a file carries: a report as PDF or HTML, or a results file. What the file is, its content tells, not its name."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from diecut_report.config.logo import logo_fault
from diecut_report.config.own_tables import name_fault
from diecut_report.errors import Problem, UserError
from diecut_report.exchange.html_links import linked_results
from diecut_report.exchange.results_form import results_of
from diecut_report.given_files import content
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.results.results_file import config_content, logo_content, table_contents

MOST = 200_000_000  # bytes of a report
MOST_RESULTS = 100_000_000  # bytes of the results in it
LONGEST_NAME = 255  # of a file, in bytes
BLANK = b" \t\r\n"
BOM = b"\xef\xbb\xbf"
Form = Literal["pdf", "html", "json"]


@dataclass(frozen=True)
class CarriedResults:
    """Hold the results of a file, the bytes of their own file, and those of the configuration; ``content`` is the whole file.

    ``tables`` are the user's own that the configuration names, and its logo, by these names, which lead nowhere but beside it and below;
    ``former_tables`` those of the former revision, since which the report shows changes.
    """

    path: Path
    form: Form
    content: bytes
    results: dict[str, Any]
    results_content: bytes
    config_content: bytes
    tables: dict[str, bytes]
    former_tables: dict[str, bytes]


def carried_results(path: Path) -> CarriedResults:
    """Return what a report or a results file carries; UserError where it is neither, or cannot be read."""
    whole = content(path, MOST, phrase("a report (PDF, HTML) or a results file (JSON)"))
    form = form_of(whole)
    if form is None:
        words = phrase(
            "This is neither a report (PDF, HTML) nor a results file (JSON). Give a file that "
            "`diecut-report report` wrote."
        )
        raise UserError(Problem(words, str(path)))
    found = _results_content(whole, form, str(path))
    results = results_of(found, str(path))
    config, tables = _config(whole, form, results, str(path)), _tables(results, str(path))
    former = _tables({"config": results["former"]}, str(path)) if results.get("former") else {}
    return CarriedResults(path, form, whole, results, found, config, tables, former)


def form_of(whole: bytes) -> Form | None:
    """Return what a file is by its first letters; None where it is neither a report nor JSON."""
    start = whole[:1024].removeprefix(BOM).lstrip(BLANK)
    forms: dict[bytes, Form] = {b"%PDF-": "pdf", b"<": "html", b"{": "json"}
    return next((form for letters, form in forms.items() if start.startswith(letters)), None)


def _results_content(whole: bytes, form: Form, file: str) -> bytes:
    if form == "json":
        found: bytes | None = whole
        if len(whole) > MOST_RESULTS:
            words = Phrase(
                "The file is too large: {count} MB; results have at most {most_results} MB.",
                count=format(len(whole) / 1000000.0, ".1f"),
                most_results=format(MOST_RESULTS / 1000000.0, "g"),
            )
            raise UserError(Problem(words, file))
    elif form == "html":
        found = linked_results(whole, MOST_RESULTS, file)
    else:
        found = _attached(whole, "results.json", file)
    if found is None:
        words = phrase(
            "This file carries no results: another program made it, or an earlier version of diecut-report, "
            "or it was printed anew."
        )
        raise UserError(Problem(words, file))
    return found


def _attached(whole: bytes, name: str, file: str) -> bytes | None:
    from diecut_report.exchange.pdf_attachments import attachment  # with the library, which others do not need

    return attachment(whole, name, MOST_RESULTS, file)


def _config(whole: bytes, form: Form, results: dict[str, Any], file: str) -> bytes:
    """The configuration in the results; that of the PDF, which is attached for a reader's convenience, must be the same."""
    found = config_content(results)
    if form == "pdf" and _attached(whole, "config.yaml", file) not in (None, found):
        words = phrase(
            "The configuration that is attached is not the one in the attached results. Somebody has "
            "exchanged one of the two."
        )
        raise UserError(Problem(words, file))
    return found


def _tables(results: dict[str, Any], file: str) -> dict[str, bytes]:
    found, logo = table_contents(results), logo_content(results)
    faults = [
        Problem(Phrase("The name of a table {fault}.", fault=fault), file)
        for name in found
        if (fault := name_fault(name))
    ]
    faults += [
        Problem(Phrase("The name of the logo {fault}.", fault=fault), file)
        for name in logo
        if (fault := logo_fault(name))
    ]
    found |= logo
    long = [name for name in found if max(len(part.encode()) for part in Path(name).parts) > LONGEST_NAME]
    faults += [
        Problem(
            Phrase(
                "The name of a file is longer than {longest_name} bytes: {name}….",
                longest_name=LONGEST_NAME,
                name=name[:80],
            ),
            file,
        )
        for name in long
    ]
    if faults:
        raise UserError(faults)
    return found
