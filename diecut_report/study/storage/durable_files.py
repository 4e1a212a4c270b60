"""Files of a study's folder: written whole or not at all, and on the disk when the call returns."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from diecut_report.errors import Problem, UserError
from diecut_report.files import reason

FULL = {errno.ENOSPC: "the disk is full", errno.EDQUOT: "the quota of the disk is used up"}
TEMPORARY = ".*.part"  # what a killed run may leave behind


@contextmanager
def in_words(path: Path) -> Iterator[None]:
    """An OSError becomes a UserError that says what could not be written, why, and what to do."""
    try:
        yield
    except OSError as error:
        full = FULL.get(error.errno or 0)
        after = "What was finished is kept: make room, then continue with --resume."
        why = f"{full}. {after}" if full else reason(error)
        raise UserError(Problem(f"This cannot be written: {why}", str(path))) from error


@contextmanager
def replaced(path: Path) -> Iterator[Path]:
    """A temporary name beside ``path``; what was written there takes the place of ``path`` at the end, or is removed."""
    with in_words(path):
        temporary = path.with_name(f".{os.urandom(8).hex()}.part")
        try:
            yield temporary
            _sync(temporary)
            temporary.replace(path)
            _sync(path.parent)
        finally:
            temporary.unlink(missing_ok=True)


def write(path: Path, content: bytes | memoryview) -> None:
    """The content under this name: all of it or, after an error in words, what was there before."""
    with replaced(path) as temporary:
        temporary.write_bytes(content)


@contextmanager
def room(folder: Path) -> Iterator[None]:
    """Temporary files of libraries go into the folder, on whose disk room is wanted, and are removed at the end."""
    before = tempfile.tempdir
    with in_words(folder), tempfile.TemporaryDirectory(prefix=".", suffix=".part", dir=folder) as place:
        tempfile.tempdir = place
        try:
            yield
        finally:
            tempfile.tempdir = before


def remove_stale(folder: Path) -> None:
    """Remove what a run that was killed has left half-written, here and in the folders below."""
    for path in list(folder.rglob(TEMPORARY)):
        with in_words(path):
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink(missing_ok=True)  # it may have stood in a folder that is gone


def _sync(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
