"""The form of the table's rows: the mistake, old text, new text, and the words that the message must hold."""

from __future__ import annotations

from typing import Any

from tests.mistakes.runner import Mistake, Stage


def row(
    told: Stage, what: str, old: str, new: str, *words: str, also: tuple[tuple[str, str], ...] = (), **rest: Any
) -> Mistake:
    """A mistake of one text, ``also`` of others, told by ``told``."""
    return Mistake(what, ((old, new), *also), told, words, **rest)


def load(what: str, old: str, new: str, *words: str, **rest: Any) -> Mistake:
    """A mistake that is told when the plugin is loaded: by each command, with exit code 3, with file and line."""
    return row("load", what, old, new, *words, **rest)


def tested(what: str, old: str, new: str, *words: str, **rest: Any) -> Mistake:
    """A mistake that ``check_mechanism`` tells of a step, with numbers: dimensions, and what is printed."""
    return row("check_mechanism", what, old, new, *words, **({"placed": False} | rest))


def calc(what: str, old: str, new: str, *words: str, **rest: Any) -> Mistake:
    """A mistake that only the numbers of a machine show."""
    return row("calc", what, old, new, *words, **({"placed": False} | rest))
