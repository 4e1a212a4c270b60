"""The revisions that were added to a PDF, where all programs read them alike: objects one after the other, and a table of them.

Programs differ in what they take for a blank, a number or the end of a name, in the ways of packing that they know, and in what they do
with a reference to nothing. A program that cannot read a table searches the file for objects by itself, each in its own way. So a
revision may hold only what leaves no choice, written in one way: whoever writes otherwise is not misread, but refused.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from typing import Any, NamedTuple

import pikepdf

MOST_ADDITIONS = 50
MOST_ADDED, MOST_BYTES = 100_000, 5_000_000  # of one addition: objects, and their bytes
LONGEST_END = 64  # bytes behind the end; a program looks for the last table in about a thousand
LONGEST_GAP = 64  # bytes between the numbers of an object and what it is; more are not taken
KEYS = {"/Type", "/Size", "/Index", "/W", "/ID", "/Prev", "/Length", "/Filter"}  # with /Root and /Info
_LINE = rb"(?:\r\n|\n|\r)"
_START = re.compile(rb"[\r\n]startxref" + _LINE + rb"([1-9]\d{0,14})" + _LINE + rb"%%EOF")
_TABLE = re.compile(rb"([1-9]\d{0,9}) 0 obj[\r\n ]*<<(.*?)>>[\r\n ]*stream\r?\n", re.DOTALL)
_REFERENCES = re.compile(rb"/(?:Root|Info) \d+ 0 R")
_OBJECT = re.compile(rb"(?<!end)obj")
_GAP = rb"[\0-\x20\x7f-\xff]"  # with all that any program takes for white space
_NUMBER = rb"[0-9+.-]+"
_HEAD = re.compile(  # a number may stand behind a comment; one with a backslash is a letter of a text
    rb"(?:(?:\A|[\r\n])%b*(?:%b)?|(?<![\\0-9+.-])%b%b+%b)%b*\Z" % (_GAP, _NUMBER, _NUMBER, _GAP, _NUMBER, _GAP)
)
WIDEST = (1, 8, 2)  # bytes of the columns of a table; a program that takes no more searches the file for objects

BLANK, END = rb"[\t\n\f\r ]", rb"(?![^\t\n\f\r ()<>\[\]/%])"
NUMBER = rb"-?(?:0|[1-9]\d{0,9})(?:\.\d{1,10})?%b" % END
PARTS = rb"%b+|<<|>>|[\[\]]|<(?:[\dA-Fa-f]{2})*>|/[\w.+-]{1,127}%b|%b" % (BLANK, END, NUMBER)
TEXT = rb"\((?:[^()\\\r]++|\\[0-3][0-7]{2}|\\[nrtbf()\\])*+\)"
_TOKEN = re.compile(rb"(?:([1-9]\d{0,9}) 0 R%b|(true|false|stream|endobj)%b|%b|%b)" % (END, END, PARTS, TEXT), re.ASCII)
_LENGTH = re.compile(rb"/Length%b+(\d+)%b(?!%b+\d+%b+R)" % (BLANK, END, BLANK, BLANK))
_STREAM_END = re.compile(rb"[\r\n]*endstream%b+endobj%b*" % (BLANK, BLANK))


class AddedRevision(NamedTuple):
    """Hold the file up to the end of a revision, the number of its table, where its objects stand, and the numbers that they refer to."""

    content: bytes
    table: int
    placed: dict[int, int]
    named: set[int]

    def is_plain(self, pdf: pikepdf.Pdf) -> bool:
        """Return whether only this revision's table tells of objects, and no stream holds some."""
        types = {number: _type(pdf.get_object(number, 0)) for number in self.placed}
        tables = {number for number, each in types.items() if each == "/XRef"}
        return tables <= {self.table} and "/ObjStm" not in types.values()


def revisions(before: bytes, after: bytes) -> Iterator[AddedRevision]:
    """Give what was added behind ``before``, revision by revision; ValueError where programs may read it in several ways."""
    begin, former = len(before), int(_START.findall(before)[-1])
    starts = list(_START.finditer(after, begin))
    last = starts[-1].end() if starts else begin
    _require(len(starts) <= MOST_ADDITIONS and after.count(b"startxref", begin) == len(starts))
    _require(b"trailer" not in after[begin:] and after.count(b"xref", begin) == len(starts))
    _require(len(after) - last <= LONGEST_END and not after[last:].strip(b"\r\n"))
    for start in starts:
        yield _revision(after[: start.end()], begin, start, former)
        begin, former = start.end(), int(start[1])


