"""Reports of strangers: what is damaged, encrypted, endless or unpacks without end is refused in words, and takes no more than is allowed."""

from __future__ import annotations

import base64
import gzip
import io
import os
import struct
import zlib
from pathlib import Path

import pikepdf
import pytest

from diecut_report.cli.main import main
from tests.exchange.reports import MB, page_of, page_with, pdf_with, saved_pdf, zeros
from tests.hostile.bounded import PEAK
from tests.hostile.bounded import run as bounded
from tests.shared import once

Capture = pytest.CaptureFixture[str]
COMMANDS = ("extract", "verify", "render")
DAMAGED = "The PDF is damaged"
UNPACKED = 400 * MB
READ = f"""
import sys
{PEAK}
from diecut_report.cli.main import main

for name in sys.argv[1:]:
    assert main(["extract", name, "-o", name + ".out"]) == 2, name
assert memory() < 380e6, memory()
"""


def endless_places(packed: bytes) -> bytes:
    """A PDF whose table of places unpacks without end."""
    head = b"%PDF-1.7\n"
    keys = b"5 0 obj\n<</Type/XRef/Size 400000000/W[1 2 1]/Filter/FlateDecode/Length %d/Root 1 0 R>>\nstream\n" % len(
        packed
    )
    return head + keys + packed + b"\nendstream\nendobj\nstartxref\n%d\n%%%%EOF" % len(head)


@pytest.fixture(scope="module")
def endless(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of small files that unpack to hundreds of megabytes."""

    def make(folder: Path) -> None:
        packed = zeros(UNPACKED)
        (folder / "stream.pdf").write_bytes(pdf_with({"results.json": packed}, filters=("/FlateDecode",)))
        twice = zlib.compress(packed, 9)
        (folder / "twice.pdf").write_bytes(pdf_with({"results.json": twice}, filters=("/FlateDecode", "/FlateDecode")))
        (folder / "places.pdf").write_bytes(endless_places(packed))
        (folder / "deep.pdf").write_bytes(b"%PDF-1.7\n1 0 obj\n" + 3 * MB * b"[" + b"\nendobj\nstartxref\n9\n%%EOF")
        # what gzip puts around packed data: its head, and a sum that need not hold, as the end is never reached
        whole = b"\x1f\x8b\x08\0\0\0\0\0\x02\xff" + packed[2:-4] + struct.pack("<II", 0, UNPACKED)
        (folder / "page.html").write_bytes(page_of(base64.b64encode(whole)))

    return once(tmp_path_factory, "endless_reports", make)


@pytest.mark.nightly
def test_what_unpacks_without_end_is_stopped(endless: Path) -> None:
    files = sorted(path for path in endless.iterdir() if path.is_file())
    assert len(files) == 5 and max(path.stat().st_size for path in files) < 5 * MB
    bounded(READ, *files)


def test_damaged_and_encrypted_reports_are_refused_in_words(small_report: Path, tmp_path: Path, capfd: Capture) -> None:
    good = (small_report / "small.pdf").read_bytes()
    page = (small_report / "small.html").read_bytes()
    at = page.rindex(b"data:application/gzip;base64,H4s") + 300
    rows = {
        "cut.pdf": (good[: len(good) // 2], DAMAGED),
        "tail.pdf": (good[:-3000], DAMAGED),
        "head.pdf": (b"%PDF-1.7\n", DAMAGED),
        "locked.pdf": (saved_pdf(pikepdf.open(io.BytesIO(good)), "secret"), "encrypted"),
        "text.pdf": (pdf_with({"results.json": b"no JSON"}), "not a JSON file"),
        "packed.pdf": (pdf_with({"results.json": b"not packed"}, filters=("/FlateDecode",)), DAMAGED),
        "two.html": (page + page, "carries 2 results files"),
        "letter.html": (page[:at] + b"AAAA" + page[at + 4 :], "damaged"),
        "cut.html": (page_of(base64.b64encode(gzip.compress(b"{}" * 1000)[:-9])), "damaged"),
        "more.html": (page_of(base64.b64encode(gzip.compress(b"{}") + b"more")), "damaged"),
        "odd.html": (page_of(b"H4sIA"), "damaged"),
        "none.html": (page_with(b""), "not a JSON file"),
        "empty": (b"", "neither a report"),
    }
    for name, (content, words) in rows.items():
        (tmp_path / name).write_bytes(content)
        assert main(["extract", str(tmp_path / name), "-o", str(tmp_path / "out")]) == 2, name
        told = capfd.readouterr().err
        assert words in told and "Traceback" not in told, (name, told)
    assert not (tmp_path / "out").exists()


def test_names_in_a_circle_have_an_end(tmp_path: Path, capfd: Capture) -> None:
    pdf = pikepdf.new()
    pdf.add_blank_page()
    node = pdf.make_indirect(pikepdf.Dictionary(Kids=pikepdf.Array()))
    node.Kids.append(node)
    pdf.Root.Names = pikepdf.Dictionary(EmbeddedFiles=node)
    (tmp_path / "a.pdf").write_bytes(saved_pdf(pdf))
    assert main(["extract", str(tmp_path / "a.pdf"), "-o", str(tmp_path / "out")]) == 2
    assert "the same ones again and again" in capfd.readouterr().err


@pytest.mark.parametrize("command", COMMANDS)
def test_a_pipe_a_folder_and_a_device_are_not_read(tmp_path: Path, capfd: Capture, command: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    for name in (tmp_path / "pipe", tmp_path, Path("/dev/zero"), tmp_path / "nowhere"):
        assert main([command, str(name)]) == 2
        assert "Traceback" not in capfd.readouterr().err


def test_both_sides_of_a_comparison_are_read_as_carefully(small_report: Path, tmp_path: Path, capfd: Capture) -> None:
    os.mkfifo(tmp_path / "pipe.yaml")
    (tmp_path / "a.pdf").write_bytes(b"%PDF-1.7\n")
    good = small_report / "small.json"
    for pair in ((good, tmp_path / "pipe.yaml"), (tmp_path / "a.pdf", good), (good, tmp_path)):
        assert main(["diff", *map(str, pair)]) == 2
        assert "Traceback" not in capfd.readouterr().err
