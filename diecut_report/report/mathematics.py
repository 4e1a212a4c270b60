"""Expression trees as LaTeX (the only place where LaTeX stands) and as linear text for search and alternative texts."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterator, Mapping
from typing import Any, NamedTuple

from fontTools.pens.basePen import BasePen

from diecut_report.quantities.units import pretty
from diecut_report.report.text import MINUS, grouped, parts, quantity

# The order of operations in print: which part of an expression stands in brackets, and what stands between factors.
#
# A tree is the nested lists of the results: ``["+", a, b]``, ``["sym", "R_b"]``, ``["qty", "40", "mm"]`` … All printed forms
# put brackets by these rules; they differ in how a fraction or a root looks.


Tree = list[Any]
OR, AND, COMPARE, SUM, PRODUCT, CALL, POWER, ATOM = range(8)  # how tightly a piece holds together
WORDS: Mapping[str, str] = {"if": "if", "otherwise": "otherwise", "and": "and", "or": "or", "not": "not"}
NAMES = {
    "log": "ln", "log10": "lg", "arcsinh": "arsinh", "arccosh": "arcosh", "arctanh": "artanh", "sign": "sgn", "minimum": "min", "maximum": "max",
    "ceil": "ceil", "floor": "floor", "round": "round", "arctan2": "arctan2",
}  # fmt: skip
SIGNS = {"<": "<", "<=": "≤", ">": ">", ">=": "≥", "==": "=", "!=": "≠"}
OPPOSITE = {"+": "-", "-": "+"}
LEVEL = ("min", "max", "minimum", "maximum")  # of as many arguments as there are
POWERS = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"
RAISED, _LOWERED = str.maketrans("0123456789", POWERS[:10]), str.maketrans(POWERS, "0123456789-")
BRACKETS = {"abs": ("|", "|"), "ceil": ("⌈", "⌉"), "floor": ("⌊", "⌋")}


def with_units(tree: Any) -> Any:
    """Return a tree in which a number times one of a unit is a quantity: 40 mm for 40 · 1 mm."""
    if not isinstance(tree, list):
        return tree
    if len(tree) == 3 and tree[0] == "*" and tree[1][:1] == ["num"] and tree[2][:2] == ["qty", "1"]:
        return ["qty", tree[1][1], tree[2][2]]
    return [with_units(part) for part in tree]


class Piece(NamedTuple):
    """A printed part: its text, how tightly it holds together, and what its ends are."""

    text: str
    level: int
    negative: bool = False  # begins with a minus
    digit: bool = False  # begins with a digit
    quantity: bool = False  # ends with a value put in for a symbol, or its unit
    number: bool = False  # ends with a number of the formula itself
    fraction: bool = False


class Linear:
    """Expressions as one line of text. Other forms print the same trees by the same order of operations and brackets."""

    times, dot, comma = "·", " · ", ", "
    signs: Mapping[str, str] = SIGNS
    minus = MINUS

    def __init__(self, words: Mapping[str, str] = WORDS, decimal: str = ".") -> None:
        self.words = words
        self.decimal = decimal

    # what forms say in their own way
    def number(self, text: str) -> str:
        return quantity(text, "1", self.decimal)

    def quantity(self, text: str, unit: str) -> str:
        """A number with its unit."""
        return quantity(text, unit, self.decimal).replace("\u00a0", " ")

    def symbol(self, name: str) -> str:
        """A symbol with its subscript."""
        return name

    def bracket(self, text: str, left: str = "(", right: str = ")") -> str:
        """A text in brackets."""
        return f"{left}{text}{right}"

    def name(self, function: str) -> str:
        return NAMES.get(function, function)

    def called(self, function: str, argument: str) -> str:
        """A function with its argument."""
        return self.name(function) + argument

    def word(self, text: str, before: str = " ", behind: str = " ") -> str:
        """A word between formulas, with its spaces."""
        return f"{before}{text}{behind}"

    def root(self, inner: Piece) -> Piece:
        return Piece(f"√{inner.text if inner.level == ATOM else self.bracket(inner.text)}", POWER)

    def fraction(self, over: Piece, under: Piece) -> Piece:
        upper = over.text if over.level >= PRODUCT or (over.negative and over.level > SUM) else self.bracket(over.text)
        lower = under.text if under.level >= CALL else self.bracket(under.text)
        return Piece(f"{upper}/{lower}", PRODUCT, over.negative and over.level >= PRODUCT, over.digit, fraction=True)

    def power(self, base: str, exponent: Tree) -> str:
        """A base, brackets included, with its exponent."""
        text = self(exponent)
        return base + text.translate(RAISED) if text.isdecimal() else f"{base}^({text})"

    def cases(self, rows: list[tuple[str, str]]) -> str:
        """Values, each with its condition."""
        return "{" + "; ".join(f"{value} {condition}" for value, condition in rows) + "}"

    # what is the same in all
    def __call__(self, tree: Tree) -> str:
        """The whole tree as text."""
        return self.piece(tree).text

    def piece(self, tree: Tree) -> Piece:
        """A tree as a printed part."""
        match tree:
            case ["num", text]:
                return self._numeric(text, self.number(text), "1")._replace(quantity=False, number=True)
            case ["qty", text, unit]:
                return self._numeric(text, self.quantity(text, unit), unit)
            case ["sym", name]:
                return Piece(self.symbol(name), ATOM)
            case ["neg", inner]:
                return Piece(f"{self.minus}{self._held(inner, PRODUCT, first=False)}", SUM, negative=True)
            case ["+" | "-", *_]:
                return self._sum(tree)
            case ["*", *_]:
                return self._product(factors(tree))
            case ["/", over, under]:
                return self.fraction(self.piece(over), self.piece(under))
            case ["^", base, exponent]:
                is_number = base[0] in ("num", "qty")
                text = self.power(self._held(base, ATOM), exponent)
                return Piece(text, POWER, digit=is_number, quantity=is_number)
            case ["call", name, *args]:
                return self._call(name, [self.piece(a) for a in _nested(name, args)])
            case ["at", symbol, *place]:
                return Piece(self(symbol) + self.bracket(f" {self.signs['==']} ".join(map(self, place))), POWER)
            case ["apply", name, *args]:
                said = self.name(name) if len(name) > 1 and name.isalpha() else self.symbol(name)
                return Piece(said + self.bracket(self.comma.join(map(self, args))), POWER)
        return self._logic(tree)

    def _logic(self, tree: Tree) -> Piece:
        match tree:
            case ["cmp", sign, left, right]:
                return Piece(f"{self._held(left, COMPARE)} {self.signs[sign]} {self._held(right, SUM)}", COMPARE)
            case ["and" | "or" as word, left, right]:
                level = AND if word == "and" else OR
                return Piece(f"{self._held(left, level)}{self.word(self.words[word])}{self._held(right, level)}", level)
            case ["not", inner]:
                return Piece(f"{self.word(self.words['not'], before='')}{self.bracket(self(inner))}", POWER)
            case ["cases", *branches]:
                otherwise = self.word(self.words["otherwise"], before="", behind="")
                if_ = self.word(self.words["if"], before="")
                rows = [(self(value), f"{if_}{self(when[0])}" if when else otherwise) for value, *when in branches]
                return Piece(self.cases(rows), OR)
        raise ValueError(f"no expression: {tree!r}")

    def _numeric(self, text: str, printed: str, unit: str) -> Piece:
        found = parts(text)
        if found is None:
            return Piece(printed, ATOM)
        negative, scaled = found[0] == "-", found[3] != 0
        level = SUM if negative else PRODUCT if scaled or pretty(unit) else ATOM
        return Piece(printed, level, negative, not negative, quantity=True)

    def _held(self, tree: Tree, level: int, *, first: bool = True) -> str:
        """A part inside another: in brackets where it holds less tightly, or begins with a minus and is not first."""
        piece = self.piece(tree)
        loose = piece.level < level or (piece.negative and not first)
        return self.bracket(piece.text) if loose else piece.text

    def _sum(self, tree: Tree) -> Piece:
        pieces = [(sign, self.piece(term)) for sign, term in map(_plain_sign, terms(tree))]
        text = pieces[0][1].text if pieces[0][1].level >= SUM else self.bracket(pieces[0][1].text)
        for sign, piece in pieces[1:]:
            loose = piece.negative or piece.level < SUM or (sign == "-" and piece.level == SUM)
            text += f" {self.minus if sign == '-' else '+'} {self.bracket(piece.text) if loose else piece.text}"
        return Piece(text, SUM, pieces[0][1].negative)

    def _product(self, trees: list[Tree]) -> Piece:
        pieces = [self._factor(tree, index, trees) for index, tree in enumerate(trees)]
        text, last = pieces[0].text, pieces[0]
        for piece in pieces[1:]:
            text += (self.dot if dotted(last, piece) else self.times) + piece.text
            last = piece
        return Piece(text, PRODUCT, pieces[0].negative, pieces[0].digit, last.quantity)

    def _factor(self, tree: Tree, index: int, trees: list[Tree]) -> Piece:
        piece = self.piece(tree)
        follows = trees[index + 1] if index + 1 < len(trees) else None
        bare = tree[0] == "call" and piece.level == CALL
        if bare and follows is not None and follows[0] != "call":
            return Piece(self.called(tree[1], self.bracket(self(tree[2]))), POWER)
        if piece.level < PRODUCT and (not piece.negative or index > 0 or tree[0] in "+-"):
            is_value = piece.quantity or tree[0] == "num"
            return Piece(self.bracket(piece.text), ATOM, quantity=is_value, digit=tree[0] in ("num", "qty"))
        return piece

    def _exponent(self, tree: Tree) -> str:
        """An exponent whose fraction is set in the line."""
        if tree[0] != "/":
            return self(tree)
        return f"{self._held(tree[1], PRODUCT)}/{self._held(tree[2], POWER)}"

    def _call(self, name: str, args: list[Piece]) -> Piece:
        if name == "sqrt":
            return self.root(args[0])
        if name in BRACKETS:
            return Piece(self.bracket(args[0].text, *BRACKETS[name]), ATOM)
        if len(args) == 1 and args[0].level == ATOM and not args[0].digit:
            return Piece(self.called(name, f" {args[0].text}"), CALL)
        return Piece(self.called(name, self.bracket(self.comma.join(a.text for a in args))), POWER)


def dotted(left: Piece, right: Piece) -> bool:
    """Whether two factors need a dot between them: before a digit, after a value, or where a mixed number would be read."""
    return right.digit or left.quantity or (left.number and right.fraction)


def _plain_sign(term: tuple[str, Tree]) -> tuple[str, Tree]:
    """A term that begins with a minus of its own number, as one that is taken away: + (−0.131 w) is − 0.131 w."""
    sign, tree = term
    match tree:
        case ["*", ["neg", ["num", _] as number], right]:
            return OPPOSITE[sign], ["*", number, right]
        case ["*", ["num", text], right] if text.startswith("-"):
            return OPPOSITE[sign], ["*", ["num", text[1:]], right]
        case ["*", ["*", *_] as left, right]:
            new, first = _plain_sign((sign, left))
            return new, ["*", first, right]
    return term


def _nested(name: str, args: list[Tree]) -> list[Tree]:
    """The arguments of a function; those of the same function within it stand beside them: min(min(a, b), c) is min(a, b, c)."""
    if name not in LEVEL:
        return args
    own = NAMES.get(name, name)
    within = [_nested(name, a[2:]) if a[0] == "call" and NAMES.get(a[1], a[1]) == own else [a] for a in args]
    return [inner for several in within for inner in several]


def terms(tree: Tree) -> list[tuple[str, Tree]]:
    """The top-level terms of a sum with their signs; a lone tree is one term."""
    match tree:
        case ["+" | "-" as sign, left, right]:
            return [*terms(left), (sign, right)]
    return [("+", tree)]


def factors(tree: Tree) -> list[Tree]:
    """The factors of a chain of products."""
    match tree:
        case ["*", left, right]:
            return [*factors(left), *factors(right)]
    return [tree]


def letters_of(tree: Any) -> Iterator[str]:
    """The symbols of a tree, from left to right."""
    match tree:
        case ["sym", name]:
            yield name
        case list():
            for part in tree:
                yield from letters_of(part)


PRIMES = "′'"


class Latex(Linear):
    """Expressions as LaTeX, of the small part that math-core and mathra both read."""

    times, dot, comma = r"\,", r" \cdot ", r",\, "
    signs: Mapping[str, str] = {"<": "<", "<=": r"\le", ">": ">", ">=": r"\ge", "==": "=", "!=": r"\ne"}
    minus = "-"
    fences: Mapping[str, str] = {"⌈": r"\lceil ", "⌉": r"\rceil ", "⌊": r"\lfloor ", "⌋": r"\rfloor "}
    known: Collection[str] = {
        "sin",
        "cos",
        "tan",
        "arcsin",
        "arccos",
        "arctan",
        "sinh",
        "cosh",
        "tanh",
        "exp",
        "ln",
        "lg",
        "min",
        "max",
    }

    def number(self, text: str) -> str:
        found = parts(text)
        if found is None:
            return rf"\text{{{escaped(text)}}}"
        sign, whole, decimals, power = found
        sign_of_decimals = "." if self.decimal == "." else f"{{{self.decimal}}}"
        body = grouped(whole, r"\,") + (sign_of_decimals + decimals if decimals else "")
        return f"{sign.replace('+', '')}{body}" + (rf" \times 10^{{{power}}}" if power else "")

    def quantity(self, text: str, unit: str) -> str:
        printed = unit_latex(unit)
        space = "" if not printed or printed.startswith("°") else r"\,"
        return f"{self.number(text)}{space}{printed}"

    def symbol(self, name: str) -> str:
        if name[:1] == name[-1:] == "|" and len(name) > 2:
            return self.bracket(self.symbol(name[1:-1]), "|", "|")
        base, _, below = name.partition("_")
        if not base:
            return "{}"
        letters, plain = base.rstrip(PRIMES), below.rstrip(PRIMES)
        prime = "'" * (len(base) - len(letters) + len(below) - len(plain))
        text = (rf"\mathit{{{letters}}}" if len(letters) > 1 and letters.isalpha() else letters) + prime
        return f"{text}_{{{subscript_latex(plain)}}}" if plain else text

    def bracket(self, text: str, left: str = "(", right: str = ")") -> str:
        tall = left == "|" or any(part in text for part in (r"\frac", r"\sqrt", r"\begin"))
        opening, closing = self.fences.get(left, left), self.fences.get(right, right)
        return rf"\left{opening} {text} \right{closing}" if tall else f"{opening}{text}{closing}"

    def name(self, function: str) -> str:
        said = NAMES.get(function, function)
        return rf"\{said}" if said in self.known else rf"\operatorname{{{said}}}"

    def word(self, text: str, before: str = " ", behind: str = " ") -> str:
        return rf"\text{{{before}{text}{behind}}}"

    def root(self, inner: Piece) -> Piece:
        return Piece(rf"\sqrt{{{inner.text}}}", POWER)

    def fraction(self, over: Piece, under: Piece) -> Piece:
        text = rf"\frac{{{over.text}}}{{{under.text}}}"
        return Piece(text, PRODUCT, quantity=over.quantity and under.quantity, fraction=True)

    def power(self, base: str, exponent: Tree) -> str:
        held = base if _PLAIN_BASE.fullmatch(base) else f"{{{base}}}"
        return f"{held}^{{{self._exponent(exponent)}}}"

    def cases(self, rows: list[tuple[str, str]]) -> str:
        lines = r" \\ ".join(f"{value} & {condition}" for value, condition in rows)
        return rf"\begin{{cases}} {lines} \end{{cases}}"


_PLAIN_BASE = re.compile(r"[^\W_](_\{.*\})?")  # a letter, whose exponent stands above its subscript

_SPECIAL = str.maketrans({
    "\\": r"\backslash ", "~": r"\sim ", "^": r"\hat{}", **{sign: rf"\{sign}" for sign in "{}$&#%_"},
})  # fmt: skip


def escaped(text: str) -> str:
    """A text for ``\\text{…}``."""
    return text.translate(_SPECIAL)


def subscript_latex(text: str) -> str:
    """A subscript: words and letters upright, digits as they are, commas and hyphens between them kept."""
    words = re.split(r"([,\s_-]+)", text)
    joints = str.maketrans({"_": r"\,", " ": r"\,", "-": r"\text{-}"})
    return "".join(part.translate(joints) if index % 2 else _upright(part) for index, part in enumerate(words) if part)


def _upright(part: str) -> str:
    return part if part.isdecimal() or unicodedata.category(part[0]) == "Sm" else rf"\mathrm{{{escaped(part)}}}"


def unit_latex(unit: str) -> str:
    """A unit, upright."""
    printed = pretty(unit)
    if not printed:
        return ""
    raised = re.sub(f"[{POWERS}]+", lambda found: f"^{{{found[0].translate(_LOWERED)}}}", printed)
    upright = re.sub(r"[^\W\d]+|%", lambda m: r"\%" if m[0] == "%" else rf"\mathrm{{{m[0]}}}", raised)
    return upright.replace("·", r"{\cdot}")


# Paths as the operators of a PDF.


class OperatorPen(BasePen):  # type: ignore[misc]  # fontTools has no types
    """Writes a path as PDF operators; quadratic curves come as cubic ones."""

    def __init__(self, glyphs: Any = None) -> None:
        super().__init__(glyphs)
        self.operators: list[str] = []

    def _moveTo(self, pt: tuple[float, float]) -> None:  # noqa: N802
        self._add("m", pt)

    def _lineTo(self, pt: tuple[float, float]) -> None:  # noqa: N802
        self._add("l", pt)

    def _curveToOne(self, *points: tuple[float, float]) -> None:  # noqa: N802
        self._add("c", *points)

    def _closePath(self) -> None:  # noqa: N802
        self.operators.append("h")

    def _add(self, operator: str, *points: tuple[float, float]) -> None:
        self.operators.append(" ".join([*(f"{value:g}" for point in points for value in point), operator]))
