"""Reads a file that is attached to a PDF, whoever made it: bounded, and without repairing what is damaged."""

from __future__ import annotations

import io
import json
import re
import resource
import subprocess
import sys
import zlib
from base64 import b64decode, b64encode
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any

import pikepdf
from pikepdf import settings

from diecut_report.errors import UserError, refusal
from diecut_report.text.phrases import Phrase, phrase

MOST_ITEMS = 1_000_000  # of an array or a dictionary
MOST_WARNINGS = 100
DEEPEST = 100
MOST_ATTACHED = 1000  # files, with the nodes of their tree
MOST_REVISIONS = 40
MOST_TO_OPEN = 48_000_000  # bytes that a stream unpacks to while a PDF is opened; the catalogue of a large report stands in one of 20 MB
SECONDS = 20  # of the processor, for reading a PDF in a process of its own: a large report takes 2
GIGABYTES = 4  # of memory there: a large report takes 0.4
OUT_OF_MEMORY = 12  # with what that process ends, as ENOMEM
APART = (
    "import sys; from diecut_report.exchange.pdf_attachments import print_attachments; print_attachments(*sys.argv[1:])"
)
ATTACHED = ("results.json", "config.yaml")
MOST_ROWS = 2_000_000  # of the table of objects, which the library that signs keeps: a large report has some 200 000
NAMES = ("/F", "/UF", "/DOS", "/Mac", "/Unix")  # of an attachment
END = re.compile(rb"startxref\s+\d+\s+%%EOF\s?\n?")
FAULTS = (
    pikepdf.PdfError, ValueError, TypeError, LookupError, AttributeError, NameError, ArithmeticError, RuntimeError, AssertionError, OSError,
    MemoryError, zlib.error,
)  # fmt: skip
"""What the library raises for a PDF that is not as the standard has it: it was damaged, or made to harm.

RuntimeError with recursion and what is not implemented, ArithmeticError with decimals, NameError with a variable that was never set."""
_bounds = {"most": 0}  # of the library, which has one for the whole process
SEVERAL = phrase(
    "The PDF carries {count} files named {name}, and a report has one. Give the file as the program wrote it."
)


Attachments = dict[str, bytes | None]
Fault = tuple[str, dict[str, str]]  # the template of a message, and its values
ENDLESS = phrase(
    "The PDF is not read within {seconds} s and {gigabytes} GB of memory. Give the file as the program wrote it."
)


def attachments(content: bytes, most: int, file: str) -> Attachments:
    """Return what a PDF carries of ATTACHED, None for what it does not; UserError where it cannot be read, or one is larger than ``most``.

    Whatever a few bytes make the library unpack or walk through cannot be interrupted, so a process of its own, which the system can
    end, reads it.
    """
    found, fault, _ = _read_apart(content, most)
    if fault is not None:
        raise refusal(fault[0], file, **fault[1])
    return found


def damage(content: bytes, most: int) -> str:
    """Return why a library that reads without bounds may not read a PDF; "" where it may. ``most`` is that of ``attachments``."""
    _, fault, is_damaged = _read_apart(content, most)
    if not is_damaged:
        return ""
    template = "its table of objects is damaged, or has more than {most} rows"
    return Phrase(*fault) if fault else Phrase(template, most=MOST_ROWS)


@lru_cache(maxsize=2)  # a report, and the one before it
def _read_apart(content: bytes, most: int) -> tuple[Attachments, Fault | None, bool]:
    """The attachments, what is wrong with the PDF, and whether its table of objects is damaged."""
    limits = [str(each) for each in (most, SECONDS, GIGABYTES)]
    read = subprocess.run([sys.executable, "-P", "-c", APART, *limits], input=content, capture_output=True, check=False)
    if read.returncode < 0 or read.returncode == OUT_OF_MEMORY:  # else the system has ended it
        return {}, (ENDLESS, {"seconds": f"{SECONDS}", "gigabytes": f"{GIGABYTES}"}), True
    if read.returncode:
        raise ChildProcessError(read.stderr.decode(errors="replace").strip().rpartition("\n")[2])
    found, fault, is_damaged = json.loads(read.stdout)
    return {name: each if each is None else b64decode(each) for name, each in found.items()}, fault, is_damaged


