"""The results that a file carries: a report as PDF or HTML, or a results file. What the file is, its content tells, not its name."""

from __future__ import annotations

import base64
import binascii
import os
import re
import zlib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Literal

from diecut_report.config.own_tables import logo_fault, name_fault, table_faults
from diecut_report.errors import Problem, UserError, refusal
from diecut_report.exchange.results_form import results_of
from diecut_report.files import content, write_all
from diecut_report.results.model import CarriedConfigRecord, ResultsRecord
from diecut_report.results.results_file import source_content
from diecut_report.text.phrases import Phrase, phrase

# Reads the results that an HTML report carries, from the one link that the program writes; nothing of the page is run or fetched.


LINK = re.compile(rb'download="results\.json\.gz" href="data:application/gzip;base64,([A-Za-z0-9+/]*={0,2})"')
GZIP = 16 + zlib.MAX_WBITS
DAMAGED = phrase("The results that the page carries are damaged. Give the file as the program wrote it.")


def linked_results(content: bytes, most: int, file: str) -> bytes | None:
    """Return the results file in a page, None where it carries none; UserError where it carries two, or a damaged or too large one."""
    found = LINK.findall(content)
    if not found:
        return None
    if len(found) > 1:
        template = (
            "The page carries {count} results files, and a report has one. Give the file as the program wrote it."
        )
        raise refusal(template, file, count=len(found))
    unpacking = zlib.decompressobj(GZIP)
    try:
        content = unpacking.decompress(base64.b64decode(found[0], validate=True), most + 1)
    except (binascii.Error, zlib.error) as error:
        raise refusal(DAMAGED, file) from error
    if len(content) > most:
        template = "What the page carries is too large: it unpacks to more than {most} MB."
        raise refusal(template, file, most=f"{most / 1e6:g}")
    if not unpacking.eof or unpacking.unused_data:
        raise refusal(DAMAGED, file)
    return content


MOST = 200_000_000  # bytes of a report
MOST_RESULTS = 100_000_000  # bytes of the results in it
LONGEST_NAME = 255  # of a file, in bytes
BLANK = b" \t\r\n"
BOM = b"\xef\xbb\xbf"
Form = Literal["pdf", "html", "json"]
ENDINGS: Mapping[Form, tuple[str, ...]] = {"pdf": (".pdf",), "html": (".html", ".htm"), "json": (".json",)}


@dataclass(frozen=True)
class CarriedResults:
    """Hold the results of a file, and the bytes of their own file; ``content`` is the whole file.

    ``tables`` are the user's own that the configuration names, and its logo, by these names, which lead nowhere but beside it and below;
    ``former_tables`` those of the former revision, since which the report shows changes.
    """

    path: Path
    form: Form
    content: bytes
    results: ResultsRecord
    results_content: bytes
    tables: dict[str, bytes]
    former_tables: dict[str, bytes]

    def require_own_name(self) -> None:
        """Raise UserError where the file is named as another form: what opens it by its name would show what nobody has compared."""
        ending = PurePath(self.path.name.rstrip(". ")).suffix.lower()  # Windows drops dots and blanks at the end
        if ending and ending not in ENDINGS[self.form]:
            template = "It is named {ending}, but holds what {own} files hold: opened by its name it may show something else. Rename it."
            raise refusal(template, str(self.path), ending=ending, own=ENDINGS[self.form][0])


def carried_results(path: Path) -> CarriedResults:
    """Return what a report or a results file carries; UserError where it is neither, or cannot be read."""
    whole = content(path, MOST, phrase("a report (PDF, HTML) or a results file (JSON)"))
    form = form_of(whole)
    if form is None:
        template = "This is neither a report (PDF, HTML) nor a results file (JSON). Give a file that `diecut-report report` wrote."
        raise refusal(template, path)
    found = _results_content(whole, form, str(path))
    results = results_of(found, str(path))
    attached = _attached(whole, "config.yaml", str(path)) if form == "pdf" else None  # for a reader's convenience
    if attached not in (None, source_content(results.config)):
        template = "The configuration that is attached is not the one in the attached results. Somebody has exchanged one of the two."
        raise refusal(template, path)
    tables = _tables(results.config, str(path))
    former = _tables(results.former, str(path)) if results.former else {}
    return CarriedResults(path, form, whole, results, found, tables, former)


