"""What goes into an error that a user sees is a phrase, so that it can be said in another language."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2] / "diecut_report"
DONE = (
    "cli",
    "config",
    "conditions",
    "design",
    "live",
    "drafting",
    "exchange/signing*",
    "exchange/verification*",
    "optimisation",
    "quantities",
    "given_files*",
    "kit",
    "pipeline*",
    "scripting",
)
ERRORS = {"Problem", "UnitError", "ConditionError", "BadParameter", "UsageError", "Unresolved"}
WORDS = re.compile(r"[A-Za-z]{2,}[,;:]? [a-z]{2,}")
FILES = sorted({file for part in DONE for file in [*ROOT.glob(f"{part}/*.py"), *ROOT.glob(f"{part}.py")]})


def fixed(file: Path) -> Iterator[str]:
    """The texts that are handed to an error without a phrase, also by a name that has one value alone."""
    tree = ast.parse(file.read_text("utf-8"))
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            named = {
                t.id: n.value
                for n in ast.walk(function)
                if isinstance(n, ast.Assign)
                for t in n.targets
                if isinstance(t, ast.Name)
            }
            for call in ast.walk(function):
                if isinstance(call, ast.Call) and call.args and _name(call.func) in ERRORS:
                    first = call.args[0]
                    yield from _texts(named.get(first.id, first) if isinstance(first, ast.Name) else first)


def _name(function: ast.expr) -> str:
    return (
        function.id if isinstance(function, ast.Name) else function.attr if isinstance(function, ast.Attribute) else ""
    )


def _texts(given: ast.expr) -> Iterator[str]:
    match given:
        case ast.Constant(value=str() as text):
            found = text
        case ast.JoinedStr(values=parts):
            found = "".join(str(part.value) if isinstance(part, ast.Constant) else "…" for part in parts)
        case _:
            return
    if WORDS.search(found):
        yield found


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_errors_are_made_of_phrases(file: Path) -> None:
    assert list(fixed(file)) == []
