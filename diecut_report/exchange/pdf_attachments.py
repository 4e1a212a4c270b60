"""Reads a file that is attached to a PDF, whoever made it: bounded, and without repairing what is damaged."""

from __future__ import annotations

import io
import re
import resource
import subprocess
import sys
import zlib
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import pikepdf
from pikepdf import settings

from diecut_report.errors import UserError, refusal
from diecut_report.text.phrases import phrase

MOST_ITEMS = 1_000_000  # of an array or a dictionary
MOST_WARNINGS = 100
DEEPEST = 100
MOST_ATTACHED = 1000  # files, with the nodes of their tree
MOST_REVISIONS = 40
MOST_TO_OPEN = 48_000_000  # bytes that a stream unpacks to while a PDF is opened; the catalogue of a large report stands in one of 20 MB
SECONDS = 30  # of the processor, for reading a PDF in a process of its own: a large report takes 2
GIGABYTES = 4  # of memory there: a large report takes 0.4
APART = (
    "import sys; from diecut_report.exchange.pdf_attachments import try_reading; "
    "try_reading(sys.stdin.buffer.read(), *map(int, sys.argv[1:]))"
)
MOST_OBJECTS = 4_000_000  # of all revisions together, each of which is looked through: a large report has some 200 000
NAMES = ("/F", "/UF", "/DOS", "/Mac", "/Unix")  # of an attachment
END = re.compile(rb"startxref\s+\d+\s+%%EOF\s?\n?")
PDF_FAULTS = (
    ValueError, TypeError, LookupError, AttributeError, NameError, ArithmeticError, RuntimeError, AssertionError, OSError, MemoryError,
    zlib.error,
)  # fmt: skip
"""What libraries raise for a PDF that is not as the standard has it: it was damaged, or made to harm.

RuntimeError with recursion and what is not implemented, ArithmeticError with decimals, NameError with a variable that was never set."""
_bounds = {"most": 0}  # of the library, which has one for the whole process
FAULTS = (pikepdf.PdfError, *PDF_FAULTS)
"""The same of pikepdf."""
SEVERAL = phrase(
    "The PDF carries {count} files named {name}, and a report has one. Give the file as the program wrote it."
)


def attachment(content: bytes, name: str, most: int, file: str) -> bytes | None:
    """Return the attachment of a name, None where the PDF has none; UserError where it cannot be read, or is larger than ``most``."""
    require_readable(content, most, file)
    try:
        return _attachment(content, name, most, file)
    except pikepdf.PasswordError as error:
        raise refusal("The PDF is encrypted, and opens only with a password. Give one without.", file) from error
    except FAULTS as error:
        template = (
            "The PDF is damaged, or holds more than {most} MB in one piece. Give the file as the program wrote it."
        )
        raise refusal(template, file, most=f"{most / 1e6:g}") from error


def require_readable(content: bytes, most: int, file: object) -> None:
    """Raise UserError for a PDF that is not read with bounded time and memory.

    Whatever a few bytes make the library unpack or walk through cannot be interrupted, so a process of its own, which the system can
    end, reads it first.
    """
    if not _is_readable(content, most):
        template = "The PDF is not read within {seconds} s and {gigabytes} GB of memory. Give the file as the program wrote it."
        raise refusal(template, file, seconds=SECONDS, gigabytes=GIGABYTES)


@lru_cache(maxsize=1)
def _is_readable(content: bytes, most: int) -> bool:
    limits = [str(each) for each in (most, SECONDS, GIGABYTES)]
    tried = subprocess.run(
        [sys.executable, "-I", "-c", APART, *limits],
        input=content,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=False,
    )
    return tried.returncode == 0


def try_reading(content: bytes, most: int, seconds: int, gigabytes: int) -> None:
    """Read a PDF as for an attachment, only to see whether that ends: what is wrong with it is no matter here, but a want of memory is."""
    for resource_kind, limit in ((resource.RLIMIT_CPU, seconds), (resource.RLIMIT_AS, gigabytes << 30)):
        hard = resource.getrlimit(resource_kind)[1]
        resource.setrlimit(resource_kind, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))
    try:
        _attachment(content, "results.json", most, "")
    except MemoryError:
        raise
    except (UserError, *FAULTS):
        pass


def _attachment(content: bytes, name: str, most: int, file: str) -> bytes | None:
    bounded(most)
    with opened(content) as pdf:
        found = _found(pdf, name, most, file)
    _refuse_former(content, found, name, most, file)
    return found


