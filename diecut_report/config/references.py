"""References ``${path}``: what each stands for, in which order the values follow, and every mistake in them.

Order and loops are judged by input: the nodes of the graph are single inputs and whole calculations. An input that refers
to another input waits for that input only; one that refers to an output waits for the calculation that gives it.
"""

from __future__ import annotations

import codecs
import copy
import hashlib
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType
from typing import Any

import yaml

from diecut_report.config.instances import Instance, Node, Slot, Target, Unresolved, default_of
from diecut_report.config.model import PRESS, texts
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.validation import ASSUMED, OF_ONE_VALUE, ConfigPlace, declared, value_at
from diecut_report.config.yaml import LOADER, KeyPath, Scalar, Tree, dotted, key_of, parse
from diecut_report.errors import Problem, UserError, nearest, seeming_latin
from diecut_report.formulas.condition_parts import Name, TypedExpression, read_expression
from diecut_report.formulas.conditions import ConditionError
from diecut_report.mechanism.curve_inputs import CurveInput, MechanismInput
from diecut_report.mechanism.inputs import Block, Meta, Quantity, Varying, fields
from diecut_report.mechanism.names import FromPress
from diecut_report.mechanism.steps import count_name, has_own_names, named, names_ahead
from diecut_report.quantities.units import UnitError, parse_quantity, pretty, unit
from diecut_report.text.phrases import Phrase, phrase

PHASES = "phases"
WHOLE = re.compile(r"\$\{([^${}]*)\}")


class _BrokenTerm(Exception):
    """Stand for an expression that refers to a mechanism whose plugin cannot be loaded."""

    def __init__(self, term: Target) -> None:
        super().__init__()
        self.term = term


