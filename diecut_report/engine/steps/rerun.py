"""The same machine calculated again with other inputs: only the steps that the asked quantities need."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from diecut_report.contract.inputs import texts_given
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.result_names import named
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import SILENT, Abscissa, Breakpoints, Prepared, Step
from diecut_report.engine.calculation import Calculation, Impossible, Unproven
from diecut_report.engine.steps.run import calculate
from diecut_report.expressions import Array


def varied(calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str]) -> dict[str, Array]:
    """Return numbers for other inputs, each of shape (variants,); NaN where the machine is then impossible."""
    count = max((np.size(value) for value in inputs.values() if not isinstance(value, str)), default=1)
    again = _calculated(calc, inputs, count, names)
    if again is None:
        return {name: np.full(count, np.nan) for name in names}
    possible = np.ones(count, dtype=bool)
    possible[list(again.flaws)] = False
    return {name: np.where(possible, again[name][:, 0], np.nan) for name in names}


def varied_curves(
    calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str], points: int
) -> tuple[Array, dict[str, Array]]:
    """Return curves over one abscissa for other inputs, at so many places of the whole of it, ends included.

    NaN where the machine is then impossible.
    """
    again = _calculated(calc, inputs, 1, names)
    axis = calc.axis[names[0]]
    period = float((again or calc).domains[axis].period[0, 0])
    x = np.linspace(0, period, points)
    if again is None:
        return x, dict.fromkeys(names, np.full(points, np.nan))
    places = np.minimum(x, np.nextafter(period, 0))[None, :]
    curves = again.sampler(names[0], places, again.domains[axis].middle_of(places))
    return x, {name: np.broadcast_to(curves[name], places.shape)[0] for name in names}


def _calculated(calc: Calculation, changed: Mapping[str, Any], count: int, names: Sequence[str]) -> Calculation | None:
    inputs = {name: _repeated(value, count) for name, value in calc.inputs.items()}
    for name, value in changed.items():
        inputs[name] = value if isinstance(value, str) else np.broadcast_to(np.asarray(value, dtype=float), (count,))
    only = needed(calc.mechanism, frozenset(inputs) | texts_given(inputs), names)
    try:
        return calculate(calc.mechanism, inputs, count, only)
    except (Impossible, Unproven):
        return None


def _repeated(value: Any, count: int) -> Any:
    return np.repeat(value[:1], count, axis=0) if isinstance(value, np.ndarray) else value


def needed(mechanism: Mechanism, given: frozenset[str], names: Sequence[str]) -> set[str]:
    """Return the ids of the steps that quantities need, and of what must hold for them."""
    steps = [step for _, step in mechanism.active(given)]
    own = {step.id: step for step in steps}
    found: set[str] = set()
    pending = list(names)
    while pending:
        name = pending.pop()
        step = _giver(name, own)
        if step is None or step.id in found:
            continue
        found.add(step.id)
        pending += _asked(step) - {getattr(step, "shown_at", "")}  # where formulas are shown matters in print only
        pending += _of_abscissa(steps, step)
    return found | {
        s.id for s in steps if isinstance(s, SILENT) and not isinstance(s, Breakpoints) and _known(s, own, found)
    }


def _asked(step: Step) -> frozenset[str]:
    """Return the ids that a step takes, with those that plain code takes where they are there."""
    return taken(step) | frozenset(step.holds) if isinstance(step, Prepared) else taken(step)


def _of_abscissa(steps: Sequence[Step], step: Step) -> list[str]:
    """What cuts an abscissa into its pieces."""
    if not isinstance(step, Abscissa):
        return []
    return [s.id for s in steps if getattr(s, "abscissa", "") == step.id]


def _giver(name: str, own: Mapping[str, Step]) -> Step | None:
    """Return the step of this id, or that gives this name."""
    found = None if name in own else named(name, own)
    return own[found.id] if found else own.get(name)


def _known(step: Step, own: Mapping[str, Step], found: set[str]) -> bool:
    givers = [_giver(name, own) for name in _asked(step)]
    return all(giver is None or giver.id in found for giver in givers)
