"""WeasyPrint, imported without a search for its libraries by a compiler, and the objects that it writes a PDF of."""

from collections.abc import Iterator
from contextlib import contextmanager

from diecut_report.errors import Problem, UserError
from diecut_report.report.surroundings import no_compiler

with no_compiler():
    from pydyf import Array, Dictionary, Stream, String
    from weasyprint import HTML, Attachment
    from weasyprint.urls import FatalURLFetchingError, URLFetcher

__all__ = ["HTML", "Array", "Attachment", "Dictionary", "Stream", "String", "URLFetcher", "fetching_refused"]


@contextmanager
def fetching_refused(folder: str) -> Iterator[None]:
    """Tell in words what a page asks for from elsewhere, which the templates of this folder brought in."""
    try:
        yield
    except FatalURLFetchingError as error:  # no Exception: it would pass by all who tell of faults
        if not folder:
            raise RuntimeError(str(error)) from error
        raise UserError(
            Problem(f"{error}: a report fetches nothing. Put what it needs into the folder.", folder)
        ) from error