class Linker:
    """Finds what every reference stands for; gathers links and problems. Broken mechanisms are None."""

    def __init__(self, instances: Mapping[str, Instance | None]) -> None:
        self.instances = instances
        self.links: dict[Node, Target] = {}
        self.unresolved: set[Node] = set()
        # by their texts: what is made of parts refers to the same again and again
        self._targets: dict[str, Target] = {}
        self._expressions: dict[str, tuple[TypedExpression, dict[str, Target]]] = {}
        self._asked: set[Node] = set()  # whose unit is just being looked for
        self.problems: list[Problem] = []
        known = [instance for instance in instances.values() if instance is not None]
        for instance in known:
            instance.leave_out(self._not_in_press(instance))
        for instance in known:
            self._written(instance)
            self._named(instance)
            self._from_press(instance)

    def _not_in_press(self, instance: Instance) -> Iterator[KeyPath]:
        press = self.instances[PRESS]
        known = press.given if press else frozenset()  # a config without a press has been reported already
        for slot in instance.slots:
            default = default_of(slot)
            if default and default.optional and default.path.removeprefix(f"{PRESS}.") not in known:
                yield slot.key

    def _written(self, instance: Instance) -> None:
        for key, text in texts(instance.data):
            if "${" not in text:
                continue
            node = (instance.name, *key)
            try:
                calculated = self._calculated(instance, key, text)
                self.links[node] = calculated or self._within_curve(instance, key, self.target(text))
            except (Unresolved, ConditionError) as fault:
                self.unresolved.add(node)
                place = fault.place if isinstance(fault, ConditionError) else None
                words = fault.words if isinstance(fault, ConditionError) else str(fault)
                self.problems.append(instance.place.problem(key, words, within=place))

    def _calculated(self, instance: Instance, key: KeyPath, text: str) -> Target | None:
        """What an expression stands for, in the unit of its key; None for a single reference, and a text around one."""
        meta = _wanted(instance, key)
        is_single = WHOLE.fullmatch(text.strip()) or not WHOLE.search(text)
        if is_single or not isinstance(meta, Quantity | CurveInput | None):
            return None
        if isinstance(meta, CurveInput) and declared(instance.model, key):
            template = "“{strip}” calculates a number; a curve is needed here, and is referred to whole"
            raise Unresolved(template, strip=text.strip())
        try:
            found, terms = self._expression(text)
        except _BrokenTerm as fault:
            return fault.term
        units = [meta.unit, getattr(meta, "or_unit", "")] if meta else []
        wanted = next((each for each in units if each and not found.refused(each)), None)
        if meta and wanted is None:
            raise Unresolved(str(found.refused(meta.unit)))
        si = unit(wanted).si if wanted else "1"
        return Target(found.text, "", unit=si, expression=found, terms=tuple(terms[name] for name in found.names))

    def _expression(self, text: str) -> tuple[TypedExpression, dict[str, Target]]:
        if (known := self._expressions.get(text)) and not self._asked:
            return known
        terms: dict[str, Target] = {}
        try:
            found = _read(text, tuple(self._term(f"${{{path.strip()}}}", terms) for path in WHOLE.findall(text)))
        except (ConditionError, _BrokenTerm):  # which the first in the order of reading tells, with its place
            terms.clear()
            found = read_expression(text, lambda name: self._term(name, terms))
        return (found, terms) if self._asked else self._expressions.setdefault(text, (found, terms))

    def _term(self, name: str, terms: dict[str, Target]) -> Name:
        """What a reference within an expression is: a single number."""
        try:
            target = terms[name] = self.target(name)
        except Unresolved as fault:
            raise ConditionError(str(fault)) from None
        if target.is_broken:
            raise _BrokenTerm(target)
        if target.is_curve:
            raise ConditionError("{name} is a curve; single numbers are needed to calculate with.", name=name)
        if target.unit is None:
            raise ConditionError("{name} is not a number; numbers and quantities are needed to calculate with.", name=name)  # fmt: skip
        instance = self.instances[target.instance]
        meta = declared(instance.model, target.key) if target.key and instance else None
        return Name(name, "number", target.unit, meta.unit if isinstance(meta, Quantity) else "")

    def _within_curve(self, instance: Instance, key: KeyPath, target: Target) -> Target:
        """The values of a curve given as a list are not inputs of their own, so their kind is judged here."""
        meta = declared(instance.model, key[:-1]) if len(key) > 1 else None
        if isinstance(meta, CurveInput) and not target.is_broken:
            single = target.unit is not None and not target.is_curve
            if not single or unit(str(target.unit)).kind != unit(meta.unit).kind:
                template = "${{path}} is not a single quantity in {pretty}, as the other values are"
                raise Unresolved(template, path=target.path, pretty=pretty(meta.unit))
        return target

    def _from_press(self, instance: Instance) -> None:
        for slot in instance.slots:
            default = default_of(slot)
            if default is None or slot.key in instance.without:
                continue
            try:
                target = self.target(f"${{{default.path}}}")
            except Unresolved:
                self.problems.append(self._no_default(instance, slot, default))
                continue
            found = Target(target.path, target.instance, target.key, None, target.unit, False, True, default.formula)
            self.links[(instance.name, *slot.key)] = found

    def _no_default(self, instance: Instance, slot: Slot, default: FromPress) -> Problem:
        assert isinstance(slot.meta, Quantity)
        field, key = default.path.removeprefix(f"{PRESS}."), slot.key[-1]
        template = "{key} is not given and the press gives no {field} to derive it from; give {key} ({text}) or {path}."
        told = {"key": key, "field": field, "text": pretty(slot.meta.unit) or phrase("a number"), "path": default.path}
        return instance.place.absent(slot.key, template, **told)

    # --- what a path stands for --------------------------------------------------------------------------------------

    def target(self, text: str) -> Target:
        """What a reference stands for; Unresolved in words where it stands for nothing."""
        if self._asked or text not in self._targets:  # while a unit is looked for, a loop is cut where it began
            found = self._target(text)
            return found if self._asked else self._targets.setdefault(text, found)
        return self._targets[text]

    def _target(self, text: str) -> Target:
        match = WHOLE.fullmatch(text.strip())
        if match is None:
            template = (
                "“{text}” mixes a reference with text; a reference stands for a whole value, as in ${press.name}."
            )
            raise Unresolved(template, text=text)
        path = match[1].strip()
        name, *rest = path.split(".")
        if name not in self.instances:
            if seeming := seeming_latin(name):
                raise Unresolved(f"${{{path}}}: {seeming}")
            near = nearest(name, self.instances)
            template = "${{path}}: there is no mechanism {name}{near}. Known: {instances}."
            raise Unresolved(template, path=path, name=repr(name), near=near, instances=", ".join(self.instances))
        instance = self.instances[name]
        if instance is None:
            return Target(path, name, is_broken=True)
        if not rest or not all(rest):
            example = next(iter(_known(instance)), "output")
            template = "${{path}} names no value; add an output or input, as in ${{name}.{example}}."
            raise Unresolved(template, path=path, name=name, example=example)
        if rest[0] == PHASES and len(rest) > 1:
            phase = ".".join(rest)
            if phase not in instance.phases:
                raise Unresolved(f"${{{path}}} {instance.no_phase(phase)}")
            return Target(path, name, result=phase, phase_unit=instance.phases[phase])
        return self._result(path, instance, ".".join(rest)) or self._input(path, instance, rest)

    def _named(self, instance: Instance) -> None:
        """What is taken whole by its name."""
        for slot in instance.slots:
            if not isinstance(slot.meta, MechanismInput) or not isinstance(slot.value, str) or "${" in slot.value:
                continue
            node, known = (instance.name, *slot.key), [name for name in self.instances if name != PRESS]
            if slot.value in known:
                is_broken = self.instances[slot.value] is None
                self.links[node] = Target(slot.value, slot.value, result="", is_broken=is_broken, is_mechanism=True)
            else:
                self.unresolved.add(node)
                template = "there is no mechanism {value}{nearest}. Known: {known}."
                value, near, names = repr(slot.value), nearest(slot.value, known), ", ".join(known)
                fault = instance.place.problem(slot.key, template, value=value, nearest=near, known=names)
                self.problems.append(fault)

    def _result(self, path: str, instance: Instance, result: str) -> Target | None:
        if result in instance.results:
            si, many = instance.results[result]
            home = instance.rows.get(result)
            if home:
                template = "${{path}} has a value for each of {home}; refer to one, as in ${{path}.0}."
                raise Unresolved(template, path=path, home=home)
            return Target(path, instance.name, result=result, unit=si, is_curve=many)
        part = named(result, instance.declared)
        if part and part.role == "part" and part.id in instance.results and instance.results[part.id][1]:
            return Target(path, instance.name, result=result, unit=instance.results[part.id][0])
        return None

    def _input(self, path: str, instance: Instance, parts: list[str]) -> Target:
        key = key_of(".".join(parts))
        meta = declared(instance.model, key)
        name = dotted(key)
        if isinstance(meta, type):
            inner = ", ".join(meta.model_fields)
            template = "${{path}} is a block or a list; refer to one of its values ({inner})."
            raise Unresolved(template, path=path, inner=inner)
        if meta is None:
            raise Unresolved(self._unknown(path, instance, ".".join(parts)))
        _check_index(path, instance.data, key)
        if name in instance.model.spread and name not in instance.data:
            single = ", ".join(instance.model.spread[name])
            raise Unresolved("${{path}} is a list; refer to one of its values ({single}).", path=path, single=single)
        if name not in instance.given:
            template = "${{path}} is not given; it is optional. Give {path}, or write the value itself here."
            raise Unresolved(template, path=path)
        listed = instance.data.get(name) if isinstance(meta, CurveInput) else None
        if isinstance(listed, list) and (held := [text for _, text in texts(listed) if "${" in text]):
            template = "${{path}} is a list that holds references itself ({held}), and cannot be referred to; write its values here."
            raise Unresolved(template, path=path, held=held[0])
        if isinstance(meta, Varying) and _varies(instance.data, key):
            template = "${{path}} is not a single number, but may vary over a cycle; write here what it is given as."
            raise Unresolved(template, path=path)
        si = unit(meta.unit).si if isinstance(meta, Quantity | CurveInput) else None
        if isinstance(meta, Quantity) and self._is_in_other_unit(instance, key, meta):
            si = meta.other.parsed_unit.si
        return Target(path, instance.name, key, unit=si, is_curve=isinstance(meta, CurveInput))

    def _is_in_other_unit(self, instance: Instance, key: KeyPath, meta: Quantity) -> bool:
        """Whether an input has a value in the other kind of unit that its key allows, itself or by what it refers to."""
        if not meta.or_unit:
            return False
        node, text = (instance.name, *key), dict(texts(instance.data)).get(key, "")
        if "${" not in text:
            return instance.is_in_other_unit(key, meta)
        if node in self._asked:  # of references that lead to each other, which is told elsewhere
            return False
        self._asked.add(node)
        target = self._calculated(instance, key, text) or self.target(text)
        self._asked.discard(node)
        return target.unit == meta.other.parsed_unit.si

    def _unknown(self, path: str, instance: Instance, name: str) -> str:
        if count_name(name) in instance.results:
            return Phrase("${{path}} has several values; refer to one of them, as in ${{path}_1}.", path=path)
        left_out = named(name, instance.declared)
        if left_out and left_out.role in ("value", "place"):
            missing = instance.missing(left_out.id)
            excess = [n for n in instance.declared[left_out.id].lacks if n in instance.given]
            message = Phrase("not calculated, as {excess} is given", excess=", ".join(excess))
            if missing:
                message = Phrase("calculated only if {missing} is given", missing=" and ".join(missing))
            return Phrase("${{path}} is {words} in {name}.", path=path, words=message, name=instance.name)
        known = _known(instance)
        near = nearest(name, known)
        found = Phrase(
            "${{path}}: {name} has no {name_2}{near}.", path=path, name=instance.name, name_2=repr(name), near=near
        )
        return found if near else found + Phrase(" Known: {known}.", known=", ".join(known))


