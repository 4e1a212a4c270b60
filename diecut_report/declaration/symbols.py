"""Symbols: within a mechanism no two quantities that may be there together are printed by one symbol."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, combinations
from typing import NamedTuple

from diecut_report.contract.binding import bound
from diecut_report.contract.inputs import POINTS, Quantity
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import Lookup, Pick
from diecut_report.contract.result_names import has_own_names, names_ahead, numbered_symbol
from diecut_report.contract.steps import SILENT, Choice, FromCurve, Step, Value
from diecut_report.declaration.input_places import of_input
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault, short
from diecut_report.declaration.world import When
from diecut_report.languages.phrases import Phrase

NO_SYMBOLS = frozenset("$\\{}<>&#%^~")  # letters that mean something to LaTeX or HTML


class Printed(NamedTuple):
    """Hold what has a symbol: a quantity's name, its place, when it is there, and the step that gives it, if none an input.

    ``is_points`` is the number of samples, whose symbol no author chose: it is the other one that gets another.
    """

    name: str
    at: str
    when: When
    step: Step | None = None
    is_points: bool = False

    @property
    def giver(self) -> str:
        """Return what it belongs to: the row of a part."""
        return self.step.id if self.step else self.name


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the second of two quantities with one symbol, and those in LaTeX; texts, and what only takes another over, may share it."""
    by_symbol: dict[str, list[Printed]] = {}
    for symbol, each in chain(_whole(mechanism, names), _single(mechanism, names)):
        by_symbol.setdefault(symbol, []).append(each)
        if letters := NO_SYMBOLS.intersection(symbol):
            words = "has the symbol {symbol} with {letters}; a symbol is plain text, not LaTeX: write α_1, F_max, [σ]"
            yield _of(mechanism, each, Phrase(words, symbol=symbol, letters=" ".join(sorted(letters))))
    told: set[tuple[str, str]] = set()
    for symbol, alike in by_symbol.items():
        for one, other in combinations(alike, 2):
            pair = one.giver, other.giver
            if one.name != other.name and pair not in told and _clash(names, one, other):
                told.add(pair)  # of two rows with many parts the first that are alike
                yield _alike(mechanism, symbol, *((other, one) if other.is_points else (one, other)))


def _alike(mechanism: Mechanism, symbol: str, one: Printed, other: Printed) -> Fault:
    """The fault of the other; inputs stand where they are declared, their quantity may be one of the program."""
    there = one.at if one.step else of_input(mechanism.inputs, one.name, one.at)
    text = Phrase(
        "has the symbol {symbol} of {name} ({points}at {place}): both would be printed as one quantity; give it another",
        symbol=symbol,
        name=one.name,
        points="POINTS, " * one.is_points,
        place=short(there),
    )
    return _of(mechanism, other, text)


def _of(mechanism: Mechanism, each: Printed, text: str) -> Fault:
    """A fault where a quantity is declared."""
    if each.step:
        return Fault(each.at, Phrase("step {id}", id=each.name), text)
    return Fault(of_input(mechanism.inputs, each.name, each.at), Phrase("input {path}", path=each.name), text)


def _whole(mechanism: Mechanism, names: DeclaredNames) -> Iterator[tuple[str, Printed]]:
    """Yield the symbols that are declared."""
    for key in names.world.keys.values():
        if isinstance(key.meta, Quantity) and key.meta.symbol:
            when, is_points = names.known[key.path][0].when, key.meta is POINTS
            yield key.meta.symbol, Printed(key.path, key.meta.at, when, is_points=is_points)
    for number, (_, step) in enumerate(mechanism.steps):
        if step.symbol and step.printed and not isinstance(step, SILENT) and names.kinds(step.id) != {"text"}:
            yield step.symbol, Printed(step.id, step.at, names.when(number), step)


def _single(mechanism: Mechanism, names: DeclaredNames) -> Iterator[tuple[str, Printed]]:
    """Yield the symbols of parts and crossings that formulas may take by names of their own."""
    for number, (_, step) in enumerate(mechanism.steps):
        if step.symbol and has_own_names(step):
            for each in names_ahead(step):
                if each.role in ("part", "crossing"):
                    yield numbered_symbol(step, each.number), Printed(each.name, step.at, names.when(number), step)


def _clash(names: DeclaredNames, one: Printed, other: Printed) -> bool:
    if any(a.step is not None and b.name in _taken_over(a.step) for a, b in ((one, other), (other, one))):
        return False
    return names.world.example(one.when.with_(other.when)) is not None


def _taken_over(step: Step) -> set[str]:
    """The quantities that a step gives again as they are."""
    found: set[str] = set()
    if isinstance(step, FromCurve | Lookup | Pick):
        found = {step.given}
    elif isinstance(step, Value | Choice):
        parts = [step.formula] if isinstance(step, Value) else [case.value for case in step.cases]
        links = [bound(part) for part in parts if not isinstance(part, str)]
        found = {str(name) for link in links if link.formula.tree.op == "sym" for name in link.names.values()}
    return found | {name.removeprefix("inputs.") for name in found}
