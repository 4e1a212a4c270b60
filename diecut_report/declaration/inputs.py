"""Inputs: each is declared, its default keeps its own bounds, its unit is known, and rules name keys that there are."""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from itertools import chain
from typing import Any, Literal, cast, get_args, get_origin, get_type_hints

from pydantic.fields import FieldInfo

from diecut_report.declaration.formulas import kind_of
from diecut_report.declaration.names import DeclaredNames, Fault, declared_in, fault
from diecut_report.errors import nearest
from diecut_report.formulas.expression import FormulaError
from diecut_report.formulas.formula import Formula
from diecut_report.formulas.tree import Node
from diecut_report.mechanism.curve_inputs import CurveInput
from diecut_report.mechanism.inputs import BOUNDS, Block, Key, Meta, Quantity, allowed, meta_of, nested
from diecut_report.mechanism.mechanism import ExampleBlock, ForEach, Wired, kinds_named
from diecut_report.mechanism.names import ByText, Text, formula_of
from diecut_report.mechanism.steps import Root, Step
from diecut_report.quantities.plausible import Plausible
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, phrase

# What a declaration may say: words among the allowed ones, yes or no, tuples of ids, tolerances of rounding.


MOST_TOLERANCE = 0.01  # of a check: more than rounding and measuring leave open is a limit of its own
MOST_OF_PROOF = 1e-6  # of the relation that proves a root: more than the rounding of differences is another number
NOT_READ = {"StandardSeries": object, "StandardTable": object, "Chapter": object}  # imported for type checkers alone
ALLOWED_PLAIN = ("needs", "lacks", "only_with", "asks_for")  # which are told of where tokens are judged


def allowed_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield words that are not among the allowed ones, and tolerances that let a machine fail."""
    for declared in declared_in(names.mechanism):
        yield from (fault(declared, text) for text in allowed_wrong(declared))
    for check in names.mechanism.checks:
        if not 0 <= check.tolerance <= MOST_TOLERANCE:
            template = (
                "has the tolerance {tolerance}, a share of the limit; allowed: 0 to {most} (1 %), for rounding alone; "
                "put what is allowed into the limit"
            )
            yield fault(check, Phrase(template, tolerance=repr(check.tolerance), most=MOST_TOLERANCE))
    for _, step in names.mechanism.steps:
        if isinstance(step, Root) and not 0 < step.tolerance <= MOST_OF_PROOF:
            template = (
                "has the tolerance {tolerance}, the share by which its left and right may differ; allowed: above 0, to {most}, "
                "for rounding alone; let the relation hold at the root"
            )
            yield fault(step, Phrase(template, tolerance=repr(step.tolerance), most=f"{MOST_OF_PROOF:g}"))


def allowed_wrong(declared: Any) -> Iterator[str]:
    """Yield what is wrong with the words, flags and tuples of something declared."""
    for name, (words, kind) in _fields(cast(Hashable, type(declared))).items():
        value = getattr(declared, name)
        if words and value not in words:
            near, told = nearest(str(value), map(str, words)), ", ".join(map(repr, words))
            template = "has {name}={value}{nearest}; allowed: {told}"
            yield Phrase(template, name=name, value=repr(value), nearest=near, told=told)
        elif kind is bool and not isinstance(value, bool):
            yield Phrase("has {name}={value}; allowed: True, False", name=name, value=repr(value))
        elif kind is tuple and isinstance(value, str):
            yield Phrase("has {name}={value}, a text; write a tuple, ({value},)", name=name, value=repr(value))


@cache
def _fields(kind: Hashable) -> dict[str, tuple[tuple[Any, ...], Any]]:
    """The fields that hold one of several words, yes or no, or a tuple."""
    found: dict[str, tuple[tuple[Any, ...], Any]] = {}
    for name, hint in get_type_hints(cast(type, kind), localns=NOT_READ).items():
        origin = get_origin(hint)
        words = get_args(hint) if origin is Literal else ()
        if words or hint is bool or (origin is tuple and name not in ALLOWED_PLAIN):
            found[name] = words, bool if hint is bool else origin
    return found


# Where inputs are declared: the class, and the line in it.


def of_class(declared: type, otherwise: str) -> str:
    """Return ``file:line`` of a class, or another place where it has no file."""
    try:
        return f"{inspect.getsourcefile(declared)}:{inspect.getsourcelines(declared)[1]}"
    except (OSError, TypeError):  # made without a file
        return otherwise


def of_field(model: type[Block], name: str, otherwise: str) -> str:
    """Return the line that declares an input: what several have in common is made elsewhere, and knows no place of its own."""
    for owner in model.__mro__:
        if name in inspect.get_annotations(owner):
            try:
                lines, first = inspect.getsourcelines(owner)
            except OSError:  # made without a file, as a block with a suffix of its own
                continue
            for number, line in enumerate(lines, first):
                if line.strip().startswith((f"{name} =", f"{name}_ =", f"{name}:")):
                    return f"{inspect.getsourcefile(owner)}:{number}"
    return otherwise


def of_input(model: type[Block], path: str, otherwise: str) -> str:
    """Return the line that declares the input of a path (``gears.driver_teeth``)."""
    head, _, rest = path.partition(".")
    inner = nested(model.model_fields[head].annotation) if rest else None
    return of_input(inner[0], rest, otherwise) if inner else of_field(model, head, otherwise)


RESERVED = ("kind",)  # keys of each mechanism in a configuration


def faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the inputs."""
    yield from _block(names.mechanism.inputs, names.mechanism.at)
    keys = names.world.keys
    for key in keys.values():
        forms, place = getattr(key.meta, "units", ()), getattr(key.meta, "at", "")
        texts = [phrase("has other units within a block, where none hold")] if forms and "." in key.path else []
        for text in (*texts, *_forms(forms, keys)):
            yield Fault(place, Phrase("input {path}", path=key.path), text)
    for _, step in names.mechanism.steps:
        yield from (fault(step, text) for text in _forms(step.units, keys))


