"""A YAML tree with other values in some of its places, and a tree written as text that reads back as the same tree."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import yaml

from diecut_report.config.hidden_letters import hidden
from diecut_report.config.yaml_tree import (
    KeyPath,
    Tree,
    YamlNode,
    parse,
    resolved,
)
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase

Scalar = str | int | float


def with_values(tree: Tree, values: Mapping[KeyPath, Scalar], name: str, heading: str) -> Tree:
    """Return the tree with these values, each at the place of what it stands for; blocks that are missing are made.

    ``name`` is what documents call it, ``heading`` the comment above its text; messages name the tree's own file and lines.
    """
    root = tree.root
    for path, value in values.items():
        if isinstance(value, str) and (found := hidden(value)):
            words = Phrase(
                "The value that is to stand here holds the invisible character {found}; it is not taken.", found=found
            )
            raise UserError(Problem(words, tree.file, path=".".join(map(str, path))))
        root = _with_value(root, path, value)
    text = f"# {heading}\n{as_text(root)}"
    return Tree(root, tree.file, text, hashlib.sha256(text.encode()).hexdigest(), name)


def in_its_own_text(tree: Tree) -> Tree:
    """Return a tree with other values, without its heading, as a text of its own: its places are those of that text.

    More values can be written into it, which are not those that the heading tells of.
    """
    read = parse(as_text(tree.root), tree.file)
    read.name = tree.name
    return read


def _with_value(node: YamlNode, path: KeyPath, value: Scalar) -> YamlNode:
    """Return a copy of the node with the value below it: an alias of the node keeps what it has."""
    if not path:
        return YamlNode(node.position, value, value if isinstance(value, str) else repr(value))
    key, rest = path[0], path[1:]
    children = dict(node.children or {})
    children[key] = _with_value(children.get(key, YamlNode(node.position)), rest, value)
    return replace(node, scalar=None, typed=None, children=children)


def as_text(root: YamlNode) -> str:
    """Return the tree as YAML; comments, anchors and the layout of the file that it was read from are not kept."""
    events = [
        yaml.StreamStartEvent(),
        yaml.DocumentStartEvent(),
        *_events(root),
        yaml.DocumentEndEvent(),
        yaml.StreamEndEvent(),
    ]
    text: str = yaml.emit(events, allow_unicode=True, width=math.inf)
    return text


def _events(node: YamlNode) -> Iterator[Any]:
    if node.children is None:
        yield _scalar(node.scalar, node.typed)
        return
    start, end = (
        (yaml.SequenceStartEvent, yaml.SequenceEndEvent)
        if node.is_list
        else (yaml.MappingStartEvent, yaml.MappingEndEvent)
    )
    yield start(anchor=None, tag=None, implicit=True, flow_style=not node.children)
    for key, child in node.children.items():
        if not node.is_list:
            yield _scalar(key, str(key))
        yield from _events(child)
    yield end()


def _scalar(value: Any, typed: str | None) -> Any:
    """Return a scalar as it was typed; a text that would be read as something else stands in quotes."""
    text = "null" if value is None else str(typed)
    is_other = isinstance(value, str) and resolved(text) != text
    return yaml.ScalarEvent(
        anchor=None, tag=None, implicit=(not is_other, True), value=text, style='"' if is_other else None
    )
