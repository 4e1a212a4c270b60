"""Changes one sign in a formula, runs the tests of that plugin, and demands that one fails: what shows that tests are strong.

    .venv/bin/python scripts/change_signs.py [--per-plugin N | --all] [--seed S] [--only NAME …] [--jobs N] [--log FILE] [--list]

A formula is an expression of quantities (``m.ID``), the body of a function under ``@formula``, or a lambda, in ``plugins/`` and in
``diecut_report/mechanics/``. One ``+`` becomes ``-``, ``-`` becomes ``+``, ``*`` becomes ``/`` or ``/`` becomes ``*``; a leading
minus becomes a plus. Each mutant lives in a copy; the checkout is never touched. With ``--log`` a run that was stopped goes on where
it was: what was noticed in the same file is not tried again, what survived is, as it may have a test now. A test that fails with a
change must pass without it.
Ends with 1 where a mutant survives, or where a test fails as it is.
"""

from __future__ import annotations

import argparse
import ast
import compileall
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from hashlib import sha256
from pathlib import Path
from py_compile import PycInvalidationMode
from queue import SimpleQueue
from threading import Lock

from unit_tests import ROOT, tests_asked, tests_of, units

OTHER = {ast.Add: (b"+", b"-"), ast.Sub: (b"-", b"+"), ast.Mult: (b"*", b"/"), ast.Div: (b"/", b"*")}


@dataclass(frozen=True)
class Mutant:
    """A place in a file, with the bytes there and those that replace them."""

    unit: str
    file: Path
    line: int
    start: int
    old: bytes
    new: bytes

    @property
    def text(self) -> bytes:
        """The file with the change."""
        source = self.file.read_bytes()
        return source[: self.start] + self.new + source[self.start + len(self.old) :]

    @property
    def key(self) -> list[str | int]:
        """What names it in the log: another file, or a place that has moved, is another mutant."""
        digest = sha256(self.file.read_bytes()).hexdigest()[:16]
        return [str(self.file.relative_to(ROOT)), digest, self.start, self.new.decode()]

    def __str__(self) -> str:
        line = self.file.read_text("utf-8").splitlines()[self.line - 1].strip()
        return f"{self.file.relative_to(ROOT)}:{self.line}: {self.old.decode()} → {self.new.decode()} in: {line}"


# --- places ----------------------------------------------------------------------------------------------------------


def mutants(unit: str, file: Path) -> Iterator[Mutant]:
    """All changes of one sign in the formulas of a file."""
    source = file.read_bytes()
    starts = [0, *(match.end() for match in re.finditer(rb"\n", source))]
    seen: set[int] = set()
    for formula in formulas(ast.parse(source)):
        for node in ast.walk(formula):
            for line, start, old, new in changes(node, source, starts):
                if start not in seen:
                    seen.add(start)
                    yield Mutant(unit, file, line, start, old, new)


def formulas(tree: ast.Module) -> Iterator[ast.AST]:
    """The expressions that are formulas: of quantities, bodies of lambdas, and of functions under ``@formula``."""
    for node in ast.walk(tree):
        if is_of_quantities(node):
            yield node
        elif isinstance(node, ast.Lambda):
            yield node.body
        elif isinstance(node, ast.FunctionDef) and any(map(is_formula, node.decorator_list)):
            yield from node.body


def is_of_quantities(node: ast.AST) -> bool:
    """Whether a node calculates with quantities, ``m.ID``."""
    is_operation = isinstance(node, ast.BinOp | ast.UnaryOp | ast.Compare)
    return is_operation and any(isinstance(part, ast.Name) and part.id == "m" for part in ast.walk(node))


def is_formula(decorator: ast.expr) -> bool:
    """Whether a decorator is ``@formula``, called or not."""
    named = decorator.func if isinstance(decorator, ast.Call) else decorator
    return (named.attr if isinstance(named, ast.Attribute) else getattr(named, "id", "")) == "formula"


