"""What the contract test tells of each rule, and where in a plugin something stands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Literal

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.input_places import of_input
from diecut_report.declaration.words import short
from diecut_report.languages.phrases import Counted, Phrase, phrase

RuleStatus = Literal["pass", "note", "not_tried", "fail", "broke"]
TOLD = 5  # faults of a rule that are told
TITLES = {
    "declaration": phrase("Declarations"),
    "dimensions": phrase("Dimensions of formulas"),
    "printed": phrase("Printed as computed"),
    "inputs": phrase("Inputs that are taken"),
    "example": phrase("Example machine"),
    "alone": phrase("Many machines as each alone"),
    "hostile": phrase("Extreme inputs"),
    "figures": phrase("Figures and report"),
    "languages": phrase("Words in all languages"),
    "speed": phrase("Time of 1000 variants"),
}
"""The rules of the contract, in the order in which they are tried."""


@dataclass(frozen=True)
class TriedRule:
    """Hold a rule of the contract that was tried: what was found in words, and each fault with its place and what to do.

    ``note`` is no fault, but what an author should know; ``broke`` is a plugin that raises where it should not.
    """

    id: str
    status: RuleStatus
    told: str = ""
    faults: tuple[str, ...] = ()

    @property
    def title(self) -> Phrase:
        """Return what the rule is about."""
        return TITLES[self.id]


def rule(id: str, told: str, faults: Iterable[str], otherwise: RuleStatus = "fail") -> TriedRule:
    """Return a rule that passes where there is no fault; where there are many, their first and how many more."""
    found = list(dict.fromkeys(islice(faults, 1000)))
    if not found:
        return TriedRule(id, "pass", told)
    more = [Counted(len(found) - TOLD, "{n} more fault", "{n} more faults")] if len(found) > TOLD else []
    return TriedRule(id, otherwise, told, (*found[:TOLD], *more))


def at_place(mechanism: Mechanism, name: str, text: str) -> str:
    """Return a text with the file and the line that declare a quantity, check or figure, and its name."""
    place = next((at for id, at in _places(mechanism, name) if id == name), mechanism.at)
    return Phrase("{place}: {name}: {text}", place=short(place), name=name, text=text)


def by_id(mechanism: Mechanism, text: str) -> str:
    """Return a text of the form ``ID: what is wrong`` with the place of the id."""
    subject, _, rest = text.partition(": ")
    name = subject.removeprefix("check ").partition(" ")[0]
    return text if ".py:" in subject else at_place(mechanism, name, rest or text)


def _places(mechanism: Mechanism, name: str) -> Iterator[tuple[str, str]]:
    for _, step in mechanism.steps:
        yield step.id, step.at
    yield from ((check.id, check.at) for check in mechanism.checks)
    yield from ((figure.id, figure.at) for figure in mechanism.figures)
    yield from ((export.id, export.at) for export in mechanism.exports)
    try:
        yield name, of_input(mechanism.inputs, name, mechanism.at)
    except (KeyError, AttributeError, TypeError):  # it is no input
        return
