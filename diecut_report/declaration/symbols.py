"""Symbols: within a mechanism no two quantities that may be there together are printed by one symbol."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from diecut_report.contract.binding import bound
from diecut_report.contract.inputs import Quantity
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import Lookup
from diecut_report.contract.steps import SILENT, Choice, FromCurve, Step, Value
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault, short
from diecut_report.declaration.world import When


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the second of two quantities with one symbol; texts, and what only takes another quantity over, may share it."""
    by_symbol: dict[str, list[tuple[str, str, When, Step | None]]] = {}
    for key in names.world.keys.values():
        if isinstance(key.meta, Quantity) and key.meta.symbol:
            when = names.known[key.path][0].when
            by_symbol.setdefault(key.meta.symbol, []).append((key.path, key.meta.at, when, None))
    for number, (_, step) in enumerate(mechanism.steps):
        if step.symbol and not isinstance(step, SILENT) and names.kinds(step.id) != {"text"}:
            by_symbol.setdefault(step.symbol, []).append((step.id, step.at, names.when(number), step))
    for symbol, alike in by_symbol.items():
        for one, other in combinations(alike, 2):
            if one[0] != other[0] and _clash(names, one, other):
                text = f"has the symbol {symbol} of {one[0]} (at {short(one[1])}): both would be printed as one quantity; give it another"
                yield Fault(other[1], f"{'step' if other[3] else 'input'} {other[0]}", text)


def _clash(
    names: DeclaredNames, one: tuple[str, str, When, Step | None], other: tuple[str, str, When, Step | None]
) -> bool:
    if any(step is not None and name in _taken_over(step) for step, name in ((one[3], other[0]), (other[3], one[0]))):
        return False
    return names.world.example(one[2].with_(other[2])) is not None


def _taken_over(step: Step) -> set[str]:
    """The quantities that a step gives again as they are."""
    found: set[str] = set()
    if isinstance(step, FromCurve | Lookup):
        found = {step.given}
    elif isinstance(step, Value | Choice):
        parts = [step.formula] if isinstance(step, Value) else [case.value for case in step.cases]
        links = [bound(part) for part in parts if not isinstance(part, str)]
        found = {str(name) for link in links if link.formula.tree.op == "sym" for name in link.names.values()}
    return found | {name.removeprefix("inputs.") for name in found}
