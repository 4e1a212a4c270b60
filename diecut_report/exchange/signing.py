"""Signs a report: adds a signature into one of its fields, and changes none of the bytes that are there."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from asn1crypto import keys, x509
from cryptography.hazmat.primitives import serialization
from pyhanko.keys.internal import translate_pyca_cryptography_cert_to_asn1
from pyhanko.pdf_utils.content import RawContent
from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter
from pyhanko.pdf_utils.layout import AxisAlignment, BoxConstraints, Margins, SimpleBoxLayoutRule
from pyhanko.sign.fields import SigSeedSubFilter, enumerate_sig_fields
from pyhanko.sign.signers import PdfSignatureMetadata, PdfSigner, SimpleSigner
from pyhanko.stamp import StaticStampStyle
from pyhanko_certvalidator.registry import SimpleCertificateStore

from diecut_report.errors import UserError, nearest, refusal
from diecut_report.exchange.carried import MOST, MOST_RESULTS, form_of
from diecut_report.exchange.later_changes import drawing, only_signed
from diecut_report.exchange.pdf_attachments import attachments, damage
from diecut_report.exchange.signatures import ENDLESS, READING_SECONDS, refuse_nested_fields, signatures, silent
from diecut_report.exchange.signing_keys import SigningKey
from diecut_report.files import content, write_all
from diecut_report.text.phrases import Phrase, joined, phrase
from diecut_report.time_limit import Overran, limited

NONE_FREE = phrase(
    "This PDF has no free field for a signature: an earlier version or another program made it, or all have signed it."
)
UNSIGNABLE = phrase("The PDF cannot be signed: {error}. Give the file as the program wrote it.")
AMBIGUOUS = phrase(
    "The reason or the signer's name holds words that PDF programs take for parts of the file, such as “startxref” or “1 0 obj”: "
    "`diecut-report verify` would refuse the signed report. Give a --reason, or sign with a certificate, without them."
)


class Additions(IncrementalPdfFileWriter):
    """Adds to a PDF, and leaves its metadata as they are: they say what PDF/A it is, which the library would write otherwise."""

    def _update_meta(self) -> None:
        """Write no metadata."""


def sign(
    report: Path, target: Path, key: SigningKey, tell: Callable[[str], None], judge: Callable[[], None],
    field: str | None = None, reason: str | None = None,
) -> None:  # fmt: skip
    """Write a report with a signature to ``target``; UserError in words where it cannot be signed, and then nothing is written.

    ``field`` may be None where only one is free.
    ``judge`` raises a UserError where the report is not as the program makes it: nobody signs what others have put into it.
    """
    whole = content(report, MOST, phrase("a report as PDF"))
    if form_of(whole) != "pdf":
        template = "This is not a PDF. Give a report that `diecut-report report` wrote as PDF; other formats hold no signatures."
        raise refusal(template, report)
    attachments(whole, MOST_RESULTS, str(report))  # UserError for what is not read
    if why := damage(whole, MOST_RESULTS):  # the library that signs reads without bounds
        raise refusal(UNSIGNABLE, report, error=why)
    with _signable(report):
        field = _chosen(list(_free_fields(Additions(io.BytesIO(whole)))), field, report)
    judge()
    with _signable(report):
        signed = with_signature(Additions(io.BytesIO(whole)), field, reason, key)
    if not only_signed(whole, signed):
        raise refusal(AMBIGUOUS, report)
    found = signatures(signed)
    if not any(each.is_last and each.holds for each in found):
        template = (
            "The signature would not hold, so nothing was signed: {found}. "
            "Sign with a certificate that is valid now, and whose names all programs can read."
        )
        raise refusal(template, report, found=joined([each.words for each in found if not each.holds], "; "))
    write_all({target: signed}, keep=key.file)
    tell(Phrase("signed by {name} in the field {field}", name=key.name, field=field))


@contextmanager
def _signable(report: Path) -> Iterator[None]:
    """UserError where the library that signs cannot read a report, or not soon."""
    try:
        with silent(), limited(READING_SECONDS):
            yield
    except UserError:
        raise
    except Exception as error:  # of any kind: libraries read what a stranger may have made
        raise refusal(UNSIGNABLE, report, error=error) from error
    except Overran as error:
        raise refusal(UNSIGNABLE, report, error=ENDLESS) from error


def _free_fields(writer: Additions) -> dict[str, Any]:
    refuse_nested_fields(writer.prev)
    return {name: widget.get_object() for name, _, widget in enumerate_sig_fields(writer.prev, filled_status=False)}


def with_signature(writer: Additions, field: str, reason: str | None, key: SigningKey) -> bytes:
    """Return a PDF with a signature in a field that is free; PdfError or SigningError where that is not possible."""
    now = datetime.now(UTC)
    x1, y1, x2, y2 = (float(each) for each in _free_fields(writer)[field]["/Rect"])
    size = abs(x2 - x1), abs(y2 - y1)
    shown = drawing(key.name, now, reason, *size)
    form = PdfSignatureMetadata(
        field_name=field, md_algorithm="sha256", name=key.name, reason=reason, subfilter=SigSeedSubFilter.PADES
    )
    layout = SimpleBoxLayoutRule(AxisAlignment.ALIGN_MIN, AxisAlignment.ALIGN_MIN, Margins(0, 0, 0, 0))
    picture = RawContent(shown, box=BoxConstraints(width=size[0], height=size[1]))
    style = StaticStampStyle(border_width=0, background=picture, background_layout=layout)
    signer = PdfSigner(form, _signer(key), stamp_style=style)
    made: Any = signer.sign_pdf(writer, existing_fields_only=True)
    content: bytes = made.getvalue()
    return content


def _chosen(free: list[str], field: str | None, report: Path) -> str:
    if not free:
        raise refusal(NONE_FREE, report)
    if field is None and len(free) > 1:
        template = "Several fields are free; name one with --field: {free}."
        raise refusal(template, report, free=", ".join(free))
    if field is not None and field not in free:
        near = nearest(field, free)
        template = "There is no free field {field}{nearest}; free are: {free}."
        raise refusal(template, report, field=repr(field), nearest=near, free=", ".join(free))
    return field or free[0]


def _signer(key: SigningKey) -> SimpleSigner:
    secret = key.private.private_bytes(
        serialization.Encoding.DER, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )
    chain: Any = SimpleCertificateStore()  # type: ignore[no-untyped-call]
    chain.register_multiple(translate_pyca_cryptography_cert_to_asn1(each) for each in key.others)
    own: x509.Certificate = translate_pyca_cryptography_cert_to_asn1(key.certificate)
    return SimpleSigner(signing_cert=own, signing_key=keys.PrivateKeyInfo.load(secret), cert_registry=chain)
