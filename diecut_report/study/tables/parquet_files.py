"""Parquet files as headers and cells, judged by their footer before they are unpacked."""

from __future__ import annotations

from typing import Any, BinaryIO

from diecut_report.languages.phrases import Phrase
from diecut_report.study.tables.cells import Cells
from diecut_report.study.tables.limits import (
    MAX_COLUMNS,
    SMALLER,
    UnreadableTable,
    judge_size,
    judge_unpacked,
)

KIND = ".parquet"
ROWS = 65_536  # read at a time
FOOTER = 10_000_000  # bytes of a text in the footer, which tells the columns

Header = tuple[str, str | None]


def read(file: BinaryIO) -> tuple[list[Header], list[Cells]]:
    """The headers, with the units that stand beside them, and the cells of all columns."""
    import pyarrow

    try:
        table = _table(file)
        units = [((field.metadata or {}).get(b"unit") or b"").decode() or None for field in table.schema]
        columns = [Cells(column, 1) for column in table.columns]  # their pieces as they are: one piece would be a copy
    except pyarrow.ArrowMemoryError as error:
        raise UnreadableTable(Phrase("needs more memory than there is. {smaller}", smaller=SMALLER)) from error
    except (pyarrow.ArrowException, OSError, ValueError, OverflowError) as error:  # Parquet says OSError of damage too
        if getattr(error, "errno", None):
            raise
        told = " ".join(str(error).split())
        raise UnreadableTable(Phrase("is not a Parquet file, or a damaged one: {told}", told=told)) from error
    return list(zip(table.column_names, units, strict=True)), columns


def _table(file: BinaryIO) -> Any:
    """The table, its texts whole, read a piece at a time and no further than is bearable."""
    import pyarrow
    from pyarrow import parquet

    limits = {"thrift_string_size_limit": FOOTER, "thrift_container_size_limit": 4 * MAX_COLUMNS}
    metadata = parquet.ParquetFile(file, **limits).metadata
    _judge(metadata)
    schema = metadata.schema.to_arrow_schema()
    _refuse_kinds(schema)
    # texts that repeat stay one text each until their whole size is known
    texts = [field.name for field in schema if _is_text(_plain_type(field.type))]
    source = parquet.ParquetFile(file, read_dictionary=texts, page_checksum_verification=True, **limits)
    plain = pyarrow.schema([pyarrow.field(f.name, _plain_type(f.type), metadata=f.metadata) for f in schema])
    pieces, size = [], 0
    for batch in source.iter_batches(ROWS):
        size += sum(_size(column) for column in batch.columns)
        judge_unpacked(KIND, size)
        whole = [_decoded(column).cast(field.type) for column, field in zip(batch.columns, plain, strict=True)]
        pieces.append(pyarrow.RecordBatch.from_arrays(whole, schema=plain))
    return pyarrow.Table.from_batches(pieces, plain)


def _judge(metadata: Any) -> None:
    judge_size(KIND, metadata.num_rows, metadata.num_columns)
    groups = [metadata.row_group(number) for number in range(metadata.num_row_groups)]
    judge_unpacked(KIND, sum(max(group.total_byte_size, 0) for group in groups))


def _refuse_kinds(schema: Any) -> None:
    wrong = [field for field in schema if not _is_plain(field.type)]
    if wrong:
        words = "column {name} holds {type}; numbers or texts are needed"
        raise UnreadableTable((Phrase(words, name=field.name, type=field.type), None) for field in wrong)


def _is_plain(kind: Any) -> bool:
    from pyarrow import types

    kind = _plain_type(kind)
    return _is_text(kind) or types.is_integer(kind) or types.is_floating(kind) or types.is_decimal(kind)


def _is_text(kind: Any) -> bool:
    from pyarrow import types

    return bool(types.is_string(kind) or types.is_large_string(kind))


def _plain_type(kind: Any) -> Any:
    from pyarrow import types

    return kind.value_type if types.is_dictionary(kind) else kind


def _size(column: Any) -> int:
    """How many bytes a column takes with its texts whole."""
    from pyarrow import compute, types

    if not types.is_dictionary(column.type):
        return int(column.nbytes)
    if not _is_text(column.type.value_type):
        return len(column) * 8
    lengths = compute.binary_length(column.dictionary)
    return int(compute.sum(lengths.take(column.indices)).as_py() or 0) + 4 * len(column)


def _decoded(column: Any) -> Any:
    from pyarrow import types

    return column.dictionary_decode() if types.is_dictionary(column.type) else column
