"""Which curves may jump inside a smooth piece's rounding: where a condition on places decides, the very end may be on the wrong side."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from diecut_report.contract.binding import Binding, bound
from diecut_report.contract.steps import Accumulated, Choice, Derivative, Step, Value
from diecut_report.expressions import FormulaError, Node, substitute

STEPWISE = {"sign", "ceil", "floor", "round"}  # functions that jump themselves


@lru_cache(maxsize=256)
def jumping(curves: tuple[tuple[str, Step], ...], axis: str) -> frozenset[str]:
    """Return the curves over an abscissa whose formulas hold a condition that may change from place to place within a smooth piece."""
    return frozenset(_Curves(dict(curves), axis).found())


class _Curves:
    def __init__(self, curves: dict[str, Step], axis: str) -> None:
        self.curves, self.axis = curves, axis
        self.known: dict[str | float, bool] = {axis: False}

    def found(self) -> Iterator[str]:
        return (name for name in self.curves if self._jumps(name))

    def _jumps(self, name: str | float) -> bool:
        if name not in self.known:
            self.known[name] = self._declared(self.curves[str(name)]) if self._varies(name) else False
        return self.known[name]

    def _varies(self, name: str | float) -> bool:
        """Whether a quantity varies within a piece: flags of pieces and numbers do not."""
        return name == self.axis or (name in self.curves and not getattr(self.curves[str(name)], "per_piece", False))

    def _declared(self, step: Step) -> bool:
        match step:
            case Value(formula=part):
                return self._formula(part, condition=False)
            case Choice(cases=cases):
                return any(self._formula(c.value, condition=False) for c in cases) or any(
                    self._formula(c.condition, condition=True) for c in cases if c.condition is not None
                )
            case Accumulated() | Derivative():
                return False  # polynomials, piece by piece
        return True

    def _formula(self, part: Any, *, condition: bool) -> bool:
        """Whether a formula jumps; of a condition, whether it may change."""
        link = bound(_binding(part))
        names = [name for name in link.names.values() if self._varies(name)]
        try:
            tree = link.formula.tree
        except FormulaError:  # it is called as it is
            return bool(names)
        varying = {parameter for parameter, name in link.names.items() if self._varies(name)}
        return (
            any(self._jumps(name) for name in names) or (condition and bool(names)) or _decides(expanded(tree), varying)
        )


def _binding(part: Any) -> Binding:
    assert not isinstance(part, str), "a curve has no texts"
    found: Binding = part
    return found


def expanded(node: Node) -> Node:
    """Return a tree with the expressions of formulas in the place of the names by which they are printed."""
    if node.op == "apply":
        called, *args = node.args
        given = dict(zip(called.formula.parameters, map(expanded, args), strict=True))
        return substitute(expanded(called.formula.tree), given)
    return Node(node.op, tuple(_expanded(part) for part in node.args))


def _expanded(part: Any) -> Any:
    if isinstance(part, Node):
        return expanded(part)
    return tuple(map(_expanded, part)) if isinstance(part, tuple) else part


def _decides(node: Node, varying: set[str]) -> bool:
    """Whether a part of a formula compares, or takes a step, by what varies."""
    if node.op == "cmp" or (node.op == "call" and node.args[0] in STEPWISE):
        return any(name in varying for name in _symbols(node))
    return any(_decides(part, varying) for part in parts(node))


def _symbols(node: Node) -> Iterator[str]:
    if node.op == "sym":
        yield node.args[0]
    for part in parts(node):
        yield from _symbols(part)


def parts(node: Node) -> Iterator[Node]:
    """Give the nodes that a node is made of."""
    for part in node.args:
        if isinstance(part, Node):
            yield part
        elif isinstance(part, tuple):
            yield from parts(Node("cases", part))
