"""Whatever a reader sees in a report follows from the configuration in it, by this program, or ``verify`` says that it does not."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta, tzinfo
from functools import reduce
from operator import getitem
from pathlib import Path
from random import Random
from typing import Any, Self

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec, rsa
from cryptography.hazmat.primitives.serialization import pkcs12
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID
from pyhanko.keys.internal import (
    translate_pyca_cryptography_cert_to_asn1,
    translate_pyca_cryptography_key_to_asn1,
)
from pyhanko.pdf_utils.generic import NumberObject
from pyhanko.pdf_utils.misc import PdfError
from pyhanko.sign import signers
from pyhanko.sign.timestamps import DummyTimeStamper
from pyhanko_certvalidator.registry import SimpleCertificateStore

from diecut_report.exchange import signatures as judging
from diecut_report.exchange.later_changes import only_signed
from diecut_report.exchange.signatures import Additions, SigningKey, signatures, with_signature
from diecut_report.text.phrases import cell
from tests.configs import SMALL, saved
from tests.examples import every, few
from tests.exchange.forgeries import (
    OF_OPTIONS,
    OF_PAGE,
    OF_PDF,
    OF_RESULTS,
    OF_REVISION,
    REFUSED,
    TRUST,
    Forgery,
    added,
    page,
    painted,
    signed_by_hand,
    with_two_contents,
)
from tests.exchange.reports import page_with, run

Capture = pytest.CaptureFixture[str]
Patch = pytest.MonkeyPatch
KNIFE = """\
schema_version: 1
project: {title: Ніж, document_number: D-1, revision: A, language: uk, prepared_by: Designer}
report: {influence: {}, frame: iso7200, status: draft, units: {length: mm}}
press: {name: P, productivity: 3600 1/h, sheet: {length: 500 mm, width: 350 mm, thickness: 0.5 mm}}
mechanisms:
  knife:
    kind: circular_knife
    eccentricity: {value: 20 mm, basis: assumed, note: by eye}
    edge_radius: {value: 100 mm, basis: assumed}
    depth: {value: 112 mm, basis: assumed}
    front_distance: {value: 26 mm, basis: assumed}
    thickness: ${press.sheet.thickness}
    cut_length: {value: 15 mm, basis: assumed}
    sharpening_angle: {value: 20 deg, basis: assumed}
    speed: {value: 60 rpm, basis: assumed}
    shear_resistance: {value: 42 N/mm**2, basis: assumed}
    rule_force: {value: 21 N/mm, basis: assumed}
    friction: {value: 0.3, basis: assumed}
    allowable_torque: 1 N*m
"""


@pytest.fixture(scope="module")
def knife(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a report that shows all that one can show: assumed values, influence, changes since a former revision, in Ukrainian."""
    folder = tmp_path_factory.mktemp("knife")
    old, new = saved(folder, KNIFE, "old.yaml"), KNIFE.replace("revision: A", "revision: B")
    assert run("report", old, "-o", folder, "--format", "json", "--quiet") == 1
    saved(folder, new.replace("20 mm", "20.5 mm", 1), "new.yaml")
    options = ["--previous", folder / "old.json", "--format", "html,json", "--quiet"]
    assert run("report", folder / "new.yaml", "-o", folder, *options) == 1
    return folder


def verified(content: bytes, folder: Path, capfd: Capture, *options: object) -> tuple[int, str]:
    (folder / "report").write_bytes(content)
    code = run("verify", folder / "report", *options, "--quiet")
    told = capfd.readouterr()
    return code, told.out + told.err


def test_the_report_itself_agrees(knife: Path, tmp_path: Path, capfd: Capture) -> None:
    code, told = verified((knife / "new.html").read_bytes(), tmp_path, capfd)
    assert code == 0 and "Everything agrees." in told


@pytest.mark.usefixtures("made_once")
@pytest.mark.parametrize("forgery", every(4, OF_RESULTS), ids=lambda forgery: forgery.way)
def test_changed_results_are_found(knife: Path, tmp_path: Path, capfd: Capture, forgery: Forgery) -> None:
    data = json.loads((knife / "new.json").read_text("utf-8"))
    forgery.change(data)
    code, told = verified(page_with(json.dumps(data).encode()), tmp_path, capfd)
    refused = forgery.line == REFUSED  # before anything is calculated
    assert forgery.line in told and (code, "Not everything agrees." in told) == ((2, False) if refused else (1, True))


