"""Symbols in running text, as HTML: ``R_b`` with an italic letter and an upright subscript."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib import import_module
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

from fontTools.pens.transformPen import TransformPen
from fontTools.ttLib import TTFont
from markupsafe import Markup, escape

from diecut_report.quantities.units import pretty
from diecut_report.report.chapters.printed_tables import WIDE
from diecut_report.report.mathematics import OperatorPen, letters_of
from diecut_report.report.scope import parts
from diecut_report.report.text import given_names, tidy
from diecut_report.results.mechanism_record import CurveRecord, MechanismRecord, QuantityRecord, SectionRecord
from diecut_report.results.model import ResultsRecord

LONGEST_WHOLE = 26  # letters of a source that stands in one line
_SIGNS = "=<>≤≥≈≠−+√"
SYMBOL = re.compile(r"(?P<before>[|\[\d]*)(?P<base>[^\W\d_]+[′']*)(?:_(?P<below>.*?))?(?P<after>[′'|\]]*)")
_OF_LETTERS = re.compile(r"[^\W\d_]{1,2}(?:\([^\W\d_]\)|/[^\W\d_]{1,2})")  # of another one, or their ratio: v(x), t/r
# A symbol within a sentence: one or two letters with a short subscript (keys such as crank_speed or n_points are none),
# a lone letter beside a sign of arithmetic (no Cyrillic one: і and а are words), a lone Greek one, or a lone Latin one that is no
# word and no name: small ones but a, of the capitals those that name no bearing, class or form, and any in a product. It stands
# behind no number (units do), within no product of units (``_UNITS``), and is no initial of a person.
_LONE = r"[^\W\d_\u0400-\u04ff][′']?"
_LETTER = (
    r"(?<![^\Wπ½])(?<![.'’–#-])(?<![\d⁰¹²³⁴-⁹][ \u00a0\u202f])(?<![A-Z]\. )(?:[b-zF-HJLMPQRSTWXYZ]|[A-Z](?=·)|(?<=·)[A-Z])′?"
    r"(?![²³]?(?:[^\W²³]|['’″–-]))(?!(?<=\(.)\))(?!\.(?: ?[A-Z]\.|-))"
)
_IN_TEXT = re.compile(
    r"(?<![\w.])(?:([^\W\d_]{1,2}[′']?)_(\d{1,2}|[^\W\d_]{1,3}(?:,[^\W_]{1,3})?|\w{1,6}(?=\s?=))(?!\w)"
    rf"|(?<!\d[ \u00a0\u202f/])({_LONE})(?=\s?[{_SIGNS}])|([Α-Ωα-ωϑϕ])(?!\w)|(?<=[{_SIGNS}])(?<!\w\+)({_LONE})(?!\w)|(?<=[{_SIGNS}] )({_LONE})(?!\w))"
    rf"|({_LETTER})"
)
_EQUAL = re.compile(r"(?<=\w) ([=≤≥<>≈]) (?=[−\d])")  # φ = 180°, which no line's end cuts
_RATIO = re.compile(r"(?<=\bd[^\W\d_])/(?=d[^\W\d_](?!\w))|(?<=</i>)/(?=d<i)|(?<=[²³>])/(?=\()")  # dθ/dφ, h²/(2·tan τ)
_SUM = re.compile(r"(\([^()\s]{1,12}) ([+−]) ([^()\s]{1,12}\))")  # (φ + τ), which no line's end cuts, either
_UNIT = r"[kMmµcd]?(?:N|W|Pa|J|g|m|s|K|h|rad|V|A|min|Hz)[²³]?"
_UNITS = re.compile(rf"(?:°|(?<![\w·/])(?:1|r|{_UNIT}))(?:[·/]\(?{_UNIT}\)?)+(?![\w·/])")


def symbol(name: str) -> Markup:
    """A symbol as HTML, nothing for the empty one; bars, brackets and digits about the letters stand upright."""
    if name.startswith("Σ "):  # a sum of what has a symbol of its own
        return Markup("Σ\u2009") + symbol(name[2:])
    found = SYMBOL.fullmatch(name)
    if found is None and not _OF_LETTERS.fullmatch(name):
        return escape(name)
    if found is None:
        letters, parts = Markup("<i class=sy>{}</i>"), re.split(r"([^\W\d_]+)", name)
        return Markup("").join(letters.format(part) if part.isalpha() else escape(part) for part in parts)
    below = Markup("<sub>{}</sub>").format(found["below"].replace("_", "\u2009")) if found["below"] else Markup("")
    return Markup("{}<i class=sy>{}</i>{}{}").format(found["before"], found["base"], below, found["after"])


def pieces(typed: str, *, narrow: bool = False) -> Markup:
    """What was typed, with the places where a line may break: between its words, behind the dots of a path, ``narrow`` behind its low lines."""
    joints = r"(?<=\.)(?=[^\W\d])|(?<=[^\W_]_)(?=[^\W_])" if narrow else r"(?<=\.)(?=[^\W\d])"
    words = [re.split(joints, word) for word in typed.split(" ")]
    joint, whole = Markup("<wbr/>"), Markup('<span class="whole">{}</span>')
    return Markup(" ").join(joint.join(whole.format(part) for part in word) for word in words)


def cited(source: str) -> Markup:
    """A source beside a formula, with what is said behind it: a short one whole, of any other the numbers kept with what they number.

    ISO 6336-3, eq. 4 · the teeth are straight
    """
    first, _, rest = source.partition(" · ")
    kept = re.sub(r" " if len(first) <= LONGEST_WHOLE else r" (?=\d)", "\u00a0", first)
    return prose(f"{kept} · {rest}" if rest else kept)


_letters: ContextVar[tuple[Collection[str], re.Pattern[str] | None] | None] = ContextVar("letters", default=None)
"""The lone letters that a report declares as symbols, and what finds its own names that hold such letters."""


@contextmanager
def letters_declared(symbols: Collection[str], names: Collection[str]) -> Iterator[None]:
    """Set within sentences no other lone letters as symbols than these, and none within these names; without this, all that look like one."""
    own = sorted((re.escape(name) for name in names if re.search(_LETTER, name)), key=len, reverse=True)
    found = re.compile(rf"(?<!\w)(?:{'|'.join(own)})(?!\w)") if own else None
    token = _letters.set((symbols, found))
    try:
        yield
    finally:
        _letters.reset(token)


def lone_letters(text: str) -> list[str]:
    """Return the letters of a sentence that look like symbols."""
    return re.findall(_LETTER, text)


def own_words(text: str) -> Markup:
    """A user's own words as HTML: of their letters none is a symbol that has no index and stands beside no sign."""
    with letters_declared((), ()):
        return prose(text)


