"""WeasyPrint, imported without a search for its libraries by a compiler."""

from diecut_report.report.surroundings import no_compiler

with no_compiler():
    from weasyprint import HTML, Attachment
    from weasyprint.urls import URLFetcher

__all__ = ["HTML", "Attachment", "URLFetcher"]
