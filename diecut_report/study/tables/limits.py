"""How large a table may be, and how it is told that one cannot be read."""

from __future__ import annotations

from collections.abc import Iterable

MAX_BYTES = {".csv": 200_000_000, ".parquet": 200_000_000, ".xlsx": 25_000_000}
MAX_UNPACKED = {".parquet": 500_000_000, ".xlsx": 100_000_000}  # what the packed file holds, in bytes
MAX_CELLS = {".csv": 10_000_000, ".parquet": 10_000_000, ".xlsx": 500_000}
MAX_COLUMNS = 16_384  # as many as a sheet of a workbook holds
SMALLER = "Give fewer rows or columns"
OTHER_FORM = "save the table as CSV or Parquet, which may be larger"


class UnreadableTable(Exception):
    """A file that is no table, in words, each with the row where it is known."""

    def __init__(self, faults: str | Iterable[tuple[str, int | None]]) -> None:
        self.faults = [(faults, None)] if isinstance(faults, str) else list(faults)
        super().__init__(self.faults)


def judge_size(kind: str, rows: int, columns: int) -> None:
    """Refuse a table of more cells than a file of this kind may have."""
    if columns > MAX_COLUMNS:
        raise UnreadableTable(f"has {columns} columns; at most {MAX_COLUMNS} are allowed. {SMALLER}")
    if rows * columns > MAX_CELLS[kind]:
        advice = f"{SMALLER}, or {OTHER_FORM}" if kind == ".xlsx" else SMALLER
        most = f"at most {MAX_CELLS[kind]:,} cells are allowed"
        raise UnreadableTable(f"has {rows:,} rows × {columns:,} columns; {most}. {advice}")


def judge_unpacked(kind: str, size: int) -> None:
    """Refuse a file whose content, unpacked, takes more bytes than is bearable."""
    if size > MAX_UNPACKED[kind]:
        most = f"at most {MAX_UNPACKED[kind] / 1e6:g} MB are allowed"
        advice = f"{SMALLER}, or {OTHER_FORM}" if kind == ".xlsx" else SMALLER
        raise UnreadableTable(f"holds {size / 1e6:.1f} MB when it is unpacked; {most}. {advice}")
