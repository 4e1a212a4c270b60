"""What became of a PDF after it was made or signed: were only signatures added, or was anything of it changed?"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Set
from decimal import Decimal
from typing import Any, NamedTuple

import pikepdf

from diecut_report.exchange import pdf_attachments
from diecut_report.exchange.added_sections import END, PARTS, TEXT, AddedRevision, revisions
from diecut_report.exchange.carried import MOST_RESULTS
from diecut_report.exchange.pdf_attachments import bounded

OF_FIELD = {"/V", "/AP", "/F", "/M"}  # what signing sets in a field: the signature, how it shows, its flags, its time
OF_FORM = {"/SigFlags", "/Fields"}  # the fields may grow by document timestamps
OF_PROOFS = {"/DSS", "/Extensions"}  # what proves certificates, with the name of that extension
OF_ROOT = OF_PROOFS | {"/AcroForm", "/Version", "/Perms"}  # with what a signer allows
OF_DSS = {"/Type", "/Certs", "/CRLs", "/OCSPs", "/VRI"}
OF_TIMESTAMP = {"/Type", "/Subtype", "/FT", "/T", "/TU", "/V", "/Rect", "/F", "/P", "/M", "/Ff"}
OF_DRAWING = {"/Type", "/Subtype", "/FormType", "/BBox", "/Matrix", "/Resources", "/Length", "/Filter"}
OF_RESOURCES = {"/Font", "/ProcSet", "/ExtGState"}
OF_STATE = {"/Type", "/CA", "/ca"}  # of which the latter tell how opaque it is
LARGEST_BOX = 14_400  # points; beyond that programs round, each in its own way
OPERATORS = rb"cm|re|gs|BT|ET|BMC|EMC|rg|RG|T[cdDfjJLmrswz*]|[fBbW]\*|[qQwJjMdmlcvyhSsfFBbnWgGkK]"
"""Of paths, colours and text. With others, such as pictures within a drawing, programs differ in where it ends."""
FLAGS = (
    4 | 128 | 512
)  # printed, locked, its contents locked; others let a field grow over the sheet where it is shown small
FAULTS = (pikepdf.PasswordError, *pdf_attachments.FAULTS)
_DRAWN = re.compile(rb"(?:(%b)%b|%b|%b)" % (OPERATORS, END, PARTS, TEXT), re.ASCII)


def only_signed(before: bytes, after: bytes) -> bool:
    """Return whether all objects of a PDF are the same in a later one, but for fields that were free and are signed there.

    Each added revision fills one field, adds a document timestamp, or what proves certificates. What it adds beside is reached from
    there alone, and shows within the field's box, or not at all.
    """
    bounded(MOST_RESULTS)
    try:
        for revision in revisions(before, after):
            with _opened(before) as old, _opened(revision.content) as new:
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


class _Changes(NamedTuple):
    """What a revision changes of the objects that were there, by their numbers, and the numbers of those that it adds."""

    old: pikepdf.Pdf
    new: pikepdf.Pdf
    changed: dict[int, tuple[Any, Any]]
    added: Set[int]

    @classmethod
    def made(cls, old: pikepdf.Pdf, new: pikepdf.Pdf, revision: AddedRevision) -> _Changes:
        pairs = {number: (old.get_object(number, 0), new.get_object(number, 0)) for number in revision.placed}
        there = {number: pair for number, pair in pairs.items() if pair[0] is not None}  # type: ignore[redundant-expr]
        return cls(old, new, there, pairs.keys() - there.keys())

    def are_signing(self) -> bool:
        fields = [number for number, (first, _) in self.changed.items() if _is_free_field(first)]
        if len(fields) > 1 or any(number < int(self.old.trailer.Size) for number in self.added):
            return False
        of_root = OF_ROOT if fields or self._has_timestamp() else OF_PROOFS
        return all(self._is_signing(number, *pair, of_root) for number, pair in self.changed.items())

    def _has_timestamp(self) -> bool:
        before, after = (len(pdf.Root.get("/AcroForm", _NONE).get("/Fields", ())) for pdf in (self.old, self.new))
        return after > before

    def _is_signing(self, number: int, first: Any, second: Any, of_root: set[str]) -> bool:
        """Whether an object is the same, or changed as by a signature."""
        if isinstance(first, pikepdf.Stream) or isinstance(second, pikepdf.Stream):
            return False
        if first.unparse(resolved=True) == second.unparse(resolved=True):
            return True
        if isinstance(first, pikepdf.Array) and isinstance(second, pikepdf.Array):
            return first.objgen in set(_lists(self.old)) and self._grown(first, second)
        if not (isinstance(first, pikepdf.Dictionary) and isinstance(second, pikepdf.Dictionary)):
            return False
        if first.objgen == self.old.Root.objgen:
            forms = (pdf.Root.get("/AcroForm", _NONE) for pdf in (self.old, self.new))
            return _same_but(first, second, of_root) and self._is_form(*forms)
        if first.objgen == self.old.Root.get("/DSS", _NONE).objgen:
            return {*first.keys(), *second.keys()} <= OF_DSS
        if _is_free_field(first):
            return self._is_filled(first, second)
        if first.get("/Type") == "/Page":
            return _same_but(first, second, {"/Annots"}) and self._grown(first.get("/Annots"), second.get("/Annots"))
        return first.objgen == self.old.Root.get("/AcroForm", _NONE).objgen and self._is_form(first, second)

    def _is_filled(self, first: Any, second: Any) -> bool:
        """Whether a free field got a signature that this revision adds, and shows it within its box."""
        flags = int(second.get("/F", 0)) & ~int(first.get("/F", 0)) & ~FLAGS
        is_shown_within = "/AP" not in second or _is_cut(second["/AP"])
        return not flags and is_shown_within and self._is_added_signature(second) and _same_but(first, second, OF_FIELD)

    def _is_added_signature(self, field: Any) -> bool:
        value = field.get("/V", _NONE)
        return value.objgen[0] in self.added and "/ByteRange" in value

    def _is_form(self, first: Any, second: Any) -> bool:
        return _same_but(first, second, OF_FORM) and self._grown(first.get("/Fields"), second.get("/Fields"))

    def _grown(self, first: Any, second: Any) -> bool:
        """Whether a list is the same, but for document timestamps at its end."""
        if first is None and second is None:
            return True
        a, b = (list(each) if isinstance(each, pikepdf.Array) else [] for each in (first, second))
        same = len(a) <= len(b) and all(
            x.objgen == y.objgen and x.unparse() == y.unparse() for x, y in zip(a, b, strict=False)
        )
        return same and all(map(self._is_timestamp, b[len(a) :]))

    def _is_timestamp(self, field: Any) -> bool:
        """Whether a field is a document timestamp, and nothing that shows or acts."""
        if not isinstance(field, pikepdf.Dictionary) or not set(field.keys()) <= OF_TIMESTAMP:
            return False
        box = [float(each) for each in field["/Rect"]]
        is_field = field["/Subtype"] == "/Widget" and field["/FT"] == "/Sig"  # a note shows, however small its box
        is_dated = self._is_added_signature(field) and field["/V"]["/Type"] == "/DocTimeStamp"
        return is_field and is_dated and box[:2] == box[2:]


def _is_free_field(found: Any) -> bool:
    is_field = isinstance(found, pikepdf.Dictionary) and not isinstance(found, pikepdf.Stream)
    return bool(is_field and found.get("/FT") == "/Sig" and "/V" not in found)


def _is_cut(appearance: Any) -> bool:
    """Whether a field shows one drawing, which no program lets reach out of its box."""
    drawing = appearance.get("/N")
    if set(appearance.keys()) != {"/N"} or not isinstance(drawing, pikepdf.Stream):
        return False
    box = list[object](drawing["/BBox"])
    corners = [float(each) for each in box if isinstance(each, int | Decimal)]
    is_upright = [float(each) for each in drawing.get("/Matrix", (1, 0, 0, 1, 0, 0))] == [1, 0, 0, 1, 0, 0]
    is_plain = set(drawing.keys()) <= OF_DRAWING and drawing.get("/Filter", "/FlateDecode") == "/FlateDecode"
    is_box = len(corners) == len(box) == 4 and max(map(abs, corners)) <= LARGEST_BOX
    return bool(
        drawing["/Subtype"] == "/Form" and is_upright and is_plain
        and is_box and min(abs(corners[0] - corners[2]), abs(corners[1] - corners[3])) >= 1
        and _takes_plain(drawing.get("/Resources", _NONE)) and _is_balanced(drawing.read_bytes())
    )  # fmt: skip


def _takes_plain(resources: Any) -> bool:
    """Whether a drawing takes letters that draw nothing else, and states that tell how opaque it is."""
    fonts, states = ([each for _, each in resources.get(key, _NONE).items()] for key in ("/Font", "/ExtGState"))
    return (
        set(resources.keys()) <= OF_RESOURCES
        and all(each.get("/Subtype") != "/Type3" for each in fonts)
        and all(set(each.keys()) <= OF_STATE for each in states)
    )


def _is_balanced(drawn: bytes) -> bool:
    """Whether a drawing takes back no more than it has saved: some programs would take back the box that cuts it."""
    depth, at = 0, 0
    while found := _DRAWN.match(drawn, at):
        at, depth = found.end(), depth + {b"q": 1, b"Q": -1}.get(found[1], 0)
        if depth < 0:
            return False
    return at == len(drawn) and depth == 0


def fault(content: bytes) -> str:
    """Return why the objects of a PDF cannot be read within bounds; "" where they can, so that a library without bounds may read them."""
    bounded(MOST_RESULTS)
    try:
        with _opened(content) as pdf:
            for _ in pdf.objects:  # each is unpacked from the stream that holds it
                pass
    except FAULTS as error:
        return f"{error}" or type(error).__name__
    return ""


def added_proofs(before: bytes, after: bytes) -> bool:
    """Return whether a later PDF holds more of what proves certificates (DSS), which may stand behind the last signature."""
    try:
        with _opened(before) as old, _opened(after) as new:
            return bool("/DSS" in new.Root and _written(old.Root, "/DSS") != _written(new.Root, "/DSS"))
    except FAULTS:
        return False


_NONE = pikepdf.Dictionary()


def _opened(content: bytes) -> pikepdf.Pdf:
    return pikepdf.open(io.BytesIO(content), attempt_recovery=False, suppress_warnings=True)


def _lists(old: pikepdf.Pdf) -> Iterator[tuple[int, int]]:
    """The lists that a document timestamp is added to, where they are objects of their own: the fields, the annotations of sheets."""
    form = old.Root.get("/AcroForm", _NONE)
    for found in (form.get("/Fields"), *(page.obj.get("/Annots") for page in old.pages)):
        if isinstance(found, pikepdf.Array) and found.objgen != (0, 0):
            yield found.objgen


def _same_but(first: Any, second: Any, keys: set[str]) -> bool:
    """Whether two dictionaries differ in these keys alone."""
    return all(_written(first, key) == _written(second, key) for key in {*first.keys(), *second.keys()} - keys)


def _written(data: Any, key: str) -> object:
    """What stands at a key, with what is referred to by its number."""
    found = data.get(key)
    return found.unparse() if isinstance(found, pikepdf.Object) else (type(found), found)
