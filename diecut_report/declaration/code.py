"""The code of a plugin: what it imports, what its functions ask for beside what they take, which texts it makes, and what was found of it."""

from __future__ import annotations

import ast
import builtins
import hashlib
import os
import re
import sys
from collections import ChainMap
from collections.abc import Iterator
from contextlib import suppress
from functools import cache, cached_property, lru_cache, partial
from importlib import import_module
from inspect import getclosurevars
from pathlib import Path
from threading import get_ident
from types import CodeType, FunctionType, MethodType, ModuleType
from typing import Any

import numpy as np

from diecut_report import __version__, api
from diecut_report.declaration.names import DeclaredNames, Fault, declared_in
from diecut_report.declaration.texts import DeclaredText, own_files, parsed
from diecut_report.files import cache_folder, code_of
from diecut_report.formulas.expression import Quantities
from diecut_report.mechanism.figures import Chart, Drawing
from diecut_report.mechanism.inputs import fields, keys
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.text.phrases import Phrase, named, phrase

# Imports: all of the program but its api and its mechanics may change from one version to the next.


PROGRAM = "diecut_report"
ALLOWED = (f"{PROGRAM}.api", f"{PROGRAM}.mechanics")


def import_faults(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield the imports of other modules of the program by a plugin's own files."""
    for file in own_files(mechanism):
        for line, module, names in _imports(parsed(file)):
            if module.split(".")[0] == PROGRAM and not any(f"{module}.".startswith(f"{each}.") for each in ALLOWED):
                public = ", ".join(name for name in names if name in api.__all__)
                template = "import {public} from {allowed}"
                instead = Phrase(template, public=public, allowed=ALLOWED[0]) if public else phrase("do without it")
                template = "a plugin may import {allowed} of the program, nothing else; {instead}"
                text = Phrase(template, allowed=named(ALLOWED, " and "), instead=instead)
                yield Fault(f"{file}:{line}", Phrase("import of {module}", module=module), text)


def _imports(tree: ast.AST) -> Iterator[tuple[int, str, list[str]]]:
    """Each import of a file, but those for type checkers: its line, the module, and the names that are taken from it."""
    for node in ast.iter_child_nodes(tree):
        match node:
            case ast.Import(names=names):
                yield from ((node.lineno, alias.name, []) for alias in names)
            case ast.ImportFrom(module=module, names=names, level=0) if module == PROGRAM:
                yield from ((node.lineno, f"{PROGRAM}.{alias.name}", []) for alias in names)
            case ast.ImportFrom(module=str() as module, names=names, level=0):
                yield node.lineno, module, [alias.name for alias in names]
            case ast.If(test=test, orelse=other) if "TYPE_CHECKING" in ast.unparse(test):
                yield from (found for each in other for found in _imports(ast.Module([each], [])))
            case _:
                yield from _imports(node)


# Plain code that takes more than it is given, the clock, chance, a file or the surroundings: equal inputs would give unlike results.


CLOCK, CHANCE = phrase("the clock"), phrase("chance")
FILE, AROUND = phrase("a file"), phrase("what is around the program")
END, ENDS = "end", {"_exit", "abort", "execv", "execve", "kill"}  # what ends the program, of the module os
LEAVE, LEAVES = "leave", {"chdir", "fchdir", "chroot"}  # what leaves the working folder
OF_MODULE = {"time": CLOCK, "random": CHANCE, "secrets": CHANCE, "uuid": CHANCE, "numpy.random": CHANCE,
             "io": FILE, "_io": FILE, "linecache": FILE, "tempfile": FILE, "glob": FILE, "shutil": FILE,
             "platform": AROUND, "socket": AROUND, "_socket": AROUND, "resource": AROUND, "ctypes": AROUND,
             "getpass": AROUND, "email.utils": CLOCK, "urllib.request": AROUND, "locale": AROUND}  # fmt: skip
NOW = {"now", "today", "utcnow"}  # of a date
# Of a path, known by their names alone.
READERS = {"read_text", "read_bytes", "open", "exists", "is_file", "is_dir", "iterdir", "rglob"}
DRAWN = "rvs"  # what a distribution of SciPy calls its numbers by chance
SEARCHES = {"differential_evolution", "dual_annealing", "basinhopping"}  # of SciPy, by chance, without one of
BEGINNINGS = {"seed", "rng", "random_state"}
OF_RUN = (hash, id, get_ident)  # other numbers in each run
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
    "getmtime",
    "getatime",
    "getctime",
    "getsize",
    "isfile",
    "isdir",
}
SYSTEM = ("os", "posix", "nt", "posixpath", "ntpath", "genericpath")
FUNCTIONS = ("function", "joints", "lines")
CALLED = (FunctionType, partial, MethodType)
METHODS = (FunctionType, staticmethod, classmethod, property, cached_property)
Scope = ChainMap[str, Any]
Used = tuple[ast.expr, str]  # where something is asked for, and what it is


