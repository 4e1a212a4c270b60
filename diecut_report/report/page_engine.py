"""WeasyPrint, imported without a search for its libraries by a compiler, and the objects that it writes a PDF of."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.report.surroundings import no_compiler

with no_compiler():
    from cssselect2 import ElementWrapper
    from pydyf import PDF, Array, Dictionary, Object, Stream, String
    from weasyprint import HTML, Attachment
    from weasyprint.html import UA_STYLESHEET
    from weasyprint.layout import block as block_layout
    from weasyprint.urls import FatalURLFetchingError, URLFetcher

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
    "block_layout",
    "told_of_page",
]


@contextmanager
def told_of_page(folder: str) -> Iterator[None]:
    """Tell in words what a page asks for from elsewhere, or cannot be set for, which the templates of this folder brought in."""
    try:
        yield
    except FatalURLFetchingError as error:  # no Exception: it would pass by all who tell of faults
        if not folder:
            raise RuntimeError(str(error)) from error
        raise UserError(
            Problem(
                Phrase("{error}: a report fetches nothing. Put what it needs into the folder.", error=error), folder
            )
        ) from error
    except (OSError, UserError):
        raise
    except Exception as error:  # of any kind: a template or a style may ask for anything
        if not folder:
            raise
        words = Phrase(
            "The sheets cannot be set with these templates: {error}. Give HTML alone, or plainer ones.",
            error=f"{type(error).__name__}: {error}",
        )
        raise UserError(Problem(words, folder)) from error


def _references(pdf: Any) -> tuple[bytes, ...]:
    """The references of a document's pages, which the page engine asks for at each element of its structure, and would make anew each time."""
    if len(pdf.__dict__.get("references", ())) != pdf.pages["Count"]:
        pdf.references = tuple(f"{number} 0 R".encode("ascii") for number in pdf.pages["Kids"][::3])
    references: tuple[bytes, ...] = pdf.references
    return references


PDF.page_references = property(_references)
