"""Tables of an author's own in a file beside the plugin (YAML, JSON, CSV): read, and told with file and line where one is wrong."""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, NoReturn, Self

import yaml
from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, ValidationError, model_validator

from diecut_report.errors import nearest
from diecut_report.quantities.units import UnitError, unit
from diecut_report.standards.tables import StandardFault, StandardTable, own_table
from diecut_report.text.phrases import Phrase, phrase

HEADED = re.compile(r"(.*?)\s*\[(.*)\]")  # a column of a CSV file: name [unit]
DECIMAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
SAID = re.compile(r"#\s*(\w+):\s*(.*)")  # a line above the columns of a CSV file: # title: …

OF_CSV = ("title", "source", "only_source", "left_out")  # what these lines say
WANTED = {
    "title": phrase("write what the table is, a text"),
    "sources": phrase("write a list of texts, what was published where"),
    "rows": phrase("write values by the names of the rows, or a list of rows of numbers"),
    "unit": phrase("write one unit, a text"),
    "columns": phrase("write the unit of each column by its name"),
    "left_out": phrase("write what is not in the table, a text"),
    "only_source": phrase("write why there is one source only, a text"),
}


class _Keys(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class _Written(_Keys):
    """A table in a file: what ``own_table`` takes."""

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
        data, lines, keys = _from_csv(text) if file.suffix == ".csv" else _from_yaml(text)
        written = _Written.model_validate(data)
        made = own_table(**written.model_dump())
    except (OSError, UnicodeDecodeError, yaml.YAMLError, csv.Error) as error:
        raise _of_file(Phrase("The table {file} cannot be read: {error}.", file=file, error=error)) from error
    except ValidationError as error:
        wrong = error.errors()[0]
        key = str(wrong["loc"][0]) if wrong["loc"] else ""
        place = f"{file.name}:{keys[key]}" if key in keys else file.name
        told = _key_fault(key, wrong["type"], is_csv=file.suffix == ".csv")
        raise _of_file(Phrase("{place}: {fault}", place=place, fault=told)) from error
    except _OddLine as odd:
        raise _of_file(Phrase("{place}: {fault}", place=f"{file.name}:{odd.line}", fault=odd.words)) from None
    except StandardFault as fault:
        place = file.name if fault.row is None else f"{file.name}:{lines[fault.row]}"
        raise _of_file(Phrase("{place}: {fault}", place=place, fault=phrase(str(fault)))) from fault
    return StandardTable(**{**vars(made), "id": file.stem, "file": str(file)})


class _OddLine(Exception):
    """A line that says nothing that is known."""

    def __init__(self, line: int, words: str) -> None:
        self.line, self.words = line, words


def _key_fault(key: str, kind: str, *, is_csv: bool) -> str:
    if not key:
        return phrase("it is not written as a table: title, sources and rows are needed")
    if kind == "missing":
        line = Phrase("write a line # {key}: … above the columns", key=key) if is_csv else WANTED[key]
        return Phrase("{key} is missing; {wanted}", key=key, wanted=line)
    if key not in WANTED:
        template = "{key} is not a key of a table{near}; known: {known}"
        return Phrase(template, key=key, near=nearest(key, WANTED), known=", ".join(WANTED))
    return Phrase("{key} is something else than it must be; {wanted}", key=key, wanted=WANTED[key])


def _of_file(words: str) -> StandardFault:
    """A fault of a file, which is not to be sought where the file is read."""
    found = StandardFault(words)
    found.tells_place = True
    return found


def _from_yaml(text: str) -> tuple[Any, list[int], dict[str, int]]:
    """What a file holds, and the line of each of its rows and keys."""
    node = yaml.compose(text, yaml.SafeLoader)
    pairs = node.value if isinstance(node, yaml.MappingNode) else []
    rows = [own for key, own in pairs if key.value == "rows"]
    keys = {str(key.value): key.start_mark.line + 1 for key, _ in pairs}
    parts = [each for own in rows for each in own.value if not isinstance(each, str)]
    first = [each[0] if isinstance(each, tuple) else each for each in parts]
    return _once(node), [each.start_mark.line + 1 for each in first], keys


def _once(node: Any) -> Any:
    """Return a file's data; a key that stands twice is a fault, where YAML alone would take the last."""
    if isinstance(node, yaml.MappingNode):
        seen: dict[str, int] = {}
        for key, _ in node.value:
            line = key.start_mark.line + 1
            if key.value in seen:
                template = "{twice} stands twice, in line {line} already; write it once"
                raise _OddLine(line, Phrase(template, twice=repr(key.value), line=seen[key.value]))
            seen[key.value] = line
        return {key.value: _once(value) for key, value in node.value}
    if isinstance(node, yaml.SequenceNode):
        return [_once(each) for each in node.value]
    # a number is one that is written as a decimal one; all else is text, so that neither 1:30 nor 010 becomes what nobody wrote
    return None if node is None else node.value if node.style else _number_or_text(node.value)


def _number_or_text(text: str) -> float | str:
    return float(text) if DECIMAL.fullmatch(text.strip()) else text


def _from_csv(text: str) -> tuple[dict[str, Any], list[int], dict[str, int]]:
    """What a file holds, and the line of each of its rows and of what is said above them."""
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    spoken = [(number, found[1], found[2]) for number, line in lines if (found := SAID.match(line))]
    keys = _judged(spoken)
    written = [(number, line) for number, line in lines if not line.startswith("#")]
    reader = csv.reader((line for _, line in written), skipinitialspace=True)
    table = [(written[reader.line_num - 1][0], row) for row in reader]
    if not table:
        raise csv.Error(phrase("it has no line with the names of its columns"))
    cells = [(cell.strip(), HEADED.fullmatch(cell.strip())) for cell in table[0][1]]
    heads = [(found[1], found[2]) if found else (cell, "") for cell, found in cells]  # names and units
    named = not heads[0][1]
    heads = heads[1:] if named else heads
    if len(dict(heads)) < len(heads):
        raise csv.Error(phrase("two of its columns have one name"))
    data: dict[str, Any] = {
        **{key: value for _, key, value in spoken if key != "source"},
        "sources": [value for _, key, value in spoken if key == "source"],
        "columns": dict(heads),
        "rows": [[*row[:named], *map(_number_or_text, row[named:])] for _, row in table[1:]],
    }
    return data, [number for number, _ in table[1:]], keys


def _judged(spoken: list[tuple[int, str, str]]) -> dict[str, int]:
    """The line of each word above the columns; a word that says nothing, or that stands twice, is a fault."""
    lines: dict[str, int] = {}
    for number, word, _ in spoken:
        if word not in OF_CSV:
            template = (
                "“# {word}:” says nothing here{near}; known: {known}; in a comment no colon follows the first word"
            )
            known = ", ".join(f"# {each}:" for each in OF_CSV)
            raise _OddLine(number, Phrase(template, word=word, near=nearest(word, OF_CSV), known=known))
        if word in lines and word != "source":
            template = "“# {word}:” stands in line {line} already; write it once"
            raise _OddLine(number, Phrase(template, word=word, line=lines[word]))
        lines[word] = number
    return lines


# The data files of the standard series: what stands in one, by its form, and what is wrong with one in words.


WRITTEN = {  # what pydantic finds amiss: how the key is written instead
    "string_type": phrase("a text"),
    "list_type": phrase("a list"),
    "dict_type": phrase("a table of names"),
    "float_type": "numbers",
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
    def _ascend(self) -> Self:
        """Raise ValueError unless the values ascend from the first end of the range to the last."""
        if not self.values:
            raise ValueError(phrase("has no values"))
        for before, after in pairwise(self.values):
            if not before < after:
                template = "must ascend without repetition, but {after} follows {before}"
                raise ValueError(Phrase(template, after=format(after, "g"), before=format(before, "g")))
        if [self.values[0], self.values[-1]] != self.range:
            ends = zip(("first", "last", "low", "high"), (self.values[0], self.values[-1], *self.range), strict=True)
            told = {name: f"{value:g}" for name, value in ends}
            raise ValueError(Phrase("runs from {first} to {last}, but its range is {low} to {high}", told))
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


AnyData = ListedData | TableData | NamedData
FORMS: dict[str, type[AnyData]] = {"values": ListedData, "table": TableData, "by": NamedData}


@cache
def data_file(id: str, folder: Path) -> AnyData:
    """Return what stands in the file of an id; StandardFault where there is none or it cannot be trusted."""
    names = {path.stem: path for path in folder.glob("*.json")}
    if id not in names:
        template = "There is no standard series {id}; there are: {names}."
        raise StandardFault(template, id=repr(id), names=", ".join(sorted(names)))
    try:
        data = json.loads(names[id].read_text(encoding="utf-8"), object_pairs_hook=_file_forms_once)
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
    raise StandardFault("Standard series {id} {what}.", id=repr(id), what=what) from cause


def _file_forms_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
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
