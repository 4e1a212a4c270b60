"""What became of a PDF after it was made or signed: were only signatures added, or was anything of it changed?"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from decimal import Decimal
from typing import Any

import pikepdf

from diecut_report.exchange import pdf_attachments
from diecut_report.exchange.added_sections import AddedRevision, revisions
from diecut_report.exchange.carried import MOST_RESULTS
from diecut_report.exchange.pdf_attachments import bounded

OF_FIELD = {"/V", "/AP", "/F", "/M"}  # what signing sets in a field: the signature, how it shows, its flags, its time
OF_FORM = {"/SigFlags", "/Fields"}  # the fields may grow by document timestamps
OF_ROOT = {
    "/AcroForm",
    "/Extensions",
    "/Version",
    "/DSS",
    "/Perms",
}  # with what proves certificates, and what a signer allows
OF_TIMESTAMP = {"/Type", "/Subtype", "/FT", "/T", "/TU", "/V", "/Rect", "/F", "/P", "/M", "/Ff"}
FLAGS = (
    4 | 128 | 512
)  # printed, locked, its contents locked; others let a field grow over the sheet where it is shown small
FAULTS = (pikepdf.PasswordError, *pdf_attachments.FAULTS)
REFERENCE = re.compile(rb"\b(\d+) (\d+) R\b")


def only_signed(before: bytes, after: bytes) -> bool:
    """Return whether all objects of a PDF are the same in a later one, but for fields that were free and are signed there.

    What is added beside is reached from these fields alone, and shows within their boxes, or is a document timestamp, which does not show.
    """
    bounded(MOST_RESULTS)
    try:
        with _opened(before) as old:
            return all(_is_signing(old, each) for each in revisions(before, after))
    except FAULTS:
        return False


def _is_signing(old: pikepdf.Pdf, revision: AddedRevision) -> bool:
    with _opened(revision.content) as new:
        same = not new.is_encrypted and all(
            old.trailer.get(key, _NONE).objgen == new.trailer.get(key, _NONE).objgen for key in ("/Root", "/Info")
        )
        lists = set(_lists(old))
        kept = (_is_kept(each, new.get_object(each.objgen), old, new, lists) for each in old.objects)
        same = same and all(kept) and not _filled_gaps(old, new) and revision.is_plain(new)
        return same and not new.get_warnings()  # a key that stands twice is for each reader another one


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


def _filled_gaps(old: pikepdf.Pdf, new: pikepdf.Pdf) -> bool:
    """Whether there is something now where the document refers to nothing."""
    there = {each.objgen for each in old.objects}
    named = {(int(a), int(b)) for each in old.objects for a, b in REFERENCE.findall(each.unparse(resolved=True))}
    return not {each.objgen for each in new.objects}.isdisjoint(named - there)


def _is_kept(first: Any, second: Any, old: pikepdf.Pdf, new: pikepdf.Pdf, lists: set[tuple[int, int]]) -> bool:
    if first.unparse(resolved=True) == second.unparse(resolved=True):
        return not isinstance(first, pikepdf.Stream) or first.read_raw_bytes() == second.read_raw_bytes()
    if isinstance(first, pikepdf.Array) and isinstance(second, pikepdf.Array):
        return first.objgen in lists and _grown(first, second)
    if not all(
        isinstance(each, pikepdf.Dictionary) and not isinstance(each, pikepdf.Stream) for each in (first, second)
    ):
        return False
    if first.objgen == old.Root.objgen:
        return _same_but(first, second, OF_ROOT) and _is_form(
            old.Root.get("/AcroForm", _NONE), new.Root.get("/AcroForm", _NONE)
        )
    if first.get("/FT") == "/Sig" and "/V" not in first:
        added = int(second.get("/F", 0)) & ~int(first.get("/F", 0)) & ~FLAGS
        is_shown_within = "/AP" not in second or _is_cut(second["/AP"])
        is_signed = "/ByteRange" in second.get("/V", _NONE)
        return not added and is_shown_within and is_signed and _same_but(first, second, OF_FIELD)
    if first.get("/Type") == "/Page":
        return _same_but(first, second, {"/Annots"}) and _grown(first.get("/Annots"), second.get("/Annots"))
    return first.objgen == old.Root.get("/AcroForm", _NONE).objgen and _is_form(first, second)


def _is_cut(appearance: Any) -> bool:
    """Whether a field shows a drawing with a box; without one some programs let it reach over the sheet."""
    drawing = appearance.get("/N")
    if set(appearance.keys()) != {"/N"} or not isinstance(drawing, pikepdf.Stream):
        return False
    box = list(drawing["/BBox"])
    is_box = len(box) == 4 and all(isinstance(each, int | Decimal) for each in box)
    return bool(drawing["/Subtype"] == "/Form" and is_box and box[0] != box[2] and box[1] != box[3])


def _is_form(first: Any, second: Any) -> bool:
    return _same_but(first, second, OF_FORM) and _grown(first.get("/Fields"), second.get("/Fields"))


def _grown(first: Any, second: Any) -> bool:
    """Whether a list is the same, but for document timestamps at its end."""
    if first is None and second is None:
        return True
    a, b = (list(each) if isinstance(each, pikepdf.Array) else [] for each in (first, second))
    same = len(a) <= len(b) and all(
        x.objgen == y.objgen and x.unparse() == y.unparse() for x, y in zip(a, b, strict=False)
    )
    return same and all(map(_is_timestamp, b[len(a) :]))


def _is_timestamp(field: Any) -> bool:
    """Whether a field is a document timestamp, and nothing that shows or acts."""
    if not isinstance(field, pikepdf.Dictionary) or not set(field.keys()) <= OF_TIMESTAMP:
        return False
    box, value = [float(each) for each in field["/Rect"]], field.get("/V", _NONE)
    is_field = field["/Subtype"] == "/Widget" and field["/FT"] == "/Sig"  # a note shows, however small its box
    return is_field and value.get("/Type") == "/DocTimeStamp" and "/ByteRange" in value and box[:2] == box[2:]


def _same_but(first: Any, second: Any, keys: set[str]) -> bool:
    """Whether two dictionaries differ in these keys alone."""
    return all(_written(first, key) == _written(second, key) for key in {*first.keys(), *second.keys()} - keys)


def _written(data: Any, key: str) -> object:
    """What stands at a key, with what is referred to by its number."""
    found = data.get(key)
    return found.unparse() if isinstance(found, pikepdf.Object) else (type(found), found)
