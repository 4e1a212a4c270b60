"""Chapters and families of steps that a plugin's file declares, and that no mechanism holds: they would be left out in silence."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.sources import files_around, own_files, parsed
from diecut_report.declaration.words import Fault
from diecut_report.languages.phrases import Phrase, phrase

CALLS = ("Chapter", "Steps")


class Defined(NamedTuple):
    """A chapter or a family of steps that a file defines under a name, in some of its lines."""

    name: str
    call: ast.Call
    line: int
    until: float  # the line that gives the name to another one

    @property
    def is_chapter(self) -> bool:
        """Whether it is a chapter."""
        return _called(self.call) == "Chapter"


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the chapters and families that are filled, and then named nowhere."""
    for file in own_files(mechanism):
        for defined in _definitions(parsed(file)):
            if _is_filled(parsed(file), defined) and not _is_named(mechanism, file, defined):
                yield _fault(file, defined)


def _fault(file: Path, defined: Defined) -> Fault:
    place, name = f"{file}:{defined.line}", defined.name
    lost = phrase("so that its steps are never calculated")
    if not defined.is_chapter:
        return Fault(
            place,
            Phrase("steps {name}", name=name),
            Phrase("is added to no chapter, {lost}; write chapter.add({name})", lost=lost, name=name),
        )
    title = defined.call.args[0] if defined.call.args else None
    subject = Phrase("chapter {title}", title=ast.unparse(title) if title else name)
    instead = Phrase("name {name} in chapters=(…) of the Mechanism", name=name)
    if defined.until != float("inf"):
        instead = Phrase(
            "line {until} calls another one {name}: give one of them another name, and name both in chapters=(…)",
            until=defined.until,
            name=name,
        )
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


def _is_filled(tree: ast.Module, defined: Defined) -> bool:
    """Whether anything is declared in it."""
    return any(_fills(s, defined.name) and defined.line < s.lineno < defined.until for s in tree.body)


def _fills(statement: ast.stmt, name: str) -> bool:
    match statement:
        case ast.Expr(value=ast.Call(func=ast.Attribute(value=ast.Name(id=head)))):
            return head == name
    return False


def _is_named(mechanism: Mechanism, file: Path, defined: Defined) -> bool:
    """Whether anything else is said of it than what is declared in it."""
    own = [s for s in parsed(file).body if defined.line < s.lineno < defined.until]
    if any(_may_name(s, defined.name) and _names(s, defined.name) > _fills(s, defined.name) for s in own):
        return True
    others = [each for each in files_around(mechanism) if each != file] if defined.until == float("inf") else []
    return any(_may_name(s, defined.name) and _names(s, defined.name) for each in others for s in parsed(each).body)


def _may_name(statement: ast.stmt, name: str) -> bool:
    return not _words(statement).isdisjoint((name, "*"))


@lru_cache(maxsize=1024)
def _words(statement: ast.AST) -> frozenset[str]:
    """All that a name could be in it: what has none of it need not be gone through for each name."""
    words = {getattr(node, key, None) for node in ast.walk(statement) for key in ("id", "attr", "name", "value")}
    return frozenset(word for word in words if isinstance(word, str))


def _names(node: ast.AST, name: str) -> int:
    """How often a name stands in it: as such, of a module, imported, or in ``__all__``; not as the parameter of a function."""
    match node:
        case ast.Lambda(args=args) | ast.FunctionDef(args=args) if any(
            name == each.arg for each in ast.walk(args) if isinstance(each, ast.arg)
        ):
            return 0
        case ast.Assign(targets=[ast.Name(id="__all__")]):
            return sum(getattr(each, "value", None) == name for each in ast.walk(node))
    own = name in (getattr(node, "id", None), getattr(node, "attr", None))
    imported = isinstance(node, ast.alias) and node.name in (name, "*")
    return own + imported + sum(_names(each, name) for each in ast.iter_child_nodes(node))
