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
from diecut_report.exchange.pdf_attachments import END
from diecut_report.exchange.signing import Additions
from diecut_report.time_limit import limited
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


@pytest.mark.parametrize("change", [fields, fields_once, same_signature])
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
    assert "a.pdf: The PDF cannot be signed" in capfd.readouterr().err


def test_a_pdf_of_many_objects_is_not_looked_through_for_ever(
    small_report: Path, tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pdf_attachments, "MOST_OBJECTS", 100_000)
    with pikepdf.open(small_report / "small.pdf") as pdf:
        pdf.Root.More = pikepdf.Array([pdf.make_indirect(pikepdf.Dictionary(A=i)) for i in range(6_000)])
        content = saved_pdf(pdf)
    end = END.findall(content)[-1]
    (tmp_path / "a.pdf").write_bytes(content + 39 * (b"\n" + end))
    with limited(SECONDS):
        assert run("extract", tmp_path / "a.pdf", "-o", tmp_path) == 2
    assert "objects in all, as it was added to 39 times" in capfd.readouterr().err


def chain(tables: int, ends: int) -> bytes:
    """A PDF of so many tables of objects, each before the next, and with so many ends: of each the rows say nothing, and there are many."""
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
    return made + ends * (b"startxref\n%d\n%%%%EOF\n" % places[-1])


@pytest.mark.parametrize(("tables", "ends"), [(15, 15), (40, 1)])
def test_a_pdf_of_many_tables_is_tried_apart(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch, tables: int, ends: int
) -> None:
    """All of them are walked through before anything else is known of it."""
    monkeypatch.setattr(pdf_attachments, "SECONDS", 1)
    (tmp_path / "a.pdf").write_bytes(chain(tables, ends))
    with limited(SECONDS):
        assert run("extract", tmp_path / "a.pdf", "-o", tmp_path) == 2
    assert "a.pdf: The PDF is not opened within" in capfd.readouterr().err


def test_a_pdf_of_some_tables_is_opened_after_it_was_tried(small_report: Path, tmp_path: Path) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    end = b"\n" + END.findall(whole)[-1]
    (tmp_path / "a.pdf").write_bytes(whole + b"\n%" + 20 * b"/Prev 9 " + end)
    assert run("extract", tmp_path / "a.pdf", "-o", tmp_path / "out", "--quiet") == 0
