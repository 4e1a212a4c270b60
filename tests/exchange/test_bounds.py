"""A PDF whose few objects refer to each other many times, so that a tree of them has more ends than anybody can walk to: it ends in words, soon."""

from __future__ import annotations

import io
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pikepdf
import pytest
from cryptography.hazmat.primitives.asymmetric import ec
from pyhanko.pdf_utils.generic import ArrayObject, DictionaryObject, NameObject, StreamObject

from diecut_report.exchange import pdf_attachments
from diecut_report.exchange.later_changes import only_signed
from diecut_report.exchange.signatures import Additions
from diecut_report.time_limit import limited
from tests.examples import every
from tests.exchange.reports import run, saved_pdf
from tests.exchange.test_forgeries import signed
from tests.exchange.test_sign import signer

Capture = pytest.CaptureFixture[str]
SECONDS = 20.0  # what none of these takes a tenth of


def named(**entries: Any) -> DictionaryObject:
    return DictionaryObject({NameObject(f"/{key}"): value for key, value in entries.items()})


def itself(writer: Additions) -> DictionaryObject:
    """Certificates in a list that holds itself."""
    listed = ArrayObject()
    reference = writer.add_object(listed)
    listed += [reference] * 1000
    return named(Certs=reference)


def levels(writer: Additions) -> DictionaryObject:
    """Certificates in lists of the same lists."""
    listed: Any = writer.add_object(StreamObject(stream_data=b"x"))
    for _ in range(4):
        listed = writer.add_object(ArrayObject([listed] * 1000))
    return named(Certs=listed)


def shared(writer: Additions) -> DictionaryObject:
    """The same list of certificates for each of many signatures."""
    certificate = writer.add_object(StreamObject(stream_data=b"x"))
    own = writer.add_object(named(Cert=writer.add_object(ArrayObject([certificate] * 20_000))))
    return named(VRI=named(**{f"A{number}": own for number in range(20_000)}))


@pytest.mark.parametrize(("proofs", "is_taken"), [(itself, False), (levels, False), (shared, True)])
def test_proofs_that_refer_to_each_other_are_judged_soon(
    small_report: Path, proofs: Callable[[Additions], DictionaryObject], is_taken: bool
) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    writer, made = Additions(io.BytesIO(whole)), io.BytesIO()
    writer.root[NameObject("/DSS")] = writer.add_object(proofs(writer))
    writer.update_root()
    writer.write(made)
    with limited(SECONDS):
        assert only_signed(whole, made.getvalue()) is is_taken


def tree(pdf: pikepdf.Pdf, leaf: pikepdf.Object, levels: int = 30, own: int = 3) -> pikepdf.Object:
    """A tree of so many levels, each node of which has the same child several times."""
    node = pdf.make_indirect(leaf)
    for _ in range(levels):
        node = pdf.make_indirect(pikepdf.Dictionary(T=pikepdf.String("x"), Kids=pikepdf.Array([node] * own)))
    return node


def attached(pdf: pikepdf.Pdf) -> pikepdf.Object:
    return tree(pdf, pdf.Root.Names.EmbeddedFiles)


def attached_nothing(pdf: pikepdf.Pdf) -> pikepdf.Object:
    return tree(pdf, pikepdf.Dictionary(Names=pikepdf.Array()))


def attached_once(pdf: pikepdf.Pdf) -> pikepdf.Object:
    return tree(pdf, pdf.Root.Names.EmbeddedFiles, 2000, 1)


def attached_wide(pdf: pikepdf.Pdf) -> pikepdf.Object:
    """Many nodes that share a long list of names."""
    names = pdf.make_indirect(pikepdf.Array([pikepdf.String("x")] * 20_000))
    return pikepdf.Dictionary(
        Kids=pikepdf.Array([pdf.make_indirect(pikepdf.Dictionary(Names=names)) for _ in range(20_000)])
    )


def attached_in_itself(pdf: pikepdf.Pdf) -> pikepdf.Object:
    """A node that is no object of its own, in a list that it refers to."""
    kids = pdf.make_indirect(pikepdf.Array())
    kids.append(pikepdf.Dictionary(Kids=kids))
    return pikepdf.Dictionary(Kids=kids)


