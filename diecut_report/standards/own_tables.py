"""Tables of an author's own, with their sources: written in the plugin, or in a file beside it (YAML, JSON, CSV)."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, NoReturn

import yaml
from pydantic import BaseModel, ConfigDict, ValidationError

from diecut_report.quantities.units import UnitError, unit
from diecut_report.standards.tables import Column, StandardFault, StandardSeries, StandardTable

Rows = Mapping[str, Any] | Sequence[Sequence[Any]]
HEADED = re.compile(r"(.*?)\s*\[(.*)\]")  # a column of a CSV file: name [unit]
DECIMAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
SAID = re.compile(r"#\s*(\w+):\s*(.*)")  # a line above the columns of a CSV file: # title: …


def own_table(
    *,
    title: str,
    rows: Rows,
    sources: Sequence[str],
    unit: str = "",
    columns: Mapping[str, str] | None = None,
    left_out: str = "",
    only_source: str = "",
) -> StandardTable:
    """Return a table that an author brings, checked; StandardFault says what is wrong with it.

    ``rows`` are values by name, {"steel": 7850} in ``unit`` or {"6204": (20, 13.5)} in the units of ``columns``
    ({"bore": "mm", "C": "kN"}); or rows of numbers, ((12, 0.245), (15, 0.29)), whose first column ascends.
    ``sources`` are two published tables that agree, or one and in ``only_source`` why there is no other.
    """
    _texts(title, sources, only_source)
    if bool(unit) is bool(columns):
        _fault(title, 'needs one of unit="…" (a value for each name) and columns={"name": "unit", …}')
    names, cells = _cells(title, rows)
    units = dict(columns) if columns else {"": unit}
    for number, (where, row) in enumerate(zip(names or cells, cells, strict=True)):
        _row(title, where, row, len(units), number)
    made = [
        Column(name, shown, tuple(float(v) for v in values))
        for (name, shown), values in zip(units.items(), zip(*cells, strict=True), strict=True)
    ]
    _units(title, made)
    if not names:
        _ascending(title, made)
    return StandardTable("", title, tuple(made), tuple(sources), left_out, tuple(names), only_source)


def own_series(
    *,
    title: str,
    unit: str,
    values: Sequence[float],
    sources: Sequence[str],
    left_out: str = "",
    only_source: str = "",
) -> StandardSeries:
    """Return a standard series that an author brings, checked as ``own_table`` checks; its values ascend."""
    _texts(title, sources, only_source)
    for value in values:
        _number(title, "the series", value)
    column = Column("values", unit, tuple(float(value) for value in values))
    _units(title, [column])
    _ascending(title, [column], least=1)
    return StandardSeries("", title, unit, column.values, tuple(sources), left_out, only_source)


def _texts(title: object, sources: Any, only_source: str) -> None:
    if not isinstance(title, str) or not title.strip():
        _fault(str(title), "has no title")
    if isinstance(sources, str) or not all(isinstance(text, str) and text.strip() for text in sources):
        _fault(title, "needs its sources as texts in brackets, that say what was published where")
    if not sources or (len(set(sources)) < 2 and not only_source):
        _fault(title, 'needs two sources that agree, or one and only_source="why there is no other"')


def _cells(title: str, rows: Rows) -> tuple[list[str], list[tuple[Any, ...]]]:
    """The names of the rows (none where they go by numbers), and the values in them."""
    if isinstance(rows, Mapping):
        listed = [(name, *(cells if isinstance(cells, list | tuple) else (cells,))) for name, cells in rows.items()]
    else:
        listed = [tuple(row) if isinstance(row, list | tuple) else (row,) for row in rows]
    if not listed:
        _fault(title, "has no rows")
    if not isinstance(listed[0][0], str):
        return [], listed
    names = [row[0] for row in listed]
    for number, name in enumerate(names):
        if not isinstance(name, str) or not name.strip():
            _fault(title, f"has the name {name!r} of a row, which is not a text", row=number)
        if name in names[:number]:
            _fault(title, f"has two rows of the name {name!r}", row=number)
    return names, [row[1:] for row in listed]


def _row(title: str, where: object, row: tuple[Any, ...], count: int, number: int) -> None:
    if len(row) != count:
        _fault(title, f"has {len(row)} values in the row {where!r}, where {count} are needed", row=number)
    for value in row:
        _number(title, f"the row {where!r}", value, number)


def _number(title: str, where: str, value: object, row: int | None = None) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        _fault(title, f"holds {value!r} in {where}, which is not a finite number", row=row)


def _units(title: str, columns: Iterable[Column]) -> None:
    for column in columns:
        try:
            unit(column.unit)
        except UnitError as error:
            _fault(title, f"has no usable unit{f' of {column.name}' if column.name else ''}: {error}", error)


def _ascending(title: str, columns: Sequence[Column], least: int = 2) -> None:
    """Check the first column; a table that goes by numbers needs two rows and a column of values."""
    if len(columns) < least:
        _fault(title, "goes by the numbers of its first column and has no other; name its rows, or add a column")
    if len(columns[0].values) < least:
        _fault(title, "has too few values; give two rows at least" if least > 1 else "has no values")
    for number, (before, after) in enumerate(pairwise(columns[0].values), 1):
        if not before < after:
            name = columns[0].name
            _fault(title, f"must ascend in {name} without repetition, but {after:g} follows {before:g}", row=number)


def _fault(title: str, what: str, cause: Exception | None = None, row: int | None = None) -> NoReturn:
    found = StandardFault(f"The table “{title}” {what}.")
    found.row = row
    raise found from cause


# --- files beside a plugin -------------------------------------------------------------------------------------------


class _Written(BaseModel):
    """A table in a file: what ``own_table`` takes."""

    model_config = ConfigDict(extra="forbid", strict=True)

    title: str
    sources: list[str]
    rows: dict[str, Any] | list[list[Any]]
    unit: str = ""
    columns: dict[str, str] | None = None
    left_out: str = ""
    only_source: str = ""


def table_beside(plugin: str, name: str) -> StandardTable:
    """Return the table in the file ``name`` beside a plugin's file: ``table_beside(__file__, "steels.yaml")``.

    YAML and JSON hold what ``own_table`` takes. CSV says it in lines above (# title: …, # source: …) and names its columns
    with their units (bore [mm]); a first column without a unit holds the rows' names.
    """
    file = Path(plugin).with_name(name)
    try:
        text = file.read_text(encoding="utf-8")
        data, lines = _from_csv(text) if file.suffix == ".csv" else _from_yaml(text)
        written = _Written.model_validate(data)
        made = own_table(**written.model_dump())
    except (OSError, UnicodeDecodeError, yaml.YAMLError, csv.Error) as error:
        raise _of_file(f"The table {file} cannot be read: {error}.") from error
    except ValidationError as error:
        told = "; ".join(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors())
        raise _of_file(f"The table {file} is not written as a table: {told}.") from error
    except StandardFault as fault:
        line = f":{lines[fault.row]}" if fault.row is not None else ""
        raise _of_file(f"{file.name}{line}: {fault}") from fault
    return StandardTable(**{**vars(made), "id": file.stem, "file": str(file)})


def _of_file(words: str) -> StandardFault:
    """A fault of a file, which is not to be sought where the file is read."""
    found = StandardFault(words)
    found.tells_place = True
    return found


def _from_yaml(text: str) -> tuple[Any, list[int]]:
    """What a file holds, and the line of each of its rows."""
    node = yaml.compose(text, yaml.SafeLoader)
    rows = [own for key, own in node.value if key.value == "rows"] if isinstance(node, yaml.MappingNode) else []
    first = [
        each[0] if isinstance(each, tuple) else each for own in rows for each in own.value if not isinstance(each, str)
    ]
    return _once(node), [each.start_mark.line + 1 for each in first]


def _once(node: yaml.Node | None) -> Any:
    """Return a file's data; a key that stands twice is a fault, where YAML alone would take the last."""
    if isinstance(node, yaml.MappingNode):
        keys = [key.value for key, _ in node.value]
        twice = next((key for key in keys if keys.count(key) > 1), None)
        if twice is not None:
            raise yaml.YAMLError(f"{twice!r} stands twice in it")
        return {key.value: _once(value) for key, value in node.value}
    if isinstance(node, yaml.SequenceNode):
        return [_once(each) for each in node.value]
    return None if node is None else _scalar(node)


def _scalar(node: Any) -> Any:
    """A number written as a decimal one; all else is text, so that neither 1:30 nor 010 becomes what nobody wrote."""
    return node.value if node.style else _number_or_text(node.value)


def _number_or_text(text: str) -> float | str:
    return float(text) if DECIMAL.fullmatch(text.strip()) else text


def _headed(cell: str) -> tuple[str, str]:
    """The name of a column and its unit."""
    found = HEADED.fullmatch(cell)
    return (found[1], found[2]) if found else (cell, "")


def _from_csv(text: str) -> tuple[dict[str, Any], list[int]]:
    """What a file holds, and the line of each of its rows."""
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    said = [found.groups() for _, line in lines if (found := SAID.match(line))]
    written = [(number, line) for number, line in lines if not line.startswith("#")]
    reader = csv.reader((line for _, line in written), skipinitialspace=True)
    table = [(written[reader.line_num - 1][0], row) for row in reader]
    if not table:
        raise csv.Error("it has no line with the names of its columns")
    heads = [_headed(cell.strip()) for cell in table[0][1]]
    named = not heads[0][1]
    heads = heads[1:] if named else heads
    if len(dict(heads)) < len(heads):
        raise csv.Error(f"two of its columns have one name, in line {table[0][0]}")
    data = {
        **{key: value for key, value in said if key != "source"},
        "sources": [value for key, value in said if key == "source"],
        "columns": dict(heads),
        "rows": [[*row[:named], *map(_number_or_text, row[named:])] for _, row in table[1:]],
    }
    return data, [number for number, _ in table[1:]]
