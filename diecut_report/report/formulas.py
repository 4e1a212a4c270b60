"""Expression trees as LaTeX (the only place where LaTeX stands) and as linear text for search and alternative texts."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping

from diecut_report.report.numbers import MINUS, grouped, parts, quantity
from diecut_report.report.printing import ATOM, CALL, NAMES, POWER, PRODUCT, SUM, Piece, Printer, Tree
from diecut_report.units import pretty

PRIMES = "′'"


class Latex(Printer):
    """Expressions as LaTeX, of the small part that math-core and mathra both read."""

    times, dot, comma = r"\,", r" \cdot ", r",\, "
    signs: Mapping[str, str] = {"<": "<", "<=": r"\le", ">": ">", ">=": r"\ge", "==": "=", "!=": r"\ne"}
    fences: Mapping[str, str] = {
        "(": "(",
        ")": ")",
        "|": "|",
        "⌈": r"\lceil ",
        "⌉": r"\rceil ",
        "⌊": r"\lfloor ",
        "⌋": r"\rfloor ",
    }
    known = frozenset(
        ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "lg", "min", "max"]
    )

    def number(self, text: str) -> str:
        found = parts(text)
        if found is None:
            return rf"\text{{{escaped(text)}}}"
        sign, whole, decimals, power = found
        body = grouped(whole, r"\,") + (
            ("." if self.decimal == "." else f"{{{self.decimal}}}") + decimals if decimals else ""
        )
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
        opening, closing = self.fences[left], self.fences[right]
        return rf"\left{opening} {text} \right{closing}" if tall else f"{opening}{text}{closing}"

    def name(self, function: str) -> str:
        said = NAMES.get(function, function)
        return rf"\{said}" if said in self.known else rf"\operatorname{{{said}}}"

    def word(self, text: str, before: str = " ", behind: str = " ") -> str:
        return rf"\text{{{before}{text}{behind}}}"

    def root(self, inner: Piece) -> Piece:
        return Piece(rf"\sqrt{{{inner.text}}}", POWER)

    def fraction(self, over: Piece, under: Piece) -> Piece:
        return Piece(
            rf"\frac{{{over.text}}}{{{under.text}}}", PRODUCT, quantity=over.quantity and under.quantity, fraction=True
        )

    def power(self, base: str, exponent: Tree) -> str:
        held = base if _PLAIN_BASE.fullmatch(base) else f"{{{base}}}"
        return f"{held}^{{{self(exponent) if exponent[0] != '/' else self._slashed(exponent)}}}"

    def _slashed(self, exponent: Tree) -> str:
        return f"{self._held(exponent[1], PRODUCT)}/{self._held(exponent[2], POWER)}"

    def cases(self, rows: list[tuple[str, str]]) -> str:
        lines = r" \\ ".join(f"{value} & {condition}" for value, condition in rows)
        return rf"\begin{{cases}} {lines} \end{{cases}}"


class Linear(Printer):
    """Expressions as one line of text."""

    times, dot, comma = "·", " · ", ", "
    minus = MINUS
    raised = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")

    def number(self, text: str) -> str:
        return quantity(text, "1", self.decimal)

    def quantity(self, text: str, unit: str) -> str:
        return quantity(text, unit, self.decimal).replace("\u00a0", " ")

    def symbol(self, name: str) -> str:
        return name

    def bracket(self, text: str, left: str = "(", right: str = ")") -> str:
        return f"{left}{text}{right}"

    def name(self, function: str) -> str:
        return NAMES.get(function, function)

    def word(self, text: str, before: str = " ", behind: str = " ") -> str:
        return f"{before}{text}{behind}"

    def root(self, inner: Piece) -> Piece:
        return Piece(f"√{inner.text if inner.level == ATOM else self.bracket(inner.text)}", POWER)

    def fraction(self, over: Piece, under: Piece) -> Piece:
        upper = over.text if over.level >= PRODUCT or (over.negative and over.level > SUM) else self.bracket(over.text)
        lower = under.text if under.level >= CALL else self.bracket(under.text)
        return Piece(f"{upper}/{lower}", PRODUCT, over.negative and over.level >= PRODUCT, over.digit, fraction=True)

    def power(self, base: str, exponent: Tree) -> str:
        text = self(exponent)
        return base + text.translate(self.raised) if text.isdecimal() else f"{base}^({text})"

    def cases(self, rows: list[tuple[str, str]]) -> str:
        return "{" + "; ".join(f"{value} {condition}" for value, condition in rows) + "}"


_PLAIN_BASE = re.compile(r"[^\W_](_\{.*\})?")  # a letter, whose exponent stands above its subscript

_SPECIAL = {
    "\\": r"\backslash ",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "#": r"\#",
    "%": r"\%",
    "_": r"\_",
    "~": r"\sim ",
    "^": r"\hat{}",
}


def escaped(text: str) -> str:
    """A text for ``\\text{…}``."""
    return "".join(_SPECIAL.get(character, character) for character in text)


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
    raised = re.sub(r"[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda m: f"^{{{m[0].translate(_LOWERED)}}}", printed)
    upright = re.sub(r"[^\W\d]+|%", lambda m: r"\%" if m[0] == "%" else rf"\mathrm{{{m[0]}}}", raised)
    return upright.replace("·", r"{\cdot}")


_LOWERED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
