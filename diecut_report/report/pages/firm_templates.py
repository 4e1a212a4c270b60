"""A firm's own templates over the report's: blocks that they override, a style sheet, pictures. They are data of strangers.

They are filled in a sandbox: they see the report's content, change nothing of it, call no Python of their own, and read no file.
"""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, is_dataclass
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from types import BuiltinFunctionType, FunctionType, MethodType
from typing import Any

from jinja2 import (
    Environment,
    FileSystemLoader,
    FunctionLoader,
    StrictUndefined,
    TemplateNotFound,
    TemplateSyntaxError,
    nodes,
)
from jinja2 import compiler as jinja_compiler
from jinja2 import environment as jinja_environment
from jinja2.environment import TemplateModule
from jinja2.filters import do_round
from jinja2.runtime import BlockReference, Context, LoopContext, Macro, TemplateReference, Undefined
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.utils import Cycler, Joiner, Namespace
from pydantic import BaseModel

from diecut_report.errors import Problem, UserError, nearest
from diecut_report.report.pages.page_policy import fetched_by_css
from diecut_report.report.text import Catalogue
from diecut_report.results.record import Record
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.time_limit import Overran, limited

# The sandbox in which a firm's templates are filled: they see plain data, and call plain functions of a list.
#
# Jinja's own sandbox forbids names that begin with an underscore; whatever else it can reach it lets a template read and call. Here nothing is
# reached but data: an attribute is a field or property of a data class, a value is a number, a text, a container of those or a data class.


TEXT = frozenset({
    "capitalize", "casefold", "count", "endswith", "find", "index", "isalnum", "isalpha", "isascii", "isdecimal", "isdigit", "islower", "isnumeric",
    "isspace", "istitle", "isupper", "join", "lower", "lstrip", "partition", "removeprefix", "removesuffix", "replace", "rfind", "rindex",
    "rpartition", "rsplit", "rstrip", "split", "splitlines", "startswith", "strip", "swapcase", "title", "upper",
})  # fmt: skip
METHODS: Mapping[type, frozenset[str]] = {
    str: TEXT,
    Catalogue: frozenset({"get", "language", "say"}),
    dict: frozenset({"get", "items", "keys", "values"}),
    list: frozenset({"count", "index"}),
    tuple: frozenset({"count", "index"}),
    Cycler: frozenset({"current", "next", "reset"}),
    LoopContext: frozenset({"changed", "cycle", "depth", "depth0", "first", "index", "index0", "last", "length", "nextitem",
                            "previtem", "revindex", "revindex0"}),
    BlockReference: frozenset({"super"}),
}  # fmt: skip
"""What may be read of values that are no data classes, by their type."""
GLOBALS = ("cycler", "joiner", "namespace", "range")
"""Jinja's own functions that templates may call."""
LONGEST = 10_000  # bits of a whole number; Python itself prints no longer ones
MOST_DECIMALS = 300  # a float has no more
PLAIN = (str, int, float, bytes, type(None), list, tuple, set, frozenset, Mapping)
OF_JINJA = (Macro, LoopContext, BlockReference, TemplateReference, TemplateModule, Cycler, Joiner, Namespace, Undefined)


