"""Refuses what would be reported of a curve that jumps inside a smooth piece: its extremes and integrals could be any numbers."""

from __future__ import annotations

from pathlib import Path

from diecut_report.contract.steps import Value
from diecut_report.engine.calculation import Calculation, Unproven
from diecut_report.engine.numerics import switches
from diecut_report.engine.numerics.decisions import Decision
from diecut_report.engine.numerics.switching import JumpFault
from diecut_report.expressions import Node, substitute, written
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import told


def require(calc: Calculation, asking: str, curve: str) -> None:
    """Refuse a single machine whose curve jumps elsewhere than at its breakpoints; mark such variants. ``asking`` asks for the curve."""
    if curve not in calc.curves:
        return
    for variant, found in switches.faults(calc, curve):
        words = _words(calc, found)
        if calc.count == 1:
            raise Unproven(words, calc.curves[curve].at)
        calc.flaws[variant] = asking, words


def _words(calc: Calculation, found: JumpFault) -> str:
    curve, axis = calc.steps.get(found.curve), calc.steps[calc.axis[found.curve]]
    assert curve is not None
    place = f"{axis.symbol} = {told(found.place, axis.unit)}"
    where = f"{curve.description} ({curve.id}, {Path(curve.at).name})"
    fix = Phrase("declare that place among the breakpoints of {id}, above what asks for the curve", id=axis.id)
    if found.decision is None:
        return (Phrase("{where} takes a flag of its smooth pieces (per_piece) that is not constant within one, as at "
"{place}: it would be that of the middle of the piece; {fix}, or take per_piece away", where=where, place=place, fix=fix))  # fmt: skip
    step, link = found.decision.step, found.decision.link
    name = Phrase("the formula {name}", name=link.formula.__name__) if isinstance(step, Value) else phrase("the choice")
    decided = written(_in_symbols(calc, found.decision))
    of = (
        phrase("its formula")
        if step.id == curve.id
        else Phrase("{name} of {id} ({place})", name=name, id=step.id, place=Path(step.at).name)
    )
    return Phrase(
        "{where} jumps inside a smooth piece, at {place}, where {decided} changes in {of}; {fix}",
        where=where,
        place=place,
        decided=decided,
        of=of,
        fix=fix,
    )


def _in_symbols(calc: Calculation, decision: Decision) -> Node:
    """What decides, with the symbols of the quantities."""
    names = decision.link.names
    shown = {
        parameter: Node("sym", (calc.step_or_input(name).symbol,)) if isinstance(name, str) else Node("num", (f"{name:g}",))
        for parameter, name in names.items()
    }  # fmt: skip
    return substitute(decision.node, shown)
