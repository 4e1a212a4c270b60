"""Checks: their sides are numbers, rows or curves that something gives, of one kind of unit, and what is said of them is known."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Collection, Iterable, Iterator
from functools import lru_cache, reduce
from itertools import pairwise, product
from pathlib import Path
from typing import Any, NamedTuple

from diecut_report.declaration.formulas import lacking, pairs
from diecut_report.declaration.inputs import allowed_wrong, fault_of
from diecut_report.declaration.names import DeclaredNames, Fault, Giver, fault, short, unknown, where
from diecut_report.declaration.texts import SAID, files_around, not_an_input, own_files, parsed
from diecut_report.errors import nearest
from diecut_report.formulas.expression import FormulaError
from diecut_report.formulas.tree import Node, substitute, symbols
from diecut_report.mechanism.chapters import MISSING, taken
from diecut_report.mechanism.checks import Check, Vary
from diecut_report.mechanism.inputs import Key, Quantity, keys
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import ByText, When, formula_of
from diecut_report.mechanism.steps import Require, ResultName, Step, Value, has_own_names, names_ahead, read
from diecut_report.mechanism.steps.from_curve import CurveOverAbscissa
from diecut_report.mechanism.steps.require import Obstacle
from diecut_report.mechanism.steps.table_steps import unlike_units
from diecut_report.quantities.formatting import NAMED
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import StandardSeries
from diecut_report.text.phrases import Phrase, named, phrase

# Checks that cannot fail, or cannot hold: both sides are one expression, or neither depends on an input.


NEUTRAL = {"+": 0.0, "*": 1.0}
ZERO, ONE = Node("num", ("0.0",)), Node("num", ("1.0",))
DEEP = 40  # formulas within formulas, of which a declaration may have a circle that is reported elsewhere


def empty(names: DeclaredNames, check: Check) -> Iterator[str]:
    """Yield what is wrong with the sides of a check.

    Where inputs decide which formula gives a side, one of them may bound the other: a size that is chosen, a count that is not
    left out. A check is refused where none of its forms can turn out otherwise.
    """
    for one, other in check.pairs:
        found = [_empty(*sides) for sides in product(_ways(names, one), _ways(names, other))]
        if all(found):
            first, second = (side if isinstance(side, str) else f"{side:g}" for side in (one, other))
            yield from (Phrase(text, one=first, other=second) for text in dict.fromkeys(found))


def _empty(demand: Node, limit: Node) -> str:
    """Return why two expressions are no check; nothing where they are one."""
    demand, limit = _ordered(demand), _ordered(limit)
    if demand == limit:
        return phrase("compares {one} with {other}, which is the same expression: it can never fail")
    if not symbols(demand) and not symbols(limit):
        template = "compares {one} with {other}, neither of which depends on an input: its verdict is always the same"
        return phrase(template)
    if limit in _arguments(demand, "minimum") or demand in _arguments(limit, "maximum"):
        return phrase("compares {one} with {other}, by which it is bounded itself: it can never fail")
    return ""


def _ordered(part: Any) -> Any:
    """An expression with the parts of its sums and products in one order, without those that change nothing or cancel."""
    if not isinstance(part, tuple):
        return part
    if not isinstance(part, Node):
        return tuple(map(_ordered, part))
    parts = [_ordered(each) for each in part.args]
    neutral = NEUTRAL.get(part.op)
    if neutral is None:
        return _cancelled(Node(part.op, tuple(parts)))
    if part.op == "*" and ZERO in parts:
        return ZERO
    flat = [each for own in parts for each in (own.args if own.op == part.op else (own,))]
    kept = sorted((each for each in flat if each.op != "num" or float(each.args[0]) != neutral), key=repr)
    return kept[0] if len(kept) == 1 else Node(part.op, tuple(kept))


def _cancelled(node: Node) -> Node:
    """A difference or quotient of equal expressions as the number that it is, and what is zero of such a difference."""
    match node:
        case Node("-" | "/" as sign, (one, other)) if one == other:
            return ZERO if sign == "-" else ONE
        case Node("/", (first, *_)) | Node("neg", (first,)) if first == ZERO:
            return ZERO
        case Node("call", ("abs" | "sqrt", argument)) if argument == ZERO:
            return ZERO
    return node


def _ways(names: DeclaredNames, side: str | float) -> list[Node]:
    if not isinstance(side, str):
        return [Node("num", (repr(float(side)),))]
    return list(dict.fromkeys(_expanded(names, side, giver, DEEP) for giver in names.givers(side)))


def _expanded(names: DeclaredNames, name: str, giver: Giver, deep: int) -> Node:
    step = giver.step
    if not isinstance(step, Value) or isinstance(step.formula, ByText) or not deep:
        return Node("sym", (name,))
    formula = formula_of(step.formula)
    try:
        tree = formula.tree
    except FormulaError:  # which is reported as a fault of the formula
        return Node("sym", (name,))
    return substitute(tree, {name: _part(names, name, deep - 1) for name in formula.parameters})


def _part(names: DeclaredNames, taken: str, deep: int) -> Node:
    """What a formula takes; a name that several steps give stands for itself."""
    givers = names.givers(taken)
    return _expanded(names, taken, givers[0], deep) if len(givers) == 1 else Node("sym", (taken,))


def _arguments(node: Node, name: str) -> Iterator[Node]:
    for part in node.args[1:] if node.op == "call" and node.args[0] == name else ():
        yield part
        yield from _arguments(part, name)


# Texts: each ``{id}`` in a message names something that can be printed there, and no other text holds one.


BRACE = re.compile(r"\{[^{}]*\}?|\}")  # what looks as if it were filled in


def messages_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the messages that name what cannot be printed, keys of no input, and texts that nothing fills in."""
    for number, (step, when) in enumerate(names.steps):
        if isinstance(step, Obstacle):
            for text in unprintable(names, step.message, when, step.message_places, number):
                yield fault(step, Phrase("the message names {text}", text=text))
            yield from (fault(step, text) for text in _key(names, step.key))
    yield from _unfilled(names.mechanism)


