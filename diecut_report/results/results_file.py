"""The results file: the one text of results that is written, attached and compared."""

from __future__ import annotations

import codecs
import json
from hashlib import sha256
from typing import Any

from diecut_report.results.model import CarriedConfigRecord, MaterialsFileRecord, ResultsRecord

ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)
LINES_TO_DEPTH = 4  # the results file has a line for each quantity and each curve


def results_text(results: ResultsRecord) -> str:
    """Return the results file: floats in their shortest exact form, never NaN or Infinity, the same bytes for the same results."""
    return _lines(results.data(), LINES_TO_DEPTH) + "\n"


def encoded(text: str) -> bytes:
    """Return the text as UTF-8; what a name of a file that is not UTF-8 has brought stands as an escape, which JSON has too."""
    return text.encode(errors="backslashreplace")


def source_content(file: CarriedConfigRecord | MaterialsFileRecord) -> bytes:
    """Return a configuration's or table's file, byte for byte; its byte order mark, which its text does not hold, shows in its hash."""
    content = encoded(file.source_text)
    marked = codecs.BOM_UTF8 + content
    return marked if sha256(marked).hexdigest() == file.sha256 else content


def _lines(data: Any, depth: int, indent: str = "\n") -> str:
    if depth == 0 or not isinstance(data, dict) or not data:
        return ENCODER.encode(data)
    parts = (
        f"{indent} {json.dumps(key, ensure_ascii=False)}: {_lines(part, depth - 1, indent + ' ')}"
        for key, part in data.items()
    )
    return "{" + ",".join(parts) + indent + "}"
