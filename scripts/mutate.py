"""Changes one thing in what computes, runs the tests of that plugin or module, and counts how many changes a test notices.

    .venv/bin/python -m pip install cosmic-ray           # once; it makes the mutants and is needed for nothing else
    .venv/bin/python scripts/mutate.py [--count N | --all] [--seed S] [--only NAME …] [--log FILE] [--list] [--report]

Mutated are the bodies of functions and lambdas in ``plugins/`` and in ``diecut_report/mechanics/``: operators, comparisons (to the
opposite, and with the bound taken in or out), numbers, conditions, loops. Not mutated is what draws, words, advises or declares
(``OTHER_WORK``), nor a text; nor is an operator put in the place of another that no number takes (``+`` to ``>>``): such a mutant only
flatters the count. A sample is drawn from all mutants alike and is the same for the same seed and sources, so that its share of killed
mutants is that of all, but for chance.

Each mutant lives in a copy; the checkout is never touched. It runs in a fork of a process that has the libraries imported, with the tests that
``change_signs.py`` would run. With ``--log`` a run that was stopped goes on where it was; ``--report`` only counts what the log holds.
A mutant that takes more than four times the processor time that the tests take without one is killed too, and counted as a timeout.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import random
import resource
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from change_signs import ROOT, Copy, tests_asked, units

OTHER_WORK = ("__init__", "inputs", "checks", "sheet", "layout")
OTHER_ENDINGS = ("figures", "figure", "drawing", "advice", "table")
ARITHMETIC = {"Add": ("Sub", "Mul"), "Sub": ("Add", "Mul"), "Mul": ("Div", "Add"), "Div": ("Mul", "Sub"), "Pow": ("Mul", "Add"),
              "FloorDiv": ("Div", "Mul"), "Mod": ("Div", "Mul"), "BitAnd": ("BitOr",), "BitOr": ("BitAnd",)}  # fmt: skip
ORDERS = {
    "Lt": ("LtE", "GtE"),
    "LtE": ("Lt", "Gt"),
    "Gt": ("GtE", "LtE"),
    "GtE": ("Gt", "Lt"),
    "Eq": ("NotEq",),
    "NotEq": ("Eq",),
}
OPERATORS = (
    *(f"ReplaceBinaryOperator_{one}_{other}" for one, others in ARITHMETIC.items() for other in others),
    *(f"ReplaceComparisonOperator_{one}_{other}" for one, others in ORDERS.items() for other in others),
    *(f"ReplaceUnaryOperator_Delete_{one}" for one in ("USub", "Not", "Invert")),
    *("AddNot", "ReplaceAndWithOr", "ReplaceOrWithAnd", "ReplaceTrueWithFalse", "ReplaceFalseWithTrue"),
    *("NumberReplacer", "ReplaceBreakWithContinue", "ReplaceContinueWithBreak", "ZeroIterationForLoop"),
)
LIBRARIES = ("numpy", "scipy.optimize", "scipy.integrate", "scipy.interpolate", "scipy.linalg", "scipy.signal", "pydantic", "yaml",
             "click", "jinja2", "pyarrow", "duckdb", "matplotlib.figure")  # fmt: skip
MEMORY = 6_000_000_000  # bytes of addresses for a mutant that asks for more and more
KILLED, SURVIVED, TIMEOUT = "killed", "survived", "timeout"
Place = tuple[int, int]


@dataclass(frozen=True)
class Mutant:
    """A change that the tool makes: the operator, and which of its places in the file."""

    unit: str
    file: Path
    operator: str
    occurrence: int
    line: int

    @property
    def key(self) -> str:
        """What names it in the log."""
        return f"{self.file.relative_to(ROOT)}:{self.line} {self.operator} {self.occurrence}"

    @property
    def text(self) -> str:
        """The file with the change."""
        mutating, plugins = import_module("cosmic_ray.mutating"), import_module("cosmic_ray.plugins")
        operator = plugins.get_operator(f"core/{self.operator}")()
        return str(mutating.mutate_code(self.file.read_text("utf-8"), operator, self.occurrence))

    @property
    def change(self) -> str:
        """The line before and after."""
        before, after = self.file.read_text("utf-8").splitlines(), self.text.splitlines()
        changed = [(old.strip(), new.strip()) for old, new in zip(before, after, strict=False) if old != new]
        return "{} → {}".format(*changed[0]) if changed else "nothing changes"


# --- mutants ---------------------------------------------------------------------------------------------------------


def computing(file: Path) -> bool:
    """Whether a file computes, and does not draw, word or declare."""
    return file.stem not in OTHER_WORK and not file.stem.endswith(OTHER_ENDINGS)


def mutants(unit: str, file: Path) -> Iterator[Mutant]:
    """All that the tool makes of the bodies in a file."""
    source = file.read_text("utf-8")
    inside, outside = spans(source)
    tree = import_module("cosmic_ray.ast")
    nodes = list(tree.ast_nodes(tree.get_ast(source)))
    for name in OPERATORS:
        operator = import_module("cosmic_ray.plugins").get_operator(f"core/{name}")()
        places = (start for node in nodes for start, _ in operator.mutation_positions(node))
        for occurrence, start in enumerate(places):
            if within(start, inside) and not within(start, outside):
                yield Mutant(unit, file, name, occurrence, start[0])


def spans(source: str) -> tuple[list[tuple[Place, Place]], list[tuple[Place, Place]]]:
    """Where the bodies of functions and lambdas stand, and where texts and what is declared of a function within them."""
    lines = source.splitlines()
    inside, outside = [], []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef):
            inside += [span(statement, lines) for statement in node.body]
            outside += [span(part, lines) for part in (*node.decorator_list, *all_of(node.args), node.returns) if part]
        elif isinstance(node, ast.Lambda):
            inside.append(span(node.body, lines))
        elif isinstance(node, ast.JoinedStr | ast.Raise):
            outside.append(span(node, lines))
    return inside, outside


def all_of(arguments: ast.arguments) -> Iterator[ast.AST]:
    """What is declared of the arguments of a function: annotations and what they are without being given."""
    yield from (argument.annotation for argument in [*arguments.args, *arguments.kwonlyargs] if argument.annotation)
    yield from (default for default in [*arguments.defaults, *arguments.kw_defaults] if default)


def span(node: Any, lines: list[str]) -> tuple[Place, Place]:
    """Where a node begins and ends, in letters (the syntax tree counts bytes)."""

    def place(line: int, column: int) -> Place:
        return line, len(lines[line - 1].encode()[:column].decode())

    return place(node.lineno, node.col_offset), place(node.end_lineno, node.end_col_offset)


def within(place: Place, spans: Iterable[tuple[Place, Place]]) -> bool:
    """Whether a place lies in one of the spans."""
    return any(start <= place < end for start, end in spans)


def chosen(arguments: argparse.Namespace) -> list[Mutant]:
    """The mutants to try, in an order of chance."""
    asked = {unit: files for unit, files in units().items() if not arguments.only or unit in arguments.only}
    files = [(unit, file) for unit, paths in asked.items() for file in paths if computing(file)]
    found = [mutant for unit, file in files for mutant in mutants(unit, file)]
    print(f"{len(found)} mutants", file=sys.stderr)
    count = len(found) if arguments.all else min(arguments.count, len(found))
    return random.Random(arguments.seed).sample(found, count)


# --- runs ------------------------------------------------------------------------------------------------------------


class Tests:
    """The tests in a copy of the program, each run of them in a fork of this process."""

    def __init__(self, copy: Copy) -> None:
        self.copy = copy
        import compileall

        import_module("pytest")
        for name in LIBRARIES:
            import_module(name)
        hashed = import_module("py_compile").PycInvalidationMode.CHECKED_HASH  # a file may change twice within a second
        compileall.compile_dir(str(copy.folder), quiet=2, invalidation_mode=hashed)

    def fate(self, mutant: Mutant) -> str:
        """What becomes of a mutant."""
        seconds = self._seconds(mutant.unit)
        place = self.copy.place(mutant.file)
        whole = place.read_bytes()
        place.write_text(mutant.text, "utf-8")
        try:
            return next((fate for fate, _ in self._runs(mutant.unit, 4 * seconds + 20) if fate != SURVIVED), SURVIVED)
        finally:
            place.write_bytes(whole)

    @cache  # noqa: B019 - there is one of it
    def _seconds(self, unit: str) -> float:
        """The processor time of the tests without a mutant; they must pass."""
        found = list(self._runs(unit, 3600))
        if any(fate != SURVIVED for fate, _ in found):
            raise SystemExit(f"{unit}: the tests fail as they are")
        return max(seconds for _, seconds in found)

    def _runs(self, unit: str, seconds: float) -> Iterator[tuple[str, float]]:
        for arguments in tests_asked(unit):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            child = os.fork()
            if child == 0:
                self._pytest(arguments, int(seconds))
            status = os.waitpid(child, 0)[1]
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            if os.WIFSIGNALED(status):
                yield (TIMEOUT if os.WTERMSIG(status) == signal.SIGXCPU else KILLED), took
            else:
                yield (KILLED if os.WEXITSTATUS(status) else SURVIVED), took

    def _pytest(self, arguments: list[str], seconds: int) -> None:
        """Run tests and end this process."""
        code = 1
        try:
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            silent = os.open(os.devnull, os.O_RDWR)
            for stream in (0, 1, 2):
                os.dup2(silent, stream)
            os.chdir(self.copy.folder)
            os.environ |= {"PYTHONPATH": str(self.copy.program.parent), "HYPOTHESIS_PROFILE": "ci"}
            sys.dont_write_bytecode = True
            sys.path[0:1] = [str(self.copy.program.parent)]  # before the checkout's, in the place of scripts/
            pytest = import_module("pytest")
            code = int(pytest.main(["-x", "-q", "-n", "0", "-p", "no:cacheprovider", *arguments]))
        finally:
            os._exit(code)


def read(log: Path | None) -> dict[str, dict[str, str]]:
    """What an earlier run found, by the mutant."""
    lines = log.read_text("utf-8").splitlines() if log and log.exists() else []
    return {found["mutant"]: found for found in map(json.loads, lines)}


def try_all(some: list[Mutant], log: Path | None) -> dict[str, dict[str, str]]:
    """What becomes of the mutants; what the log holds is not tried again."""
    found = read(log)
    with tempfile.TemporaryDirectory() as work:
        tests = Tests(Copy(Path(work)))
        for mutant in some:
            if mutant.key in found:
                continue
            fate = tests.fate(mutant)
            found[mutant.key] = {"mutant": mutant.key, "unit": mutant.unit, "fate": fate, "change": mutant.change}
            print(fate, mutant.key, mutant.change if fate == SURVIVED else "", flush=True)
            if log:
                with log.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(found[mutant.key], ensure_ascii=False) + "\n")
    return found


def report(found: Iterable[dict[str, str]]) -> None:
    """Print the counts of each plugin and module as a table, and the survivors."""
    rows = list(found)
    counts = Counter((row["unit"], row["fate"]) for row in rows)
    print("\n| plugin or module | mutants | killed | of them by time | survived |\n|---|---|---|---|---|")
    for unit in [*sorted({row["unit"] for row in rows}), "all"]:
        of = {
            fate: sum(n for (u, f), n in counts.items() if f == fate and unit in (u, "all"))
            for fate in (KILLED, TIMEOUT, SURVIVED)
        }
        print(f"| {unit} | {sum(of.values())} | {of[KILLED] + of[TIMEOUT]} | {of[TIMEOUT]} | {of[SURVIVED]} |")
    print(*(f"{row['mutant']}: {row['change']}" for row in rows if row["fate"] == SURVIVED), sep="\n")


def main() -> int:
    """Try the mutants that were asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=100, metavar="N", help="mutants in the sample (100)")
    parser.add_argument("--all", action="store_true", help="every mutant")
    parser.add_argument("--seed", type=int, default=0, help="draws another sample (0)")
    parser.add_argument("--only", nargs="*", metavar="NAME", help="plugins, or modules as mechanics.NAME")
    parser.add_argument("--log", type=Path, help="a file that keeps what is found, for a run that goes on (JSON lines)")
    parser.add_argument("--list", action="store_true", help="only list the mutants")
    parser.add_argument("--report", action="store_true", help="only count what the log holds")
    arguments = parser.parse_args()
    if arguments.report:
        report(read(arguments.log).values())
        return 0
    some = chosen(arguments)
    if arguments.list:
        print(*(f"{mutant.key}: {mutant.change}" for mutant in some), sep="\n")
        return 0
    found = try_all(some, arguments.log)
    report(found[mutant.key] for mutant in some)
    return int(any(found[mutant.key]["fate"] == SURVIVED for mutant in some))


if __name__ == "__main__":
    raise SystemExit(main())
