"""WeasyPrint, imported without a search for its libraries by a compiler, and the objects that it writes a PDF of."""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from copy import copy
from functools import cache
from os import cpu_count
from typing import Any
from xml.etree.ElementTree import Element, ParseError, fromstring

from diecut_report.errors import Problem, UserError
from diecut_report.report.scope import no_compiler
from diecut_report.text.phrases import Phrase

with no_compiler():
    from cssselect2 import ElementWrapper
    from pydyf import PDF, Array, Dictionary, Object, Stream, String
    from weasyprint import HTML, Attachment
    from weasyprint.html import UA_STYLESHEET
    from weasyprint.layout import block as block_layout
    from weasyprint.urls import FatalURLFetchingError, URLFetcher

__all__ = [
    "HTML", "Array", "Attachment", "Dictionary", "Object", "Stream", "String", "URLFetcher", "block_layout", "told_of_page",
]  # fmt: skip


@contextmanager
def told_of_page(folder: str) -> Iterator[None]:
    """Tell in words what a page asks for from elsewhere, or cannot be set for, which the templates of this folder brought in."""
    try:
        yield
    except FatalURLFetchingError as error:  # no Exception: it would pass by all who tell of faults
        if not folder:
            raise RuntimeError(str(error)) from error
        message = Phrase("{error}: a report fetches nothing. Put what it needs into the folder.", error=error)
        raise UserError(Problem(message, folder)) from error
    except (OSError, UserError):
        raise
    except Exception as error:  # of any kind: a template or a style may ask for anything
        if not folder:
            raise
        message = Phrase(
            "The sheets cannot be set with these templates: {error}. Give HTML alone, or plainer ones.",
            error=f"{type(error).__name__}: {error}",
        )
        raise UserError(Problem(message, folder)) from error


def _references(pdf: Any) -> tuple[bytes, ...]:
    """The references of a document's pages, which the page engine asks for at each element of its structure, and would make anew each time."""
    if len(pdf.__dict__.get("references", ())) != pdf.pages["Count"]:
        pdf.references = tuple(f"{number} 0 R".encode("ascii") for number in pdf.pages["Kids"][::3])
    references: tuple[bytes, ...] = pdf.references
    return references


PDF.page_references = property(_references)


# The objects of a PDF as they are written: each is said once, its stream packed on whatever core is free.


LEVEL = 6  # of packing: the highest takes twice the time for a file that is 2 % smaller
FREE = "f"


class SaidObject(Object):  # type: ignore[misc]  # the page engine has no types
    """An object that is said already; the page engine says each twice, for the file and for its identifier."""

    data = compressible = None  # which are properties of the page engine's objects

    def __init__(self, object_: Any, said: bytes, *, is_stream: bool) -> None:
        super().__init__()
        self.number, self.generation, self.free = object_.number, object_.generation, object_.free
        self.data, self.compressible = said, not is_stream  # those of one stream are not packed with others


def say_once(pdf: Any) -> None:
    """Put in the place of each object of a document, which is complete, what is written of it."""
    with ThreadPoolExecutor(max_workers=cpu_count()) as pool:
        bodies = {each.number: body for each, body in _packed(pdf.objects, pool)}
        for place, each in enumerate(pdf.objects):
            is_stream = isinstance(each, Stream)
            if is_stream or each.free != FREE:
                said = _stream(each, bodies[each.number].result()) if is_stream else each.data
                pdf.objects[place] = SaidObject(each, said, is_stream=is_stream)


def _packed(objects: list[Any], pool: Executor) -> Iterator[tuple[Any, Future[bytes]]]:
    """The bodies of streams on their way; packing them leaves this core free."""
    for each in objects:
        if isinstance(each, Stream):
            body = b"\n".join(map(_bytes, each.stream))
            each.stream = []  # what was drawn is not needed any more, and is most of the memory
            yield each, pool.submit(zlib.compress, body, LEVEL) if each.compress else pool.submit(bytes, body)


def _stream(stream: Any, body: bytes) -> bytes:
    packing = {"Filter": "/FlateDecode"} if stream.compress else {}
    head = Dictionary({**stream.extra, **packing, "Length": len(body)})
    # the line before the end is \r\n: behind a body that ends with \r, \n alone is taken as \r\n, and the body as too short
    return b"".join((head.data, b"\nstream\n", body, b"\r\nendstream"))


def _bytes(item: Any) -> bytes:
    if isinstance(item, bytes):
        return item
    said: bytes = item.encode("ascii") if isinstance(item, str) else Array([item]).data[1:-1]
    return said


# The print page as WeasyPrint takes it: read by expat where it is well-formed, since reading HTML by its rules takes a tenth of a report.


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
