"""Libraries imported apart from what surrounds the program: what lies in the current folder or is set for a notebook is not theirs.

Matplotlib reads its settings while it is imported, those of the current folder first; a setting may start LaTeX, or make other
figures. WeasyPrint's search for its libraries starts a compiler where a name is not found at once.
"""

from __future__ import annotations

import ctypes.util
import logging
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path


@contextmanager
def settings_of_its_own() -> Iterator[None]:
    """Import Matplotlib with nothing but the settings that it comes with, and without a screen.

    It looks for a ``matplotlibrc`` in the current folder before all others, so that is the folder of its own meanwhile. Where it cannot write
    into the user's folders, it would tell that at each start, and leave one among the temporary files: the command line ends without its help.
    """
    spec = find_spec("matplotlib")
    assert spec is not None and spec.submodule_search_locations
    own = Path(spec.submodule_search_locations[0]) / "mpl-data"
    before = {name: os.environ.get(name) for name in ("MPLBACKEND", "MPLCONFIGDIR")}
    logger = logging.getLogger("matplotlib")
    level = logger.level
    os.environ["MPLBACKEND"] = "agg"
    logger.setLevel(logging.ERROR)
    try:
        with _inside(own), _without_temporary_files():
            yield
    finally:
        logger.setLevel(level)
        for name, value in before.items():
            os.environ.pop(name, None)
            os.environ |= {} if value is None else {name: value}


@contextmanager
def _without_temporary_files() -> Iterator[None]:
    """Remove at the end what is put among the temporary files meanwhile."""
    before = tempfile.tempdir
    with tempfile.TemporaryDirectory(prefix="diecut-report-") as folder:
        tempfile.tempdir = folder
        try:
            yield
        finally:
            tempfile.tempdir = before


@contextmanager
def _inside(folder: Path) -> Iterator[None]:
    """Make a folder the current one; the one before may have been deleted, or be closed to reading."""
    before = os.open(".", getattr(os, "O_PATH", os.O_RDONLY))
    try:
        os.chdir(folder)
        yield
    finally:
        os.fchdir(before)
        os.close(before)


@contextmanager
def no_compiler() -> Iterator[None]:
    """Import what loads system libraries without the search by ``gcc`` and ``ld``.

    On Linux the loader finds a library by its file name, which is among the names that are tried; elsewhere no compiler is asked.
    """
    search = ctypes.util.find_library
    if sys.platform == "linux":
        ctypes.util.find_library = _not_searched
    try:
        yield
    finally:
        ctypes.util.find_library = search


def _not_searched(name: str) -> str | None:
    return None
