"""What is told of a plugin of one file that imports another file of its folder, which it cannot."""

from __future__ import annotations

import re
from pathlib import Path

from diecut_report.languages.phrases import Phrase

RELATIVE = re.compile("relative import")


def beside(file: Path, cause: BaseException) -> str:
    """Return in words what to do where the cause is such an import; empty for other causes."""
    if not isinstance(cause, ImportError) or file.name == "__init__.py":
        return ""
    asked = RELATIVE.search(str(cause.msg)) is not None
    if not asked and not (cause.name and file.with_name(f"{cause.name.partition('.')[0]}.py").is_file()):
        return ""
    words = (
        "; a plugin of one file cannot import what lies beside it: make a folder {name}/ of it, with {file} as its __init__.py, "
        "and import from there, as in from ._helpers import …"
    )
    return Phrase(words, name=file.stem, file=file.name)
