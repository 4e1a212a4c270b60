"""Parts of results for tests that care for a few of their keys alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin

from diecut_report.results.record import Record

R = TypeVar("R", bound=Record)


def filled(kind: type[R], data: Mapping[str, Any]) -> R:
    """Return a part of the results of these data (by the names of the file), with what is missing empty."""
    return kind.model_validate(_of_record(kind, data))


def _of_record(kind: type[Record], data: Mapping[str, Any]) -> dict[str, Any]:
    given = {key: _of(kind, key, value) for key, value in data.items()}
    missing = {
        field.alias or name: _empty(field.annotation)
        for name, field in kind.model_fields.items()
        if field.is_required() and (field.alias or name) not in data and name not in data
    }
    return missing | given


def _of(kind: type[Record], key: str, value: Any) -> Any:
    fields = {field.alias or name: field for name, field in kind.model_fields.items()}
    return _filled(fields[key].annotation, value) if key in fields else value


def _filled(form: Any, value: Any) -> Any:
    if isinstance(value, Record):
        return value
    args = get_args(form)
    if get_origin(form) is Annotated:
        return _filled(args[0], value)
    if isinstance(form, type) and issubclass(form, Record) and isinstance(value, Mapping):
        return _of_record(form, value)
    if get_origin(form) is list and isinstance(value, list | tuple):
        return [_filled(args[0], each) for each in value]
    if get_origin(form) is dict and isinstance(value, Mapping):
        return {key: _filled(args[1], each) for key, each in value.items()}
    inner = list(_records(form))
    if not inner or not isinstance(value, Mapping):
        return value
    return _of_record(max(inner, key=lambda kind: sum(_has(kind, key, value[key]) for key in value)), value)


def _records(form: Any) -> Iterator[type[Record]]:
    """The kinds of blocks that a type allows."""
    if isinstance(form, type) and issubclass(form, Record):
        yield form
    elif get_origin(form) is not Literal:
        yield from (kind for each in get_args(form) for kind in _records(each))


def _has(kind: type[Record], key: str, value: Any) -> bool:
    found = next((field for name, field in kind.model_fields.items() if key in (name, field.alias)), None)
    return found is not None and (get_origin(found.annotation) is not Literal or value in get_args(found.annotation))


def _empty(form: Any) -> Any:
    args = get_args(form)
    if get_origin(form) is Annotated:
        return _empty(args[0])
    if get_origin(form) is Literal:
        return args[0]
    if type(None) in args:
        return None
    if isinstance(form, type) and issubclass(form, Record):
        return _of_record(form, {})
    kind = get_origin(form) or form
    return {list: [], dict: {}, int: 0, float: 0.0, bool: False}.get(kind, "")
