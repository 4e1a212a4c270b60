"""Judges the signatures of a report: who signed, and whether anything changed since."""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from diecut_report.given_files import content
from diecut_report.languages.phrases import Phrase, phrase

if TYPE_CHECKING:
    from cryptography import x509

MARK = b"/ByteRange"  # stands in clear in each file that is signed
SHORT = 16  # letters of a fingerprint


class Signature(NamedTuple):
    """What is to be said of a signature, whether it holds, and whether it covers the whole file."""

    words: str
    holds: bool
    is_last: bool = False


def signatures(whole: bytes, trusted: Path | None = None) -> list[Signature]:
    """Return what the signatures of a PDF tell, in their order; with ``trusted``, a file of certificates, who is not known fails."""
    if MARK not in whole:
        return []
    from pyhanko.pdf_utils.misc import PdfError
    from pyhanko.pdf_utils.reader import PdfFileReader
    from pyhanko.sign.validation.errors import ValidationInfoReadingError

    from diecut_report.exchange.later_changes import fault
    from diecut_report.exchange.signing_keys import MOST, certificates_in

    if found_fault := fault(whole):
        return [Signature(Phrase("cannot be read: {found_fault}", found_fault=found_fault), False)]
    roots = certificates_in(content(trusted, MOST, phrase("certificates (PEM)")), trusted) if trusted else None
    try:
        with _silent():
            found = [_judged(each, whole, roots) for each in PdfFileReader(io.BytesIO(whole)).embedded_signatures]
    except (PdfError, ValidationInfoReadingError, *_FAULTS) as error:
        return [Signature(Phrase("cannot be read: {error}", error=error), False)]
    if not found:
        return [Signature(phrase("the file holds a part of one, but no field has a signature"), False)]
    if all(each.holds for each in found) and not any(each.is_last for each in found):
        found.append(Signature(phrase("something was added to the file after the last signature"), False))
    return found


_FAULTS = (ValueError, KeyError, TypeError, AttributeError, IndexError, RecursionError, NotImplementedError, OSError)
"""What the library raises for a file that is not as the standard has it."""


def _judged(signature: Any, whole: bytes, roots: list[x509.Certificate] | None) -> Signature:
    from diecut_report.exchange.signature_status import status_of

    status = status_of(signature, whole, roots or [])
    named = f"{signature.field_name}: {_signer(signature)}"
    if not status.is_whole:
        return Signature(
            Phrase(
                "{named}: what was signed has been changed since, or the signature is not the signer's", named=named
            ),
            False,
        )
    if not (status.is_last or status.is_signed_again):
        return Signature(Phrase("{named}: the document has been changed since", named=named), False)
    since = phrase("nothing changed since") if status.is_last else phrase("since then others have signed")
    if roots is None:
        words = Phrase("{named}, {since}", named=named, since=since) + _fingerprint(signature)
        return Signature(words, True, status.is_last)
    trust = (
        phrase("trusted") if status.is_trusted else phrase("but the certificate does not lead to one that you trust")
    )
    words = Phrase("{named}, {since}, {trust}", named=named, since=since, trust=trust)
    return Signature(words, status.is_trusted, status.is_last)


def _signer(signature: Any) -> str:
    """Who signed, when, and why, as the signature has it."""
    found = signature.signer_cert.subject.native
    time = signature.self_reported_timestamp
    reason = signature.sig_object.get("/Reason")
    parts = [
        found.get("common_name", ""),
        found.get("organization_name", ""),
        f"{time:%Y-%m-%d %H:%M} UTC" if time else "",
        reason,
    ]
    return ", ".join(str(part) for part in parts if part)


def _fingerprint(signature: Any) -> str:
    digest = signature.signer_cert.sha256.hex()[:SHORT]
    cert = signature.signer_cert
    by = phrase("itself") if cert.self_signed != "no" else cert.issuer.human_friendly
    return Phrase(
        "; certificate {digest} by {by}, whose name anybody may have chosen: compare it, or give --trust",
        digest=digest,
        by=by,
    )


@contextmanager
def _silent() -> Iterator[None]:
    """Without the library's own messages, which are told in words of ours."""
    loggers = [logging.getLogger(name) for name in ("pyhanko", "pyhanko_certvalidator")]
    levels = [each.level for each in loggers]
    try:
        for each in loggers:
            each.setLevel(logging.CRITICAL + 1)
        yield
    finally:
        for each, level in zip(loggers, levels, strict=True):
            each.setLevel(level)
