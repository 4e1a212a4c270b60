"""What an author may write of any step: formulas in their forms, and what a step may say besides."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypedDict

from diecut_report.contract.binding import Binding, ByText, as_binding
from diecut_report.contract.steps import Case

Written = Binding | ByText | Callable[..., Any]
"""A formula as an author writes it: a lambda, a ``@formula``, one that is bound, one chosen by a text."""


class Options(TypedDict, total=False):
    """Declare what any step may say besides; see ``Step``."""

    source: str
    source_symbol: str
    digits: int
    output: bool
    needs: tuple[str, ...]
    lacks: tuple[str, ...]
    exists: Written | None
    numbered: str
    first: int
    named_by: str
    whole: bool
    printed: bool
    units: tuple[tuple[str, str], ...]


class StepCondition(TypedDict, total=False):
    """Declare with which optional inputs a step takes part that gives no quantity."""

    needs: tuple[str, ...]
    lacks: tuple[str, ...]


def case(value: Written | str, words: str, condition: Written | None = None) -> Case:
    """Return one branch of a choice: its value (formula or text), why in words, and when it is taken; the last one has no condition."""
    taken = value if isinstance(value, str) else as_binding(value, words)
    return Case(taken, words, None if condition is None else as_binding(condition, words))
