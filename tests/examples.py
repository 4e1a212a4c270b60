"""How many examples hypothesis draws for a test, beside the settings of the suite."""

from __future__ import annotations

from hypothesis import settings

USUAL, FEW, MANY, LEAST = 100, 20, 1000, 5


def examples(count: int) -> settings:
    """Return the settings of a test that is to draw so many examples where others draw 100: fewer in CI, more at night."""
    return settings(max_examples=max(LEAST, round(count * settings.default.max_examples / USUAL)))
