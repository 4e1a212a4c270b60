"""Reads a condition: what Python parsed becomes a tree, each part judged as it joins the others."""

from __future__ import annotations

import ast
from collections.abc import Callable, Collection, Iterator
from dataclasses import replace
from itertools import chain

from diecut_report.conditions import parts
from diecut_report.conditions.grammar import Parsed, parsed
from diecut_report.conditions.parts import ConditionPart, Name
from diecut_report.conditions.tree import (
    Missing,
    Node,
    TextLiteral,
    Truth,
)
from diecut_report.conditions.words import ALLOWED, FUNCTIONS, ConditionError
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase

DEEPEST = 100  # levels of a tree
Find = Callable[[str], Name]
"""What a name stands for; ConditionError in words where it stands for nothing."""
_ARITHMETIC: dict[type[ast.operator], str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
_SIGNS: dict[type[ast.cmpop], str] = {
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=",
}  # fmt: skip


def read(given: str, known: Collection[str], find: Find, example: str) -> Node:
    """Read a condition; ConditionError in words, with the place, for what it may not say.

    ``known`` names are taken whole whatever they are made of, and may stand in double quotes; ``find`` says what a name is.
    """
    whole = parsed(given, known)
    part = ConditionReader(whole, find).part(whole.body, 0)
    return parts.condition(part, Phrase("a comparison is needed, such as {example}", example=example))


class ConditionReader:
    """Reads the parts of a condition; of an ``exact`` one, an expression, by the angles of formulas and whole powers."""

    def __init__(self, whole: Parsed, find: Find, exact: bool = False) -> None:
        self.whole, self.find, self.exact = whole, find, exact

    def part(self, at: ast.expr, depth: int) -> ConditionPart:
        """Return the part that a piece of the Python text says."""
        found = self._part(at, depth)
        return replace(found, exact=True) if self.exact else found

    def _part(self, at: ast.expr, depth: int) -> ConditionPart:
        if depth > DEEPEST:
            words = Phrase(
                "the condition is nested deeper than {deepest} levels. Write several conditions.", deepest=DEEPEST
            )
            raise ConditionError(words, self._place(at))
        match at:
            case ast.Name():
                return self._leaf(at)
            case ast.UnaryOp(op=ast.USub() | ast.UAdd() | ast.Not()):
                return self._signed(at, depth)
            case ast.BoolOp(op=op, values=values):
                word = "and" if isinstance(op, ast.And) else "or"
                nodes = [parts.condition(self.part(each, depth + 1), _between(word)) for each in values]
                return parts.joined(word, nodes, self._place(at))  # type: ignore[arg-type]
            case ast.BinOp(op=ast.Pow(), left=base, right=power):
                return parts.raised(self.part(base, depth + 1), self.part(power, depth + 1))
            case ast.BinOp(op=op) if type(op) in _ARITHMETIC:
                return self._calculated(at, depth)
            case ast.Call(func=ast.Name() as function, args=given):
                name = self._function(function)
                return parts.called(name, [self.part(each, depth + 1) for each in given], self._place(at))
            case ast.Compare(left=left, ops=ops, comparators=others):
                return self._compared(left, ops, others, depth)
        raise self._unfit(at)

    def _place(self, at: ast.expr) -> int:
        return self.whole.word(at).place

    def _unfit(self, at: ast.expr) -> ConditionError:
        word = self.whole.word(at)
        return ConditionError(
            Phrase("{shown} does not fit here; use brackets. Allowed: {allowed}.", shown=word.shown, allowed=ALLOWED),
            word.place,
        )

    # --- names, numbers, texts ---

    def _leaf(self, at: ast.Name) -> ConditionPart:
        word = self.whole.word(at)
        if word.sort == "number":
            return parts.number(float(word.text), word.place)
        if word.sort == "text":
            typed = word.text if self.exact else f"'{word.text}'"
            return ConditionPart(TextLiteral(word.text), "quoted", word.place, typed=typed)
        if word.text in ("true", "false") and word.sort == "keyword":
            return ConditionPart(Truth(word.text == "true"), "condition", word.place, typed=word.text)
        try:
            return parts.named(self.find(word.text), word.place)
        except ConditionError as fault:
            raise ConditionError(fault.words, word.place) from None

    def _function(self, at: ast.Name) -> str:
        word = self.whole.word(at)
        if word.text not in FUNCTIONS:
            near = nearest(word.text, FUNCTIONS)
            words = Phrase(
                "there is no function {text}{near}; known: {functions}.",
                text=repr(word.text),
                near=near,
                functions=", ".join(FUNCTIONS),
            )
            raise ConditionError(words, word.place)
        return word.text

    # --- arithmetic ---

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
            return parts.negative(part) if is_turned else parts.quantity(part)
        node = parts.condition(part, phrase("'not' stands before a condition; compare it with something"))
        return parts.contrary(node, self._place(at)) if is_turned else part

    def _calculated(self, at: ast.BinOp, depth: int) -> ConditionPart:
        """A chain of + and - or of * and /, from left to right without a recursion for each."""
        group = (ast.Add, ast.Sub) if isinstance(at.op, ast.Add | ast.Sub) else (ast.Mult, ast.Div)
        rest, left = list[tuple[str, ast.expr]](), at.left
        rest.append((_ARITHMETIC[type(at.op)], at.right))
        while isinstance(left, ast.BinOp) and isinstance(left.op, group):
            rest.append((_ARITHMETIC[type(left.op)], left.right))
            left = left.left
        made = self.part(left, depth + 1)
        for sign, right in reversed(rest):
            made = parts.calculated(sign, made, self.part(right, depth + 1))
        return made

    # --- comparisons ---

    def _compared(self, left: ast.expr, ops: list[ast.cmpop], others: list[ast.expr], depth: int) -> ConditionPart:
        def inner(at: ast.expr) -> ConditionPart:
            return self.part(at, depth + 1)

        match ops, others:
            case _ if all(type(op) in _SIGNS for op in ops):
                return parts.compared([_SIGNS[type(op)] for op in ops], [inner(at) for at in (left, *others)])
            case [ast.Is() | ast.IsNot() as op], [_]:
                made = ConditionPart(Missing(inner(left).node), "condition", self._place(left))
            case [ast.Is() | ast.IsNot() as op, ast.Is()], [low, high]:
                pairs = [(inner(left), ">=", inner(low)), (inner(left), "<=", inner(high))]
                made = self._joined("and", iter(pairs), left)
            case [ast.In() | ast.NotIn() as op], [ast.UnaryOp(op=ast.Invert(), operand=pattern)]:
                made = parts.like(inner(left), inner(pattern))
            case [ast.In() | ast.NotIn() as op], [ast.List(elts=values)]:
                made = self._joined("or", ((inner(left), "==", inner(each)) for each in values), left)
            case _:
                raise self._unfit(next(chain(others[1:], others)))
        return made if isinstance(op, ast.Is | ast.In) else parts.contrary(made.node, made.place)

    def _joined(
        self, word: str, pairs: Iterator[tuple[ConditionPart, str, ConditionPart]], at: ast.expr
    ) -> ConditionPart:
        nodes = [parts.compared([sign], [one, two]).node for one, sign, two in pairs]
        return parts.joined(word, nodes, self._place(at))  # type: ignore[arg-type]


def _between(word: str) -> str:
    return Phrase("{word} stands between conditions; compare both sides with something", word=repr(word))
