"""What changed between two calculations, as lines for a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from diecut_report.languages.catalogues import Catalogues
from diecut_report.languages.speech import say, spoken_language
from diecut_report.report.changes import ChangedCheck, ChangedRow, printed_changes
from diecut_report.report.i18n import Catalogue
from diecut_report.report.translated import translated

WIDEST = 60  # letters of a column; what is longer is not aligned
MOST = {"changed_checks": 40, "changed_inputs": 40, "changed_outputs": 20}  # rows of a block
Cells = Sequence[str]


def lines(changes: Mapping[str, Any], *, all_rows: bool = False) -> Iterator[str]:
    """Give the changes of `results.changes` line by line; of the results the first ones, with the others counted."""
    words = Catalogue(spoken_language())
    made = printed_changes(changes, words)
    yield from _aligned([_head(say("old"), made.old, words), _head(say("new"), made.new, words)], indent="")
    if not made:
        yield words["no_changes"]
    mechanisms = [(name, old, "→", new) for name, old, new in made.mechanisms]
    yield from _block("changed_mechanisms", mechanisms, words, all_rows)
    yield from _block("changed_checks", [_check(row, words) for row in made.checks], words, all_rows)
    yield from _block("changed_inputs", [_row(row) for row in made.inputs], words, all_rows)
    if all_rows:
        yield from _block("following_inputs", [_row(row) for row in made.following], words, all_rows)
    elif made.following:
        yield say("  and {n} that follow from other changes by reference (--all shows them)", n=len(made.following))
    yield from _block("changed_outputs", [_row(row) for row in made.outputs], words, all_rows)
    yield from _block("changed_code", [(name, old, "→", new) for name, old, new in made.code], words, all_rows)


def said_changes(
    changes: Mapping[str, Any], old: Mapping[str, Any], new: Mapping[str, Any], catalogues: Catalogues
) -> Mapping[str, Any]:
    """Return the changes with their texts in the language of the catalogues; ``old`` and ``new`` are the results of both sides."""
    for data in old["mechanisms"].values():
        catalogues.of(data["kind"])
    found: Mapping[str, Any] = translated({**new, "changes": changes}, catalogues)["changes"]
    return found


def _head(name: str, side: Mapping[str, Any], words: Catalogue) -> Cells:
    counts = [f"{n} {words[status]}" for status, n in side["checks"].items() if n and status != "pass"]
    revision = say("revision {name}", name=side["revision"]) if side["revision"] else ""
    governing = say("governing {check}", check=side["governing"]) if side["governing"] else ""
    return name, side["file"], revision, words[side["status"]], ", ".join(counts), governing


def _check(row: ChangedCheck, words: Catalogue) -> Cells:
    old, new = (
        f"{words[status]} {used}".rstrip() if status else "–"
        for status, used in ((row.old_status, row.old), (row.new_status, row.new))
    )
    return row.change, f"{row.mechanism}: {row.title}", old, "→", new


def _row(row: ChangedRow) -> Cells:
    return row.path, row.old, "→", row.new, row.change, row.note


def _block(key: str, rows: Sequence[Cells], words: Catalogue, all_rows: bool) -> Iterator[str]:
    """A title and its rows, the first ones alone where there are many."""
    if not rows:
        return
    yield ""
    yield f"{words[key]}: {len(rows)}"
    shown = rows if all_rows else rows[: MOST.get(key, len(rows))]
    yield from _aligned(shown)
    if len(shown) < len(rows):
        yield say("  and {n} more (--all shows them)", n=len(rows) - len(shown))


def _aligned(rows: Sequence[Cells], indent: str = "  ") -> Iterator[str]:
    """The rows with their columns as wide as they need."""
    widths = [min(max(map(len, column)), WIDEST) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True) if width)
        yield f"{indent}{'  '.join(cells)}".rstrip()
