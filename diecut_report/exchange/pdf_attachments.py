"""Reads a file that is attached to a PDF, whoever made it: bounded, and without repairing what is damaged."""

from __future__ import annotations

import io
from functools import cache

import pikepdf
from pikepdf import settings

from diecut_report.errors import Problem, UserError
from diecut_report.exchange.pdf_faults import PDF_FAULTS
from diecut_report.languages.phrases import Phrase, phrase

MOST_ITEMS = 1_000_000  # of an array or a dictionary
MOST_WARNINGS = 100
DEEPEST = 100
FAULTS = (pikepdf.PdfError, *PDF_FAULTS)
"""What the library raises for a file that is not as the standard has it."""


def attachment(content: bytes, name: str, most: int, file: str) -> bytes | None:
    """Return the attachment of a name, None where the PDF has none; UserError where it cannot be read, or is larger than ``most``."""
    bounded(most)
    try:
        with pikepdf.open(io.BytesIO(content), attempt_recovery=False, suppress_warnings=True) as pdf:
            return _found(pdf, name, most, file)
    except pikepdf.PasswordError as error:
        words = phrase("The PDF is encrypted, and opens only with a password. Give one without.")
        raise UserError(Problem(words, file)) from error
    except FAULTS as error:
        words = Phrase(
            "The PDF is damaged, or holds more than {most} MB in one piece. Give the file as the program wrote it.",
            most=format(most / 1000000.0, "g"),
        )
        raise UserError(Problem(words, file)) from error


@cache
def bounded(most: int) -> None:
    """Let the library unpack no more than so much of any stream, be it one that only tells where the objects stand."""
    settings.set_qpdf_limits(
        doc_max_warnings=MOST_WARNINGS, parser_max_nesting=DEEPEST, parser_max_container_size=MOST_ITEMS,
        flate_max_memory=most, png_max_memory=most, run_length_max_memory=most, tiff_max_memory=most, dct_max_memory=most,
    )  # fmt: skip


def _found(pdf: pikepdf.Pdf, name: str, most: int, file: str) -> bytes | None:
    names = pdf.Root.get("/Names", pikepdf.Dictionary())
    if "/EmbeddedFiles" not in names:
        return None
    # the names only tell which attachment it is; nothing is written under them
    found = [spec for label, spec in pikepdf.NameTree(names["/EmbeddedFiles"]).items() if label == name]
    if not found:
        return None
    content = found[0]["/EF"]["/F"].read_bytes()
    if len(content) > most:
        words = Phrase(
            "What is attached is too large: {count} MB; at most {most} MB are taken.",
            count=format(len(content) / 1000000.0, ".1f"),
            most=format(most / 1000000.0, "g"),
        )
        raise UserError(Problem(words, file))
    return bytes(content)
