"""Signatures and docstrings of what is documented, as Markdown."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Iterator
from pathlib import PurePath
from typing import Any

from diecut_report.mechanism.steps import Step
from tools.site.markup import code, fenced, plain

WIDEST = 100
HIDDEN = ("self", "cls")


def signature(name: str, thing: Any) -> str:
    """Return how something is called, on several lines where one would be too wide; empty where it is not called."""
    if _is_protocol(thing) or not callable(thing):
        return ""
    try:
        found = inspect.signature(
            thing.__init__ if inspect.isclass(thing) and not dataclasses.is_dataclass(thing) else thing
        )
    except (TypeError, ValueError):
        return ""
    taken = [each for each in found.parameters.values() if each.name not in HIDDEN and not _is_place(each)]
    parts: list[str] = []
    is_keyed = False
    for each in taken:
        if each.kind is each.KEYWORD_ONLY and not is_keyed:
            parts, is_keyed = [*parts, "*"], True
        is_keyed = is_keyed or each.kind is each.VAR_POSITIONAL
        parts.append(_parameter(each))
    gives = (
        ""
        if inspect.isclass(thing) or found.return_annotation in (found.empty, None, "None")
        else f" -> {_type(found.return_annotation)}"
    )
    whole = f"{name}({', '.join(parts)}){gives}"
    return whole if len(whole) <= WIDEST else f"{name}(\n    " + ",\n    ".join(parts) + f",\n){gives}"


def _is_place(each: inspect.Parameter) -> bool:
    """Whether it is where a declaration stands, which the program finds by itself."""
    return each.name == "at" and each.default is not each.empty


def _parameter(each: inspect.Parameter) -> str:
    stars = "*" if each.kind is each.VAR_POSITIONAL else "**" if each.kind is each.VAR_KEYWORD else ""
    kind = "" if each.annotation is each.empty else f": {_type(each.annotation)}"
    default = "" if each.default is each.empty else f" = {_default(each.default)}"
    return f"{stars}{each.name}{kind}{default}"


def _type(annotation: Any) -> str:
    text = annotation if isinstance(annotation, str) else inspect.formatannotation(annotation)
    return re.sub(r"\b(?:diecut_report|collections|typing|numpy)\.(?:\w+\.)*", "", text)


def _default(value: Any) -> str:
    text = repr(value)
    return "..." if text.startswith("<") or "0x" in text or isinstance(value, PurePath) else text


def _is_protocol(thing: Any) -> bool:
    return bool(getattr(thing, "_is_protocol", False))


def described(thing: Any) -> Iterator[str]:
    """Yield the docstring as Markdown."""
    yield from ("", *(_marked(paragraph) for paragraph in paragraphs(thing)), "")


def paragraphs(thing: Any) -> Iterator[str]:
    """Yield the paragraphs of a docstring, each followed by an empty line."""
    for paragraph in (inspect.getdoc(thing) or "").split("\n\n"):
        yield from (" ".join(paragraph.split()), "")


def _marked(text: str) -> str:
    """A text of a docstring, its code in double backticks, as Markdown."""
    parts = re.split(r"``(.+?)``", text)
    return "".join(code(part) if index % 2 else plain(part) for index, part in enumerate(parts))


def called(name: str, thing: Any) -> Iterator[str]:
    """Yield the signature as a block of code; nothing where there is none."""
    found = signature(name, thing)
    if found:
        yield from fenced("python", found)


def methods(thing: type) -> dict[str, Any]:
    """Return what a class offers beside its making: methods and properties with words of their own, in their order."""
    own: dict[str, Any] = {}
    if issubclass(thing, Step):  # what it offers is for the rooms of the program
        return own
    for base in reversed(thing.__mro__):
        if base.__module__.startswith("diecut_report"):
            own |= {name: each for name, each in vars(base).items() if not name.startswith("_") and _is_offered(each)}
    return own


def _is_offered(each: Any) -> bool:
    return isinstance(each, property) or (inspect.isfunction(each) and bool(each.__doc__))
