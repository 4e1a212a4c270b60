"""What is known of a formula's function from its code: its body as syntax, its place, and the formulas that it may call.

Only the function's own lines are read: to parse whole files costs more than a short run may.
"""

from __future__ import annotations

import ast
import inspect
import linecache
from collections.abc import Callable, Iterator, Mapping
from textwrap import dedent
from types import CodeType, ModuleType
from typing import Any

from diecut_report.languages.phrases import phrase

LAMBDA = "<lambda>"
CHANGED = phrase("its place in the file holds something else; was the file changed?")
Place = tuple[int, int]  # line from 1, column from 0 in bytes


class FormulaError(TypeError):
    """A formula's body holds something that cannot be printed: a mistake of the plugin's author."""


class Unreadable(Exception):
    """The source cannot be found, or is not what runs; the text says why."""


def body(code: CodeType) -> list[ast.stmt]:
    """Return the statements of a function (of a lambda the one ``return``), with the line numbers of their file.

    Raises ``Unreadable``.
    """
    lines = linecache.getlines(code.co_filename)
    if not lines:
        raise Unreadable(phrase("there is no such file"))
    return [_returned(code, lines)] if code.co_name == LAMBDA else _definition(code, lines).body


def _definition(code: CodeType, lines: list[str]) -> ast.FunctionDef:
    first, last = code.co_firstlineno, max(line for *_, line in code.co_lines() if line)
    for end in range(last, len(lines) + 1):  # brackets may close below the last line that does something
        try:
            found = ast.parse("\n" * (first - 1) + dedent("".join(lines[first - 1 : end])))
        except SyntaxError:
            continue
        definition = found.body[0]
        if isinstance(definition, ast.FunctionDef):
            return definition
    raise Unreadable(phrase("its lines are not a function"))


def _returned(code: CodeType, lines: list[str]) -> ast.Return:
    """What a lambda returns: its instructions tell where it begins and ends, also among others on one line."""
    span = _span(code)
    value = _number(code) if span is None else _expression(code, lines, *span)
    return ast.copy_location(ast.Return(value), value)


def _span(code: CodeType) -> tuple[Place, Place] | None:
    """First and last place of what a code does; None where nothing has a place, as Python 3.12 has none for a number alone."""
    begins, ends = set[Place](), set[Place]()
    for line, last_line, column, last_column in code.co_positions():
        if line and last_line and column is not None and last_column and (line, column) != (last_line, last_column):
            begins.add((line, column))
            ends.add((last_line, last_column))
    return (min(begins), max(ends)) if begins else None


def _number(code: CodeType) -> ast.expr:
    numbers = [value for value in code.co_consts if isinstance(value, int | float)]
    if len(numbers) != 1 or code.co_names or code.co_argcount:
        raise Unreadable(
            phrase("this Python was told to keep no columns (PYTHONNODEBUGRANGES); write a def with @formula")
        )
    return ast.Constant(numbers[0], lineno=code.co_firstlineno, col_offset=0)


def _expression(code: CodeType, lines: list[str], begin: Place, end: Place) -> ast.expr:
    text = _between(lines, begin, end)
    try:
        value = ast.parse("\n" * (begin[0] - 1) + f"({text}\n)", mode="eval").body
    except SyntaxError:
        raise Unreadable(CHANGED) from None
    nodes = list(ast.walk(value))
    names = {n.id for n in nodes if isinstance(n, ast.Name)} | {n.attr for n in nodes if isinstance(n, ast.Attribute)}
    if names - set(code.co_varnames) - set(code.co_freevars) != set(code.co_names):
        raise Unreadable(CHANGED)
    return value


def _between(lines: list[str], begin: Place, end: Place) -> str:
    chosen = [line.encode() for line in lines[begin[0] - 1 : end[0]]]
    chosen[-1] = chosen[-1][: end[1]]
    chosen[0] = chosen[0][begin[1] :]
    return b"".join(chosen).decode()


def place(function: Callable[..., Any]) -> str:
    """Return ``file:line`` of a function."""
    code = inspect.unwrap(function).__code__
    return f"{code.co_filename}:{code.co_firstlineno}"


def perhaps_named(function: Callable[..., Any], kind: type) -> Iterator[Any]:
    """Give the values of a type that a function may name, as globals or by way of a module, at no cost.

    They may be too many: of ``np.sqrt`` the code tells no more than that both names stand in it.
    """
    space, names = function.__globals__, function.__code__.co_names
    spaces = [space, *(vars(space[name]) for name in names if isinstance(space.get(name), ModuleType))]
    for each in spaces:
        yield from (each[name] for name in names if isinstance(each.get(name), kind))


def given_to(function: Callable[..., Any], args: tuple[Any, ...], named: Mapping[str, Any]) -> dict[str, Any]:
    """Return what each parameter of a function is given by a call, by position, by name or by default, in their order.

    Raises TypeError in words where the call does not fit.
    """
    call = inspect.signature(function).bind(*args, **named)
    call.apply_defaults()
    return call.arguments
