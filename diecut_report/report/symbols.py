"""Symbols in running text, as HTML: ``R_b`` with an italic letter and an upright subscript."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple

from markupsafe import Markup, escape

from diecut_report.report.number_format import tidy

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
        return Markup("").join(
            Markup("<i class=sy>{}</i>").format(part) if part.isalpha() else escape(part)
            for part in re.split(r"([^\W\d_]+)", name)
        )
    below = Markup("<sub>{}</sub>").format(found["below"].replace("_", "\u2009")) if found["below"] else Markup("")
    return Markup("{}<i class=sy>{}</i>{}{}").format(found["before"], found["base"], below, found["after"])


def pieces(typed: str, *, narrow: bool = False) -> Markup:
    """What was typed, with the places where a line may break: between its words, behind the dots of a path, ``narrow`` behind its low lines."""
    joints = r"(?<=\.)(?=[^\W\d])|(?<=[^\W_]_)(?=[^\W_])" if narrow else r"(?<=\.)(?=[^\W\d])"
    words = [re.split(joints, word) for word in typed.split(" ")]
    joint = Markup("<wbr/>")
    return Markup(" ").join(
        joint.join(Markup('<span class="whole">{}</span>').format(part) for part in word) for word in words
    )


def cited(source: str) -> Markup:
    """A source beside a formula, with what is said behind it: a short one whole, of any other the numbers kept with what they number.

    ISO 6336-3, eq. 4 · the teeth are straight
    """
    first, _, rest = source.partition(" · ")
    kept = re.sub(r" " if len(first) <= LONGEST_WHOLE else r" (?=\d)", "\u00a0", first)
    return prose(f"{kept} · {rest}" if rest else kept)


class _Letters(NamedTuple):
    """The lone letters that a report declares as symbols, and what finds its own names that hold such letters."""

    symbols: frozenset[str]
    names: re.Pattern[str] | None


_letters: ContextVar[_Letters | None] = ContextVar("letters", default=None)


@contextmanager
def letters_declared(symbols: Collection[str], names: Collection[str]) -> Iterator[None]:
    """Set within sentences no other lone letters as symbols than these, and none within these names; without this, all that look like one."""
    own = sorted((re.escape(name) for name in names if re.search(_LETTER, name)), key=len, reverse=True)
    found = re.compile(rf"(?<!\w)(?:{'|'.join(own)})(?!\w)") if own else None
    token = _letters.set(_Letters(frozenset(symbols), found))
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
    letters = _letters.get()
    taken = [found.span() for found in _UNITS.finditer(text)]
    taken += [found.span() for found in letters.names.finditer(text)] if letters and letters.names else []
    parts, start = [], 0
    for found in _IN_TEXT.finditer(text):
        if found[7] and any(first <= found.start() < end for first, end in taken):
            continue
        if found[7] and letters and found[7] not in letters.symbols:
            continue
        base = next(filter(None, (found[1], *found.groups()[2:])))
        parts += [escape(text[start : found.start()]), symbol(f"{base}_{found[2]}" if found[2] else base)]
        start = found.end()
    return Markup(_RATIO.sub("/\u2060", "".join([*parts, escape(text[start:])])))
