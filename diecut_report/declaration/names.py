"""What a mechanism's names stand for: which step or input gives each, when, and whether it is a number, a row or a curve."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain, combinations
from pathlib import Path
from typing import Any, NamedTuple

from diecut_report.errors import nearest
from diecut_report.mechanism.chapters import Chapter
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.curve_inputs import CurveInput, MechanismInput, PhaseInput
from diecut_report.mechanism.figures import Figure
from diecut_report.mechanism.inputs import Block, Key, Quantity, Varying, keys, rules
from diecut_report.mechanism.mechanism import Erratum, Mechanism, Profile, Source, made_when
from diecut_report.mechanism.names import OneOf, Text, When
from diecut_report.mechanism.steps import PREFIX, Phase, Step, has_own_names, names_ahead, read
from diecut_report.text.phrases import Phrase, joined, phrase

# What is wrong with a declaration, in words: where it stands, what it is of, and what to write instead.


class Fault(NamedTuple):
    """One mistake of a plugin's author: the place (``file:line``), what it is of (``step force``), and what to do."""

    place: str
    subject: str
    text: str

    def __str__(self) -> str:
        """The one line that is shown: ``gear.py:12: step force: takes arm, which nothing gives``."""
        return joined([part for part in (short(self.place), self.subject, self.text) if part], ": ")


def subject(declared: Any) -> str:
    """Return how messages call something declared."""
    match declared:
        case Mechanism(kind=kind):
            return Phrase("mechanism {kind}", kind=kind)
        case Chapter(title=title):
            return Phrase("chapter {title}", title=repr(title))
        case Phase(id=id):
            return Phrase("phase {name}", name=id.removeprefix(PREFIX))
        case Step(id=id):
            return Phrase("step {id}", id=id)
        case Check(id=id):
            return Phrase("check {id}", id=id)
        case Figure(id=id):
            return Phrase("figure {id}", id=id)
        case Profile(id=id):
            return Phrase("export {id}", id=id)
        case Source(id=id):
            return Phrase("source {id}", id=id)
        case Erratum(source=source):
            return Phrase("erratum of {source}", source=source)
    return Phrase("comparison {kind}", kind=declared.mechanism.kind)


def fault(declared: Any, text: str, place: str = "") -> Fault:
    """Return what is wrong with something declared, at its place or at another one."""
    return Fault(place or declared.at, subject(declared), text)


def declared_in(mechanism: Mechanism) -> Iterator[Any]:
    """Yield the mechanism and all that it declares beside its inputs, in the order of reading."""
    yield from (mechanism, *mechanism.chapters, *(step for _, step in mechanism.steps))
    yield from (*mechanism.checks, *mechanism.figures, *mechanism.exports, *mechanism.errata)


def short(place: str) -> str:
    """Return a place without the folders of its file."""
    return Path(place).name


KINDS = {
    "number": phrase("a number"), "row": phrase("a row"), "curve": phrase("a curve"), "abscissa": phrase("an abscissa"),
    "crossings": phrase("found crossings"), "text": phrase("a text"), "curve input": phrase("a curve input"), "block": phrase("a block"),
    "varying": phrase("a number that varies"), "phase": phrase("a phase"), "mechanism": phrase("a mechanism"),
    "prepared": phrase("what is prepared"), "list of parts": phrase("a list of parts"),
}  # fmt: skip
"""What a name may be, in words."""


def kinds_told(kinds: Iterable[str]) -> str:
    """Return in words what a name may be."""
    return joined([KINDS[kind] for kind in sorted(kinds)], " or ")


def unknown(name: str, known: Iterable[str]) -> str:
    """Return a name that nothing gives, with the nearest one that something gives."""
    return Phrase("{name}, which nothing gives{nearest}", name=name, nearest=nearest(name, known))


# Which inputs may be given together: what is optional, which texts are allowed, of which keys one group is needed.


GIVEN, OTHER = "given", "another text"
Given = str | None  # what is known of an input: that it is given, its text, or None where it is left out


