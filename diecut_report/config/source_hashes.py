"""The hash of the code that calculates: of the program, of each plugin, of each extension.

Results of one version may come from other code: a plugin that is being written, the program in an editable checkout. A hash
covers the names and bytes of the files, wherever they lie; compiled files do not count. Tables that a plugin reads while it is
loaded belong to its code where they lie in its folder.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

from diecut_report.config.yaml import printable
from diecut_report.files import code_below, code_of
from diecut_report.mechanism.mechanism import Mechanism

PACKAGE = Path(__file__).parents[1]
PLUGINS = "diecut_report.plugins"
ASIDE = ("plugins", "templates", "configs")  # plugins have hashes of their own, the others calculate nothing


@dataclass
class PluginCode:
    """Hold what is known of the code of a mechanism's plugin: its hash and, unless it is the program's own, its file's name.

    ``faults`` is what is wrong with its formulas, which may still be used; None where that was not judged.
    """

    sha256: str = ""
    file: str = ""
    faults: tuple[str, ...] | None = None


_known: WeakKeyDictionary[Mechanism, PluginCode] = WeakKeyDictionary()
LIBRARIES = tuple(
    os.path.join(each, "")
    for each in {sys.prefix, sys.base_prefix, *map(os.path.realpath, (sys.prefix, sys.base_prefix))}
)
_reading: list[list[str]] = []  # of each module that is being loaded, the files that were opened meanwhile
_read: dict[Path, dict[str, str]] = {}  # of each module that was loaded, the tables that it read with their names
_when_loaded: dict[Path, str] = {}  # a module that is loaded stays as it was, whatever becomes of its file


@cache
def program_hash() -> str:
    """Return the SHA-256 of the program's own code and tables, as they were when this was first asked."""
    shared = Path(import_module(PLUGINS).__path__[0]).glob("*.py")
    own = code_below(str(PACKAGE), "program/", without=ASIDE)
    return _digest([*own, *((f"plugins/{path.name}", str(path)) for path in shared)])


def _code(mechanism: Mechanism | None) -> PluginCode:
    return _known.get(mechanism, PluginCode()) if mechanism else PluginCode()


def plugin_hash(mechanism: Mechanism | None) -> str:
    """Return the SHA-256 of the code of a mechanism's plugin; nothing for one that was not loaded as a plugin."""
    return _code(mechanism).sha256


def plugin_code(mechanism: Mechanism | None) -> dict[str, str]:
    """Return what results hold of the code of a mechanism's plugin: its hash and, unless it is the program's own, its file and check."""
    code = _code(mechanism)
    found = {"plugin_sha256": code.sha256} | ({"plugin_file": code.file} if code.file else {})
    return found if code.faults is None else found | {"plugin_check": "failed" if code.faults else "passed"}


def plugin_faults(mechanism: Mechanism | None) -> tuple[str, ...]:
    """Return what is wrong with the formulas of a foreign plugin; nothing where that was not judged."""
    return _code(mechanism).faults or ()


def note_check(mechanism: Mechanism, faults: tuple[str, ...]) -> None:
    """Note what is wrong with the formulas of a foreign plugin, which may still be used."""
    code = _known.setdefault(mechanism, PluginCode())
    code.faults = faults if code.faults is None else code.faults


def note_plugin(mechanism: Mechanism, digest: str, foreign: Path | None) -> None:
    """Note the hash of the code that a mechanism and its comparisons come from, and the file of one that is not the program's own.

    Of the file its name is kept, with the folder of a package, and not where it lies: that is the business of its user.
    """
    name = printable("/".join(foreign.parts[-2 if foreign.name == "__init__.py" else -1 :])) if foreign else ""
    for each in (mechanism, *(comparison.mechanism for comparison in mechanism.comparisons)):
        _known.setdefault(each, PluginCode(digest, name))


def note_same_code(made: Mechanism, of: Mechanism) -> None:
    """Note that a mechanism comes from the code of another one, of which it is a part."""
    _known.setdefault(made, _code(of))


def module_hash(file: Path) -> str:
    """Return the SHA-256 of a module's code, as it was when this was first asked."""
    if file not in _when_loaded:
        code = {os.path.abspath(path): name for name, path in code_of(file)}
        _when_loaded[file] = _digest((name, path) for path, name in (_read.get(file, {}) | code).items())
    return _when_loaded[file]


@contextmanager
def noting_what_is_read(file: Path) -> Iterator[None]:
    """Note which files of its folder a module reads while it is loaded: its numbers are from them, too."""
    folder = os.path.join(os.path.abspath(file.parent), "")
    opened: list[str] = []
    _add_hook()
    _reading.append(opened)
    try:
        yield
    finally:
        _reading.remove(opened)
        tables = {path for path in opened if path.startswith(folder) and not path.endswith((".py", ".pyc"))}
        tables = {path for path in tables if not path.startswith(LIBRARIES)}  # which may lie below the folder
        _read[file] = {path: path.removeprefix(folder) for path in tables if os.path.isfile(path)}


@cache
def _add_hook() -> None:
    sys.addaudithook(_note_opened)  # which stays for good


def _note_opened(event: str, arguments: tuple[Any, ...]) -> None:
    if event == "open" and isinstance(arguments[0], str):
        for opened in _reading:
            opened.append(os.path.abspath(arguments[0]))


def file_of(module: str) -> Path:
    """Return the file of the whole package that a module of an installed package belongs to."""
    found = sys.modules[module.partition(".")[0]]
    return Path(found.__file__ or f"{found.__path__[0]}/__init__.py")


def _digest(files: Iterable[tuple[str, str]]) -> str:
    """Return one hash of files by their names: the same wherever they lie."""
    whole = sha256()
    for name, path in sorted(files):
        with open(path, "rb", buffering=0) as file:
            content = file.readall()
        whole.update(f"{name}\0{len(content)}\0".encode())
        whole.update(content)
    return whole.hexdigest()