def print_attachments(most: str, seconds: str, gigabytes: str) -> None:
    """Read the PDF on the standard input within limits, and print its attachments as JSON, or what is wrong with it."""
    for resource_kind, limit in ((resource.RLIMIT_CPU, int(seconds)), (resource.RLIMIT_AS, int(gigabytes) << 30)):
        hard = resource.getrlimit(resource_kind)[1]
        resource.setrlimit(resource_kind, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))
    try:
        found, fault, is_damaged = _attachments(sys.stdin.buffer.read(), int(most))
    except MemoryError:
        sys.exit(OUT_OF_MEMORY)
    packed = {name: each if each is None else b64encode(each).decode() for name, each in found.items()}
    sys.stdout.write(json.dumps((packed, fault and (fault.template, fault.values), is_damaged)))


def _attachments(content: bytes, most: int) -> tuple[Attachments, Phrase | None, bool]:
    """What ``_read_apart`` tells."""
    bounded(most)
    found, is_damaged = Attachments(), False
    fault: str | None = None
    try:
        with opened(content) as pdf:
            is_damaged = int(pdf.trailer.Size) > MOST_ROWS or bool(pdf.get_warnings())
            found = _found(pdf, most)
        _refuse_former(content, found, most)
    except MemoryError:
        raise
    except UserError as error:
        fault = error.problems[0].message
    except pikepdf.PasswordError:
        fault, is_damaged = Phrase("The PDF is encrypted, and opens only with a password. Give one without."), True
    except FAULTS:
        template = (
            "The PDF is damaged, or holds more than {most} MB in one piece. Give the file as the program wrote it."
        )
        fault, is_damaged = Phrase(template, most=f"{most / 1e6:g}"), True
    assert fault is None or isinstance(fault, Phrase), "what refuses has a template"
    return found, fault, is_damaged


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


def _found(pdf: pikepdf.Pdf, most: int) -> Attachments:
    # the names only tell which attachment it is; nothing is written under them
    return {name: _content(streams, name, most) for name, streams in _named(pdf).items()}


def _content(streams: Mapping[tuple[int, int], pikepdf.Stream], name: str, most: int) -> bytes | None:
    if len(streams) > 1:
        raise refusal(SEVERAL, count=len(streams), name=name)
    content = next((bytes(each.read_bytes()) for each in streams.values()), None)
    if content is not None and len(content) > most:
        template = "What is attached is too large: {count} MB; at most {most} MB are taken."
        raise refusal(template, count=f"{len(content) / 1e6:.1f}", most=f"{most / 1e6:g}")
    return content


def _refuse_former(content: bytes, found: Attachments, most: int) -> None:
    """UserError where the file held another attachment of a name before something was added to it: readers of PDF may show either."""
    ends = [end.end() for end in END.finditer(content)][:-1]
    if len(ends) > MOST_REVISIONS:
        template = "The PDF was added to {count} times. Give the file as the program wrote it."
        raise refusal(template, count=len(ends))
    for end in ends:
        try:
            with opened(content[:end]) as pdf:
                former = _found(pdf, most)
        except MemoryError:
            raise
        except FAULTS:  # no end of a PDF: the letters stand in a stream
            continue
        for name, each in former.items():
            if each is not None and each != found[name]:
                raise refusal(SEVERAL, count=2, name=name)


def _named(pdf: pikepdf.Pdf) -> dict[str, dict[tuple[int, int], pikepdf.Stream]]:
    """The attachments of each name, wherever the PDF has them: among its attachments, at an annotation, or as an associated file."""
    names = pdf.Root.get("/Names", pikepdf.Dictionary())
    specs = [(str(label), spec) for label, spec in _labelled(names.get("/EmbeddedFiles"))]
    risky = (part for each in pdf.objects if b"/EF" in each.unparse(resolved=True) for part in _dictionaries(each, 0))
    specs += [(str(part.get(key, "")), part) for part in risky if "/EF" in part for key in NAMES]
    found: dict[str, dict[tuple[int, int], pikepdf.Stream]] = {name: {} for name in ATTACHED}
    for label, spec in specs:
        if (streams := found.get(label.strip().casefold())) is not None:
            for stream in spec["/EF"].as_dict().values():
                if isinstance(stream, pikepdf.Stream):
                    streams.setdefault(stream.objgen, stream)
    return found


def _labelled(tree: Any) -> list[tuple[Any, Any]]:
    """What a tree names; UserError for more than MOST_ATTACHED, which nodes that stand in it again and again name without an end."""
    nodes, found = [] if tree is None else [tree], list[tuple[Any, Any]]()
    for node in nodes:
        named = list(node.get("/Names", ()))
        found += zip(named[::2], named[1::2], strict=True)
        nodes.extend(node.get("/Kids", ()))
        if len(nodes) + len(found) > MOST_ATTACHED:
            template = "The PDF lists more than {most} attachments, or the same ones again and again. Give the file as the program wrote it."
            raise refusal(template, most=MOST_ATTACHED)
    return found


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
