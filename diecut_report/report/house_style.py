"""A firm's own templates over the report's: blocks that they override, a style sheet, pictures. They are data of strangers.

They are filled in a sandbox: they see the report's content, change nothing of it, call no Python of their own, and read no file.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Any

from jinja2 import (
    BaseLoader,
    Environment,
    FileSystemLoader,
    StrictUndefined,
    TemplateNotFound,
    TemplateSyntaxError,
    nodes,
)
from jinja2 import compiler as jinja_compiler
from jinja2 import environment as jinja_environment

from diecut_report.errors import Problem, UserError, nearest
from diecut_report.languages.phrases import Phrase
from diecut_report.report.page_policy import fetched_by_css
from diecut_report.report.template_sandbox import TemplateSandbox

OWN = "program/"  # before the name of a template: the program's, whatever the firm has
ENDING, CSS = ".html.j2", "house.css"
MAIN = "report.html.j2"
OPTIONS: dict[str, Any] = {"autoescape": True, "undefined": StrictUndefined, "trim_blocks": True, "lstrip_blocks": True}

Filters = Mapping[str, Callable[..., Any]]


@dataclass(frozen=True)
class HouseStyle:
    """What a folder of a firm's templates holds: texts by the names of their files, pictures as data addresses."""

    folder: str
    templates: Mapping[str, str] = field(default_factory=dict)
    css: str = ""
    pictures: Mapping[str, str] = field(default_factory=dict)

    @property
    def sha256(self) -> str:
        """The hash of all that it holds."""
        told = [sorted(self.templates.items()), self.css, sorted(self.pictures.items())]
        return sha256(repr(told).encode("utf-8", "surrogatepass")).hexdigest()

    def environment(self, programs: Path, filters: Filters, functions: Collection[Callable[..., Any]]) -> Environment:
        """Return what fills templates, the firm's before the program's: they may call these functions, and ``picture``."""
        environment = TemplateSandbox([*functions, self._picture], loader=_HouseLoader(self, programs), **OPTIONS)
        environment.filters.update(filters)
        environment.globals["picture"] = self._picture
        return environment

    def _picture(self, name: str) -> str:
        if name not in self.pictures:
            raise ValueError(
                Phrase(
                    "{name} is not a picture of the folder{nearest}",
                    name=repr(name),
                    nearest=nearest(name, self.pictures),
                )
            )
        return self.pictures[name]

    def path(self, name: str) -> str:
        """The file of a template."""
        return str(Path(self.folder) / name)


class _HouseLoader(BaseLoader):
    """Finds a template in the firm's folder, else in the program's; ``program/NAME`` is always the program's."""

    def __init__(self, house: HouseStyle, programs: Path) -> None:
        self.house, self.programs = house, FileSystemLoader(programs)

    def get_source(self, environment: Environment, template: str) -> tuple[str, str | None, Callable[[], bool] | None]:
        """Return a template's text and its file."""
        if template in self.house.templates:
            return self.house.templates[template], self.house.path(template), lambda: True
        return self.programs.get_source(environment, template.removeprefix(OWN))


def problems(house: HouseStyle, programs: Path) -> list[Problem]:
    """Return what is wrong with a firm's templates before any is filled: their syntax, names that nothing asks for, what would be fetched."""
    known = sorted(path.name for path in programs.glob(f"*{ENDING}"))
    environment = Environment(loader=FileSystemLoader(programs), **OPTIONS)
    found = [
        problem for name, text in house.templates.items() for problem in _judged(house, name, text, known, environment)
    ]
    return found + [
        Problem(Phrase("{what} would be fetched; a report fetches nothing. Put pictures into the folder, and write "
"them as data: addresses.", what=what),
                house.path(CSS), line)
        for what, line in fetched_by_css(house.css)
    ]  # fmt: skip


def _judged(house: HouseStyle, name: str, text: str, known: list[str], environment: Environment) -> Iterator[Problem]:
    if name not in known and not name.startswith("_"):
        words = Phrase(
            "{name} is not a template of the program{nearest}, so nothing asks for it. Your own begin with _.",
            name=repr(name),
            nearest=nearest(name, known),
        )
        yield Problem(words, house.path(name))
    try:
        tree = environment.parse(text)
        asked_for = list(tree.find_all(nodes.Extends))
    except TemplateSyntaxError as error:
        yield Problem(f"{(error.message or '').rstrip('.')}.", house.path(name), error.lineno)
        return
    except (RecursionError, ValueError) as error:  # brackets in brackets, a number of thousands of digits
        yield Problem(Phrase("The template cannot be read: {error}.", error=error), house.path(name))
        return
    extended = [each.template.value for each in asked_for if isinstance(each.template, nodes.Const)]
    for asked in extended:
        if str(asked).removeprefix(OWN) not in known:
            yield Problem(
                Phrase(
                    "{asked} is not a template of the program{nearest}.",
                    asked=repr(asked),
                    nearest=nearest(str(asked).removeprefix(OWN), known),
                ),
                house.path(name),
            )
        elif not str(asked).startswith(OWN) and asked == name:
            yield Problem(
                Phrase('A template cannot extend itself. Write {% extends "{name}" %}.', name=f"{OWN}{name}"),
                house.path(name),
                1,
            )
        else:
            yield from _unknown_blocks(house, name, tree, blocks(str(asked).removeprefix(OWN), environment))


def _unknown_blocks(house: HouseStyle, name: str, tree: nodes.Template, known: list[str]) -> Iterator[Problem]:
    for block in tree.find_all(nodes.Block):
        if block.name not in known:
            words = Phrase(
                "{name} is not a block of the template{nearest}; its blocks: {known}.",
                name=repr(block.name),
                nearest=nearest(block.name, known),
                known=", ".join(known),
            )
            yield Problem(words, house.path(name), block.lineno)


def blocks(name: str, environment: Environment) -> list[str]:
    """Return the blocks of a template of the program, in their order."""
    assert environment.loader is not None
    source, _, _ = environment.loader.get_source(environment, name)
    return [block.name for block in environment.parse(source).find_all(nodes.Block)]


@contextmanager
def in_words(house: HouseStyle | None) -> Iterator[None]:
    """What goes wrong while a firm's template is filled is told with its file and line; what goes wrong elsewhere is raised as it is."""
    try:
        yield
    except UserError:
        raise
    except Exception as cause:  # of any kind: a template may call, divide, index whatever it likes
        files = {house.path(name) for name in house.templates} if house else set()
        places = [frame for frame in traceback.extract_tb(cause.__traceback__) if frame.filename in files]
        if house and files and (isinstance(cause, RecursionError | MemoryError) or _is_of_jinja(cause)):
            places = places or [traceback.FrameSummary(house.folder, None, "")]
        if not places:
            raise
        said = f"{cause}"
        if isinstance(cause, TemplateNotFound):
            said = Phrase("{name} is not a template of the folder or the program", name=repr(cause.name))
        words = Phrase("The template cannot be filled: {reason}.", reason=said.rstrip(".") or type(cause).__name__)
        raise UserError(Problem(words, places[-1].filename, places[-1].lineno)) from cause


def _is_of_jinja(cause: Exception) -> bool:
    """Whether it went wrong in what Jinja makes of a template or joins of its texts, whose lines tell nothing."""
    *_, last = traceback.extract_tb(cause.__traceback__)
    return last.filename in (jinja_compiler.__file__, jinja_environment.__file__)
