"""What a plugin's files define twice under one name: Python keeps the last and says nothing."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.remembered import files
from diecut_report.declaration.sources import parsed
from diecut_report.declaration.words import Fault
from diecut_report.languages.phrases import Phrase

Defined = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
MEANT = {
    "overload",
    "setter",
    "getter",
    "deleter",
    "register",
}  # decorators by which a name is defined again on purpose


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield functions, classes and fields that are defined twice at one level of a file."""
    for file in sorted(file for file in files(mechanism) if file.suffix == ".py"):
        yield from _twice(file, parsed(file))


def _twice(file: Path, scope: ast.Module | Defined) -> Iterator[Fault]:
    seen: dict[str, int] = {}
    for statement in scope.body:
        name = _name(statement, isinstance(scope, ast.ClassDef))
        if name and name in seen:
            told = "twice, at first in line {line}, and only the last one counts; give one of them another name, or take it away"
            is_field = isinstance(statement, ast.AnnAssign)
            text = Phrase("is a field {told}" if is_field else "is defined {told}", told=Phrase(told, line=seen[name]))
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
        case ast.AnnAssign(target=ast.Name(id=name)) if of_class:
            return name
    return ""
