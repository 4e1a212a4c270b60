"""The contract test for a mechanism plugin: ``check_mechanism(MECHANISM)`` raises AssertionError with all that is wrong.

It goes through every declared formula with the units of what it takes and refuses where dimensions do not balance (the angle is one), in
each of the units that a mechanism may have, and checks all that is declared, as loading a plugin does (``diecut_report.declaration``).
"""

from __future__ import annotations

import ast
import json
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import fields as fields_of
from dataclasses import is_dataclass, replace
from itertools import chain, combinations
from pathlib import Path
from typing import Any, cast

import numpy as np

from diecut_report.declaration import code, faults
from diecut_report.declaration.inputs import of_input
from diecut_report.declaration.names import declared_in, short, subject
from diecut_report.declaration.texts import PAPER, own_files, parsed, unlisted
from diecut_report.formulas.conditions import alike as kinds_alike
from diecut_report.formulas.expression import GRAVITY
from diecut_report.formulas.formula import Formula, evaluate
from diecut_report.formulas.tree import APPLY, AS_ANGLE, AS_NUMBER, PI, Node, symbols, walk, written
from diecut_report.mechanism.chapters import Chapter, form_keys, in_form, in_unit, taken
from diecut_report.mechanism.inputs import Block, Inputs, fields, keys
from diecut_report.mechanism.mechanism import Mechanism, axes
from diecut_report.mechanism.names import Text
from diecut_report.mechanism.steps import SilentStep, Step, Value, names_ahead
from diecut_report.mechanism.steps.protocols import StepFormula
from diecut_report.quantities.formatting import NAMED
from diecut_report.quantities.units import DIMENSIONS, Kind, si_text, times, unit
from diecut_report.text.phrases import Phrase, phrase

# Inputs that nothing takes: somebody types them, and no result changes.


FOR_READERS = ("symbol", "unit", "description", "source", "title", "summary", "caption", "at", "kind", "version", "id")


def idle_inputs(mechanism: Mechanism) -> Iterator[str]:
    """Yield the numbers and curves among the inputs that nothing takes or names; a text may be there for the reader alone."""
    used = {name.removeprefix("inputs.").partition("=")[0] for name in _used(mechanism)}
    used |= {key for key, singles in _spread(mechanism.inputs) if used.intersection(singles)}
    told = _told_in_code(own_files(mechanism))
    for path, meta in fields(mechanism.inputs):
        if not isinstance(meta, Text) and path not in used and path.rpartition(".")[2] not in told:
            place = short(of_input(mechanism.inputs, path, mechanism.at))
            template = "{place}: input {path}: nothing uses it, so it affects no result; use it in a step, or remove it"
            yield Phrase(template, place=place, path=path)


def _used(mechanism: Mechanism) -> Iterator[str]:
    """The names in all that is declared: of what is taken, of what switches it on, of what a message prints."""
    for chapter, step in mechanism.steps:
        yield from (*taken(step), *chapter.needs, *named_in(step))
    for parts in (mechanism.checks, mechanism.figures, mechanism.exports):
        yield from named_in(parts)
    for comparison in mechanism.comparisons:
        yield from (name for _, name in comparison.takes.values())
    yield from (key for _, meta in fields(mechanism.inputs) for key, _ in getattr(meta, "units", ()))


def named_in(declared: Any) -> Iterator[str]:
    """Yield the texts in something declared, but those for the reader, with the ``{ids}`` in them."""
    if isinstance(declared, str):
        yield declared
        yield from (found[1] for found in NAMED.finditer(declared))
    elif isinstance(declared, tuple | list):
        for part in declared:
            yield from named_in(part)
    elif is_dataclass(declared):
        for field in fields_of(declared):
            if field.name not in FOR_READERS and not (field.name == "cases" and isinstance(declared, Step)):
                yield from named_in(getattr(declared, field.name))


