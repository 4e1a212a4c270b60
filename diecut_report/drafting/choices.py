"""What a configuration is to begin with: mechanisms of chosen kinds, each with a name of its own."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import count

from diecut_report.config.discovery import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.loader import NAME, RESERVED
from diecut_report.contract.mechanism import Mechanism
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.limits import MAX_MECHANISMS


@dataclass(frozen=True)
class Drafted:
    """Hold a mechanism that is to be written: its name, its kind, and what its plugin declares."""

    name: str
    kind: str
    mechanism: Mechanism


def chosen(given: Sequence[str], discovery: Discovery) -> list[Drafted]:
    """Return the mechanisms of texts such as ``clutch`` or ``clutch:main``; UserError with all that is wrong with them."""
    parts = [text.partition(":") for text in given]
    found, problems = [], list(_wrong_names([name for _, colon, name in parts if colon]))
    if len(given) > MAX_MECHANISMS:
        words = "{count} mechanisms are asked for; a configuration has at most {most}."
        problems.append(Problem(Phrase(words, count=len(given), most=MAX_MECHANISMS)))
    names = {name for _, _, name in parts if name}
    for kind, _, name in parts:
        try:
            mechanism = discovery.mechanism(kind)
        except (UnknownKind, DuplicateKind) as fault:
            problems.append(Problem(str(fault)))
            continue
        own = name or free_name(mechanism, names)
        names.add(own)
        found.append(Drafted(own, kind, mechanism))
    if problems:
        raise UserError(dict.fromkeys(problems))
    return found


def free_name(mechanism: Mechanism, names: Iterable[str]) -> str:
    """Return a name that no other mechanism has: that of its example, else its kind, numbered from the second on."""
    first = mechanism.example.name if mechanism.example else mechanism.kind
    taken = {*names, *RESERVED}
    return next(name for number in count(1) if (name := first if number == 1 else f"{first}_{number}") not in taken)


def by_kind(mechanisms: Iterable[Drafted]) -> Mapping[str, Sequence[str]]:
    """Return the names of the mechanisms of each kind."""
    found: dict[str, list[str]] = {}
    for each in mechanisms:
        found.setdefault(each.kind, []).append(each.name)
    return found


def _wrong_names(names: Sequence[str]) -> Iterable[Problem]:
    for name in dict.fromkeys(names):
        if not NAME.fullmatch(name):
            words = "{name} is not a name: a letter, then letters, digits, _ and - are allowed."
            yield Problem(Phrase(words, name=repr(name)))
        elif name in RESERVED:
            yield Problem(Phrase("the name {name} is reserved. Choose another one.", name=repr(name)))
        elif names.count(name) > 1:
            yield Problem(
                Phrase("the name {name} is given to several mechanisms. Choose another one.", name=repr(name))
            )