def _forms(forms: Iterable[tuple[str, str]], keys: dict[str, Key]) -> Iterator[str]:
    """Units beside keys by which they cannot be told."""
    for name, _ in forms:
        key = keys.get(name)
        if key is None:
            template = "has units beside {name}, which is not an input{nearest}"
            yield Phrase(template, name=name, nearest=nearest(name, keys))
        elif not key.may_be_absent or key.has_default or "." in name or getattr(key.meta, "press", None):
            yield Phrase("has units beside {name}, which is not an optional input without a default", name=name)


MADE_BY = ("__init__", "__new__", "__getattribute__", "__getattr__", "model_post_init")


def _own_code(model: type[Block]) -> Iterator[str]:
    """What of a class comes between the values that the program read and those that count."""
    judged = model.__pydantic_decorators__
    yield from (*judged.validators, *judged.field_validators, *judged.root_validators, *judged.model_validators)
    own = [each for each in model.__mro__ if each not in Block.__mro__]
    yield from (name for name in MADE_BY if any(name in vars(each) for each in own))


def _block(model: type[Block], place: str, prefix: str = "") -> Iterator[Fault]:
    whole = of_class(model, place), Phrase("class {name}", name=model.__name__)
    if changed := [name for name, value in Block.model_config.items() if model.model_config.get(name) != value]:
        template = "changes {names} in its model_config, so that keys that are misspelt may pass unread; take it away"
        yield Fault(*whole, Phrase(template, names=", ".join(changed)))
    if own := list(_own_code(model)):
        template = (
            "reads its inputs by code of its own ({names}), so that another value than the user's may count; calculate in a step, "
            "and refuse by require"
        )
        yield Fault(*whole, Phrase(template, names=", ".join(own)))
    for name, declared in model.model_fields.items():
        inner, subject = nested(declared.annotation), Phrase("input {path}", path=f"{prefix}{name}")
        told = [] if inner else list(_wrong(declared, meta_of(model, name)))
        if not any(name in getattr(owner, "assigned", ()) for owner in model.__mro__):
            told = [
                Phrase(
                    'is annotated; write {name} = Quantity("SYMBOL", "UNIT", "description"), or Text("description")',
                    name=name,
                )
            ]
        if name in RESERVED and not prefix:
            template = "has the name of a key that the program reads itself ({reserved}), so that nobody can give it; name it otherwise"
            told.append(Phrase(template, reserved=", ".join(RESERVED)))
        for text in told:
            yield Fault(of_field(model, name, place), subject, text)
        if inner:
            yield from _block(inner[0], place, f"{prefix}{name}.")
    yield from (Fault(place, subject, text) for subject, text in _rules(model))


