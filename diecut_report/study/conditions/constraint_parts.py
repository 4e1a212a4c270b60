"""The parts of a constraint and how they join: the kind of each quantity is judged, and the words where it does not fit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np

from diecut_report.errors import nearest
from diecut_report.expressions import Node, evaluate, symbols
from diecut_report.quantities.units import (
    BASE_UNITS,
    DIMENSIONS,
    Kind,
    Unit,
    UnitError,
    kind_name,
    parse_quantity,
    unit,
)

MAX_EXPONENT, MAX_NUMBER = 20, 1e300
FUNCTIONS = ("abs", "min", "max", "sqrt")
NUMBER: Kind = (0.0,) * len(DIMENSIONS)
ANGLE = DIMENSIONS.index("angle")


class ConstraintError(ValueError):
    """A constraint that cannot be used; the text says why and what to write instead."""


@dataclass(frozen=True)
class Part:
    """A part of a constraint: a quantity of a kind, a text, a condition, or what stands in quotes and may be either.

    In the ``loose`` product of a quantity with an angle (angular speed times radius) radians may be left out.
    """

    node: Node
    what: str  # "quantity", "text", "condition", "quoted"
    kind: Kind = NUMBER
    loose: bool = False
    typed: str = ""

    @property
    def is_zero(self) -> bool:
        """Whether it is a plain 0, which is of any kind."""
        return self.kind == NUMBER and self.node == Node("qty", (0.0,))


def number(value: float) -> Part:
    """A plain number."""
    if abs(value) > MAX_NUMBER:
        raise ConstraintError("holds a number that is too large to calculate with.")
    return Part(Node("qty", (float(value),)), "quantity", typed=f"{value:g}")


def quantity(part: Part) -> Part:
    """A part as something to calculate with."""
    if part.what == "quantity":
        return part
    if part.what != "quoted":
        raise ConstraintError(
            f"{_shown(part)} is a {part.what}; a quantity is needed to calculate with or to compare by size."
        )
    text = str(part.node.args[0])
    try:
        own = _unit_of(text)
        return Part(Node("qty", (parse_quantity(text, own.text),)), "quantity", own.kind, typed=f"'{text}'")
    except UnitError as error:
        raise ConstraintError(str(error)) from None


def _unit_of(text: str) -> Unit:
    match = re.fullmatch(r"\s*[-+−]?[\d.]+(?:[eE][-+]?\d+)?\s*(.*?)\s*", text, re.DOTALL)
    if match is None:
        raise ConstraintError(f"'{text}' is no quantity; a number with a unit is needed, such as '90 mm'.")
    return unit(match[1] or "1")


def condition(part: Part) -> Node:
    """A part as a condition."""
    if part.what == "text" and part.node.op == "sym":
        raise ConstraintError(f"{_shown(part)} stands alone; compare it, as in {_shown(part)} == 'cycloidal'.")
    if part.what != "condition":
        raise ConstraintError(f"{_shown(part)} is no condition; and, or, not join comparisons.")
    return part.node


def joined(sign: str, nodes: Sequence[Node]) -> Part:
    """Conditions joined by ``and`` or ``or``."""
    return Part(reduce(lambda left, right: Node(sign, (left, right)), nodes), "condition")


def calculated(sign: str, left: Part, right: Part) -> Part:
    """What two quantities give by ``+ - * / ^``."""
    node = Node(sign, (left.node, right.node))
    if sign in "+-":
        return Part(node, "quantity", _alike(left, right, sign), left.loose or right.loose)
    if sign == "^":
        return _raised(left, right, node)
    turn = 1.0 if sign == "*" else -1.0
    kind = tuple(round(a + turn * b, 9) for a, b in zip(left.kind, right.kind, strict=True))
    both = NUMBER not in (left.kind, right.kind)
    loose = left.loose or right.loose or (both and bool(left.kind[ANGLE] or right.kind[ANGLE]))
    return Part(node, "quantity", kind, loose)


def _raised(base: Part, power: Part, node: Node) -> Part:
    if power.kind != NUMBER:
        raise ConstraintError(f"the exponent {_shown(power)} is {_kind(power)}; a number is needed.")
    exponent = _constant(power.node)
    if exponent is None or abs(exponent) > MAX_EXPONENT:
        if base.kind == NUMBER and exponent is None:
            return Part(node, "quantity")
        raise ConstraintError(
            f"the exponent of {_shown(base)} must be a number between -{MAX_EXPONENT} and {MAX_EXPONENT}."
        )
    return Part(
        node, "quantity", tuple(round(exponent * share, 9) for share in base.kind), base.loose or bool(base.kind[ANGLE])
    )


def _constant(node: Node) -> float | None:
    """The value of an expression that names no path."""
    if symbols(node):
        return None
    with np.errstate(all="ignore"):
        return float(evaluate(node, lambda leaf: np.float64(leaf.args[0])))


def compared(signs: Sequence[str], parts: Sequence[Part]) -> Part:
    """A comparison, also of more than two: each with the next."""
    pairs = zip(signs, parts, parts[1:], strict=False)
    return joined("and", [_pair(sign, left, right) for sign, left, right in pairs])


def _pair(sign: str, left: Part, right: Part) -> Node:
    if "text" in (left.what, right.what):
        return _same_text(sign, left, right)
    left, right = quantity(left), quantity(right)
    _alike(left, right, sign)
    return Node("cmp", (sign, left.node, right.node))


def _same_text(sign: str, left: Part, right: Part) -> Node:
    if sign not in ("==", "!="):
        raise ConstraintError(f"texts have no order, so {sign} cannot hold between them; use == or !=.")
    other = next((part for part in (left, right) if part.what not in ("text", "quoted")), None)
    if other:
        raise ConstraintError(f"{_shown(left)} and {_shown(right)} are a text and a quantity; put texts in quotes.")
    return Node("cmp", (sign, left.node, right.node))


def called(name: str, given: Iterable[Part]) -> Part:
    """A function of quantities."""
    if name not in FUNCTIONS:
        raise ConstraintError(
            f"there is no function {name!r}{nearest(name, FUNCTIONS)}; known: {', '.join(FUNCTIONS)}."
        )
    parts = list(given)
    many = name in ("min", "max")
    if not parts or (len(parts) < 2) == many:
        raise ConstraintError(
            f"{name} takes {'two or more quantities' if many else 'one quantity'}; {len(parts)} given."
        )
    if not many:
        power = 0.5 if name == "sqrt" else 1.0
        kind = tuple(power * share for share in parts[0].kind)
        return Part(Node("call", (name, parts[0].node)), "quantity", kind, parts[0].loose)
    whole = parts[0]
    for part in parts[1:]:
        node = Node("call", (f"{name}imum", whole.node, part.node))
        whole = Part(node, "quantity", _alike(whole, part, name), whole.loose or part.loose)
    return whole


def _alike(left: Part, right: Part, sign: str) -> Kind:
    """The kind that both sides have; a plain 0 is of any kind."""
    if left.is_zero or right.is_zero or left.kind == right.kind:
        return right.kind if left.is_zero else left.kind
    if (left.loose or right.loose) and _without_angle(left.kind) == _without_angle(right.kind):
        return left.kind
    told = [f"{_shown(part)} is {_kind(part)}" for part in (left, right)]
    bare = any(part.kind == NUMBER and part.typed and part.node.op == "qty" for part in (left, right))
    advice = " Put the quantity with its unit in quotes." if bare else ""
    raise ConstraintError(f"{' and '.join(told)}; {sign} needs the same kind on both sides.{advice}")


def _without_angle(kind: Kind) -> Kind:
    return (*kind[:ANGLE], 0.0, *kind[ANGLE + 1 :])


def _kind(part: Part) -> str:
    if part.kind == NUMBER:
        return "a pure number"
    return kind_name(_si_unit(part.kind))


def _si_unit(kind: Kind) -> Unit:
    powers = [
        base if power == 1 else f"{base}**{power:g}" for base, power in zip(BASE_UNITS, kind, strict=True) if power
    ]
    return Unit("", 1.0, "*".join(powers), kind)


def _shown(part: Part) -> str:
    """A part in a message: a path, what was typed, or only what it is."""
    return part.typed or (str(part.node.args[0]) if part.node.op == "sym" else "the calculated side")
