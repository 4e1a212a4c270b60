"""Where a curve is not smooth inside a smooth piece though no condition tells it: an angle that wraps, a pole, a corner."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from diecut_report.contract.steps import Choice, Step, Value
from diecut_report.engine.calculation import Calculation, Unproven
from diecut_report.engine.numerics.domain import shares
from diecut_report.engine.steps import smooth_pieces
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import unit

FINE = 64  # intervals of a piece in which a curve is looked at first
ROUNDS, WITHIN = 8, 16  # how often the place is looked at closer, each time in so many intervals
INSET, WIDE = (
    1e-9,
    1e-6,
)  # shares: of a piece, that its ends are left out by; of the period, of pieces that are looked at
STAYS, APART = 0.5, 0.05  # of a difference: a jump keeps it however near, and what is beside it changes by far less
GROWS, STILL = 1e3, 4.0  # times the greatest size seen first, and two looks before: a pole
LEAST = 1e-9  # of the sizes in the formula: a difference that is not rounding


def require_whole(calc: Calculation, curve: str) -> None:
    """Raise Unproven where a curve of a single machine jumps or has a pole inside a smooth piece: its numbers there mean nothing."""
    with np.errstate(all="ignore"):
        place = _pole(calc, curve)
        place = _torn(calc, curve) if place is None else place
    if place is None:
        return
    smooth_pieces.require(calc, curve, curve)  # tells the condition that jumps there, if one does
    words = Phrase(
        "{where} jumps or has a pole inside a smooth piece, near {place}; {instead}", _told(calc, curve, place)
    )
    raise Unproven(words, calc.curves[curve].at)


def sharpest(calc: Calculation, step: Step) -> str:
    """Return in words where the curve that a step asks for bends most; empty where it asks for none."""
    curve = getattr(step, "of", "")
    if calc.count > 1 or curve not in calc.curves:
        return ""
    found = _told(calc, curve, _sharpest(calc, curve))
    return Phrase("; {where} bends most near {place}: if it has a corner, a jump or a pole there, {instead}", found)


def _told(calc: Calculation, curve: str, place: float) -> dict[str, str]:
    step, axis = calc.curves[curve], calc.steps[calc.axis[curve]]
    where = Phrase("{description} ({id}, {place})", description=step.description, id=curve, place=Path(step.at).name)
    instead = Phrase("declare that place among the breakpoints of {id}, above what asks for the curve, or require what keeps away from it",
                     id=axis.id)  # fmt: skip
    return {"where": where, "place": f"{axis.symbol} = {told(place, axis.unit)}", "instead": instead}


def _pieces(calc: Calculation, curve: str) -> tuple[Array, Array]:
    """Places in the pieces of an abscissa, (pieces, places), and the middle of each."""
    domain = calc.domains[calc.axis[curve]]
    wide = domain.widths[0] > WIDE * domain.period[0, 0]
    starts, widths = domain.edges[0, :-1][wide], domain.widths[0][wide]
    inner = INSET + (1 - 2 * INSET) * shares(FINE)
    return starts[:, None] + widths[:, None] * inner, domain.middles[0][wide]


def _values(calc: Calculation, curve: str, x: Array, middles: Array) -> Array:
    """A curve at places (pieces, places)."""
    middle = np.broadcast_to(middles[:, None], x.shape)
    return np.broadcast_to(calc.sample(curve, x.reshape(1, -1), middle.reshape(1, -1)), (1, x.size)).reshape(x.shape)


def _torn(calc: Calculation, curve: str) -> float | None:
    """The place where a formula stays apart however near it is looked at, as an angle that wraps; None where there is none."""
    x, middles = _pieces(calc, curve)
    values = _values(calc, curve, x, middles)
    first = np.abs(np.diff(values)).max(initial=0.0)
    if not isinstance(calc.curves[curve], Value | Choice) or not first > LEAST * _scale(calc, curve, x, middles):
        return None
    for _ in range(ROUNDS):
        row, k = np.unravel_index(np.nanargmax(np.abs(np.diff(values))), (len(x), x.shape[1] - 1))
        x, middles = np.linspace(x[row, k], x[row, k + 1], WITHIN + 1)[None], middles[[row]]
        values = _values(calc, curve, x, middles)
    others = np.sort(np.abs(np.diff(values[0])))
    return float(x[0, WITHIN // 2]) if others[-1] > STAYS * first and others[-2] < APART * others[-1] else None


def _pole(calc: Calculation, curve: str) -> float | None:
    """The place where a curve still grows however near it is looked at; None where there is none."""
    x, middles = _pieces(calc, curve)
    sizes = []
    for _ in range(ROUNDS):
        size = np.nan_to_num(np.abs(_values(calc, curve, x, middles)), posinf=np.inf)
        if np.isinf(size).any():
            return float(x[np.isinf(size)][0])
        row, k = np.unravel_index(np.argmax(size), size.shape)
        before, after = max(int(k) - 1, 0), min(int(k) + 1, x.shape[1] - 1)
        sizes.append(float(size[row, k]))
        if sizes[-1] * LEAST > np.delete(size[row, before : after + 1], k - before).max() > 0:  # the pole itself
            return float(x[row, k])
        x, middles = np.linspace(x[row, before], x[row, after], WITHIN + 1)[None], middles[[row]]
    is_pole = sizes[-1] > GROWS * sizes[0] and sizes[-1] > STILL * sizes[-3]
    return float(x[0, WITHIN // 2]) if is_pole else None


def _scale(calc: Calculation, curve: str, x: Array, middles: Array) -> float:
    """The greatest size of a formula's curve and of what it takes in its unit: a difference of those has the rounding of theirs."""
    step = calc.curves[curve]
    assert isinstance(step, Value | Choice)
    own = unit(step.unit).kind
    scale = 1.0 if own in (unit("1").kind, unit("rad").kind) else 0.0
    for name in {curve, *(each for each in step.takes() if isinstance(each, str))}:
        if name == curve or unit(calc.step_or_input(name).unit).kind == own:
            values = (
                _values(calc, name, x, middles)
                if name in calc.curves
                else calc[name]
                if name not in calc.domains
                else x
            )
            scale = max(scale, float(np.abs(values).max(initial=0.0)))
    return scale


def _sharpest(calc: Calculation, curve: str) -> float:
    x, middles = _pieces(calc, curve)
    x = np.linspace(x[:, 0], x[:, -1], FINE + 1, axis=1)
    for _ in range(ROUNDS):
        bends = np.nan_to_num(np.abs(np.diff(_values(calc, curve, x, middles), 2)), posinf=np.inf)
        row, k = np.unravel_index(np.argmax(bends), bends.shape)
        x, middles = np.linspace(x[row, k], x[row, k + 2], WITHIN + 1)[None], middles[[row]]
    return float(x[0, WITHIN // 2])
