"""Standard series and tables (ratings, speeds, preferred numbers, belt lengths, pitches), each with its sources.

Each id is one file ``data/ID.json``, read on first use. A file has ``title``, ``unit``, ``sources`` (two published
tables that agree, or more), ``left_out`` (what could not be confirmed) and one of

- ``values``: a list in ascending order, with its ``range`` [first, last];
- ``table``: a number for each name; as a series it gives its different values in order;
- ``by``: for each name a ``values`` list with its ``range``, which may have ``sources`` and ``left_out`` of its own.

``data/ID.yaml`` holds a catalogue of machine elements, in the form of ``table_beside``.

A fault of a file is a StandardFault, never a value left away in silence.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from diecut_report.standards.files import (
    ListedData,
    NamedData,
    NamedValues,
    StandardData,
    TableData,
    data_file,
    fault,
    form_of,
    table_beside,
)
from diecut_report.standards.tables import Column, StandardSeries, StandardTable
from diecut_report.text.phrases import Phrase, phrase

DATA = Path(__file__).with_name("data")


def standard_ids(form: str, folder: Path = DATA) -> tuple[str, ...]:
    """Return the ids of the files of one form ("values", "table", "by"), in order."""
    names = sorted(path.stem for path in folder.glob("*.json"))
    return tuple(name for name in names if form_of(data_file(name, folder)) == form)


@cache
def standard_series(id: str, folder: Path = DATA) -> StandardSeries:
    """Return the series of that id; a table gives its different values in order."""
    match data_file(id, folder):
        case NamedData():
            fault(id, phrase("holds one series for each name; use standard_series_by"))
        case ListedData() as file:
            return _series(id, file, file.values)
        case TableData() as file:
            return _series(id, file, sorted(set(file.table.values())))


@cache
def standard_series_by(id: str, folder: Path = DATA) -> Mapping[str, StandardSeries]:
    """Return the series of each name (such as the section of a V-belt) in the file of that id."""
    file = data_file(id, folder)
    if not isinstance(file, NamedData):
        fault(id, Phrase("is of the form {form_of}, not 'by'", form_of=repr(form_of(file))))
    return MappingProxyType({name: _named(f"{id}.{name}", file, part) for name, part in file.by.items()})


@cache
def standard_table(id: str, folder: Path = DATA) -> StandardTable:
    """Return the table of that id: a number for each name; of ``data/ID.yaml``, a catalogue, its columns by designation."""
    if (folder / f"{id}.yaml").exists():
        return table_beside(str(folder / id), f"{id}.yaml")
    file = data_file(id, folder)
    if not isinstance(file, TableData):
        fault(id, Phrase("is of the form {form_of}, not 'table'", form_of=repr(form_of(file))))
    column = Column("", file.unit, tuple(file.table.values()))
    return StandardTable(id, file.title, (column,), tuple(file.sources), file.left_out, tuple(file.table))


def _series(id: str, file: StandardData, values: Iterable[float]) -> StandardSeries:
    return StandardSeries(id, file.title, file.unit, tuple(values), tuple(file.sources), file.left_out)


def _named(id: str, file: NamedData, part: NamedValues) -> StandardSeries:
    own = part.model_dump(include={"sources", "left_out"}, exclude_none=True)
    return _series(id, file.model_copy(update=own), part.values)