def prose(sentence: str) -> Markup:
    """A sentence as HTML, its symbols set as symbols."""
    text = _SUM.sub("\\1\u00a0\\2\u00a0\\3", _EQUAL.sub("\u00a0\\1\u00a0", tidy(sentence)))
    declared, names = _letters.get() or (None, None)
    taken = [found.span() for each in (_UNITS, names) if each for found in each.finditer(text)]
    parts, start = [], 0
    for found in _IN_TEXT.finditer(text):
        is_within = any(first <= found.start() < end for first, end in taken)
        if found[7] and (is_within or (declared is not None and found[7] not in declared)):
            continue
        base = next(filter(None, (found[1], *found.groups()[2:])))
        parts += [escape(text[start : found.start()]), symbol(f"{base}_{found[2]}" if found[2] else base)]
        start = found.end()
    return Markup(_RATIO.sub("/\u2060", "".join([*parts, escape(text[start:])])))


# The list of a chapter's symbols: each letter of its formulas with its meaning and unit, and what a source writes for it.


COLUMNS, ROOM = 3, 33  # on paper, and the letters that a line has beside its symbol
LINES = 14  # of a block's columns: less than a third of a sheet is left empty before one


class SymbolRow(NamedTuple):
    """A symbol with its meaning, its unit, and the letter of the source where that is another one."""

    symbol: Markup
    meaning: str
    unit: str
    in_source: Markup
    name: str = ""
    stands: str = ""  # the number of the step, or of the inputs, where it is explained
    is_step: bool = False

    @property
    def anchor(self) -> str:
        """Where the link to that place leads."""
        return f"{'eq' if self.is_step else 's'}-{self.stands}"


