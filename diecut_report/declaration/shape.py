"""The shape of what is declared: each thing of the type that the contract names, or nothing else can be asked of it."""

from __future__ import annotations

import ast
import re
import reprlib
from collections.abc import Iterable, Iterator
from functools import lru_cache
from keyword import iskeyword
from pathlib import Path
from typing import Any

from diecut_report.declaration.code import files
from diecut_report.declaration.inputs import of_class, of_input
from diecut_report.declaration.names import DeclaredNames, Fault, fault, short
from diecut_report.declaration.texts import parsed
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.chapters import Chapter
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.figures import Bars, Drawing, Figure, Plot, Polar
from diecut_report.mechanism.inputs import Inputs, fields
from diecut_report.mechanism.mechanism import Erratum, Mechanism, Profile, Source
from diecut_report.mechanism.steps import Step
from diecut_report.mechanism.steps.base import FOR_READERS, tuple_faults
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, phrase

ID = re.compile(r"[A-Za-z_]\w*(\.\w+)*")
NO_ID = phrase("is not an id; write letters, digits and underscores")
RESERVED = ("inputs", "checks")
HOLDS = {
    "chapters": Chapter,
    "checks": Check,
    "figures": Figure,
    "exports": Profile,
    "sources": Source,
    "errata": Erratum,
}
TEXTS = ("kind", "version", "title", "summary")


def faults(mechanism: Mechanism) -> list[Fault]:
    """Return what has not the shape that the contract names."""
    found = [fault(mechanism, text, place) for place, text in _of_mechanism(mechanism)]
    for chapter in () if found else mechanism.chapters:
        found += [fault(chapter, text) for text in tuple_faults(chapter, "needs")]
        found += [fault(step, text) for step in chapter.steps for text in _of_step(step)]
    nameless = [check for check in mechanism.checks if not ID.fullmatch(check.id)] if not found else []
    return found + [fault(check, NO_ID) for check in nameless]


def _of_mechanism(mechanism: Mechanism) -> Iterator[tuple[str, str]]:
    """What has another shape, each with its place: of a class that is not an Inputs its own, else that of the mechanism."""
    for name in TEXTS:
        if not isinstance(given := getattr(mechanism, name), str):
            yield mechanism.at, Phrase("has {name}={given}; write a text in quotes", name=name, given=repr(given))
    model: Any = mechanism.inputs
    if not (isinstance(model, type) and issubclass(model, Inputs)):
        kind = model if isinstance(model, type) else type(model)
        given = kind.__name__ if kind is model else repr(model)
        template = (
            "has inputs={given}; give the class of its inputs, which is a subclass of Inputs: class {name}(Inputs)"
        )
        place = of_class(kind, mechanism.at) if kind is model else mechanism.at
        yield place, Phrase(template, given=given, name=kind.__name__)
    for name, kind in HOLDS.items():
        given = getattr(mechanism, name)
        several = given if isinstance(given, tuple | list) else None
        strange = [given] if several is None else [each for each in several if not isinstance(each, kind)]
        if strange:
            at = getattr(strange[0], "at", "")
            where = f", {type(strange[0]).__name__}" + (Phrase(" (at {place})", place=short(at)) if at else "")
            template = "has {name} of another kind{where}; write a tuple of {kind}, with a comma behind a single one: {name}=(…,)"
            yield mechanism.at, Phrase(template, name=name, where=where, kind=kind.__name__)


def _of_step(step: Step) -> Iterator[str]:
    if not ID.fullmatch(step.id):
        yield NO_ID
    elif step.id in RESERVED or iskeyword(step.id):  # inputs.KEY is a name; a formula takes a step as its argument
        template = "has a name that is reserved; choose another one than {reserved} or a word of Python"
        yield Phrase(template, reserved=", ".join(RESERVED))
    if step.digits < 1:
        yield Phrase("has digits={digits}; at least one digit is printed", digits=repr(step.digits))
    yield from tuple_faults(step, "needs", "lacks")
    for name in FOR_READERS:
        if name != "unit" and not isinstance(given := getattr(step, name), str):  # units are told for themselves
            yield Phrase("has {name}={given}; write a text in quotes", name=name, given=reprlib.repr(given))
    wrong = list(step.shape_faults())
    yield from wrong
    for each in () if wrong else step.formulas():
        yield from _of_formula(each.formula)