def unprintable(
    names: DeclaredNames, text: str, when: When, parts: Collection[str], before: int | None = None
) -> Iterator[str]:
    """Yield what is wrong with the ``{ids}`` of a message that is told (before a step) when something is made."""
    for left in BRACE.findall(NAMED.sub("", text)):
        words = "{left}: write {plain}, {up} or {down}; nothing else is filled in"
        yield Phrase(words, left=left, plain="{id}", up="{id:up}", down="{id:down}")
    for name in dict.fromkeys(found[1] for found in NAMED.finditer(text)):
        if name in parts:
            continue
        braced = f"{{{name}}}"
        makers = [g for g in names.givers(name) if g.step and g.step.is_made_late]
        words = lacking(names, name, when, None if makers else before)
        if not words and "curve" in names.kinds(name) | {k.replace("curve input", "curve") for k in names.kinds(name)}:
            words = Phrase("{name}, a curve, which has no single number; name an extreme or a mean of it", name=braced)
        if words:
            yield words
            continue
        for maker in makers:  # a text is made where a message asks for it, of what is known then
            of = (lacking(names, taken, when.with_(maker.when), before) for taken in getattr(maker.step, "takes", ()))
            yield from (Phrase("{name}, which takes {said}", name=braced, said=said) for said in of if said)


def _key(names: DeclaredNames, key: str) -> Iterator[str]:
    """What is wrong with the key of an input that a message stands at."""
    parts = [part for part in key.split(".") if not part.isdigit() and not NAMED.fullmatch(part)]
    path, keys = ".".join(parts), names.world.keys
    if path not in keys:
        template = "the key {key} is not an input{nearest}; name the input that is to be changed"
        yield Phrase(template, key=repr(key), nearest=nearest(path, keys))


def _unfilled(mechanism: Mechanism) -> Iterator[Fault]:
    """Texts with ``{id}`` that are printed as they stand."""
    template = "{braced} stands in braces in {field}, where nothing is filled in; write it without, or say it in a message or consequence"
    for declared in (
        *mechanism.chapters,
        *(step for _, step in mechanism.steps),
        *mechanism.checks,
        *mechanism.figures,
    ):
        plain = [(field, getattr(declared, field, "")) for field in PLAIN]
        plain += [(phrase("the words of a case"), case.words) for case in getattr(declared, "cases", ())]
        for field, text in plain:
            if found := NAMED.search(text.replace(MISSING, "") if field == "absent" else text):
                yield fault(declared, Phrase(template, braced=found[0], field=field))


PLAIN = sorted(SAID - {"message", "consequence", "words"})  # in which nothing is filled in
JUDGED = ("number", "row", "curve")
OF_PARTS = ("part", "next", "index")


def faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the checks."""
    made = [(check, when) for check in names.mechanism.checks for when in _when(names, check)]
    yield from pairs(names, phrase("another check"), made)
    for check in names.mechanism.checks:
        yield from (fault(check, text) for text in _wrong(names, check))


def _when(names: DeclaredNames, check: Check) -> list[When]:
    """When a check is made: what it needs is given, and something gives each of its sides."""
    own = When(frozenset((*check.needs, *check.only_with)))
    givers = [[giver.when for giver in names.givers(name)] for name in check.named]
    found = dict.fromkeys(reduce(When.with_, chosen, own) for chosen in product(*givers))
    return [when for when in found if names.world.example(when) is not None]


def _wrong(names: DeclaredNames, check: Check) -> Iterator[str]:
    sides = {name: names.givers(name) for name in check.named}
    numbers = [each for pair in check.pairs for each in pair if not isinstance(each, str)]
    if endless := [each for each in (*numbers, check.fails_beyond or 0) if not math.isfinite(each)]:
        template = "compares {number}, which is not a finite number, so that nothing would be checked; write the limit, or its id"
        yield Phrase(template, number=repr(endless[0]))
        return
    for key in (each for each in check.only_with if each in (check.limit, check.at_least)):
        template = (
            "has the limit {key} and names it in only_with, so that the check vanishes where it is not given; take it out of "
            "only_with: the check is then reported as not checked"
        )
        yield Phrase(template, key=key)
    if not sides:
        yield phrase("compares plain numbers only; one side at least must be the id of a quantity")
        return
    for name, givers in sides.items():
        if not givers:
            yield Phrase("takes {unknown}", unknown=unknown(name, names.known))
        for kind in sorted({giver.kind for giver in givers} - set(JUDGED)):
            yield Phrase("compares {name}, {instead}", name=name, instead=_instead(name, kind))
        units = {each for giver in givers if giver.kind in JUDGED for each in _units(names, giver, check)}
        wrong = sorted(each for each in units if check.unit and unit(each).kind != unit(check.unit).kind)
        if wrong:
            yield Phrase("is in {unit}, {name} in {wrong}", unit=check.unit, name=name, wrong=", ".join(wrong))
    if not all(sides.values()):
        return
    if all(giver.kind in JUDGED for givers in sides.values() for giver in givers):
        yield from _unsaid(check)
    axes = {giver.axis for givers in sides.values() for giver in givers if giver.axis}
    if len(axes) > 1:
        template = "compares what runs over {axes}; compare numbers, or curves over one abscissa"
        yield Phrase(template, axes=named(sorted(axes), " with what runs over "))
    yield from empty(names, check)
    yield from _names_of_parts(names, check)
    made = _when(names, check)
    if not made:
        yield phrase("is never performed: what it needs and what it compares are never given together")
    parts = OF_PARTS if any(names.kinds(name) == {"row"} for name in sides) else ()
    wrong_names = (text for when in made for text in unprintable(names, check.consequence, when, parts))
    yield from dict.fromkeys(Phrase("the consequence names {text}", text=text) for text in wrong_names)


def _unsaid(check: Check) -> Iterator[str]:
    """What its author left out, and nothing that it compares tells."""
    for field in ("unit", "demand_label", "limit_label"):
        if not getattr(check, field):
            template = "has no {field}, and none follows from what it compares; write {field}="
            yield Phrase(template, field=field)


def _names_of_parts(names: DeclaredNames, check: Check) -> Iterator[str]:
    """What is wrong with the part that is judged alone, and with the names of parts, each of which is to have a check of its own."""
    is_row = any(giver.kind == "row" for name in check.named for giver in names.givers(name))
    if check.index is not None and not is_row:
        template = "is of part index={index} alone, but compares no row over repeated parts; leave index out"
        yield Phrase(template, index=repr(check.index))
    if not check.named_by:
        return
    if not is_row:
        template = "is one check for each of {named_by}, but compares no row over repeated parts; leave named_by out"
        yield Phrase(template, named_by=check.named_by)
    elif check.named_by not in names.world.keys or names.kinds(check.named_by) - {"text"}:
        template = "is one check for each of {named_by}, which is not a text of repeated parts"
        yield Phrase(template, named_by=check.named_by)


def _units(names: DeclaredNames, giver: Giver, check: Check) -> set[str]:
    needs = (*check.needs, *check.only_with)
    beside = {unit for key, unit in giver.units if names.world.example(When(frozenset((*needs, key)))) is None}
    return giver.units_when(needs) - (beside - {giver.unit})


def _instead(name: str, kind: str) -> str:
    template = "places that may be none or many; compare {name}_count, or one of them as {name}_1"
    return {
        "text": phrase("a text; compare a number"),
        "abscissa": phrase("an abscissa, which takes all its values; compare a curve over it"),
        "crossings": Phrase(template, name=name),
        "curve input": phrase("a curve input; take it over by FromCurve and compare that curve"),
        "block": phrase("a block; compare one of its inputs"),
    }[kind]


# Chapters and families of steps that a plugin's file declares, and that no mechanism holds: they would be left out in silence.


CALLS = ("Chapter", "Steps")


class Defined(NamedTuple):
    """A chapter or a family of steps that a file defines under a name, in some of its lines."""

    name: str
    call: ast.Call
    line: int
    until: float  # the line that gives the name to another one


def idle_chapters_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the chapters and families that are filled, and then named nowhere."""
    for file in own_files(names.mechanism):
        for defined in _definitions(parsed(file)):
            own = [s for s in parsed(file).body if defined.line < s.lineno < defined.until]
            if any(_fills(s, defined.name) for s in own) and not _is_named(names.mechanism, file, defined, own):
                yield _fault(file, defined)


