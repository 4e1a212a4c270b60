"""Parts by their names, and the error of a name that is not known."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeVar

from diecut_report.errors import Problem, UnknownName, nearest
from diecut_report.languages.phrases import Phrase
from diecut_report.scripting.spoken import told_in

PartT = TypeVar("PartT")
SHOWN = 20  # known names that a message lists


def unknown(what: str, name: str, known: Sequence[str], *, also: Sequence[str] = ()) -> UnknownName:
    """Return the error of a name that is not known; ``what`` says of what, ``drive has no figure``. The nearest is sought ``also`` in others."""
    near = nearest(name, (*known, *also)) or _listed(known)
    return UnknownName(Problem(Phrase("{what} {name}{nearest}.", what=what, name=repr(name), nearest=near)))


def _listed(known: Sequence[str]) -> str:
    return Phrase("; there are {known}", known=", ".join(known[:SHOWN])) if known else ""


class NamedParts(Mapping[str, PartT]):
    """Hold parts by their names, as a mapping; another name is an UnknownName (a KeyError) that tells the nearest."""

    def __init__(self, parts: Mapping[str, PartT], missing: str, language: str | None) -> None:
        self._parts, self._missing, self._language = dict(parts), missing, language

    def __getitem__(self, name: str) -> PartT:
        """Return a part by its name; UnknownName where there is none."""
        if name not in self._parts:
            with told_in(self._language):
                raise unknown(self._missing, name, list(self._parts))
        return self._parts[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return repr(self._parts)