def _of_formula(part: object) -> Iterator[str]:
    if isinstance(part, Formula) and part.defaults:
        template = (
            "takes the formula {formula}, whose parameters have a default; each takes a quantity: remove the default"
        )
        yield Phrase(template, formula=part.__name__)


# What a plugin's files define twice under one name: Python keeps the last and says nothing.


Defined = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
MEANT = {"overload", "setter", "getter", "deleter", "register"}  # by which a name is defined again on purpose


def doubled_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield functions, classes and fields that are defined twice at one level of a file, and keys that stand twice in a table."""
    for file in sorted(file for file in files(names.mechanism) if file.suffix == ".py"):
        yield from _doubled(file, parsed(file))


@lru_cache(maxsize=512)
def _doubled(file: Path, tree: ast.Module) -> tuple[Fault, ...]:
    """What stands twice in a file, which is gone through once for all that it declares."""
    return (*_twice(file, tree), *_keys_twice(file, tree))


def _keys_twice(file: Path, tree: ast.Module) -> Iterator[Fault]:
    for table in ast.walk(tree):
        seen: dict[str, int] = {}
        for key in table.keys if isinstance(table, ast.Dict) else ():
            if not isinstance(key, ast.Constant | ast.Tuple):
                continue
            written = ast.unparse(key)
            if written in seen:
                template = "stands twice in a table, at first in line {line}, and only the last one counts; take one of them away"
                yield Fault(
                    f"{file}:{key.lineno}", Phrase("key {key}", key=written), Phrase(template, line=seen[written])
                )
            seen.setdefault(written, key.lineno)


def _twice(file: Path, scope: ast.Module | Defined) -> Iterator[Fault]:
    seen: dict[str, int] = {}
    for statement in scope.body:
        name = _name(statement, isinstance(scope, ast.ClassDef))
        if name and name in seen:
            template = "twice, at first in line {line}, and only the last one counts; give one of them another name, or take it away"
            is_field = isinstance(statement, ast.AnnAssign | ast.Assign)
            text = Phrase(
                "is a field {told}" if is_field else "is defined {told}", told=Phrase(template, line=seen[name])
            )
            yield Fault(f"{file}:{statement.lineno}", name, text)
        if name:
            seen[name] = statement.lineno
        if isinstance(statement, Defined):
            yield from _twice(file, statement)


def _name(statement: ast.stmt, of_class: bool) -> str:
    """The name that a statement defines; empty where it may be defined again."""
    match statement:
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            marks = {getattr(mark, "attr", getattr(mark, "id", "")) for d in statement.decorator_list for mark in ast.walk(d)}  # fmt: skip
            return "" if marks & MEANT or statement.name == "_" else statement.name
        case ast.AnnAssign(target=ast.Name(id=name)) | ast.Assign(targets=[ast.Name(id=name)], value=ast.Call()) if (
            of_class
        ):
            return name
    return ""


# Units that are none: nothing that is measured in one can be judged, so that they are told before all else is asked.


def unknown_units_faults(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield each unit of an input, a step, a check or a figure that nobody knows."""
    for path, meta in fields(mechanism.inputs):
        for text in _unknown([getattr(meta, "unit", "1"), *(own for _, own in getattr(meta, "units", ()))]):
            yield Fault(of_input(mechanism.inputs, path, mechanism.at), Phrase("input {path}", path=path), text)
    for _, step in mechanism.steps:
        for text in _unknown([step.unit, *(own for _, own in step.units)]):
            yield fault(step, text)
    for check in mechanism.checks:
        yield from (fault(check, text) for text in _unknown([check.unit] if check.unit else []))
    for figure in mechanism.figures:
        for text in _unknown(_drawn(figure)):
            yield fault(figure, text)


def _unknown(units: Iterable[object]) -> Iterator[str]:
    for text in dict.fromkeys(units):
        if not isinstance(text, str):
            yield Phrase('has the unit {text}; write a text, "mm"', text=repr(text))
            continue
        try:
            unit(text)
        except ValueError as unknown:
            yield Phrase("has the unit {text}: {unknown}", text=repr(text), unknown=unknown)


def _drawn(figure: Figure) -> list[str]:
    match figure:
        case Plot(panels=panels):
            return [panel.unit for panel in panels]
        case Bars(groups=groups):
            return [group.unit for group in groups]
        case Polar() | Drawing():
            return [figure.unit]
    return []
