"""The examples of ``diecut_report.api`` in docs/reference/examples: each is a plugin as anybody would write it, and is run as one.

A module may say with which block of a configuration it is run (``PRESS``), with which table beside it (``TABLES``), and what
that gives (``GIVES``); one without ``PRESS`` is run by itself.
"""

from __future__ import annotations

import ast
import runpy
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from diecut_report import api
from diecut_report.config.plugins import LIST, Discovery
from diecut_report.mechanism import steps
from diecut_report.press import Press
from diecut_report.results.mechanism_record import QuantityRecord
from diecut_report.results.model import ResultsRecord
from tools.site.sources import ROOT

FOLDER = ROOT / "docs" / "reference" / "examples"
HEAD = {"schema_version": "1", "project": "{title: Example}", "press": "{name: Example}"}
SAID = ("PRESS", "TABLES", "GIVES")
TYPES = {name: each for name, each in vars(steps).items() if isinstance(each, type) and issubclass(each, steps.Step)}
"""The types of steps, which authors declare by calls: the words and fields of each are told with its call."""


class ApiExample(NamedTuple):
    """An example: its file, its text and first words, the names of the interface that it shows, and what it says of itself."""

    file: Path
    text: str
    words: str
    shows: frozenset[str]
    kinds: Mapping[str, str]  # each with the name that the module gives its mechanism
    said: Mapping[str, Any]

    @property
    def name(self) -> str:
        """Return what it is called: the name that it is the first example of."""
        return self.file.stem

    @property
    def code(self) -> str:
        """Return the text without its first words, which stand above it."""
        return self.text.split('"""', 2)[2].strip("\n")


@cache
def api_examples(folder: Path = FOLDER) -> tuple[ApiExample, ...]:
    """Return all examples, by their names."""
    return tuple(_read(file) for file in sorted(folder.glob("*.py")))


def example_of(name: str) -> ApiExample | None:
    """Return the example of a name: the one that is called so, else the shortest that shows it; None where there is none."""
    found = [each for each in api_examples() if name in each.shows]
    return min(found, key=lambda each: (each.name != name, len(each.text)), default=None)


def _read(file: Path) -> ApiExample:
    text = file.read_text(encoding="utf-8")
    tree = ast.parse(text)
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    used = {own for own, called in _imported(tree).items() if called in names}
    shows = frozenset(used | {type_of(own) for own in used} | set(_declared(tree))) & {*api.__all__, *TYPES}
    values = {name: value for name, value in _assigned(tree) if name in SAID}
    kinds = {_kind(value): name for name, value in _assigned(tree) if _is_mechanism(value)}
    words = " ".join((ast.get_docstring(tree) or "").split())
    return ApiExample(
        file, text, words, shows, kinds, {name: ast.literal_eval(value) for name, value in values.items()}
    )


def _imported(tree: ast.Module) -> dict[str, str]:
    """What is imported of the interface, each with the name that it has here."""
    imports = [node for node in tree.body if isinstance(node, ast.ImportFrom) and node.module == api.__name__]
    return {alias.name: alias.asname or alias.name for node in imports for alias in node.names}


def _declared(tree: ast.Module) -> Iterator[str]:
    """The steps that calls of a chapter declare: ``chapter.part_table(…)`` is an example of ``PartTable``."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and hasattr(api.Steps, node.func.attr):
            yield type_of(node.func.attr)


def type_of(call: str) -> str:
    """Return the name of the type of step that a call declares, as types are named: ``made_curve`` is ``MadeCurve``."""
    return "".join(part.capitalize() for part in call.split("_"))


def _assigned(tree: ast.Module) -> Iterator[tuple[str, ast.expr]]:
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            yield node.targets[0].id, node.value


def _is_mechanism(value: ast.expr) -> bool:
    return isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.func.id == "Mechanism"


def _kind(value: ast.expr) -> str:
    assert isinstance(value, ast.Call)
    return str(next(ast.literal_eval(given.value) for given in value.keywords if given.arg == "kind"))


def run(example: ApiExample) -> ResultsRecord | None:
    """Return the results of an example, whose plugin is found in a folder as the user's are; None where it is run by itself."""
    if "PRESS" not in example.said:
        runpy.run_path(str(example.file))
        return None
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        shutil.copy(example.file, folder)
        listed = [f"{kind}: {example.file.name}:{name}\n" for kind, name in example.kinds.items()]
        (folder / LIST).write_text("".join(listed), encoding="utf-8")
        (folder / "tables.yaml").write_text(example.said.get("TABLES", ""), encoding="utf-8")
        config = folder / "example.yaml"
        config.write_text(configuration(example), encoding="utf-8")
        made_of = Press.read(config, Discovery([folder])).calculate()
        if made_of.broken:
            raise made_of.broken[0]
        return made_of.results


def configuration(example: ApiExample) -> str:
    """Return the configuration of an example: its block, with the head that each configuration has."""
    block = example.said["PRESS"].lstrip("\n")
    head = [f"{key}: {value}" for key, value in HEAD.items() if f"\n{key}:" not in f"\n{block}"]
    return "\n".join([*head, block])


def given_by(results: ResultsRecord, name: str) -> QuantityRecord:
    """Return what the results hold under ``MECHANISM.ID``: the value and the unit of an output or value."""
    mechanism, _, id = name.partition(".")
    found = results.mechanisms[mechanism]
    return {**found.values, **found.outputs}[id]
