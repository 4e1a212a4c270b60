"""Pages about many variants or machines: one self-contained HTML file each, and the same as PDF."""

from __future__ import annotations

from typing import Any

from markupsafe import Markup

from diecut_report import __version__
from diecut_report.files import room
from diecut_report.report.pages import html, pdf
from diecut_report.report.pages.page_engine import HTML, URLFetcher
from diecut_report.report.text import Catalogue
from diecut_report.results.results_file import encoded
from diecut_report.text.translation import said, say, spoken_language


def filled(template: str, kind: str, styles: tuple[str, ...], script: str = "", **values: Any) -> str:
    """Return a template as one self-contained HTML page, for the ``screen`` or for ``print``; ``styles`` come after those of a report.

    What no page can hold, bytes of a file's name that are not UTF-8, stands as an escape.
    """
    sheets = ("report", kind, *(["strip"] if kind == "print" else []), *styles)
    style = "\n".join([html._font_faces(tuple(html.FACES.items())), *(html._read(f"{name}.css") for name in sheets)])
    page = html._environment().get_template(template).render(
        t=Catalogue(spoken_language()), language=spoken_language(), kind=kind, policy=html.policy(script), style=Markup(style),
        version=__version__, say=say, said=said, **values,
    )  # fmt: skip
    return encoded(page).decode()


def printed(source: str) -> bytes:
    """Return a page as PDF (A4, PDF/UA-1)."""
    fetcher = URLFetcher(allowed_protocols={"data"}, allow_redirects=False, fail_on_errors=True)
    with room(), pdf._without_collection():
        content: bytes = HTML(string=source, url_fetcher=fetcher).write_pdf(pdf_variant="pdf/ua-1")
    return content
