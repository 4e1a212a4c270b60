"""Whether what was added to a PDF reads alike in all programs: each added object is told once, by tables that leave no choice.

Programs differ where a table names an object twice or is not quite as the standard has it: some take the first entry, some the last, some
search the file for objects by themselves. So whatever such a program could find must be what the tables tell.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import pikepdf

MOST_SECTIONS = 200
_GAP = rb"(?:[\0\t\n\f\r ]|%[^\r\n]*[\r\n])+"
_OBJECT = re.compile(rb"(?<!\d)(\d{1,10})" + _GAP + rb"(\d{1,5})(?:" + _GAP + rb")?obj")
_START = re.compile(rb"startxref\s+(\d{1,15})\s+%%EOF")
_HEAD = re.compile(rb"xref *(?:\r\n|\n|\r)")
_RANGE = re.compile(rb"(\d{1,10}) (\d{1,7}) *(?:\r\n|\n|\r)")
_ENTRY = re.compile(rb"(\d{10}) (\d{5}) ([nf])(?: \r| \n|\r\n)")
_TRAILER = re.compile(rb"\s*trailer\s*<<([^#%]*?)>>\s*startxref")
_PREVIOUS = re.compile(rb"/Prev\s+(\d{1,15})(?!\s+\d+\s+R)")
_ROOT = re.compile(
    rb"/" + rb"".join(rb"(?:%c|#%02x|#%02X)" % (each, each, each) for each in b"Root") + rb"(?![A-Za-z])"
)


class _Unclear(ValueError):
    """What programs may read in several ways."""


class _Section(NamedTuple):
    """Where a table tells objects: number, generation and place of each, and those within others (number, number of that)."""

    places: list[tuple[int, int, int]]
    packed: list[tuple[int, int]]
    previous: int


def is_clear(before: bytes, after: bytes) -> bool:
    """Return whether all that was added behind ``before`` can be read in one way only; what it changes is another question."""
    try:
        sections = list(_sections(before, after))
    except (_Unclear, pikepdf.PdfError):
        return False
    added, told = after[len(before) :], {place for each in sections for place in each.places}
    found = [(int(each[1]), int(each[2]), each.start() + len(before)) for each in _OBJECT.finditer(added)]
    starts = len(_START.findall(added)), added.count(b"startxref")
    return set(found) == told and starts == (len(sections),) * 2 and _has_one_root(after, added)


def _sections(before: bytes, after: bytes) -> Iterator[_Section]:
    """The tables that were added, from the last on to the one that was there."""
    stop, place = _start(before), _start(after)
    for _ in range(MOST_SECTIONS):
        if place == stop:
            return
        if not len(before) <= place < len(after):
            break
        section = _table(after, place) if after.startswith(b"xref", place) else _stream(after, place)
        numbers = [each[0] for each in (*section.places, *section.packed)]
        if len(set(numbers)) != len(numbers) or not stop <= section.previous < place:
            break
        yield section
        place = section.previous
    raise _Unclear


def _start(content: bytes) -> int:
    found = _START.findall(content)
    if not found:
        raise _Unclear
    return int(found[-1])


def _table(whole: bytes, place: int) -> _Section:
    """A table in letters, of exactly the form that the standard gives it."""
    at = _matched(_HEAD, whole, place).end()
    places: list[tuple[int, int, int]] = []
    while part := _RANGE.match(whole, at):
        at = part.end()
        for number in range(int(part[1]), int(part[1]) + int(part[2])):
            entry = _matched(_ENTRY, whole, at)
            at = entry.end()
            if entry[3] == b"n":
                places.append((number, int(entry[2]), int(entry[1])))
            elif number:  # what is taken away may be there for others
                raise _Unclear
    trailer = _matched(_TRAILER, whole, at)[1]
    if b"/XRefStm" in trailer:
        raise _Unclear
    return _Section(places, [], _previous(trailer))


def _stream(whole: bytes, place: int) -> _Section:
    """A table as a stream; the stream itself need not be in it."""
    head = _matched(_OBJECT, whole, place)
    number, generation = int(head[1]), int(head[2])
    with _read_with(whole, number, generation, place) as pdf:
        table = pdf.get_object((number, generation))
        if not isinstance(table, pikepdf.Stream) or table.get("/Type") != "/XRef":
            raise _Unclear
        places, packed = _entries(table)
        for within in {each[1] for each in packed}:
            if _numbers_within(pdf.get_object((within, 0))) != [each[0] for each in packed if each[1] == within]:
                raise _Unclear
        previous = int(table.get("/Prev", -1))
    own = number, generation, place
    return _Section(places if own in places else [*places, own], packed, previous)


def _entries(table: pikepdf.Stream) -> tuple[list[tuple[int, int, int]], list[tuple[int, int]]]:
    widths = [max(int(each), 0) for each in list(table["/W"])]
    if len(widths) != 3:
        raise _Unclear
    told: Any = table.get("/Index", [0, table["/Size"]])
    index = [int(each) for each in told]
    data, places, packed, at = table.read_bytes(), list[tuple[int, int, int]](), list[tuple[int, int]](), 0
    for first, count in zip(index[::2], index[1::2], strict=True):
        for number in range(first, first + count):
            if not at < at + sum(widths) <= len(data):
                raise _Unclear
            fields = []
            for width in widths:
                fields.append(int.from_bytes(data[at : at + width], "big"))
                at += width
            kind = fields[0] if widths[0] else 1
            if kind == 1:
                places.append((number, fields[2], fields[1]))
            elif kind == 2:
                packed.append((number, fields[1]))
            elif number:
                raise _Unclear
    if at != len(data):
        raise _Unclear
    return places, packed


def _numbers_within(stream: object) -> list[int]:
    """The numbers of the objects that are packed in a stream, in their order."""
    if not isinstance(stream, pikepdf.Stream) or "/Extends" in stream:
        raise _Unclear
    words = stream.read_bytes()[: int(stream["/First"])].split()
    return [int(each) for each in words[: 2 * int(stream["/N"]) : 2]]


def _read_with(whole: bytes, number: int, generation: int, place: int) -> pikepdf.Pdf:
    """The file with one more table, which tells this object alone."""
    with pikepdf.open(io.BytesIO(whole), attempt_recovery=False, suppress_warnings=True) as pdf:
        size, root = max(int(pdf.trailer["/Size"]), number + 1), pdf.Root.objgen
    more = b"\nxref\n%d 1\n%010d %05d n \ntrailer\n<< /Size %d /Root %d %d R /Prev %d >>\nstartxref\n%d\n%%%%EOF\n" % (
        number, place, generation, size, *root, _start(whole), len(whole) + 1,
    )  # fmt: skip
    return pikepdf.open(io.BytesIO(whole + more), attempt_recovery=False, suppress_warnings=True)


def _has_one_root(after: bytes, added: bytes) -> bool:
    """Whether wherever the added part names a root it is that of the document."""
    with pikepdf.open(io.BytesIO(after), attempt_recovery=False, suppress_warnings=True) as pdf:
        number, generation = pdf.Root.objgen
    right = re.compile(rb"\s*0*%d\s+0*%d\s+R(?![A-Za-z])" % (number, generation))
    return all(right.match(added, each.end()) for each in _ROOT.finditer(added))


def _previous(trailer: bytes) -> int:
    found = _PREVIOUS.findall(trailer)
    if len(found) != 1 or trailer.count(b"/Prev") != 1:
        raise _Unclear
    return int(found[0])


def _matched(pattern: re.Pattern[bytes], whole: bytes, place: int) -> re.Match[bytes]:
    found = pattern.match(whole, place)
    if found is None:
        raise _Unclear
    return found