@pytest.mark.usefixtures("made_once")
@pytest.mark.parametrize("forgery", OF_OPTIONS, ids=lambda forgery: forgery.way)
def test_what_is_chosen_beside_the_configuration_is_told(
    knife: Path, tmp_path: Path, capfd: Capture, forgery: Forgery
) -> None:
    data = json.loads((knife / "new.json").read_text("utf-8"))
    forgery.change(data)
    code, told = verified(page_with(json.dumps(data).encode()), tmp_path, capfd, "--numbers")
    assert code == 0 and forgery.line in told


def leaves(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    if isinstance(data, dict | list) and data:
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from leaves(value, (*path, key))
    else:
        yield path, data


def one_of_each(data: Any, random: Random) -> list[tuple[Any, ...]]:
    """A leaf for each way of keys that leads to one, whatever the numbers in lists."""
    found: dict[tuple[Any, ...], list[tuple[Any, ...]]] = {}
    for path, _ in leaves(data):
        found.setdefault(tuple("" if isinstance(key, int) else key for key in path), []).append(path)
    return [random.choice(paths) for paths in found.values()]


def other(value: Any) -> Any:
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + 1 if isinstance(value, int) else value * 1.01 + 0.01
    return f"{value}0" if isinstance(value, str) else 1


def is_told_apart(path: tuple[Any, ...]) -> bool:
    """Whether another value is told, and no fault: the versions of libraries."""
    return path[:2] == ("program", "libraries")


def changed(place: Any, key: Any) -> None:
    place[key] = other(place[key])


def removed(place: Any, key: Any) -> None:
    del place[key]


def more(place: Any, _: Any) -> None:
    if isinstance(place, dict):
        place["another"] = "x"
    else:
        place.append("x")


def turned_round(place: Any, _: Any) -> None:
    if isinstance(place, list):
        place.reverse()


@pytest.mark.usefixtures("made_once")
@pytest.mark.parametrize(
    "change", few([changed, removed, more, turned_round], keep=lambda change: change in (changed, more))
)
@pytest.mark.parametrize("count", [12, pytest.param(2000, marks=pytest.mark.nightly)])
def test_no_value_of_the_results_can_be_changed(
    knife: Path, tmp_path: Path, capfd: Capture, count: int, change: Callable[[Any, Any], None]
) -> None:
    random, text = Random(f"{count} {change.__name__}"), (knife / "new.json").read_text("utf-8")
    paths = [path for path in one_of_each(json.loads(text), random) if not is_told_apart(path)]
    if change is turned_round:  # the keys of a block have no order
        paths = [path for path in paths if isinstance(path[-1], int)]
    unnoticed = []
    for path in random.sample(paths, min(count, len(paths))):
        data = json.loads(text)
        change(reduce(getitem, path[:-1], data), path[-1])
        if json.dumps(data) != json.dumps(json.loads(text)):
            code, _ = verified(page_with(json.dumps(data).encode()), tmp_path, capfd, "--numbers")
            unnoticed += [] if code in (1, 2) else [path]
    assert unnoticed == []


# --- pages ----------------------------------------------------------------------------------------------------------------


@pytest.mark.usefixtures("made_once")
@pytest.mark.parametrize("forgery", OF_PAGE, ids=lambda forgery: forgery.way)
def test_a_changed_page_is_found(knife: Path, tmp_path: Path, capfd: Capture, forgery: Forgery) -> None:
    content = (knife / "new.html").read_bytes()
    changed = forgery.change(content)
    assert changed != content
    code, told = verified(changed, tmp_path, capfd)
    assert (code == 1 and forgery.line in told) or (forgery.line == "two results" and code == 2)


@pytest.mark.usefixtures("made_once")
@pytest.mark.parametrize(
    "forgery", few(OF_PDF, keep=lambda each: each.line != "✗ pages" or each is OF_PDF[0]), ids=lambda each: each.way
)
def test_a_changed_pdf_is_found(small_report: Path, tmp_path: Path, capfd: Capture, forgery: Forgery) -> None:
    changed = forgery.change((small_report / "small.pdf").read_bytes())
    code, told = verified(changed, tmp_path, capfd)
    assert (code == 1 and forgery.line in told) or (forgery.line == "refused" and code == 2 and "Traceback" not in told)


# --- signatures -----------------------------------------------------------------------------------------------------------

Private = ec.EllipticCurvePrivateKey | rsa.RSAPrivateKey


def certified(
    private: Private, name: str = "Chief engineer", first: int = -9, last: int = 9, *, stamps: bool = False
) -> x509.Certificate:
    named, now = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)]), datetime.now(UTC)
    made = x509.CertificateBuilder().subject_name(named).issuer_name(named).public_key(private.public_key())
    made = made.serial_number(x509.random_serial_number())
    made = made.not_valid_before(now + timedelta(first)).not_valid_after(now + timedelta(last))
    if stamps:
        made = made.add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.TIME_STAMPING]), critical=True)
    return made.sign(private, hashes.SHA256())