def _revision(whole: bytes, begin: int, start: re.Match[bytes], former: int) -> AddedRevision:
    """The last revision of a file, which has what was added from ``begin`` on."""
    place, part = int(start[1]), whole[begin : start.start()]
    _require(len(part) <= MOST_BYTES)
    number, told, data = _table(whole, place)
    _require(begin <= place and told["/Prev"] == former)
    placed = _entries(told, data)
    _require(placed.get(number) == place == max(placed.values()))
    places = sorted(at - begin for at in placed.values())
    _require(places[0] >= 0 and not part[: places[0]].strip(b"\r\n"))
    named = set[int]()
    for at, end in zip(places, [*places[1:], len(part)], strict=True):
        named |= _named(part[at:end])
    for each, at in placed.items():
        _require(whole[at - 1] in b"\r\n" and whole.startswith(b"%d 0 obj" % each, at))
    known = {at + len(f"{each} 0 ") - begin for each, at in placed.items()}
    added = whole[begin:]
    others = (each.start() for each in _OBJECT.finditer(added) if each.start() not in known)
    # a program that searches for objects would find those
    _require(not any(_HEAD.search(added[max(at - LONGEST_GAP, 0) : at]) for at in others))
    return AddedRevision(whole, number, placed, named)


def _named(written: bytes) -> set[int]:
    """The numbers that an object refers to; ValueError where it, or what follows it, may be read in several ways."""
    named, at = set[int](), written.find(b"obj") + len(b"obj")
    while found := _TOKEN.match(written, at):
        at = found.end()
        if found[1]:
            named.add(int(found[1]))
        if found[2] == b"endobj":
            _require(not written[at:].strip(b"\t\n\r "))
            return named
        if found[2] == b"stream":
            lengths, begin = _LENGTH.findall(written, 0, at), written.find(b"\n", at) + 1
            _require(len(lengths) == 1 and written[at:begin] in (b"\n", b"\r\n"))
            _require(_STREAM_END.fullmatch(written, begin + int(lengths[0])))
            return named
    raise ValueError


def _table(whole: bytes, place: int) -> tuple[int, Any, bytes]:
    """The number of a table, what it tells of itself, and its rows."""
    found = _TABLE.match(whole, place)
    if found is None:
        raise ValueError
    number, told = int(found[1]), pikepdf.Object.parse(b"<<%b>>" % _REFERENCES.sub(b"", found[2]))
    _require(set(told.keys()) <= KEYS and told["/Type"] == "/XRef")
    _require(told.get("/Filter", "/FlateDecode") == "/FlateDecode")
    packed, unpacking = whole[found.end() : found.end() + int(told["/Length"])], zlib.decompressobj()
    if "/Filter" not in told:
        return number, told, packed
    rows = unpacking.decompress(packed, sum(WIDEST) * MOST_ADDED)
    _require(unpacking.eof and not unpacking.unused_data)
    return number, told, rows


def _entries(told: Any, data: bytes) -> dict[int, int]:
    """Where a table says that objects stand."""
    widths, index = _whole_numbers(told["/W"]), _whole_numbers(told.get("/Index", [0, told["/Size"]]))
    kinds, places, ends = (sum(widths[:count]) for count in (1, 2, 3))
    _require(len(widths) == 3 and all(map(int.__le__, widths, WIDEST)) and places > kinds)
    _require(len(data) == ends * sum(index[1::2]) <= ends * MOST_ADDED)
    ranges = zip(index[::2], index[1::2], strict=True)
    numbers = [each for first, count in ranges for each in range(first, first + count)]
    _require(len(set(numbers)) == len(numbers))
    placed = dict[int, int]()
    for at, number in enumerate(numbers):
        row = data[at * ends : (at + 1) * ends]
        kind = int.from_bytes(row[:kinds], "big") if kinds else 1
        # a later generation is another object for some programs, and what is taken away may be there for others
        if number:
            _require(kind == 1 and not int.from_bytes(row[places:], "big"))
            placed[number] = int.from_bytes(row[kinds:places], "big")
        else:
            _require(kind == 0)
    return placed


def _type(found: Any) -> object:
    return found.get("/Type") if isinstance(found, pikepdf.Dictionary | pikepdf.Stream) else None


def _whole_numbers(array: Any) -> list[int]:
    numbers = list(array)
    _require(all(type(each) is int and each >= 0 for each in numbers))
    return numbers


def _require(holds: object) -> None:
    if not holds:
        raise ValueError
