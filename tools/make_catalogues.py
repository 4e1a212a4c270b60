"""Makes the catalogues of the built-in plugins, keeping what is translated: ``python -m tools.make_catalogues``."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from inspect import cleandoc
from pathlib import Path
from typing import NamedTuple

import click
from babel.messages.catalog import Catalog
from jinja2 import Environment, nodes

from diecut_report.cli.main import program
from diecut_report.config.model import PressBlock, Project
from diecut_report.config.parts.keys import MachineKeys
from diecut_report.config.parts.reading import BODY, COORDINATE, MODELS
from diecut_report.config.plugins import Discovery
from diecut_report.declaration.code import code_texts, fixed_texts
from diecut_report.declaration.texts import DeclaredText, inputs_texts, is_text, texts
from diecut_report.machine.printing import page
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.mechanism.inputs import fields, keys
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Accumulated, Derivative, pick, reduction, root, rows, table_steps
from diecut_report.quantities.units import _table
from diecut_report.report.text import COUNTED, ENGLISH, one
from diecut_report.results import checks, document, machine_advice, mechanism
from diecut_report.standards import standard_ids, standard_series, standard_series_by
from diecut_report.standards.ranges import range_table
from diecut_report.standards.tables import StandardSeries
from diecut_report.testing.contract import tables_of
from diecut_report.text import po_files
from diecut_report.text.catalogues import file_beside
from diecut_report.text.translation import CITATION, EQUATIONS, PAPER

ROOT = Path(__file__).parents[1]
LANGUAGES = ("uk",)
PLACEHOLDER = re.compile(r"\\\{[\w.]+(?::\w+)?\\\}")


def main() -> None:
    """Write all catalogues anew."""
    for language in LANGUAGES:
        for file, catalogue in catalogues(language):
            file.parent.mkdir(exist_ok=True)
            file.write_bytes(po_files.written(catalogue))
            print(file.relative_to(ROOT), len(catalogue))


def catalogues(language: str) -> Iterator[tuple[Path, Catalog]]:
    """Yield each catalogue as it is to be, with its file."""
    for file, project, found in wanted(language):
        yield file, updated(file, language, found, project)


def wanted(language: str) -> Iterator[tuple[Path, str, list[ProgramText]]]:
    """Yield for each catalogue its file, what it is of, and its texts: the program's, and those of its plugins."""
    discovery = Discovery()
    yield file_beside(ROOT / "diecut_report" / "__init__.py", language), "diecut-report", list(program_texts())
    for kind in discovery.origins:
        file = file_beside(ROOT / "plugins" / kind / "__init__.py", language)
        yield file, kind, [ProgramText(text, note=of) for text, of in plugin_texts(discovery.mechanism(kind))]


def plugin_texts(mechanism: Mechanism) -> list[DeclaredText]:
    """Return all texts of a plugin: those of its declarations, and those that its code makes."""
    declared = list(texts(mechanism))
    return [*declared, *made_by_code(ROOT / "plugins" / mechanism.kind, declared), *table_sources(mechanism)]


def table_sources(mechanism: Mechanism) -> Iterator[DeclaredText]:
    """Yield once where each table of the plugin's own comes from; those of the program it says itself."""
    tables = [table for _, step in mechanism.steps for table in tables_of(step)]
    for source in dict.fromkeys(source for table in tables for source in table.sources):
        yield DeclaredText(source, "source of a table")


def made_by_code(folder: Path, declared: list[DeclaredText]) -> Iterator[DeclaredText]:
    """Yield the texts in functions that are not declared."""
    known = {text for text, _ in declared}
    yield from (found for found in code_texts(folder) if found.text not in known)


def untranslatable(folder: Path, declared: list[DeclaredText]) -> Iterator[DeclaredText]:
    """Yield what a plugin's functions make of words and numbers without a phrase: neither declared, nor to be translated."""
    whole = "\n".join(text for text, _ in declared)
    for found in fixed_texts(folder):
        if not re.search(f"(?i){PLACEHOLDER.sub('.*', re.escape(found.text))}", whole):
            yield found


def updated(file: Path, language: str, found: list[ProgramText], project: str) -> Catalog:
    """Return the catalogue with these messages, the translations of the file kept."""
    template = po_files.empty(language, project)
    for each in found:
        id = (each.text, each.plural) if each.plural else each.text
        template.add(id, context=each.context, auto_comments=[each.note] if each.note else [])
    if not file.exists():
        return template
    old = po_files.read(file, language)
    for message in template:
        if message.id and (known := old.get(message.id, message.context)):
            message.string, message.flags = known.string, known.flags
    return template


