"""The summary of a batch run: what the variants say as a whole, on one page and on paper."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from diecut_report.config.plugins import Discovery
from diecut_report.study.analysis.variants import opened

FORMATS = ("html", "pdf")


def summarise(directory: Path, formats: Sequence[str] = FORMATS, discovery: Discovery | None = None) -> list[Path]:
    """Write ``summary.html`` and ``summary.pdf`` into the folder of a run, from what is stored there; gives the files.

    ``discovery`` knows the plugins that the variants were calculated by.

    UserError in words where nothing is stored or the files cannot be written; OSError where the system has no pango (PDF).
    """
    import diecut_report.report.figures  # noqa: F401  # before Matplotlib, for its settings
    from diecut_report.files import room, write_all
    from diecut_report.study.summary.content import content  # with matplotlib

    with opened(directory) as stored:
        found = content(stored, discovery or Discovery())
    from diecut_report.report.pages.pdf import printed_page  # with WeasyPrint
    from diecut_report.study.summary.content import page

    contents = {"html": lambda: page(found).encode(), "pdf": lambda: printed_page(page(found, "print"))}
    with room():
        files = {directory / f"summary.{ending}": contents[ending]() for ending in formats}
    write_all(files, keep=directory / "study.json")
    return list(files)
