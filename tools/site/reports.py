"""The reports of the examples, as the program writes them, and a page that leads to them."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from tools.site.examples import Example
from tools.site.markup import html
from tools.site.sources import Sources

EXTRA = "_extra"  # what stands in it is part of the site as it is


def add_reports(sources: Sources, examples: list[Example]) -> None:
    """Add the reports that there are, and their list."""
    made = sorted((each for each in examples if each.report), key=lambda each: each.name)
    for example in made:
        sources.add(f"{EXTRA}/reports/{example.name}.html", example.report)
    sources.page("reports.md", _page(made))


def _page(made: list[Example]) -> Iterator[str]:
    yield from ("# Reports of the examples", "")
    yield "What the program writes of the configurations in `configs/`, as it writes them: each is one file, which needs no network."
    yield from html(
        "<ul>",
        *(f'<li><a href="reports/{each.name}.html">{escape(each.title)}</a> {_verdict(each)}</li>' for each in made),
        "</ul>",
    )


def _verdict(example: Example) -> str:
    """The name of the configuration, and the verdict."""
    status = example.results.status if example.results else ""
    return f"<code>configs/{example.name}.yaml</code>: {escape(status)}"
