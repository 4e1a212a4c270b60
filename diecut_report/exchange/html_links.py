"""Reads the results that an HTML report carries, from the one link that the program writes; nothing of the page is run or fetched."""

from __future__ import annotations

import base64
import binascii
import re
import zlib

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase

LINK = re.compile(rb'download="results\.json\.gz" href="data:application/gzip;base64,([A-Za-z0-9+/]*={0,2})"')
GZIP = 16 + zlib.MAX_WBITS


def linked_results(content: bytes, most: int, file: str) -> bytes | None:
    """Return the results file in a page, None where it carries none; UserError where it carries two, or a damaged or too large one."""
    found = LINK.findall(content)
    if not found:
        return None
    if len(found) > 1:
        words = Phrase(
            "The page carries {count} results files, and a report has one. Give the file as the program wrote it.",
            count=len(found),
        )
        raise UserError(Problem(words, file))
    return _unpacked(found[0], most, file)


def _unpacked(text: bytes, most: int, file: str) -> bytes:
    unpacking = zlib.decompressobj(GZIP)
    try:
        content = unpacking.decompress(base64.b64decode(text, validate=True), most + 1)
    except (binascii.Error, zlib.error) as error:
        raise UserError(Problem(_damaged(), file)) from error
    if len(content) > most:
        words = Phrase(
            "What the page carries is too large: it unpacks to more than {most} MB.", most=format(most / 1000000.0, "g")
        )
        raise UserError(Problem(words, file))
    if not unpacking.eof or unpacking.unused_data:
        raise UserError(Problem(_damaged(), file))
    return content


def _damaged() -> str:
    return phrase("The results that the page carries are damaged. Give the file as the program wrote it.")