@lru_cache(maxsize=4096)  # a machine of parts has the same ones each time that it is read
def _read(text: str, names: tuple[Name, ...]) -> TypedExpression:
    return read_expression(text, {each.name: each for each in names}.__getitem__)


def _wanted(instance: Instance, key: KeyPath) -> Meta | type[Block] | None:
    """What stands at a key: the declaration of the input, or of the curve that the value is listed in."""
    found = declared(instance.model, key)
    listed = declared(instance.model, key[:-1]) if found is None and len(key) > 1 else None
    return listed if isinstance(listed, CurveInput) else found


def _known(instance: Instance) -> list[str]:
    """What may be referred to; of numbered results the first alone, for how many there are shows in calculating."""
    several = [step for step in instance.declared.values() if has_own_names(step)]
    later = {each.name for step in several for each in names_ahead(step) if each.index > 0}
    single = [name for name in instance.results if name not in later]
    return list(dict.fromkeys([*single, *(name for name, _ in fields(instance.model))]))


def _varies(data: Any, key: KeyPath) -> bool:
    """Whether something else than a number is written there; what is left out has its default, a number."""
    given = value_at(data, key)
    return isinstance(given, dict) or (isinstance(given, str) and ("${" in given or given[:1].isalpha()))


def _check_index(path: str, data: Any, key: KeyPath) -> None:
    for part in key:
        if isinstance(part, int) and isinstance(data, list) and part >= len(data):
            raise Unresolved("${{path}}: the list has {count} entries, counted from 0.", path=path, count=len(data))
        data = value_at(data, (part,))


