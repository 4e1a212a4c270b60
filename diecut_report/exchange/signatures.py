"""Judges the signatures of a report: who signed, and whether anything changed since."""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from diecut_report.exchange.pdf_faults import PDF_FAULTS
from diecut_report.files import content
from diecut_report.text.phrases import Phrase, cell, joined, phrase

if TYPE_CHECKING:
    from datetime import datetime

    from cryptography import x509

    from diecut_report.exchange.signature_status import Status

MARK = b"/ByteRange"  # stands in clear in each file that is signed
SHORT = 16  # letters of a fingerprint
UNSIGNED = phrase("none, where --trust asks for one: nobody has signed the report, or the signatures were removed")


class Signature(NamedTuple):
    """What is to be said of a signature, whether it holds, whether it covers the whole file, and how many bytes it covers."""

    words: str
    holds: bool
    is_last: bool = False
    end: int = 0


def signatures(whole: bytes, trusted: Path | None = None) -> list[Signature]:
    """Return what the signatures of a PDF tell, in their order.

    With ``trusted``, a file of certificates, who is not known fails, and so does a report without a signature. UserError where that
    file cannot be read.
    """
    roots = _certificates(trusted) if trusted else None
    if MARK not in whole:
        return [] if roots is None else [Signature(UNSIGNED, False)]
    from pyhanko.pdf_utils.misc import PdfError
    from pyhanko.pdf_utils.reader import PdfFileReader
    from pyhanko.sign.validation.errors import SignatureValidationError, ValidationInfoReadingError

    from diecut_report.exchange.later_changes import added_proofs, fault

    if found_fault := fault(whole):
        return [Signature(Phrase("cannot be read: {found_fault}", found_fault=found_fault), False)]
    try:
        with silent():
            found = _all_judged(PdfFileReader(io.BytesIO(whole)).embedded_signatures, whole, roots)
    except (PdfError, ValidationInfoReadingError, SignatureValidationError, *PDF_FAULTS) as error:
        told = f"{error}" or type(error).__name__
        return [Signature(Phrase("cannot be read: {error}", error=told), False)]
    if not found:
        return [Signature(phrase("the file holds a part of one, but no field has a signature"), False)]
    is_ended = any(each.is_last for each in found) or added_proofs(whole[: max(each.end for each in found)], whole)
    if all(each.holds for each in found) and not is_ended:
        found.append(Signature(phrase("something was added to the file after the last signature"), False))
    return found


def _certificates(file: Path) -> list[x509.Certificate]:
    from diecut_report.exchange.signing_keys import MOST, certificates_in

    return certificates_in(content(file, MOST, phrase("certificates (PEM)")), file)


def _all_judged(embedded: Sequence[Any], whole: bytes, roots: list[x509.Certificate] | None) -> list[Signature]:
    """The signatures judged from the last on: a document timestamp proves that those before it were there."""
    from diecut_report.exchange.signature_status import is_timestamp, status_of

    found: list[Signature] = []
    attested: datetime | None = None
    for each in reversed(embedded):
        status = status_of(each, whole, roots, attested)
        found.insert(0, _judged(each, status, asks_trust=roots is not None))
        if is_timestamp(each) and found[0].holds and status.time:
            attested = min(attested or status.time, status.time)
    return found


def _judged(signature: Any, status: Status, *, asks_trust: bool) -> Signature:
    named = f"{cell(signature.field_name)}: {_signer(signature, status)}"
    if why := _why_not(status) or _other_name(signature):
        return Signature(Phrase("{named}: {why}", named=named, why=why), False, end=status.end)
    since = phrase("nothing changed since") if status.is_last else phrase("since then others have signed")
    if not asks_trust:
        words = Phrase("{named}, {since}", named=named, since=since) + _fingerprint(signature)
        return Signature(words, True, status.is_last, status.end)
    trust = (
        phrase("trusted") if status.is_trusted else phrase("but the certificate does not lead to one that you trust")
    )
    words = Phrase("{named}, {since}, {trust}", named=named, since=since, trust=trust)
    return Signature(words, status.is_trusted, status.is_last, status.end)


def _why_not(status: Status) -> str:
    """Why a signature does not hold, whoever is trusted; "" where it does."""
    if not status.is_whole and not status.weakness:
        return phrase("what was signed has been changed since, or the signature is not the signer's")
    if not (status.is_last or status.is_signed_again):
        return phrase("the document has been changed since")
    return status.weakness or status.outdated


def _other_name(signature: Any) -> str:
    """Why the name that a signature shows is not its signer's; "" where it is, or where it has none."""
    from cryptography import x509

    from diecut_report.exchange.signing_keys import name_of

    shown = signature.sig_object.get("/Name")
    if shown is None or str(shown) == name_of(x509.load_der_x509_certificate(signature.signer_cert.dump())):
        return ""
    return Phrase("it shows the name {shown}, and its certificate has another one", shown=cell(str(shown)))


def _signer(signature: Any, status: Status) -> str:
    """Who signed, when, and why, as the signature has it; of a timestamp who tells the time."""
    found = signature.signer_cert.subject.native
    told = signature.self_reported_timestamp
    own = [found.get("common_name"), found.get("organization_name"), signature.sig_object.get("/Reason")]
    name, firm, reason = (cell(str(each)) if each else "" for each in own)
    parts = [
        name,
        firm,
        f"{told.astimezone(UTC):%Y-%m-%d %H:%M} UTC" if told else "",
        reason,
        Phrase("time stamped {time} UTC", time=f"{status.time:%Y-%m-%d %H:%M}") if status.time else "",
    ]
    return joined(filter(None, parts), ", ")


def _fingerprint(signature: Any) -> str:
    digest = signature.signer_cert.sha256.hex()[:SHORT]
    cert = signature.signer_cert
    by = phrase("itself") if cert.self_signed != "no" else cell(cert.issuer.human_friendly)
    return Phrase(
        "; certificate {digest} by {by}, whose name anybody may have chosen: compare it, or give --trust",
        digest=digest,
        by=by,
    )


@contextmanager
def silent() -> Iterator[None]:
    """Keep the library's own messages away, which are told in words of ours."""
    loggers = [logging.getLogger(name) for name in ("pyhanko", "pyhanko_certvalidator")]
    levels = [each.level for each in loggers]
    try:
        for each in loggers:
            each.setLevel(logging.CRITICAL + 1)
        yield
    finally:
        for each, level in zip(loggers, levels, strict=True):
            each.setLevel(level)
