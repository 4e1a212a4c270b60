"""Symbols that stand for two quantities of one mechanism."""

from __future__ import annotations

from collections.abc import Collection

from diecut_report.mechanism.inputs import fields
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import SilentStep


def doubled(mechanism: Mechanism, alike: Collection[tuple[str, str]] = ()) -> list[str]:
    """Symbols that stand for two printed quantities; ``alike`` names an input and the step that takes it over under another id."""
    known: dict[str, set[str]] = {}
    for name, meta in fields(mechanism.inputs):
        known.setdefault(getattr(meta, "symbol", ""), set()).add(name)
    for _, step in mechanism.steps:
        if step.printed and not isinstance(step, SilentStep):
            known.setdefault(step.symbol, set()).add(step.id)
    pairs = {frozenset(pair) for pair in alike}
    return [
        f"{symbol}: {', '.join(sorted(ids))}"
        for symbol, ids in known.items()
        if symbol and len(ids) > 1 and ids not in pairs
    ]
