"""What is wrong with a declaration, in words: where it stands, what it is of, and what to write instead."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from diecut_report.errors import nearest


class Fault(NamedTuple):
    """One mistake of a plugin's author: the place (``file:line``), what it is of (``step force``), and what to do."""

    place: str
    subject: str
    text: str

    def __str__(self) -> str:
        """The one line that is shown: ``gear.py:12: step force: takes arm, which nothing gives``."""
        return ": ".join(part for part in (short(self.place), self.subject, self.text) if part)


def short(place: str) -> str:
    """Return a place without the folders of its file."""
    return Path(place).name


def unknown(name: str, known: Iterable[str]) -> str:
    """Return a name that nothing gives, with the nearest one that something gives."""
    return f"{name}, which nothing gives{nearest(name, known)}"