def _spread(model: type[Block]) -> Iterator[tuple[str, set[str]]]:
    """Keys that stand for others, each with those."""
    inner = [(f"{key.path}.", key.block) for key in keys(model).values() if key.block]
    for prefix, block in [("", model), *inner]:
        yield from ((prefix + key, {prefix + single for single in singles}) for key, singles in block.spread.items())


def _told_in_code(files: Iterable[Path]) -> set[str]:
    """The words that code may ask by, as drawings and validators do: whole texts, their parts between dots, and attributes."""
    found: set[str] = set()
    for file in files:
        for node in ast.walk(parsed(file)):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.update(node.value.split("."))
            elif isinstance(node, ast.Attribute):
                found.add(node.attr)
    return found


def check_mechanism(mechanism: Mechanism) -> None:
    """Raise AssertionError, listing every flaw of a mechanism's declaration."""
    problems = [str(fault) for fault in faults(mechanism)] or [
        *idle_inputs(mechanism),
        *(problem for form in forms(mechanism) for problem in unbalanced(form)),
    ]
    assert not problems, f"{mechanism.kind}:\n" + "\n".join(problems)


def unbalanced(mechanism: Mechanism) -> Iterator[str]:
    """Return the dimensions that do not balance in a mechanism in one of its forms."""
    return chain(dimensions(mechanism), curve_units(mechanism), relations(mechanism))


def forms(mechanism: Mechanism) -> Iterator[Mechanism]:
    """Yield the mechanism in all units that it may have, each with the steps that are made then."""
    keys = form_keys(mechanism.inputs).union(*([key for key, _ in step.units] for _, step in mechanism.steps))
    for count in range(len(keys) + 1):
        for given in map(frozenset, combinations(sorted(keys), count)):
            rules = [each.groups for each in mechanism.inputs.one_of if given.intersection(chain(*each.groups))]
            excluded = chain(*(group for groups in rules for group in groups if given.isdisjoint(group)))
            absent = (keys - given).union(excluded)
            chapters = tuple(replace(c, steps=_in_form(c, given, absent)) for c in mechanism.chapters)
            inputs = cast(type[Inputs], in_form(mechanism.inputs, given))
            yield replace(mechanism, inputs=inputs, chapters=chapters)


def _in_form(chapter: Chapter, given: frozenset[str], absent: frozenset[str]) -> tuple[Step, ...]:
    made = [s for s in chapter.steps if absent.isdisjoint(chapter.needs + s.needs) and given.isdisjoint(s.lacks)]
    return tuple(in_unit(step, given) for step in made)


# What is wrong with the formulas of a plugin, remembered by the content of its files in the user's folder for what can be made again.


FOLDER = "formulas"


def faults_of_formulas(mechanism: Mechanism) -> tuple[str, ...]:
    """Return dimensions that do not balance, each with file and line.

    What was found is judged again where one of the plugin's files, or the program, has changed. The declarations are sound.
    """
    key = code.content(mechanism)
    with suppress(ValueError):  # it is judged again
        known = json.loads(code.remembered(FOLDER, key) or "null")
        if isinstance(known, list) and all(isinstance(each, str) for each in known):
            return tuple(known)
    try:
        found = tuple(dict.fromkeys(by_id(mechanism, text) for form in forms(mechanism) for text in unbalanced(form)))
    except Exception as cause:  # a formula that cannot be gone through alone
        found = (f"{type(cause).__name__}: {cause}",)
    code.remember(FOLDER, key, json.dumps(found))
    return found


# What an author may mean, and often does not: a unit that a formula converts by hand, a chapter that nothing depends on.


POWERS = (1e-9, 1e-6, 1e-4, 1e-3, 1e2, 1e3, 1e4, 1e5, 1e6, 1e9)
BY_HAND = np.array([
    *POWERS, 60, 3600, 180, 360, np.pi, 180 / np.pi, np.pi / 180, np.pi / 30, 30 / np.pi, 30000 / np.pi,
    float(GRAVITY), 25.4, 4.448222, 6894.757, 735.5,
])  # fmt: skip
AS_TYPED = 1e-3  # relative: 57.3 is 180/π, and 9.8 the acceleration of gravity


