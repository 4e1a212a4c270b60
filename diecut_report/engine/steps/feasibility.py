"""What must hold for a machine to be possible, and how its reasons are reported."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from diecut_report.contract.binding import bound
from diecut_report.contract.steps import Clash, Require, Step
from diecut_report.engine.calculation import Calculation, Impossible
from diecut_report.engine.printing.substitution import filled
from diecut_report.engine.steps import plain_code


def require(calc: Calculation, step: Require) -> None:
    """Mark each variant for which the condition does not hold (for one of its parts); a single machine is refused."""
    held = calc.apply(step.condition).astype(bool)
    for variant in np.flatnonzero(~held.all(axis=1)):
        part, count = int(np.argmin(held[variant])), held.shape[1]
        _said(calc, step, int(variant), {"part": part + 1, "next": (part + 1) % count + 1, "index": part})


def clash(calc: Calculation, step: Clash) -> None:
    """Mark each variant of which a part clashes with another; a single machine is refused."""
    rows = plain_code.taken(calc, step.takes)
    others = plain_code.partners(step, step.function(*rows), np.broadcast_shapes(*(np.shape(row) for row in rows)))
    for variant in np.flatnonzero((others >= 0).any(axis=1)):
        part = int(np.argmax(others[variant] >= 0))
        _said(calc, step, int(variant), {"part": part + 1, "other": int(others[variant, part]) + 1, "index": part})


def _said(calc: Calculation, step: Require | Clash, variant: int, places: dict[str, int]) -> None:
    if variant in calc.flaws and calc.count > 1:  # what follows from impossible numbers says nothing more
        return
    message = "" if calc.is_partial else filled(calc, step.message, variant, places)
    refuse(calc, variant, filled(calc, step.key, variant, places), message)


def refuse(calc: Calculation, variant: int, key: str, message: str) -> None:
    """Mark a variant as impossible, unless it is already; a single machine is refused."""
    if variant in calc.flaws and calc.count > 1:
        return
    calc.flaws[variant] = key, message
    if calc.count == 1:
        raise Impossible([(key, message)])


def reasons(calc: Calculation, steps: Sequence[Step]) -> Iterator[tuple[str, str]]:
    """Yield why else a machine cannot exist, as far as it can be told from what is known already."""
    known = {*calc.inputs, *calc.values, *(f"inputs.{name}" for name in calc.inputs)}
    for step in steps:
        if isinstance(step, Require) and known.issuperset(n for n in bound(step.condition).takes if isinstance(n, str)):
            try:
                require(calc, step)
            except Impossible as other:
                yield from other.reasons
