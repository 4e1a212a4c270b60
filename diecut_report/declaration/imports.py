"""Imports of what is not a plugin's: all of the program but its api and its mechanics may change from one version to the next."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from diecut_report import api
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.sources import own_files, parsed
from diecut_report.declaration.words import Fault
from diecut_report.languages.phrases import Phrase, named, phrase

PROGRAM = "diecut_report"
ALLOWED = (f"{PROGRAM}.api", f"{PROGRAM}.mechanics")


def faults(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield the imports of other modules of the program by a plugin's own files."""
    for file in own_files(mechanism):
        for line, module, names in _imports(parsed(file)):
            if module.split(".")[0] == PROGRAM and not any(f"{module}.".startswith(f"{each}.") for each in ALLOWED):
                public = [name for name in names if name in api.__all__]
                instead = (
                    Phrase("import {public} from {allowed}", public=", ".join(public), allowed=ALLOWED[0])
                    if public
                    else phrase("do without it")
                )
                text = Phrase(
                    "a plugin may import {allowed} of the program, nothing else; {instead}",
                    allowed=named(ALLOWED, " and "),
                    instead=instead,
                )
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
