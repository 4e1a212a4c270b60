"""What became of a PDF after it was made or signed: were only signatures added, or was anything of it changed?"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator, Set
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta, timezone
from functools import cached_property
from typing import Any, NamedTuple

import pikepdf

from diecut_report.config.yaml import printable
from diecut_report.exchange import pdf_attachments
from diecut_report.exchange.carried import MOST_RESULTS
from diecut_report.exchange.pdf_attachments import bounded, opened
from diecut_report.report.symbols import LINE, MILLIMETRE, drawn, fitted

OF_FIELD = {"/V", "/AP", "/F", "/M"}  # what signing sets in a field: the signature, how it shows, its flags, its time
OF_FORM = {"/SigFlags", "/Fields"}  # the fields may grow by document timestamps
OF_PROOFS = {"/DSS", "/Extensions"}  # what proves certificates, with the name of that extension
OF_ROOT = OF_PROOFS | {"/AcroForm", "/Version", "/Perms"}  # with what a signer allows
OF_DSS = {"/Type", "/Certs", "/CRLs", "/OCSPs", "/VRI"}
OF_TIMESTAMP = {"/Type", "/Subtype", "/FT", "/T", "/TU", "/V", "/Rect", "/F", "/P", "/M", "/Ff"}
OF_DRAWING = {"/Type", "/Subtype", "/BBox", "/Resources", "/Length"}
OF_SIGNATURE = {"/Type", "/Filter", "/SubFilter", "/ByteRange", "/Contents", "/M", "/Name", "/Reason", "/Location", "/ContactInfo",
                "/Reference"}  # fmt: skip
OF_PROOF = {"/Type", "/Cert", "/CRL", "/OCSP", "/TU", "/TS"}  # of one signature
WRAPPED = re.compile(rb"q q (?:/BackgroundGS gs )?1 0 0 1 0 0 cm (.*) Q Q", re.DOTALL)
FLAGS = 4 | 128 | 512
"""Printed, locked, its contents locked; others let a field grow over the sheet where it is shown small."""
FAULTS = (pikepdf.PasswordError, *pdf_attachments.FAULTS)
_NONE = pikepdf.Dictionary()


def only_signed(before: bytes, after: bytes) -> bool:
    """Return whether all objects of a PDF are the same in a later one, but for fields that were free and are signed there.

    Each added revision fills one field, adds a document timestamp, or what proves certificates, and nothing that these do not take. A
    signature shows what this program draws of its name, time and reason, or nothing.
    """
    bounded(MOST_RESULTS)
    try:
        for revision in revisions(before, after):
            with opened(before) as old, opened(revision.content) as new:
                if not (_is_consistent(old, new, revision) and _Changes.made(old, new, revision).are_signing()):
                    return False
            before = revision.content
    except FAULTS:
        return False
    return True


def _is_consistent(old: pikepdf.Pdf, new: pikepdf.Pdf, revision: AddedRevision) -> bool:
    """Whether a revision belongs to the same document, and all programs find in it what its table says, and nothing else."""
    same = all(old.trailer.get(key, _NONE).objgen == new.trailer.get(key, _NONE).objgen for key in ("/Root", "/Info"))
    exist = all(number in revision.placed or old.get_object(number, 0) is not None for number in revision.named)
    is_same_document = same and exist and not new.is_encrypted and revision.is_plain(new)
    return is_same_document and not new.get_warnings()  # a key that stands twice is for each reader another one


@dataclass(frozen=True)
class _Changes:
    """What a revision changes of the objects that were there, by their numbers, and the numbers of those that it adds."""

    old: pikepdf.Pdf
    new: pikepdf.Pdf
    changed: dict[int, tuple[Any, Any]]
    added: Set[int]

    @classmethod
    def made(cls, old: pikepdf.Pdf, new: pikepdf.Pdf, revision: AddedRevision) -> _Changes:
        pairs = {number: (old.get_object(number, 0), new.get_object(number, 0)) for number in revision.placed}
        there = {number: pair for number, pair in pairs.items() if pair[0] is not None}  # type: ignore[redundant-expr]
        return cls(old, new, there, pairs.keys() - there.keys() - {revision.table})

    def are_signing(self) -> bool:
        fields = [pair[1] for pair in self.changed.values() if _is_free_field(pair[0])]
        stamps = _fields(self.new)[len(_fields(self.old)) :]
        of_root = OF_ROOT if fields or stamps else OF_PROOFS
        taken = {found.objgen[0] for field in (*fields, *stamps) for found in (field, field["/V"])}
        taken |= {field["/AP"]["/N"].objgen[0] for field in fields if "/AP" in field}
        taken |= _reached(self.new.Root.get("/DSS"))
        return (
            len(fields) + len(stamps) <= 1
            and self.added <= taken
            and all(number >= int(self.old.trailer.Size) for number in self.added)
            and all(self._is_signing(*pair, of_root) for pair in self.changed.values())
            and self._are_proofs()
        )

    def _are_proofs(self) -> bool:
        """Whether what proves certificates is of that kind, and nothing that was there for something else."""
        proofs, before = self.new.Root.get("/DSS", _NONE), _reached(self.old.Root.get("/DSS"))
        lists = [each for key, each in proofs.items() if key in ("/Certs", "/CRLs", "/OCSPs")]
        for own in proofs.get("/VRI", _NONE).values():
            lists += [each for key, each in own.items() if key not in ("/Type", "/TU", "/TS")]
            if not set(own.keys()) <= OF_PROOF:
                return False
        data = [each for listed in _once(lists) for each in listed]
        return (
            set(proofs.keys()) <= OF_DSS
            and _reached(proofs) <= self.added | before
            and all(isinstance(each, pikepdf.Stream) and set(each.keys()) <= {"/Length", "/Filter"} for each in data)
        )

    def _is_signing(self, first: Any, second: Any, of_root: set[str]) -> bool:
        """Whether an object is the same, or changed as by a signature."""
        if isinstance(first, pikepdf.Stream) or isinstance(second, pikepdf.Stream):
            return False
        if first.unparse(resolved=True) == second.unparse(resolved=True):
            return True
        if isinstance(first, pikepdf.Array) and isinstance(second, pikepdf.Array):
            return first.objgen in self._lists and self._grown(first, second)
        if not (isinstance(first, pikepdf.Dictionary) and isinstance(second, pikepdf.Dictionary)):
            return False
        if first.objgen == self.old.Root.objgen:
            forms = (pdf.Root.get("/AcroForm", _NONE) for pdf in (self.old, self.new))
            return _same_but(first, second, of_root) and self._is_form(*forms) and self._is_root(second)
        if first.objgen == self.old.Root.get("/DSS", _NONE).objgen:
            return bool(
                first.objgen == self.new.Root.get("/DSS", _NONE).objgen
            )  # whose content is judged with the proofs
        if _is_free_field(first):
            return self._is_filled(first, second)
        if first.get("/Type") == "/Page":
            return _same_but(first, second, {"/Annots"}) and self._grown(first.get("/Annots"), second.get("/Annots"))
        return first.objgen == self.old.Root.get("/AcroForm", _NONE).objgen and self._is_form(first, second)

    @cached_property
    def _names(self) -> frozenset[str]:
        """The names of the fields that were there."""
        return frozenset(map(_plain, _fields(self.old)))

    @cached_property
    def _lists(self) -> frozenset[tuple[int, int]]:
        """The lists that a document timestamp is added to, where they are objects of their own: the fields, the annotations of sheets."""
        lists = (
            self.old.Root.get("/AcroForm", _NONE).get("/Fields"),
            *(page.obj.get("/Annots") for page in self.old.pages),
        )
        return frozenset(each.objgen for each in lists if isinstance(each, pikepdf.Array) and each.objgen != (0, 0))

    def _is_root(self, root: Any) -> bool:
        """Whether the catalogue tells of its version and of what a signer allows, and of nothing else by it."""
        allowed = list(root.get("/Perms", _NONE).items())
        return (
            b" R" not in root.get("/Extensions", _NONE).unparse(resolved=True)
            and isinstance(root.get("/Version", pikepdf.Name("/1.7")), pikepdf.Name)
            and all(key == "/DocMDP" and each["/Type"] == "/Sig" for key, each in allowed)
        )

    def _is_filled(self, first: Any, second: Any) -> bool:
        """Whether a free field got a signature that this revision adds, and shows what that says."""
        flags = int(second.get("/F", 0)) & ~int(first.get("/F", 0)) & ~FLAGS
        if flags or not self._is_added_signature(second, "/Sig") or not _same_but(first, second, OF_FIELD):
            return False
        return "/AP" not in second or self._is_drawn(second["/AP"], second)

    def _is_drawn(self, appearance: Any, field: Any) -> bool:
        """Whether what a field shows is what this program draws of the signature."""
        shown = appearance.get("/N")
        is_alone = set(appearance.keys()) == {"/N"} and isinstance(shown, pikepdf.Stream)
        if not (is_alone and set(shown.keys()) <= OF_DRAWING):
            return False
        x1, y1, x2, y2 = (float(each) for each in field["/Rect"])
        width, height = abs(x2 - x1), abs(y2 - y1)
        box = [abs(float(each) - wanted) for each, wanted in zip(shown["/BBox"], (0, height, width, 0), strict=True)]
        found = WRAPPED.fullmatch(shown.read_bytes())
        name, time, reason = (str(field["/V"].get(key, "")) for key in ("/Name", "/M", "/Reason"))
        return (
            shown.objgen[0] in self.added
            and shown["/Subtype"] == "/Form"
            and max(box) <= 1
            and _takes_opacity(shown.get("/Resources", _NONE))
            and found is not None
            and found[1] in drawings(name, time, reason, width, height)
        )

    def _is_added_signature(self, field: Any, kind: str) -> bool:
        value = field.get("/V", _NONE)
        return (
            value.get("/Type") == kind
            and value.objgen[0] in self.added
            and set(value.keys()) <= OF_SIGNATURE
            and "/ByteRange" in value
        )

    def _is_form(self, first: Any, second: Any) -> bool:
        return _same_but(first, second, OF_FORM) and self._grown(first.get("/Fields"), second.get("/Fields"))

    def _grown(self, first: Any, second: Any) -> bool:
        """Whether a list is the same, but for one document timestamp at its end."""
        if first is None and second is None:
            return True
        if not isinstance(second, pikepdf.Array):
            return False
        a, b = list(first or ()), list(second)
        pairs = zip(a, b, strict=False)
        same = len(a) <= len(b) <= len(a) + 1 and all(
            x.objgen == y.objgen and x.unparse() == y.unparse() for x, y in pairs
        )
        return same and all(map(self._is_timestamp, b[len(a) :]))

    def _is_timestamp(self, field: Any) -> bool:
        """Whether a field is a document timestamp, and nothing that shows or acts."""
        if not isinstance(field, pikepdf.Dictionary) or not set(field.keys()) <= OF_TIMESTAMP:
            return False
        box = [float(each) for each in field["/Rect"]]
        is_field = field["/Subtype"] == "/Widget" and field["/FT"] == "/Sig"  # a note shows, however small its box
        is_dated = self._is_added_signature(field, "/DocTimeStamp") and _plain(field) not in self._names
        return is_field and is_dated and len(box) == 4 and box[:2] == box[2:]


def _fields(pdf: pikepdf.Pdf) -> list[Any]:
    return list(pdf.Root.get("/AcroForm", _NONE).get("/Fields", ()))


def _plain(field: Any) -> str:
    """The name of a field as somebody reads it."""
    return str(field.get("/T", "")).strip().casefold()


def _is_free_field(found: Any) -> bool:
    is_field = isinstance(found, pikepdf.Dictionary) and not isinstance(found, pikepdf.Stream)
    return bool(is_field and found.get("/FT") == "/Sig" and "/V" not in found)


def _takes_opacity(resources: Any) -> bool:
    """Whether a drawing takes nothing but states that tell how opaque it is."""
    states = [each for _, each in resources.get("/ExtGState", _NONE).items()]
    return set(resources.keys()) <= {"/ExtGState"} and all(set(each.keys()) <= {"/CA", "/ca"} for each in states)


def _once(found: list[Any]) -> list[Any]:
    """The same objects, those that have a number once, however often they are referred to."""
    numbered = {each.objgen: each for each in found if each.objgen[0]}
    return [*numbered.values(), *(each for each in found if not each.objgen[0])]


def _reached(found: Any, depth: int = 5) -> set[int]:
    """The numbers of the objects that something holds or is; each is looked into once, however often it is referred to."""
    numbers, waiting = set[int](), [(found, depth)]
    for each, left in waiting:
        if isinstance(each, pikepdf.Object) and left and each.objgen[0] not in numbers:
            numbers |= {each.objgen[0]} - {0}
            listed = each if isinstance(each, pikepdf.Array) else ()
            inner = each.values() if isinstance(each, pikepdf.Dictionary) else listed
            waiting += [(one, left - 1) for one in inner]
    return numbers


def added_proofs(before: bytes, after: bytes) -> bool:
    """Return whether a later PDF holds more of what proves certificates (DSS), which may stand behind the last signature."""
    try:
        with opened(before) as old, opened(after) as new:
            return bool("/DSS" in new.Root and _written(old.Root, "/DSS") != _written(new.Root, "/DSS"))
    except FAULTS:
        return False


def _same_but(first: Any, second: Any, keys: set[str]) -> bool:
    """Whether two dictionaries differ in these keys alone."""
    return all(_written(first, key) == _written(second, key) for key in {*first.keys(), *second.keys()} - keys)


def _written(data: Any, key: str) -> object:
    """What stands at a key, with what is referred to by its number."""
    found = data.get(key)
    return found.unparse() if isinstance(found, pikepdf.Object) else (type(found), found)


# What a signature shows in its field: who signed, when and why, as outlines, so that no font is needed that the document has not embedded.


SMALLEST, LARGEST = 2.5, 8.0  # points of the letters in a field
PAD = 1.0  # points between a field's edge and its letters
LIFTED = 0.3  # of a line: its baseline above its lower edge
MOST_LETTERS = 1000
TIME = re.compile(r"D:(\d{14})(?:Z|([+-])(\d\d)'(\d\d)'?)")


def drawing(name: str, time: datetime, reason: str | None, width: float, height: float) -> bytes:
    """Return the operators that draw who signed, when (UTC) and why, in a field of so many points."""
    told = printable(f"{name}, {time:%Y-%m-%d %H:%M} UTC" + (f", {reason}" if reason else ""))
    room = (width - 2 * PAD) / MILLIMETRE, (height - 2 * PAD) / MILLIMETRE
    lines, size = fitted(told, *room, LARGEST, SMALLEST)
    top = (height + len(lines) * size * LINE) / 2
    return "\n".join(
        f"q {size:.3f} 0 0 {size:.3f} {PAD:.3f} {top - (number + 1 - LIFTED) * size * LINE:.3f} cm {drawn(line)} Q"
        for number, line in enumerate(lines)
    ).encode()


def drawings(name: str, time: str, reason: str | None, width: float, height: float) -> Iterator[bytes]:
    """Give what a signature with these entries may show; ValueError where its time is none. It is drawn before its time is taken."""
    found = TIME.fullmatch(time)
    if found is None or len(name) + len(reason or "") > MOST_LETTERS:
        raise ValueError
    away = timedelta(hours=int(found[3] or 0), minutes=int(found[4] or 0)) * (-1 if found[2] == "-" else 1)
    told = datetime.strptime(found[1], "%Y%m%d%H%M%S").replace(tzinfo=timezone(away)).astimezone(UTC)
    for earlier in (0, 1):
        yield drawing(name, told - timedelta(minutes=earlier), reason, width, height)


# The revisions that were added to a PDF, where all programs read them alike: objects one after the other, and a table of them.
#
# Programs differ in what they take for a blank, a number or the end of a name, in the ways of packing that they know, and in what they do
# with a reference to nothing. A program that cannot read a table searches the file for objects by itself, each in its own way. So a
# revision may hold only what leaves no choice, written in one way: whoever writes otherwise is not misread, but refused.


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
