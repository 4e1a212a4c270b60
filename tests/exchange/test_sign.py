"""A report is signed in its fields, one signer after the other, and whatever is changed afterwards shows."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from random import Random
from ssl import DER_cert_to_PEM_cert
from typing import Any

import pikepdf
import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import pkcs12
from cryptography.x509.oid import NameOID
from page import validate_pdf

from diecut_report.errors import UserError
from diecut_report.exchange.signatures import SigningKey, sign, signatures
from tests.configs import SMALL, saved
from tests.exchange.forgeries import (
    filled_field,
    later,
    moved_field,
    turned,
    turned_together,
    with_action,
    with_other_results,
    without_sheet,
)
from tests.exchange.reports import run, saved_pdf

pytestmark = pytest.mark.usefixtures("made_once")  # but for the programs that are started
Capture = pytest.CaptureFixture[str]
Patch = pytest.MonkeyPatch
PASSWORD = "right"
VARIABLE = "DIECUT_REPORT_KEY_PASSWORD"
PEM = serialization.Encoding.PEM


def hidden(password: str | None) -> serialization.KeySerializationEncryption:
    return serialization.BestAvailableEncryption(password.encode()) if password else serialization.NoEncryption()


@dataclass
class Signer:
    """Somebody with a key and a certificate that he made himself."""

    private: ec.EllipticCurvePrivateKey
    certificate: x509.Certificate

    def p12(self, path: Path, password: str | None = PASSWORD) -> Path:
        whole = pkcs12.serialize_key_and_certificates(b"key", self.private, self.certificate, None, hidden(password))
        path.write_bytes(whole)
        return path

    def pem(self, path: Path, password: str | None = None) -> Path:
        path.write_bytes(self.private.private_bytes(PEM, serialization.PrivateFormat.PKCS8, hidden(password)))
        return path

    def cert(self, path: Path) -> Path:
        path.write_bytes(self.certificate.public_bytes(PEM))
        return path


def signer(name: str, days: int = 9) -> Signer:
    private = ec.generate_private_key(ec.SECP256R1())
    named = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])
    made = x509.CertificateBuilder().subject_name(named).issuer_name(named).public_key(private.public_key())
    made = made.serial_number(x509.random_serial_number()).not_valid_before(datetime.now(UTC) - timedelta(20))
    return Signer(private, made.not_valid_after(datetime.now(UTC) + timedelta(days)).sign(private, hashes.SHA256()))


@pytest.fixture(scope="module")
def engineer() -> Signer:
    return signer("Головний інженер")


@pytest.fixture
def key(engineer: Signer, tmp_path: Path, monkeypatch: Patch) -> Path:
    """The engineer's key, with its password in the environment."""
    monkeypatch.setenv(VARIABLE, PASSWORD)
    return engineer.p12(tmp_path / "key.p12")


@pytest.fixture
def pdf(small_report: Path, tmp_path: Path) -> Path:
    """A copy of a small report."""
    path = tmp_path / "small.pdf"
    path.write_bytes((small_report / "small.pdf").read_bytes())
    return path


