"""Columns of values to tables with schema, units and provenance (pyarrow)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.storage.description import SCHEMA_VERSION, VARIANT, VERDICT, Description, Kind, ResultColumn

Values = NDArray[Any] | Sequence[Any]
TYPES: dict[Kind, Any] = {
    "float": pa.float64(),
    "int": pa.int64(),
    "bool": pa.bool_(),
    "text": pa.dictionary(pa.int32(), pa.string()),
    "curve": pa.list_(pa.field("element", pa.float64())),  # the name that Parquet gives
}
COMPRESSION = "zstd"
DAMAGED = phrase("This part of the results is damaged or not of this study. Calculate it again with --resume.")
FOREIGN = phrase("No run of this study has written this part. Move it to another folder, or let --resume remove it.")
MISSING = phrase("This part of the results is missing. Calculate it again with --resume.")


def schema_of(description: Description) -> pa.Schema:
    """Return the types of the columns, with unit, symbol and description of each, and where the results come from."""
    return pa.schema([_field(column) for column in description.all_columns], provenance(description))


def _field(column: ResultColumn) -> pa.Field:
    about = {"unit": column.unit, "symbol": column.symbol, "description": column.description}
    return pa.field(column.name, TYPES[column.kind], column.name != VARIANT.name, about)


def provenance(description: Description) -> dict[str, str]:
    """Return what the schema of each part says of its origin."""
    return {
        "program": "diecut-report",
        "version": description.program,
        "study": description.study.sha256,
        "base": description.base.sha256,
        "schema_version": str(SCHEMA_VERSION),
    }


def table_of(schema: pa.Schema, columns: Mapping[str, Values], variants: NDArray[np.int64]) -> pa.Table:
    """Return the columns as a table; one that is not given holds nulls, for an output that applies to none of the variants."""
    names = [field.name for field in schema]
    strange = [name for name in columns if name not in names]
    if strange or VERDICT[0].name not in columns:
        raise ValueError(f"a part needs its status and no columns without description: {', '.join(strange)}")
    arrays = [array_of(field, columns.get(field.name), len(variants)) for field in schema if field.name != VARIANT.name]
    return pa.Table.from_arrays([pa.array(variants), *arrays], schema=schema)


def described_table(columns: Mapping[ResultColumn, Values | None], count: int) -> pa.Table:
    """Return columns of so many variants as a table in memory, with unit, symbol and description of each."""
    fields = [_field(column) for column in columns]
    arrays = [array_of(field, values, count) for field, values in zip(fields, columns.values(), strict=True)]
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def plain_table(rows: Sequence[Mapping[str, Any]]) -> pa.Table:
    """Return rows of plain values as a table."""
    return pa.Table.from_pylist([dict(row) for row in rows])


def array_of(field: pa.Field, values: Values | None, count: int) -> pa.Array:
    """Return the values of a column in its type; what is missing, not a number or infinite is null."""
    if values is None:
        return pa.nulls(count, field.type)
    if len(values) != count:
        raise ValueError(f"the column {field.name} has {len(values)} values for {count} variants")
    try:
        return _array(field.type, values)
    except (pa.ArrowException, TypeError, ValueError) as error:
        raise ValueError(f"the column {field.name} cannot hold its values as {field.type}: {error}") from error


def _array(kind: Any, values: Values) -> pa.Array:
    if pa.types.is_dictionary(kind):
        return pa.array(list(values), pa.string()).dictionary_encode()
    if pa.types.is_list(kind):
        return _lists(kind, values)
    if pa.types.is_floating(kind) and not isinstance(values, np.ndarray):
        values = np.array(values, float)  # None is not a number
    if isinstance(values, np.ndarray) and values.dtype.kind == "f":
        missing = ~np.isfinite(values)
        return pa.array(np.where(missing, 0.0, values), mask=missing).cast(kind)  # refuses 0.5 as an integer
    return pa.array(values, kind)


def _lists(kind: Any, values: Values) -> pa.Array:
    """Curves, one after the other in one array; None where there is none."""
    missing = np.array([one is None for one in values], bool)
    given = [np.asarray(one, float) for one in values if one is not None]
    ends = np.cumsum([0 if one is None else len(one) for one in values])
    numbers = _array(kind.value_type, np.concatenate([*given, np.empty(0)]))
    return pa.ListArray.from_arrays(np.append(0, ends).astype(np.int32), numbers, kind, mask=pa.array(missing))


def part_content(table: pa.Table) -> memoryview:
    """Return the table as the content of a Parquet file, with a checksum for each page."""
    texts = [field.name for field in table.schema if pa.types.is_dictionary(field.type)]
    sink = pa.BufferOutputStream()
    # numbers that seldom repeat only grow by a dictionary
    pq.write_table(table, sink, compression=COMPRESSION, use_dictionary=texts, row_group_size=max(len(table), 1),
                   write_page_checksum=True)  # fmt: skip
    return memoryview(sink.getvalue())


@contextmanager
def readable(path: Path) -> Iterator[None]:
    """Turn what goes wrong in reading a part into a UserError that says what to do."""
    try:
        yield
    except pa.ArrowException as error:
        raise UserError(Problem(DAMAGED, str(path))) from error
    except OSError as error:
        words = (
            Phrase("This part cannot be read: {strerror}.", strerror=error.strerror) if error.errno else DAMAGED
        )  # Parquet's own has no number
        raise UserError(Problem(words, str(path))) from error


def columns_of_part(path: Path, schema: pa.Schema, names: Sequence[str]) -> pa.Table | None:
    """Return some columns of a part, nothing where it is none or of another origin or other columns than the schema."""
    try:
        with pq.ParquetFile(path) as part:
            return part.read(columns=list(names)) if part.schema_arrow.equals(schema, check_metadata=True) else None
    except pa.ArrowException:
        return None
    except OSError as error:
        if error.errno is None:  # Parquet says so too of a damaged file
            return None
        raise
