"""The revisions that were added to a PDF, where all programs read them alike: each ends with a table that leaves no choice.

A program that cannot read a table searches the file for objects by itself, each program in its own way. So nothing may stand there that
only such a search finds, and each revision is given by itself: whatever a program takes out of one was judged.

Programs differ also in what they take for a blank, a comment or the end of a name, and in the ways of packing that they know. So a revision
is one object after the other, written in what all of them read alike, and what holds other objects is packed in one way or not at all.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import pikepdf

MOST_REVISIONS, MOST_ADDED = 50, 100_000  # the latter objects in a revision
LONGEST_END = 64  # bytes behind the end; a program looks for the last table in about a thousand
LONGEST_GAP = 64  # bytes between the numbers of an object and what it is; more are not taken
KEYS = {"/Type", "/Size", "/Index", "/W", "/ID", "/Prev", "/Length", "/Filter", "/DecodeParms"}  # with /Root and /Info
_LINE = rb"(?:\r\n|\n|\r)"
_START = re.compile(rb"[\r\n]startxref" + _LINE + rb"(\d{1,15})" + _LINE + rb"%%EOF")
_TABLE = re.compile(rb"(\d{1,10}) 0 obj[\r\n ]*<<([^#%(]*?)>>[\r\n ]*stream\r?\n")
_REFERENCES = re.compile(rb"/(?:Root|Info) \d+ \d+ R")
_TABLE_END = re.compile(rb"[\r\n]*endstream[\r\n ]+endobj[\r\n ]*")
_OBJECT = re.compile(rb"(?<!end)obj")
_GAP = rb"[\0-\x20\x7f-\xff]"  # with all that any program takes for white space
_NUMBER = rb"[0-9+.-]+"
_HEAD = re.compile(  # a number may stand behind a comment; one with a backslash is a letter of a text
    rb"(?:(?:\A|[\r\n])%b*(?:%b)?|(?<![\\0-9+.-])%b%b+%b)%b*\Z" % (_GAP, _NUMBER, _NUMBER, _GAP, _NUMBER, _GAP)
)
_TRAILER = re.compile(rb"trailer" + _GAP + rb"*<<")
_BLANK = rb"[\t\n\f\r ]"
_WORD = rb"[!\"$&'*-.0-;=?-Z\\^-z|~]+"  # neither a delimiter nor a control character, nor one beyond ASCII
_TOKEN = re.compile(
    rb"(?:%b+|<<|>>|[\[\]]|<[\dA-Fa-f]*>|/(?:%b|#[\dA-Fa-f]{2})+|%b|\((?:[^()\\\r]|\\[0-3][0-7]{2}|\\[nrtbf()\\])*\))"
    % (_BLANK, _WORD, _WORD)
)
_LENGTH = re.compile(rb"/Length%b+(\d+)%b*(?:/|>>)" % (_BLANK, _BLANK))
_STREAM_END = re.compile(rb"[\r\n]*endstream%b+endobj%b*" % (_BLANK, _BLANK))
_PACKED_KEYS = {"/Type", "/N", "/First", "/Length", "/Filter"}


class AddedRevision(NamedTuple):
    """Hold the file up to the end of a revision, the number of its table, where its objects stand, and those that streams of it hold."""

    content: bytes
    table: int
    placed: dict[int, int]
    packed: dict[int, list[int]]

    def is_plain(self, pdf: pikepdf.Pdf) -> bool:
        """Return whether only this revision's table tells of objects, and only streams that it names hold some: those that it says."""
        objects = {number: pdf.get_object(number, 0) for number in self.placed}
        holders = {number for number, each in objects.items() if _type(each) == "/ObjStm"}
        tables = {number for number, each in objects.items() if _type(each) == "/XRef"}
        return (
            tables <= {self.table}
            and holders == self.packed.keys()
            and all(_numbers_within(objects[number]) == self.packed[number] for number in holders)
        )


def revisions(before: bytes, after: bytes) -> Iterator[AddedRevision]:
    """Give what was added behind ``before``, revision by revision; ValueError where programs may read it in several ways."""
    begin, former = len(before), int(_START.findall(before)[-1])
    starts = list(_START.finditer(after, begin))
    last = starts[-1].end() if starts else begin
    _require(len(starts) <= MOST_REVISIONS and after.count(b"startxref", begin) == len(starts))
    _require(len(after) - last <= LONGEST_END and not _has_other_objects(after[last:], set()))
    for start in starts:
        yield _revision(after[: start.end()], begin, start, former)
        begin, former = start.end(), int(start[1])


def _revision(whole: bytes, begin: int, start: re.Match[bytes], former: int) -> AddedRevision:
    """The last revision of a file, which has what was added from ``begin`` on."""
    place = int(start[1])
    number, told, data = _table(whole, place, start.start())
    _require(begin <= place and told["/Prev"] == former)
    placed, packed = _entries(told, data)
    _require(placed.get(number) == place)
    for each, at in placed.items():
        _require(begin <= at <= place and whole[at - 1] in b"\r\n" and whole.startswith(b"%d 0 obj" % each, at))
    _require_plain(whole[begin : start.start()], sorted(at - begin for at in placed.values()))
    known = {at + len(f"{each} 0 ") - begin for each, at in placed.items()}
    _require(not _has_other_objects(whole[begin:], known))
    return AddedRevision(whole, number, placed, packed)