@pytest.fixture(scope="module")
def signed_once(engineer: Signer, small_report: Path, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The report, signed by the one who approves it."""
    folder = tmp_path_factory.mktemp("signed")
    path, key = folder / "signed.pdf", engineer.p12(folder / "key.p12")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, PASSWORD)
        assert run("sign", small_report / "small.pdf", "--key", key, "--field", "approved", "-o", path, "--quiet") == 0
    return path.read_bytes()


@pytest.fixture
def signed(pdf: Path, signed_once: bytes) -> Path:
    """A copy of the signed report."""
    pdf.write_bytes(signed_once)
    return pdf


@pytest.mark.nightly
def test_one_signs_after_the_other_and_the_report_agrees_in_everything(
    small_report: Path, pdf: Path, key: Path, tmp_path: Path, capfd: Capture
) -> None:
    out = tmp_path / "out" / "signed.pdf"
    assert run("sign", pdf, "--key", key, "--field", "checked", "--reason", "Checked by hand", "-o", out) == 0
    assert "signed by Головний інженер in the field checked" in capfd.readouterr().err
    once = out.read_bytes()
    assert once.startswith(pdf.read_bytes()) and pdf.read_bytes() == (small_report / "small.pdf").read_bytes()
    # of a stream whose last byte happens to be CR the validator counts one byte less
    unfit = [each.message for profile in ("3a", "ua1") for each in validate_pdf(out, profile=profile).failures]
    assert [each for each in unfit if "/Length does not match" not in each] == []
    assert run("sign", out, "--key", key, "--field", "approved", "--quiet") == 0
    assert out.read_bytes().startswith(once)
    assert run("verify", out) == 0
    told = capfd.readouterr().out
    assert "✓ pages          byte for byte what the program makes of these results, and after it the signatures" in told
    assert "✓ signature      checked: Головний інженер, " in told
    assert "Checked by hand, since then others have signed" in told
    assert "✓ signature      approved: Головний інженер, " in told and "nothing changed since; certificate" in told
    assert run("extract", out, "-o", tmp_path / "back", "--quiet") == 0
    assert (tmp_path / "back" / "signed.json").read_bytes() == (small_report / "small.json").read_bytes()


@pytest.mark.nightly
def test_a_signature_shows_in_its_field(signed: Path) -> None:
    with pikepdf.open(signed) as opened:
        [field] = [each for each in opened.pages[0].Annots if each.get("/T") == "approved"]
        assert b" c" in field.AP.N.read_bytes() or b"Do" in field.AP.N.read_bytes()
        assert str(field.V.Name) == "Головний інженер"


def test_a_report_that_nobody_signed_says_so(pdf: Path, capfd: Capture) -> None:
    assert run("verify", pdf, "--numbers") == 0
    assert "✓ signature      none: the report is not signed" in capfd.readouterr().out


def test_a_byte_that_is_changed_after_signing_is_told(signed: Path, capfd: Capture) -> None:
    whole = signed.read_bytes()
    assert whole.count(b'x-default">Test<') == 1
    signed.write_bytes(whole.replace(b'x-default">Test<', b'x-default">Text<'))
    assert run("verify", signed, "--numbers") == 1
    assert "✗ signature      approved: Головний інженер, " in (told := capfd.readouterr().out)
    assert "what was signed has been changed since" in told and "Not everything agrees." in told


def test_an_object_that_is_written_again_as_it_was_is_no_change(signed: Path) -> None:
    found = signatures(later(signed.read_bytes(), lambda root: root["/Pages"]["/Kids"][0]))
    assert found[0].holds and "added to the file after the last signature" in found[1].words


@pytest.mark.parametrize(
    "change", [turned, turned_together, without_sheet, with_other_results, moved_field, filled_field, with_action]
)
def test_an_object_that_is_changed_after_signing_is_told(signed: Path, change: Callable[[Any], Any]) -> None:
    found = next(iter(signatures(later(signed.read_bytes(), change))))
    assert not found.holds and "the document has been changed since" in found.words


@pytest.mark.nightly
def test_a_signed_report_is_not_written_over(signed: Path, signed_once: bytes, capfd: Capture) -> None:
    config = saved(signed.parent, SMALL).rename(signed.with_suffix(".yaml"))
    assert run("report", config, "--format", "pdf,json", "-o", signed.parent) == 2
    assert "is signed, and would be lost. Choose another place with -o" in capfd.readouterr().err
    assert signed.read_bytes() == signed_once and not signed.with_suffix(".json").exists()


@pytest.mark.parametrize("name", ["Firm ₴", "אבג Ann"])  # no library compares such names alike
def test_nobody_signs_what_would_not_hold(
    pdf: Path, tmp_path: Path, monkeypatch: Patch, capfd: Capture, name: str
) -> None:
    monkeypatch.setenv(VARIABLE, PASSWORD)
    before, key = pdf.read_bytes(), signer(name).p12(tmp_path / "other.p12")
    assert run("sign", pdf, "--key", key, "--field", "approved", "--quiet") == 2
    assert "The signature would not hold, so nothing was signed: " in capfd.readouterr().err
    assert pdf.read_bytes() == before


def test_a_report_that_a_link_names_is_signed_where_it_stands(pdf: Path, key: Path, tmp_path: Path) -> None:
    link = tmp_path / "link.pdf"
    link.symlink_to(pdf)
    assert run("sign", link, "--key", key, "--field", "approved", "--quiet") == 0
    assert link.is_symlink() and [each.holds for each in signatures(pdf.read_bytes())] == [True]


def test_what_is_added_behind_the_signature_is_told(signed: Path) -> None:
    found = signatures(signed.read_bytes() + b"% more")
    assert [each.holds for each in found] == [False] and "the document has been changed since" in found[0].words
    assert not all(each.holds for each in signatures(signed.read_bytes() + b"\n%%EOF\n"))


def damaged(whole: bytes) -> Iterator[bytes]:
    """The file with letters changed in what signing has added: hardest where it tells of objects and of the certificate."""
    start, chance = whole.rindex(b"%%EOF", 0, len(whole) - 10), Random(7)
    for _ in range(10):
        place = chance.randrange(start, len(whole))
        yield whole[:place] + bytes(chance.randrange(256) for _ in range(3)) + whole[place + 3 :]
    yield whole[:-100]
    yield b"%PDF-1.7 /ByteRange"


@pytest.mark.nightly
def test_a_damaged_signature_is_told_in_words(signed: Path) -> None:
    whole = signed.read_bytes()
    start = whole.index(b"/ByteRange")
    elsewhere = whole.replace(whole[start : start + 20], b"/ByteRange [0 9 9 9 ", 1)
    assert not any(each.holds for each in signatures(elsewhere))
    for each in damaged(whole):
        # behind the signature itself its room is filled with zeros, which nobody reads
        place = next((i for i, (a, b) in enumerate(zip(whole, each, strict=False)) if a != b), len(whole))
        is_padding = whole[place - 50 : place + 50] == b"0" * 100
        assert is_padding or not all(found.holds for found in signatures(each))


def test_who_is_not_trusted_is_told_where_trust_is_asked_for(
    signed: Path, engineer: Signer, tmp_path: Path, capfd: Capture
) -> None:
    own, other = engineer.cert(tmp_path / "own.pem"), signer("Another").cert(tmp_path / "other.pem")
    assert run("verify", signed, "--numbers", "--trust", own) == 0
    assert "nothing changed since, trusted" in capfd.readouterr().out
    assert run("verify", signed, "--numbers", "--trust", other) == 1
    assert "does not lead to one that you trust" in capfd.readouterr().out
    assert run("verify", signed, "--numbers", "--trust", signed) == 2
    assert "not a certificate" in capfd.readouterr().err


@pytest.mark.parametrize("form", ["pdf", "html", "json"])
def test_who_asks_for_trust_asks_for_a_signature(
    small_report: Path, engineer: Signer, tmp_path: Path, capfd: Capture, form: str
) -> None:
    """Whoever removes the signatures, or gives the HTML of a signed PDF, has no report that is trusted."""
    report, own = small_report / f"small.{form}", engineer.cert(tmp_path / "own.pem")
    assert run("verify", report, "--numbers", "--trust", own) == 1
    assert "✗ signature      none, where --trust asks for one" in capfd.readouterr().out
    assert run("verify", report, "--numbers", "--trust", tmp_path / "missing.pem") == 2


@pytest.mark.nightly
def test_a_key_signs_without_a_password_and_as_pem_with_its_certificate_beside_it(
    pdf: Path, engineer: Signer, tmp_path: Path, monkeypatch: Patch
) -> None:
    plain, cert = engineer.pem(tmp_path / "key.pem"), engineer.cert(tmp_path / "cert.pem")
    monkeypatch.delenv(VARIABLE, raising=False)
    without = engineer.p12(tmp_path / "a.p12", None)
    assert run("sign", pdf, "--key", without, "--field", "approved", "--quiet") == 0
    assert run("sign", pdf, "--key", plain, "--cert", cert, "--field", "prepared", "--quiet") == 0
    monkeypatch.setenv(VARIABLE, "x")
    closed = engineer.pem(tmp_path / "closed.pem", "x")
    assert run("sign", pdf, "--key", closed, "--cert", cert, "--field", "checked", "--quiet") == 0
    assert [each.holds for each in signatures(pdf.read_bytes())] == [True, True, True]


# --- what cannot be signed -------------------------------------------------------------------------------------------


def refused(capfd: Capture, words: str, *arguments: object) -> None:
    assert run("sign", *arguments) == 2
    told = capfd.readouterr().err
    assert words in told and "Traceback" not in told


def test_what_the_judgement_of_a_report_raises_is_no_fault_of_the_pdf(pdf: Path, engineer: Signer) -> None:
    def judge() -> None:
        raise LookupError("of a plugin")

    key = SigningKey(pdf, engineer.private, engineer.certificate)
    with pytest.raises(LookupError, match="of a plugin"):
        sign(pdf, pdf, key, lambda _: None, judge, "checked")


EC_KEY, OWN_KEY = (
    bytes.fromhex("06072a8648ce3d0201"),
    bytes.fromhex("06072a8648ce3d0209"),
)  # of a public key, and of no kind that is known


def test_a_key_or_a_certificate_of_a_kind_that_is_not_known_is_told(
    pdf: Path, engineer: Signer, tmp_path: Path, monkeypatch: Patch, capfd: Capture
) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    der = serialization.Encoding.DER
    whole = engineer.private.private_bytes(der, serialization.PrivateFormat.PKCS8, serialization.NoEncryption())
    other = signer("Authority").certificate.public_bytes(der).replace(EC_KEY, OWN_KEY)
    key, foreign = tmp_path / "foreign-key.pem", tmp_path / "foreign.pem"
    key.write_text(DER_cert_to_PEM_cert(whole.replace(EC_KEY, OWN_KEY)).replace("CERTIFICATE", "PRIVATE KEY"))
    foreign.write_text(DER_cert_to_PEM_cert(other))
    own = engineer.pem(tmp_path / "own.pem")
    refused(capfd, "The kind of this key", pdf, "--key", key, "--field", "checked")
    refused(capfd, "This is not the certificate of the key", pdf, "--key", own, "--cert", foreign, "--field", "checked")
    both = tmp_path / "both.pem"
    both.write_bytes(foreign.read_bytes() + engineer.cert(tmp_path / "cert.pem").read_bytes())
    assert run("sign", pdf, "--key", own, "--cert", both, "--field", "checked", "--quiet") == 0
    version, third = bytes.fromhex("a003020102"), bytes.fromhex("a003020105")
    foreign.write_text(DER_cert_to_PEM_cert(engineer.certificate.public_bytes(der).replace(version, third, 1)))
    refused(
        capfd, "This is not a certificate that can be read", pdf, "--key", own, "--cert", foreign, "--field", "approved"
    )
    foreign.write_text(DER_cert_to_PEM_cert(other))
    with pytest.raises(UserError, match="No key of these certificates"):
        signatures(pdf.read_bytes(), foreign)
    assert [each.holds for each in signatures(pdf.read_bytes(), both)] == [True]


def test_a_wrong_password_is_told(
    pdf: Path, key: Path, engineer: Signer, tmp_path: Path, monkeypatch: Patch, capfd: Capture
) -> None:
    before = pdf.read_bytes()
    monkeypatch.setenv(VARIABLE, "wrong")
    refused(capfd, f"{key}: The key cannot be opened: the password is wrong", pdf, "--key", key, "--field", "checked")
    refused(capfd, "the password is wrong", pdf, "--key", engineer.pem(tmp_path / "a.pem", "x"), "--field", "checked")
    (tmp_path / "none.p12").write_bytes(b"x")
    refused(capfd, "or not a key", pdf, "--key", tmp_path / "none.p12", "--field", "checked")
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setattr("sys.stdin", None)
    refused(capfd, f"Set the variable {VARIABLE}", pdf, "--key", key, "--field", "checked")
    assert pdf.read_bytes() == before


def test_a_field_that_is_not_there_or_not_free_is_told(signed: Path, key: Path, capfd: Capture) -> None:
    refused(capfd, "Several fields are free; name one with --field: prepared, checked.", signed, "--key", key)
    template = "no free field 'approved'; free are: prepared, checked."
    refused(capfd, template, signed, "--key", key, "--field", "approved")
    refused(capfd, "no free field 'cheked' (did you mean 'checked'?)", signed, "--key", key, "--field", "cheked")


def test_a_reason_that_reads_like_a_part_of_the_file_is_refused(pdf: Path, key: Path, capfd: Capture) -> None:
    before, asked = pdf.read_bytes(), (pdf, "--key", key, "--field", "checked", "--reason", "see startxref")
    refused(capfd, "would refuse the signed report", *asked)
    assert pdf.read_bytes() == before


def test_a_certificate_of_another_key_is_told(
    pdf: Path, key: Path, engineer: Signer, tmp_path: Path, capfd: Capture
) -> None:
    other, late = signer("Another").cert(tmp_path / "other.pem"), signer("Late", days=-9)
    plain, asked = engineer.pem(tmp_path / "key.pem"), (pdf, "--field", "checked", "--key")
    refused(capfd, f"{other}: This is not the certificate of the key", *asked, plain, "--cert", other)
    refused(capfd, f"{plain}: The file holds no certificate", *asked, plain)
    refused(capfd, "The certificate is not valid now", *asked, late.p12(tmp_path / "late.p12"))


def test_what_is_not_a_report_as_pdf_is_told(small_report: Path, key: Path, tmp_path: Path, capfd: Capture) -> None:
    refused(capfd, "This is not a PDF", small_report / "small.html", "--key", key)
    refused(capfd, "There is no such file", tmp_path / "none.pdf", "--key", key)
    (tmp_path / "damaged.pdf").write_bytes(b"%PDF-1.7\n%%EOF")
    refused(capfd, "The PDF is damaged", tmp_path / "damaged.pdf", "--key", key)
    other = pikepdf.new()
    other.add_blank_page()
    (tmp_path / "other.pdf").write_bytes(saved_pdf(other))
    refused(capfd, "no free field for a signature", tmp_path / "other.pdf", "--key", key)
    (tmp_path / "closed.pdf").write_bytes(saved_pdf(other, "x"))
    refused(capfd, "is encrypted, and opens only with a password", tmp_path / "closed.pdf", "--key", key)


def test_an_output_that_cannot_be_written_is_told(pdf: Path, key: Path, tmp_path: Path, capfd: Capture) -> None:
    (tmp_path / "folder").mkdir()
    arguments = (pdf, "--key", key, "--field", "checked", "-o")
    refused(capfd, "a folder has this name", *arguments, tmp_path / "folder")
    before = key.read_bytes()
    refused(capfd, "This is the key or its certificate", *arguments, key)
    there = sorted(path.name for path in tmp_path.iterdir())
    assert key.read_bytes() == before and there == ["folder", "key.p12", "small.pdf"]


@pytest.mark.nightly
def test_a_report_without_signatures_is_judged_without_the_library_that_reads_them(small_report: Path) -> None:
    code = (
        "import sys; from diecut_report.cli.main import main; "
        f"main(['verify', '--numbers', {str(small_report / 'small.pdf')!r}]); "
        "print([name for name in ('pyhanko', 'cryptography') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "none: the report is not signed" in done.stdout and done.stdout.endswith("\n[]\n")