# The order in which the values and calculations of a config follow from each other, and the loops in it.


def ordered(linker: Linker) -> tuple[list[Node], list[Problem]]:
    """The nodes in the order in which they can be known; or, for each loop, a problem that shows the whole of it."""
    kept, problems = dict(linker.links), list[Problem]()
    while True:
        sorter: TopologicalSorter[Node] = TopologicalSorter({(name,): () for name in linker.instances})
        for node, target in kept.items():
            sorter.add(node, *(single.node for single in target.single))
            sorter.add(node[:1], node)
        try:
            return list(sorter.static_order()), problems
        except CycleError as error:
            loop: list[Node] = error.args[1][:0:-1]  # each refers to the next
            first = next(index for index, node in enumerate(loop) if node in kept)
            loop = loop[first:] + loop[:first]
            problems.append(_loop_problem(linker.instances, kept, loop))
            del kept[loop[0]]


def _loop_problem(instances: Mapping[str, Instance | None], links: Mapping[Node, Target], loop: list[Node]) -> Problem:
    shown = []
    for before, node in zip([loop[-1], *loop], loop, strict=False):
        calculation = (single.path for single in links[before].single if single.node == node) if len(node) == 1 else ()
        shown.append(next(iter(calculation), ".".join(map(str, node))))
    instance = instances[str(loop[0][0])]
    assert instance is not None, "a mechanism without a model has no links"
    told = [text for before, text in zip(["", *shown], [*shown, shown[0]], strict=True) if text != before]
    template = "refers to itself: {told}. Give one of these inputs a value of its own."
    return instance.place.problem(loop[0][1:], template, told=" → ".join(told if len(told) > 1 else 2 * told))


