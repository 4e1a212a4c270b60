"""What became of a PDF after it was signed: were only signatures added, or was anything of it changed?"""

from __future__ import annotations

import io
from typing import Any

import pikepdf

from diecut_report.exchange.carried_results import MOST_RESULTS
from diecut_report.exchange.pdf_attachments import FAULTS, bounded

OF_FIELD = {"/V", "/AP", "/F", "/M"}  # what signing sets in a field: the signature, how it shows, its flags, its time
OF_FORM = {"/SigFlags"}
OF_ROOT = {"/AcroForm", "/Extensions"}


def only_signed(before: bytes, after: bytes) -> bool:
    """Return whether all objects of a signed PDF are the same in a later one, but for fields that were free and are signed there.

    What is added beside is reached from these fields alone, and shows within their boxes.
    """
    bounded(MOST_RESULTS)
    try:
        with _opened(before) as old, _opened(after) as new:
            same = all(
                old.trailer.get(key, _NONE).objgen == new.trailer.get(key, _NONE).objgen for key in ("/Root", "/Info")
            )
            return same and all(_is_kept(each, new.get_object(each.objgen), old, new) for each in old.objects)
    except FAULTS:
        return False


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


_NONE = pikepdf.Dictionary()


def _opened(content: bytes) -> pikepdf.Pdf:
    return pikepdf.open(io.BytesIO(content), attempt_recovery=False, suppress_warnings=True)


def _is_kept(first: Any, second: Any, old: pikepdf.Pdf, new: pikepdf.Pdf) -> bool:
    if first.unparse(resolved=True) == second.unparse(resolved=True):
        return not isinstance(first, pikepdf.Stream) or first.read_raw_bytes() == second.read_raw_bytes()
    if not (isinstance(first, pikepdf.Dictionary) and isinstance(second, pikepdf.Dictionary)):
        return False
    if first.objgen == old.Root.objgen:
        forms = old.Root.get("/AcroForm", _NONE), new.Root.get("/AcroForm", _NONE)
        return _same_but(first, second, OF_ROOT) and _same_but(*forms, OF_FORM)
    if first.get("/FT") == "/Sig" and "/V" not in first:
        return _same_but(first, second, OF_FIELD) and "/ByteRange" in second.get("/V", _NONE)
    return first.objgen == old.Root.get("/AcroForm", _NONE).objgen and _same_but(first, second, OF_FORM)


def _same_but(first: Any, second: Any, keys: set[str]) -> bool:
    """Whether two dictionaries differ in these keys alone."""
    return all(_told(first, key) == _told(second, key) for key in {*first.keys(), *second.keys()} - keys)


def _told(data: Any, key: str) -> object:
    """What stands at a key, with what is referred to by its number."""
    found = data.get(key)
    return found.unparse() if isinstance(found, pikepdf.Object) else (type(found), found)
