"""The signatures of a report: who signed, and whether anything changed since; the key of a signer; and how one more is added.

Whether only signatures were added later is judged by `later_changes`, as the library takes minutes for it.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

from asn1crypto import keys
from cryptography import x509
from cryptography.exceptions import UnsupportedAlgorithm
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric import dsa, ec, rsa
from cryptography.hazmat.primitives.serialization import pkcs12
from cryptography.x509.oid import NameOID
from pyhanko.keys.internal import translate_pyca_cryptography_cert_to_asn1
from pyhanko.pdf_utils.content import RawContent
from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter
from pyhanko.pdf_utils.layout import AxisAlignment, BoxConstraints, Margins, SimpleBoxLayoutRule
from pyhanko.pdf_utils.reader import PdfFileReader
from pyhanko.sign.fields import SigSeedSubFilter, enumerate_sig_fields
from pyhanko.sign.signers import PdfSignatureMetadata, PdfSigner, SimpleSigner
from pyhanko.sign.validation import validate_pdf_signature, validate_pdf_timestamp
from pyhanko.sign.validation.settings import KeyUsageConstraints
from pyhanko.sign.validation.status import SignatureCoverageLevel
from pyhanko.stamp import StaticStampStyle
from pyhanko_certvalidator import ValidationContext
from pyhanko_certvalidator.registry import SimpleCertificateStore

from diecut_report.errors import UserError, nearest, refusal
from diecut_report.exchange.carried import MOST, MOST_RESULTS, form_of
from diecut_report.exchange.later_changes import added_proofs, drawing, only_signed
from diecut_report.exchange.pdf_attachments import attachments, damage
from diecut_report.files import content, write_all
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
    every = certificates_in(content(file, MAX_KEY_BYTES, phrase("certificates (PEM)")), file)
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


# The key that a report is signed with: PKCS #12, or PEM beside its certificate; its password is asked for where it has one.


MAX_KEY_BYTES = 1_000_000  # bytes of a key or of certificates
PEM = b"-----BEGIN"
WRONG = phrase("The key cannot be opened: the password is wrong, or the file is damaged or not a key (PKCS #12, PEM).")
UNKNOWN = phrase(
    "The kind of this key, or of the password's encryption, is not known here: {error}. Keys with RSA and with the curves P-256 to P-521 are taken."
)
KEY_FAULTS = (UnsupportedAlgorithm, x509.InvalidVersion)
"""What the library raises for a key or a certificate of a kind that it does not know, and is no ValueError."""
WEAK_DIGESTS = ("md2", "md4", "md5", "sha1")  # of which somebody can make another document
SHORTEST = {"rsa": 2048, "rsassa_pss": 2048, "dsa": 2048, "ec": 224}
"""Bits of a key: NIST SP 800-131A wants 112 bits of security."""
Ask = Callable[[], bytes]
"""Gives the password; UserError where nobody can be asked for it."""


@dataclass(frozen=True)
class SigningKey:
    """A private key, its certificate, and the certificates that lead from it to one that is trusted."""

    file: Path
    private: Any
    certificate: x509.Certificate
    others: tuple[x509.Certificate, ...] = ()

    @property
    def name(self) -> str:
        """Whose certificate it is."""
        return name_of(self.certificate)


def name_of(certificate: x509.Certificate) -> str:
    """Return the name by which a certificate's owner signs."""
    found = certificate.subject.get_attributes_for_oid(NameOID.COMMON_NAME)
    return str(found[0].value) if found else certificate.subject.rfc4514_string()


def weak_key(kind: str, bits: int | None) -> str:
    """Return what is told of a key that can be broken; "" of one that cannot."""
    least = SHORTEST.get(kind, 0)
    template = "the key is too short: {kind} with {bits} bits, at least {least} are needed"
    return "" if bits is None or bits >= least else Phrase(template, kind=kind.upper(), bits=bits, least=least)