def symbol_rows(mechanism: MechanismRecord) -> list[SymbolRow]:
    """The symbols that stand in a chapter's formulas, in the order of the alphabet, Latin letters first."""
    used = set(used_symbols(mechanism.sections))
    printed = {item.id for section in mechanism.sections for item in section.items if item.id}
    known: dict[str, QuantityRecord | CurveRecord] = {}
    # what a step prints, before a chart's curves
    for _, row in sorted(_quantities(mechanism), key=lambda each: each[0] not in printed):
        if row.symbol in used and any(map(str.isalpha, row.symbol)):
            known.setdefault(row.symbol, row)
    return [_row(known[name]) for name in sorted(known, key=_order)]


def _quantities(mechanism: MechanismRecord) -> list[tuple[str, QuantityRecord | CurveRecord]]:
    groups = (mechanism.inputs, mechanism.curves, mechanism.outputs, mechanism.values)
    return [pair for group in groups for pair in group.items()]


def in_blocks(rows: list[SymbolRow]) -> list[list[list[SymbolRow]]]:
    """The rows for paper, in blocks of columns that no sheet's end cuts: each block is read column by column."""
    blocks: list[list[SymbolRow]] = [[]]
    room = COLUMNS * LINES
    for row in rows:
        if sum(map(_lines, blocks[-1])) + _lines(row) > room:
            blocks.append([])
        blocks[-1].append(row)
    return [_in_columns(block) for block in blocks if block]


def _lines(row: SymbolRow) -> int:
    """How many lines a row takes on paper, about."""
    return ceil((len(row.meaning) + len(row.unit) + 2) / ROOM)


def _in_columns(rows: list[SymbolRow]) -> list[list[SymbolRow]]:
    columns: list[list[SymbolRow]] = [[] for _ in rows[:COLUMNS]]
    share, above = ceil(sum(map(_lines, rows)) / len(columns)), 0
    for row in rows:
        columns[min(int((above + _lines(row) / 2) / share), len(columns) - 1)].append(row)
        above += _lines(row)
    return columns


def symbols_at(rows: list[SymbolRow], steps: Mapping[str, str], inputs: Mapping[str, str]) -> list[SymbolRow]:
    """The rows with the place of each symbol: the step that gives it, else the inputs; by their names."""
    at = {row.name: steps.get(row.name) or inputs.get(row.name, "") for row in rows}
    return [row._replace(stands=at[row.name], is_step=row.name in steps) for row in rows]


def _row(row: QuantityRecord | CurveRecord) -> SymbolRow:
    unit = row.display_unit if isinstance(row, CurveRecord) else row.display.unit
    meaning = row.description.partition(";")[0]
    return SymbolRow(symbol(row.symbol), meaning, pretty(unit), symbol(row.source_symbol), row.symbol)


def _order(name: str) -> tuple[bool, str, str]:
    letter = name.lstrip("|[0123456789")
    return not letter[:1].isascii(), letter.casefold(), letter


def used_symbols(sections: list[SectionRecord]) -> Iterator[str]:
    """The symbols of results and of formulas."""
    for section in sections:
        for item in section.items:
            if any(map(str.isalpha, item.symbol)):  # no arrow before a choice in words
                yield item.symbol
            if len(columns := item.columns) >= WIDE:
                yield from (column.symbol for column in columns if column.symbol)
            for tree in (item.equation, item.relation, item.condition, *(each.stands_for for each in item.where)):
                yield from letters_of(tree)


# Widths and outlines of letters in the report's own fonts: what must fit into a box is measured before it is set.


