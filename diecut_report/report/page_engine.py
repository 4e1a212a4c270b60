"""WeasyPrint, imported without a search for its libraries by a compiler, and the objects that it writes a PDF of."""

from typing import Any

from diecut_report.report.surroundings import no_compiler

with no_compiler():
    from cssselect2 import ElementWrapper
    from pydyf import PDF, Array, Dictionary, Object, Stream, String
    from weasyprint import HTML, Attachment
    from weasyprint.html import UA_STYLESHEET
    from weasyprint.urls import URLFetcher

__all__ = [
    "HTML",
    "UA_STYLESHEET",
    "Array",
    "Attachment",
    "Dictionary",
    "ElementWrapper",
    "Object",
    "Stream",
    "String",
    "URLFetcher",
]


def _references(pdf: Any) -> tuple[bytes, ...]:
    """The references of a document's pages, which the page engine asks for at each element of its structure, and would make anew each time."""
    if len(pdf.__dict__.get("references", ())) != pdf.pages["Count"]:
        pdf.references = tuple(f"{number} 0 R".encode("ascii") for number in pdf.pages["Kids"][::3])
    references: tuple[bytes, ...] = pdf.references
    return references


PDF.page_references = property(_references)
