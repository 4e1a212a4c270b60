"""The parts of a condition and how they join: the kind of each quantity is judged, and the words where it does not fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Literal

import numpy as np

from diecut_report.conditions.kinds import NUMBER, alike, told_kind, without_angle
from diecut_report.conditions.numpy_emitter import numbers
from diecut_report.conditions.tree import (
    Call,
    Chain,
    ColumnName,
    Compared,
    Joined,
    Like,
    Negative,
    Node,
    Not,
    Number,
    Power,
    TextLiteral,
    names,
)
from diecut_report.conditions.words import ConditionError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.phrases import joined as joined_phrases
from diecut_report.quantities.units import (
    Kind,
    UnitError,
    number_and_unit,
    parse_quantity,
    pretty,
    unit,
)

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
        raise ConditionError(phrase("the condition holds a number that is too large to calculate with."), place)
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
        words = Phrase("{shown} is a {what}; a quantity is needed to calculate with or to compare by size.", shown=part.shown,
            what=part.what)  # fmt: skip
        raise ConditionError(words, part.place)
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
        raise ConditionError(Phrase("{shown} stands alone; compare it with a text in quotes.", shown=part.shown), part.place)  # fmt: skip
    if part.what != "condition":
        raise ConditionError(Phrase("{shown} is not a condition; {needed_by}.", shown=part.shown, needed_by=needed_by), part.place)  # fmt: skip
    return part.node


def joined(word: Literal["and", "or"], nodes: Sequence[Node], place: int) -> ConditionPart:
    """Return conditions joined by ``and`` or ``or``."""
    return ConditionPart(nodes[0] if len(nodes) == 1 else Joined(word, tuple(nodes)), "condition", place)


def contrary(node: Node, place: int) -> ConditionPart:
    """Return the contrary of a condition."""
    return ConditionPart(Not(node), "condition", place)


# --- comparisons -----------------------------------------------------------------------------------------------------


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
        words = Phrase("{shown} and {shown_2} are a text and a {other}; put texts in quotes.", shown=left.shown, shown_2=right.shown,
            other=other)  # fmt: skip
        raise ConditionError(words, right.place)
    left, right = quantity(left, right), quantity(right, left)
    _alike(left, right, sign)
    return Compared(sign, left.node, right.node)


def like(text: ConditionPart, pattern: ConditionPart) -> ConditionPart:
    """Return whether a text is like a pattern in quotes."""
    if text.what != "text" or not isinstance(pattern.node, TextLiteral) or not isinstance(text.node, ColumnName):
        words = phrase("'like' compares a column of words with a pattern in quotes, such as 'drive.%'.")
        raise ConditionError(words, pattern.place)
    return ConditionPart(Like(text.node, pattern.node.value), "condition", text.place)


# --- arithmetic ------------------------------------------------------------------------------------------------------


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
        words = Phrase("the exponent {shown} is {kind}; a number is needed.", shown=power.shown, kind=_kind(power))
        raise ConditionError(words, power.place)
    constant = _constant(power.node)
    if base.exact and (constant is None or not constant.is_integer()):
        words = Phrase("the exponent {shown} is not a whole number that is written here; take sqrt(…) for a root.", shown=power.shown)  # fmt: skip
        raise ConditionError(words, power.place)
    node = Power(base.node, power.node)
    if base.kind == NUMBER:
        return ConditionPart(node, "quantity", base.place, bare=base.bare and power.bare, loose=True)
    exponent = _constant(power.node)
    if exponent is None or not abs(exponent) <= MAX_EXPONENT:
        words = Phrase("the exponent of {shown} must be a number between -{max_exponent} and {max_exponent}.", shown=base.shown,
            max_exponent=MAX_EXPONENT)  # fmt: skip
        raise ConditionError(words, power.place)
    return ConditionPart(
        node, "quantity", base.place, tuple(round(exponent * share, 9) for share in base.kind), loose=True
    )


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
        raise ConditionError(Phrase("{name} takes {wanted}; {count} given.", name=name, wanted=wanted, count=len(parts)), place)  # fmt: skip
    whole = reduce(lambda one, two: _alike(one, two, name), parts)
    bare, loose = all(part.bare for part in parts), any(part.loose for part in parts)
    made = replace(
        whole, node=Call(name, tuple(part.node for part in parts)), place=place, bare=bare, loose=loose, typed=""
    )
    if name == "sqrt":
        return replace(made, kind=tuple(0.5 * share for share in whole.kind), loose=True, name=None)
    return made


# --- kinds -----------------------------------------------------------------------------------------------------------


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
        raise ConditionError(Phrase("{unlike}; {sign} needs the same kind on both sides.", unlike=_unlike(left, right), sign=sign),
            right.place)  # fmt: skip
    is_loose = left.loose or right.loose
    if left.kind == right.kind or (is_loose and without_angle(left.kind) == without_angle(right.kind)):
        return right if left.bare else left
    raise ConditionError(Phrase("{unlike}; {sign} needs the same kind on both sides.", unlike=_unlike(left, right), sign=sign),
        right.place)  # fmt: skip


def _bare(
    bare: ConditionPart, other: ConditionPart, left: ConditionPart, right: ConditionPart, sign: str
) -> ConditionError:
    """Return what is wrong with a number beside a quantity that needs its unit."""
    kinds = Phrase("{kinds}; ", kinds=_unlike(left, right)) if left.kind != right.kind else ""
    if bare.exact:
        own = pretty(other.name.display) if other.name and other.name.display else phrase("its unit")
        words = "{kinds}the number {shown} beside {other} needs {unit}."
        return ConditionError(Phrase(words, kinds=kinds, shown=bare.shown, other=other.shown, unit=own), bare.place)
    if other.name is None or not other.name.display:
        words = Phrase("{kinds}{sign} needs the same kind on both sides. Quote the quantity with its unit.", kinds=kinds, sign=sign)  # fmt: skip
        return ConditionError(words, bare.place)
    example = f"'{bare.typed or 5} {other.name.display}'"
    words = Phrase("{kinds}a number beside {name} needs {pretty}, for example {example}.", kinds=kinds, name=other.name.name, pretty=pretty(
        other.name.display), example=example)  # fmt: skip
    return ConditionError(words, bare.place)


def _unlike(left: ConditionPart, right: ConditionPart) -> str:
    return joined_phrases(
        [Phrase("{shown} is {kind}", shown=each.shown, kind=_kind(each)) for each in (left, right)], " and "
    )


def _kind(part: ConditionPart) -> str:
    return told_kind(part.kind, part.name.unit if part.name else "")
