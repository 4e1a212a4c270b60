"""The texts of the program itself that stand in reports: the words of a report, phrases, tables of standards, fields of the press."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from diecut_report.config.model import Press
from diecut_report.declaration.texts import inputs_texts, is_text
from diecut_report.engine.printing import methods, tables
from diecut_report.languages.translation import CITATION, EQUATIONS
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.report.i18n import COUNTED, ENGLISH, one
from diecut_report.results import document, mechanism, reference_origins, unchecked

ROOT = Path(__file__).parents[1]
CONSTANTS = (*methods.METHODS.values(), methods.EQUAL_TERMS, "True", "False", *tables.SERIES_WORDS.values(), tables.AS_GIVEN, tables.AMONG,
             mechanism.IDLE,
             reference_origins.FOLLOWS, *unchecked.MISSING.values(), document.LEFT_OUT, "a curve", "yes", "no", "Name", "No.", "Place",
             "does not apply to this machine", "It refers to what is not there, which gives no results.", "not calculated",
             "Taken at {place}, in the middle of its smooth piece; it is the same in all of it.",
             "There is no {kinds}, or there are several: name one by {key}.")  # fmt: skip
"""Texts that the program holds outside of the calls that make phrases."""
JOINING = ("joined", "named")
SOURCES = (*EQUATIONS.values(),
           "eq.", "Fig.", "table", "chart", "charts", "after", "before", "corrected", "solved", "exact", "input", "key", "energy", "statics",
           "geometry", "kinematics", "dynamics", "mechanics", "this method", "closed form", "conservation of energy", "dead centre",
           "heat conduction", "inequality of the means", "involute teeth of 20°", "law of cosines", "linear damage", "loop", "maker",
           "maker's catalogue", "material", "motion laws", "power", "practice", "reference", "simply supported beam", "parabola",
           "strength of materials", "symmetry", "timing", "vibration", "virtual work", "block with clamped ends", "and", "erratum",
           "in general", "to the first order", "over the full turn", "both dead centres", "overlap once only", "with the unbalance",
           "for n dampers", "for whole teeth", "the source's unit", "at the dead centre", "first paper", "second", "conclusion", "idlers",
           "method B", "method C", "corrigendum", "series", "catalogue", "Duhamel's integral", "at")  # fmt: skip
"""Words of what is said of sources, beside names of authors and standards."""


class ProgramText(NamedTuple):
    """Hold a text, its form for many where it is counted, and what tells it apart from others."""

    text: str
    plural: str = ""
    context: str | None = None
    note: str = ""


def program_texts() -> Iterator[ProgramText]:
    """Yield each text of the program once."""
    seen = set()
    for found in (
        *_words(),
        *map(ProgramText, (*CONSTANTS, *_phrases(), *_press(), *(law.title for law in LAWS.values()))),
        *_sources(),
    ):
        if (found.context, found.text) not in seen:
            seen.add((found.context, found.text))
            yield found


def _words() -> Iterator[ProgramText]:
    for key, text in ENGLISH.items():
        yield ProgramText(one(key), text if key in COUNTED else "", key)


def _sources() -> Iterator[ProgramText]:
    yield from (ProgramText(text, context=CITATION) for text in SOURCES)


def _press() -> Iterator[str]:
    yield from (text for text, _ in inputs_texts(Press))


def _phrases() -> Iterator[str]:
    """The templates of phrases, and the words between what is joined, of the program and of all its plugins."""
    own = sorted((ROOT / "diecut_report").rglob("*.py"))
    for file in own:
        yield from (text for text in _called(file, ("Phrase", "phrase"), 0) if is_text(text))
    for file in (*own, *sorted((ROOT / "plugins").rglob("*.py"))):
        yield from (f"{{first}}{text}{{next}}" for text in _called(file, JOINING, 1) if any(map(str.isalpha, text)))


def _called(file: Path, names: tuple[str, ...], place: int) -> Iterator[str]:
    """The constant texts that a file hands to functions."""
    for node in _calls(file):
        if isinstance(node.func, ast.Name) and node.func.id in names and len(node.args) > place:
            yield from _constants(node.args[place])


@cache
def _calls(file: Path) -> list[ast.Call]:
    return [node for node in ast.walk(ast.parse(file.read_text("utf-8"))) if isinstance(node, ast.Call)]


def _constants(argument: ast.expr) -> Iterator[str]:
    match argument:
        case ast.Constant(value=str() as text):
            yield text
        case ast.IfExp(body=body, orelse=other):
            yield from (*_constants(body), *_constants(other))