def changes(node: ast.AST, source: bytes, starts: list[int]) -> Iterator[tuple[int, int, bytes, bytes]]:
    """The change of a sum, product or leading minus: its line, its place in the file, the old bytes and the new ones."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield node.lineno, starts[node.lineno - 1] + node.col_offset, b"-", b"+"
    if isinstance(node, ast.BinOp) and type(node.op) in OTHER:
        old, new = OTHER[type(node.op)]
        left, right = node.left, node.right
        assert left.end_lineno is not None and left.end_col_offset is not None
        end = starts[left.end_lineno - 1] + left.end_col_offset
        between = source[end : starts[right.lineno - 1] + right.col_offset]
        yield left.end_lineno, end + re.sub(rb"#[^\n]*", blank, between).index(old), old, new


def blank(match: re.Match[bytes]) -> bytes:
    """A comment as so many blanks."""
    return b" " * len(match[0])


# --- runs ------------------------------------------------------------------------------------------------------------


class Copy:
    """The program as it is installed, and the tests, in a folder of their own."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.program = folder, folder / "program" / "diecut_report"
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / "diecut_report", self.program, ignore=ignored)
        for name in ("plugins", "templates", "configs"):
            shutil.copytree(ROOT / name, self.program / name, ignore=ignored)
        shutil.copytree(ROOT / "tests", folder / "tests", ignore=ignored)
        shutil.copy(ROOT / "pyproject.toml", folder)
        hashed = PycInvalidationMode.CHECKED_HASH  # a file may change twice within a second
        compileall.compile_dir(str(self.folder), quiet=2, invalidation_mode=hashed)

    def place(self, file: Path) -> Path:
        """Where a file of the checkout is in the copy."""
        path = file.relative_to(ROOT)
        return self.folder / "program" / path if path.parts[0] == "diecut_report" else self.program / path

    def failing(self, unit: str) -> str:
        """The first test of the plugin or module that fails, or nothing; those of printed numbers come first."""
        return next(filter(None, map(self._failing, tests_asked(unit))), "")

    def _failing(self, arguments: list[str]) -> str:
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", *arguments]
        path = {"PYTHONPATH": str(self.folder / "program"), "HYPOTHESIS_PROFILE": "ci"}
        clean = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        done = subprocess.run(command, cwd=self.folder, env=clean | path, capture_output=True, text=True, check=False)
        if done.returncode > 2:  # neither passed nor failed, nor an import that a formula does not survive
            raise SystemExit(f"pytest ended with {done.returncode}:\n{done.stdout}{done.stderr}")
        told = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - |$)", done.stdout, re.MULTILINE)
        return told[1] if told else arguments[0] if done.returncode else ""

    def kills(self, mutant: Mutant) -> bool:
        """Whether a test notices the change: it fails with it, and not without."""
        place = self.place(mutant.file)
        whole = place.read_bytes()
        place.write_bytes(mutant.text)
        try:
            test = self.failing(mutant.unit)
        finally:
            place.write_bytes(whole)
        if test and self._failing([test]):
            raise SystemExit(f"{test} fails as it is")
        return bool(test)


class Log:
    """What was noticed, a line of JSON each, in a file or nowhere."""

    def __init__(self, file: Path | None) -> None:
        self.file, self.lock = file, Lock()
        lines = file.read_text("utf-8").splitlines() if file and file.exists() else []
        self.noticed = [entry["mutant"] for entry in map(json.loads, lines) if entry["noticed"]]

    def add(self, mutant: Mutant, is_noticed: bool) -> None:
        """Keep and tell what became of a mutant."""
        with self.lock:
            print("killed  " if is_noticed else "SURVIVES", mutant, flush=True)
            if self.file:
                with self.file.open("a", encoding="utf-8") as file:
                    entry = {"mutant": mutant.key, "unit": mutant.unit, "noticed": is_noticed, "told": str(mutant)}
                    file.write(json.dumps(entry, ensure_ascii=False) + "\n")


def chosen(arguments: argparse.Namespace) -> dict[str, list[Mutant]]:
    """The mutants to try, by plugin or module; fewer of each are some of more."""
    found = {}
    for unit, files in units().items():
        if not arguments.only or unit in arguments.only:
            everything = [mutant for file in files for mutant in mutants(unit, file)]
            random.Random(f"{arguments.seed} {unit}").shuffle(everything)
            found[unit] = everything if arguments.all else everything[: arguments.per_plugin]
    return {unit: some for unit, some in found.items() if some}


def tried(copies: SimpleQueue[Copy], log: Log, mutant: Mutant) -> bool:
    """Whether a mutant is noticed, by the tests of a copy that no other thread uses."""
    copy = copies.get()
    try:
        is_noticed = mutant.key in log.noticed or copy.kills(mutant)
    finally:
        copies.put(copy)
    if mutant.key not in log.noticed:
        log.add(mutant, is_noticed)
    return is_noticed


def survivors(some: list[Mutant], jobs: int, log: Log) -> list[Mutant]:
    """The mutants that no test notices."""
    with tempfile.TemporaryDirectory() as work, ThreadPoolExecutor(jobs) as pool:
        copies: SimpleQueue[Copy] = SimpleQueue()
        for number in range(jobs):
            copies.put(Copy(Path(work) / str(number)))
        noticed = pool.map(partial(tried, copies, log), some)
        return [mutant for mutant, is_noticed in zip(some, noticed, strict=True) if not is_noticed]


def main() -> int:
    """Try the mutants that were asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--per-plugin", type=int, default=1, metavar="N", help="mutants of each plugin and module (1)")
    parser.add_argument("--all", action="store_true", help="every mutant")
    parser.add_argument("--seed", type=int, default=0, help="draws other mutants (0)")
    parser.add_argument("--only", nargs="*", metavar="NAME", help="plugins, or modules as mechanics.NAME")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="plugins at a time (2)")
    parser.add_argument("--log", type=Path, help="a file that keeps what is found, for a run that goes on (JSON lines)")
    parser.add_argument("--list", action="store_true", help="list the mutants, and the tests of each plugin")
    arguments = parser.parse_args()
    asked = chosen(arguments)
    if arguments.list:
        print(
            "\n".join(
                f"{unit}: {' '.join(tests_of(unit))}\n  " + "\n  ".join(map(str, some)) for unit, some in asked.items()
            )
        )
        return 0
    wanted = [mutant for some in asked.values() for mutant in some]
    left, total = survivors(wanted, arguments.jobs, Log(arguments.log)), len(wanted)
    print(f"{total - len(left)} of {total} changes of a sign are noticed.")
    return 1 if left else 0


if __name__ == "__main__":
    raise SystemExit(main())
