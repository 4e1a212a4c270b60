"""How large a table may be, and how it is told that one cannot be read."""

from __future__ import annotations

from collections.abc import Iterable

from diecut_report.languages.phrases import Phrase, joined, phrase

MAX_BYTES = {".csv": 200_000_000, ".parquet": 200_000_000, ".xlsx": 25_000_000}
MAX_UNPACKED = {".parquet": 500_000_000, ".xlsx": 100_000_000}  # what the packed file holds, in bytes
MAX_CELLS = {".csv": 10_000_000, ".parquet": 10_000_000, ".xlsx": 500_000}
MAX_COLUMNS = 16_384  # as many as a sheet of a workbook holds
SMALLER = phrase("Give fewer rows or columns")
OTHER_FORM = phrase("save the table as CSV or Parquet, which may be larger")


class UnreadableTable(Exception):
    """A file that is no table, in words, each with the row where it is known."""

    def __init__(self, faults: str | Iterable[tuple[str, int | None]]) -> None:
        self.faults = [(faults, None)] if isinstance(faults, str) else list(faults)
        super().__init__(self.faults)


def judge_size(kind: str, rows: int, columns: int) -> None:
    """Refuse a table of more cells than a file of this kind may have."""
    if columns > MAX_COLUMNS:
        raise UnreadableTable(
            Phrase(
                "has {columns} columns; at most {max_columns} are allowed. {smaller}",
                columns=columns,
                max_columns=MAX_COLUMNS,
                smaller=SMALLER,
            )
        )
    if rows * columns > MAX_CELLS[kind]:
        advice = joined((SMALLER, OTHER_FORM), ", or ") if kind == ".xlsx" else SMALLER
        most = Phrase("at most {max_cells} cells are allowed", max_cells=format(MAX_CELLS[kind], ","))
        raise UnreadableTable(
            Phrase(
                "has {rows} rows × {columns} columns; {most}. {advice}",
                rows=f"{rows:,}",
                columns=f"{columns:,}",
                most=most,
                advice=advice,
            )
        )


def judge_unpacked(kind: str, size: int) -> None:
    """Refuse a file whose content, unpacked, takes more bytes than is bearable."""
    if size > MAX_UNPACKED[kind]:
        most = Phrase("at most {max_unpacked} MB are allowed", max_unpacked=format(MAX_UNPACKED[kind] / 1000000.0, "g"))
        advice = joined((SMALLER, OTHER_FORM), ", or ") if kind == ".xlsx" else SMALLER
        raise UnreadableTable(
            Phrase(
                "holds {size} MB when it is unpacked; {most}. {advice}",
                size=format(size / 1000000.0, ".1f"),
                most=most,
                advice=advice,
            )
        )
