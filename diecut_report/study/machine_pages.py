"""The comparison of machines as HTML (one file, no network), PDF, XLSX, CSV and JSON."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from diecut_report.study.documents import filled, printed
from diecut_report.study.machines import STATES, MachineComparison, Verdict
from diecut_report.study.storage.spreadsheets import workbook
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import localised, said, say

NAME = "machines"
HEADS = (
    phrase("machine"), phrase("verdict"), phrase("governing check"), phrase("utilisation"), phrase("failed"),
    phrase("not checked"), phrase("warnings"), phrase("assumed"), phrase("file"), phrase("what is wrong"),
)  # fmt: skip


def page(made: MachineComparison, kind: str = "screen") -> str:
    """Return the comparison as one self-contained HTML page."""
    styles = ("summary", "machines")
    return filled("summary_machines.html.j2", kind, styles, c=made, states=STATES, shown=_shown, utilised=_utilised)


def _shown(cell: dict[str, Any] | None) -> str:
    """Return a check of a machine as a cell: its utilisation in per cent, or its verdict; nothing where it is not made."""
    if cell is None:
        return ""
    return said(STATES[cell["status"]]) if cell["utilisation"] is None else _utilised(cell["utilisation"])


def _utilised(share: float) -> str:
    return localised(f"{100 * share:.4g} %")


def table(made: MachineComparison) -> bytes:
    """Return the verdicts, the matrix of checks, the inputs that differ and the advice as one CSV, each below its heads."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for rows in _tables(made).values():
        writer.writerows([*rows, []])
    return text.getvalue().encode()


def _tables(made: MachineComparison) -> dict[str, list[list[Any]]]:
    return {
        say("verdicts"): [[*map(said, HEADS)], *map(_verdict, made.verdicts)],
        say("checks"): [[say("check"), say("title"), *made.machines],
                   *([name, title, *map(_cell, cells)] for name, title, cells in made.checks)],
        say("differing inputs"): [[say("input"), say("description"), *made.machines],
                             *([path, described, *cells] for path, described, cells in made.inputs)],
        say("advice"): [[say("machine"), say("advice")], *([name, each] for name, some in made.advice for each in some)],
    }  # fmt: skip


def _verdict(of: Verdict) -> list[Any]:
    counts = [of.failed, of.not_checked, of.warnings, of.assumed]
    words = "\n".join(map(said, of.words))
    return [of.machine, said(STATES[of.face]), of.governing, of.utilisation, *counts, of.file, words]


def _cell(cell: dict[str, Any] | None) -> str:
    if cell is None:
        return ""
    used = "" if cell["utilisation"] is None else localised(f" {cell['utilisation']:.6g}")
    return said(STATES[cell["status"]]) + used


def _json(made: MachineComparison) -> bytes:
    return (json.dumps(made.as_data(), indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


FORMATS: dict[str, Callable[[MachineComparison], bytes]] = {
    "html": lambda made: page(made).encode(),
    "pdf": lambda made: printed(page(made, "print")),
    "xlsx": lambda made: workbook(_tables(made)),
    "csv": table,
    "json": _json,
}


def files(
    made: MachineComparison, folder: Path, formats: list[str], neutral: MachineComparison | None = None
) -> dict[Path, bytes]:
    """Return the files of a comparison, all made before any is written; ``neutral`` is the same in English, for JSON."""
    shown = {"json": neutral or made}
    return {folder / f"{NAME}.{ending}": FORMATS[ending](shown.get(ending, made)) for ending in formats}