def doubts(mechanism: Mechanism) -> Iterator[str]:
    """Yield what may be a mistake, each with its place."""
    for step, _, formula in formulas(mechanism):
        for number in _converting(formula.tree):
            template = "{place}: {id}: holds {number}, a number without a unit; formulas are in SI and convert nothing: if it stands for a unit or a constant, take it away, or write pi, GRAVITY or Constant(…)"  # noqa: E501
            yield Phrase(template, place=short(step.at), id=step.id, number=number)
    for citing, name in unlisted(mechanism, PAPER):
        template = "{place}: {subject} cites {name}, which is not a source; list it: sources=(Source({id}, …),)"
        yield Phrase(template, place=short(citing.at), subject=subject(citing), name=name, id=repr(name))
    yield from _exchanged(mechanism)
    yield from _idle_chapters(mechanism)


def _exchanged(mechanism: Mechanism) -> Iterator[str]:
    """Checks whose demand is an input, and whose limit a result, by the signs that an author gives to what is allowed."""
    symbols = {path: getattr(meta, "symbol", "") for path, meta in fields(mechanism.inputs)}
    given = {step.id for _, step in mechanism.steps}
    for check in mechanism.checks:
        demand, limit = (str(side).removeprefix("inputs.") for side in (check.demand, check.limit))
        if symbols.get(demand, "").startswith("[") and limit in given:
            template = "{place}: check {id}: its demand {demand} ({symbol}) has the symbol of what is allowed, and its limit {limit} is calculated; exchange them where the limit is what must not be too great"  # noqa: E501
            yield Phrase(
                template, place=short(check.at), id=check.id, demand=demand, symbol=symbols[demand], limit=limit
            )


def _converting(tree: Node) -> list[str]:
    """The numbers of a formula, typed or worked out of typed ones, that may stand for a unit: π and 30 together are turns a minute."""
    found = dict(_numbers(tree))
    known = {
        text: value
        for text, value in found.items()
        if np.isclose(value, BY_HAND, rtol=AS_TYPED, atol=0).any() and text != "π"
    }
    return [*known, *(text for text, value in found.items() if value == 30 and "π" in found)]


def _numbers(node: object) -> Iterator[tuple[str, float]]:
    """Each number of a formula, and each product, quotient and power of numbers alone, with its value."""
    match node:
        case Node("num", (text,)):
            yield text, float(text)
        case Node("sym", ("π",)):
            yield "π", np.pi
        case Node(op, parts):
            if op in APPLY and all(each.op in APPLY or each.op == "num" or each == PI for each in walk(node)):
                value = float(evaluate(node, lambda leaf: leaf))
                yield f"{value:.7g}", value
            for part in parts[:1] if op == "^" else parts:  # an exponent has no unit
                yield from _numbers(part)
        case tuple():
            for part in node:
                yield from _numbers(part)


def _idle_chapters(mechanism: Mechanism) -> Iterator[str]:
    """Chapters of numbers alone that no check, key result, figure, file or other chapter takes, nor plain code by its name."""
    declared = (mechanism.checks, mechanism.key_results, mechanism.figures, mechanism.exports)
    if not any(declared):
        return
    asked = {name for part in declared for name in named_in(part)}
    asked |= {name for comparison in mechanism.comparisons for _, name in comparison.takes.values()}
    written = Counter(
        node.value for file in own_files(mechanism) for node in ast.walk(parsed(file))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    )  # fmt: skip
    for chapter in mechanism.chapters:
        if chapter.steps and all(isinstance(step, Value) for step in chapter.steps):
            others = (step for other in mechanism.chapters if other is not chapter for step in other.steps)
            used = asked.union(*({*taken(step), *named_in(step)} for step in others))
            if not any(step.id in used or written[step.id] > 1 for step in chapter.steps):
                template = (
                    "{place}: chapter {title}: no check, key result, figure or other chapter uses its results; name its result in "
                    "key_results, or check it"
                )
                yield Phrase(template, place=short(chapter.at), title=repr(chapter.title))