def signing_key(key: Path, certificates: Path | None, ask: Ask) -> SigningKey:
    """Return the key in a file with its certificate, which may stand in another one; UserError in words where they do not serve."""
    whole = content(key, MAX_KEY_BYTES, phrase("a key (PKCS #12 or PEM)"))
    try:
        private, found = _pem(whole, key, ask) if PEM in whole else _pkcs12(whole, key, ask)
    except KEY_FAULTS as error:
        raise refusal(UNKNOWN, key, error=error) from None
    if certificates is not None:
        found = (
            certificates_in(content(certificates, MAX_KEY_BYTES, phrase("a certificate (PEM)")), certificates) + found
        )
    if not found:
        raise refusal("The file holds no certificate. Give that of the key with --cert.", key)
    own = next((each for each in found if public_key(each) == private.public_key()), None)
    if own is None:
        template = (
            "This is not the certificate of the key: it belongs to another one. Give that of the key with --cert."
        )
        raise refusal(template, certificates or key)
    kinds = {rsa.RSAPrivateKey: "rsa", dsa.DSAPrivateKey: "dsa", ec.EllipticCurvePrivateKey: "ec"}
    kind = next((name for type_, name in kinds.items() if isinstance(private, type_)), "")
    if weak := weak_key(kind, private.key_size if kind else None):
        raise refusal("Nobody can rely on what this key signs: {weak}. Take another one.", key, weak=weak)
    first, last = own.not_valid_before_utc, own.not_valid_after_utc
    if not first <= datetime.now(UTC) <= last:
        told = {"not_valid_before_utc": f"{first:%Y-%m-%d}", "last": f"{last:%Y-%m-%d}"}
        template = "The certificate is not valid now: from {not_valid_before_utc} to {last}."
        raise refusal(template, certificates or key, **told)
    return SigningKey(key, private, own, tuple(each for each in found if each != own))


def public_key(certificate: x509.Certificate) -> Any:
    """Return the key of a certificate; None where it is damaged, or its kind is not known here."""
    try:
        return certificate.public_key()
    except (ValueError, *KEY_FAULTS):
        return None


def _pkcs12(whole: bytes, file: Path, ask: Ask) -> tuple[Any, list[x509.Certificate]]:
    try:
        private, own, others = pkcs12.load_key_and_certificates(whole, None)
    except ValueError:  # it has a password, or is none
        try:
            private, own, others = pkcs12.load_key_and_certificates(whole, ask())
        except ValueError:
            raise refusal(WRONG, file) from None
    if private is None:
        raise refusal("The file holds no private key.", file)
    return private, [*([own] if own else []), *others]


def _pem(whole: bytes, file: Path, ask: Ask) -> tuple[Any, list[x509.Certificate]]:
    try:
        try:
            private: Any = serialization.load_pem_private_key(whole, None)
        except TypeError:  # it has a password
            private = serialization.load_pem_private_key(whole, ask())
    except (ValueError, TypeError):
        raise refusal(WRONG, file) from None
    return private, certificates_in(whole, file) if b"BEGIN CERTIFICATE" in whole else []


def certificates_in(whole: bytes, file: Path) -> list[x509.Certificate]:
    """Return the certificates that a file holds as PEM, or the one that it is; UserError where there is none."""
    try:
        return x509.load_pem_x509_certificates(whole) if PEM in whole else [x509.load_der_x509_certificate(whole)]
    except (ValueError, *KEY_FAULTS):
        raise refusal("This is not a certificate that can be read. Give one as PEM.", file) from None


# Adds a signature into one of a report's fields, and changes none of the bytes that are there.


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
    signer = PdfSigner(form, _signer_of(key), stamp_style=style)
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


def _signer_of(key: SigningKey) -> SimpleSigner:
    secret = key.private.private_bytes(
        serialization.Encoding.DER, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )
    chain: Any = SimpleCertificateStore()  # type: ignore[no-untyped-call]
    chain.register_multiple(translate_pyca_cryptography_cert_to_asn1(each) for each in key.others)
    own: Any = translate_pyca_cryptography_cert_to_asn1(key.certificate)
    return SimpleSigner(signing_cert=own, signing_key=keys.PrivateKeyInfo.load(secret), cert_registry=chain)