def signed_elsewhere(
    content: bytes | Additions, private: Private, certificate: x509.Certificate, **options: Any
) -> bytes:
    """Signed by another program, which asks nothing; it leaves the metadata as they are, or these alone would tell."""
    hidden = serialization.NoEncryption()
    stored = pkcs12.serialize_key_and_certificates(b"key", private, certificate, None, hidden)  # type: ignore[arg-type]
    signer = signers.SimpleSigner.load_pkcs12_data(stored, other_certs=[])
    asked = signers.PdfSignatureMetadata(field_name="approved", **options)
    writer = Additions(io.BytesIO(content)) if isinstance(content, bytes) else content
    made = signers.sign_pdf(writer, asked, signer=signer)
    return bytes(made.getvalue())


def signed(path: Path, private: ec.EllipticCurvePrivateKey, monkeypatch: Patch) -> int:
    """Sign a report by the command; its exit code."""
    monkeypatch.setenv("DIECUT_REPORT_KEY_PASSWORD", "")
    hidden = serialization.NoEncryption()
    key = path.with_name("key.p12")
    key.write_bytes(pkcs12.serialize_key_and_certificates(b"k", private, certified(private), None, hidden))
    return run("sign", path, "--key", key, "--field", "approved", "--quiet")


@pytest.fixture(scope="module")
def private() -> ec.EllipticCurvePrivateKey:
    return ec.generate_private_key(ec.SECP256R1())


@pytest.mark.usefixtures("made_once")
def test_what_was_painted_over_is_not_signed(
    small_report: Path, tmp_path: Path, capfd: Capture, private: ec.EllipticCurvePrivateKey, monkeypatch: Patch
) -> None:
    forged = added(painted)((small_report / "small.pdf").read_bytes())
    (tmp_path / "a.pdf").write_bytes(forged)
    assert signed(tmp_path / "a.pdf", private, monkeypatch) == 2
    assert "was not signed" in capfd.readouterr().err and (tmp_path / "a.pdf").read_bytes() == forged
    code, told = verified(signed_elsewhere(forged, private, certified(private)), tmp_path, capfd)
    assert code == 1 and "✗ pages" in told


def test_contents_that_only_some_readers_show_are_no_signature(small_report: Path) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    assert only_signed(whole, added(lambda root: root["/Pages"]["/Kids"][0])(whole))
    assert not only_signed(whole, with_two_contents(whole))


@pytest.mark.parametrize("forgery", OF_REVISION, ids=lambda each: each.way)
def test_what_is_added_beside_a_signature_is_found(small_report: Path, forgery: Forgery) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    assert only_signed(whole, signed_by_hand(whole))
    assert not only_signed(whole, forgery.change(whole))


def test_a_reason_in_any_words_is_no_object(small_report: Path, private: ec.EllipticCurvePrivateKey) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    key = SigningKey(Path("key.p12"), private, certified(private))
    for reason in ("Revision 7, 5 objections (0 obj) \\ Перевірено", None):
        assert only_signed(whole, with_signature(Additions(io.BytesIO(whole)), "approved", reason, key))
    assert not only_signed(whole, signed_elsewhere(whole, private, certified(private)))  # which draws something else


def test_a_signature_in_the_name_of_another_does_not_hold(
    small_report: Path, private: ec.EllipticCurvePrivateKey
) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    (found,) = signatures(signed_elsewhere(whole, private, certified(private), name="Somebody else"))
    assert not found.holds and "it shows the name Somebody else" in found.words