# Dimensions of what a mechanism declares: its formulas are gone through with the kinds of what they take.


# The kind of what a formula gives, found from the kinds of what it takes: its expression is gone through, nothing is computed.
#
# A kind is the exponents of ``units.DIMENSIONS``, and the plane angle is one of them: rad/s is not 1/s. π is an angle, half a turn.
# Sine, cosine and tangent take angles, their inverses give them. The radian drops by itself in one place, **beside a length**: an arc is
# radius times angle, a speed radius times angular speed, N·m the same as kg·m²·rad/s². Two kinds that differ by the angle alone are
# alike where they have a length. Everywhere else the formula says it, by ``as_number`` or ``as_angle``.


ANY = None  # the kind of zero, which is alike to all
NUMBER: Kind = unit("1").kind
ANGLE: Kind = unit("rad").kind
Found = Kind | None
ANGLE_AT = DIMENSIONS.index("angle")
TEXT_LENGTH = 60


class KindError(ValueError):
    """Report a formula that equals, adds or takes quantities of unlike kinds; the text says which, where in the formula."""


def alike(one: Found, other: Found) -> bool:
    """Return whether two kinds may be equalled: they are the same, or differ by the angle alone beside a length."""
    return one is None or other is None or kinds_alike(one, other)


def kind_text(kind: Found) -> str:
    """Return the coherent SI unit of a kind, in words for the pure number."""
    return phrase("zero") if kind is None else phrase("a pure number") if kind == NUMBER else si_text(kind)


def angle_hint(found: Found, wanted: Found, part: str = "…") -> str:
    """Return what to write where two kinds differ by the angle alone: in words that follow what is wrong; empty where they do not."""
    if found is None or wanted is None or found == wanted or _turned(found, 0) != _turned(wanted, 0):
        return ""
    match wanted[ANGLE_AT]:
        case 1:
            return Phrase("; if that counts radians, write {call}", call=f"as_angle({part})")
        case 0:
            return Phrase("; if the number of radians is meant, write {call}", call=f"as_number({part})")
    return ""


def kind_given(formula: Formula, taken: Mapping[str, Found | float]) -> Found:
    """Return the kind of what a formula gives for the kinds (or plain numbers) that its parameters take; KindError where it has none."""
    constants = {symbol: unit(constant.unit).kind for symbol, constant in formula.constants.items()}
    kinds = {name: _plain(value) if isinstance(value, float) else value for name, value in taken.items()}
    return _Walk(constants | kinds).kind(formula.full_tree)


def _plain(value: float) -> Found:
    return NUMBER if value and math.isfinite(value) else ANY


def _turned(kind: Kind, power: float) -> Kind:
    return (*kind[:ANGLE_AT], power, *kind[ANGLE_AT + 1 :])


