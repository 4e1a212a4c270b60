"""Questions to the stored variants: which fulfil a condition, the best first, as a table, CSV, JSON or a workbook."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Generator, Iterator, Sequence
from pathlib import Path

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Counted, Phrase, phrase
from diecut_report.languages.speech import decimal_sign, said, say, say_counted
from diecut_report.report.number_format import number
from diecut_report.study.analysis.answers import SI, Notation, as_csv, as_json, as_workbook, csv_text, side_by_side
from diecut_report.study.analysis.question import Question, Request, question
from diecut_report.study.analysis.stored_variants import Stored, opened
from diecut_report.study.storage.spreadsheets import workbook
from diecut_report.study.storage.state import read_state
from diecut_report.study.storage.state_form import continuing

FORMATS = ("table", "csv", "json")


def variants(
    directory: Path,
    where: str | None = None,
    sort: str | None = None,
    top: int | None = None,
    format: str = "table",
    columns: Sequence[str] | None = None,
    width: int | None = None,
) -> Generator[str, None, None]:
    """Yield the answer in pieces of text: a ``table`` for people (in the units that they read), ``csv`` or ``json`` (SI, all columns).

    ``sort`` names columns, parted by commas, with - for the greatest first; without ``columns`` a table shows the varied
    quantities and what the question names. UserError in words for what cannot be asked.
    """
    yield from answer(directory, Request(where, sort, top, columns), format, width=width)


def answer(
    directory: Path,
    asked: Request,
    format: str = "table",
    notation: Notation = SI,
    *,
    transposed: bool = False,
    width: int | None = None,
) -> Generator[str, None, None]:
    """Yield the answer in pieces of text; with ``transposed`` a line for each quantity and a column for each variant.

    A table that compares variants leaves out what is the same for all, and says how much that is, unless the columns are named.
    """
    if format not in FORMATS:
        raise UserError(
            Problem(
                Phrase(
                    "{format} is not a format of variants; known: {formats}.",
                    format=repr(format),
                    formats=", ".join(FORMATS),
                )
            )
        )
    if transposed and format == "json":
        raise UserError(
            Problem(phrase("JSON names each value, so that it has no rows to transpose; ask for table, csv or xlsx."))
        )
    with opened(directory) as stored:
        found = question(stored, asked, is_table=format == "table" and not transposed)
        if transposed and format == "csv":
            yield from csv_text(*_rows_of(stored, found, notation), notation)
        elif transposed:
            yield _compared(stored, found, asked, width)
        elif format == "table":
            yield from _table(stored, found, width)
        else:
            yield from {"csv": as_csv, "json": as_json}[format](stored, found, notation)


def answer_workbook(directory: Path, asked: Request, notation: Notation = SI, *, transposed: bool = False) -> bytes:
    """Return the answer as a workbook (XLSX); UserError in words for what cannot be asked."""
    with opened(directory) as stored:
        found = question(stored, asked, is_table=False)
        if not transposed:
            return as_workbook(stored, found, notation)
        (_, _, *numbers), lines = side_by_side(stored, found, notation)
        return workbook({say("variants"): [[say("quantity"), say("unit"), *numbers], *lines]})


def unfinished(directory: Path) -> Iterator[str]:
    """Return a warning where a study is not calculated to its end: its best variant may still come."""
    state = read_state(directory)
    if state.get("state") != "complete":
        parts, rows, chunk = len(list((directory / "variants").glob("part-*.parquet"))), state["rows"], state["chunk"]
        yield (
            Phrase(
                "This study is not finished: {parts} of {all} parts are calculated. Go on with: {continued}",
                parts=parts,
                all=-(-rows // chunk),
                continued=continuing(directory, state["columns"]),
            )
        )


def _rows_of(stored: Stored, asked: Question, notation: Notation) -> tuple[list[object], Iterator[list[object]]]:
    head, lines = side_by_side(stored, asked, notation)
    return head, iter(lines)


def _table(stored: Stored, asked: Question, width: int | None) -> Iterator[str]:
    """A table for people, and how many variants there are."""
    from diecut_report.study.analysis.variant_table import table_text

    rows = list(asked.rows(stored))
    found, without = table_text(asked.columns, rows, width or _terminal())
    yield f"{found}\n{_counted(stored, asked, len(rows))}\n"
    if without:
        words = "No room on a line for: {columns} (--columns names some, --format csv has them all)."
        yield say(words, columns=", ".join(column.name for column in without)) + "\n"


def _compared(stored: Stored, found: Question, asked: Request, width: int | None) -> str:
    from diecut_report.study.analysis.variant_table import compared_text

    rows = list(found.rows(stored))
    text, equal = compared_text(found.columns, rows, width or _terminal(), keep_equal=asked.columns is not None)
    words = say_counted(len(rows), "{n} variant", "{n} variants")
    if equal:
        words += say_counted(
            equal,
            "; {n} quantity that is the same for all is left out (--columns, --format csv)",
            "; {n} quantities that are the same for all are left out (--columns, --format csv)",
        )
    return f"{text}\n{words}.\n"


def _terminal() -> int | None:
    """How many letters a line of the terminal has; nothing where the answer goes elsewhere."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def _counted(stored: Stored, asked: Question, given: int) -> str:
    sql = f"SELECT count(*) FILTER ({asked.where}), count(*) FROM v"
    found, total = stored.rows(sql, asked.condition.parameters)[0]
    sign = decimal_sign()
    of_all = Counted(
        total,
        "{found} of {n} variant",
        "{found} of {n} variants",
        found=number(str(found), sign),
        n=number(str(total), sign),
    )
    words = of_all if asked.condition.sql == "true" else Phrase("Fulfilling the condition: {count}", count=of_all)
    shown = Phrase("{words}; {given} are shown (--top, --format csv).", words=words, given=given)
    return said(shown if given < found else Phrase("{words}.", words=words))


__all__ = ["FORMATS", "answer", "answer_workbook", "unfinished", "variants"]
