"""What is not YAML, in words with its place; and commas in lists that part what was meant as one number."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import yaml

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


def decimal_commas(entries: Sequence[Any]) -> Iterator[tuple[int, Phrase]]:
    """Yield where a list within brackets has a number that a decimal comma parts, as in [9,5 mm, 10 mm], with what is told of it.

    [1,2,3] is a list of three: the comma is suspected where others are followed by a space, or where a unit stands behind it.
    """
    glued = [_is_glued(one, other) for one, other in pairwise(entries)]
    for index, is_glued in enumerate(glued):
        following = entries[index + 1].value if is_glued else ""
        if is_glued and (not all(glued) or not re.fullmatch(r"[\d.eE+-]+", following)):
            words = "{typed} is read as two values. Write a decimal point, or a space after the comma."
            yield index, Phrase(words, typed=f"{entries[index].value},{following}")


def _is_glued(one: Any, other: Any) -> bool:
    """Whether a whole number and what begins with a digit stand with nothing but a comma between them."""
    if not all(isinstance(each, yaml.ScalarEvent) and each.implicit[0] for each in (one, other)):
        return False
    beside = other.start_mark.index == one.end_mark.index + 1
    return beside and bool(re.fullmatch(r"[-+−]?\d+", one.value) and re.match(r"\d", other.value))