def impure_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what the functions of steps and drawings ask for beside what they take, and the files themselves when they are loaded."""
    files = {str(file): file for file in own_files(names.mechanism)}
    for function in _functions(names.mechanism, set(files)):
        file, code = files[function.__code__.co_filename], function.__code__
        for node in _definitions(parsed(file)).get(code.co_firstlineno, ()):
            for where, what in _used(node, _scope(function)):
                yield _fault(file, where, what, code.co_name)
            for where in _quantities(node, _scope(function)):
                template = "uses {quantity}, a quantity of formulas, which plain code does not know; take its number: {takes}, in a drawing {view}"
                told = {
                    "quantity": ast.unparse(where),
                    "takes": f'takes=("{where.attr}",)',
                    "view": f'view["{where.attr}"]',
                }
                yield Fault(
                    f"{file}:{where.lineno}", Phrase("function {name}", name=code.co_name), Phrase(template, told)
                )
            for where in _of_loops(parsed(file), node):
                template = "takes {name} of the loop around it, which is the last one when it is called; write functools.partial(function, {name})"
                subject = Phrase("function {name}", name=code.co_name)
                yield Fault(f"{file}:{where.lineno}", subject, Phrase(template, name=where.id))
    loaded = {getattr(each, "__file__", None): vars(each) for each in [*sys.modules.values()][::-1]}
    for name, file in files.items():
        for where, what in _used_at_load(parsed(file), loaded.get(name, {})):
            yield _fault(file, where, what, phrase("the module"))


def _of_loops(tree: ast.Module, node: ast.AST) -> Iterator[ast.Name]:
    """The names in a function that a loop around it gives: all that it makes would take the last of them."""
    own = {each.arg for each in ast.walk(node) if isinstance(each, ast.arg)}
    own |= {each.id for each in ast.walk(node) if isinstance(each, ast.Name) and not isinstance(each.ctx, ast.Load)}
    given = {
        each.id
        for loop in _loops(tree)
        if any(each is node for each in ast.walk(loop))
        for each in ast.walk(loop.target)
        if isinstance(each, ast.Name)
    } - own
    body = getattr(node, "body", node)
    for part in body if isinstance(body, list) else [body]:
        yield from (each for each in ast.walk(part) if isinstance(each, ast.Name) and each.id in given)


@lru_cache(maxsize=512)
def _loops(tree: ast.Module) -> list[ast.For]:
    return [each for each in ast.walk(tree) if isinstance(each, ast.For)]


def _quantities(node: ast.AST, scope: Scope) -> Iterator[ast.Attribute]:
    """The quantities in a function, which are taken by the name that gives them; it may have that name for something of its own."""
    own = {each.id for each in ast.walk(node) if isinstance(each, ast.Name) and not isinstance(each.ctx, ast.Load)}
    own |= {each.arg for each in ast.walk(node) if isinstance(each, ast.arg)}
    for each in ast.walk(node):
        match each:
            case ast.Attribute(value=ast.Name(id=name)) if name not in own and isinstance(scope.get(name), Quantities):
                yield each


def _fault(file: Path, where: ast.expr, what: str, name: str) -> Fault:
    template = "uses {what} ({code}), so that equal inputs give different results; take it as an input, or read a table when the module is loaded"
    if what == END:
        template = "ends the whole program ({code}) without a message to the user; raise Refusal(…), or an exception"
    if what == LEAVE:
        template = "leaves the working folder of the program ({code}), so that reports are written elsewhere; name files by their absolute path"
    text = Phrase(template, what=what, code=ast.unparse(where))
    return Fault(f"{file}:{where.lineno}", Phrase("function {name}", name=name), text)


def _functions(mechanism: Mechanism, files: set[str]) -> Iterator[FunctionType]:
    """The plugin's own functions and methods that steps and drawings call, and those that these name."""
    given = [getattr(step, name, None) for _, step in mechanism.steps for name in FUNCTIONS]
    drawn = [figure for figure in mechanism.figures if isinstance(figure, Drawing | Chart)]
    given += [getattr(figure, name, None) for figure in drawn for name in ("build", "moving")]
    waiting, known = [own for each in given for own in _behind(each)], set()
    while waiting:
        function = waiting.pop()
        if function in known or function.__code__.co_filename not in files:
            continue
        known.add(function)
        yield function
        named = [_scope(function).get(name) for name in _names(function.__code__)]
        waiting += [own for each in named for own in _behind(each)]