class TemplateSandbox(ImmutableSandboxedEnvironment):
    """Fill templates that see plain data; of functions and methods they call those of a list, and Jinja's."""

    intercepted_binops = frozenset({"*", "**", "/", "//", "%"})

    def __init__(self, functions: Collection[Callable[..., Any]], **options: Any) -> None:
        """Take the functions, and methods as they stand in their classes, that templates may call."""
        super().__init__(**options)
        self.functions = frozenset(functions)
        self.filters = {**self.filters, "round": _rounded}
        self.globals = {name: self.globals[name] for name in GLOBALS}
        self.allowed = self.functions | frozenset(self.globals.values())

    def call_binop(self, context: Context, operator: str, left: Any, right: Any) -> Any:
        """Return what an operator makes of two values; ValueError for whole numbers so long that Python would reckon without an end."""
        longest = max(each.bit_length() if isinstance(each, int) else 0 for each in (left, right))
        is_power = operator == "**" and isinstance(left, int) and isinstance(right, int)
        if longest * (abs(right) if is_power else 1) > LONGEST:
            raise ValueError(phrase("a whole number of too many digits"))
        return super().call_binop(context, operator, left, right)

    def is_safe_attribute(self, obj: Any, attr: str, value: Any) -> bool:
        """Return whether a template may read an attribute."""
        if attr.startswith("_") or isinstance(obj, type):
            return False
        return self._is_readable(obj, attr) and self._is_shown(value)

    def is_safe_callable(self, obj: Any) -> bool:
        """Return whether a template may call an object."""
        if isinstance(obj, (Macro, LoopContext, BlockReference, Joiner, Undefined)):
            return True  # the last one raises its own message
        owner = getattr(obj, "__self__", None)
        return self._is_listed(obj) or getattr(obj, "__name__", "") in _names(owner)

    def getattr(self, obj: Any, attribute: str) -> Any:
        """Return an attribute, or an item, where it is plain data."""
        return self._shown(super().getattr(obj, attribute), obj, attribute)

    def getitem(self, obj: Any, argument: Any) -> Any:
        """Return an item, or an attribute, where it is plain data."""
        return self._shown(super().getitem(obj, argument), obj, argument)

    def _shown(self, found: Any, obj: Any, name: Any) -> Any:
        return found if self._is_shown(found) else self.unsafe_undefined(obj, f"{name}")

    def _is_readable(self, obj: Any, attr: str) -> bool:
        if isinstance(obj, (TemplateModule, Namespace)):
            return True  # what the templates themselves define
        of_class = getattr(type(obj), attr, None)
        if attr in _names(obj) or (callable(of_class) and of_class in self.functions):
            return True
        if not _is_record(obj):
            return False
        of_data = [each.name for each in fields(obj)] if is_dataclass(obj) else getattr(obj, "_fields", ())
        names = type(obj).model_fields if isinstance(obj, Record) else of_data
        is_own = isinstance(of_class, property | cached_property) and not hasattr(BaseModel, attr)
        return attr in names or is_own

    def _is_shown(self, value: Any) -> bool:
        return isinstance(value, (*PLAIN, *OF_JINJA)) or _is_record(value) or self.is_safe_callable(value)

    def _is_listed(self, obj: Any) -> bool:
        if not isinstance(obj, FunctionType | BuiltinFunctionType | MethodType | type):
            return False
        return obj in self.allowed or (isinstance(obj, MethodType) and obj.__func__ in self.functions)


def _rounded(value: float, precision: int = 0, method: str = "common") -> float:
    """Return a number rounded by Jinja's filter, which would raise ten to any power."""
    if abs(precision) > MOST_DECIMALS:
        raise ValueError(phrase("a number is rounded to too many decimals"))
    return do_round(value, precision, method)  # type: ignore[arg-type]  # another method raises its own message


def _names(obj: Any) -> frozenset[str]:
    return next((names for kind, names in METHODS.items() if isinstance(obj, kind)), frozenset())


def _is_record(obj: Any) -> bool:
    """Whether an object is of a class of plain data: a data class, a named tuple, or a part of the results."""
    return not isinstance(obj, type) and (is_dataclass(obj) or isinstance(obj, Record) or hasattr(type(obj), "_fields"))


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
        program = FileSystemLoader(programs)

        def load(name: str) -> tuple[str, str | None, Callable[[], bool] | None]:
            if name in self.templates:
                return self.templates[name], self.path(name), lambda: True
            return program.get_source(environment, name.removeprefix(OWN))

        environment = TemplateSandbox([*functions, self._picture], loader=FunctionLoader(load), **OPTIONS)
        environment.filters.update(filters)
        environment.globals["picture"] = self._picture
        return environment

    def _picture(self, name: str) -> str:
        if name not in self.pictures:
            told = {"name": repr(name), "nearest": nearest(name, self.pictures)}
            raise ValueError(Phrase("{name} is not a picture of the folder{nearest}", **told))
        return self.pictures[name]

    def path(self, name: str) -> str:
        """The file of a template."""
        return str(Path(self.folder) / name)


def problems(house: HouseStyle, programs: Path) -> list[Problem]:
    """Return what is wrong with a firm's templates before any is filled: their syntax, names that nothing asks for, what would be fetched."""
    known = sorted(path.name for path in programs.glob(f"*{ENDING}"))
    environment = Environment(loader=FileSystemLoader(programs), **OPTIONS)
    found = [each for name, text in house.templates.items() for each in _judged(house, name, text, known, environment)]
    for what, line in fetched_by_css(house.css):
        message = Phrase("{what} would be fetched; a report fetches nothing. Put pictures into the folder, and write "
                       "them as data: addresses.", what=what)  # fmt: skip
        found.append(Problem(message, house.path(CSS), line))
    return found


