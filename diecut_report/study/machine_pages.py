"""The summary of many machines, as pages and tables."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from markupsafe import Markup

from diecut_report import __version__
from diecut_report.files import room
from diecut_report.report.pages import html, pdf
from diecut_report.report.pages.page_engine import HTML, URLFetcher
from diecut_report.report.text import Catalogue
from diecut_report.study.machines import STATES, MachineComparison, Verdict
from diecut_report.study.storage.spreadsheets import workbook
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import localised, said, say, spoken_language

NAME = "machines"
HEADS = (
    phrase("machine"), phrase("verdict"), phrase("governing check"), phrase("utilisation"), phrase("failed"),
    phrase("not checked"), phrase("warnings"), phrase("assumed"), phrase("file"), phrase("what is wrong"),
)  # fmt: skip


Rows = list[list[Any]]


def page(made: MachineComparison) -> bytes:
    """Return the comparison as one self-contained HTML page."""
    return _filled(made, "screen").encode()


def sheets(made: MachineComparison) -> bytes:
    """Return the comparison as PDF (PDF/UA-1)."""
    fetcher = URLFetcher(allowed_protocols={"data"}, allow_redirects=False, fail_on_errors=True)
    with room(), pdf._without_collection():
        content: bytes = HTML(string=_filled(made, "print"), url_fetcher=fetcher).write_pdf(pdf_variant="pdf/ua-1")
    return content


def _filled(made: MachineComparison, kind: str) -> str:
    faces = html._font_faces(tuple(html.FACES.items()))
    style = "\n".join(
        [
            faces,
            *(
                html._read(f"{name}.css")
                for name in ("report", kind, *(["strip"] if kind == "print" else []), "summary", "machines")
            ),
        ]
    )
    language = spoken_language()
    return html._environment().get_template("summary_machines.html.j2").render(
        c=made, t=Catalogue(language), language=language, kind=kind, say=say, said=said, states=STATES, policy=html.policy(""),
        style=Markup(style), version=__version__, shown=shown, utilised=utilised,
    )  # fmt: skip


def shown(cell: dict[str, Any] | None) -> str:
    """Return a check of a machine as a cell: its utilisation in per cent, or its verdict; nothing where it is not made."""
    if cell is None:
        return ""
    return said(STATES[cell["status"]]) if cell["utilisation"] is None else utilised(cell["utilisation"])


def utilised(share: float) -> str:
    """Return a utilisation in per cent."""
    return localised(f"{100 * share:.4g} %")


def table(made: MachineComparison) -> bytes:
    """Return the verdicts, the matrix of checks, the inputs that differ and the advice as one CSV, each below its heads."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for rows in _tables(made).values():
        writer.writerows(rows)
        writer.writerow([])
    return text.getvalue().encode()


def _tables(made: MachineComparison) -> dict[str, Rows]:
    return {
        say("verdicts"): [[*map(said, HEADS)], *map(_verdict, made.verdicts)],
        say("checks"): [[say("check"), say("title"), *made.machines],
                   *([name, title, *map(_cell, cells)] for name, title, cells in made.checks)],
        say("differing inputs"): [[say("input"), say("description"), *made.machines],
                             *([path, told, *cells] for path, told, cells in made.inputs)],
        say("advice"): [[say("machine"), say("advice")], *([name, each] for name, told in made.advice for each in told)],
    }  # fmt: skip


def _verdict(of: Verdict) -> list[Any]:
    return [
        of.machine,
        said(STATES[of.face]),
        of.governing,
        of.utilisation,
        of.failed,
        of.not_checked,
        of.warnings,
        of.assumed,
        of.file,
        "\n".join(map(said, of.words)),
    ]


def _cell(cell: dict[str, Any] | None) -> str:
    """A check in a table: its verdict with its utilisation."""
    if cell is None:
        return ""
    used = "" if cell["utilisation"] is None else localised(f" {cell['utilisation']:.6g}")
    return said(STATES[cell["status"]]) + used


def _json(made: MachineComparison) -> bytes:
    return (json.dumps(made.as_data(), indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


FORMATS: dict[str, Callable[[MachineComparison], bytes]] = {
    "html": page, "pdf": sheets, "xlsx": lambda made: workbook(_tables(made)), "csv": table, "json": _json,
}  # fmt: skip


def files(
    made: MachineComparison, folder: Path, formats: list[str], neutral: MachineComparison | None = None
) -> Iterator[tuple[Path, bytes]]:
    """Yield the files of a comparison, all made before any is written; ``neutral`` is the same in English, for JSON."""
    sides = {"json": neutral or made}
    yield from [(folder / f"{NAME}.{ending}", FORMATS[ending](sides.get(ending, made))) for ending in formats]