class _Walk:
    """Goes through one expression with what its symbols stand for."""

    def __init__(self, known: Mapping[str, Found]) -> None:
        self.known = known

    def kind(self, node: Node) -> Found:
        match node:
            case Node("num", (text,)):
                return _plain(float(text))
            case Node("sym", (name,)):
                return ANGLE if name == "π" else self.known[name]
            case Node("call", (name, *args)):
                return self._call(node, str(name), *args)
            case Node("cmp", (_, left, right)):
                self._common(node, left, right)
                return NUMBER
            case Node("cases", branches):
                for _, condition in (branch for branch in branches if len(branch) == 2):
                    self.kind(condition)
                return self._common(node, *(branch[0] for branch in branches))
        return self._operation(node)

    def _operation(self, node: Node) -> Found:
        match node:
            case Node("+" | "-", (left, right)):
                return self._common(node, left, right)
            case Node("*" | "/" as sign, (left, right)):
                return times(self.kind(left), self.kind(right), 1 if sign == "*" else -1)
            case Node("^", (base, exponent)):
                return self._power(base, exponent)
            case Node("neg", (inner,)):
                return self.kind(inner)
        for part in node.args:  # and, or, not
            self.kind(part)
        return NUMBER

    def _power(self, base: Node, exponent: Node) -> Found:
        if symbols(exponent):
            return self._needed(NUMBER, base) and self._needed(NUMBER, exponent)
        return times(NUMBER, self.kind(base), float(evaluate(exponent, dict[Node, float]().__getitem__)))

    def _call(self, node: Node, name: str, *args: Node) -> Found:
        match name:
            case "sin" | "cos" | "tan":
                return self._needed(ANGLE, *args) and NUMBER
            case "arcsin" | "arccos" | "arctan":
                return self._needed(NUMBER, *args) and ANGLE
            case _ if name in OF_NUMBERS:
                return self._needed(NUMBER, *args)
            case "arctan2":
                self._common(node, *args)
                return ANGLE
            case "minimum" | "maximum":
                return self._common(node, *args)
            case "sqrt":
                return times(NUMBER, self.kind(args[0]), 0.5)
        inner = self.kind(args[0])
        return NUMBER if name == "sign" else self._said(node, inner, SAID[name]) if name in SAID else inner

    def _said(self, node: Node, inner: Found, power: int) -> Found:
        """What is said to be a number or an angle; KindError where it is that already."""
        if inner is None or inner[ANGLE_AT] == power:
            template = "{part} says that rad {text}, but {inner} is {kind} already"
            filling = {"part": _shortened(node), "text": phrase("comes in") if power else phrase("drops")}
            raise KindError(Phrase(template, filling, inner=_shortened(node.args[1]), kind=kind_text(inner)))
        return _turned(inner, power)

    def _needed(self, kind: Kind, argument: Node) -> Kind:
        found, part = self.kind(argument), _shortened(argument)
        if found not in (ANY, kind):
            template = "{part} is {kind}, {wanted} is needed"
            wrong = Phrase(template, part=part, kind=kind_text(found), wanted=kind_text(kind))
            raise KindError(wrong + angle_hint(found, kind, part))
        return kind

    def _common(self, node: Node, *parts: Node) -> Found:
        """The kind of what is added, compared or chosen from; beside a length without the radian where one has none."""
        first, *others = parts
        common = self.kind(first)
        for part in others:
            found = self.kind(part)
            if not alike(common, found):
                one, other = _shortened(first), _shortened(part)
                kinds = {"kind": kind_text(common), "other_kind": kind_text(found)}
                template = "{part} brings together {kind} ({one}) and {other_kind} ({other})"
                hint = angle_hint(found, common, other) or angle_hint(common, found, one)
                raise KindError(Phrase(template, kinds, part=_shortened(node), one=one, other=other) + hint)
            common = found if common is None else common if found in (ANY, common) else _turned(common, 0)
        return common


SAID = {AS_NUMBER: 0, AS_ANGLE: 1}
OF_NUMBERS = {"exp", "log", "log10", "ceil", "floor", "round", "sinh", "cosh", "tanh", "arcsinh", "arccosh", "arctanh"}


def _shortened(node: Node) -> str:
    text = written(node)
    return text if len(text) <= TEXT_LENGTH else text[: TEXT_LENGTH - 1] + "…"


def formulas(mechanism: Mechanism) -> Iterator[tuple[Step, StepFormula, Formula]]:
    """Yield every bound formula with its step and its part in it; of a choice by a text all of them."""
    for _, step in mechanism.steps:
        yield from ((step, each, formula) for each in step.formulas() for formula in each.options)


