"""Questions to stored variants, as tests ask them."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from pathlib import Path

from diecut_report.study.analysis.answers import Request, answer


def variants(
    folder: Path,
    where: str | None = None,
    sort: str | None = None,
    top: int | None = None,
    format: str = "table",
    columns: Sequence[str] | None = None,
    width: int | None = None,
) -> Generator[str, None, None]:
    """The answer in pieces of text."""
    yield from answer(folder, Request(where, sort, top, columns), format, width=width)
