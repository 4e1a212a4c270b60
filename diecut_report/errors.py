"""Every error that a user can see."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass

TOLD = 20  # problems of a file that are told, so that the message itself stays short


@dataclass(frozen=True)
class Problem:
    """One thing that a user must fix, and where.

    `message` says in whole sentences what is wrong, what was given, what is allowed and what to do.
    `line` and `column` count from 1; `path` is the key path, such as "mechanisms.drive.crank_speed".
    """

    message: str
    file: str = ""
    line: int | None = None
    column: int | None = None
    path: str = ""

    def __str__(self) -> str:
        """The one-line form that editors and terminals can follow: `press.yaml:12:5: path: message`."""
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part not in ("", None))
        return ": ".join(part for part in (place, self.path, self.message) if part)


class UserError(Exception):
    """Bad input: everything found wrong with it, in the order of reading (exit code 2)."""

    problems: tuple[Problem, ...]

    def __init__(self, problems: Problem | Iterable[Problem]) -> None:
        self.problems = (problems,) if isinstance(problems, Problem) else tuple(problems)
        if not self.problems:
            raise ValueError("a user error needs at least one problem")
        super().__init__(self.problems)

    def __str__(self) -> str:
        return "\n".join(str(problem) for problem in self.problems)


class Unwritable(UserError):
    """What was asked for cannot be written: the disk is full, or standard output is closed (exit code 74)."""


class PluginError(Exception):
    """A plugin broke (exit code 3). Raise it `from` the cause; it names the kind and, where known, the instance."""

    def __init__(self, message: str, kind: str = "", instance: str = "") -> None:
        super().__init__(message, kind, instance)
        self.message, self.kind, self.instance = message, kind, instance

    def __str__(self) -> str:
        where = f"mechanism {self.instance!r}" if self.instance else ""
        plugin = f"plugin {self.kind!r}" if self.kind else ""
        return ": ".join(part for part in (" of ".join(p for p in (where, plugin) if p), self.message) if part)


def nearest(given: str, known: Iterable[str]) -> str:
    """A suggestion to append, " (did you mean 'crank_speed'?)", or nothing where none is near."""
    found = difflib.get_close_matches(given[:100], list(known), n=1, cutoff=0.6)
    return f" (did you mean {found[0]!r}?)" if found else ""