# The text of a configuration with other values in some of its places; all else stays as it is, byte for byte.


ANCHOR = re.compile(r"&\S+\s+")
EXPRESSION = phrase(
    "holds ${…}, a reference or an expression, and is not overwritten; change what it refers to, or write a number there first"
)
SHARED = phrase(
    "stands in a part that an anchor (&) and its aliases (*) share, so that it cannot be changed here alone; write it out"
)
NO_HOME = phrase(
    "cannot be put into the file, as the block that it belongs to does not stand there; write that block first"
)


@dataclass(frozen=True)
class _Span:
    """Hold where a scalar stands in the text: from its first letter to the one after its last, and whether in braces or brackets."""

    start: int
    end: int
    column: int
    in_flow: bool


def assumed_bases(tree: Tree, values: Mapping[KeyPath, Scalar], units: Mapping[KeyPath, str]) -> dict[KeyPath, str]:
    """Return the bases that become assumed with other values, by their places: those that are of the former value alone.

    ``units`` are those of the keys, in which a number without one counts.
    """
    other = [
        path for path, value in values.items() if _differs(tree.typed(path), value, units.get(path, _own_unit(path)))
    ]
    bases = [(*path[:-1], "basis") for path in other if path[-1:] == ("value",)]
    is_inherited = any(path[0] in WORDS and path[-1] != "value" for path in other)
    bases += [("machine", "basis")] if is_inherited else []  # of all numbers of the parts that do not say their own
    return {path: ASSUMED for path in bases if tree.typed(path) in OF_ONE_VALUE}


def _own_unit(path: KeyPath) -> str:
    """The unit in which a number without one counts where its key is not known: of a part it is a length."""
    return "mm" if path[0] in WORDS and path[-1] != "value" else "1"


def _differs(typed: str | None, value: Scalar, own: str) -> bool:
    """Whether a value is another one than what is typed: 0.37 GPa is 370 MPa, and "true" is true."""
    text = str(value)
    if typed is None or typed == text.strip('"'):
        return False
    try:
        return not math.isclose(parse_quantity(typed, own), parse_quantity(text, own), rel_tol=1e-12)
    except UnitError:
        return True


