"""The data files of the standard series: what stands in one, by its form, and what is wrong with one in words."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, NoReturn, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.units import UnitError, unit
from diecut_report.standards.tables import StandardFault

WRITTEN = {  # what pydantic finds amiss: how the key is written instead
    "string_type": "a text",
    "list_type": "a list",
    "dict_type": phrase("a table of names"),
    "float_type": "numbers",
    "int_type": phrase("whole numbers"),
}


def _said(text: Any) -> Any:
    if not isinstance(text, str) or not text.strip():
        raise ValueError(phrase("has an empty title or source"))
    return text


def _agreeing(sources: list[str]) -> list[str]:
    if len(set(sources)) < 2:
        raise ValueError(phrase("needs two sources that agree"))
    return sources


def _usable(text: str) -> str:
    try:
        unit(text)
    except UnitError as error:
        raise ValueError(Phrase("has no usable unit: {error}", error=error)) from error
    return text


def _above_zero(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value) or value <= 0:
        raise ValueError(Phrase("holds {value}, which is not a number above 0", value=repr(value)))
    return float(value)


def _both_ends(limits: list[float]) -> list[float]:
    if len(limits) != 2:
        raise ValueError(phrase("needs the first and the last value as range"))
    return limits


Sources = Annotated[list[Annotated[str, BeforeValidator(_said)]], AfterValidator(_agreeing)]
Value = Annotated[float, BeforeValidator(_above_zero)]
Range = Annotated[list[float], AfterValidator(_both_ends)]


class _Keys(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class StandardData(_Keys):
    """Hold what stands in every file: its title, the unit of its numbers, where they are from, and what is left out."""

    title: Annotated[str, AfterValidator(_said)]
    unit: Annotated[str, AfterValidator(_usable)]
    sources: Sources
    left_out: str = ""


class _Values(_Keys):
    values: list[Value]
    range: Range

    @model_validator(mode="after")
    def _fit(self) -> Self:
        in_range(self.values, self.range)
        return self


class ListedData(_Values, StandardData):
    """Hold a list of values."""


class TableData(StandardData):
    """Hold a number for each name."""

    table: dict[str, Value]


class NamedValues(_Values):
    """Hold the values of one name, with sources of their own or those of the file."""

    sources: Sources | None = None
    left_out: str | None = None


class NamedData(StandardData):
    """Hold a list of values for each name."""

    by: dict[str, NamedValues]


class DecadesData(StandardData):
    """Hold which series of one decade is laid over which powers of ten."""

    decade: Annotated[str, Field(alias="from")]
    decades: list[int]
    range: Range


AnyData = ListedData | TableData | NamedData | DecadesData
FORMS: dict[str, type[AnyData]] = {"values": ListedData, "table": TableData, "by": NamedData, "from": DecadesData}


def in_range(values: Sequence[float], limits: list[float]) -> None:
    """Raise ValueError unless values ascend from the first limit to the last."""
    if not values:
        raise ValueError(phrase("has no values"))
    for before, after in pairwise(values):
        if not before < after:
            raise ValueError(
                Phrase(
                    "must ascend without repetition, but {after} follows {before}",
                    after=format(after, "g"),
                    before=format(before, "g"),
                )
            )
    if [values[0], values[-1]] != limits:
        raise ValueError(
            Phrase(
                "runs from {first} to {last}, but its range is {low} to {high}",
                first=format(values[0], "g"),
                last=format(values[-1], "g"),
                low=format(limits[0], "g"),
                high=format(limits[1], "g"),
            )
        )


@cache
def data_file(id: str, folder: Path) -> AnyData:
    """Return what stands in the file of an id; StandardFault where there is none or it cannot be trusted."""
    names = {path.stem: path for path in folder.glob("*.json")}
    if id not in names:
        raise StandardFault(
            Phrase("There is no standard series {id}; there are: {names}.", id=repr(id), names=", ".join(sorted(names)))
        )
    try:
        data = json.loads(names[id].read_text(encoding="utf-8"), object_pairs_hook=_once)
    except ValueError as error:
        fault(id, Phrase("is not readable: {error}", error=error), error)
    forms = [name for name in FORMS if isinstance(data, dict) and name in data]
    if len(forms) != 1:
        fault(id, Phrase("needs exactly one of {forms}", forms=", ".join(FORMS)))
    try:
        return FORMS[forms[0]].model_validate(data)
    except ValidationError as error:
        where, what = next(_faults(error))
        fault(".".join([id, *where]), what, error)


def form_of(file: AnyData) -> str:
    """Return the key that makes the form of a file."""
    return next(form for form, model in FORMS.items() if isinstance(file, model))


def fault(id: str, what: str, cause: Exception | None = None) -> NoReturn:
    """Raise StandardFault with what is wrong with a series."""
    raise StandardFault(Phrase("Standard series {id} {what}.", id=repr(id), what=what)) from cause


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(Phrase("{next} stands twice in it", next=repr(next(n for n in names if names.count(n) > 1))))
    return found


def _faults(error: ValidationError) -> Iterator[tuple[tuple[str, ...], str]]:
    """The faults of a file in words, each with the name below ``by`` that it is of."""
    for each in error.errors():
        place = tuple(map(str, each["loc"]))
        where, key = (place[1:2], place[2:]) if place[:1] == ("by",) and len(place) > 1 else ((), place)
        yield where, _words(each["type"], key[0] if key else "", each)


def _words(kind: str, key: str, each: Any) -> str:
    if kind == "missing":
        return Phrase("lacks {key}", key=key)
    if kind == "extra_forbidden":
        return Phrase("has the unknown {key}", key=key)
    if kind == "value_error":
        return str(each["ctx"]["error"])
    return (
        Phrase("needs {wanted} as {key}", wanted=WRITTEN[kind], key=key) if key else phrase("must be a table of names")
    )
