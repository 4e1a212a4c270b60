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

from diecut_report.languages.phrases import Phrase, phrase
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
        _fault(title, phrase('needs one of unit="…" (a value for each name) and columns={"name": "unit", …}'))
    names, cells = _cells(title, rows)
    units = dict(columns) if columns else {"": unit}
    for where, row in zip(names or cells, cells, strict=True):
        _row(title, where, row, len(units))
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
        _number(title, phrase("the series"), value)
    column = Column("values", unit, tuple(float(value) for value in values))
    _units(title, [column])
    _ascending(title, [column], least=1)
    return StandardSeries("", title, unit, column.values, tuple(sources), left_out, only_source)


def _texts(title: object, sources: Any, only_source: str) -> None:
    if not isinstance(title, str) or not title.strip():
        _fault(str(title), phrase("has no title"))
    if isinstance(sources, str) or not all(isinstance(text, str) and text.strip() for text in sources):
        _fault(title, phrase("needs its sources as texts in brackets, that say what was published where"))
    if not sources or (len(set(sources)) < 2 and not only_source):
        _fault(title, phrase('needs two sources that agree, or one and only_source="why there is no other"'))


def _cells(title: str, rows: Rows) -> tuple[list[str], list[tuple[Any, ...]]]:
    """The names of the rows (none where they go by numbers), and the values in them."""
    if isinstance(rows, Mapping):
        listed = [(name, *(cells if isinstance(cells, list | tuple) else (cells,))) for name, cells in rows.items()]
    else:
        listed = [tuple(row) if isinstance(row, list | tuple) else (row,) for row in rows]
    if not listed:
        _fault(title, phrase("has no rows"))
    if not isinstance(listed[0][0], str):
        return [], listed
    names = [row[0] for row in listed]
    strange = next((name for name in names if not isinstance(name, str) or not name.strip()), None)
    if strange is not None:
        _fault(title, Phrase("has the name {strange} of a row, which is not a text", strange=repr(strange)))
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        _fault(title, Phrase("has two rows of the name {twice}", twice=repr(twice)))
    return names, [row[1:] for row in listed]


def _row(title: str, where: object, row: tuple[Any, ...], count: int) -> None:
    if len(row) != count:
        _fault(
            title,
            Phrase(
                "has {count} values in the row {where}, where {wanted} are needed",
                count=len(row),
                where=repr(where),
                wanted=count,
            ),
        )
    for value in row:
        _number(title, Phrase("the row {where}", where=repr(where)), value)


def _number(title: str, where: str, value: object) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        _fault(title, Phrase("holds {value} in {where}, which is not a finite number", value=repr(value), where=where))


def _units(title: str, columns: Iterable[Column]) -> None:
    for column in columns:
        try:
            unit(column.unit)
        except UnitError as error:
            _fault(
                title,
                Phrase(
                    "has no usable unit{where}: {error}",
                    where=Phrase(" of {name}", name=column.name) if column.name else "",
                    error=error,
                ),
                error,
            )


def _ascending(title: str, columns: Sequence[Column], least: int = 2) -> None:
    """Check the first column; a table that goes by numbers needs two rows and a column of values."""
    if len(columns) < least:
        _fault(
            title, phrase("goes by the numbers of its first column and has no other; name its rows, or add a column")
        )
    if len(columns[0].values) < least:
        _fault(title, phrase("has too few values; give two rows at least") if least > 1 else phrase("has no values"))
    for before, after in pairwise(columns[0].values):
        if not before < after:
            name = columns[0].name
            _fault(
                title,
                Phrase(
                    "must ascend in {name} without repetition, but {after} follows {before}",
                    name=name,
                    after=format(after, "g"),
                    before=format(before, "g"),
                ),
            )


def _fault(title: str, what: str, cause: Exception | None = None) -> NoReturn:
    raise StandardFault(Phrase("The table “{title}” {what}.", title=title, what=what)) from cause


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
        data = _from_csv(text) if file.suffix == ".csv" else _once(yaml.compose(text, yaml.SafeLoader))
        written = _Written.model_validate(data)
    except (OSError, UnicodeDecodeError, yaml.YAMLError, csv.Error) as error:
        raise StandardFault(Phrase("The table {file} cannot be read: {error}.", file=file, error=error)) from error
    except ValidationError as error:
        told = "; ".join(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors())
        raise StandardFault(
            Phrase("The table {file} is not written as a table: {told}.", file=file, told=told)
        ) from error
    made = own_table(**written.model_dump())
    return StandardTable(**{**vars(made), "id": file.stem, "file": str(file)})


def _once(node: yaml.Node | None) -> Any:
    """Return a file's data; a key that stands twice is a fault, where YAML alone would take the last."""
    if isinstance(node, yaml.MappingNode):
        keys = [key.value for key, _ in node.value]
        twice = next((key for key in keys if keys.count(key) > 1), None)
        if twice is not None:
            raise yaml.YAMLError(Phrase("{twice} stands twice in it", twice=repr(twice)))
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


def _from_csv(text: str) -> dict[str, Any]:
    lines = [line for line in text.splitlines() if line.strip()]
    said = [found.groups() for line in lines if (found := SAID.match(line))]
    table = list(csv.reader((line for line in lines if not line.startswith("#")), skipinitialspace=True))
    if not table:
        raise csv.Error(phrase("it has no line with the names of its columns"))
    heads = [_headed(cell.strip()) for cell in table[0]]
    named = not heads[0][1]
    heads = heads[1:] if named else heads
    if len(dict(heads)) < len(heads):
        raise csv.Error(phrase("two of its columns have one name"))
    return {
        **{key: value for key, value in said if key != "source"},
        "sources": [value for key, value in said if key == "source"],
        "columns": dict(heads),
        "rows": [[*row[:named], *map(_number_or_text, row[named:])] for row in table[1:]],
    }