def form_of(whole: bytes) -> Form | None:
    """Return what a file is by its first letters; None where it is neither a report nor JSON."""
    start = whole[:1024].removeprefix(BOM).lstrip(BLANK)
    forms: dict[bytes, Form] = {b"%PDF-": "pdf", b"<": "html", b"{": "json"}
    return next((form for letters, form in forms.items() if start.startswith(letters)), None)


def _results_content(whole: bytes, form: Form, file: str) -> bytes:
    if form == "json":
        found: bytes | None = whole
        if len(whole) > MOST_RESULTS:
            template = "The file is too large: {count} MB; results have at most {most_results} MB."
            raise refusal(template, file, count=f"{len(whole) / 1e6:.1f}", most_results=f"{MOST_RESULTS / 1e6:g}")
    elif form == "html":
        found = linked_results(whole, MOST_RESULTS, file)
    else:
        found = _attached(whole, "results.json", file)
    if found is None:
        template = "This file carries no results: another program made it, or an earlier version of diecut-report, or it was printed anew."
        raise refusal(template, file)
    return found


def _attached(whole: bytes, name: str, file: str) -> bytes | None:
    from diecut_report.exchange.pdf_attachments import attachments  # with the library, which others do not need

    return attachments(whole, MOST_RESULTS, file)[name]


def _tables(config: CarriedConfigRecord, file: str) -> dict[str, bytes]:
    found = {table.file: source_content(table) for table in config.materials}
    logo = {config.logo.file: base64.b64decode(config.logo.base64)} if config.logo else {}
    faults = [Phrase("The name of a table {fault}.", fault=fault) for name in found if (fault := name_fault(name))]
    faults += [Phrase("The name of the logo {fault}.", fault=fault) for name in logo if (fault := logo_fault(name))]
    found |= logo
    template = "The name of a file is longer than {longest_name} bytes: {name}…."
    long = [name for name in found if any(len(part.encode()) > LONGEST_NAME for part in Path(name).parts)]
    faults += [Phrase(template, longest_name=LONGEST_NAME, name=name[:80]) for name in long]
    if faults:
        raise UserError([Problem(fault, file) for fault in faults])
    return found


# The configuration and the results of a report as files again. Their names are the report's own, whatever stands in it.


def extract(report: Path, folder: Path) -> list[Path]:
    """Write ``STEM.yaml`` and ``STEM.json`` of a report into a folder, and the tables and the logo that the configuration names; the files.

    One that is there already stays as it is. UserError where it has another content, or where the report carries nothing that can
    be read.
    """
    found = carried_results(report)
    config = source_content(found.results.config)
    contents = {f"{report.stem}.yaml": config, f"{report.stem}.json": found.results_content}
    if doubled := [name for name, times in Counter(map(PurePath, (*contents, *found.tables))).items() if times > 1]:
        template = "The configuration names a file {doubled}, and would be called so itself. Rename the report."
        raise refusal(template, report, doubled=doubled[0])
    tables = (table.file for table in found.results.config.materials)
    if faults := [fault for name in tables for fault in table_faults(found.tables[name], name)]:
        raise UserError(faults)
    files = {folder / name: each for name, each in (contents | found.tables).items()}
    if problems := list(_refused(files, folder)):
        raise UserError(problems)
    write_all({path: each for path, each in files.items() if not os.path.lexists(path)}, keep=report)
    return list(files)


def _refused(files: Mapping[Path, bytes], folder: Path) -> Iterator[Problem]:
    for path, wanted in files.items():
        if os.path.lexists(path) and not _is_same(path, wanted):
            message = phrase("Another file of this name exists and is not overwritten: choose another folder with -o.")
            yield Problem(message, str(path))
        elif not Path(os.path.realpath(path.parent)).is_relative_to(os.path.realpath(folder)):
            message = phrase("A link leads out of the folder here, and is not followed: choose another folder with -o.")
            yield Problem(message, str(path))


def _is_same(path: Path, wanted: bytes) -> bool:
    is_alike = path.is_file() and path.stat().st_size == len(wanted)
    return is_alike and content(path, len(wanted), phrase("a file")) == wanted