def _names(code: CodeType) -> Iterator[str]:
    """The names that a function asks for, in its lambdas, comprehensions and own functions, too."""
    yield from code.co_names
    yield from code.co_freevars
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from _names(inner)


def _behind(value: Any) -> Iterator[FunctionType]:
    """The functions that are run where something is called or asked: itself, what it wraps, and the methods of its class."""
    match value:
        case FunctionType():
            yield value
            yield from _behind(getattr(value, "__wrapped__", None))
        case partial(func=inner) | np.vectorize(pyfunc=inner) | MethodType(__func__=inner):
            yield from _behind(inner)
        case staticmethod(__func__=inner) | classmethod(__func__=inner) | property(fget=inner):
            yield from _behind(inner)
        case ModuleType() | None:
            return
        case dict() | tuple() | list():
            for each in value.values() if isinstance(value, dict) else value:
                yield from _behind(each) if isinstance(each, CALLED) else ()
        case cached_property(func=inner):
            yield from _behind(inner)
        case _ if isinstance(getattr(value, "__wrapped__", None), FunctionType):  # what functools.cache makes
            yield from _behind(value.__wrapped__)
        case _:
            own = value if isinstance(value, type) else type(value)
            bases = [vars(base) for base in own.__mro__ if base.__module__ != "builtins"]
            for each in getattr(value, "__dict__", {}).values() if own is not value else ():
                yield from _behind(each) if isinstance(each, CALLED) else ()
            methods = (method for base in bases for name, method in base.items() if name != "__hash__")
            yield from (found for each in methods if isinstance(each, METHODS) for found in _behind(each))


@lru_cache(maxsize=512)
def _definitions(tree: ast.Module) -> dict[int, list[ast.AST]]:
    """What is defined in each line: a function, from its decorator on, or the lambdas in it."""
    found: dict[int, list[ast.AST]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.Lambda):
            decorators = getattr(node, "decorator_list", [])
            found.setdefault(min([node.lineno, *(each.lineno for each in decorators)]), []).append(node)
    return found


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
                for a in aliases:
                    whole, head = _module(a.name), a.name.partition(".")[0]
                    own |= {a.asname: whole} if a.asname else {head: sys.modules.get(head)}
            case ast.ImportFrom(module=str() as module, names=aliases, level=0):
                home = _module(module)
                own |= {
                    a.asname or a.name: getattr(home, a.name, None) or _module(f"{module}.{a.name}") for a in aliases
                }
    yield from _asked(node, scope.new_child(own))


def _module(name: str) -> ModuleType | None:
    """Return a module as a function would import it; None where it cannot."""
    try:
        return import_module(name)
    except Exception:  # what the function will tell when it runs
        return None