def _fault(file: Path, defined: Defined) -> Fault:
    place, name = f"{file}:{defined.line}", defined.name
    lost = phrase("so that its steps are never calculated")
    if _called(defined.call) != "Chapter":
        text = Phrase("is added to no chapter, {lost}; write chapter.add({name})", lost=lost, name=name)
        return Fault(place, Phrase("steps {name}", name=name), text)
    title = defined.call.args[0] if defined.call.args else None
    subject = Phrase("chapter {title}", title=ast.unparse(title) if title else name)
    instead = Phrase("name {name} in chapters=(…) of the Mechanism", name=name)
    if defined.until != float("inf"):
        template = "line {until} calls another one {name}: give one of them another name, and name both in chapters=(…)"
        instead = Phrase(template, until=defined.until, name=name)
    return Fault(place, subject, Phrase("is in no mechanism, {lost}; {instead}", lost=lost, instead=instead))


def _definitions(tree: ast.Module) -> Iterator[Defined]:
    """What the statements of a file itself define; what functions and loops make may go anywhere."""
    found: dict[str, list[tuple[int, ast.Call]]] = {}
    for statement in tree.body:
        match statement:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Call() as call) if _called(call) in CALLS:
                found.setdefault(name, []).append((statement.lineno, call))
    for name, several in found.items():
        for (line, call), (until, _) in pairwise([*several, (float("inf"), several[-1][1])]):
            yield Defined(name, call, int(line), until)


def _called(call: ast.Call) -> str:
    return getattr(call.func, "id", getattr(call.func, "attr", ""))


def _fills(statement: ast.stmt, name: str) -> bool:
    match statement:
        case ast.Expr(value=ast.Call(func=ast.Attribute(value=ast.Name(id=head)))):
            return head == name
        case ast.Assign(targets=[ast.Attribute(value=ast.Name(id=head)) | ast.Subscript(value=ast.Name(id=head))]):
            return head == name
    return False


def _is_named(mechanism: Mechanism, file: Path, defined: Defined, own: list[ast.stmt]) -> bool:
    """Whether anything else is said of it, in its own statements of the file or elsewhere, than what is declared in it."""
    if any(_may_name(s, defined.name) and _names(s, defined.name) > _fills(s, defined.name) for s in own):
        return True
    others = [each for each in files_around(mechanism) if each != file] if defined.until == float("inf") else []
    return any(_may_name(s, defined.name) and _names(s, defined.name) for each in others for s in parsed(each).body)


def _may_name(statement: ast.stmt, name: str) -> bool:
    return not _words(statement).isdisjoint((name, "*"))


@lru_cache(maxsize=1024)
def _words(statement: ast.AST) -> frozenset[str]:
    words = {getattr(node, key, None) for node in ast.walk(statement) for key in ("id", "attr", "name", "value")}
    return frozenset(word for word in words if isinstance(word, str))


def _names(node: ast.AST, name: str) -> int:
    """How often a name stands in it: as such, of a module, imported, or in ``__all__``; not as the parameter of a function."""
    match node:
        case ast.Lambda(args=args) | ast.FunctionDef(args=args) if any(
            name == each.arg for each in ast.walk(args) if isinstance(each, ast.arg)
        ):
            return 0
        case ast.Attribute(value=ast.Name(id="m")):  # a quantity of this id
            return 0
        case ast.Attribute(value=filled, ctx=ast.Store()):
            return _names(filled, name)
        case ast.Assign(targets=[ast.Name(id="__all__")]):
            return sum(getattr(each, "value", None) == name for each in ast.walk(node))
    own = name in (getattr(node, "id", None), getattr(node, "attr", None))
    imported = isinstance(node, ast.alias) and node.name in (name, "*")
    return own + imported + sum(_names(each, name) for each in ast.iter_child_nodes(node))