# The texts of the program itself that stand in reports: the words of a report, phrases, tables of standards, fields of the press.


CONSTANTS = (root.METHOD, reduction.SEARCHED, reduction.INTEGRATED, Accumulated.METHOD, Derivative.METHOD,
             page.EQUAL_TERMS, page.TO_ROUNDING, "True", "False", *pick.SERIES_WORDS.values(),
             table_steps.AS_GIVEN, rows.AMONG, mechanism.IDLE,
             machine_advice.FOUNDED, *checks.MISSING.values(), document.LEFT_OUT,
             "a curve", "yes", "no", "Name", "No.", "Place",
             "does not apply to this machine", "It refers to what is not there, which gives no results.", "not calculated",
             "Shown at {place}, in the middle of its smooth piece, over which it is constant.",
             "There is no {kinds}, or there are several: select one with {key}.")  # fmt: skip
"""Texts that the program holds outside of the calls that make phrases."""
MAKING = dict.fromkeys(("Phrase", "phrase", "say", "refusal", "UnitError", "ConditionError", "Unresolved", "PictureFault", "StandardFault",
                        "Undrawable", "UnknownPath", "SampleError"),
                       0) | {".problem": 1, ".absent": 1, ".fault": 1, "._fault": 1, "finding": 1}  # fmt: skip
"""What takes the template of a message, with the place of that argument."""
JOINING = ("joined", "named")
COUNTING = ("Counted", "say_counted")
SOURCES = (*EQUATIONS.values(),
           "eq.", "Fig.", "table", "chart", "charts", "after", "before", "corrected", "solved", "exact", "input", "energy", "statics",
           "geometry", "kinematics", "dynamics", "mechanics", "this method", "closed form", "conservation of energy", "dead centre",
           "heat conduction", "inequality of the means", "involute teeth of 20°", "law of cosines", "linear damage", "loop", "maker",
           "maker's catalogue", "material", "motion laws", "power", "practice", "reference", "simply supported beam", "parabola",
           "strength of materials", "symmetry", "timing", "vibration", "virtual work", "block with clamped ends", "and", "erratum",
           "in general", "to the first order", "over the full turn", "both dead centres", "overlap once only", "with the unbalance",
           "for n dampers", "for whole teeth", "the source's unit", "at the dead centre", "first paper", "second", "conclusion", "idlers",
           "method B", "method C", "corrigendum", "series", "R40 series", "catalogue", "SKF catalogue", "Duhamel's integral", "at",
           "Castigliano", "Euler", "Euler–Bernoulli", "Grashof", "Hertz", "Hooke", "Saint-Venant")  # fmt: skip
"""Words of what is said of sources, beside names of authors and standards."""


Assigned = dict[str, list[ast.expr]]


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
        *map(
            ProgramText,
            (
                *CONSTANTS,
                *_phrases(),
                *_help(),
                *_kinds_of_quantity(),
                *_press(),
                *(law.title for law in LAWS.values()),
            ),
        ),
        *_standards(),
        *_open_without_basis(),
        *_counted(),
        *_templates(),
        *_sources(),
        *_papers(),
    ):
        if (found.context, found.text) not in seen:
            seen.add((found.context, found.text))
            yield found


def _words() -> Iterator[ProgramText]:
    for key, text in ENGLISH.items():
        yield ProgramText(one(key), text if key in COUNTED else "", key)


def _sources() -> Iterator[ProgramText]:
    yield from (ProgramText(text, context=CITATION) for text in SOURCES)


def _standards() -> Iterator[ProgramText]:
    """The titles of the standard series and tables."""
    for form in ("values", "table"):
        yield from (text for id in standard_ids(form) for text in _series(standard_series(id)))
    for id in standard_ids("by"):
        yield from (text for each in standard_series_by(id).values() for text in _series(each))


def _open_without_basis() -> Iterator[ProgramText]:
    """The reasons for which inputs are open, of the table of plausible values."""
    table = range_table()
    reasons = [group.reason for group in table.without if group.needs_basis or group.by_reference] + [
        group.reason for group in table.choices
    ]
    yield from (ProgramText(reason, note="plausible values") for reason in reasons)


