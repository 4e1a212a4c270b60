"""Inputs: each is declared, its default keeps its own bounds, its unit is known, and rules name keys that there are."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from typing import Any

from pydantic.fields import FieldInfo

from diecut_report.contract.inputs import Block, CurveInput, Meta, Quantity, Text, meta_of, nested
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.declaration.world import Key, allowed
from diecut_report.errors import nearest
from diecut_report.quantities.plausible import Plausible
from diecut_report.quantities.units import unit


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the inputs."""
    yield from _block(mechanism.inputs, mechanism.at)
    for key in names.world.keys.values():
        forms = getattr(key.meta, "units", ())
        if forms and "." in key.path:
            yield Fault(
                key.meta.at if key.meta else "", f"input {key.path}", "has other units within a block, where none hold"
            )
        for other in forms:
            yield from _form(key.meta.at if key.meta else "", f"input {key.path}", other, names.world.keys)
    for _, step in mechanism.steps:
        for other in step.units:
            yield from _form(step.at, f"step {step.id}", other, names.world.keys)


def _form(place: str, subject: str, form: tuple[str, str], keys: dict[str, Key]) -> Iterator[Fault]:
    """A unit beside a key by which it cannot be told."""
    name, key = form[0], keys.get(form[0])
    if key is None:
        yield Fault(place, subject, f"has units beside {name}, which is no input{nearest(name, keys)}")
    elif not key.may_be_absent or key.has_default or "." in name or getattr(key.meta, "press", None):
        yield Fault(place, subject, f"has units beside {name}, which is no optional input without a default")


def _block(model: type[Block], place: str, prefix: str = "") -> Iterator[Fault]:
    for name, declared in model.model_fields.items():
        meta, inner = meta_of(model, name), nested(declared.annotation)
        if inner:
            yield from _block(inner[0], place, f"{prefix}{name}.")
            continue
        for text in _wrong(name, declared, meta):
            yield Fault(_place(model, name, place), f"input {prefix}{name}", text)
    for rule in model.one_of:
        for key in sorted(set().union(*rule.groups, rule.shared) - set(model.model_fields)):
            yield Fault(place, f"one_of of {model.__name__}", f"names {key}, which is no input{nearest(key, model.model_fields)}")  # fmt: skip
    for key in sorted({single for keys in model.spread.values() for single in keys} - set(model.model_fields)):
        yield Fault(place, f"spread of {model.__name__}", f"names {key}, which is no input{nearest(key, model.model_fields)}")  # fmt: skip


def _place(model: type[Block], name: str, otherwise: str) -> str:
    """Return the line that declares an input: annotations may be texts that pydantic reads, so that they know no place themselves."""
    for owner in model.__mro__:
        if name in inspect.get_annotations(owner):
            try:
                lines, first = inspect.getsourcelines(owner)
            except OSError:  # made without a file
                return otherwise
            for number, line in enumerate(lines, first):
                if line.strip().startswith(f"{name}:"):
                    return f"{inspect.getsourcefile(owner)}:{number}"
    return otherwise


def _wrong(name: str, declared: FieldInfo, meta: Meta | None) -> Iterator[str]:
    default = declared.get_default(call_default_factory=True)
    if meta is None:
        kind = getattr(declared.annotation, "__name__", str(declared.annotation))
        what = f'Quantity("SYMBOL", "UNIT", "description")' if kind in ("int", "float") else 'Text("description")'  # noqa: F541
        value = "" if declared.is_required() else f" = {default!r}"
        yield f"is a plain {kind}, of which nothing is known; write {name}: Annotated[{kind}, {what}]{value}"
        return
    if isinstance(meta, Quantity | CurveInput):
        try:
            unit(meta.unit)
        except ValueError as unknown:
            yield f"has the unit {meta.unit!r}: {unknown}"
            return
    if isinstance(meta, Quantity) and meta.plausible:
        yield from _sizes(meta, meta.plausible)
    if isinstance(meta, Quantity) and meta.integer and (meta.unit != "1" or meta.units):
        yield f"is a whole number in {meta.unit}; a count has the unit 1"
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
            yield f"has plausible sizes {ends[0]} to {ends[1]}; a quantity in {meta.unit} is needed"
    except (TypeError, ValueError) as why:
        yield f"has plausible sizes that are none: {why}"


def _default(default: Any, annotation: Any, meta: Meta) -> Iterator[str]:
    if isinstance(meta, Text):
        texts = tuple(allowed(annotation, meta))
        said = str(default).lower() if isinstance(default, bool) else str(default)
        if texts and said not in texts:
            yield f"has the default {default!r}{nearest(said, texts)}; allowed: {', '.join(texts)}"
        return
    try:
        meta.validate(default)
    except ValueError as why:
        yield f"the default {why}; change the default or the bounds"
