"""Equations as Office Math, which is edited in a word processor: printed from the same trees, by the same rules of brackets, as LaTeX.

A piece is XML in which operators stand as plain text between elements; at the end that text is put into runs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

from diecut_report.quantities.units import pretty
from diecut_report.report.equations import Equation, EquationRow, Link
from diecut_report.report.expression_printer import ATOM, NAMES, POWER, PRODUCT, SUM, Piece, Printer, Tree
from diecut_report.report.latex import PRIMES
from diecut_report.report.number_format import MINUS, grouped, parts
from diecut_report.report.office.archive import holdable

SPACE = "http://schemas.openxmlformats.org/officeDocument/2006/math"
NARROW, WIDE, NOTHING = "\u2009", "\u2003", "\u200b"
_TEXT_HOLDERS = {f"{{{SPACE}}}{name}" for name in ("oMath", "e", "num", "den", "sub", "sup", "fName")}
ElementTree.register_namespace("m", SPACE)
_INDEXED = re.compile(r"<m:sSub><m:e>((?:(?!<m:sSub>).)*)</m:e><m:sub>((?:(?!<m:sSub>).)*)</m:sub></m:sSub>")


def run(text: str, style: str = "p") -> str:
    """A text in mathematics, upright (``p``), italic (``i``), or as in a sentence (an empty style)."""
    form = f'<m:sty m:val="{style}"/>' if style else "<m:nor/>"
    return f'<m:r><m:rPr>{form}</m:rPr><m:t xml:space="preserve">{escape(holdable(text))}</m:t></m:r>'


class OfficeMath(Printer):
    """Expressions as Office Math."""

    times, dot, comma = NARROW, "·", ", "
    minus = MINUS
    signs: Mapping[str, str] = {"<": "&lt;", "<=": "≤", ">": "&gt;", ">=": "≥", "==": "=", "!=": "≠"}

    def number(self, text: str) -> str:
        """A number, its power of ten raised."""
        found = parts(text)
        if found is None:
            return run(text, "")
        sign, whole, decimals, power = found
        body = (MINUS if sign == "-" else "") + grouped(whole) + (self.decimal + decimals if decimals else "")
        ten = f"<m:sSup><m:e>{run('10')}</m:e><m:sup>{run(str(power).replace('-', MINUS))}</m:sup></m:sSup>"
        return run(f"{body}{NARROW}×{NARROW}") + ten if power else run(body)

    def quantity(self, text: str, unit: str) -> str:
        """A number with its unit, upright."""
        printed = pretty(unit)
        space = "" if printed.startswith(("°", "′", "″")) else "\u00a0"
        return self.number(text) + (run(space + printed) if printed else "")

    def symbol(self, name: str) -> str:
        """A symbol: its letter italic, its index upright."""
        if name[:1] == name[-1:] == "|" and len(name) > 2:
            return self.bracket(self.symbol(name[1:-1]), "|", "|")
        base, _, below = name.partition("_")
        if not base:
            return ""
        plain = below.rstrip(PRIMES)
        letter = run(base + below[len(plain) :], "i")
        index = run(plain.replace("_", NARROW))
        return f"<m:sSub><m:e>{letter}</m:e><m:sub>{index}</m:sub></m:sSub>" if plain else letter

    def bracket(self, text: str, left: str = "(", right: str = ")") -> str:
        """A text in brackets, which grow with it."""
        ends = f"<m:begChr m:val={quoteattr(left)}/><m:endChr m:val={quoteattr(right)}/>"
        return f"<m:d><m:dPr>{ends}</m:dPr><m:e>{text}</m:e></m:d>"

    def name(self, function: str) -> str:
        """A function's name, upright."""
        return run(NAMES.get(function, function))

    def word(self, text: str, before: str = " ", behind: str = " ") -> str:
        """A word between formulas."""
        return run(f"{before}{text}{behind}", "")

    def root(self, inner: Piece) -> Piece:
        """A square root."""
        form = '<m:radPr><m:degHide m:val="1"/></m:radPr><m:deg/>'
        return Piece(f"<m:rad>{form}<m:e>{inner.text}</m:e></m:rad>", POWER)

    def fraction(self, over: Piece, under: Piece) -> Piece:
        """A fraction."""
        text = f"<m:f><m:num>{over.text}</m:num><m:den>{under.text}</m:den></m:f>"
        return Piece(text, PRODUCT, quantity=over.quantity and under.quantity, fraction=True)

    def power(self, base: str, exponent: Tree) -> str:
        """A base with its exponent, which stands above the index where it has one."""
        raised = f"<m:sup>{self(exponent) if exponent[0] != '/' else self._slashed(exponent)}</m:sup>"
        if found := _INDEXED.fullmatch(base):
            return f"<m:sSubSup><m:e>{found[1]}</m:e><m:sub>{found[2]}</m:sub>{raised}</m:sSubSup>"
        return f"<m:sSup><m:e>{base}</m:e>{raised}</m:sSup>"

    def _slashed(self, exponent: Tree) -> str:
        return f"{self._held(exponent[1], PRODUCT)}/{self._held(exponent[2], POWER)}"

    def cases(self, rows: list[tuple[str, str]]) -> str:
        """Values, each with its condition, in two columns behind a brace."""
        column = '<m:mc><m:mcPr><m:count m:val="2"/><m:mcJc m:val="left"/></m:mcPr></m:mc>'
        lines = "".join(f"<m:mr><m:e>{value}</m:e><m:e>{condition}</m:e></m:mr>" for value, condition in rows)
        return self.bracket(f"<m:m><m:mPr><m:mcs>{column}</m:mcs></m:mPr>{lines}</m:m>", "{", "")

    def _call(self, name: str, args: list[Piece]) -> Piece:
        piece, said = super()._call(name, args), self.name(name)
        return piece._replace(text=_applied(said, piece.text)) if piece.text.startswith(said) else piece

    def _closed_call(self, tree: Tree) -> Piece:
        piece = super()._closed_call(tree)
        return piece._replace(text=_applied(self.name(tree[1]), piece.text))

    def _logic(self, tree: Tree) -> Piece:
        """What is taken of curves, beside what formulas hold."""
        match tree:
            case ["derivative", curve, by]:
                return self.fraction(Piece(run("d") + self(curve), PRODUCT), Piece(run("d") + self(by), PRODUCT))
            case ["integral", curve, by, end]:
                return Piece(_nary("∫", f"{self(curve)}{NARROW}{run('d')}{self(by)}", run("0"), self(end)), SUM)
            case ["nary", sign, of]:
                return Piece(_nary(sign, self(of)), SUM)
            case ["place", word, symbol, value]:
                return Piece(f"{run(f'{WIDE}{word} ', '')}{self(symbol)} = {self(value)}", ATOM)
        return super()._logic(tree)


