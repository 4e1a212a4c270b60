"""How many examples a test has: those that hypothesis draws, and those of a family of parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import pytest
from hypothesis import settings

USUAL, FEW, MANY, LEAST = 100, 20, 1000, 5


def examples(count: int) -> settings:
    """Return the settings of a test that is to draw so many examples where others draw 100: fewer in CI, more at night."""
    return settings(max_examples=max(LEAST, round(count * settings.default.max_examples / USUAL)))


def few(values: Iterable[Any], keep: Callable[[Any], bool]) -> list[Any]:
    """Return parameters of a test with all but those to keep marked for the night; a tuple fills several arguments."""
    return [value if keep(value) else _at_night(value) for value in values]


def every(step: int, values: Iterable[Any]) -> list[Any]:
    """Return parameters of a test of which the first, and every so many further ones, are kept; all run at night."""
    return [value if index % step == 0 else _at_night(value) for index, value in enumerate(values)]


def _at_night(value: Any) -> Any:
    return pytest.param(*(value if isinstance(value, tuple) else (value,)), marks=pytest.mark.nightly)
