"""What is not YAML, in words with its place: tabs, quotes that are never closed, second colons, bare references in braces."""

from __future__ import annotations

from typing import Any

from diecut_report.errors import Problem
from diecut_report.languages.phrases import Phrase, phrase


def syntax_problem(error: Any, text: str, file: str) -> Problem:
    """Return what is told of a text that is not YAML, with the place where it is to be mended."""
    # a quote that is never closed is mended where it begins
    mark = error.context_mark if "end of stream" in error.problem and error.context_mark else error.problem_mark
    line = [*text.splitlines(), ""][mark.line]
    indentation = len(line) - len(line.lstrip())
    tab = line.find("\t", 0, max(indentation, mark.column + 1))
    if tab in range(indentation) or tab == mark.column:
        return Problem(phrase("A tab stands here; YAML is indented with spaces. Put spaces."), file, mark.line + 1, tab + 1)  # fmt: skip
    return Problem(Phrase("This is not valid YAML: {explained}", explained=_explained(error, line)), file, mark.line + 1,
        mark.column + 1)  # fmt: skip


def _explained(error: Any, line: str) -> str:
    if "mapping values are not allowed" in error.problem:
        return phrase("a second colon or a wrong indentation. Align keys of one block; put text that holds ': ' in quotes.")  # fmt: skip
    begin = Phrase(" that begins in line {line}", line=error.context_mark.line + 1) if error.context_mark else ""
    said = f"{error.problem} {error.context}{begin}" if error.context else error.problem
    if "${" in line and "flow" in (error.context or ""):
        return phrase('a reference stands in braces or brackets without quotes, and YAML reads its brace as a map. Quote it: "${…}".')  # fmt: skip
    return Phrase("{said}. Check quotes, brackets and indentation here and just above.", said=said)