@pytest.mark.parametrize("change", [attached, attached_nothing, attached_once, attached_wide, attached_in_itself])
def test_a_tree_of_attachments_without_an_end_is_refused(
    small_report: Path, tmp_path: Path, capfd: Capture, change: Callable[[pikepdf.Pdf], pikepdf.Object]
) -> None:
    with pikepdf.open(small_report / "small.pdf") as pdf:
        pdf.Root.Names.EmbeddedFiles = change(pdf)
        (tmp_path / "a.pdf").write_bytes(saved_pdf(pdf))
    for command in (["extract"], ["verify"], ["render"], ["diff", small_report / "small.json"]):
        with limited(SECONDS):
            assert run(*command, tmp_path / "a.pdf") == 2
        assert "a.pdf: The PDF lists more than 1000 attachments" in capfd.readouterr().err


def fields(pdf: pikepdf.Pdf) -> list[pikepdf.Object]:
    return [tree(pdf, pikepdf.Dictionary(FT=pikepdf.Name.Sig, T=pikepdf.String("x")))]


def fields_once(pdf: pikepdf.Pdf) -> list[pikepdf.Object]:
    return [tree(pdf, pikepdf.Dictionary(FT=pikepdf.Name.Sig, T=pikepdf.String("x")), 2000, 1)]


def same_signature(pdf: pikepdf.Pdf) -> list[pikepdf.Object]:
    """Fields that all have the same signature, each of which would be judged."""
    value = pdf.make_indirect(pikepdf.Dictionary(Type=pikepdf.Name.Sig, ByteRange=pikepdf.Array([0, 1, 2, 3])))
    field = pdf.make_indirect(pikepdf.Dictionary(FT=pikepdf.Name.Sig, T=pikepdf.String("x"), V=value))
    return [field] * 50_000


@pytest.mark.parametrize("change", every(2, [fields, same_signature, fields_once]))
def test_a_form_without_an_end_is_neither_judged_nor_signed(
    small_report: Path,
    tmp_path: Path,
    capfd: Capture,
    monkeypatch: pytest.MonkeyPatch,
    change: Callable[[pikepdf.Pdf], list[pikepdf.Object]],
) -> None:
    with pikepdf.open(small_report / "small.pdf") as pdf:
        pdf.Root.AcroForm.Fields.extend(change(pdf))
        pdf.Root.Zz = pikepdf.Dictionary(ByteRange=pikepdf.Array([0, 1, 2, 3]))  # in clear, as in a signed report
        whole = saved_pdf(pdf)
    (tmp_path / "a.pdf").write_bytes(whole)
    words = "its form has fields within fields, or more than 100"
    with limited(SECONDS):
        assert run("verify", tmp_path / "a.pdf", "--numbers") == 1
    assert f"✗ signature      cannot be read: {words}" in capfd.readouterr().out
    with limited(SECONDS):
        assert signed(tmp_path / "a.pdf", ec.generate_private_key(ec.SECP256R1()), monkeypatch) == 2
    assert f"a.pdf: The PDF cannot be signed: {words}. Give" in capfd.readouterr().err
    assert (tmp_path / "a.pdf").read_bytes() == whole


def with_table(table: bytes) -> bytes:
    """A PDF of one object, whose table of objects is a stream."""
    head = b"%PDF-1.7\n1 0 obj\n<< /Type /Catalog >>\nendobj\n"
    return head + b"2 0 obj\n" + table + b"\nendobj\nstartxref\n%d\n%%%%EOF\n" % len(head)


def rows(count: int) -> bytes:
    """A table of so many rows, packed, that all say the same."""
    data = zlib.compress(bytes(3 * count), 9)
    head = b"<< /Type /XRef /Root 1 0 R /W [1 1 1] /Size %d /Filter /FlateDecode /Length %d >>" % (count, len(data))
    return head + b"\nstream\n" + data + b"\nendstream"


@pytest.mark.parametrize(
    "table",
    [
        b"<< /Type /XRef /Root 1 0 R /W [0 0 0] /Index [0 1000000000] /Size 1000000000 /Length 0 >>\nstream\n\nendstream",
        rows(30_000_000),
    ],
    ids=["rows of nothing", "packed rows"],
)
def test_a_table_without_an_end_is_not_signed(table: bytes, tmp_path: Path, capfd: Capture) -> None:
    """The library that signs reads such a table without bounds."""
    (tmp_path / "a.pdf").write_bytes(with_table(table))
    engineer = signer("Engineer")
    key, cert = engineer.pem(tmp_path / "key.pem"), engineer.cert(tmp_path / "cert.pem")
    with limited(SECONDS):
        assert run("sign", tmp_path / "a.pdf", "--key", key, "--cert", cert) == 2
    assert "a.pdf: The PDF is damaged" in capfd.readouterr().err


