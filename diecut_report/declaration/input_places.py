"""Where inputs are declared: the class, and the line in it."""

from __future__ import annotations

import inspect

from diecut_report.contract.inputs import Block, nested


def of_class(declared: type, otherwise: str) -> str:
    """Return ``file:line`` of a class, or another place where it has no file."""
    try:
        return f"{inspect.getsourcefile(declared)}:{inspect.getsourcelines(declared)[1]}"
    except (OSError, TypeError):  # made without a file
        return otherwise


def of_field(model: type[Block], name: str, otherwise: str) -> str:
    """Return the line that declares an input: annotations may be texts that pydantic reads, so that they know no place themselves."""
    for owner in model.__mro__:
        if name in inspect.get_annotations(owner):
            try:
                lines, first = inspect.getsourcelines(owner)
            except OSError:  # made without a file
                return otherwise
            for number, line in enumerate(lines, first):
                if line.strip().startswith(f"{name}:"):
                    return f"{inspect.getsourcefile(owner)}:{number}"
    return otherwise


def of_input(model: type[Block], path: str, otherwise: str) -> str:
    """Return the line that declares the input of a path (``gears.driver_teeth``)."""
    head, _, rest = path.partition(".")
    inner = nested(model.model_fields[head].annotation) if rest else None
    return of_input(inner[0], rest, otherwise) if inner else of_field(model, head, otherwise)
