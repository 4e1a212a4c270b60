"""Where a mechanism declares what a fault is told of."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.input_places import of_input
from diecut_report.declaration.words import short
from diecut_report.languages.phrases import Phrase


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
