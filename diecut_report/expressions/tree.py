"""Expression trees: nodes with their operands, and what is done with them whatever they say."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

LEAVES = ("sym", "num", "qty")


class Node(NamedTuple):
    """One node of an expression: an operation and its operands (nodes, or the texts of a leaf)."""

    op: str
    args: tuple[Any, ...]

    def to_json(self) -> list[Any]:
        """The node as nested lists, the form in which results hold it."""
        return [self.op, *map(_plain, self.args)]


def _plain(part: Any) -> Any:
    if type(part) is Node:
        return part.to_json()
    return list(map(_plain, part)) if isinstance(part, tuple) else part


def transform(node: Node, leaf: Callable[[Node], Node]) -> Node:
    """The tree with each leaf (``sym``, ``num``, ``qty``) replaced by ``leaf(node)``."""
    op, args = node
    if op in LEAVES:
        return leaf(node)
    return Node(op, tuple([_inner(part, leaf) for part in args]))


def _inner(part: Any, leaf: Callable[[Node], Node]) -> Any:
    if type(part) is Node:
        return transform(part, leaf)
    return tuple([transform(each, leaf) for each in part]) if isinstance(part, tuple) else part


def substitute(node: Node, values: Mapping[str, Node]) -> Node:
    """The tree with the named symbols replaced."""
    return transform(node, lambda n: values.get(n.args[0], n) if n.op == "sym" else n)


def symbols(node: Node) -> list[str]:
    """The symbols in the tree, in order of appearance, each once."""
    found: dict[str, None] = {}

    def note(leaf: Node) -> Node:
        if leaf.op == "sym":
            found[leaf.args[0]] = None
        return leaf

    transform(node, note)
    return list(found)


def walk(node: Node) -> list[Node]:
    """Return the node and all nodes in it, in order of appearance."""
    found: list[Node] = []
    pending: list[Any] = [node]
    while pending:
        part = pending.pop()
        if type(part) is Node:
            found.append(part)
            pending += part.args[::-1]
        elif isinstance(part, tuple):
            pending += part[::-1]
    return found


LOOSE = ("+", "-", "cmp", "*", "/", "neg")  # operations that stand in brackets within another one


def written(node: Node) -> str:
    """Return an expression as a line of text, to show the author where in the formula."""
    match node:
        case Node("num" | "sym", (text,)):
            return str(text)
        case Node("call", (name, *args)):
            return f"{name}({', '.join(map(written, args))})"
        case Node("cases", branches):
            return f"where({', '.join(written(part) for branch in branches for part in reversed(branch))})"
        case Node("cmp", (sign, left, right)):
            return f"{written(left)} {sign} {written(right)}"
        case Node("neg" | "not", (inner,)):
            return f"-{written(inner)}" if node.op == "neg" else f"not {written(inner)}"
    left, right = (f"({written(part)})" if part.op in LOOSE else written(part) for part in node.args)
    return f"{left} {node.op} {right}"
