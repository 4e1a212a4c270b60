"""What a library finds of a signature, and whether only signatures were added later (which the library takes minutes for)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from cryptography import x509
from pyhanko.keys.internal import translate_pyca_cryptography_cert_to_asn1
from pyhanko.sign.validation import validate_pdf_signature
from pyhanko.sign.validation.settings import KeyUsageConstraints
from pyhanko.sign.validation.status import SignatureCoverageLevel
from pyhanko_certvalidator import ValidationContext

from diecut_report.exchange.later_changes import only_signed

USAGE = KeyUsageConstraints(key_usage={"non_repudiation", "digital_signature"}, match_all_key_usages=False)


class Status(NamedTuple):
    """Whether what was signed is as it was, whether it is the whole file, and if not, whether only signatures were added."""

    is_whole: bool
    is_last: bool
    is_signed_again: bool
    is_trusted: bool


def status_of(signature: Any, whole: bytes, roots: Sequence[x509.Certificate]) -> Status:
    """Return what is to be said of an embedded signature; trusted is one whose certificate leads to one of the roots."""
    known = [translate_pyca_cryptography_cert_to_asn1(each) for each in roots]
    context = ValidationContext(trust_roots=known, allow_fetching=False)
    found = validate_pdf_signature(signature, context, skip_diff=True, key_usage_settings=USAGE)
    is_last = found.coverage == SignatureCoverageLevel.ENTIRE_FILE
    is_revision = found.coverage == SignatureCoverageLevel.ENTIRE_REVISION
    start, length = (int(each) for each in list(signature.byte_range)[-2:])
    return Status(
        bool(found.intact and found.valid),
        is_last,
        is_revision and only_signed(whole[: start + length], whole),
        bool(found.trusted),
    )
