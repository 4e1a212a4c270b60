"""Reads the key that a report is signed with: PKCS #12, or PEM beside its certificate; its password is asked for where it has one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from cryptography import x509
from cryptography.exceptions import UnsupportedAlgorithm
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric import dsa, ec, rsa
from cryptography.hazmat.primitives.serialization import pkcs12
from cryptography.x509.oid import NameOID

from diecut_report.errors import refusal
from diecut_report.files import content
from diecut_report.text.phrases import Phrase, phrase

MOST = 1_000_000  # bytes of a key or of certificates
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
    whole = content(key, MOST, phrase("a key (PKCS #12 or PEM)"))
    try:
        private, found = _pem(whole, key, ask) if PEM in whole else _pkcs12(whole, key, ask)
    except KEY_FAULTS as error:
        raise refusal(UNKNOWN, key, error=error) from None
    if certificates is not None:
        found = certificates_in(content(certificates, MOST, phrase("a certificate (PEM)")), certificates) + found
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
