"""The parts of a condition and how they join: the kind of each quantity is judged, and the words where it does not fit."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, reduce
from itertools import chain
from typing import Any, Literal, cast

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas.condition_numpy import numbers
from diecut_report.formulas.condition_tree import (
    Call,
    Chain,
    ColumnName,
    Compared,
    Joined,
    Like,
    Missing,
    Negative,
    Node,
    Not,
    Number,
    Power,
    TextLiteral,
    Truth,
    names,
    operands,
)
from diecut_report.formulas.conditions import (
    ALLOWED,
    FUNCTIONS,
    NUMBER,
    ConditionError,
    Parsed,
    alike,
    calculation,
    parsed,
    tokens,
    told_kind,
    without_angle,
)
from diecut_report.formulas.tree import BINARY, COMPARE
from diecut_report.quantities.units import Kind, UnitError, number_and_unit, parse_quantity, pretty, unit
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.phrases import joined as joined_phrases

MAX_EXPONENT = 20


@dataclass(frozen=True)
class Name:
    """Hold what a name stands for: a number in its SI ``unit``, a text, or a truth; ``display`` is the unit that people read ("" if unknown)."""

    name: str
    holds: Literal["number", "text", "truth"]
    unit: str = "1"
    display: str = ""

    @property
    def is_read_in_si(self) -> bool:
        """Return whether people read it in SI, so that a number beside it needs no unit."""
        return self.unit == (self.display or "1")


@dataclass(frozen=True)
class ConditionPart:
    """Hold a part of a condition and its place: a quantity of a kind, a text, a condition, or what stands in quotes and may be either.

    A ``bare`` quantity is made of numbers without units. In the ``loose`` product of quantities (angular speed times radius)
    radians may be left out; in an ``exact`` part, of an expression, they count as in formulas. ``name`` is what it names or scales,
    ``typed`` what messages call it.
    """

    node: Node
    what: Literal["quantity", "text", "condition", "quoted"]
    place: int
    kind: Kind = NUMBER
    bare: bool = False
    loose: bool = False
    exact: bool = False
    name: Name | None = None
    typed: str = ""

    @property
    def shown(self) -> str:
        """Return what messages call it."""
        return self.typed or (phrase("what is calculated") if self.exact else phrase("the calculated side"))


def number(value: float, place: int) -> ConditionPart:
    """Return a plain number as a part."""
    if not np.isfinite(value):
        raise ConditionError("the condition holds a number that is too large to calculate with.", place)
    return ConditionPart(Number(value), "quantity", place, bare=True, typed=f"{value:g}")


def named(name: Name, place: int) -> ConditionPart:
    """Return what a name stands for as a part."""
    node = ColumnName(name.name, name.holds)
    if name.holds == "number":
        return ConditionPart(node, "quantity", place, unit(name.unit).kind, name=name, typed=name.name)
    return ConditionPart(node, "text" if name.holds == "text" else "condition", place, typed=name.name)


def quantity(part: ConditionPart, beside: ConditionPart | None = None) -> ConditionPart:
    """Return a part as something to calculate with; a bare number in quotes counts in the unit of the name beside it."""
    if part.what == "quantity":
        return part
    if not isinstance(part.node, TextLiteral):
        template = "{shown} is a {what}; a quantity is needed to calculate with or to compare by size."
        raise ConditionError(template, part.place, shown=part.shown, what=part.what)
    name = beside.name if beside else None
    wanted = unit(name.display or name.unit) if name else None
    try:
        own = number_and_unit(part.node.value, wanted)[1]
        measure = unit(own) if own else wanted or unit("1")
        value = parse_quantity(part.node.value, measure.text)
    except UnitError as error:
        raise ConditionError(str(error), part.place) from None
    return ConditionPart(Number(value), "quantity", part.place, measure.kind, exact=part.exact, typed=part.typed)


def condition(part: ConditionPart, needed_by: str) -> Node:
    """Return the node of a part that is to be a condition; ``needed_by`` says why."""
    if part.what == "text":
        raise ConditionError("{shown} stands alone; compare it with a text in quotes.", part.place, shown=part.shown)  # fmt: skip
    if part.what != "condition":
        raise ConditionError("{shown} is not a condition; {needed_by}.", part.place, shown=part.shown, needed_by=needed_by)  # fmt: skip
    return part.node


def joined(word: Literal["and", "or"], nodes: Sequence[Node], place: int) -> ConditionPart:
    """Return conditions joined by ``and`` or ``or``."""
    return ConditionPart(nodes[0] if len(nodes) == 1 else Joined(word, tuple(nodes)), "condition", place)


def contrary(node: Node, place: int) -> ConditionPart:
    """Return the contrary of a condition."""
    return ConditionPart(Not(node), "condition", place)


# Comparisons.


def compared(signs: Sequence[str], parts: Sequence[ConditionPart]) -> ConditionPart:
    """Return a comparison, also of more than two parts: each with the next."""
    pairs = zip(signs, parts, parts[1:], strict=False)
    return joined("and", [_pair(sign, left, right) for sign, left, right in pairs], parts[0].place)


def _pair(sign: str, left: ConditionPart, right: ConditionPart) -> Node:
    whats = {left.what, right.what}
    if whats == {"condition"} or ("text" in whats and whats <= {"text", "quoted"}):
        return Compared(sign, left.node, right.node)
    if "text" in whats:
        other = next(part.what for part in (left, right) if part.what not in ("text", "quoted"))
        template = "{shown} and {shown_2} are a text and a {other}; put texts in quotes."
        raise ConditionError(template, right.place, shown=left.shown, shown_2=right.shown, other=other)
    left, right = quantity(left, right), quantity(right, left)
    _alike(left, right, sign)
    return Compared(sign, left.node, right.node)


def like(text: ConditionPart, pattern: ConditionPart) -> ConditionPart:
    """Return whether a text is like a pattern in quotes."""
    if text.what != "text" or not isinstance(pattern.node, TextLiteral) or not isinstance(text.node, ColumnName):
        template = "'like' compares a column of words with a pattern in quotes, such as 'drive.%'."
        raise ConditionError(template, pattern.place)
    return ConditionPart(Like(text.node, pattern.node.value), "condition", text.place)


# Arithmetic.


def calculated(sign: str, left: ConditionPart, right: ConditionPart) -> ConditionPart:
    """Return what two quantities give by ``+ - * /``."""
    left, right = quantity(left, right if sign in "+-" else None), quantity(right, left if sign in "+-" else None)
    node = _chained(sign, left.node, right.node)
    bare = left.bare and right.bare
    if sign in "+-":
        whole = _alike(left, right, sign)
        return replace(whole, node=node, place=left.place, bare=bare, loose=left.loose or right.loose, typed="")
    turn = 1.0 if sign == "*" else -1.0
    kind = tuple(round(a + turn * b, 9) for a, b in zip(left.kind, right.kind, strict=True))
    scaled = left if right.bare else right if left.bare and sign == "*" else None
    loose = scaled.loose if scaled else True
    return ConditionPart(
        node, "quantity", left.place, kind, bare, loose, left.exact or right.exact, scaled.name if scaled else None
    )


def _chained(sign: str, left: Node, right: Node) -> Chain:
    """Return a longer chain where the left side is one of the same binding: trees do not get deep by long sums."""
    group = "+-" if sign in "+-" else "*/"
    if isinstance(left, Chain) and left.rest[0][0] in group:
        return Chain(left.first, (*left.rest, (sign, right)))
    return Chain(left, ((sign, right),))


def negative(part: ConditionPart) -> ConditionPart:
    """Return a quantity with the other sign."""
    part = quantity(part)
    if isinstance(part.node, Number):
        return replace(part, node=Number(-part.node.value), typed=f"-{part.typed}")
    return replace(part, node=Negative(part.node), typed="")


def raised(base: ConditionPart, power: ConditionPart) -> ConditionPart:
    """Return a power; its exponent must be known where the base has a unit."""
    base, power = quantity(base), quantity(power)
    if power.kind != NUMBER:
        template = "the exponent {shown} is {kind}; a number is needed."
        raise ConditionError(template, power.place, shown=power.shown, kind=_kind(power))
    constant = _constant(power.node)
    if base.exact and (constant is None or not constant.is_integer()):
        template = "the exponent {shown} is not a whole number that is written here; take sqrt(…) for a root."
        raise ConditionError(template, power.place, shown=power.shown)
    node = Power(base.node, power.node)
    if base.kind == NUMBER:
        return ConditionPart(node, "quantity", base.place, bare=base.bare and power.bare, loose=True)
    if constant is None or not abs(constant) <= MAX_EXPONENT:
        template = "the exponent of {shown} must be a number between -{max_exponent} and {max_exponent}."
        raise ConditionError(template, power.place, shown=base.shown, max_exponent=MAX_EXPONENT)
    kind = tuple(round(constant * share, 9) for share in base.kind)
    return ConditionPart(node, "quantity", base.place, kind, loose=True)


def _constant(node: Node) -> float | None:
    """Return the value of a number that names nothing, NaN where it has none."""
    if names(node):
        return None
    with np.errstate(all="ignore"):
        return float(numbers(node, lambda _: None))


def called(name: str, given: Sequence[ConditionPart], place: int) -> ConditionPart:
    """Return a function of quantities."""
    parts = [quantity(part) for part in given]
    if not parts or (len(parts) > 1 and name in ("abs", "sqrt")):
        wanted = phrase("one quantity") if name in ("abs", "sqrt") else phrase("one quantity or more")
        raise ConditionError("{name} takes {wanted}; {count} given.", place, name=name, wanted=wanted, count=len(parts))  # fmt: skip
    whole = reduce(lambda one, two: _alike(one, two, name), parts)
    bare, loose = all(part.bare for part in parts), any(part.loose for part in parts)
    made = replace(
        whole, node=Call(name, tuple(part.node for part in parts)), place=place, bare=bare, loose=loose, typed=""
    )
    if name == "sqrt":
        return replace(made, kind=tuple(0.5 * share for share in whole.kind), loose=True, name=None)
    return made


# Kinds.


def _alike(left: ConditionPart, right: ConditionPart, sign: str) -> ConditionPart:
    """Return the side whose kind both have; a plain 0 is of any kind, and a number that of what people read in SI."""
    for bare, other in ((left, right), (right, left)):
        if bare.bare and not other.bare and (other.kind != NUMBER or other.name):
            if _constant(bare.node) != 0.0 and not (other.name and other.name.is_read_in_si):
                raise _bare(bare, other, left, right, sign)
            return other
    if left.exact or right.exact:
        if alike(left.kind, right.kind):
            common = right if left.bare else left
            return common if left.kind == right.kind else replace(common, kind=without_angle(common.kind))
    elif left.kind == right.kind or (
        (left.loose or right.loose) and without_angle(left.kind) == without_angle(right.kind)
    ):
        return right if left.bare else left
    raise ConditionError("{unlike}; {sign} needs the same kind on both sides.", right.place, unlike=_unlike(left, right), sign=sign)  # fmt: skip


def _bare(
    bare: ConditionPart, other: ConditionPart, left: ConditionPart, right: ConditionPart, sign: str
) -> ConditionError:
    """Return what is wrong with a number beside a quantity that needs its unit."""
    kinds = Phrase("{kinds}; ", kinds=_unlike(left, right)) if left.kind != right.kind else ""
    if bare.exact:
        own = pretty(other.name.display) if other.name and other.name.display else phrase("its unit")
        template = "{kinds}the number {shown} beside {other} needs {unit}."
        return ConditionError(template, bare.place, kinds=kinds, shown=bare.shown, other=other.shown, unit=own)
    if other.name is None or not other.name.display:
        template = "{kinds}{sign} needs the same kind on both sides. Quote the quantity with its unit."
        return ConditionError(template, bare.place, kinds=kinds, sign=sign)
    example = f"'{bare.typed or 5} {other.name.display}'"
    template = "{kinds}a number beside {name} needs {pretty}, for example {example}."
    return ConditionError(
        template, bare.place, kinds=kinds, name=other.name.name, pretty=pretty(other.name.display), example=example
    )


def _unlike(left: ConditionPart, right: ConditionPart) -> str:
    return joined_phrases(
        [Phrase("{shown} is {kind}", shown=each.shown, kind=_kind(each)) for each in (left, right)], " and "
    )


def _kind(part: ConditionPart) -> str:
    return told_kind(part.kind, part.name.unit if part.name else "")


# Reads a condition: what Python parsed becomes a tree, each part judged as it joins the others.


MAX_DEPTH = 100  # levels of a tree
Find = Callable[[str], Name]
"""What a name stands for; ConditionError in words where it stands for nothing."""


def read(given: str, known: Collection[str], find: Find, example: str) -> Node:
    """Read a condition; ConditionError in words, with the place, for what it may not say.

    ``known`` names are taken whole whatever they are made of, and may stand in double quotes; ``find`` says what a name is.
    """
    whole = parsed(tokens(given, known))
    part = ConditionReader(whole, find).part(whole.body, 0)
    return condition(part, Phrase("a comparison is needed, such as {example}", example=example))


class ConditionReader:
    """Reads the parts of a condition; of an ``exact`` one, an expression, by the angles of formulas and whole powers."""

    def __init__(self, whole: Parsed, find: Find, exact: bool = False) -> None:
        self.whole, self.find, self.exact = whole, find, exact

    def part(self, at: ast.expr, depth: int) -> ConditionPart:
        """Return the part that a piece of the Python text says."""
        found = self._part(at, depth)
        return replace(found, exact=True) if self.exact else found

    def _part(self, at: ast.expr, depth: int) -> ConditionPart:
        if depth > MAX_DEPTH:
            template = "the condition is nested deeper than {deepest} levels. Write several conditions."
            raise ConditionError(template, self._place(at), deepest=MAX_DEPTH)
        match at:
            case ast.Name():
                return self._leaf(at)
            case ast.UnaryOp(op=ast.USub() | ast.UAdd() | ast.Not()):
                return self._signed(at, depth)
            case ast.BoolOp(op=op, values=values):
                word = "and" if isinstance(op, ast.And) else "or"
                needed = Phrase("{word} stands between conditions; compare both sides with something", word=repr(word))
                nodes = [condition(self.part(each, depth + 1), needed) for each in values]
                return joined(word, nodes, self._place(at))  # type: ignore[arg-type]
            case ast.BinOp(op=ast.Pow(), left=base, right=power):
                return raised(self.part(base, depth + 1), self.part(power, depth + 1))
            case ast.BinOp():
                return self._calculated(at, depth)
            case ast.Call(func=ast.Name() as function, args=given):
                name = self._function(function)
                return called(name, [self.part(each, depth + 1) for each in given], self._place(at))
            case ast.Compare(left=left, ops=ops, comparators=others):
                return self._compared(left, ops, others, depth)
        raise self._unfit(at)

    def _place(self, at: ast.expr) -> int:
        return self.whole.word(at).place

    def _unfit(self, at: ast.expr) -> ConditionError:
        word = self.whole.word(at)
        template = "{shown} does not fit here; use brackets. Allowed: {allowed}."
        return ConditionError(template, word.place, shown=word.shown, allowed=ALLOWED)

    # Names, numbers, texts.

    def _leaf(self, at: ast.Name) -> ConditionPart:
        word = self.whole.word(at)
        if word.sort == "number":
            return number(float(word.text), word.place)
        if word.sort == "text":
            typed = word.text if self.exact else f"'{word.text}'"
            return ConditionPart(TextLiteral(word.text), "quoted", word.place, typed=typed)
        if word.text in ("true", "false") and word.sort == "keyword":
            return ConditionPart(Truth(word.text == "true"), "condition", word.place, typed=word.text)
        try:
            return named(self.find(word.text), word.place)
        except ConditionError as fault:
            raise ConditionError(fault.words, word.place) from None

    def _function(self, at: ast.Name) -> str:
        word = self.whole.word(at)
        if word.text not in FUNCTIONS:
            near = nearest(word.text, FUNCTIONS)
            template = "there is no function {text}{near}; known: {functions}."
            raise ConditionError(template, word.place, text=repr(word.text), near=near, functions=", ".join(FUNCTIONS))
        return word.text

    # Arithmetic.

    def _signed(self, at: ast.UnaryOp, depth: int) -> ConditionPart:
        """Signs and ``not``, each time all that stand before each other, so that they make no depth."""
        is_not, is_turned = isinstance(at.op, ast.Not), False
        inner: ast.expr = at
        while (
            isinstance(inner, ast.UnaryOp)
            and isinstance(inner.op, ast.Not) == is_not
            and not isinstance(inner.op, ast.Invert)
        ):
            is_turned ^= not isinstance(inner.op, ast.UAdd)
            inner = inner.operand
        part = self.part(inner, depth + 1)
        if not is_not:
            return negative(part) if is_turned else quantity(part)
        node = condition(part, phrase("'not' stands before a condition; compare it with something"))
        return contrary(node, self._place(at)) if is_turned else part

    def _calculated(self, at: ast.BinOp, depth: int) -> ConditionPart:
        """A chain of + and - or of * and /, from left to right without a recursion for each."""
        group = (ast.Add, ast.Sub) if isinstance(at.op, ast.Add | ast.Sub) else (ast.Mult, ast.Div)
        rest, left = list[tuple[str, ast.expr]](), cast(ast.expr, at)
        while isinstance(left, ast.BinOp) and isinstance(left.op, group):
            rest.append((BINARY[type(left.op)], left.right))
            left = left.left
        made = self.part(left, depth + 1)
        for sign, right in reversed(rest):
            made = calculated(sign, made, self.part(right, depth + 1))
        return made

    # Comparisons.

    def _compared(self, left: ast.expr, ops: list[ast.cmpop], others: list[ast.expr], depth: int) -> ConditionPart:
        def inner(at: ast.expr) -> ConditionPart:
            return self.part(at, depth + 1)

        match ops, others:
            case _ if all(type(op) in COMPARE for op in ops):
                return compared([COMPARE[type(op)] for op in ops], [inner(at) for at in (left, *others)])
            case [ast.Is() | ast.IsNot() as op], [_]:
                made = ConditionPart(Missing(inner(left).node), "condition", self._place(left))
            case [ast.Is() | ast.IsNot() as op, ast.Is()], [low, high]:
                pairs = [(inner(left), ">=", inner(low)), (inner(left), "<=", inner(high))]
                made = self._joined("and", iter(pairs), left)
            case [ast.In() | ast.NotIn() as op], [ast.UnaryOp(op=ast.Invert(), operand=pattern)]:
                made = like(inner(left), inner(pattern))
            case [ast.In() | ast.NotIn() as op], [ast.List(elts=values)]:
                made = self._joined("or", ((inner(left), "==", inner(each)) for each in values), left)
            case _:
                raise self._unfit(next(chain(others[1:], others)))
        return made if isinstance(op, ast.Is | ast.In) else contrary(made.node, made.place)

    def _joined(
        self, word: str, pairs: Iterator[tuple[ConditionPart, str, ConditionPart]], at: ast.expr
    ) -> ConditionPart:
        nodes = [compared([sign], [one, two]).node for one, sign, two in pairs]
        return joined(word, nodes, self._place(at))  # type: ignore[arg-type]


# Expressions of a configuration: ``${press.sheet.length} + 110 mm`` read, judged and computed, for one machine or for many.


WITHOUT_VALUE = phrase("a division by zero, the root of a number below zero, or a number too large to calculate with")

WORDS = (
    ("the condition ", "the expression "),
    ("Write several conditions.", "Write it in a simpler way."),
    (phrase("a name, a number or a quantity"), phrase("a reference, a number or a quantity")),
)


@dataclass(frozen=True)
class TypedExpression:
    """Hold an expression: its text as typed, its tree, and the kind of what it gives; its names are ``${NAME.KEY}``."""

    text: str
    tree: Node
    kind: Kind

    @cached_property  # it is asked for at each step of a reading
    def names(self) -> tuple[str, ...]:
        """Return the references in it, each once."""
        return names(self.tree)

    def value(self, value_of: Callable[[str], Any]) -> Any:
        """Return its value in SI, NaN where there is none; arrays where the references have arrays."""
        with np.errstate(all="ignore"):
            found = numbers(self.tree, value_of)
        return float(found) if found.ndim == 0 else found

    def known_value(self, known: Mapping[str, Any]) -> Any:
        """Return its value in SI; ConditionError where a single machine gives it none, with why that is so."""
        found = self.value(known.__getitem__)
        if not (isinstance(found, float) and math.isnan(found)):
            return found
        single = (
            Phrase("{name} is {given}", name=name, given=f"{each:.6g}")
            for name, each in known.items()
            if np.ndim(each) == 0
        )
        with np.errstate(all="ignore"):
            too_large = phrase("gives a number that is too large to calculate with")
            fault = next(_faults(self.tree, known.__getitem__), too_large)
        raise ConditionError(
            "“{text}” {fault}, where (in SI) {values}.",
            text=self.text,
            fault=fault,
            values=joined_phrases(single, ", "),
        )

    def refused(self, wanted: str) -> str:
        """Return why it cannot stand where a quantity in the unit ``wanted`` is needed; nothing where it can."""
        needed = unit(wanted)
        if alike(self.kind, needed.kind):
            return ""
        template = "“{text}” gives {told_kind}; {told_kind_2} in {wanted} is needed here"
        return Phrase(
            template,
            text=self.text,
            told_kind=told_kind(self.kind),
            told_kind_2=told_kind(needed.kind, wanted),
            wanted=wanted,
        )


@lru_cache(maxsize=4096)  # a machine of parts has the same five hundred each time that it is read
def _whole(text: str) -> Parsed:
    return parsed(calculation(text))


def read_expression(text: str, find: Find) -> TypedExpression:
    """Read an expression; ConditionError in words, with the place, for what it may not say. ``find`` says what a reference is."""
    try:
        whole = _whole(text)
        made = quantity(ConditionReader(whole, find, exact=True).part(whole.body, 0))
    except ConditionError as fault:
        text_of_fault: str = fault.words  # which tells of conditions
        for of_condition, of_expression in WORDS:
            text_of_fault = text_of_fault.replace(of_condition, of_expression)
        raise ConditionError(text_of_fault, fault.place) from None
    if not names(made.node):
        raise ConditionError("the expression refers to nothing; write the value itself.", 0)
    return TypedExpression(text.strip(), made.node, made.kind)


def _faults(node: Node, value_of: Callable[[str], Any]) -> Iterator[str]:
    """Yield what has no value in a tree, the innermost first."""
    for part in operands(node):
        yield from _faults(part, value_of)
    match node:
        case Chain(_, rest):
            if any(sign == "/" and numbers(part, value_of) == 0.0 for sign, part in rest):
                yield phrase("divides by zero")
        case Power(base, exponent) if numbers(base, value_of) == 0.0 and numbers(exponent, value_of) < 0.0:
            yield phrase("divides by zero")
        case Call("sqrt", (of,)) if numbers(of, value_of) < 0.0:
            yield phrase("takes the root of a number below zero")
