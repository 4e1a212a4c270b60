"""Reports and catalogues of strangers: read, or refused in words where damaged, encrypted or endless, within the memory that is allowed."""

from __future__ import annotations

import base64
import gzip
import io
import os
import shutil
import struct
import zlib
from pathlib import Path

import pikepdf
import pytest

from diecut_report.cli.main import main
from diecut_report.errors import UserError
from diecut_report.text.catalogues import TextCatalogue
from tests.configs import GOOD, LEVER, saved
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


TEXT = b'msgid "Force"\nmsgstr "x"\n'


def head(line: str) -> bytes:
    """The head of a catalogue with a line of its own."""
    return f'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=utf-8\\n"\n"{line}\\n"\n\n'.encode()


def plural(form: str, count: int = 3) -> bytes:
    """A catalogue whose forms of words for numbers are chosen so."""
    return head(f"Plural-Forms: nplurals={count}; plural={form};") + TEXT


FAULTS = {
    "bytes": (b"\0\xff\xfe", "can't decode byte 0xff"),
    "letters": (head("X: y") + b'msgid "Force"\nmsgstr "\xff"\n', "can't decode byte 0xff"),
    "by nothing": (plural("n/0"), "by zero"),
    "code": (plural("__import__('os').abort()"), "invalid token in plural form: __import__"),
    "brackets": (plural("(" * 500 + "n" + ")" * 500), "too long"),
    "below": (plural("0-9"), "have none for 0"),
    "above": (plural("n"), "have none for 3"),
    "forms": (plural("n", 10**11), "at most 10 forms"),
    "encoding": (b'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=xyz\\n"\n\n' + TEXT, "unknown encoding"),
    "clock": (head("PO-Revision-Date: 99999-99-99 99:99+9999") + TEXT, "does not match format"),
    "language": (head("Language: ../../x") + TEXT, "expected only letters"),
    "many forms": (plural("0") + b'msgid "a"\nmsgid_plural "b"\nmsgstr[999999999] "c"\n', "more translations than"),
    "an open translation": (
        TEXT.replace(b'x"', b"x"),
        "line 2 is 'msgstr \"x'; write msgid or msgstr, and a text that begins and ends",
    ),
    "an open text": (TEXT.replace(b'Force"', b"Force"), "line 1 is 'msgid \"Force'"),
    "an open end of lines": (TEXT + b'"y\n', "line 3 is '\"y'"),
    "a quotation mark within": (TEXT.replace(b'"x"', b'"x" y"'), "line 2 is"),
    "no text": (TEXT + b"\nForce\n", "line 4 is 'Force'"),
    "a text twice": (
        TEXT + b'\nmsgid "Force"\nmsgstr "y"\n',
        "line 4 translates 'Force', as line 1 does; keep one of them",
    ),
    "another name": (
        b'msgid "is {force}"\nmsgstr "x {forse}"\n',
        "line 1: the translation of 'is {force}' is filled with {forse}, the text itself with {force}; write the same names",
    ),
    "a name that is lost": (
        b'msgid "is {force}"\nmsgstr "x"\n',
        "is filled with nothing, the text itself with {force}",
    ),
    "two translations of one text": (
        b'msgid "Force"\nmsgstr "F"\nmsgstr "G"\n',
        "line 3 is a second msgstr of one text; keep one of them",
    ),
    "a brace too many": (b'msgid "Force"\nmsgstr "x {."\n', "holds a brace that its text has not; take it away"),
    "a name too many": (b'msgid "Force"\nmsgstr "x {y}"\n', "is filled with {y}, the text itself with nothing"),
    "rounded otherwise": (
        b'msgid "is {force:up}"\nmsgstr "x {force}"\n',
        "is filled with {force}, the text itself with {force:up}",
    ),
    "a name lost in a form": (
        plural("n>1", 2)
        + b'msgid "{n} of {all}"\nmsgid_plural "{n} of {all} all"\nmsgstr[0] "{all}"\nmsgstr[1] "{n} {all}"\n',
        "is filled with {all}, the text itself with {all}, {n}",
    ),
    **{
        f"U+{ord(letter):04X}": (
            head("X: y") + f'msgid "Force"\nmsgstr "{letter}"\n'.encode(),
            f"holds U+{ord(letter):04X}",
        )
        for letter in "\0\x1b\x85\u2028\u202e\u2066"
    },
}


SOUND = {
    "each once": TEXT + b'\nmsgid "is {force}"\nmsgstr "{force} x"\n\n#~ msgid "Force"\n#~ msgstr "z"\n',
    "another context": TEXT + b'\nmsgctxt "c"\nmsgid "Force"\nmsgstr "y"\n',
    "one without its number": plural("n>1", 2)
    + b'msgid "one"\nmsgid_plural "{n} all"\nmsgstr[0] "x"\nmsgstr[1] "{n} x"\n',
    "not translated": b'msgid "is {force}"\nmsgstr ""\n',
    "guessed": b'#, fuzzy\nmsgid "is {force}"\nmsgstr "x"\n',
    "several lines": b'msgid ""\n"is {force}"\nmsgstr "x "\n  "{force} \\"y\\" \\\\"\r\n',
}


@pytest.mark.parametrize("name", SOUND)
def test_what_is_a_catalogue_is_read(name: str, tmp_path: Path) -> None:
    file = tmp_path / "lever.uk.po"
    file.write_bytes(SOUND[name])
    TextCatalogue(file, "uk")


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_no_catalogue_is_told(name: str, tmp_path: Path) -> None:
    content, words = FAULTS[name]
    file = tmp_path / "lever.uk.po"
    file.write_bytes(content)
    with pytest.raises(UserError) as error:
        TextCatalogue(file, "uk")
    assert str(error.value).startswith(f"{file}: This catalogue of texts cannot be read: ") and words in str(
        error.value
    )


def test_a_report_is_refused_with_the_name_of_the_file(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    shutil.copy(GOOD / "lever.py", tmp_path)
    (tmp_path / "lever.uk.po").write_bytes(FAULTS["code"][0])
    config, out = saved(tmp_path, LEVER), tmp_path / "out"
    asked = ["report", config, "-o", out, "--format", "html", "--language", "uk", "--plugins", tmp_path]
    assert main(list(map(str, asked))) == 2
    assert f"{tmp_path / 'lever.uk.po'}: Цей каталог" in capfd.readouterr().err and not out.exists()
