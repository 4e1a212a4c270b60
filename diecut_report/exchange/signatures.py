"""Judges the signatures of a report: who signed, and whether anything changed since.

Whether only signatures were added later is judged by `later_changes`, as the library takes minutes for it.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

from cryptography import x509
from pyhanko.keys.internal import translate_pyca_cryptography_cert_to_asn1
from pyhanko.pdf_utils.reader import PdfFileReader
from pyhanko.sign.validation import validate_pdf_signature, validate_pdf_timestamp
from pyhanko.sign.validation.settings import KeyUsageConstraints
from pyhanko.sign.validation.status import SignatureCoverageLevel
from pyhanko_certvalidator import ValidationContext

from diecut_report.errors import refusal
from diecut_report.exchange.carried import MOST_RESULTS
from diecut_report.exchange.later_changes import added_proofs, only_signed
from diecut_report.exchange.pdf_attachments import damage
from diecut_report.exchange.signing_keys import (
    MOST,
    WEAK_DIGESTS,
    certificates_in,
    name_of,
    public_key,
    weak_key,
)
from diecut_report.files import content
from diecut_report.text.phrases import Phrase, cell, joined, phrase
from diecut_report.time_limit import Overran, limited

MOST_FIELDS = 100
READING_SECONDS = 20.0  # seconds: those of a large report that three have signed take less than ten
ENDLESS = Phrase("it is not read within {seconds} s", seconds=f"{READING_SECONDS:g}")
SHORT = 16  # letters of a fingerprint
USAGE = KeyUsageConstraints(key_usage={"non_repudiation", "digital_signature"}, match_all_key_usages=False)
Roots = Sequence[x509.Certificate] | None


class Signature(NamedTuple):
    """What is to be said of a signature, whether it holds, whether it covers the whole file, and how many bytes it covers.

    ``time`` is that which a document timestamp proves.
    """

    words: str
    holds: bool
    is_last: bool = False
    end: int = 0
    time: datetime | None = None


def signatures(whole: bytes, trusted: Path | None = None) -> list[Signature]:
    """Return what the signatures of a PDF tell, in their order.

    With ``trusted``, a file of certificates, who is not known fails, and so does a report without a signature. UserError where that
    file cannot be read.
    """
    roots = _roots(trusted) if trusted else None
    if b"/ByteRange" not in whole:  # which stands in clear in each file that is signed
        message = phrase(
            "none, where --trust asks for one: nobody has signed the report, or the signatures were removed"
        )
        return [] if roots is None else [Signature(message, False)]
    if error := damage(whole, MOST_RESULTS):
        return [Signature(Phrase("cannot be read: {error}", error=error), False)]
    try:
        with silent(), limited(READING_SECONDS):
            reader = PdfFileReader(io.BytesIO(whole))
            refuse_nested_fields(reader)
            found = _all_judged(reader.embedded_signatures, whole, roots)
    except Exception as error:  # of any kind: four libraries read what a stranger has made
        told = f"{error}" or type(error).__name__
        return [Signature(Phrase("cannot be read: {error}", error=told), False)]
    except Overran:
        return [Signature(Phrase("cannot be read: {error}", error=ENDLESS), False)]
    if not found:
        return [Signature(phrase("the file holds a part of one, but no field has a signature"), False)]
    is_ended = any(each.is_last for each in found) or added_proofs(whole[: max(each.end for each in found)], whole)
    if all(each.holds for each in found) and not is_ended:
        found.append(Signature(phrase("something was added to the file after the last signature"), False))
    return found


def _roots(file: Path) -> list[x509.Certificate]:
    """The certificates that are trusted, without those of keys that are not known here, which no signature can be held against."""
    every = certificates_in(content(file, MOST, phrase("certificates (PEM)")), file)
    if found := [each for each in every if public_key(each) is not None]:
        return found
    raise refusal(
        "No key of these certificates is of a kind that is known here. Give those of RSA or of the curves P-256 to P-521.",
        file,
    )


def refuse_nested_fields(reader: PdfFileReader) -> None:
    """Raise ValueError for a form that is not a list of at most MOST_FIELDS fields, as the program's is: the library walks into any other."""
    fields = reader.root.get("/AcroForm", {}).get("/Fields", ())
    if len(fields) > MOST_FIELDS or any("/Kids" in each.get_object() for each in fields):
        raise ValueError(Phrase("its form has fields within fields, or more than {most}", most=MOST_FIELDS))


def _all_judged(embedded: Sequence[Any], whole: bytes, roots: Roots) -> list[Signature]:
    """The signatures judged from the last on: a document timestamp proves that those before it were there."""
    found: list[Signature] = []
    attested: datetime | None = None
    for each in reversed(embedded):
        found.insert(0, _judged(each, whole, roots, attested))
        if found[0].holds and found[0].time:
            attested = min(attested or found[0].time, found[0].time)
    return found