def _used_at_load(tree: ast.Module, scope: dict[str, Any]) -> Iterator[Used]:
    """What a file asks for when it is loaded; a table that it reads then is the same for all."""
    for statement in tree.body:
        if not isinstance(statement, ast.FunctionDef | ast.ClassDef | ast.Import | ast.ImportFrom):
            asked = _asked(statement, ChainMap(scope, vars(builtins)))
            yield from (found for found in asked if found[1] in (CLOCK, CHANCE, END, LEAVE))


def _asked(node: ast.AST, scope: Scope) -> Iterator[Used]:
    """Of each name, with what is asked of it, what it stands for; chance that begins with a number of its own is none."""
    match node:
        case ast.FunctionDef() | ast.Lambda():
            pass
        case ast.Call(func=ast.Attribute(attr=attr)) if attr in READERS:
            yield node.func, FILE
        case ast.Call(func=ast.Attribute(attr=attr), keywords=given) if attr == DRAWN and not _begins(given):
            yield node.func, CHANCE
        case ast.Call(func=func, keywords=given) if _is_search(_value(func, scope)) and not _begins(given):
            yield func, CHANCE
        case ast.Call(func=func, args=[ast.Constant(value=text), *_]) if (
            text in NOW and _value(func, scope) is np.datetime64
        ):
            yield func, CLOCK
        case ast.Call(func=func, args=[_, *_]) if getattr(_value(func, scope), "__name__", "") in SEEDED:
            return
        case ast.Attribute() | ast.Name() if found := _of(_value(node, scope)):
            yield node, found
            return
    for child in ast.iter_child_nodes(node):
        yield from _asked(child, scope)


def _begins(given: list[ast.keyword]) -> bool:
    """Whether chance begins with a number that is given, so that it is the same each time."""
    return any(each.arg in BEGINNINGS and getattr(each.value, "value", "") is not None for each in given)


def _is_search(value: Any) -> bool:
    return getattr(value, "__name__", "") in SEARCHES and str(getattr(value, "__module__", "")).startswith("scipy.")


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
    of_system = getattr(value, "__module__", "") in SYSTEM
    if of_system and name in ENDS | LEAVES:
        return END if name in ENDS else LEAVE
    if any(value is each for each in OF_RUN):
        return CHANCE
    if value is os.environ or value is sys.argv or (of_system and name in OF_SYSTEM):
        return AROUND
    homes = {str(getattr(each, "__module__", None)) for each in (value, type(value), type(owner))}
    homes |= {owner.__name__} if isinstance(owner, ModuleType) else set()
    found = (what for home, what in OF_MODULE.items() if any(f"{each}.".startswith(f"{home}.") for each in homes))
    return next(found, "")


# Texts that a plugin's code makes: string constants inside functions, those of phrases among them, found in the syntax tree.


WORDS = re.compile(r"(?<![\w{.])[A-Za-z][a-z'’-]+(?![\w}(])")
NAMES = re.compile(r"[\w.{}\[\],:+/*-]*")
JOINING = re.compile(r"[\s,;]*(?:and|or)[\s,;]*")
LABELS = {"label": 1, "mark": 2, "level": 1, "vertical": 1, "line": 2, "fill": 2, "point": 2, "arrow": 3, "dimension": 3, "phrase": 0,
          "radius_dimension": 3, "box": 3}  # fmt: skip
"""Functions that draw, each with the place of its words; and that which marks a text."""
SILENT_CALLS = {"Source", "ValueError", "TypeError", "KeyError", "AssertionError", "RuntimeError"}
SILENT_KEYWORDS = {"source", "sources", "needs", "lacks", "id", "symbol", "unit", "role", "anchor"}


def code_texts(folder: Path) -> Iterator[DeclaredText]:
    """Yield each text of the Python files of a plugin (a folder, or one file) once."""
    seen = set()
    for file, finder in _searched(folder):
        for text in finder.found:
            if text not in seen:
                seen.add(text)
                yield DeclaredText(text, file.name)


