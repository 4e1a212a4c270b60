"""The print page as WeasyPrint takes it: read by expat where it is well-formed, since reading HTML by its rules takes a tenth of a report."""

from __future__ import annotations

import re
from copy import copy
from functools import cache
from typing import Any
from xml.etree.ElementTree import Element, ParseError, fromstring

from diecut_report.report.pages.page_engine import HTML, UA_STYLESHEET, ElementWrapper, URLFetcher

_VOID = re.compile(r"<(br|col|img|meta)\b([^<>]*?)/?>")  # elements without an end
NOTES = ("footnote-call", "footnote-marker", "note-call", "note-marker", "note-callback")
PART = 3  # place of the part of an element in the matcher's entries
SYMBOL = "<i class=sy>"  # the one attribute without quotation marks


class ReadPage(HTML):  # type: ignore[misc]  # the page engine has no types
    """A page whose elements are read already."""

    def __init__(self, root: Element, fetcher: URLFetcher) -> None:
        self.base_url, self.url_fetcher, self.media_type = None, fetcher, "print"
        self.wrapper_element = ElementWrapper.from_html_root(root, content_language=None)
        self.etree_element = self.wrapper_element.etree_element

    def _ua_stylesheets(self, forms: bool = False) -> list[Any]:
        """The page engine's own style, as far as a report needs it."""
        return super()._ua_stylesheets(forms) if forms else [_needed_style()]


@cache
def _needed_style() -> Any:
    """The page engine's own style without that of notes, which reports have not; only items of lists have marks.

    Else each element would get the styles of four parts that it has not, which are three quarters of all styles.
    """
    style = copy(UA_STYLESHEET)
    style.matcher = copy(style.matcher)
    every = [(selector[PART], selector) for selector in style.matcher.other_selectors]
    marks = [selector for part, selector in every if part == "marker"]
    style.matcher.other_selectors = [selector for part, selector in every if part not in NOTES and part != "marker"]
    tags = style.matcher.lower_local_name_selectors
    style.matcher.lower_local_name_selectors = tags | {"li": [*tags.get("li", []), *marks]}
    return style


def read_page(source: str, fetcher: URLFetcher, *, is_own: bool) -> HTML:
    """Return the page of a source; one that is not the program's own (``is_own``), or not well-formed, is read by the rules of HTML.

    The space before a symbol stands for itself: where only a space at a text's end has no room, the page engine breaks the text at its first
    place.
    """
    source = source.replace(f" {SYMBOL}", f"<span> </span>{SYMBOL}")
    if is_own:
        try:
            return ReadPage(fromstring(well_formed(source)), fetcher)
        except ParseError:
            pass  # a sign that XML cannot hold came with the results
    return HTML(string=source, url_fetcher=fetcher)


def well_formed(source: str) -> str:
    """Return a page of the program's templates as XML."""
    return _VOID.sub(r"<\1\2/>", source.strip().replace("&nbsp;", "\u00a0").replace(SYMBOL, '<i class="sy">'))