def _applied(name: str, text: str) -> str:
    """A function with its argument, as an editor of formulas knows it."""
    return f"<m:func><m:fName>{name}</m:fName><m:e>{text.removeprefix(name)}</m:e></m:func>"


def _nary(sign: str, inner: str, below: str = "", above: str = "") -> str:
    hidden = "" if below or above else '<m:subHide m:val="1"/><m:supHide m:val="1"/>'
    form = f'<m:naryPr><m:chr m:val={quoteattr(sign)}/><m:limLoc m:val="subSup"/>{hidden}</m:naryPr>'
    return f"<m:nary>{form}<m:sub>{below}</m:sub><m:sup>{above}</m:sup><m:e>{inner}</m:e></m:nary>"


def office_math(equation: Equation, printer: OfficeMath) -> list[str]:
    """An equation as XML: a formula for each of its rows, each to stand in a paragraph of its own."""
    form = '<m:oMathParaPr><m:jc m:val="left"/></m:oMathParaPr>'
    rows = [_with_runs(_row(row, printer)) for row in equation.rows]
    return [f"<m:oMathPara>{form}<m:oMath>{row}</m:oMath></m:oMathPara>" for row in rows]


def _row(row: EquationRow, printer: OfficeMath) -> str:
    """A row; one that goes on with another begins with a sign, before which stands nothing that is seen."""
    links = [_printed(link, printer) for link in row.links]
    head = _printed(row.head, printer) or run(NOTHING)
    start = "" if row.joint == ":" else f"{head} {row.joint} "
    return start + f" {row.joint}{WIDE if row.joint == ':' else ' '}".join(links) + _printed(row.place, printer)


def _printed(link: Link, printer: OfficeMath) -> str:
    return "" if link.form is None else printer(link.form)


def _with_runs(fragment: str) -> str:
    """The XML with the plain text between its elements in runs; spaces about operators are the editor's business."""
    root = ElementTree.fromstring(f'<m:oMath xmlns:m="{SPACE}">{fragment}</m:oMath>')
    for holder in [element for element in root.iter() if element.tag in _TEXT_HOLDERS]:
        for place, text in reversed(list(_loose(holder))):
            made = ElementTree.fromstring(f'<m:r xmlns:m="{SPACE}"><m:t xml:space="preserve"/></m:r>')
            made[0].text = text
            holder.insert(place, made)
    return "".join(ElementTree.tostring(child, "unicode") for child in root).replace(f' xmlns:m="{SPACE}"', "")


def _loose(holder: ElementTree.Element) -> Iterator[tuple[int, str]]:
    """Give the texts between the elements of a holder, taken out of it, with their places."""
    first, holder.text = (holder.text or "").strip(" "), None
    if first:
        yield 0, first
    for index, child in enumerate(holder, 1):
        text, child.tail = (child.tail or "").strip(" "), None
        if text:
            yield index, text
