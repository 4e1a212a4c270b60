"""What an author may mean, and often does not: a unit that a formula converts by hand, a chapter that nothing depends on."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator

from diecut_report.contract.chapters import Chapter
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Value
from diecut_report.declaration.sources import own_files, parsed
from diecut_report.declaration.words import short
from diecut_report.expressions import Node
from diecut_report.formula_checks.dimensions import formulas
from diecut_report.formula_checks.idle import named_in
from diecut_report.languages.phrases import Phrase

BY_HAND = {60, 3600, 100, 1000, 1e6, 0.001, 180, 360, 57.3, 9.8, 9.81, 9.80665, 3.14, 3.142, 3.1416, 25.4}


def doubts(mechanism: Mechanism) -> Iterator[str]:
    """Yield what may be a mistake, each with its place."""
    for step, _, link in formulas(mechanism):
        for number in dict.fromkeys(_numbers(link.formula.tree)):
            if float(number) in BY_HAND:
                words = "{place}: {id}: holds {number}, a number without a unit; formulas are in SI and convert nothing: if it stands for a unit or a constant, take it away, or write np.pi, GRAVITY or Constant(…)"  # noqa: E501
                yield Phrase(words, place=short(step.at), id=step.id, number=number)
    yield from _idle_chapters(mechanism)


def _numbers(node: object) -> Iterator[str]:
    match node:
        case Node("num", (text,)):
            yield text
        case Node("^", (base, _)):  # an exponent has no unit
            yield from _numbers(base)
        case Node(_, parts) | tuple(parts):
            for part in parts:
                yield from _numbers(part)


def _idle_chapters(mechanism: Mechanism) -> Iterator[str]:
    """Chapters of numbers alone that no check, key result, figure, file or other chapter takes, nor plain code by its name."""
    declared = (mechanism.checks, mechanism.key_results, mechanism.figures, mechanism.exports)
    if not any(declared):
        return
    asked = {name for part in declared for name in named_in(part)}
    asked |= {name for comparison in mechanism.comparisons for _, name in comparison.takes.values()}
    written = Counter(
        node.value for file in own_files(mechanism) for node in ast.walk(parsed(file))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    )  # fmt: skip
    for chapter in mechanism.chapters:
        if chapter.steps and all(isinstance(step, Value) for step in chapter.steps):
            used = asked | _taken_elsewhere(mechanism, chapter)
            if not any(step.id in used or written[step.id] > 1 for step in chapter.steps):
                words = "{place}: chapter {title}: no check, key result, figure or other chapter takes what it gives; name the result that it is for in key_results, or check it"  # noqa: E501
                yield Phrase(words, place=short(chapter.at), title=repr(chapter.title))


def _taken_elsewhere(mechanism: Mechanism, chapter: Chapter) -> set[str]:
    others = [step for other in mechanism.chapters if other is not chapter for step in other.steps]
    return {name for step in others for name in (*taken(step), *named_in(step))}
