"""The text of a configuration with other values in some of its places; all else stays as it is, byte for byte."""

from __future__ import annotations

import codecs
import copy
import hashlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import yaml

from diecut_report.config.yaml_tree import LOADER, KeyPath, Tree, parse
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import phrase

ANCHOR = re.compile(r"&\S+\s+")
EXPRESSION = phrase(
    "holds ${…}, a reference or an expression, and is not written over; change what it refers to, "
    "or write a number there first"
)
SHARED = phrase(
    "stands in a part that an anchor (&) and its aliases (*) share, so that it cannot be changed "
    "here alone; write it out"
)
NO_HOME = phrase(
    "cannot be put into the file, as the block that it belongs to does not stand there; write that block first"
)


@dataclass(frozen=True)
class _Span:
    """Hold where a scalar stands in the text: from its first letter to the one after its last, and whether in braces or brackets."""

    start: int
    end: int
    column: int
    in_flow: bool


def written(tree: Tree, values: Mapping[KeyPath, str], *, over_references: bool = False) -> str:
    """Return the text of the file with these scalars, as they are to be typed; UserError as of ``rewritten``."""
    return rewritten(tree, values, over_references=over_references).text


def rewritten(tree: Tree, values: Mapping[KeyPath, str], *, over_references: bool = False) -> Tree:
    """Return the file with these scalars, as they are to be typed; a key that is not there is put into its block.

    UserError in words where a value cannot be written: it is shared by an anchor, or an expression stands there which is not
    to be written over.
    """
    if tree.problems or not values:
        return tree
    spans, edits = _spans(tree.text), []
    for path, value in values.items():
        typed = tree.typed(path)
        if typed is not None and "${" in typed and not over_references:
            raise UserError(_problem(tree, path, EXPRESSION))
        edits.append(_new_key(tree, spans, path, value) if typed is None else _other(tree, spans, path, value))
    text = tree.text
    for start, end, new in sorted(edits, reverse=True):
        text = text[:start] + new + text[end:]
    return tree if text == tree.text else _read_again(tree, values, text)


def as_file(tree: Tree, text: str) -> bytes:
    """Return the bytes of a file with this text in place of the tree's, with the byte order mark that it began with."""
    had_mark = hashlib.sha256(codecs.BOM_UTF8 + tree.text.encode()).hexdigest() == tree.sha256
    return (codecs.BOM_UTF8 if had_mark else b"") + text.encode()


@lru_cache(maxsize=4)
def _spans(text: str) -> dict[tuple[int, int], _Span]:
    """Where each scalar stands, by its line and column as the tree has them."""
    found: dict[tuple[int, int], _Span] = {}
    flows: list[bool] = []
    for event in yaml.parse(text, Loader=LOADER):
        if isinstance(event, yaml.MappingStartEvent | yaml.SequenceStartEvent):
            flows.append(bool(event.flow_style))
        elif isinstance(event, yaml.MappingEndEvent | yaml.SequenceEndEvent):
            flows.pop()
        elif isinstance(event, yaml.ScalarEvent):
            first, last = event.start_mark, event.end_mark
            assert first is not None and last is not None, "events of a text have marks"
            end = last.index
            anchor = ANCHOR.match(text, first.index, end) if event.anchor else None
            span = _Span(anchor.end() if anchor else first.index, end, first.column, any(flows))
            found[first.line + 1, first.column + 1] = span
    return found


def _other(tree: Tree, spans: Mapping[tuple[int, int], _Span], path: KeyPath, value: str) -> tuple[int, int, str]:
    """The piece of the text that holds a scalar, and what takes its place."""
    span = spans[tree.position(path)]
    ending = len(tree.text[span.start : span.end]) - len(tree.text[span.start : span.end].rstrip())
    return span.start, span.end - ending, value


def _new_key(tree: Tree, spans: Mapping[tuple[int, int], _Span], path: KeyPath, value: str) -> tuple[int, int, str]:
    """Where a new key goes: behind the first single value of its block, in a line of its own or, within braces, in the same one."""
    home, key = path[:-1], path[-1]
    for name in _keys(tree.data, home):
        before = (*home, name)
        span, key_span = spans.get(tree.position(before)), spans.get(tree.key_position(before))
        if (
            tree.typed(before) in (None, "")
            or span is None
            or key_span is None
            or "\n" in tree.text[key_span.start : span.end]
        ):
            continue
        if span.in_flow:
            return span.end, span.end, f", {key}: {value}"
        line_end = _line_end(tree.text, span.end)
        break_ = "\r\n" if "\r\n" in tree.text else "\n"
        return line_end, line_end, f"{break_}{' ' * key_span.column}{key}: {value}"
    raise UserError(_problem(tree, path, NO_HOME))


def _line_end(text: str, place: int) -> int:
    end = text.find("\n", place)
    end = len(text) if end < 0 else end
    return end - 1 if text[:end].endswith("\r") else end


def _keys(data: Any, home: KeyPath) -> Iterator[str]:
    """The keys of the block at a path; none where there is no block."""
    for key in home:
        known = key in data if isinstance(data, dict) else isinstance(data, list) and int(key) < len(data)
        data = data[key] if known else None
    yield from data if isinstance(data, dict) else ()


def _read_again(tree: Tree, values: Mapping[KeyPath, str], text: str) -> Tree:
    """The new text read, which must differ from the file in these values alone."""
    expected = copy.deepcopy(tree.data)
    for path, value in values.items():
        home = expected
        for key in path[:-1]:
            home = home[key]
        home[path[-1]] = parse(f"value: {value}\n", tree.file).data["value"]
    found = parse(text, tree.file)
    if found.data != expected:
        shared = {tree.position(path) for path in _differing(found.data, expected)}
        culprit = next((path for path in values if tree.position(path) in shared), next(iter(values)))
        raise UserError(_problem(tree, culprit, SHARED))
    found.name = tree.name
    return found


def _differing(one: Any, other: Any, path: KeyPath = ()) -> Iterator[KeyPath]:
    """The paths of the single values in which two trees of plain data differ."""
    is_block = isinstance(one, dict | list) and type(one) is type(other) and len(one) == len(other)
    if not is_block:
        yield from () if one == other else (path,)
        return
    for key in one if isinstance(one, dict) else range(len(one)):
        if isinstance(one, list) or key in other:
            yield from _differing(one[key], other[key], (*path, key))


def _problem(tree: Tree, path: KeyPath, words: str) -> Problem:
    return Problem(words, tree.file, *tree.position(path), path=".".join(map(str, path)))
