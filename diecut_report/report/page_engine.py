"""WeasyPrint, imported without a search for its libraries by a compiler, and the objects that it writes a PDF of."""

from diecut_report.report.surroundings import no_compiler

with no_compiler():
    from pydyf import Array, Dictionary, Stream, String
    from weasyprint import HTML, Attachment
    from weasyprint.urls import URLFetcher

__all__ = ["HTML", "Array", "Attachment", "Dictionary", "Stream", "String", "URLFetcher"]
