"""Tables of an author's own in a file beside the plugin (YAML, JSON, CSV): read, and told with file and line where one is wrong."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Any

import yaml
from pydantic import BaseModel, ConfigDict, ValidationError

from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.standards.own_tables import own_table
from diecut_report.standards.tables import StandardFault, StandardTable

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
        data, lines, keys = _from_csv(text) if file.suffix == ".csv" else _from_yaml(text)
        written = _Written.model_validate(data)
        made = own_table(**written.model_dump())
    except (OSError, UnicodeDecodeError, yaml.YAMLError, csv.Error) as error:
        raise _of_file(Phrase("The table {file} cannot be read: {error}.", file=file, error=error)) from error
    except ValidationError as error:
        wrong = error.errors()[0]
        key = str(wrong["loc"][0]) if wrong["loc"] else ""
        place = f"{file.name}:{keys[key]}" if key in keys else file.name
        told = _told(key, wrong["type"], is_csv=file.suffix == ".csv")
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


def _told(key: str, kind: str, *, is_csv: bool) -> str:
    """What is wrong with a key of a table, and what it must be."""
    if not key:
        return phrase("it is not written as a table: title, sources and rows are needed")
    if kind == "missing":
        line = Phrase("write a line # {key}: … above the columns", key=key) if is_csv else WANTED[key]
        return Phrase("{key} is missing; {wanted}", key=key, wanted=line)
    if key not in WANTED:
        return Phrase(
            "{key} is not a key of a table{near}; known: {known}",
            key=key,
            near=nearest(key, WANTED),
            known=", ".join(WANTED),
        )
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
    first = [
        each[0] if isinstance(each, tuple) else each for own in rows for each in own.value if not isinstance(each, str)
    ]
    return _once(node), [each.start_mark.line + 1 for each in first], keys


def _once(node: yaml.Node | None) -> Any:
    """Return a file's data; a key that stands twice is a fault, where YAML alone would take the last."""
    if isinstance(node, yaml.MappingNode):
        seen: dict[str, int] = {}
        for key, _ in node.value:
            line = key.start_mark.line + 1
            if key.value in seen:
                words = "{twice} stands twice, in line {line} already; write it once"
                raise _OddLine(line, Phrase(words, twice=repr(key.value), line=seen[key.value]))
            seen[key.value] = line
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
    heads = [_headed(cell.strip()) for cell in table[0][1]]
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
            words = "“# {word}:” says nothing here{near}; known: {known}; in a comment no colon follows the first word"
            known = ", ".join(f"# {each}:" for each in OF_CSV)
            raise _OddLine(number, Phrase(words, word=word, near=nearest(word, OF_CSV), known=known))
        if word in lines and word != "source":
            raise _OddLine(
                number, Phrase("“# {word}:” stands in line {line} already; write it once", word=word, line=lines[word])
            )
        lines[word] = number
    return lines
