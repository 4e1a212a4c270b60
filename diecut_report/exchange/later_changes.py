"""What became of a PDF after it was made or signed: were only signatures added, or was anything of it changed?"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta, timezone
from functools import cached_property
from typing import Any

import pikepdf

from diecut_report.config.yaml import printable
from diecut_report.exchange import pdf_attachments
from diecut_report.exchange.added_sections import AddedRevision, revisions
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
