"""What a library finds of a signature, and whether only signatures were added later (which the library takes minutes for)."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any, NamedTuple

from cryptography import x509
from pyhanko.keys.internal import translate_pyca_cryptography_cert_to_asn1
from pyhanko.sign.validation import validate_pdf_signature, validate_pdf_timestamp
from pyhanko.sign.validation.settings import KeyUsageConstraints
from pyhanko.sign.validation.status import SignatureCoverageLevel
from pyhanko_certvalidator import ValidationContext

from diecut_report.exchange.later_changes import only_signed
from diecut_report.text.phrases import Phrase

# Which digests and keys are too weak to sign with: NIST SP 800-131A wants 112 bits of security.


WEAK_DIGESTS = ("md2", "md4", "md5", "sha1")
SHORTEST = {"rsa": 2048, "rsassa_pss": 2048, "dsa": 2048, "ec": 224}  # bits of a key


def weak_digest(name: str) -> bool:
    """Return whether somebody can make another document of the same digest."""
    return name.lower().replace("-", "") in WEAK_DIGESTS


def weak_key(kind: str, bits: int | None) -> str:
    """Return what is told of a key that can be broken; "" of one that cannot."""
    least = SHORTEST.get(kind, 0)
    if bits is None or bits >= least:
        return ""
    return Phrase(
        "the key is too short: {kind} with {bits} bits, at least {least} are needed",
        kind=kind.upper(),
        bits=bits,
        least=least,
    )


USAGE = KeyUsageConstraints(key_usage={"non_repudiation", "digital_signature"}, match_all_key_usages=False)
Roots = Sequence[x509.Certificate] | None


class Status(NamedTuple):
    """Whether what was signed is as it was, whether it is the whole file, and if not, whether only signatures were added.

    ``weakness`` tells of a digest or key that can be forged, ``outdated`` of a certificate that is not valid; "" where there is none.
    ``time`` is that which a time stamping authority tells, ``end`` the number of bytes that are signed.
    """

    is_whole: bool
    is_last: bool
    is_signed_again: bool
    is_trusted: bool
    weakness: str
    outdated: str
    time: datetime | None
    end: int


def is_timestamp(signature: Any) -> bool:
    """Return whether an embedded signature is a document timestamp, which tells no signer but a time."""
    return bool(signature.sig_object_type == "/DocTimeStamp")


def status_of(signature: Any, whole: bytes, roots: Roots, attested: datetime | None) -> Status:
    """Return what is to be said of an embedded signature; trusted is one whose certificate leads to one of the roots.

    ``attested`` is a time at which the signature was there already, by a later document timestamp.
    """
    found, time = _validated(signature, roots, attested)
    is_last = found.coverage == SignatureCoverageLevel.ENTIRE_FILE
    is_revision = found.coverage == SignatureCoverageLevel.ENTIRE_REVISION
    start, length = (int(each) for each in list(signature.byte_range)[-2:])
    return Status(
        bool(found.intact and found.valid), is_last, is_revision and only_signed(whole[: start + length], whole), bool(found.trusted),
        _weakness(signature), _outdated(signature, min(filter(None, (time, attested)), default=None)), time, start + length,
    )  # fmt: skip


def _validated(signature: Any, roots: Roots, attested: datetime | None) -> tuple[Any, datetime | None]:
    """What the library finds, and the time that an authority tells; one that is not trusted tells none where trust is asked for."""
    known = [translate_pyca_cryptography_cert_to_asn1(each) for each in roots or ()]
    context = ValidationContext(trust_roots=known, allow_fetching=False, moment=attested)
    if is_timestamp(signature):
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
    if (attested or datetime.now(UTC)) > found.signing_cert.not_valid_after:
        return None
    time: datetime = found.timestamp
    return time


def _weakness(signature: Any) -> str:
    info, cert = signature.signer_info, signature.signer_cert
    digests = [info["digest_algorithm"]["algorithm"].native, signature.external_md_algorithm]
    if cert.self_signed == "no":  # nobody relies on what a certificate says of itself
        digests.append(cert.hash_algo)
    found = next((digest for digest in digests if digest and weak_digest(digest)), "")
    if found:
        return Phrase("the digest {digest} can be forged", digest=found.upper())
    return weak_key(cert.public_key.algorithm, cert.public_key.bit_size)


def _outdated(signature: Any, attested: datetime | None) -> str:
    """Why the certificate is not valid: at the time that an authority tells, else now, and at the time that the signature tells."""
    cert, now = signature.signer_cert, datetime.now(UTC)
    first, last = cert.not_valid_before, cert.not_valid_after
    told = None if is_timestamp(signature) else signature.self_reported_timestamp
    filling = {"first": f"{first:%Y-%m-%d}", "last": f"{last:%Y-%m-%d}"}
    if told is not None and told.tzinfo is not None and not first <= told <= last:
        return Phrase("the certificate was not valid when it was used: from {first} to {last}", filling)
    if first <= (attested or now) <= last:
        return ""
    return Phrase(
        "the certificate is not valid now ({first} to {last}), and no timestamp proves that it was used then", filling
    )
