"""The configuration of one stored variant: the base with that variant's values, as text, its comments kept."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

from diecut_report.config import yaml_tree
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.errors import Problem, UserError
from diecut_report.study.analysis.stored_variants import Column, Stored, opened
from diecut_report.study.storage.state import kept

Values = dict[KeyPath, Any]


def variant_config(directory: Path, variant: int) -> str:
    """The configuration of a variant: the study's base with the varied values put in, SI numbers with their units.

    UserError in words where the variant is not stored, and with its reason where it cannot be calculated.
    """
    with opened(directory) as stored:
        _refuse_error(stored, variant)
        values: Values = {tuple(_keys(column.name)): value for column, value in _row(stored, variant)}
        description = stored.description
    base = yaml_tree.load(kept(directory)[description.base.file])
    values |= dict(_named(base.data.get("project") or {}, variant, description.study.file))
    wanted = base.data
    for path, value in values.items():
        wanted = replaced(wanted, path, value)
    text = _edited(base.text, values)
    if (
        text is None or yaml_tree.parse(text, "variant").data != wanted
    ):  # anchors, say: comments are lost, never a value
        text = yaml.safe_dump(wanted, sort_keys=False, allow_unicode=True)
    return f"# Variant {variant} of {description.study.file}: its values stand in SI units, exactly as they were calculated.\n{text}"


def _named(project: Mapping[str, Any], variant: int, study: str) -> Iterator[tuple[KeyPath, str]]:
    """The title block says which variant it is: no two documents are called alike."""
    yield ("project", "title"), f"{project.get('title', '')} – variant {variant} of {Path(study).stem}"
    if number := project.get("document_number"):
        yield ("project", "document_number"), f"{number}/V{variant}"


def _refuse_error(stored: Stored, variant: int) -> None:
    for status, reason in stored.rows("SELECT status, error FROM v WHERE variant = ?", [variant]):
        if status == "error":
            words = f"Variant {variant} cannot be calculated: {reason or 'no reason was stored'}"
            raise UserError(Problem(words, str(stored.folder)))


def _keys(path: str) -> Iterator[str | int]:
    for part in path.split("."):
        yield int(part) if part.isdecimal() else part


def _row(stored: Stored, variant: int) -> list[tuple[Column, Any]]:
    names = ", ".join(column.sql for column in stored.varied) or "variant"
    rows = stored.rows(f"SELECT {names} FROM v WHERE variant = ?", [variant])
    if not rows:
        first, last = stored.rows("SELECT min(variant), max(variant) FROM v")[0]
        is_whole = stored.study.get("state") == "complete"
        words = (
            f"There is no variant {variant} here. The stored ones are within {first} … {last}; a number in between that is missing "
            + ("was dropped by a constraint." if is_whole else "was dropped by a constraint or is not calculated yet.")
        )
        raise UserError(Problem(words, str(stored.folder)))
    given = [(column, _told(value, column)) for column, value in zip(stored.varied, rows[0], strict=False)]
    return [(column, value) for column, value in given if value is not None]


def _told(value: Any, column: Column) -> Any:
    """The value as a configuration gives it; whole pure numbers (teeth) as integers."""
    if not isinstance(value, float):
        return value
    if column.unit != "1":
        return f"{value!r} {column.unit}"
    return int(value) if value.is_integer() and abs(value) < 1e15 else value


def replaced(data: Any, path: KeyPath, value: Any) -> Any:
    """A copy of the data with the value at the path; blocks that are missing are made."""
    if not path:
        return value
    key, rest = path[0], path[1:]
    if isinstance(data, list) and isinstance(key, int):
        return [replaced(part, rest, value) if index == key else part for index, part in enumerate(data)]
    block = data if isinstance(data, dict) else {}
    return {**block, key: replaced(block.get(key), rest, value)}


# --- in the text -----------------------------------------------------------------------------------------------------


def _edited(text: str, values: Values) -> str | None:
    """The text with the values written over those that stand there, and new keys put first in their block."""
    edits = sorted((_edit(text, path, value) for path, value in values.items()), reverse=True)
    for start, end, new in edits:
        text = text[:start] + new + text[end:]
    try:
        yaml_tree.parse(text, "variant")
    except UserError:
        return None
    return text


def _edit(text: str, path: KeyPath, value: Any) -> tuple[int, int, str]:
    """From where to where, and what to put there."""
    node: Any = yaml.compose(text, Loader=yaml.SafeLoader)
    for depth, key in enumerate(path):
        child = _child(node, key)
        if child is None and isinstance(node, yaml.MappingNode):
            return _inserted(node, key, _nested(path[depth + 1 :], value))
        if child is None:
            return _over(node, _nested(path[depth:], value))
        node = child
    return _over(node, _flow(value))


def _over(node: Any, new: str) -> tuple[int, int, str]:
    """In place of a value; after the key of one that is empty."""
    start, end = node.start_mark.index, node.end_mark.index
    return start, end, new if end > start else f" {new}"


def _child(node: Any, key: str | int) -> Any:
    if isinstance(node, yaml.MappingNode):
        return next((value for name, value in node.value if name.value == str(key)), None)
    if isinstance(node, yaml.SequenceNode) and isinstance(key, int) and key < len(node.value):
        return node.value[key]
    return None


def _inserted(node: Any, key: str | int, new: str) -> tuple[int, int, str]:
    """A new key at the head of a block, on a line of its own where the block stands in lines."""
    at = node.start_mark.index
    if node.flow_style:
        return at + 1, at + 1, f"{key}: {new}" + (", " if node.value else "")
    return at, at, f"{key}: {new}\n{' ' * node.start_mark.column}"


def _nested(path: KeyPath, value: Any) -> str:
    return _flow(value) if not path else f"{{{path[0]}: {_nested(path[1:], value)}}}"


def _flow(value: Any) -> str:
    """A value within a line: words stand bare where they are plain words, else in quotes."""
    is_plain = isinstance(value, str) and re.fullmatch(r"[\w.+-]+( [\w*/]+)?", value) and not _is_other(value)
    return value if is_plain else json.dumps(value, ensure_ascii=False)


def _is_other(text: str) -> bool:
    """Whether a bare text would be read as something else than this text."""
    return bool(yaml_tree.parse(f"a: {text}", "text").data["a"] != text)
