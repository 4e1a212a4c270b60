"""Changes one thing in what computes, runs the tests of that plugin or module, and counts how many changes a test notices.

    .venv/bin/python -m pip install cosmic-ray           # once; it makes the mutants and is needed for nothing else
    .venv/bin/python scripts/mutate.py [--count N | --all] [--seed S] [--only NAME …] [--log FILE] [--list] [--report]

Mutated are the bodies of functions and lambdas in ``plugins/`` and in ``diecut_report/mechanics/``: operators, comparisons (to the
opposite, and with the bound taken in or out), numbers, conditions, loops. Not mutated is what draws, words, advises or declares
(``OTHER_WORK``), nor a text; nor is an operator put in the place of another that no number takes (``+`` to ``>>``): such a mutant only
flatters the count. A sample is drawn from all mutants alike and is the same for the same seed and sources, so that its share of killed
mutants is that of all, but for chance.

Each mutant lives in a copy; the checkout is never touched. It meets the tests that ``change_signs.py`` would run, in a fork that has nearly all
imported (``mutant_runs.py``), which takes some seconds. With ``--log`` a run that was stopped goes on where it was; ``--report`` only counts
what the log holds. A mutant whose tests take far longer than without it is killed too, and counted as one by time.
"""

from __future__ import annotations

import argparse
import ast
import json
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from math import inf, sqrt
from pathlib import Path
from typing import Any

from change_signs import is_of_quantities
from mutant_runs import KILLED, OPEN, SURVIVED, TIMEOUT, Server, in_server, prepared
from unit_tests import ROOT, units

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
NOTICED = (KILLED, TIMEOUT)
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
        elif is_of_quantities(node):
            inside.append(span(node, lines))
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
    random.Random(arguments.seed).shuffle(found)  # a smaller sample is the beginning of a larger one
    return found[:count]


# --- runs ------------------------------------------------------------------------------------------------------------


def read(log: Path) -> dict[str, dict[str, str]]:
    """What an earlier run found, by the mutant."""
    lines = log.read_text("utf-8").splitlines() if log.exists() else []
    return {found["mutant"]: found for found in map(json.loads, lines)}


def try_all(some: list[Mutant], log: Path, most: float) -> None:
    """Find what becomes of the mutants, unit by unit; what the log holds is not tried again, unless it stayed open and time is not bounded."""
    known = read(log)
    left = [mutant for mutant in some if mutant.key not in known or (known[mutant.key]["fate"] == OPEN and most == inf)]
    with tempfile.TemporaryDirectory() as work:
        copy = prepared(Path(work))
        for unit in sorted({mutant.unit for mutant in left}):
            in_server(copy, unit, most, partial(try_those, [mutant for mutant in left if mutant.unit == unit], log))


def try_those(some: list[Mutant], log: Path, server: Server) -> None:
    """Find what becomes of mutants of one plugin or module, and write it into the log."""
    for mutant in some:
        fate, by = server.fate(mutant.file, mutant.text)
        found = {"mutant": mutant.key, "unit": mutant.unit, "fate": fate, "change": mutant.change, "by": by}
        print(fate, mutant.key, by or mutant.change, flush=True)
        with log.open("a", encoding="utf-8") as file:
            file.write(json.dumps(found, ensure_ascii=False) + "\n")


def report(found: Iterable[dict[str, str]]) -> None:
    """Print the counts of each plugin and module as a table, and the survivors."""
    rows = list(found)
    counts = Counter((row["unit"], row["fate"]) for row in rows)
    print("\n| plugin or module | mutants | killed | of them by time | survived | open |\n|---|---|---|---|---|---|")
    for unit in [*sorted({row["unit"] for row in rows}), "all"]:
        of = {
            fate: sum(n for (u, f), n in counts.items() if f == fate and unit in (u, "all"))
            for fate in (KILLED, TIMEOUT, SURVIVED, OPEN)
        }
        print(
            f"| {unit} | {sum(of.values())} | {of[KILLED] + of[TIMEOUT]} | {of[TIMEOUT]} | {of[SURVIVED]} | {of[OPEN]} |"
        )
    low, high = interval(sum(row["fate"] in NOTICED for row in rows), len(rows))
    print(f"\n95 % interval of the share that is killed: {low:.1%} to {high:.1%}\n")
    print(*(f"{row['mutant']}: {row['change']}" for row in rows if row["fate"] not in NOTICED), sep="\n")


def interval(killed: int, count: int) -> tuple[float, float]:
    """The 95 % interval of a share, by Wilson."""
    share, z = killed / count, 1.96
    middle, half = share + z**2 / (2 * count), z * sqrt(share * (1 - share) / count + (z / (2 * count)) ** 2)
    return (middle - half) / (1 + z**2 / count), (middle + half) / (1 + z**2 / count)


def main() -> int:
    """Try the mutants that were asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=100, metavar="N", help="mutants in the sample (100)")
    parser.add_argument("--all", action="store_true", help="every mutant")
    parser.add_argument("--seed", type=int, default=0, help="draws another sample (0)")
    parser.add_argument("--only", nargs="*", metavar="NAME", help="plugins, or modules as mechanics.NAME")
    parser.add_argument(
        "--seconds",
        type=float,
        default=inf,
        help="the tests of a mutant may take so long; what they did not notice stays open",
    )
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
    with tempfile.TemporaryDirectory() as folder:
        log = arguments.log or Path(folder) / "log"
        try_all(some, log, arguments.seconds)
        found = read(log)
    report(found[mutant.key] for mutant in some)
    return int(any(found[mutant.key]["fate"] not in NOTICED for mutant in some))


if __name__ == "__main__":
    raise SystemExit(main())
