"""What is known of a formula's function from its code: its definition, its place, and the formulas that it may call."""

from __future__ import annotations

import ast
import inspect
import linecache
from collections.abc import Callable, Iterator, Mapping
from textwrap import dedent
from types import CodeType, ModuleType
from typing import Any


class FormulaError(TypeError):
    """A formula's body holds something that cannot be printed: a mistake of the plugin's author."""


def definition(code: CodeType) -> ast.FunctionDef:
    """Return the definition of a function, read from its own lines alone: to parse whole files costs more than a short run may."""
    lines = linecache.getlines(code.co_filename)
    first, last = code.co_firstlineno, max(line for *_, line in code.co_lines() if line)
    for end in range(last, len(lines) + 1):  # brackets may close below the last line that does something
        try:
            found = ast.parse("\n" * (first - 1) + dedent("".join(lines[first - 1 : end])))
        except SyntaxError:
            continue
        read = found.body[0]
        if isinstance(read, ast.FunctionDef):
            return read
    raise FormulaError(f"{code.co_filename}:{first}: the source of formula {code.co_name} cannot be read")


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