def opened(content: bytes) -> pikepdf.Pdf:
    """Return a PDF as it stands: what is damaged is not repaired, and what all sheets have in common stays where it is written.

    Opening walks through all tables of objects, of which none is larger than a large report has.
    """
    settings.set_qpdf_limits(flate_max_memory=MOST_TO_OPEN)
    try:
        return pikepdf.open(
            io.BytesIO(content), attempt_recovery=False, suppress_warnings=True, inherit_page_attributes=False
        )
    finally:
        settings.set_qpdf_limits(flate_max_memory=_bounds["most"])


def bounded(most: int) -> None:
    """Let the library unpack no more than so much of any stream."""
    _bounds["most"] = most
    settings.set_qpdf_limits(
        doc_max_warnings=MOST_WARNINGS, parser_max_nesting=DEEPEST, parser_max_container_size=MOST_ITEMS,
        flate_max_memory=most, png_max_memory=most, run_length_max_memory=most, tiff_max_memory=most, dct_max_memory=most,
    )  # fmt: skip


def _found(pdf: pikepdf.Pdf, name: str, most: int, file: str) -> bytes | None:
    # the names only tell which attachment it is; nothing is written under them
    found = list(_named(pdf, name, file))
    if not found:
        return None
    if len(found) > 1:
        raise refusal(SEVERAL, file, count=len(found), name=name)
    content = found[0].read_bytes()
    if len(content) > most:
        template = "What is attached is too large: {count} MB; at most {most} MB are taken."
        raise refusal(template, file, count=f"{len(content) / 1e6:.1f}", most=f"{most / 1e6:g}")
    return bytes(content)


def _refuse_former(content: bytes, found: bytes | None, name: str, most: int, file: str) -> None:
    """UserError where the file held another attachment of this name before something was added to it: readers of PDF may show either."""
    ends = [end.end() for end in END.finditer(content)][:-1]
    if len(ends) > MOST_REVISIONS:
        template = "The PDF was added to {count} times. Give the file as the program wrote it."
        raise refusal(template, file, count=len(ends))
    objects = 0
    for end in ends:
        try:
            with opened(content[:end]) as pdf:
                objects += len(pdf.objects)
                former = _found(pdf, name, most, file) if objects <= MOST_OBJECTS else None
        except MemoryError:
            raise
        except FAULTS:  # no end of a PDF: the letters stand in a stream
            continue
        if objects > MOST_OBJECTS:
            template = "The PDF had more than {most} objects in all, as it was added to {count} times. Give the file as the program wrote it."
            raise refusal(template, file, most=MOST_OBJECTS, count=len(ends))
        if former is not None and former != found:
            raise refusal(SEVERAL, file, count=2, name=name)


def _named(pdf: pikepdf.Pdf, name: str, file: str) -> Iterator[pikepdf.Stream]:
    """The attachments of a name, wherever the PDF has them: among its attachments, at an annotation, or as an associated file."""
    names = pdf.Root.get("/Names", pikepdf.Dictionary())
    specs = [spec for label, spec in _labelled(names.get("/EmbeddedFiles"), file) if _alike(label, name)]
    told = (part for each in pdf.objects if b"/EF" in each.unparse(resolved=True) for part in _dictionaries(each, 0))
    specs += [part for part in told if "/EF" in part and any(_alike(part.get(key, ""), name) for key in NAMES)]
    seen = set[tuple[int, int]]()
    for spec in specs:
        for stream in spec["/EF"].as_dict().values():
            if isinstance(stream, pikepdf.Stream) and stream.objgen not in seen:
                seen.add(stream.objgen)
                yield stream


def _labelled(tree: Any, file: str) -> list[tuple[Any, Any]]:
    """What a tree names; UserError for more than MOST_ATTACHED, which nodes that stand in it again and again name without an end."""
    nodes, found = [] if tree is None else [tree], list[tuple[Any, Any]]()
    for node in nodes:
        named = list(node.get("/Names", ()))
        found += zip(named[::2], named[1::2], strict=True)
        nodes.extend(node.get("/Kids", ()))
        if len(nodes) + len(found) > MOST_ATTACHED:
            template = "The PDF lists more than {most} attachments, or the same ones again and again. Give the file as the program wrote it."
            raise refusal(template, file, most=MOST_ATTACHED)
    return found


def _alike(label: object, name: str) -> bool:
    return str(label).strip().casefold() == name


def _dictionaries(part: Any, depth: int) -> Iterator[pikepdf.Dictionary | pikepdf.Stream]:
    """The dictionaries that stand in an object itself."""
    if depth and part.is_indirect if isinstance(part, pikepdf.Object) else True:
        return
    if isinstance(part, pikepdf.Dictionary | pikepdf.Stream):
        yield part
        inner = [part[key] for key in part.keys()]  # noqa: SIM118 a stream has no other way
    else:
        inner = list(part) if isinstance(part, pikepdf.Array) else []
    for each in inner if depth < DEEPEST else ():
        yield from _dictionaries(each, depth + 1)
