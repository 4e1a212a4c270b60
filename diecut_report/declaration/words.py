"""What is wrong with a declaration, in words: where it stands, what it is of, and what to write instead."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, joined, phrase


class Fault(NamedTuple):
    """One mistake of a plugin's author: the place (``file:line``), what it is of (``step force``), and what to do."""

    place: str
    subject: str
    text: str

    def __str__(self) -> str:
        """The one line that is shown: ``gear.py:12: step force: takes arm, which nothing gives``."""
        return joined([part for part in (short(self.place), self.subject, self.text) if part], ": ")


def short(place: str) -> str:
    """Return a place without the folders of its file."""
    return Path(place).name


KINDS = {
    "number": phrase("a number"), "row": phrase("a row"), "curve": phrase("a curve"), "abscissa": phrase("an abscissa"),
    "crossings": phrase("found crossings"), "text": phrase("a text"), "curve input": phrase("a curve input"), "block": phrase("a block"),
    "varying": phrase("a number that varies"), "phase": phrase("a phase"), "mechanism": phrase("a mechanism"),
    "prepared": phrase("what is prepared"), "list of parts": phrase("a list of parts"),
}  # fmt: skip
"""What a name may be, in words."""


def kinds_told(kinds: Iterable[str]) -> str:
    """Return in words what a name may be."""
    return joined([KINDS[kind] for kind in sorted(kinds)], " or ")


def unknown(name: str, known: Iterable[str]) -> str:
    """Return a name that nothing gives, with the nearest one that something gives."""
    return Phrase("{name}, which nothing gives{nearest}", name=name, nearest=nearest(name, known))