def _series(series: StandardSeries) -> Iterator[ProgramText]:
    """What a standard series is, and what its published tables are called."""
    of = f"standard series {series.id}"
    yield from (ProgramText(text, note=of) for text in (series.title, *series.sources) if is_text(text))


def _papers() -> Iterator[ProgramText]:
    """What the built-in mechanisms cite: works by their own titles, with words of the program's own."""
    discovery = Discovery()
    for kind in discovery.origins:
        yield from (ProgramText(source.citation, context=PAPER) for source in discovery.mechanism(kind).sources)


def _press() -> Iterator[str]:
    yield from (text for text, _ in inputs_texts(PressBlock))
    models = (MachineKeys, *MODELS.values())
    yield from (each.meta.description for model in models for each in keys(model).values() if each.meta)
    yield from (meta.description for meta in (*BODY.values(), COORDINATE))
    yield from (meta.description for _, meta in fields(Project))


def _phrases() -> Iterator[str]:
    """The templates of phrases, and the words between what is joined, of the program and of all its plugins."""
    own = sorted((ROOT / "diecut_report").rglob("*.py"))
    for file in own:
        yield from (text for name, place in MAKING.items() for text in _called(file, (name,), place) if is_text(text))
    for file in (*own, *sorted((ROOT / "plugins").rglob("*.py"))):
        yield from (f"{{first}}{text}{{next}}" for text in _called(file, JOINING, 1) if any(map(str.isalpha, text)))


def _counted() -> Iterator[ProgramText]:
    """What is said of a number of things, with its form for many."""
    for file in sorted((ROOT / "diecut_report").rglob("*.py")):
        for call, known in _calls(file):
            if isinstance(call.func, ast.Name) and call.func.id in COUNTING:
                given = [text for argument in call.args[1:] for text in _constants(argument, known)]
                yield from [ProgramText(*given[:2])] if len(given) > 1 else []


def _templates() -> Iterator[ProgramText]:
    """What templates say beside the words of a report."""
    environment = Environment()
    for file in sorted((ROOT / "templates").rglob("*.j2")):
        for call in environment.parse(file.read_text("utf-8")).find_all(nodes.Call):
            name = call.node.name if isinstance(call.node, nodes.Name) else ""
            given = [each.value for each in call.args if isinstance(each, nodes.Const)]
            if name == "say":
                yield ProgramText(given[0])
            elif name == "counted":
                yield ProgramText(*given[:2])


def _help() -> Iterator[str]:
    """What the commands and their options do."""
    for command in (program, *program.commands.values()):
        yield cleandoc(command.help or "")
        yield from filter(None, (command.epilog,))
        yield from (option.help for option in command.params if isinstance(option, click.Option) and option.help)
    yield from ("Show this message and exit.", "Usage:", "Options", "Commands", "required")


def _kinds_of_quantity() -> Iterator[str]:
    """What messages call lengths, forces and so on."""
    yield from (family["name"] for family in _table()["families"])


def _called(file: Path, names: tuple[str, ...], place: int) -> Iterator[str]:
    """The constant texts that a file hands to functions."""
    for node, known in _calls(file):
        name = f".{node.func.attr}" if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        if name in names and len(node.args) > place:
            yield from _constants(node.args[place], known)


@cache
def _calls(file: Path) -> list[tuple[ast.Call, Assigned]]:
    """All calls of a file, each with what the names of its function stand for."""
    tree = ast.parse(file.read_text("utf-8"))
    scopes = [tree, *(node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))]
    found: dict[ast.Call, Assigned] = {}
    for scope in scopes:
        known = _assigned(scope)
        found |= {node: known for node in ast.walk(scope) if isinstance(node, ast.Call)}
    return list(found.items())


def _assigned(scope: ast.AST) -> Assigned:
    """The values that are given to names in a function."""
    found: Assigned = {}
    for node in ast.walk(scope):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                if isinstance(target, ast.Name):
                    found.setdefault(target.id, []).append(node.value)
    return found


def _constants(argument: ast.expr, known: Assigned) -> Iterator[str]:
    match argument:
        case ast.Constant(value=str() as text):
            yield text
        case ast.IfExp(body=body, orelse=other):
            yield from (*_constants(body, known), *_constants(other, known))
        case ast.Name(id=name):
            yield from (text for value in known.get(name, ()) for text in _constants(value, {}))
        case ast.Starred(value=inner):
            yield from _constants(inner, known)
        case ast.Tuple(elts=parts):
            yield from (text for part in parts for text in _constants(part, known))


if __name__ == "__main__":
    main()
