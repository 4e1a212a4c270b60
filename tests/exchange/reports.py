"""Reports of strangers: made of what a real one carries, with something changed, or built by hand."""

from __future__ import annotations

import base64
import gzip
import io
import json
import zlib
from collections.abc import Callable
from functools import reduce
from operator import getitem
from pathlib import Path
from typing import Any

import pikepdf

from diecut_report.cli.main import main
from tests.configs import GOOD

MB = 1_000_000


def run(*arguments: object) -> int:
    """The exit code of a command, with the kinds for tests."""
    return main([*map(str, arguments), "--plugins", str(GOOD)])


def page_with(content: bytes) -> bytes:
    """A page that carries these bytes as its results."""
    return page_of(base64.b64encode(gzip.compress(content, mtime=0)))


def page_of(text: bytes) -> bytes:
    """A page with this text in its link."""
    return b'<!DOCTYPE html><a download="results.json.gz" href="data:application/gzip;base64,%s">r</a>' % text


def pdf_with(files: dict[str, bytes], *, filters: tuple[str, ...] = (), password: str | None = None) -> bytes:
    """A PDF with these files attached; their bytes are taken as packed by the filters."""
    pdf = pikepdf.new()
    pdf.add_blank_page()
    names = pikepdf.Array()
    for name, content in sorted(files.items()):
        stream = pikepdf.Stream(pdf, b"")
        stream.write(content, filter=pikepdf.Array([pikepdf.Name(each) for each in filters]) if filters else None)
        label = pikepdf.String(name)
        spec = pikepdf.Dictionary(Type=pikepdf.Name("/Filespec"), F=label, UF=label, EF=pikepdf.Dictionary(F=stream))
        names.extend([label, pdf.make_indirect(spec)])
    pdf.Root.Names = pikepdf.Dictionary(EmbeddedFiles=pikepdf.Dictionary(Names=names))
    return saved_pdf(pdf, password)


def saved_pdf(pdf: pikepdf.Pdf, password: str | None = None) -> bytes:
    """The bytes of a PDF, its streams as they are."""
    file = io.BytesIO()
    if password:
        pdf.save(file, encryption=pikepdf.Encryption(owner=password, user=password))
    else:
        pdf.save(file, compress_streams=False, stream_decode_level=pikepdf.StreamDecodeLevel.none)
    return file.getvalue()


def zeros(count: int) -> bytes:
    """So many zeros, packed."""
    packing, piece = zlib.compressobj(9), bytes(10 * MB)
    return b"".join([packing.compress(piece) for _ in range(count // len(piece))]) + packing.flush()


def changed(results: Path, target: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    """A copy of a results file with something changed."""
    data = json.loads(results.read_text("utf-8"))
    change(data)
    target.write_text(json.dumps(data), "utf-8")
    return target


def set_at(path: str, value: object) -> Callable[[dict[str, Any]], None]:
    """Change what stands at a path (``mechanisms/knife/status``); a list's number is a number."""
    *way, last = (int(key) if key.isdigit() else key for key in path.split("/"))

    def change(data: Any) -> None:
        home = reduce(getitem, way, data)
        assert home[last] != value
        home[last] = value

    return change


def removed_at(home: str, key: str) -> Callable[[dict[str, Any]], object]:
    """Leave out a key of what stands at a path."""
    return lambda data: reduce(getitem, home.split("/") if home else [], data).pop(key)


def added_at(path: str, key: str, value: object) -> Callable[[dict[str, Any]], None]:
    """Say at a path what the report does not say."""

    def change(data: Any) -> None:
        home = reduce(getitem, path.split("/"), data)
        assert key not in home
        home[key] = value

    return change