@pytest.mark.parametrize(("flags", "holds"), [(4 | 128, True), (4 | 8, False), (4 | 16, False)])
def test_a_signed_field_does_not_grow_over_its_sheet(
    small_report: Path, private: ec.EllipticCurvePrivateKey, flags: int, holds: bool
) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    writer = Additions(io.BytesIO(whole))
    fields = [each.get_object() for each in writer.root["/AcroForm"]["/Fields"]]
    field = next(each for each in fields if each["/T"] == "approved")
    field["/F"] = NumberObject(flags)
    writer.update_container(field)
    key = SigningKey(Path("key.p12"), private, certified(private))
    assert only_signed(whole, with_signature(writer, "approved", None, key)) is holds


WEAK: dict[str, tuple[Callable[[], Private], dict[str, Any], dict[str, int], str]] = {
    "expired": (lambda: ec.generate_private_key(ec.SECP256R1()), {}, {"first": -9, "last": -1}, "the certificate was not valid when it was used"),
    "SHA-1": (lambda: ec.generate_private_key(ec.SECP256R1()), {"md_algorithm": "sha1"}, {}, "SHA1 can be forged"),
    "RSA-1024": (lambda: rsa.generate_private_key(65537, 1024), {}, {}, "1024"),
}  # fmt: skip


@pytest.mark.usefixtures("made_once")
@pytest.mark.parametrize("name", WEAK)
def test_a_weak_or_outdated_signature_does_not_hold(
    small_report: Path, tmp_path: Path, capfd: Capture, name: str
) -> None:
    make, options, times, words = WEAK[name]
    key = make()
    content = signed_elsewhere((small_report / "small.pdf").read_bytes(), key, certified(key, **times), **options)  # type: ignore[arg-type]
    code, told = verified(content, tmp_path, capfd, "--numbers")
    assert code == 1 and "✗ signature" in told and words in told


def time_stamped(content: bytes, last: int = 99) -> bytes:
    """With a document timestamp of an authority whose certificate lasts for so many days."""
    key = rsa.generate_private_key(65537, 2048)
    hidden = serialization.NoEncryption()
    packed = key.private_bytes(serialization.Encoding.DER, serialization.PrivateFormat.PKCS8, hidden)
    authority = translate_pyca_cryptography_cert_to_asn1(certified(key, "Time stamps", last=last, stamps=True))
    stamper = DummyTimeStamper(authority, translate_pyca_cryptography_key_to_asn1(serialization.load_der_private_key(packed, None)),
                               SimpleCertificateStore())  # fmt: skip
    made = signers.PdfTimeStamper(stamper).timestamp_pdf(Additions(io.BytesIO(content)), "sha256")
    return bytes(made.getvalue())


@pytest.mark.nightly
@pytest.mark.usefixtures("made_once")
def test_a_document_timestamp_holds_and_tells_its_time(
    small_report: Path, tmp_path: Path, capfd: Capture, private: ec.EllipticCurvePrivateKey, monkeypatch: Patch
) -> None:
    (tmp_path / "a.pdf").write_bytes((small_report / "small.pdf").read_bytes())
    assert signed(tmp_path / "a.pdf", private, monkeypatch) == 0
    code, told = verified(time_stamped((tmp_path / "a.pdf").read_bytes()), tmp_path, capfd)
    assert (code, told.count("✓ signature"), told.count("time stamped 20")) == (0, 2, 1), told


class InAMonth(datetime):
    @classmethod
    def now(cls, tz: tzinfo | None = None) -> Self:
        return super().now(tz) + timedelta(30)


@pytest.mark.nightly
def test_a_certificate_that_ended_holds_where_a_timestamp_proves_that_it_was_used_before(
    small_report: Path, private: ec.EllipticCurvePrivateKey, monkeypatch: Patch
) -> None:
    own = signed_elsewhere((small_report / "small.pdf").read_bytes(), private, certified(private))
    stamped, late = time_stamped(own), time_stamped(own, last=9)
    monkeypatch.setattr(judging, "datetime", InAMonth)
    [found] = signatures(own)
    assert not found.holds and "is not valid now" in found.words and "no timestamp proves" in found.words
    assert [each.holds for each in signatures(stamped)] == [True, True]
    assert [each.holds for each in signatures(late)] == [False, False]