# Names of two things: a step that hides an input, or a name that the engine makes itself, as the place of an extreme.


MADE = {
    "place": phrase("the place of its extreme"),
    "count": phrase("the number of its crossings"),
    "crossing": phrase("one of its crossings"),
    "part": phrase("one of its parts"),
}


def shared_names_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the steps that hide an input whose value nothing takes then, and names that the engine makes of another step."""
    inputs = keys(names.mechanism.inputs)
    for number, (step, when) in enumerate(names.steps):
        if step.id in inputs and step.is_taken:
            yield from _hidden(names, step, when, inputs[step.id])
        for name, place, other in _made_otherwise(names, number, step):
            yield from _made_twice(names, step, name, place, when.with_(other))


def _hidden(names: DeclaredNames, step: Step, when: When, key: Key) -> Iterator[Fault]:
    """The step that has the id of an input, where that is given and no step or check takes ``inputs.ID``, or refuses it."""
    when = when.with_(When(frozenset((key.path,)) if key.may_be_absent else frozenset()))
    given = names.world.example(when, list(_takers(names, key.path)))
    if given is not None:
        template = (
            "has the id of an input, so that what the user gives for {id} counts nowhere{where}; name the step otherwise, "
            'or let a formula take the input as "inputs.{id}"'
        )
        yield fault(step, Phrase(template, id=step.id, where=where(given, when.needs | when.lacks)))


def _takers(names: DeclaredNames, path: str) -> Iterator[When]:
    """When something takes an input itself, not the step of its id."""
    for step, when in names.steps:
        own = {getattr(step, "given", "")} | ({step.id} if isinstance(step, CurveOverAbscissa) else set())
        own |= {name.removeprefix("inputs.") for name in getattr(step, "holds", ()) if name.startswith("inputs.")}
        refuses = isinstance(step, Require) and step.key == path and path in step.needs
        if f"inputs.{path}" in taken(step) or path in own or refuses:
            yield when
    for check in names.mechanism.checks:
        if f"inputs.{path}" in check.named:
            yield When(frozenset((*check.needs, *check.only_with)))


def _made_otherwise(names: DeclaredNames, number: int, step: Step) -> Iterator[tuple[ResultName, str, When]]:
    """The names that the engine makes of a step, each with the place and the condition of what is declared under it."""
    made = {each.name: each for each in names_ahead(step) if each.role != "value"}
    if not made:
        return
    for name in sorted(made.keys() & names.world.keys.keys()):
        key = names.world.keys[name]
        yield made[name], "", When(frozenset((key.path,)) if key.may_be_absent else frozenset())
    for other, (declared, when) in enumerate(names.steps):
        if declared is step or not declared.is_taken:
            continue
        if declared.id in made:
            yield made[declared.id], declared.at, when
        elif other < number:
            yield from ((made[name], declared.at, when) for name in _both_make(made, declared))


def _both_make(made: dict[str, ResultName], other: Step) -> list[str]:
    if has_own_names(other):
        return [name for name in made if (found := read(name, other)) and found.role != "value"][:1]
    return [each.name for each in names_ahead(other) if each.role != "value" and each.name in made][:1]


def _made_twice(names: DeclaredNames, step: Step, made: ResultName, place: str, both: When) -> Iterator[Fault]:
    if names.world.example(both) is None:
        return
    what = Phrase("that of another step (at {place})", place=short(place)) if place else phrase("that of an input")
    template = "gives {name} as {made}, and this name is {what}; name one of them otherwise"
    yield fault(step, Phrase(template, name=made.name, made=MADE[made.role], what=what))


# Advice: the inputs that it names can be changed, to values that they may have, and what is judged follows from them.


def advice_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the advice of conditions and checks."""
    for section, step in names.mechanism.steps:
        if isinstance(step, Require):
            judged = (*taken(step), *step.needs, *section.needs)
            yield from (fault(step, text) for text in _wrong_advice(names, step, judged))
    for check in names.mechanism.checks:
        judged = (*check.named, *check.needs, *check.only_with, *check.founded)
        yield from (fault(check, text) for text in _wrong_advice(names, check, judged))


