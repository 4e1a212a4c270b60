"""How the summary calls quantities and prints their sizes."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any

from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import decimal_sign, localised, said, say, say_counted
from diecut_report.languages.tokens import worded
from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.figures.style import plain, text_size
from diecut_report.report.number_format import joined, number
from diecut_report.study.analysis.stored_variants import StoredColumn
from diecut_report.study.analysis.titles import UTILISATION

DIGITS = 4
WORST = StoredColumn(
    "greatest utilisation", "float", title=phrase("Utilisation of the check that governs (where it has one)")
)
WORDS = {"pass": phrase("pass"), "warn": phrase("warning"), "fail": phrase("fail"), "error": phrase("error")}


def named(column: StoredColumn) -> str:
    """Return a quantity as people call it: ``Radius of the bore (cylinder)``."""
    return said(column.told)


def titled(column: StoredColumn) -> str:
    """Return a quantity with the unit that people read."""
    sign = pretty(column.display)
    return named(column) + (f", {sign}" if sign else "")


def wrapped(words: str, wide: float, size: float, most: int) -> str:
    """Return a name for matplotlib on lines of a width, broken at its spaces; a word that is too long behind dots and underscores.

    Of what does not fit on so many lines the last line stays, with the mechanism and the unit.
    """
    lines = [""]
    for part in _pieces(words, wide, size):
        if lines[-1] and text_size(plain((lines[-1] + part).rstrip()), size)[0] > wide:
            lines.append("")
        lines[-1] += part
    if len(lines) > most:
        kept = [line.rstrip() for line in lines[: most - 1]]
        lines = [*kept, _shortened(" ".join(line.strip() for line in lines[most - 1 :]), wide, size)]
    return plain("\n".join(line.rstrip() for line in lines))


def _pieces(words: str, wide: float, size: float) -> Iterator[str]:
    for word in re.findall(r"[^ ]+ ?| ", words):
        fits = text_size(plain(word), size)[0] <= wide
        yield from [word] if fits else re.findall(r"[^._]*[._]|[^._]+", word)


def _shortened(words: str, wide: float, size: float) -> str:
    """As much of the beginning of a name as fits on a line before its end in brackets."""
    head, bracket, tail = words.rpartition(" (")
    head, tail = (head, f"… ({tail}") if bracket else (words, "…")
    while head and text_size(plain(head.rstrip() + tail), size)[0] > wide:
        head = head[:-1]
    return head.rstrip() + tail


def factor(column: StoredColumn) -> float:
    """Return display units in an SI unit."""
    return 1.0 / unit(column.display).factor


def display(value: float, column: StoredColumn) -> str:
    """Return an SI value in the unit that people read, without the unit."""
    if not math.isfinite(value):
        return "–"
    if is_utilisation(column):
        return utilised(value)
    return number(number_text(unit(column.display).from_si(value), DIGITS), decimal_sign()) if value else "0"


def quantity(value: float, column: StoredColumn) -> str:
    """Return an SI value with the unit that people read."""
    return joined(display(value, column), pretty(column.display))


def value_told(value: Any) -> str:
    """Return a value that is not a number: the words of a choice, yes or no."""
    if isinstance(value, str):
        return said(worded(value))
    return say("yes") if value else say("no")


def is_utilisation(column: StoredColumn) -> bool:
    """Return whether 1 is the limit of a quantity."""
    return column.name == WORST.name or (".checks." in column.name and column.name.endswith(UTILISATION))


def utilised(value: float) -> str:
    """Return a utilisation; one that is next to 1 shows on which side it is, and a small one that is not none does not print as 0."""
    text = f"{value:.2f}"
    if text == "1.00" and value != 1:
        near = f"{value:.4f}"
        return localised(near) if near != "1.0000" else "< 1" if value < 1 else "> 1"
    if value >= 99.995:
        return number(f"{value:.3g}" if value >= 1e6 else f"{value:.0f}", decimal_sign())
    return localised("< 0.01" if text == "0.00" and value > 0 else text)


def variants(count: int) -> str:
    """Return how many variants."""
    return say_counted(count, "{n} variant", "{n} variants", n=number(str(count)))


def percent(part: float, whole: float) -> str:
    """Return a share; a small one that is not none does not print as 0."""
    share = 100.0 * part / whole if whole else 0.0
    text = "< 0.1 %" if 0 < share < 0.1 else f"{share:.3g} %" if share < 99.95 or part == whole else "> 99.9 %"
    return localised(text)
