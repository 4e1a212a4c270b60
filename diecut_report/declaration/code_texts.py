"""Texts that a plugin's code makes: string constants inside functions, those of phrases among them, found in the syntax tree."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from diecut_report.declaration.texts import DeclaredText

WORDS = re.compile(r"(?<![\w{.])[A-Za-z][a-z'’-]+(?![\w}(])")
NAMES = re.compile(r"[\w.{}\[\],:+/*-]*")
JOINING = re.compile(r"[\s,;]*(?:and|or)[\s,;]*")
LABELS = {"label": 1, "mark": 2, "level": 1, "vertical": 1, "line": 2, "fill": 2, "point": 2, "arrow": 3, "dimension": 3, "phrase": 0,
          "radius_dimension": 3, "box": 3}  # fmt: skip
"""Functions that draw, each with the place of its words; and that which marks a text."""
SILENT_CALLS = {"Source", "ValueError", "TypeError", "KeyError", "AssertionError", "RuntimeError"}
SILENT_KEYWORDS = {"source", "sources", "needs", "lacks", "id", "symbol", "unit", "role", "anchor"}


def code_texts(folder: Path) -> Iterator[DeclaredText]:
    """Yield each text of the Python files of a plugin (a folder, or one file) once."""
    seen = set()
    for file, finder in _searched(folder):
        for text in finder.found:
            if text not in seen:
                seen.add(text)
                yield DeclaredText(text, file.name)


def fixed_texts(folder: Path) -> Iterator[DeclaredText]:
    """Yield the templates of f-strings in functions: what is not declared, but made for one machine, cannot be translated so."""
    for file, finder in _searched(folder):
        yield from (DeclaredText(text, file.name) for text in finder.made)


def _searched(folder: Path) -> Iterator[tuple[Path, _Finder]]:
    for file in sorted(folder.rglob("*.py")) if folder.is_dir() else [folder]:
        finder = _Finder()
        finder.visit(ast.parse(file.read_text("utf-8"), str(file)))
        yield file, finder


class _Finder(ast.NodeVisitor):
    """Collect the texts of functions."""

    def __init__(self) -> None:
        self.depth = 0
        self.found: list[str] = []
        self.made: list[str] = []

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        self.depth += 1
        for part in node.body[1:] if ast.get_docstring(node, clean=False) else node.body:
            self.visit(part)
        self.depth -= 1

    def visit_Call(self, node: ast.Call) -> None:
        if isinstance(node.func, ast.Name) and node.func.id in SILENT_CALLS:
            return
        self._note_label(node)
        if (
            not self.depth and isinstance(node.func, ast.Name) and node.func.id == "Phrase"
        ):  # of a lambda in a declaration
            self.found += [text for each in node.args[:1] for text in _spoken(each) if WORDS.search(text)]
        self.visit(node.func)
        for argument in node.args:
            self.visit(argument)
        for keyword in node.keywords:
            if keyword.arg not in SILENT_KEYWORDS:
                self.visit(keyword.value)

    def _note_label(self, node: ast.Call) -> None:
        """Note the words beside what is drawn, which may be a single one."""
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if (self.depth or name == "phrase") and name in LABELS:
            said = [
                *node.args[LABELS[name] :][:1],
                *(each.value for each in node.keywords if each.arg in ("label", "text", "lines")),
            ]
            self.found += [text for each in said for text in _spoken(each) if WORDS.fullmatch(text) or name == "phrase"]

    def visit_Subscript(self, node: ast.Subscript) -> None:
        self.visit(node.value)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        self._note(template(node), self.made)
        for part in node.values:
            if isinstance(part, ast.FormattedValue):
                self.visit(part.value)

    def visit_Constant(self, node: ast.Constant) -> None:
        if isinstance(node.value, str):
            self._note(node.value, self.found)

    def _note(self, text: str, kept: list[str]) -> None:
        if self.depth and WORDS.search(text) and not JOINING.fullmatch(text) and not _is_name(text):
            kept.append(text)


def _spoken(part: ast.expr) -> Iterator[str]:
    """The constant texts of which a label is one, or is put together."""
    match part:
        case ast.Constant(value=str() as text):
            yield text
        case ast.IfExp(body=first, orelse=other) | ast.BinOp(left=first, right=other):
            yield from (*_spoken(first), *_spoken(other))
        case ast.List(elts=parts) | ast.Tuple(elts=parts):
            yield from (text for each in parts for text in _spoken(each))


def _is_name(text: str) -> bool:
    """Whether a text is a key, an id or a unit."""
    return NAMES.fullmatch(text) is not None and not text[:1].isupper()


def template(node: ast.JoinedStr) -> str:
    """Return an f-string with a name for each of its parts."""
    names: dict[str, str] = {}
    text = ""
    for part in node.values:
        if isinstance(part, ast.FormattedValue):
            text += f"{{{_placeholder(part.value, names)}}}"
        elif isinstance(part, ast.Constant):
            text += str(part.value)
    return text


def _placeholder(value: ast.expr, names: dict[str, str]) -> str:
    """The name of a part: equal parts share one."""
    written = ast.unparse(value)
    if written not in names:
        name = _name(value)
        taken = sum(re.fullmatch(rf"{name}(_\d+)?", other) is not None for other in names.values())
        names[written] = f"{name}_{taken + 1}" if taken else name
    return names[written]


def _name(value: ast.expr) -> str:
    match value:
        case ast.Name(id=name):
            return name.lstrip("_").lower()
        case ast.Attribute(attr=name):
            return name.lstrip("_").lower()
        case ast.Subscript(slice=ast.Constant(value=str() as name)):
            return name
        case ast.Subscript(value=inner) | ast.Starred(value=inner) | ast.FormattedValue(value=inner):
            return _name(inner)
        case ast.Call(args=[ast.Constant(value=str() as name), *_]) if name.isidentifier():
            return name
        case ast.Call(func=ast.Attribute(attr="join"), args=[inner, *_]):
            return _name(inner)
        case ast.Call(func=ast.Name(id="told" | "below" | "sum" | "max" | "min"), args=[inner, *_]):
            return _name(inner)
        case ast.Call(func=function):
            return _name(function)
        case ast.BinOp(left=ast.Constant(), right=inner) | ast.BinOp(left=inner) | ast.UnaryOp(operand=inner):
            return _name(inner)
        case ast.IfExp(body=inner) if not isinstance(inner, ast.Constant):
            return _name(inner)
        case ast.IfExp(orelse=inner) if not isinstance(inner, ast.Constant):
            return _name(inner)
        case ast.JoinedStr(values=parts):
            return next((_name(part.value) for part in parts if isinstance(part, ast.FormattedValue)), "text")
    return "text"
