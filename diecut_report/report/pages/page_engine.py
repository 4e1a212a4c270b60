"""WeasyPrint, imported without a search for its libraries by a compiler, and the objects that it writes a PDF of."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from os import cpu_count
from typing import Any

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
    "HTML", "UA_STYLESHEET", "Array", "Attachment", "Dictionary", "ElementWrapper", "Object", "Stream", "String", "URLFetcher",
    "block_layout", "told_of_page",
]  # fmt: skip


@contextmanager
def told_of_page(folder: str) -> Iterator[None]:
    """Tell in words what a page asks for from elsewhere, or cannot be set for, which the templates of this folder brought in."""
    try:
        yield
    except FatalURLFetchingError as error:  # no Exception: it would pass by all who tell of faults
        if not folder:
            raise RuntimeError(str(error)) from error
        words = Phrase("{error}: a report fetches nothing. Put what it needs into the folder.", error=error)
        raise UserError(Problem(words, folder)) from error
    except (OSError, UserError):
        raise
    except Exception as error:  # of any kind: a template or a style may ask for anything
        if not folder:
            raise
        words = Phrase(
            "The sheets cannot be set with these templates: {error}. Give HTML alone, or plainer ones.",
            error=f"{type(error).__name__}: {error}",
        )
        raise UserError(Problem(words, folder)) from error


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
