"""Plain code that takes more than it is given, the clock, chance, a file or the surroundings: equal inputs would give unlike results."""

from __future__ import annotations

import ast
import builtins
import os
import sys
from collections import ChainMap
from collections.abc import Iterator
from inspect import getclosurevars
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from diecut_report.contract.figures import Chart, Drawing
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.sources import own_files, parsed
from diecut_report.declaration.words import Fault
from diecut_report.languages.phrases import Phrase, phrase

CLOCK, CHANCE = phrase("the clock"), phrase("chance")
FILE, AROUND = phrase("a file"), phrase("what is around the program")
OF_MODULE = {"time": CLOCK, "random": CHANCE, "secrets": CHANCE, "uuid": CHANCE, "numpy.random": CHANCE,
             "io": FILE, "_io": FILE, "tempfile": FILE, "glob": FILE, "shutil": FILE,
             "platform": AROUND, "socket": AROUND,
             "urllib.request": AROUND, "locale": AROUND}  # fmt: skip
NOW = {"now", "today", "utcnow"}  # of a date
READERS = {"read_text", "read_bytes"}  # of a path, which is known by its name alone
TABLES = {"load", "loadtxt", "genfromtxt", "fromfile", "memmap"}  # of NumPy
SEEDED = {"default_rng", "Random", "RandomState"}  # with a number to begin with they give the same each time
OF_SYSTEM = {
    "getenv",
    "getcwd",
    "listdir",
    "scandir",
    "walk",
    "stat",
    "getpid",
    "times",
    "urandom",
    "cpu_count",
    "getlogin",
    "uname",
}
FUNCTIONS = ("function", "joints", "lines")
Scope = ChainMap[str, Any]
Used = tuple[ast.expr, str]  # where something is asked for, and what it is


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what the functions of steps and drawings ask for beside what they take, and the files themselves when they are loaded."""
    files = {str(file): file for file in own_files(mechanism)}
    for function in _functions(mechanism, set(files)):
        file, code = files[function.__code__.co_filename], function.__code__
        for node in _definitions(parsed(file), code.co_firstlineno):
            for where, what in _used(node, _scope(function)):
                yield _fault(file, where, what, code.co_name)
    for file in files.values():
        module = next((each for each in [*sys.modules.values()] if getattr(each, "__file__", "") == str(file)), None)
        for where, what in _used_at_load(parsed(file), vars(module) if module else {}):
            yield _fault(file, where, what, phrase("the module"))


def _fault(file: Path, where: ast.expr, what: str, name: str) -> Fault:
    text = Phrase(
        "asks {what} ({code}), so that equal inputs give unlike results; take it as an input, or read a table when the module is loaded",
        what=what,
        code=ast.unparse(where),
    )
    return Fault(f"{file}:{where.lineno}", Phrase("function {name}", name=name), text)


def _functions(mechanism: Mechanism, files: set[str]) -> Iterator[FunctionType]:
    """The plugin's own functions that steps and drawings call, and those that these name."""
    given = [getattr(step, name, None) for _, step in mechanism.steps for name in FUNCTIONS]
    given += [figure.build for figure in mechanism.figures if isinstance(figure, Drawing | Chart)]
    waiting, known = [each for each in given if isinstance(each, FunctionType)], set()
    while waiting:
        function = waiting.pop()
        if function in known or function.__code__.co_filename not in files:
            continue
        known.add(function)
        yield function
        named = (_scope(function).get(name) for name in function.__code__.co_names)
        waiting += [each for each in named if isinstance(each, FunctionType)]


def _definitions(tree: ast.Module, line: int) -> Iterator[ast.AST]:
    """What is defined in a line: a function, from its decorator on, or the lambdas in it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.Lambda):
            decorators = getattr(node, "decorator_list", [])
            if min([node.lineno, *(each.lineno for each in decorators)]) == line:
                yield node


def _scope(function: FunctionType) -> Scope:
    """What the names in a function stand for, as far as it does not give them itself."""
    try:
        closed = dict(getclosurevars(function).nonlocals)
    except ValueError:  # a variable that is not there yet
        closed = {}
    own = dict.fromkeys(function.__code__.co_varnames)
    return ChainMap({**own, **closed}, function.__globals__, vars(builtins))


def _used(node: ast.AST, scope: Scope) -> Iterator[Used]:
    """What a function asks for; modules that it imports itself are known in it."""
    own: dict[str, Any] = {}
    for each in ast.walk(node):
        match each:
            case ast.Import(names=aliases):
                own |= {
                    a.asname or a.name.partition(".")[0]: sys.modules.get(a.name.partition(".")[0]) for a in aliases
                }
            case ast.ImportFrom(module=str() as module, names=aliases):
                home = sys.modules.get(module)
                own |= {a.asname or a.name: getattr(home, a.name, None) for a in aliases}
    yield from _asked(node, scope.new_child(own))


def _used_at_load(tree: ast.Module, scope: dict[str, Any]) -> Iterator[Used]:
    """What a file asks for when it is loaded; a table that it reads then is the same for all."""
    for statement in tree.body:
        if not isinstance(statement, ast.FunctionDef | ast.ClassDef | ast.Import | ast.ImportFrom):
            yield from (
                found for found in _asked(statement, ChainMap(scope, vars(builtins))) if found[1] in (CLOCK, CHANCE)
            )


def _asked(node: ast.AST, scope: Scope) -> Iterator[Used]:
    """Of each name, with what is asked of it, what it stands for; chance that begins with a number of its own is none."""
    match node:
        case ast.FunctionDef() | ast.Lambda():
            pass
        case ast.Call(func=ast.Attribute(attr=attr)) if attr in READERS:
            yield node.func, FILE
        case ast.Call(func=func, args=[_, *_]) if getattr(_value(func, scope), "__name__", "") in SEEDED:
            return
        case ast.Attribute() | ast.Name() if found := _of(_value(node, scope)):
            yield node, found
            return
    for child in ast.iter_child_nodes(node):
        yield from _asked(child, scope)


def _value(node: ast.expr, scope: Scope) -> Any:
    match node:
        case ast.Name(id=name):
            return scope.get(name)
        case ast.Attribute(value=of, attr=attr):
            home = _value(of, scope)
            return getattr(home, attr, None) if isinstance(home, ModuleType | type) else None
    return None


def _of(value: Any) -> str:
    """What something gives that is no module itself; empty where it gives nothing of its own."""
    if value is None or isinstance(value, ModuleType | str | int | float | tuple):
        return ""
    name, owner = getattr(value, "__name__", ""), getattr(value, "__self__", None)
    if name == "sleep":  # it tells nothing
        return ""
    if isinstance(owner, type) and name in NOW:
        return CLOCK
    if name in TABLES and getattr(value, "__module__", "") in ("numpy", "numpy.lib._npyio_impl", "numpy.lib.npyio"):
        return FILE
    if value is os.environ or (name in OF_SYSTEM and getattr(value, "__module__", "") in ("os", "posix", "nt")):
        return AROUND
    homes = {str(getattr(each, "__module__", None)) for each in (value, type(value), type(owner))}
    homes |= {owner.__name__} if isinstance(owner, ModuleType) else set()
    found = (what for home, what in OF_MODULE.items() if any(f"{each}.".startswith(f"{home}.") for each in homes))
    return next(found, "")