def fixed_texts(folder: Path) -> Iterator[DeclaredText]:
    """Yield the templates of f-strings in functions: what is not declared, but made for one machine, cannot be translated so."""
    for file, finder in _searched(folder):
        yield from (DeclaredText(text, file.name) for text in finder.made)


def _searched(folder: Path) -> Iterator[tuple[Path, _Finder]]:
    for file in sorted(folder.rglob("*.py")) if folder.is_dir() else [folder]:
        finder = _Finder()
        finder.visit(ast.parse(file.read_text("utf-8"), str(file)))
        yield file, finder


class _Finder(ast.NodeVisitor):
    """Collect the texts of functions."""

    def __init__(self) -> None:
        self.depth = 0
        self.found: list[str] = []
        self.made: list[str] = []

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        self.depth += 1
        for part in node.body[1:] if ast.get_docstring(node, clean=False) else node.body:
            self.visit(part)
        self.depth -= 1

    def visit_Call(self, node: ast.Call) -> None:
        name = getattr(node.func, "id", "")
        if name in SILENT_CALLS:
            return
        self._note_label(node, name)
        if not self.depth and name == "Phrase":  # a lambda's, in a declaration
            self.found += [text for each in node.args[:1] for text in _spoken(each) if WORDS.search(text)]
        self.visit(node.func)
        for argument in node.args:
            self.visit(argument)
        for keyword in node.keywords:
            if keyword.arg not in SILENT_KEYWORDS:
                self.visit(keyword.value)

    def _note_label(self, node: ast.Call, name: str) -> None:
        """Note the words beside what is drawn, which may be a single one."""
        if (self.depth or name == "phrase") and name in LABELS:
            said = node.args[LABELS[name] :][:1]
            said += [each.value for each in node.keywords if each.arg in ("label", "text", "lines")]
            self.found += [text for each in said for text in _spoken(each) if WORDS.fullmatch(text) or name == "phrase"]

    def visit_Assign(self, node: ast.Assign) -> None:
        """Visit what is assigned; of a quantity what gives it and its description: symbol, unit and source are no words."""
        is_quantity = isinstance(node.targets[0], ast.Attribute | ast.Subscript) and isinstance(node.value, ast.Tuple)
        for place, part in enumerate(node.value.elts if isinstance(node.value, ast.Tuple) else [node.value]):
            if not is_quantity or place in (0, 3):
                self.visit(part)

    def visit_Subscript(self, node: ast.Subscript) -> None:
        self.visit(node.value)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        self._note(template(node), self.made)
        for part in node.values:
            if isinstance(part, ast.FormattedValue):
                self.visit(part.value)

    def visit_Constant(self, node: ast.Constant) -> None:
        if isinstance(node.value, str):
            self._note(node.value, self.found)

    def _note(self, text: str, kept: list[str]) -> None:
        is_name = NAMES.fullmatch(text) and not text[:1].isupper()
        if self.depth and WORDS.search(text) and not JOINING.fullmatch(text) and not is_name:
            kept.append(text)


def _spoken(part: ast.expr) -> Iterator[str]:
    """The constant texts of which a label is one, or is put together."""
    match part:
        case ast.Constant(value=str() as text):
            yield text
        case ast.IfExp(body=first, orelse=other) | ast.BinOp(left=first, right=other):
            yield from (*_spoken(first), *_spoken(other))
        case ast.List(elts=parts) | ast.Tuple(elts=parts):
            yield from (text for each in parts for text in _spoken(each))


def template(node: ast.JoinedStr) -> str:
    """Return an f-string with a name for each of its parts."""
    names: dict[str, str] = {}
    text = ""
    for part in node.values:
        if isinstance(part, ast.FormattedValue):
            text += f"{{{_placeholder(part.value, names)}}}"
        elif isinstance(part, ast.Constant):
            text += str(part.value)
    return text


def _placeholder(value: ast.expr, names: dict[str, str]) -> str:
    """The name of a part: equal parts share one."""
    written = ast.unparse(value)
    if written not in names:
        name = _name(value)
        taken = sum(re.fullmatch(rf"{name}(_\d+)?", other) is not None for other in names.values())
        names[written] = f"{name}_{taken + 1}" if taken else name
    return names[written]