MILLIMETRE = 72 / 25.4  # in points
LINE = 1.2  # of a line's letters
LETTERS_ROOM = 1.02  # what a line may come out wider than it is measured
STEP = 0.25  # points
REGULAR, BOLD = "report-sans-regular", "report-sans-bold"
MISSING = ".notdef"


def fitted(
    text: str, width: float, height: float, largest: float, smallest: float, face: str = REGULAR
) -> tuple[list[str], float]:
    """Return a text in lines that fit into a box of so many millimetres, and the size of its letters in points: as large as it may be.

    At its smallest it is cut where it still has no room.
    """
    size = largest
    while True:
        lines = list(_letters_lines(text, width * MILLIMETRE / size / LETTERS_ROOM, face))
        most = max(int(height * MILLIMETRE / (LINE * size) + 1e-6), 1)
        if len(lines) <= most:
            return lines, size
        if size <= smallest:
            kept = lines[:most]
            kept[-1] = f"{kept[-1][: max(len(kept[-1]) - 2, 0)].rstrip()}…"
            return kept, size
        size = max(size - STEP, smallest)


def measured(text: str, face: str = REGULAR) -> float:
    """Return the width of a text in em."""
    return float(sum(map(_widths(face), text)))


def drawn(text: str, face: str = REGULAR) -> str:
    """Return the operators that draw a text in a PDF, in em from its baseline's start, y upwards."""
    glyphs, x, scale = font(face).getGlyphSet(), 0.0, 1 / font(face)["head"].unitsPerEm
    pen = OperatorPen(glyphs)
    for letter in text:
        glyphs[_named(letter, face)].draw(TransformPen(pen, (scale, 0, 0, scale, x, 0)))
        x += _widths(face)(letter)
    return " ".join([*pen.operators, "f"]) if pen.operators else ""


def _letters_lines(text: str, width: float, face: str) -> Iterator[str]:
    line = ""
    for word in text.split():
        longer = f"{line} {word}".lstrip()
        if measured(longer, face) <= width:
            line = longer
            continue
        if line:
            yield line
        *full, line = _parts(word, width, face)
        yield from full
    if line:
        yield line


def _parts(word: str, width: float, face: str) -> list[str]:
    parts = [""]
    for letter in word:
        if parts[-1] and measured(parts[-1] + letter, face) > width:
            parts.append("")
        parts[-1] += letter
    return parts


def font_file(face: str) -> Path:
    """Return the file of one of the report's own fonts."""
    return Path(import_module("diecut_report.templates").__path__[0]) / "fonts" / f"{face}.ttf"


@cache
def font(face: str) -> TTFont:
    """Return one of the report's own fonts."""
    return TTFont(font_file(face))


def _named(letter: str, face: str) -> str:
    """What the font calls a letter; another font's letter counts as the one for what is missing."""
    return str(font(face).getBestCmap().get(ord(letter), MISSING))


@cache
def _widths(face: str) -> Any:
    metrics, units = font(face)["hmtx"], font(face)["head"].unitsPerEm
    return cache(lambda letter: metrics[_named(letter, face)][0] / units)


# Which letters a report declares as symbols, and which names its configuration gives: sentences hold both.


def declared_letters(results: ResultsRecord) -> tuple[set[str], set[str]]:
    """Return letters that are symbols, alone or with an index (a sentence may speak of the k of k_a), and the names that a configuration gives."""
    mechanisms = results.mechanisms
    own = {name for data in mechanisms.values() for name in given_names(data, mechanisms)}
    every = [name for _, data in parts(results) for name in used_symbols(data.sections)]
    every += [row.symbol for _, data in parts(results) for _, row in _quantities(data)]
    found = map(SYMBOL.fullmatch, every)
    symbols = {each["base"] for each in found if each and len(each["base"].rstrip("′'")) == 1}
    for data in mechanisms.values():  # what was found wrong in a source speaks of the source's letters
        symbols.update(letter for each in data.errata for letter in lone_letters(each.text))
    return symbols, own | set(mechanisms)
