"""Inputs: each is declared, its default keeps its own bounds, its unit is known, and rules name keys that there are."""

from __future__ import annotations

import math
from collections.abc import Iterator
from inspect import get_annotations
from types import UnionType
from typing import Any, Union, get_args, get_origin

from pydantic import PydanticSchemaGenerationError, TypeAdapter
from pydantic.fields import FieldInfo

from diecut_report.contract.bounds import BOUNDS
from diecut_report.contract.inputs import Block, CurveInput, Meta, Quantity, Text, meta_of, nested
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.input_places import of_class, of_field
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.declaration.world import Key, allowed
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.plausible import Plausible
from diecut_report.quantities.units import unit

RESERVED = ("kind",)  # keys of each mechanism in a configuration
PLAIN = ("builtins", "typing", "types")  # where the classes of plain values stand


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the inputs."""
    yield from _block(mechanism.inputs, mechanism.at)
    for key in names.world.keys.values():
        forms = getattr(key.meta, "units", ())
        if forms and "." in key.path:
            yield Fault(
                key.meta.at if key.meta else "",
                Phrase("input {path}", path=key.path),
                phrase("has other units within a block, where none hold"),
            )
        for other in forms:
            yield from _form(
                key.meta.at if key.meta else "", Phrase("input {path}", path=key.path), other, names.world.keys
            )
    for _, step in mechanism.steps:
        for other in step.units:
            yield from _form(step.at, Phrase("step {id}", id=step.id), other, names.world.keys)


def _form(place: str, subject: str, form: tuple[str, str], keys: dict[str, Key]) -> Iterator[Fault]:
    """A unit beside a key by which it cannot be told."""
    name, key = form[0], keys.get(form[0])
    if key is None:
        yield Fault(
            place,
            subject,
            Phrase("has units beside {name}, which is not an input{nearest}", name=name, nearest=nearest(name, keys)),
        )
    elif not key.may_be_absent or key.has_default or "." in name or getattr(key.meta, "press", None):
        yield Fault(
            place,
            subject,
            Phrase("has units beside {name}, which is not an optional input without a default", name=name),
        )


def _block(model: type[Block], place: str, prefix: str = "") -> Iterator[Fault]:
    if changed := [name for name, value in Block.model_config.items() if model.model_config.get(name) != value]:
        words = "changes {names} in its model_config, so that keys that are misspelt may pass unread; take it away"
        subject = Phrase("class {name}", name=model.__name__)
        yield Fault(of_class(model, place), subject, Phrase(words, names=", ".join(changed)))
    for name, declared in model.model_fields.items():
        inner, subject = nested(declared.annotation), Phrase("input {path}", path=f"{prefix}{name}")
        for text in (*_absent(declared), *(() if inner else _wrong(name, declared, meta_of(model, name)))):
            yield Fault(of_field(model, name, place), subject, text)
        if name in RESERVED and not prefix:
            text = Phrase(
                "has the name of a key that the program reads itself ({reserved}), so that nobody can give it; name it otherwise",
                reserved=", ".join(RESERVED),
            )
            yield Fault(of_field(model, name, place), subject, text)
        for kind in _strange(declared.annotation):
            text = Phrase(
                "is made of {name}, which is not a block of inputs; write class {name}(Block)", name=kind.__name__
            )
            yield Fault(of_class(kind, place), subject, text)
        if inner:
            yield from _block(inner[0], place, f"{prefix}{name}.")
    for rule in model.one_of:
        for key in sorted(
            set().union(*rule.groups, rule.shared, filter(None, [rule.when.partition("=")[0]]))
            - set(model.model_fields)
        ):
            yield Fault(place, Phrase("one_of of {name}", name=model.__name__), _no_input(key, model))
    for key in sorted({single for keys in model.spread.values() for single in keys} - set(model.model_fields)):
        yield Fault(place, Phrase("spread of {name}", name=model.__name__), _no_input(key, model))
    for key in sorted({key for rule in model.from_tables for key in (rule.key, *rule.gives)} - set(model.model_fields)):
        yield Fault(place, Phrase("from_tables of {name}", name=model.__name__), _no_input(key, model))
    known = {name: meta_of(model, name) for name in model.model_fields}
    for key, curve in model.curve_keys.items():
        if not isinstance(known.get(key), Quantity) or not isinstance(known.get(curve), CurveInput):
            text = Phrase(
                "lay {key} on {curve}; a Quantity and a CurveInput of the inputs are needed", key=key, curve=curve
            )
            yield Fault(place, Phrase("curve_keys of {name}", name=model.__name__), text)


def _no_input(key: str, model: type[Block]) -> Phrase:
    known = model.model_fields
    return Phrase("names {key}, which is not an input{nearest}", key=key, nearest=nearest(key, known))


def _absent(declared: FieldInfo) -> Iterator[str]:
    """What is wrong with an input that is left out: None must be allowed where it is the default, and be the default where it is allowed."""
    kinds = _kinds(declared.annotation)
    said = " | ".join(_said(kind) for kind in kinds if kind is not type(None))
    may_be_none = type(None) in kinds  # Any alone does not tell that it may be left out
    if declared.is_required() and type(None) in kinds:
        yield Phrase(
            "may be None, but has no default, so that it must be given all the same; write = None behind it, or annotate it as {said}",
            said=said,
        )
    if not declared.is_required() and declared.get_default(call_default_factory=True) is None and not may_be_none:
        yield Phrase(
            "has the default None, but may not be None; annotate it as {said} | None, or give it a value", said=said
        )


def _kinds(annotation: Any) -> tuple[Any, ...]:
    """The kinds that a union allows; of any other annotation itself."""
    return get_args(annotation) if get_origin(annotation) in (Union, UnionType) else (annotation,)


def _said(kind: Any) -> str:
    return kind.__name__ if isinstance(kind, type) else str(kind).removeprefix("typing.")


def _strange(annotation: Any) -> Iterator[type]:
    """Classes with keys of their own that are not blocks, of which nothing is known, and those that no text of a file can be."""
    if isinstance(annotation, type):
        is_plain = annotation.__module__ in PLAIN or issubclass(annotation, Block)
        if not is_plain and (get_annotations(annotation) or not _is_readable(annotation)):
            yield annotation
    for part in get_args(annotation):
        yield from _strange(part)


def _is_readable(kind: type) -> bool:
    try:
        TypeAdapter(kind)
    except PydanticSchemaGenerationError:
        return False
    return True


def _bounds(meta: Quantity) -> Iterator[str]:
    """Bounds that are not numbers, and those that no number keeps."""
    given = {name: getattr(meta, name) for name, _ in BOUNDS if getattr(meta, name) is not None}
    for name, bound in given.items():
        if isinstance(bound, bool) or not isinstance(bound, int | float):
            yield Phrase(
                "has the bound {name}={bound}; write a plain number, which counts in its unit ({unit}): {name}=0",
                name=name,
                bound=repr(bound),
                unit=meta.unit,
            )
            return
    low = max((given[name] for name in ("gt", "ge") if name in given), default=-math.inf)
    high = min((given[name] for name in ("lt", "le") if name in given), default=math.inf)
    if low > high or (low == high and low in (meta.gt, meta.lt)):
        yield Phrase("has bounds that no number keeps: {allowed}; exchange or widen them", allowed=meta.allowed)


def _wrong(name: str, declared: FieldInfo, meta: Meta | None) -> Iterator[str]:
    default = declared.get_default(call_default_factory=True)
    if meta is None:
        kind = getattr(declared.annotation, "__name__", str(declared.annotation))
        what = f'Quantity("SYMBOL", "UNIT", "description")' if kind in ("int", "float") else 'Text("description")'  # noqa: F541
        value = "" if declared.is_required() else f" = {default!r}"
        yield Phrase(
            "is a plain {kind}, of which nothing is known; write {name}: Annotated[{kind}, {what}]{value}",
            kind=kind,
            name=name,
            what=what,
            value=value,
        )
        return
    if isinstance(meta, Quantity):
        wrong = list(_bounds(meta))
        if wrong:  # no number can be held against them
            yield from wrong
            return
        if int in _kinds(declared.annotation) and not meta.integer:
            yield Phrase(
                "is annotated as int, but takes any number; write integer=True in its Quantity, or annotate it as float"
            )
    if isinstance(meta, Quantity) and meta.plausible:
        yield from _sizes(meta, meta.plausible)
    if isinstance(meta, Quantity) and meta.integer and (meta.unit != "1" or meta.units):
        yield Phrase("is a whole number in {unit}; a count has the unit 1", unit=meta.unit)
    if declared.is_required() or default is None:
        return
    yield from _default(default, declared.annotation, meta)


def _sizes(meta: Quantity, ends: tuple[str, str]) -> Iterator[str]:
    """Plausible sizes that are none, or of another kind of quantity."""
    try:
        own = Plausible(*ends)
        _ = own.ends  # which are judged when they are read
        kinds = [unit(text).kind for text in (meta.unit, *(other for _, other in meta.units))]
        if own.kind not in kinds:
            yield Phrase(
                "has plausible sizes {low} to {high}; a quantity in {unit} is needed",
                low=ends[0],
                high=ends[1],
                unit=meta.unit,
            )
    except (TypeError, ValueError) as why:
        yield Phrase("has plausible sizes that are none: {why}", why=why)


def _default(default: Any, annotation: Any, meta: Meta) -> Iterator[str]:
    if isinstance(meta, Text):
        texts = tuple(allowed(annotation, meta))
        said = str(default).lower() if isinstance(default, bool) else str(default)
        if texts and said not in texts:
            yield Phrase(
                "has the default {default}{nearest}; allowed: {texts}",
                default=repr(default),
                nearest=nearest(said, texts),
                texts=", ".join(texts),
            )
        return
    try:
        meta.validate(default)
    except ValueError as why:
        yield Phrase("the default {why}; change the default or the bounds", why=why)