@dataclass
class World:
    """The inputs of a mechanism by their paths, and what may be given of them."""

    keys: dict[str, Key]
    rules: tuple[tuple[str, OneOf], ...]
    """Of which keys one group is needed, each rule with the path of the block that it is for."""
    _found: dict[Any, dict[str, Given] | None] = field(default_factory=dict)

    def example(self, holds: When, never: Sequence[When] = ()) -> dict[str, Given] | None:
        """Return what may be given so that something is calculated and none of the others; None where that cannot be.

        An input with a default is taken as given where others are asked about: only its model knows with what it is put to None.
        """
        if any(other.needs <= holds.needs and other.lacks <= holds.lacks for other in never):
            return None
        asked = holds, tuple(never)
        if asked not in self._found:
            self._found[asked] = next(self._search(holds, never, self._variables(holds, never), {}), None)
        return self._found[asked]

    def _search(
        self, holds: When, never: Sequence[When], open_ones: Sequence[str], known: dict[str, Given]
    ) -> Iterator[dict[str, Given]]:
        if (
            _judged(holds, known) is False
            or any(_judged(other, known) for other in never)
            or not all(_keeps(home, rule, known, self.keys) for home, rule in self.rules)
        ):
            return
        if not open_ones:
            yield known
            return
        for value in self._values(open_ones[0], known):
            if value is None and never and self.keys[open_ones[0]].has_default:
                continue
            yield from self._search(holds, never, open_ones[1:], {**known, open_ones[0]: value})

    def _variables(self, holds: When, never: Sequence[When]) -> list[str]:
        """The inputs on which it depends; those that something needs come first, blocks before what is in them."""
        tokens = [token for each in (holds, *never) for token in sorted(each.needs | each.lacks)]
        paths = [token.partition("=")[0] for token in tokens]
        heads = [(home, rule, {rule.when.partition("=")[0]} - {""}) for home, rule in self.rules]
        grouped = [{f"{home}{key}" for key in head.union(*rule.groups)} for home, rule, head in heads]
        paths += [key for each in grouped if each.intersection(paths) for key in sorted(each)]
        found = [above for path in paths for above in (*_above(path), path)]
        return [path for path in dict.fromkeys(found) if path in self.keys]

    def _values(self, path: str, known: Mapping[str, Given]) -> Iterator[Given]:
        key = self.keys[path]
        if any(known.get(above, GIVEN) is None for above in _above(path)):
            yield None
            return
        yield from key.texts or ((OTHER, GIVEN) if isinstance(key.meta, Text) and not key.block else (GIVEN,))
        if key.may_be_absent:
            yield None


def _keeps(home: str, rule: OneOf, known: Mapping[str, Given], keys: Mapping[str, Key]) -> bool:
    """Whether a rule lets these be given; a key with a default is there without being typed, so that it may stand in no group."""
    names = {key: f"{home}{key}" for group in rule.groups for key in group}
    if rule.when and not _holds(f"{home}{rule.when}", known):
        return True
    if not all(path in known for path in names.values()) or (home and known.get(home.removesuffix(".")) is None):
        return True
    typed = [key for key, path in names.items() if known[path] is not None and not keys[path].has_default]
    free = [key for key, path in names.items() if known[path] is not None and keys[path].has_default]
    chosen = chain.from_iterable(combinations(free, count) for count in range(len(free) + 1))
    return any(not rule.fault([*typed, *more]) for more in chosen)


def _above(path: str) -> list[str]:
    parts = path.split(".")
    return [".".join(parts[:count]) for count in range(1, len(parts))]


def _judged(when: When, known: Mapping[str, Given]) -> bool | None:
    """Whether something is calculated; None where what is known does not say."""
    needed = [_holds(token, known) for token in when.needs]
    lacking = [_holds(token, known) for token in when.lacks]
    if False in needed or True in lacking:
        return False
    return None if None in needed or None in lacking else True


def _holds(token: str, known: Mapping[str, Given]) -> bool | None:
    path, is_text, text = token.partition("=")
    if path not in known:
        return None
    return known[path] == text if is_text else known[path] is not None


def world(model: type[Block]) -> World:
    """Return the inputs of a model, and what may be given of them."""
    return World(dict(keys(model)), rules(model))


def told(given: Mapping[str, Given], tokens: Iterable[str]) -> str:
    """Return in words what is given, of the inputs that tokens name; empty where there is none."""
    paths = dict.fromkeys(token.partition("=")[0] for token in tokens)
    words = []
    for path in sorted(path for path in paths if path in given):
        text = given[path]
        given_text = f"{path}={text}" if text not in (GIVEN, OTHER) else path
        words.append(Phrase("without {path}", path=path) if text is None else Phrase("with {given}", given=given_text))
    return joined(words, " and ")


def where(given: Mapping[str, Given], tokens: Iterable[str]) -> str:
    """Return the same behind a space, as a part of a sentence."""
    words = told(given, tokens)
    return Phrase(" {where}", where=words) if words else ""


class Giver(NamedTuple):
    """What gives a name: an input, or a step at a place in the order; when, and what it is."""

    when: When
    kind: str  # number, row, curve, abscissa, crossings, text, curve input, block
    axis: str  # of a curve its abscissa, of a row its list
    unit: str | None
    step: Step | None = None
    number: int = -1
    units: tuple[tuple[str, str], ...] = ()

    def units_when(self, needs: Iterable[str]) -> set[str]:
        """Return the units that it may have where these inputs are given."""
        held = {other for key, other in self.units if key in needs}
        return held or {other for _, other in self.units} | ({self.unit} if self.unit else set())


