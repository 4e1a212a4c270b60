"""Checks: their sides are numbers, rows or curves that something gives, of one kind of unit, and what is said of them is known."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from diecut_report.contract.checks import Check
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration import same_sides
from diecut_report.declaration.messages import unprintable
from diecut_report.declaration.names import DeclaredNames, Giver
from diecut_report.declaration.order import pairs
from diecut_report.declaration.words import Fault, unknown
from diecut_report.declaration.world import When
from diecut_report.languages.phrases import Phrase, named, phrase
from diecut_report.quantities.units import unit

JUDGED = ("number", "row", "curve")
OF_PARTS = ("part", "next", "index")


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the checks."""
    made = [(check, when) for check in mechanism.checks for when in _when(names, check)]
    yield from pairs(names, "check", made)
    for check in mechanism.checks:
        for text in _wrong(names, check):
            yield Fault(check.at, Phrase("check {id}", id=check.id), text)


def _when(names: DeclaredNames, check: Check) -> list[When]:
    """When a check is made: what it needs is given, and something gives each of its sides."""
    givers = [[giver.when for giver in names.givers(name)] for name in check.named]
    found = []
    for chosen in product(*givers):
        when = When(frozenset((*check.needs, *check.only_with)))
        for other in chosen:
            when = when.with_(other)
        found.append(when)
    return [when for when in dict.fromkeys(found) if names.world.example(when) is not None]


def _wrong(names: DeclaredNames, check: Check) -> Iterator[str]:
    sides = {name: names.givers(name) for name in check.named}
    if not sides:
        yield phrase("compares plain numbers only; one side at least must be the id of a quantity")
        return
    for name, givers in sides.items():
        if not givers:
            yield Phrase("takes {unknown}", unknown=unknown(name, names.known))
        for kind in sorted({giver.kind for giver in givers} - set(JUDGED)):
            yield Phrase("compares {name}, {instead}", name=name, instead=_instead(name, kind))
        units = {each for giver in givers if giver.kind in JUDGED for each in _units(names, giver, check)}
        wrong = sorted(each for each in units if unit(each).kind != unit(check.unit).kind)
        if wrong:
            yield Phrase("is in {unit}, {name} in {wrong}", unit=check.unit, name=name, wrong=", ".join(wrong))
    if not all(sides.values()):
        return
    axes = {giver.axis for givers in sides.values() for giver in givers if giver.axis}
    if len(axes) > 1:
        yield Phrase(
            "compares what runs over {axes}; compare numbers, or curves over one abscissa",
            axes=named(sorted(axes), " with what runs over "),
        )
    yield from same_sides.told(names, check)
    yield from _names_of_parts(names, check)
    made = _when(names, check)
    if not made:
        yield phrase("is never made: what it needs and what it compares is never given together")
    parts = OF_PARTS if any(names.kinds(name) == {"row"} for name in sides) else ()
    wrong_names = (text for when in made for text in unprintable(names, check.consequence, when, parts))
    yield from dict.fromkeys(Phrase("the consequence names {text}", text=text) for text in wrong_names)


def _names_of_parts(names: DeclaredNames, check: Check) -> Iterator[str]:
    """What is wrong with the names of parts, each of which is to have a check of its own."""
    if not check.named_by:
        return
    if not any(giver.kind == "row" for name in check.named for giver in names.givers(name)):
        yield Phrase(
            "is one check for each of {named_by}, but compares no row over repeated parts; leave named_by out",
            named_by=check.named_by,
        )
    elif check.named_by not in names.world.keys or {giver.kind for giver in names.givers(check.named_by)} - {"text"}:
        yield Phrase(
            "is one check for each of {named_by}, which is not a text of repeated parts", named_by=check.named_by
        )


def _units(names: DeclaredNames, giver: Giver, check: Check) -> set[str]:
    """The units that a side may have where the check is made."""
    needs = (*check.needs, *check.only_with)
    beside = {unit for key, unit in giver.units if names.world.example(When(frozenset((*needs, key)))) is None}
    return giver.units_when(needs) - (beside - {giver.unit})


def _instead(name: str, kind: str) -> str:
    return {
        "text": phrase("a text; compare a number"),
        "abscissa": phrase("an abscissa, which takes all its values; compare a curve over it"),
        "crossings": Phrase(
            "places that may be none or many; compare {name}_count, or one of them as {name}_1", name=name
        ),
        "curve input": phrase("a curve input; take it over by FromCurve and compare that curve"),
        "block": phrase("a block; compare one of its inputs"),
    }[kind]
