"""Expression trees: nodes with their operands, and what is done with them whatever they say."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

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


def unsaid(node: Node) -> Node:
    """The tree without what is said to the check of dimensions alone."""

    def without(part: Any) -> Any:
        if type(part) is Node:
            return unsaid(part)
        return tuple(map(without, part)) if isinstance(part, tuple) else part

    if node.op == "call" and node.args[0] in SAID:
        return unsaid(node.args[1])
    return node if node.op in LEAVES else Node(node.op, tuple(map(without, node.args)))


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


# What a formula's body may hold beside its parameters: constants, functions, operators; each with its name in a tree.


ROUNDING = 1e-9  # of a factor of 1; how far beyond ±1 rounding may carry the cosine of an angle that exists


def arccos_of(cosine: Any) -> Any:
    """Return the angle of a cosine, in [0, π] rad; a cosine beyond ±1 by rounding alone counts as ±1, beyond that is NaN."""
    size = abs(cosine)
    if not np.any(size > 1):  # as nearly always
        return np.arccos(cosine)
    beyond = (size > 1) & (size < 1 + ROUNDING)
    return np.arccos(np.where(beyond, np.sign(cosine), cosine))


FUNCTIONS: dict[Any, str] = {
    np.sqrt: "sqrt", np.sin: "sin", np.cos: "cos", np.tan: "tan", np.arcsin: "arcsin", np.arccos: "arccos",
    arccos_of: "arccos", np.arctan: "arctan", np.arctan2: "arctan2", np.exp: "exp", np.log: "log", np.abs: "abs", abs: "abs",
    np.sign: "sign", np.minimum: "minimum", np.maximum: "maximum", np.ceil: "ceil", np.floor: "floor", np.round: "round",
    np.sinh: "sinh", np.cosh: "cosh", np.tanh: "tanh", np.arcsinh: "arcsinh", np.arccosh: "arccosh", np.arctanh: "arctanh",
    np.log10: "log10",
}  # fmt: skip
OF_TWO = ("arctan2", "minimum", "maximum")  # what takes two numbers; all others take one
NUMERIC: dict[str, Callable[..., Any]] = {name: function for function, name in FUNCTIONS.items()}
AS_NUMBER, AS_ANGLE = "as_number", "as_angle"
SAID = (AS_NUMBER, AS_ANGLE)  # what the check of dimensions is told, and nobody else
BINARY: dict[type[ast.operator], str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "^", ast.BitAnd: "and", ast.BitOr: "or",
}  # fmt: skip
COMPARE: dict[type[ast.cmpop], str] = {
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=",
}  # fmt: skip
APPLY: dict[str, Callable[..., Any]] = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "^": operator.pow,
    "and": operator.and_, "or": operator.or_, "not": np.logical_not, "neg": operator.neg,
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
}  # fmt: skip
SIGNS = {"^": "**", "and": "&", "or": "|"}  # operations that Python writes otherwise
PI = Node("sym", ("π",))
