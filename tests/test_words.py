"""The words of the program: how docstrings of what plugins import begin, and what messages do not say."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from typing import Any

from diecut_report import api
from diecut_report.formulas.formula import Formula
from tests.test_architecture import PROGRAM, tree, within

VERBS = {
    "Add", "Bind", "Calculate", "Check", "Choose", "Compute", "Count", "Declare", "Demand", "Describe", "Draw", "Find",
    "Give", "Hold", "Make", "Mark", "Name", "Raise", "Read", "Refuse", "Report", "Require", "Return", "Say", "Stand",
    "Take", "Tell", "Write", "Yield",
}  # fmt: skip


def documented(name: str, value: Any) -> Iterator[tuple[str, str]]:
    """What is public of an object of the program, with its docstring; dataclasses without one have their signature there."""
    text = inspect.getdoc(value)
    if text and not text.startswith(f"{name.rpartition('.')[2]}("):
        yield name, text
    if inspect.isclass(value):
        for part, member in vars(value).items():
            member = member.fget if isinstance(member, property) else getattr(member, "__func__", member)
            if not part.startswith("_") and inspect.isfunction(member) and member.__doc__:
                yield f"{name}.{part}", member.__doc__


def of_api() -> Iterator[tuple[str, str]]:
    for name in api.__all__:
        value = getattr(api, name)
        is_ours = getattr(value, "__module__", "").startswith("diecut_report.")
        if isinstance(value, Formula) or (is_ours and (inspect.isclass(value) or inspect.isfunction(value))):
            yield from documented(name, value)


def test_docstrings_of_what_plugins_import_begin_with_a_verb() -> None:
    found = dict(of_api())
    assert {"Chapter", "Steps.require", "reduction", "StandardTable", "arccos", "point"} <= found.keys()
    assert {name: text for name, text in found.items() if re.split(r"\W", text, maxsplit=1)[0] not in VERBS} == {}


def said(name: str) -> Iterator[tuple[str, str]]:
    """The texts of a module that are not docstrings, with their lines."""
    plain = {id(node.value) for node in ast.walk(tree(name)) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree(name)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in plain:
            yield f"{name}:{node.lineno}", node.value


def test_messages_say_is_not_a_instead_of_is_no() -> None:
    stiff = re.compile(r"(?<!there )(?<!There )\b(is|are) no (?!longer)")
    modules = [name for name in PROGRAM if not within(name, "diecut_report.plugins")]
    assert [(place, text) for name in modules for place, text in said(name) if stiff.search(text)] == []
