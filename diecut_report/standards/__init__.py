"""Standard series and tables (ratings, speeds, preferred numbers, belt lengths, pitches), each with its sources.

Each id is one file ``data/ID.json``, read on first use. A file has ``title``, ``unit``, ``sources`` (two published
tables that agree, or more), ``left_out`` (what could not be confirmed) and one of

- ``values``: a list in ascending order, with its ``range`` [first, last];
- ``table``: a number for each name; as a series it gives its different values in order;
- ``by``: for each name a ``values`` list with its ``range``, which may have ``sources`` and ``left_out`` of its own;
- ``from``: another file's series of one decade, 1 … 10, laid over the powers of ten ``decades`` within ``range``.

A fault of a file is a StandardFault, never a value left away in silence.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from decimal import Decimal
from functools import cache
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType
from typing import Any, NoReturn

from diecut_report.quantities.units import UnitError, unit
from diecut_report.standards.own_tables import own_series, own_table, table_beside
from diecut_report.standards.tables import Column, StandardFault, StandardSeries, StandardTable, sources_told

__all__ = ["Column", "StandardFault", "StandardSeries", "StandardTable", "own_series", "own_table", "sources_told", "standard_ids",
           "standard_series", "standard_series_by", "standard_table", "table_beside"]  # fmt: skip

DATA = Path(__file__).with_name("data")
FORMS: dict[str, set[str]] = {  # form of a file: what else stands in it
    "values": {"range"},
    "table": set(),
    "by": set(),
    "from": {"decades", "range"},
}
COMMON = {"title", "unit", "sources"}
SHAPES: dict[str, tuple[type, str]] = {  # key: how it is written
    "title": (str, "a text"),
    "unit": (str, "a text"),
    "left_out": (str, "a text"),
    "from": (str, "a text"),
    "sources": (list, "a list"),
    "values": (list, "a list"),
    "range": (list, "a list"),
    "decades": (list, "a list"),
    "table": (dict, "a table of names"),
    "by": (dict, "a table of names"),
}


def standard_ids(form: str, folder: Path = DATA) -> tuple[str, ...]:
    """Return the ids of the files of one form ("values", "table", "by", "from"), in order."""
    names = sorted(path.stem for path in folder.glob("*.json"))
    return tuple(name for name in names if _form(_file(name, folder)) == form)


@cache
def standard_series(id: str, folder: Path = DATA) -> StandardSeries:
    """Return the series of that id; a table gives its different values in order."""
    data = _file(id, folder)
    if "by" in data:
        _fault(id, "holds one series for each name; use standard_series_by")
    return _series(id, data, _values(id, data, folder))


@cache
def standard_series_by(id: str, folder: Path = DATA) -> Mapping[str, StandardSeries]:
    """Return the series of each name (such as the section of a V-belt) in the file of that id."""
    data = _file(id, folder)
    _need(id, data, "by")
    parts = {name: {**data, **part} for name, part in data["by"].items()}
    return MappingProxyType(
        {name: _series(f"{id}.{name}", part, _listed(f"{id}.{name}", part)) for name, part in parts.items()}
    )


@cache
def standard_table(id: str, folder: Path = DATA) -> StandardTable:
    """Return the table of that id: a number for each name."""
    data = _file(id, folder)
    _need(id, data, "table")
    values = tuple(_number(id, value) for value in data["table"].values())
    sources, left_out = _provenance(data)
    return StandardTable(
        id, data["title"], (Column("", data["unit"], values),), sources, left_out, tuple(data["table"])
    )


def _series(id: str, data: dict[str, Any], values: tuple[float, ...]) -> StandardSeries:
    return StandardSeries(id, data["title"], data["unit"], values, *_provenance(data))


def _provenance(data: dict[str, Any]) -> tuple[tuple[str, ...], str]:
    return tuple(data["sources"]), data.get("left_out", "")


# --- values ----------------------------------------------------------------------------------------------------------


def _values(id: str, data: dict[str, Any], folder: Path) -> tuple[float, ...]:
    if "from" in data:
        return _over_decades(id, data, folder)
    if "table" in data:
        return tuple(sorted({_number(id, value) for value in data["table"].values()}))
    return _listed(id, data)


def _listed(id: str, data: dict[str, Any]) -> tuple[float, ...]:
    values = tuple(_number(id, value) for value in data["values"])
    return _in_range(id, values, data["range"])


def _over_decades(id: str, data: dict[str, Any], folder: Path) -> tuple[float, ...]:
    decade = standard_series(data["from"], folder).values
    if (decade[0], decade[-1]) != (1.0, 10.0):
        _fault(id, f"is made from {data['from']}, which does not run from 1 to 10")
    first, last = data["range"]
    all_values = {float(Decimal(repr(v)).scaleb(power)) for power in data["decades"] for v in decade}
    return _in_range(id, tuple(sorted(v for v in all_values if first <= v <= last)), data["range"])


def _in_range(id: str, values: tuple[float, ...], limits: list[float]) -> tuple[float, ...]:
    if not values:
        _fault(id, "has no values")
    for before, after in pairwise(values):
        if not before < after:
            _fault(id, f"must ascend without repetition, but {after:g} follows {before:g}")
    if [values[0], values[-1]] != limits:
        _fault(id, f"runs from {values[0]:g} to {values[-1]:g}, but its range is {limits}")
    return values


def _number(id: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value) or value <= 0:
        _fault(id, f"holds {value!r}, which is not a number above 0")
    return float(value)


# --- files -----------------------------------------------------------------------------------------------------------


@cache
def _file(id: str, folder: Path) -> dict[str, Any]:
    names = {path.stem: path for path in folder.glob("*.json")}
    if id not in names:
        raise StandardFault(f"There is no standard series {id!r}; there are: {', '.join(sorted(names))}.")
    try:
        data = json.loads(names[id].read_text(encoding="utf-8"), object_pairs_hook=_once)
    except ValueError as error:
        _fault(id, f"is not readable: {error}", error)
    _check(id, data)
    return dict(data)


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(f"{next(n for n in names if names.count(n) > 1)!r} stands twice in it")
    return found


def _form(data: dict[str, Any]) -> str:
    return next(name for name in FORMS if name in data)


def _check(id: str, data: object) -> None:
    forms = [name for name in FORMS if isinstance(data, dict) and name in data]
    if not isinstance(data, dict) or len(forms) != 1:
        _fault(id, f"needs exactly one of {', '.join(FORMS)}")
    needed = COMMON | FORMS[forms[0]] | {forms[0]}
    _keys(id, data, needed)
    _texts(id, data)
    if forms[0] == "by":
        for name, part in data["by"].items():
            if not isinstance(part, dict):
                _fault(f"{id}.{name}", "must be a table of names")
            _keys(f"{id}.{name}", part, {"values", "range"}, {"sources", "left_out"})
            _texts(f"{id}.{name}", {**data, **part})


def _keys(
    id: str, data: dict[str, Any], needed: set[str], optional: frozenset[str] | set[str] = frozenset({"left_out"})
) -> None:
    if missing := needed - data.keys():
        _fault(id, f"lacks {', '.join(sorted(missing))}")
    if unknown := data.keys() - needed - optional:
        _fault(id, f"has the unknown {', '.join(sorted(unknown))}")
    for key, value in data.items():
        if not isinstance(value, SHAPES[key][0]):
            _fault(id, f"needs {SHAPES[key][1]} as {key}")
    if len(data.get("range", (1, 2))) != 2:
        _fault(id, "needs the first and the last value as range")


def _texts(id: str, data: dict[str, Any]) -> None:
    texts = [data["title"], *data["sources"]]
    if not all(isinstance(text, str) and text.strip() for text in texts):
        _fault(id, "has an empty title or source")
    if len(set(data["sources"])) < 2:
        _fault(id, "needs two sources that agree")
    try:
        unit(data["unit"])
    except UnitError as error:
        _fault(id, f"has no usable unit: {error}", error)


def _need(id: str, data: dict[str, Any], form: str) -> None:
    if form not in data:
        _fault(id, f"is of the form {_form(data)!r}, not {form!r}")


def _fault(id: str, what: str, cause: Exception | None = None) -> NoReturn:
    raise StandardFault(f"Standard series {id!r} {what}.") from cause
