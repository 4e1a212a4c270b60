"""Dimensions of what a mechanism declares: its formulas are gone through with the kinds of what they take."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress

from diecut_report.declaration.inputs import of_input
from diecut_report.declaration.names import declared_in, short
from diecut_report.formulas.conditions import alike as kinds_alike
from diecut_report.formulas.formula import Formula, evaluate
from diecut_report.formulas.tree import AS_ANGLE, AS_NUMBER, Node, symbols, written
from diecut_report.mechanism.inputs import fields
from diecut_report.mechanism.mechanism import Mechanism, axes
from diecut_report.mechanism.names import Bound
from diecut_report.mechanism.steps import SilentStep, Step, names_ahead
from diecut_report.mechanism.steps.protocols import StepFormula
from diecut_report.quantities.units import DIMENSIONS, Kind, si_text, times, unit
from diecut_report.text.phrases import Phrase, phrase

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


def formulas(mechanism: Mechanism) -> Iterator[tuple[Step, StepFormula, Bound]]:
    """Yield every bound formula with its step and its part in it; of a choice by a text all of them."""
    for _, step in mechanism.steps:
        yield from ((step, each, link) for each in step.formulas() for link in each.options)


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
    for step, part, link in formulas(mechanism):
        try:
            given = _given(link, units)
        except KindError as error:
            yield f"{step.id}: {link.formula.__name__}: {error}"
            continue
        wanted = unit(step.unit).si
        if part.is_of_unit and not alike(given, unit(wanted).kind):
            filling = {"id": step.id, "name": link.formula.__name__, "given": kind_text(given), "wanted": wanted}
            yield Phrase("{id}: {name} gives {given}, declared is {wanted}", filling) + angle_hint(
                given, unit(wanted).kind
            )


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
    """Yield roots that are proved by a relation between quantities of unlike dimensions."""
    units = units_of(mechanism)
    sides: dict[str, list[Found]] = {}
    for step, part, link in formulas(mechanism):
        if part.part in ("left", "right"):
            sides.setdefault(step.id, []).append(_given(link, units))
    for name, (a, b) in sides.items():
        if not alike(a, b):
            template = "{name}: the relation equals {one} with {other}"
            yield Phrase(template, name=name, one=kind_text(a), other=kind_text(b))


def _given(link: Bound, units: dict[str, str]) -> Found:
    taken = zip(link.names, link.takes, strict=True)
    kinds = {parameter: unit(units[name]).kind if isinstance(name, str) else name for parameter, name in taken}
    return kind_given(link.formula, kinds)


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
