"""Tables of an author's own in a file beside the plugin (YAML, JSON, CSV): read, and told with file and line where one is wrong."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Any

import yaml
from pydantic import BaseModel, ConfigDict, ValidationError

from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.standards.own_tables import own_table
from diecut_report.standards.tables import StandardFault, StandardTable

HEADED = re.compile(r"(.*?)\s*\[(.*)\]")  # a column of a CSV file: name [unit]
DECIMAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
SAID = re.compile(r"#\s*(\w+):\s*(.*)")  # a line above the columns of a CSV file: # title: …


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
        raise _of_file(Phrase("The table {file} cannot be read: {error}.", file=file, error=error)) from error
    except ValidationError as error:
        told = "; ".join(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors())
        raise _of_file(Phrase("The table {file} is not written as a table: {told}.", file=file, told=told)) from error
    except StandardFault as fault:
        place = file.name if fault.row is None else f"{file.name}:{lines[fault.row]}"
        raise _of_file(Phrase("{place}: {fault}", place=place, fault=phrase(str(fault)))) from fault
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


def _from_csv(text: str) -> tuple[dict[str, Any], list[int]]:
    """What a file holds, and the line of each of its rows."""
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    said = [found.groups() for _, line in lines if (found := SAID.match(line))]
    written = [(number, line) for number, line in lines if not line.startswith("#")]
    reader = csv.reader((line for _, line in written), skipinitialspace=True)
    table = [(written[reader.line_num - 1][0], row) for row in reader]
    if not table:
        raise csv.Error(phrase("it has no line with the names of its columns"))
    heads = [_headed(cell.strip()) for cell in table[0][1]]
    named = not heads[0][1]
    heads = heads[1:] if named else heads
    if len(dict(heads)) < len(heads):
        raise csv.Error(phrase("two of its columns have one name"))
    data = {
        **{key: value for key, value in said if key != "source"},
        "sources": [value for key, value in said if key == "source"],
        "columns": dict(heads),
        "rows": [[*row[:named], *map(_number_or_text, row[named:])] for _, row in table[1:]],
    }
    return data, [number for number, _ in table[1:]]
