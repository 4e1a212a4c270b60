"""What is wrong with a formula that does not give what is printed of it."""

from __future__ import annotations

from diecut_report.contract.binding import Bound
from diecut_report.contract.steps import Step
from diecut_report.engine.printing.substitution import MOST_DIGITS, Contradiction
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.quantities.units import unit


def contradicted(step: Step, part: Bound, found: Contradiction) -> str:
    """Return what is wrong with a formula whose expression does not give its result, with so many digits as show it."""
    factor, said = unit(step.unit).factor, ("", "")
    for digits in range(step.digits, MOST_DIGITS + 1):
        said = (number_text(found.result / factor, digits), number_text(found.printed / factor, digits))
        if said[0] != said[1]:
            break
    result, again = (with_unit(text, step.unit) for text in said)
    formula = part.formula
    return Phrase(
        "{description} ({id}) is {result}, but its formula {name} as it is printed gives {again}, which "
        "is more than rounding; it must compute by its parameters and constants alone ({place})",
        description=step.description,
        id=step.id,
        result=result,
        name=formula.__name__,
        again=again,
        place=formula.place,
    )