def by_instance(links: Mapping[Node, Target]) -> dict[str, dict[Node, Target]]:
    """Return links by the names of the instances whose inputs they are of."""
    found: dict[str, dict[Node, Target]] = {}
    for node, target in links.items():
        found.setdefault(str(node[0]), {})[node] = target
    return found


def upstream(links: Mapping[Node, Target], names: Iterable[str]) -> set[str]:
    """Return these mechanisms and all that they follow from, the press too where they do."""
    sources: dict[str, set[str]] = {}
    for (name, *_), target in links.items():
        sources.setdefault(str(name), set()).update(each.instance for each in target.single)
    return reached(sources, names)


def reached(neighbours: Mapping[str, set[str]], names: Iterable[str]) -> set[str]:
    """Return these names, and all that are reached from one to its neighbours."""
    found: set[str] = set()
    left = list(names)
    while left:
        if (name := left.pop()) not in found:
            found.add(name)
            left += neighbours.get(name, ())
    return found


def rewritten(
    tree: Tree,
    values: Mapping[KeyPath, str],
    units: Mapping[KeyPath, str] = MappingProxyType({}),
    *,
    over_references: bool = False,
) -> Tree:
    """Return the file with these scalars, as they are to be typed; a key that is not there is put into its block.

    A basis that is of the former value alone (a catalogue, a standard, a measurement) becomes assumed with it; ``units`` are those of the keys.

    UserError in words where a value cannot be written: it is shared by an anchor, or an expression stands there which is not
    to be written over.
    """
    if tree.problems or not values:
        return tree
    values = {**assumed_bases(tree, values, units), **values}
    spans, edits = _spans(tree.text), []
    for path, value in values.items():
        typed = tree.typed(path)
        if typed is not None and "${" in typed and not over_references:
            raise UserError(ConfigPlace(tree).problem(path, EXPRESSION))
        if typed is None:
            edits.append(_new_key(tree, spans, path, value))
        else:
            span = spans[tree.position(path)]
            edits.append((span.start, span.start + len(tree.text[span.start : span.end].rstrip()), value))
    text = tree.text
    for start, end, new in sorted(edits, reverse=True):
        text = text[:start] + new + text[end:]
    return tree if text == tree.text else _read_again(tree, values, text)


def as_file(tree: Tree, text: str) -> bytes:
    """Return the bytes of a file with this text in place of the tree's, with the byte order mark that it began with."""
    had_mark = hashlib.sha256(codecs.BOM_UTF8 + tree.text.encode()).hexdigest() == tree.sha256
    return (codecs.BOM_UTF8 if had_mark else b"") + text.encode()


@lru_cache(maxsize=4)
def _spans(text: str) -> dict[tuple[int, int], _Span]:
    """Where each scalar stands, by its line and column as the tree has them."""
    found: dict[tuple[int, int], _Span] = {}
    flows: list[bool] = []
    for event in yaml.parse(text, Loader=LOADER):
        if isinstance(event, yaml.MappingStartEvent | yaml.SequenceStartEvent):
            flows.append(bool(event.flow_style))
        elif isinstance(event, yaml.MappingEndEvent | yaml.SequenceEndEvent):
            flows.pop()
        elif isinstance(event, yaml.ScalarEvent):
            first, last = event.start_mark, event.end_mark
            assert first is not None and last is not None, "events of a text have marks"
            end = last.index
            anchor = ANCHOR.match(text, first.index, end) if event.anchor else None
            span = _Span(anchor.end() if anchor else first.index, end, first.column, any(flows))
            found[first.line + 1, first.column + 1] = span
    return found


