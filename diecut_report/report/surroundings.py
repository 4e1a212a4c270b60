"""Libraries imported apart from what surrounds the program: what lies in the current folder or is set for a notebook is not theirs.

Matplotlib reads its settings while it is imported, those of the current folder first; a setting may start LaTeX, or make other
figures. WeasyPrint's search for its libraries starts a compiler where a name is not found at once.
"""

from __future__ import annotations

import ctypes.util
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path


@contextmanager
def settings_of_its_own() -> Iterator[None]:
    """Import Matplotlib with nothing but the settings that it comes with, and without a screen.

    It looks for a ``matplotlibrc`` in the current folder before all others, so that is the folder of its own meanwhile.
    """
    spec = find_spec("matplotlib")
    assert spec is not None and spec.submodule_search_locations
    own = Path(spec.submodule_search_locations[0]) / "mpl-data"
    asked = os.environ.get("MPLBACKEND")
    os.environ["MPLBACKEND"] = "agg"
    try:
        with _inside(own):
            yield
    finally:
        del os.environ["MPLBACKEND"]
        if asked is not None:
            os.environ["MPLBACKEND"] = asked


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