def _wrong_advice(names: DeclaredNames, owner: Check | Require, judged: Iterable[str]) -> Iterator[str]:
    """What is wrong with the ways that a check or a condition advises; ``judged`` are the names on which its verdict rests."""
    advise: Any = owner.advise  # as an author wrote it
    if not isinstance(advise, tuple):
        if not isinstance(advise, str):  # which is told where words are
            template = "has advise={given}; write a tuple of ways, with a comma behind a single one"
            yield Phrase(template, given=repr(advise))
        return
    behind = _behind(names, judged) if all(map(names.givers, judged)) else None
    for way in advise:
        keys = (way.key,) if isinstance(way, Vary) else (way,) if isinstance(way, str) else way
        if not keys or not isinstance(keys, tuple) or not all(isinstance(key, str) for key in keys):
            template = "advise holds {way}; write the key of an input, Vary(key, …), or a tuple of keys that are changed together"
            yield Phrase(template, way=repr(way))
            continue
        found = [text for key in keys if (text := _not_changed(names, key, keys, behind))]
        yield from (Phrase("{field} names {text}", field="advise", text=text) for text in found)
        if isinstance(way, Vary) and not found:
            yield from _vary(names, way)


def _behind(names: DeclaredNames, judged: Iterable[str]) -> set[str]:
    """The inputs from which something follows: by what is taken, and by what switches steps on and off."""
    found: set[str] = set()
    pending = list(judged)
    while pending:
        name = pending.pop().removeprefix("inputs.").partition("=")[0]
        if name not in found:
            found.add(name)
            for giver in names.givers(name):
                pending += [*giver.when.needs, *giver.when.lacks]
                if step := giver.step:
                    pending += [*taken(step), *getattr(step, "holds", ())]
                    pending += [each.formula.key for each in step.formulas() if isinstance(each.formula, ByText)]
    return found


def _not_changed(names: DeclaredNames, key: str, together: tuple[str, ...], behind: set[str] | None) -> str:
    """Why nothing can be advised on a key; empty where something can."""
    known = names.world.keys.get(key)
    if known is None or key in names.mechanism.facts:
        return not_an_input(names, key)
    if not isinstance(known.meta, Quantity) and not known.texts:
        return Phrase("{key}, which is neither a number nor a text with allowed values", key=key)
    if not isinstance(known.meta, Quantity) and known.home:
        return Phrase("{token}, but each part of {home} has a text of its own", token=key, home=known.home)
    if not isinstance(known.meta, Quantity) and len(together) > 1:
        others = named([each for each in together if each != key], " and ")
        return Phrase("{key} together with {others}, but texts are changed each by itself", key=key, others=others)
    if behind is not None and key not in behind:
        return Phrase("{key}, on which its verdict does not depend; name an input that changes it", key=key)
    return ""


def _vary(names: DeclaredNames, way: Vary) -> Iterator[str]:
    """What is wrong with the direction and the series of a key."""
    known = names.world.keys[way.key]
    series: Any = way.series
    wrong = list(allowed_wrong(way))
    if not wrong and isinstance(series, StandardSeries):
        title = Phrase("the series “{title}”", title=series.title)
        yield from unlike_units(title, series.unit, names.units(way.key), way.key)
    elif not wrong:
        template = "has {value} in its series{nearest}; allowed: {texts}"
        wrong += [
            Phrase(template, value=repr(text), nearest=nearest(str(text), known.texts), texts=", ".join(known.texts))
            for text in (series if known.texts else ()) if text not in known.texts
        ]  # fmt: skip
        wrong += () if known.texts else _numbers_wrong(known.meta, series)
    yield from (Phrase("the advice on {key} {text}", key=way.key, text=text) for text in wrong)


def _numbers_wrong(meta: Any, series: tuple[Any, ...]) -> Iterator[str]:
    for strange in [each for each in series if isinstance(each, bool) or not isinstance(each, int | float)][:1]:
        template = "has {value} in its series; write plain numbers, which count in its unit ({unit})"
        yield Phrase(template, value=repr(strange), unit=meta.unit)
        return
    for one, other in [pair for pair in pairwise(series) if pair[0] >= pair[1]][:1]:
        yield Phrase("has a series that does not ascend ({one} before {other}); put it in order", one=one, other=other)
    refused = [fault_of(meta, each) for each in series]
    if refused and all(refused):
        template = "has a series of which no value is allowed: {why}; its numbers count in {unit}"
        yield Phrase(template, why=refused[0], unit=meta.unit)