def _require_plain(part: bytes, places: list[int]) -> None:
    """Refuse what is not these objects one after the other, or holds what programs may read in several ways."""
    _require(places and not part[: places[0]].strip(b"\r\n"))
    for at, end in zip(places, [*places[1:], len(part)], strict=True):
        _require_plain_object(part[at:end])


def _require_plain_object(written: bytes) -> None:
    last, at = next(each for each in _tokens(written) if each[0] in (b"stream", b"endobj"))
    if last == b"endobj":
        _require(not written[at:].strip())
        return
    lengths, begin = _LENGTH.findall(written, 0, at), written.find(b"\n", at) + 1
    _require(len(lengths) == 1 and written[at:begin] in (b"\n", b"\r\n"))
    _require(_STREAM_END.fullmatch(written, begin + int(lengths[0])))


def _tokens(written: bytes) -> Iterator[tuple[bytes, int]]:
    """Each token with its end; ValueError where a program may see others."""
    at = 0
    while found := _TOKEN.match(written, at):
        at = found.end()
        yield found[0], at
    _require(at == len(written))


def _table(whole: bytes, place: int, stop: int) -> tuple[int, Any, bytes]:
    """The number of a table, what it tells of itself, and its rows; nothing may stand between it and ``stop``."""
    found = _TABLE.match(whole, place)
    if found is None:
        raise ValueError
    number, told = int(found[1]), pikepdf.Object.parse(b"<<%b>>" % _REFERENCES.sub(b"", found[2]))
    end = found.end() + int(told["/Length"])
    _require(set(told.keys()) <= KEYS and told["/Type"] == "/XRef")
    _require(told.get("/Filter", "/FlateDecode") == "/FlateDecode")
    rows = pikepdf.Dictionary(Predictor=12, Columns=sum(_whole_numbers(told["/W"])))
    _require("/DecodeParms" not in told or told["/DecodeParms"] == rows)
    _require(_TABLE_END.fullmatch(whole, end, stop))
    with pikepdf.new() as pdf:
        return number, told, pikepdf.Stream(pdf, whole[found.end() : end], told).read_bytes()


def _entries(told: Any, data: bytes) -> tuple[dict[int, int], dict[int, list[int]]]:
    """Where a table says that objects stand, and what others hold: the numbers in their order."""
    widths, index = _whole_numbers(told["/W"]), _whole_numbers(told.get("/Index", [0, told["/Size"]]))
    kinds, places, ends = (sum(widths[:count]) for count in (1, 2, 3))
    _require(len(widths) == 3 and places > kinds and len(data) == ends * sum(index[1::2]) <= ends * MOST_ADDED)
    numbers = [
        each for first, count in zip(index[::2], index[1::2], strict=True) for each in range(first, first + count)
    ]
    _require(len(set(numbers)) == len(numbers))
    placed, packed = dict[int, int](), dict[int, list[int]]()
    for at, number in enumerate(numbers):
        row = data[at * ends : (at + 1) * ends]
        kind = int.from_bytes(row[:kinds], "big") if kinds else 1
        first, second = int.from_bytes(row[kinds:places], "big"), int.from_bytes(row[places:], "big")
        if kind == 1 and not second:  # a later generation is another object for some programs
            placed[number] = first
        elif kind == 2 and second == len(packed.setdefault(first, [])):
            packed[first].append(number)
        else:  # what is taken away may be there for others
            _require(kind == 0 and number == 0)
    return placed, packed


def _numbers_within(stream: Any) -> list[int]:
    """The numbers of the objects that a stream holds, in their order."""
    _require(set(stream.keys()) <= _PACKED_KEYS and stream.get("/Filter", "/FlateDecode") == "/FlateDecode")
    content = stream.read_bytes()
    words = content[: int(stream["/First"])].split()
    _require(len(words) == 2 * int(stream["/N"]) and all(map(bytes.isdigit, words)))
    _require({b"obj", b"endobj", b"stream"}.isdisjoint(token for token, _ in _tokens(content)))
    return [int(each) for each in words[::2]]


def _has_other_objects(part: bytes, known: set[int]) -> bool:
    """Whether a program that searches for objects, or for what tells of them, could find others than those that are known."""
    others = (each.start() for each in _OBJECT.finditer(part) if each.start() not in known)
    return bool(_TRAILER.search(part)) or any(_HEAD.search(part[max(at - LONGEST_GAP, 0) : at]) for at in others)


def _type(found: Any) -> object:
    return found.get("/Type") if isinstance(found, pikepdf.Dictionary | pikepdf.Stream) else None


def _whole_numbers(array: Any) -> list[int]:
    numbers = list(array)
    _require(all(type(each) is int and each >= 0 for each in numbers))
    return numbers


def _require(holds: object) -> None:
    if not holds:
        raise ValueError