def units_of(mechanism: Mechanism) -> dict[str, str]:
    """Return the SI unit of each id of numbers, inputs and steps."""
    found = {name: unit(meta.unit).si for name, meta in fields(mechanism.inputs) if hasattr(meta, "unit")}
    found |= {f"inputs.{name}": si for name, si in found.items()}
    for _, step in mechanism.steps:
        if not isinstance(step, SilentStep):
            found[step.id] = unit(step.unit).si
    axis_of = axes(tuple(step for _, step in mechanism.steps), mechanism.inputs)
    for _, step in mechanism.steps:
        for each in names_ahead(step):
            of_place = found[axis_of[step.asked_curve]] if each.role == "place" else ""
            found.setdefault(each.name, {"count": "1", "place": of_place}.get(each.role, found[step.id]))
    return found


def dimensions(mechanism: Mechanism) -> Iterator[str]:
    """Yield formulas whose dimensions do not balance, or do not give what their step declares."""
    units = units_of(mechanism)
    for step, part, formula in formulas(mechanism):
        try:
            given = _given(formula, units)
        except KindError as error:
            yield f"{step.id}: {_told(step, formula)}: {error}"
            continue
        wanted = unit(step.unit).si
        if part.is_of_unit and not alike(given, unit(wanted).kind):
            filling = {"id": step.id, "name": _told(step, formula), "given": kind_text(given), "wanted": wanted}
            yield Phrase("{id}: {name} gives {given}, declared is {wanted}", filling) + angle_hint(
                given, unit(wanted).kind
            )


def _told(step: Step, formula: Formula) -> str:
    """A formula in words: by its name, or as the step's where it has no name of its own."""
    return phrase("its formula") if formula.__name__ == step.id else formula.__name__


def curve_units(mechanism: Mechanism) -> Iterator[str]:
    """Yield curves and what is laid over an abscissa, in other units than what they are made of has."""
    units = units_of(mechanism)
    axis_of = axes(tuple(step for _, step in mechanism.steps), mechanism.inputs)

    def of(name: str) -> Kind:
        return unit(units[name]).kind

    for _, step in mechanism.steps:
        for name, made, wanted in step.dimensions(of, axis_of.__getitem__):
            if not alike(made, wanted):
                filling = {"id": step.id, "name": name, "given": kind_text(made), "wanted": kind_text(wanted)}
                yield Phrase("{id}: {name} gives {given}, declared is {wanted}", filling)


def relations(mechanism: Mechanism) -> Iterator[str]:
    """Yield roots and self-tests that are proved by a relation between quantities of unlike dimensions."""
    units = units_of(mechanism)
    sides: dict[str, list[Found]] = {}
    for step, part, formula in formulas(mechanism):
        if part.part in ("left", "right", "scale"):
            sides.setdefault(step.id, []).append(_given(formula, units))
    for name, (one, *others) in sides.items():
        for other in (each for each in others if not alike(one, each)):
            template = "{name}: the relation equals {one} with {other}"
            yield Phrase(template, name=name, one=kind_text(one), other=kind_text(other))


def _given(formula: Formula, units: dict[str, str]) -> Found:
    return kind_given(formula, {name: unit(units[name]).kind for name in formula.parameters})


# Where a mechanism declares what a fault is told of.


def at_place(mechanism: Mechanism, name: str, text: str, place: str = "") -> str:
    """Return a text with the file and the line (or the ``place``) that declare a quantity, check or figure, and its name."""
    place = place or next((each.at for each in declared_in(mechanism) if getattr(each, "id", "") == name), "")
    if not place:
        with suppress(KeyError, AttributeError, TypeError):  # it is not an input
            place = of_input(mechanism.inputs, name, mechanism.at)
    place = place or mechanism.at
    return Phrase("{place}: {name}: {text}", place=short(place), name=name, text=text)


def by_id(mechanism: Mechanism, text: str) -> str:
    """Return a text of the form ``ID: what is wrong`` with the place of the id."""
    subject, _, rest = text.partition(": ")
    name = subject.partition(" ")[0]
    return text if ".py:" in subject else at_place(mechanism, name, rest or text)