@dataclass(frozen=True)
class DeclaredNames:
    """All names of a mechanism."""

    mechanism: Mechanism

    @cached_property
    def world(self) -> World:
        """Return the inputs, and which of them may be given together."""
        found = world(self.mechanism.inputs)
        found.keys |= {name: Key(name) for name in self.mechanism.facts}
        return found

    @cached_property
    def steps(self) -> list[tuple[Step, When]]:
        """Return the steps in their order, each with when it is made."""
        return [(step, made_when(chapter, step)) for chapter, step in self.mechanism.steps]

    @cached_property
    def known(self) -> dict[str, list[Giver]]:
        """Each name with all that gives it, inputs first, then steps in their order."""
        found: dict[str, list[Giver]] = {}
        for key in self.world.keys.values():
            for name in (key.path, f"inputs.{key.path}"):
                found.setdefault(name, []).append(_input(key))
        for number, (step, when) in enumerate(self.steps):
            for name, giver in self._given(number, step, when, found):
                found.setdefault(name, []).append(giver)
        return found

    def _given(self, number: int, step: Step, when: When, found: dict[str, list[Giver]]) -> Iterator[tuple[str, Giver]]:
        def over(*names: str, of_all: bool = False) -> set[tuple[str, str]]:
            """Return the kinds and axes of what runs over something; ``of_all`` also of texts."""
            givers = [giver for name in names for giver in found.get(name, ()) if giver.axis or not of_all]
            own = [giver for giver in givers if of_all or giver.kind in ("curve", "abscissa", "row")]
            return {("curve" if giver.kind == "abscissa" else giver.kind, giver.axis) for giver in own}

        for kind, axis in step.kinds(over):
            own = None if kind in ("text", "prepared", "list of parts") else step.unit
            yield step.id, Giver(when, kind, axis, own, step, number, step.units)
        for each in names_ahead(step):
            if each.role == "place":
                places = [axis for curve in found.get(step.asked_curve, ()) for axis in found.get(curve.axis, ())]
                own, forms = (places[0].unit, places[0].units) if places else (None, ())
                yield each.name, Giver(when, "number", "", own, step, number, forms)
            if each.role == "count":
                yield each.name, Giver(when, "number", "", "1", step, number)

    def givers(self, name: str) -> list[Giver]:
        """Return what gives a name: inputs and steps."""
        return self.known.get(name) or list(self._numbered(name))

    def _numbered(self, name: str) -> Iterator[Giver]:
        for number, (step, when) in enumerate(self.steps):
            found = read(name, step) if has_own_names(step) else None
            if found and found.role in ("crossing", "part"):
                yield Giver(when, "number", "", step.unit, step, number)

    def units(self, name: str, needs: Iterable[str] = ()) -> set[str]:
        """Return the units that a quantity may have where these inputs are given."""
        return {each for giver in self.givers(name) for each in giver.units_when(needs)}

    def without(self, when: When, given: str) -> When:
        """Return when something is made while an input is not given."""
        path = given.removeprefix("inputs.")
        return when.with_(When(frozenset(), frozenset((path,)))) if path else when

    def incomplete(self, by: str, rows: Mapping[str, Any], when: When, none: str) -> Iterator[str]:
        """Yield what is wrong with a choice by a text: each text that may be given has its row."""
        key = self.world.keys.get(by)
        if key is None:
            return  # told where ids are
        if not key.texts:
            allowed = ", ".join(map(repr, rows))
            template = (
                "is chosen by {by}, which may be any text; give it allowed ones: Annotated[Literal[{allowed}], Text(…)]"
            )
            yield Phrase(template, by=by, allowed=allowed)
            return
        missing = [text for text in key.texts if text not in rows]
        chosen = {text: when.with_(When(frozenset((f"{by}={text}",)))) for text in missing}
        if missing := [text for text in missing if key.home or self.world.example(chosen[text])]:
            template = "has {none} for {by}={missing}; add {them}, or forbid the text"
            them = phrase("it" if len(missing) == 1 else "them")
            yield Phrase(template, none=none, by=by, missing=", ".join(missing), them=them)

    def kinds(self, name: str) -> set[str]:
        """Return what a name may be: number, row, curve, …"""
        return {giver.kind for giver in self.givers(name)}

    def axes(self, name: str) -> set[str]:
        """Return the abscissas or lists that a name may run over."""
        return {giver.axis for giver in self.givers(name) if giver.axis}

    def missing(self, name: str, when: When, before: int | None = None) -> dict[str, str | None] | None:
        """Return what is given where a name is wanted and nothing (before a step) gives it; None where that cannot be."""
        givers = [g.when for g in self.givers(name) if before is None or g.number < before]
        return self.world.example(when, givers)


def _input(key: Key) -> Giver:
    when = When(frozenset((key.path,)) if key.may_be_absent or "." in key.path else frozenset())
    kind = "row" if key.home else "number"
    match key.meta:
        case _ if key.block:
            kind = "block"
        case Varying():
            return Giver(when, "varying", key.home, key.meta.unit)
        case Quantity():
            return Giver(when, kind, key.home, key.meta.unit, units=key.meta.units)
        case PhaseInput():
            return Giver(when, "phase", key.home, key.meta.unit)
        case MechanismInput():
            return Giver(when, "mechanism", key.home, None)
        case CurveInput():
            return Giver(when, "curve input", "", key.meta.unit, units=key.meta.units)
        case Text():
            kind = "text"
    return Giver(when, kind, key.home, None)
