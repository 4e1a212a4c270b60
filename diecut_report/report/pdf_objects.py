"""The objects of a PDF as they are written: each is said once, its stream packed on whatever core is free."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from os import cpu_count
from typing import Any

from diecut_report.report.page_engine import Array, Dictionary, Object, Stream

LEVEL = 6  # of packing: the highest takes twice the time for a file that is 2 % smaller
FREE = "f"


class SaidObject(Object):  # type: ignore[misc]  # the page engine has no types
    """An object that is said already; the page engine says each twice, for the file and for its identifier."""

    def __init__(self, object_: Any, said: bytes, *, is_stream: bool) -> None:
        super().__init__()
        self.number, self.generation, self.free = object_.number, object_.generation, object_.free
        self.said, self.is_stream = said, is_stream

    @property
    def data(self) -> bytes:
        """The object as it stands in the file."""
        return self.said

    @property
    def compressible(self) -> bool:
        """Whether it may be packed together with others."""
        return not self.is_stream


def say_once(pdf: Any) -> None:
    """Put in the place of each object of a document, which is complete, what is written of it."""
    with ThreadPoolExecutor(max_workers=cpu_count()) as pool:
        bodies = {each.number: body for each, body in _packed(pdf.objects, pool)}
        for place, each in enumerate(pdf.objects):
            if isinstance(each, Stream):
                pdf.objects[place] = SaidObject(each, _stream(each, bodies[each.number].result()), is_stream=True)
            elif each.free != FREE:
                pdf.objects[place] = SaidObject(each, each.data, is_stream=False)


def _packed(objects: list[Any], pool: Executor) -> Iterator[tuple[Any, Future[bytes]]]:
    """The bodies of streams on their way; packing them leaves this core free."""
    for each in objects:
        if isinstance(each, Stream):
            body = b"\n".join(map(_bytes, each.stream))
            each.stream = []  # what was drawn is not needed any more, and is most of the memory
            yield each, pool.submit(zlib.compress, body, LEVEL) if each.compress else pool.submit(bytes, body)


def _stream(stream: Any, body: bytes) -> bytes:
    """A stream with its head."""
    packing = {"Filter": "/FlateDecode"} if stream.compress else {}
    head = Dictionary({**stream.extra, **packing, "Length": len(body)})
    # the line before the end is \r\n: behind a body that ends with \r, \n alone is taken as \r\n, and the body as too short
    return b"".join((head.data, b"\nstream\n", body, b"\r\nendstream"))


def _bytes(item: Any) -> bytes:
    """A line of a stream."""
    if isinstance(item, bytes):
        return item
    said: bytes = item.encode("ascii") if isinstance(item, str) else Array([item]).data[1:-1]
    return said