def _judged(signature: Any, whole: bytes, roots: Roots, attested: datetime | None) -> Signature:
    """An embedded signature; ``attested`` is a time at which it was there already, by a later document timestamp."""
    found, time = _validated(signature, roots, attested)
    end = sum(int(each) for each in list(signature.byte_range)[-2:])
    named = f"{cell(signature.field_name)}: {_signer(signature, time)}"
    is_last = found.coverage == SignatureCoverageLevel.ENTIRE_FILE
    is_same = is_last or (found.coverage == SignatureCoverageLevel.ENTIRE_REVISION and only_signed(whole[:end], whole))
    when = min(filter(None, (time, attested)), default=None)
    if why := _why_not(signature, bool(found.intact and found.valid), is_same, when):
        return Signature(Phrase("{named}: {why}", named=named, why=why), False, end=end)
    since = phrase("nothing changed since") if is_last else phrase("since then others have signed")
    attests = time if _is_timestamp(signature) else None
    if roots is None:
        words = Phrase("{named}, {since}", named=named, since=since) + _fingerprint(signature)
        return Signature(words, True, is_last, end, attests)
    unknown = phrase("but the certificate does not lead to one that you trust")
    trust = phrase("trusted") if found.trusted else unknown
    words = Phrase("{named}, {since}, {trust}", named=named, since=since, trust=trust)
    return Signature(words, bool(found.trusted), is_last, end, attests)


def _is_timestamp(signature: Any) -> bool:
    """Whether an embedded signature is a document timestamp, which tells no signer but a time."""
    return bool(signature.sig_object_type == "/DocTimeStamp")


def _validated(signature: Any, roots: Roots, attested: datetime | None) -> tuple[Any, datetime | None]:
    """What the library finds, and the time that an authority tells; one that is not trusted tells none where trust is asked for."""
    known = [translate_pyca_cryptography_cert_to_asn1(each) for each in roots or ()]
    context = ValidationContext(trust_roots=known, allow_fetching=False, moment=attested)
    if _is_timestamp(signature):
        found: Any = validate_pdf_timestamp(signature, context, skip_diff=True)
        return found, _time(found, roots, attested)
    found = validate_pdf_signature(signature, context, skip_diff=True, key_usage_settings=USAGE)
    time = _time(found.timestamp_validity, roots, attested)
    if time and not found.trusted and attested is None:
        return _validated(signature, roots, time)[0], time
    return found, time


def _time(found: Any, roots: Roots, attested: datetime | None) -> datetime | None:
    """The time of a timestamp that is whole, trusted where roots are given, and whose own certificate has not ended."""
    if found is None or not (found.intact and found.valid and (roots is None or found.trusted)):
        return None
    is_ended = (attested or datetime.now(UTC)) > found.signing_cert.not_valid_after
    time: datetime = found.timestamp
    return None if is_ended else time


def _why_not(signature: Any, is_whole: bool, is_same: bool, attested: datetime | None) -> str:
    """Why a signature does not hold, whoever is trusted; "" where it does."""
    weakness = _weakness(signature)
    if not is_whole and not weakness:
        return phrase("what was signed has been changed since, or the signature is not the signer's")
    if not is_same:
        return phrase("the document has been changed since")
    return weakness or _outdated(signature, attested) or _other_name(signature)


def _weakness(signature: Any) -> str:
    """Which digest or key of a signature can be forged; "" where none can."""
    info, cert = signature.signer_info, signature.signer_cert
    digests = [info["digest_algorithm"]["algorithm"].native, signature.external_md_algorithm]
    if cert.self_signed == "no":  # nobody relies on what a certificate says of itself
        digests.append(cert.hash_algo)
    if found := [each for each in filter(None, digests) if each.lower().replace("-", "") in WEAK_DIGESTS]:
        return Phrase("the digest {digest} can be forged", digest=found[0].upper())
    return weak_key(cert.public_key.algorithm, cert.public_key.bit_size)


def _outdated(signature: Any, attested: datetime | None) -> str:
    """Why the certificate is not valid: at the time that an authority tells, else now, and at the time that the signature tells."""
    cert = signature.signer_cert
    first, last = cert.not_valid_before, cert.not_valid_after
    told = None if _is_timestamp(signature) else signature.self_reported_timestamp
    filling = {"first": f"{first:%Y-%m-%d}", "last": f"{last:%Y-%m-%d}"}
    if told is not None and told.tzinfo is not None and not first <= told <= last:
        return Phrase("the certificate was not valid when it was used: from {first} to {last}", filling)
    template = "the certificate is not valid now ({first} to {last}), and no timestamp proves that it was used then"
    return "" if first <= (attested or datetime.now(UTC)) <= last else Phrase(template, filling)


def _other_name(signature: Any) -> str:
    """Why the name that a signature shows is not its signer's; "" where it is, or where it has none."""
    shown = signature.sig_object.get("/Name")
    if shown is None or str(shown) == name_of(x509.load_der_x509_certificate(signature.signer_cert.dump())):
        return ""
    return Phrase("it shows the name {shown}, and its certificate has another one", shown=cell(str(shown)))


def _signer(signature: Any, time: datetime | None) -> str:
    """Who signed, when, and why, as the signature has it; of a timestamp who tells the time."""
    found = signature.signer_cert.subject.native
    told = signature.self_reported_timestamp
    own = [found.get("common_name"), found.get("organization_name"), signature.sig_object.get("/Reason")]
    name, firm, reason = (cell(str(each)) if each else "" for each in own)
    signed = f"{told.astimezone(UTC):%Y-%m-%d %H:%M} UTC" if told else ""
    stamped = Phrase("time stamped {time} UTC", time=f"{time:%Y-%m-%d %H:%M}") if time else ""
    return joined(filter(None, (name, firm, signed, reason, stamped)), ", ")


def _fingerprint(signature: Any) -> str:
    cert = signature.signer_cert
    by = phrase("itself") if cert.self_signed != "no" else cell(cert.issuer.human_friendly)
    template = "; certificate {digest} by {by}, whose name anybody may have chosen: compare it, or give --trust"
    return Phrase(template, digest=cert.sha256.hex()[:SHORT], by=by)


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
