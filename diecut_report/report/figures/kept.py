"""Figures that were drawn before: by the hash of all that they are drawn of, in the user's folder for what can be made again."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path

import matplotlib as mpl
from pydantic import TypeAdapter

from diecut_report.files import cache_folder, code_below
from diecut_report.report.figures.style import FONTS, Svg
from diecut_report.report.symbols import font_file

PACKAGE = Path(__file__).parents[2]
MAX_KEPT = 2000  # figures, some 100 MB; of more the half that was written first is removed
FORM = TypeAdapter(Svg)


def kept(drawn_of: object, draw: Callable[[], Svg]) -> Svg:
    """Return the figure that was drawn of the same data, by the same code, before; else draw it, and keep it where that is possible.

    ``drawn_of`` is all that ``draw`` follows from, records whose representation tells all that they hold.
    """
    folder = _folder()
    if folder is None:
        return draw()
    file = folder / f"{sha256(f'{_code()} {drawn_of!r}'.encode()).hexdigest()}.json"
    with suppress(OSError, ValueError):  # not there, or not whole
        return FORM.validate_json(file.read_bytes(), strict=True)
    made = draw()
    with suppress(OSError):
        file.write_bytes(FORM.dump_json(made))
    return made


def _folder() -> Path | None:
    """The folder of kept figures; None where others may write into it, as what stands there becomes part of pages."""
    folder = cache_folder("figures")
    if folder is None or not hasattr(os, "getuid"):
        return None
    with suppress(OSError):
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        found = folder.stat()
        return folder if found.st_uid == os.getuid() and not found.st_mode & 0o022 else None
    return None


def make_room() -> None:
    """Remove the figures that were written first, where too many are kept."""
    folder = _folder()
    with suppress(OSError):
        files = sorted(folder.glob("*.json"), key=lambda file: file.stat().st_mtime) if folder else []
        for file in files[: len(files) // 2] if len(files) > MAX_KEPT else []:
            file.unlink(missing_ok=True)


@cache
def _code() -> str:
    """The hash of the program's code and of the fonts, by which figures are drawn."""
    found = sha256(mpl.__version__.encode())
    files = sorted(Path(path) for _, path in code_below(str(PACKAGE)))
    for file in (*files, *map(font_file, FONTS)):
        found.update(file.read_bytes())
    return found.hexdigest()