def chain(tables: int) -> bytes:
    """A PDF of so many tables of objects, each before the next: the rows of each say nothing, and there are many."""
    rows = zlib.compress(bytes(3_000_000), 9)
    made, places = b"%PDF-1.7\n1 0 obj\n<< /Type /Catalog >>\nendobj\n", list[int]()
    for number in range(2, tables + 2):
        before = b"/#50rev\0%d " % places[-1] if places else b""
        places.append(len(made))
        head = b"<< /Type /XRef /Root 1 0 R /W [1 0 0] /Size 3000000 /Filter /FlateDecode /Length %d %s>>" % (
            len(rows),
            before,
        )
        made += b"%d 0 obj\n" % number + head + b"\nstream\n" + rows + b"\nendstream\nendobj\n"
    return made + b"startxref\n%d\n%%%%EOF\n" % places[-1]


OBJECTS = b"".join(
    b"%d 0 obj\n<< /Type /%s >>\nendobj\n" % each
    for each in ((1, b"Catalog /Pages 2 0 R"), (2, b"Pages /Kids [3 0 R] /Count 1"), (3, b"Page /Parent 2 0 R"))
)


def comment() -> bytes:
    """A PDF whose table leads again and again to the beginning of one long comment, which the library reads each time."""
    objects = b"%PDF-1.7\n" + OBJECTS
    rows = [b"0000000000 65535 f \n"] + [b"%010d 00000 n \n" % objects.index(b"%d 0 obj" % each) for each in (1, 2, 3)]
    rows += 2000 * [b"%010d 00000 n \n" % len(objects)]
    made = objects + b"%" + 3_000_000 * b"x" + b"\n"
    table = b"xref\n0 %d\n%strailer\n<< /Size %d /Root 1 0 R >>\n" % (len(rows), b"".join(rows), len(rows))
    return made + table + b"startxref\n%d\n%%%%EOF\n" % len(made)


def packed() -> bytes:
    """A PDF of 40 streams that say to hold a million objects each."""
    pairs, count, streams = zlib.compress(1_000_000 * b"99 0 " + b"null", 9), 1_000_000, range(10, 50)
    made = b"%PDF-1.7\n" + OBJECTS
    head = b"<< /Type /ObjStm /N %d /First %d /Filter /FlateDecode /Length %d >>" % (count, 5 * count, len(pairs))
    for number in streams:
        made += b"%d 0 obj\n%s\nstream\n%s\nendstream\nendobj\n" % (number, head, pairs)
    places = [made.index(b"\n%d 0 obj" % each) + 1 for each in (1, 2, 3, *streams)]
    rows = b"".join(b"\1%s\0" % each.to_bytes(4, "big") for each in places)
    rows += b"".join(b"\2%s\0" % each.to_bytes(4, "big") for each in streams)
    index = b"1 3 %d %d 1000 %d" % (streams[0], len(streams), len(streams))
    table = b"<< /Type /XRef /W [1 4 1] /Index [%s] /Size 2000 /Root 1 0 R /Length %d >>" % (index, len(rows))
    return made + b"4 0 obj\n%s\nstream\n%s\nendstream\nendobj\nstartxref\n%d\n%%%%EOF\n" % (table, rows, len(made))


@pytest.mark.parametrize("content", every(3, [comment(), chain(400), packed()]), ids=["comment", "tables", "packed"])
def test_a_pdf_that_takes_too_long_or_too_much_memory_is_ended(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch, content: bytes
) -> None:
    """Nothing that it says of itself tells what the library will walk through."""
    monkeypatch.setattr(pdf_attachments, "SECONDS", 1)
    (tmp_path / "a.pdf").write_bytes(content)
    with limited(SECONDS):
        assert run("extract", tmp_path / "a.pdf", "-o", tmp_path) == 2
    assert "a.pdf: The PDF is not read within" in capfd.readouterr().err


def test_a_reader_that_breaks_is_a_fault_of_the_program_and_not_of_the_pdf(
    small_report: Path, tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pdf_attachments, "APART", "raise LookupError('not there')")
    (tmp_path / "a.pdf").write_bytes((small_report / "small.pdf").read_bytes() + b"\n")
    assert run("extract", tmp_path / "a.pdf", "-o", tmp_path / "out") == 70
    assert "LookupError: not there" in capfd.readouterr().err
