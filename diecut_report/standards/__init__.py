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
from math import inf
from pathlib import Path
from types import MappingProxyType

from diecut_report.quantities.units import unit
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


# The bearings of the tables by their designations.


BEARING_TABLES = {"deep_groove": "ball_bearings", "roller": "roller_bearings"}  # by the type of their bearings


def catalogue_size(designation: str, column: str) -> float | None:
    """Return a column of a bearing of the tables, SI; None of one that they do not have."""
    plain = "".join(designation.split()).upper()
    for table in map(standard_table, BEARING_TABLES.values()):
        of = table.column(column)
        rows = dict(zip(table.names, of.values, strict=True))
        found = rows.get(plain, rows.get(f"{plain}E"))
        if found is not None:
            return float(found * unit(of.unit).factor)
    return None


def catalogue_type(designation: str) -> str | None:
    """Return the type of a bearing of the tables; None of one that they do not have."""
    plain = "".join(designation.split()).upper()
    return next(
        (kind for kind, table in BEARING_TABLES.items() if {plain, f"{plain}E"} & {*standard_table(table).names}), None
    )


@cache
def related_bearings(designation: str) -> tuple[str, ...]:
    """Return the bearings of the tables that have the bore of this one, or are of its series; none where it is of no table."""
    bore, series = catalogue_size(designation, "d"), _size_series(designation)
    names = (name for table in BEARING_TABLES.values() for name in standard_table(table).names)
    return tuple(name for name in names if bore and (catalogue_size(name, "d") == bore or _size_series(name) == series))


def _size_series(designation: str) -> str:
    """A designation without its last two digits, which stand for the bore: NU2 of NU217E."""
    return "".join(designation.split()).upper().removesuffix("E")[:-2]


def bearing_series(designation: str) -> dict[str, float]:
    """Return the bearings of the series of one, each with its bore, m, the smallest first."""
    own = (each for each in related_bearings(designation) if _size_series(each) == _size_series(designation))
    bores = {each: catalogue_size(each, "d") or 0.0 for each in own}
    return dict(sorted(bores.items(), key=lambda pair: pair[1]))


def stronger_bearings(designation: str) -> list[str]:
    """Return the bearings of the same bore and type with a higher dynamic rating, the lowest first."""
    own = [catalogue_type(designation), catalogue_size(designation, "d")]
    alike = (each for each in related_bearings(designation) if [catalogue_type(each), catalogue_size(each, "d")] == own)
    ratings = {each: catalogue_size(each, "C") or 0.0 for each in alike}
    return sorted(
        (each for each in ratings if ratings[each] > (catalogue_size(designation, "C") or inf)), key=ratings.__getitem__
    )