def _new_key(tree: Tree, spans: Mapping[tuple[int, int], _Span], path: KeyPath, value: str) -> tuple[int, int, str]:
    """Where a new key goes: behind the first single value of its block, in a line of its own or, within braces, in the same one.

    In a block whose values all say their basis it goes before the first of them.
    """
    home, key = path[:-1], path[-1]
    data = value_at(tree.data, home)
    break_ = "\r\n" if "\r\n" in tree.text else "\n"
    for name in data if isinstance(data, dict) else ():
        before = (*home, name)
        span, key_span = spans.get(tree.position(before)), spans.get(tree.key_position(before))
        if span is None or key_span is None or tree.typed(before) in (None, ""):
            continue
        if "\n" in tree.text[key_span.start : span.end]:
            continue
        if span.in_flow:
            return span.end, span.end, f", {key}: {value}"
        line_end = span.end + len(tree.text[span.end :].partition("\n")[0].removesuffix("\r"))
        return line_end, line_end, f"{break_}{' ' * key_span.column}{key}: {value}"
    first = next(iter(data), None) if isinstance(data, dict) else None
    key_span = None if first is None else spans.get(tree.key_position((*home, first)))
    if key_span is not None:
        apart = ", " if key_span.in_flow else f"{break_}{' ' * key_span.column}"
        return key_span.start, key_span.start, f"{key}: {value}{apart}"
    raise UserError(ConfigPlace(tree).problem(path, NO_HOME))


def _read_again(tree: Tree, values: Mapping[KeyPath, str], text: str) -> Tree:
    """The new text read, which must differ from the file in these values alone."""
    expected = copy.deepcopy(tree.data)
    for path, value in values.items():
        value_at(expected, path[:-1])[path[-1]] = parse(f"value: {value}\n", tree.file).data["value"]
    found = parse(text, tree.file)
    if found.data != expected:
        shared = {tree.position(path) for path in _differing(found.data, expected)}
        culprit = next((path for path in values if tree.position(path) in shared), next(iter(values)))
        raise UserError(ConfigPlace(tree).problem(culprit, SHARED))
    found.name = tree.name
    return found


def _differing(one: Any, other: Any, path: KeyPath = ()) -> Iterator[KeyPath]:
    if not (isinstance(one, dict | list) and type(one) is type(other) and len(one) == len(other)):
        yield from () if one == other else (path,)
        return
    for key in one if isinstance(one, dict) else range(len(one)):
        if isinstance(one, list) or key in other:
            yield from _differing(one[key], other[key], (*path, key))


# Keys that take a number or a curve: a value that is a curve stands under the key of the curve, wherever it was typed.


def linked(instances: Mapping[str, Instance | None]) -> Linker:
    """Return the links of all instances, whose curves stand under their own keys then (``Block.curve_keys``).

    What a mechanism gives may depend on that, and so whether a reference to it is a curve: it is asked until nothing moves.
    """
    linker = Linker(instances)
    while _any_moved(linker):
        linker = Linker(instances)
    return linker


def _any_moved(linker: Linker) -> bool:
    """Lay curves under their own keys, but where that is asked of an instance that has just changed; return whether there were any."""
    moved: set[str] = set()
    for instance in filter(None, linker.instances.values()):
        asked = (linker.links.get((instance.name, key)) for key in instance.model.curve_keys)
        if not any(target.instance in moved for target in asked if target) and _moved(instance, linker):
            moved.add(instance.name)
    return bool(moved)


def _moved(instance: Instance, linker: Linker) -> bool:
    """Lay curves under their own keys; return whether there were any."""
    found = []
    for key, curve in instance.model.curve_keys.items():
        target = linker.links.get((instance.name, key))
        is_curve = (target is not None and target.is_curve) or isinstance(instance.data.get(key), list)
        if is_curve and instance.data.get(curve) is None:
            found.append((key, curve))
    for key, curve in found:
        instance.data[curve] = instance.data.pop(key)
        instance.place = replace(instance.place, listed={**instance.place.listed, (curve,): (key,)})
        instance.bases = {(curve,) if at == (key,) else at: basis for at, basis in instance.bases.items()}
    if found:
        instance.forget()
    return bool(found)