def _name(value: ast.expr) -> str:
    match value:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name.lstrip("_").lower()
        case ast.Subscript(slice=ast.Constant(value=str() as name)):
            return name
        case ast.Subscript(value=inner) | ast.Starred(value=inner) | ast.FormattedValue(value=inner):
            return _name(inner)
        case ast.Call(args=[ast.Constant(value=str() as name), *_]) if name.isidentifier():
            return name
        case ast.Call(
            func=ast.Attribute(attr="join") | ast.Name(id="told" | "below" | "sum" | "max" | "min"), args=[inner, *_]
        ):
            return _name(inner)
        case (
            ast.BinOp(left=ast.Constant(), right=inner)
            | ast.BinOp(left=inner)
            | ast.UnaryOp(operand=inner)
            | ast.Call(func=inner)
        ):
            return _name(inner)
        case ast.IfExp(body=first, orelse=other) if not (
            isinstance(first, ast.Constant) and isinstance(other, ast.Constant)
        ):
            return _name(other if isinstance(first, ast.Constant) else first)
        case ast.JoinedStr(values=parts):
            return next((_name(part.value) for part in parts if isinstance(part, ast.FormattedValue)), "text")
    return "text"


# What the check of a plugin found: by the content of its files, in the user's folder for what can be made again.


OWN = Path(__file__).parents[1]


def content(mechanism: Mechanism) -> str:
    """Return the SHA-256 of all that the check of a plugin follows from: its files, its allowed texts, and the check itself."""
    found = hashlib.sha256(__version__.encode())
    texts = [(key.path, key.texts) for key in keys(mechanism.inputs).values()]
    found.update(repr((mechanism.kind, texts)).encode())
    for file in sorted({*files(mechanism)}):
        found.update(_named_content(file))
    found.update(_own_content())
    return found.hexdigest()


def _named_content(file: Path) -> bytes:
    return str(file).encode() + hashlib.sha256(file.read_bytes()).digest()


@cache
def _own_content() -> bytes:
    """Of the check itself, which stays as it is while it runs."""
    own = (file for part in ("declaration", "mechanism", "formulas") for file in (OWN / part).rglob("*.py"))
    return b"".join(map(_named_content, sorted(own)))


def remembered(folder: str, key: str) -> bytes | None:
    """Return what was found of a plugin of this content before; None where that is not known."""
    home = cache_folder(folder)
    with suppress(OSError):
        return (home / key).read_bytes() if home else None
    return None


def remember(folder: str, key: str, found: str = "") -> None:
    """Note what was found of a plugin of this content; where it cannot be noted it is judged again the next time."""
    home = cache_folder(folder)
    with suppress(OSError):
        if home:
            home.mkdir(parents=True, exist_ok=True)
            (home / key).write_text(found, "utf-8")


def files(mechanism: Mechanism) -> Iterator[Path]:
    """Give the files in which anything of a mechanism is declared, and all others of their code."""
    for file in {Path(place.rpartition(":")[0]) for place in _places(mechanism)}:
        if not file.is_file():
            continue
        yield file
        if file.suffix == ".py" and not file.is_relative_to(OWN):
            package = file.with_name("__init__.py")
            yield from (Path(path) for _, path in code_of(package if package.is_file() else file))


def _places(mechanism: Mechanism) -> Iterator[str]:
    beside = (
        *mechanism.sources,
        *mechanism.comparisons,
        *mechanism.spectra,
        *(meta for _, meta in fields(mechanism.inputs)),
    )
    yield from (part.at for part in (*declared_in(mechanism), *beside))
    for _, step in mechanism.steps:
        tables = (each for each in (getattr(step, "table", None), getattr(step, "series", None)))
        yield from (
            f"{each.file}:" for each in tables if isinstance(each, StandardTable | StandardSeries) and each.file
        )
        yield from (formula.place for each in step.formulas() for formula in each.options)
    for comparison in mechanism.comparisons:
        yield from _places(comparison.mechanism)
