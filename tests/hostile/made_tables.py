"""Tables that a stranger may hand to a study, each made by a function named as it is."""

from __future__ import annotations

import os
import random
import socket
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import openpyxl
import pyarrow as pa
import pyarrow.parquet as pq

Made = Callable[[Path], None]
MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
SHEET, STRINGS, STYLES, BOOK = "xl/worksheets/sheet1.xml", "xl/sharedStrings.xml", "xl/styles.xml", "xl/workbook.xml"


def plain_workbook() -> dict[str, bytes]:
    """The members of a sound workbook with the table a: 1, 2 and b: x, y."""
    book, out = openpyxl.Workbook(), BytesIO()
    for row in (["a", "b"], [1, "x"], [2, "y"]):
        book.worksheets[0].append(row)
    book.save(out)
    with zipfile.ZipFile(out) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def workbook(changed: dict[str, bytes], path: Path) -> None:
    """A workbook with other members in the place of sound ones; they are packed as well as they can be."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, content in (plain_workbook() | changed).items():
            archive.writestr(name, content)


def sheet(rows: bytes, head: bytes = b"") -> dict[str, bytes]:
    """A sheet with these rows."""
    told = f'<worksheet xmlns="{MAIN}"><sheetData>'.encode()
    return {SHEET: head + told + rows + b"</sheetData></worksheet>"}


def inline(text: bytes) -> bytes:
    """A row with a header and one with this text in its cell."""
    head = b'<row r="1"><c r="A1" t="inlineStr"><is><t>a</t></is></c></row>'
    return head + b'<row r="2"><c r="A2" t="inlineStr"><is><t>' + text + b"</t></is></c></row>"


HEAD = inline(b"1").split(b'<row r="2">')[0]
LAUGHS = b"<!DOCTYPE x [<!ENTITY a '" + b"ha" * 5000 + b"'>" + b"".join(
    f"<!ENTITY {name} '{f'&{before};' * 10}'>".encode() for before, name in zip("abcd", "bcde", strict=True)
) + b"]>"  # fmt: skip


def flipped(path: Path, seed: int) -> None:
    """A sound workbook or Parquet file with one bit of it flipped."""
    out = BytesIO()
    if path.suffix == ".xlsx":
        workbook({}, path)
    else:
        pq.write_table(pa.table({"a": [1.0, 2.0], "b": ["x", "y"]}), out)
        path.write_bytes(out.getvalue())
    content, chance = bytearray(path.read_bytes()), random.Random(seed)
    content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    path.write_bytes(bytes(content))


def cut(path: Path) -> None:
    """The first half of a sound workbook."""
    workbook({}, path)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def hole(path: Path, size: int = 20_000_000_000) -> None:
    """A file of this size that takes no room on the disk."""
    with path.open("wb") as file:
        file.truncate(size)


def a_socket(path: Path) -> None:
    """A socket, bound by a short name: that of a path is limited."""
    before = Path.cwd()
    os.chdir(path.parent)
    try:
        with socket.socket(socket.AF_UNIX) as made:
            made.bind(path.name)
    finally:
        os.chdir(before)


def parquet(columns: dict[str, object], path: Path, **options: object) -> None:
    """A Parquet file of these columns, packed as well as it can be."""
    pq.write_table(pa.table(columns), path, compression="zstd", **options)


def repeated(text: str, count: int) -> object:
    """A column that holds one text so many times."""
    return pa.DictionaryArray.from_arrays(pa.array([0] * count, pa.int32()), [text])


QUICK: dict[str, Made] = {
    # --- what is no regular file
    "pipe.csv": os.mkfifo,
    "pipe.xlsx": os.mkfifo,
    "pipe.parquet": os.mkfifo,
    "zero.csv": lambda path: path.symlink_to("/dev/zero"),
    "zero.parquet": lambda path: path.symlink_to("/dev/zero"),
    "random.xlsx": lambda path: path.symlink_to("/dev/urandom"),
    "folder.csv": Path.mkdir,
    "folder.xlsx": Path.mkdir,
    "socket.csv": a_socket,
    "loop.csv": lambda path: path.symlink_to(path.name),
    "hole.csv": hole,
    "hole.xlsx": hole,
    "hole.parquet": hole,
    # --- CSV
    "empty.csv": lambda path: path.write_bytes(b"") and None,
    "zeros.csv": lambda path: hole(path, 1_000_000),
    "line.csv": lambda path: hole(path, 150_000_000),
    "quote.csv": lambda path: path.write_bytes(b'a,b\n"' + b"1,2\n" * 600_000 + b'"') and None,
    "columns.csv": lambda path: path.write_bytes(b"," * 900_000 + b"\n1") and None,
    "blank.csv": lambda path: path.write_bytes(b"a,b,c,d,e,f,g,h,i\n" + b"\n" * 5_000_000) and None,
    "ragged.csv": lambda path: path.write_bytes(b"a,b\n" + b"1\n" * 100_000) and None,
    "words.csv": lambda path: path.write_bytes(b"a\n" + b"x\n" * 100_000) and None,
    # --- XLSX
    "cut.xlsx": cut,
    "packed cell.xlsx": lambda path: workbook(sheet(inline(b"x" * 120_000_000)), path),
    "far cell.xlsx": lambda path: workbook(
        sheet(HEAD + b'<row r="1048576"><c r="XFD1048576"><v>1</v></c></row>'), path
    ),
    "far cells.xlsx": lambda path: workbook(
        sheet(b"".join(b'<row r="%d"><c r="XFD%d"><v>1</v></c></row>' % (n, n) for n in range(1, 3000))), path
    ),
    "far row.xlsx": lambda path: workbook(sheet(HEAD + b'<row r="99999999999"><c><v>1</v></c></row>'), path),
    "far column.xlsx": lambda path: workbook(sheet(HEAD + b'<row r="2"><c r="ZZZZZZ2"><v>1</v></c></row>'), path),
    "negative row.xlsx": lambda path: workbook(sheet(HEAD + b'<row r="-5"><c r="A-5"><v>1</v></c></row>'), path),
    "empty rows.xlsx": lambda path: workbook(sheet(HEAD + b"<row/>" * 2_100_000), path),
    "many fonts.xlsx": lambda path: workbook(
        {STYLES: b'<styleSheet xmlns="%s"><fonts>' % MAIN.encode() + b"<font/>" * 300_000 + b"</fonts></styleSheet>"},
        path,
    ),
    "entities.xlsx": lambda path: workbook(sheet(inline(b"&e;"), LAUGHS), path),
    "strings with entities.xlsx": lambda path: workbook(
        {STRINGS: LAUGHS + b'<sst xmlns="%s"><si><t>&e;</t></si></sst>' % MAIN.encode()}, path
    ),
    "other letters.xlsx": lambda path: workbook(
        {SHEET: b"<?xml version='1.0' encoding='cp037'?>" + sheet(inline(b"1"))[SHEET].decode().encode("cp037")}, path
    ),
    "no book.xlsx": lambda path: workbook({BOOK: b""}, path),
    "no sheet.xlsx": lambda path: workbook({SHEET: b""}, path),
    "no strings.xlsx": lambda path: workbook({STRINGS: b'<sst xmlns="%s"/>' % MAIN.encode()}, path),
    "string 9.xlsx": lambda path: workbook(sheet(HEAD + b'<row r="2"><c r="A2" t="s"><v>9999999</v></c></row>'), path),
    "style 9.xlsx": lambda path: workbook(sheet(HEAD + b'<row r="2"><c r="A2" s="9999"><v>1</v></c></row>'), path),
    "word as number.xlsx": lambda path: workbook(sheet(HEAD + b'<row r="2"><c r="A2"><v>one</v></c></row>'), path),
    "strange type.xlsx": lambda path: workbook(sheet(HEAD + b'<row r="2"><c r="A2" t="d"><v>no</v></c></row>'), path),
    "open tag.xlsx": lambda path: workbook(sheet(HEAD + b"<row><c>"), path),
    "members.xlsx": lambda path: workbook({f"m{number}": b"" for number in range(11_000)}, path),
    **{f"bit {seed}.xlsx": lambda path, seed=seed: flipped(path, seed) for seed in range(40)},  # type: ignore[misc]
    "letters.xlsx": lambda path: workbook(sheet(inline(b"x" * 9_900_000)), path),
    "attributes.xlsx": lambda path: workbook(
        sheet(HEAD + b"<row " + b"".join(b"a%d='' " % n for n in range(800_000)) + b"/>"), path
    ),
    "comment.xlsx": lambda path: workbook(sheet(HEAD + b"<!--" + b" <" * 9_000_000 + b"-->"), path),
    "two bytes.xlsx": lambda path: workbook({SHEET: sheet(inline(b"1"))[SHEET].decode().encode("utf-16")}, path),
    # --- Parquet
    "cut.parquet": lambda path: path.write_bytes(b"PAR1" + bytes(100) + b"\xff\xff\xff\x7fPAR1") and None,
    "text.parquet": lambda path: parquet({"a": repeated("x" * 100_000, 100_000)}, path),
    "rows.parquet": lambda path: parquet({"a": repeated("1", 11_000_000)}, path),
    "columns.parquet": lambda path: parquet({f"c{number}": [1] for number in range(17_000)}, path),
    "lists.parquet": lambda path: parquet({"a": [[[1.0]]]}, path),
    "twins.parquet": lambda path: pq.write_table(pa.Table.from_arrays([pa.array([1.0])] * 2, ["a", "a"]), path),
    **{f"bit {seed}.parquet": lambda path, seed=seed: flipped(path, seed) for seed in range(40)},  # type: ignore[misc]
}

# as large as it may be, and made of what takes most memory
LARGEST: dict[str, Made] = {
    "rows.xlsx": lambda path: workbook(sheet(HEAD + b"<row/>" * 1_000_000), path),
    "cells.xlsx": lambda path: workbook(sheet(HEAD + (b"<row>" + b"<c/>" * 4_000 + b"</row>") * 480), path),
    "strings.xlsx": lambda path: workbook(
        {STRINGS: b'<sst xmlns="%s">' % MAIN.encode() + b"<si/>" * 1_990_000 + b"</sst>"}, path
    ),
    "styles.xlsx": lambda path: workbook(
        {STYLES: b'<styleSheet xmlns="%s"><fonts>' % MAIN.encode() + b"<font/>" * 190_000 + b"</fonts></styleSheet>"},
        path,
    ),
    "formats.xlsx": lambda path: workbook(
        {STYLES: b'<styleSheet xmlns="%s"><cellXfs>' % MAIN.encode() + b"<xf/>" * 190_000 + b"</cellXfs></styleSheet>"},
        path,
    ),
    "sheets.xlsx": lambda path: workbook(
        {BOOK: b'<workbook xmlns="%s"><sheets>' % MAIN.encode() + b"<sheet/>" * 190_000 + b"</sheets></workbook>"},
        path,
    ),
    "merged.xlsx": lambda path: workbook(
        {
            SHEET: b'<worksheet xmlns="%s"><mergeCells>' % MAIN.encode()
            + b"<mergeCell ref='A1'/>" * 190_000
            + b"</mergeCells></worksheet>"
        },
        path,
    ),
    "words.csv": lambda path: path.write_bytes(b"a\n" + b"".join(b"%d x\n" % n for n in range(9_990_000))) and None,
    "units.csv": lambda path: path.write_bytes(b"a\n" + b"".join(b"%d mm\n" % n for n in range(3_000_000))) and None,
    "blank.csv": lambda path: path.write_bytes(b"a,b\n" + b"\n" * 4_990_000 + b"1,2\n") and None,
    "text.parquet": lambda path: parquet({"a": repeated("x" * 40, 9_900_000)}, path),
    "numbers.parquet": lambda path: parquet({"a": pa.array([1.0]).take(pa.array([0] * 9_900_000))}, path),
}


def made(folder: Path, tables: dict[str, Made]) -> list[Path]:
    """The tables in a folder."""
    for name, make in tables.items():
        make(folder / name)
    return [folder / name for name in tables]