def _rules(model: type[Block]) -> Iterator[tuple[Phrase, Phrase]]:
    """Rules of a block that name what is not an input of it."""
    name, known = model.__name__, {name: meta_of(model, name) for name in model.model_fields}
    ruled = [(Phrase("one_of of {name}", name=name), {*chain(*rule.groups), *rule.shared, rule.when.partition("=")[0]} - {""})
             for rule in model.one_of]  # fmt: skip
    ruled.append((Phrase("spread of {name}", name=name), set(chain(*model.spread.values()))))
    tables = {key for rule in model.from_tables for key in (rule.key, *rule.gives)}
    for subject, keys in (*ruled, (Phrase("from_tables of {name}", name=name), tables)):
        for key in sorted(keys - known.keys()):
            near = nearest(key, known)
            yield subject, Phrase("names {key}, which is not an input{nearest}", key=key, nearest=near)
    for key, curve in model.curve_keys.items():
        if not isinstance(known.get(key), Quantity) or not isinstance(known.get(curve), CurveInput):
            template = "lay {key} on {curve}; a Quantity and a CurveInput of the inputs are needed"
            yield Phrase("curve_keys of {name}", name=name), Phrase(template, key=key, curve=curve)


def _bounds(meta: Quantity) -> Iterator[str]:
    """Bounds that are not numbers, and those that no number keeps."""
    given = {name: getattr(meta, name) for name, _ in BOUNDS if getattr(meta, name) is not None}
    for name, limit in given.items():
        if isinstance(limit, bool) or not isinstance(limit, int | float):
            template = "has the bound {name}={bound}; write a plain number, which counts in its unit ({unit}): {name}=0"
            yield Phrase(template, name=name, bound=repr(limit), unit=meta.unit)
            return
    low = max((given[name] for name in ("gt", "ge") if name in given), default=-math.inf)
    high = min((given[name] for name in ("lt", "le") if name in given), default=math.inf)
    if low > high or (low == high and low in (meta.gt, meta.lt)):
        yield Phrase("has bounds that no number keeps: {allowed}; exchange or widen them", allowed=meta.allowed)


def _wrong(declared: FieldInfo, meta: Meta | None) -> Iterator[str]:
    default = declared.get_default(call_default_factory=True)
    if isinstance(meta, Quantity):
        wrong = list(_bounds(meta))
        if wrong:  # no number can be held against them
            yield from wrong
            return
        if meta.plausible:
            yield from _sizes(meta, meta.plausible)
        if meta.integer and (meta.unit != "1" or meta.units):
            yield Phrase("is a whole number in {unit}; a count has the unit 1", unit=meta.unit)
    if meta and not declared.is_required() and default is not None:
        yield from _default(default, declared.annotation, meta)


def _sizes(meta: Quantity, ends: tuple[str, str]) -> Iterator[str]:
    """Plausible sizes that are none, or of another kind of quantity."""
    try:
        own = Plausible(*ends)
        _ = own.ends  # which are judged when they are read
        kinds = [unit(text).kind for text in (meta.unit, *(other for _, other in meta.units))]
        if own.kind not in kinds:
            template = "has plausible sizes {low} to {high}; a quantity in {unit} is needed"
            yield Phrase(template, low=ends[0], high=ends[1], unit=meta.unit)
    except (TypeError, ValueError) as why:
        yield Phrase("has plausible sizes that are none: {why}", why=why)


def _default(default: Any, annotation: Any, meta: Meta) -> Iterator[str]:
    if isinstance(meta, Text):
        texts = tuple(allowed(annotation, meta))
        said = str(default).lower() if isinstance(default, bool) else str(default)
        if texts and said not in texts:
            template = "has the default {default}{nearest}; allowed: {texts}"
            yield Phrase(template, default=repr(default), nearest=nearest(said, texts), texts=", ".join(texts))
        return
    if why := fault_of(meta, default):
        yield Phrase("the default {why}; change the default or the bounds", why=why)


# Conditions give yes or no, and choices end with a case that is always taken.


YES_OR_NO = ("cmp", "and", "or", "not")


