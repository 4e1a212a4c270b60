"""The reference of ``diecut_report.api`` and ``diecut_report.testing``, from signatures and docstrings, with examples that are run."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from html import escape
from typing import Any

from diecut_report import api, testing
from diecut_report.report.figures.by_type import render
from diecut_report.report.figures.style import SizesSize
from diecut_report.report.text import Catalogue
from tools.site.api_examples import ApiExample, example_of, run
from tools.site.api_groups import GROUPS, TOLD, Group
from tools.site.drawing_page import drawing_page
from tools.site.functions_page import functions_page
from tools.site.markup import code, contents, fenced, html, plain, table
from tools.site.signatures import called, described, methods, paragraphs
from tools.site.sources import ROOT, Sources

PAGES = ROOT / "docs" / "reference"
WORDS = Catalogue("en")
LISTED = ("Chapter", "Steps")  # whose methods are told as the steps that they declare


def add_reference(sources: Sources) -> None:
    """Add the pages that are made; those of docs/reference are documents."""
    for group in GROUPS:
        sources.page(f"reference/{group.page}.md", _page(group))
    sources.page("reference/testing.md", _testing())
    sources.page("reference/functions.md", functions_page())
    sources.page("reference/drawings.md", drawing_page())
    sources.page("reference/index.md", _index())


def _index() -> Iterator[str]:
    yield from ("# Reference", "")
    yield (
        "All that a plugin may import of `diecut_report.api`, with examples. Each example is a whole plugin, which the tests run: `PRESS` is "
        "the block of a configuration with which it is run, `GIVES` is what then comes out. Figures that an example declares stand below it."
    )
    yield from (
        "",
        *(f"- [{group.title}]({group.page}.md): {', '.join(map(code, group.names))}" for group in GROUPS),
        "",
    )
    own = sorted(file.stem for file in PAGES.glob("*.md"))
    yield from contents("", [*(group.page for group in GROUPS), "testing", "functions", "drawings", *own])


def _page(group: Group) -> Iterator[str]:
    yield from (f"# {group.title}", "", group.words, "")
    for name in group.names:
        yield from _place(name)
        yield from (f"## {code(name)}", "")
        yield from _told(name, getattr(api, name))
        yield from _example(name, group)


def _place(name: str) -> Iterator[str]:
    """A place by the very name: titles lose the difference of ``Point`` and ``point``."""
    yield from html(f'<span id="name-{name}"></span>')


def _told(name: str, thing: Any) -> Iterator[str]:
    declared = declared_by(name)
    if declared:
        yield from called(f"chapter.{declared.__name__}", declared)
        yield from described(declared) if inspect.getdoc(declared) != inspect.getdoc(thing) else ()
    elif name not in TOLD:
        yield from called(name, thing)
    yield from (TOLD[name], "") if name in TOLD else described(thing)
    if inspect.isclass(thing):
        yield from _methods(name, thing)


def declared_by(name: str) -> Any:
    """Return the call of a chapter that declares a step of this name; None where there is none."""
    method = "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name).lstrip("_")
    found = getattr(api.Steps, method, None)
    return found if inspect.isclass(getattr(api, name)) and inspect.isfunction(found) else None


def _methods(name: str, thing: type) -> Iterator[str]:
    """What a class offers, a line for each: of chapters by the names of the steps alone."""
    rows = [(code(short(method, each)), plain(next(paragraphs(each)))) for method, each in methods(thing).items()]
    if rows and name != "Steps":
        yield from table(("it offers", "which does"), rows, "offers")


def short(name: str, each: Any) -> str:
    """Return a call with the names of what it takes, or a property."""
    if isinstance(each, property):
        return name
    taken = [
        p.name for p in inspect.signature(each).parameters.values() if p.name != "self" and p.kind is not p.VAR_KEYWORD
    ]
    return f"{name}({', '.join(taken)})"


def _example(name: str, group: Group) -> Iterator[str]:
    """The example, where it is called so; else where it stands."""
    example = example_of(name)
    if example is None:
        raise LookupError(f"{name} has no example; write docs/reference/examples/{name}.py")
    if example.name == name:
        yield from html(f'<p id="example-{name}"><b>Example.</b> {escape(example.words)}</p>')
        yield from fenced("python", example.code)
        yield from _figures(example)
        return
    home = next(each for each in GROUPS if example.name in each.names)
    address = f"{'' if home is group else f'{home.page}.html'}#example-{example.name}"
    yield from html(f'<p>Example: <a href="{address}">{escape(example.words)}</a></p>')


def _figures(example: ApiExample) -> Iterator[str]:
    results = run(example) if "figures=" in example.text else None
    for name, mechanism in results.mechanisms.items() if results else ():
        for figure in mechanism.figures:
            svg = render(figure, mechanism.curves, WORDS, f"{example.name}-{name}-{figure.id}", SizesSize.HALF)
            yield from html(f'<figure class="drawn"><div class="fig">{svg.text}</div></figure>')


def _testing() -> Iterator[str]:
    yield from ("# Testing a plugin", "")
    yield from ("`diecut_report.testing` has what a plugin's own tests need.", "")
    offered = {name: each for name, each in vars(testing).items() if is_own(name, each)}
    for name, each in offered.items():
        yield from (f"## {code(name)}", "")
        yield from (*called(name, each), *described(each))
    yield from fenced("python", TESTED)


def is_own(name: str, each: Any) -> bool:
    """Return whether it is meant for authors: named in ``__all__`` where there is one, else told of in the package's own words."""
    named = getattr(testing, "__all__", None)
    return name in named if named is not None else callable(each) and f"{name}(" in (testing.__doc__ or "")


TESTED = """
from diecut_report.testing import check_mechanism
from my_plugins.hook import MECHANISM


def test_the_hook_keeps_the_contract() -> None:
    check_mechanism(MECHANISM)
"""