def _judged(house: HouseStyle, name: str, text: str, known: list[str], environment: Environment) -> Iterator[Problem]:
    if name not in known and not name.startswith("_"):
        message = Phrase(
            "{name} is not a template of the program{nearest}, so nothing asks for it. Your own begin with _.",
            name=repr(name),
            nearest=nearest(name, known),
        )
        yield Problem(message, house.path(name))
    try:
        tree = environment.parse(text)
        asked_for = list(tree.find_all(nodes.Extends))
    except TemplateSyntaxError as error:
        yield Problem(f"{(error.message or '').rstrip('.')}.", house.path(name), error.lineno)
        return
    except (RecursionError, ValueError) as error:  # brackets in brackets, a number of thousands of digits
        yield Problem(Phrase("The template cannot be read: {error}.", error=error), house.path(name))
        return
    for asked in [each.template.value for each in asked_for if isinstance(each.template, nodes.Const)]:
        program = str(asked).removeprefix(OWN)
        if program not in known:
            message = Phrase(
                "{asked} is not a template of the program{nearest}.", asked=repr(asked), nearest=nearest(program, known)
            )
            yield Problem(message, house.path(name))
        elif asked == name:
            message = Phrase('A template cannot extend itself. Write {% extends "{name}" %}.', name=f"{OWN}{name}")
            yield Problem(message, house.path(name), 1)
        else:
            yield from _unknown_blocks(house, name, tree, blocks(program, environment))


def _unknown_blocks(house: HouseStyle, name: str, tree: nodes.Template, known: list[str]) -> Iterator[Problem]:
    for block in tree.find_all(nodes.Block):
        if block.name not in known:
            message = Phrase(
                "{name} is not a block of the template{nearest}; its blocks: {known}.",
                name=repr(block.name),
                nearest=nearest(block.name, known),
                known=", ".join(known),
            )
            yield Problem(message, house.path(name), block.lineno)


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
        frames = traceback.extract_tb(cause.__traceback__)
        places = [frame for frame in frames if frame.filename in files]
        # what Jinja makes of a template or joins of its texts, whose lines tell nothing
        is_of_jinja = frames[-1].filename in (jinja_compiler.__file__, jinja_environment.__file__)
        if house and files and (isinstance(cause, RecursionError | MemoryError) or is_of_jinja):
            places = places or [traceback.FrameSummary(house.folder, None, "")]
        if not places:
            raise
        said = f"{cause}"
        if isinstance(cause, TemplateNotFound):
            said = Phrase("{name} is not a template of the folder or the program", name=repr(cause.name))
        message = Phrase("The template cannot be filled: {reason}.", reason=said.rstrip(".") or type(cause).__name__)
        raise UserError(Problem(message, places[-1].filename, places[-1].lineno)) from cause


# How long a firm's templates may take, and how much memory: what strangers wrote need not end.


SECONDS = 600.0  # for a page to be filled, judged and set; the longest report of the program's own takes a tenth of it
MEMORY = 4 * 2**30  # bytes for a page to be filled, beyond those that the program has


@contextmanager
def bounded(house: HouseStyle | None) -> Iterator[None]:
    """Tell in words that a page of a firm's templates was given up."""
    try:
        with limited(SECONDS if house else None):
            yield
    except Overran:
        message = Phrase(
            "With these templates the report was not finished within {seconds} s and was aborted. Look for an "
            "endless loop, and for a style or a picture that the page engine cannot handle.",
            seconds=f"{SECONDS:g}",
        )
        raise UserError(Problem(message, house.folder if house else "")) from None


@contextmanager
def bounded_memory() -> Iterator[None]:
    """Let what asks for more than a page needs end in MemoryError, where the system can tell; not in its ending other programs."""
    if sys.platform != "linux":
        yield
        return
    import resource

    before = resource.getrlimit(resource.RLIMIT_AS)
    has = int(Path("/proc/self/statm").read_text("ascii").split()[0]) * resource.getpagesize()
    most = min([has + MEMORY, *(each for each in before if each != resource.RLIM_INFINITY)])
    resource.setrlimit(resource.RLIMIT_AS, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)