def conditions_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield conditions that are numbers, and numbers that are conditions."""
    for _, step in names.mechanism.steps:
        for each in step.formulas():
            if each.is_condition:
                strange = [formula.__name__ for formula in each.options if not _decides(formula, names)]
                template = "the {part} gives a number, not yes or no; compare it with something ({formula} > 0)"
                part = phrase("condition exists") if each.part == "exists" else each.part
                yield from (fault(step, Phrase(template, part=part, formula=name)) for name in strange[:1])
        if step.exists is not None and not step.may_be_absent:
            template = "has exists, which holds for {kinds} alone; put it on what this step takes"
            yield fault(step, Phrase(template, kinds="value, choice, computed"))
        yield from (fault(step, text) for text in _flag(step, names))


def _decides(formula: Formula, names: DeclaredNames, *, unread: bool = True) -> bool:
    """Whether a formula gives yes or no; ``unread`` of one that cannot be read, which is told elsewhere."""
    try:
        return _is_condition(formula.tree, names, unread)
    except (FormulaError, RecursionError):
        return unread


def _is_condition(node: Node, names: DeclaredNames, unread: bool) -> bool:
    match node:
        case Node("cases", branches):
            return all(_is_condition(branch[0], names, unread) for branch in branches)
        case Node("apply", (called, *_)):
            return _is_condition(called.formula.tree, names, unread)
        case Node("sym", (name,)):
            steps = [giver.step for giver in names.givers(name)]
            formulas = [getattr(step, "formula", None) for step in steps]
            found = (each is not None and _decides(formula_of(each), names, unread=unread) for each in formulas)
            return bool(steps) and all(found)
    return node.op in YES_OR_NO


def _flag(step: Step, names: DeclaredNames) -> Iterator[str]:
    """A comparison that stands as a quantity with a unit."""
    formula = getattr(step, "formula", None)
    if formula is not None and not isinstance(formula, ByText) and _decides(formula_of(formula), names, unread=False):
        wrong = [each for each in (step.unit, *(other for _, other in step.units)) if kind_of(each) != kind_of("1")]
        if wrong:
            yield Phrase("gives yes or no (1 or 0), but has the unit {wrong}; a flag has the unit 1", wrong=wrong[0])


# Examples name keys that there are, with values that these take.


NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
"""What a mechanism, a shaft or a part may be called."""


def examples_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the keys of an example that name no input, and the values that an input does not take."""
    example: Any = names.mechanism.example
    if example is None:
        return
    if not isinstance(example, ExampleBlock):
        words = 'has example={example}; write ExampleBlock("name", {"key": "10 mm"})'
        yield fault(names.mechanism, Phrase(words, example=repr(example)))
        return
    if not NAME.fullmatch(example.name):
        text = phrase("is not a name of a mechanism: a letter, then letters, digits, _ and - are allowed")
        yield Fault(example.at, Phrase("example {name}", name=repr(example.name)), text)
    subject = Phrase("example {name}", name=example.name)
    for key, words in _examples_wrong(names.mechanism.inputs, example.inputs, ""):
        yield Fault(example.at, subject, Phrase("{key} {text}", key=key, text=words))


def _examples_wrong(model: type[Block], data: Mapping[str, Any], path: str) -> Iterator[tuple[str, str]]:
    for key, value in data.items():
        if key not in model.model_fields:
            yield f"{path}{key}", Phrase("names no input{nearest}", nearest=nearest(key, model.model_fields))
            continue
        block, meta = nested(model.model_fields[key].annotation), meta_of(model, key)
        for each in _values(value):
            if block and isinstance(each, dict):
                yield from _examples_wrong(block[0], each, f"{path}{key}.")
            elif isinstance(meta, Quantity | Text) and (text := _refused(meta, each)):
                yield f"{path}{key}", text


def _values(value: Any) -> Iterator[Any]:
    """The values that may stand there, and the parts of those that are lists."""
    match value:
        case Wired():
            yield from _values(value.value)
            yield from _values(value.otherwise)
        case ForEach():
            yield from _values(value.part)
        case list() | tuple():
            for part in value:
                yield from _values(part)
        case _:
            yield value


def _refused(meta: Quantity | Text, value: Any) -> str:
    """What is wrong with a value that refers to nothing, in words."""
    if isinstance(value, dict) and isinstance(meta, Quantity):
        value = value.get("value")
    if value is None or (isinstance(value, str) and ("${" in value or any(kinds_named(value)))):
        return ""
    if isinstance(meta, Text) and not meta.options:
        return ""
    others = [replace(meta, unit=unit, units=()) for _, unit in meta.units] if isinstance(meta, Quantity) else []
    found = [fault_of(each, value) for each in (meta, *others)]
    return found[0] if all(found) else ""


def fault_of(meta: Meta, value: Any) -> str:
    """Return why an input does not take a value; empty where it does."""
    try:
        meta.validate(value)
    except ValueError as fault:
        return str(fault)
    return ""