@pytest.mark.usefixtures("made_once")
def test_a_name_forges_neither_a_line_nor_another_part_of_its_own(
    small_report: Path, tmp_path: Path, capfd: Capture, private: ec.EllipticCurvePrivateKey
) -> None:
    whole, folder = (small_report / "small.pdf").read_bytes(), tmp_path / "a\n✓ pages"
    folder.mkdir()
    name = "x\n✓ signature      approved: Chief\x1b[1A\u202e"
    _, told = verified(signed_elsewhere(whole, private, certified(private, name)), folder, capfd, "--numbers")
    assert not any(line.startswith(("✓ signature      approved: Chief", "✓ pages")) for line in told.splitlines())
    assert "\x1b" not in told and "\u202e" not in told
    name, reason = "Chief, nothing changed since, trusted", f'"{100 * " "}✓ x'
    (found,) = signatures(signed_elsewhere(whole, private, certified(private, name), reason=reason))
    assert f'approved: "{name}", ' in found.words and r', "\" ✓ x", nothing changed' in found.words


def test_the_name_of_a_file_forges_no_line(tmp_path: Path, capfd: Capture) -> None:
    names = ("a\n✓ pass.yaml", "b\x1b[1A\u202e\u3164.yaml", "c       pass  ok.yaml", "bad\n✓ pass.yaml")
    for name in names:
        saved(tmp_path, SMALL.replace("300 N", "-300 N") if name.startswith("bad") else SMALL, name)
    run("check", tmp_path, "--jobs", 1)
    rows, told = (text.splitlines() for text in capfd.readouterr())
    assert len(rows) == 5 and rows[1].startswith('"a ✓ pass"  ') and rows[-1].startswith("c pass ok  ")
    for name in names:
        run("validate", tmp_path / name)
        run("report", tmp_path / name, "--format", "json", "-o", tmp_path / "out")
    told += capfd.readouterr().err.splitlines()
    assert any(line.endswith("\\n✓ pass.yaml: valid") for line in told)
    assert any(line.startswith("written: ") and line.endswith("\\n✓ pass.json") for line in told)
    assert not any(line.strip().startswith("✓") or set(line) & set("\x1b\u202e\u3164") for line in [*rows, *told])


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("Олена П'ятигорська", "Олена П'ятигорська"),
        ("out/a-1.pdf", "out/a-1.pdf"),
        ("a, b", '"a, b"'),
        ("a  \u2003\n b", "a b"),
        ("", '""'),
        (200 * "x", f"{80 * 'x'}…"),
    ],
)
def test_a_text_of_others_is_one_part_of_a_line(text: str, shown: str) -> None:
    assert cell(text) == shown


SHOWN = [each for each in OF_PDF if each.way != "something behind its end"]  # which no object refers to then


@pytest.mark.parametrize("forgery", every(2, SHOWN), ids=lambda each: each.way)
def test_a_changed_pdf_that_somebody_signs_is_found(
    small_report: Path, private: ec.EllipticCurvePrivateKey, forgery: Forgery
) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    changed = forgery.change(whole)
    try:
        signed = signed_elsewhere(changed, private, certified(private))
    except PdfError:  # the other program refuses it as well
        signed = changed
    assert not (signed.startswith(whole) and only_signed(whole, signed))


@pytest.mark.parametrize("forgery", every(4, OF_PDF), ids=lambda each: each.way)
def test_a_pdf_that_is_changed_after_it_was_signed_is_found(
    small_report: Path, private: ec.EllipticCurvePrivateKey, forgery: Forgery
) -> None:
    signed = signed_elsewhere((small_report / "small.pdf").read_bytes(), private, certified(private))
    assert not all(each.holds for each in signatures(forgery.change(signed)))


@pytest.mark.nightly
@pytest.mark.usefixtures("made_once")
@pytest.mark.parametrize("count", [12, pytest.param(400, marks=pytest.mark.nightly)])
def test_a_damaged_signed_report_ends_in_words(
    small_report: Path, tmp_path: Path, capfd: Capture, private: ec.EllipticCurvePrivateKey, count: int
) -> None:
    whole = signed_elsewhere((small_report / "small.pdf").read_bytes(), private, certified(private))
    random = Random(count)
    for _ in range(count):
        place, length = random.randrange(len(whole)), random.choice([1, 3, 40, 4000])
        damage = bytes(random.randrange(256) for _ in range(length)) if random.random() < 0.7 else b""
        code, told = verified(whole[:place] + damage + whole[place + length :], tmp_path, capfd, "--numbers")
        assert code in (0, 1, 2) and "Traceback" not in told, (place, length, told)


def test_the_list_of_forgeries_is_that_of_the_documentation() -> None:
    text = TRUST.read_text("utf-8")
    assert page(text) == text
