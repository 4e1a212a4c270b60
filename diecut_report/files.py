"""Writes files so that none is ever half-written: all are complete beside their places before the first takes its place."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

from diecut_report.errors import Problem, UserError


def write_all(files: Mapping[Path, bytes], keep: Path) -> None:
    """Write all files, or none and raise UserError in words; folders that are missing are made.

    ``keep`` is a file that must not be written over: the config itself.
    """
    with ExitStack() as stack:
        ready = []
        for path, content in files.items():
            with _in_words(path):
                place = path.resolve()
                _refuse_config(path, keep)
                ready.append((stack.enter_context(_beside(place, content)), place, path))
        for temporary, place, path in ready:
            with _in_words(path):
                if temporary == place:
                    temporary.write_bytes(files[path])
                else:
                    temporary.replace(place)


def _refuse_config(path: Path, keep: Path) -> None:
    if path.exists() and path.samefile(keep):
        words = "This is the configuration itself; it would be written over. Choose another place with -o."
        raise UserError(Problem(words, str(path)))


@contextmanager
def _beside(place: Path, content: bytes) -> Iterator[Path]:
    """The content in a temporary file beside ``place``; gone on leaving, with the folders made for it if nothing is in them.

    What is no regular file (/dev/null, a pipe) stands for itself.
    """
    made: list[Path] = []
    temporary = place
    try:
        _make_folder(place.parent, made)
        if place.is_dir():
            raise IsADirectoryError(errno.EISDIR, "a folder has this name")
        if place.is_file() or not place.exists():
            temporary = place.with_name(f".{os.urandom(8).hex()}.part")
            temporary.write_bytes(content)
        yield temporary
    finally:
        if temporary != place:
            temporary.unlink(missing_ok=True)
        for folder in reversed(made):
            if not any(folder.iterdir()):
                folder.rmdir()


def _make_folder(folder: Path, made: list[Path]) -> None:
    if folder.is_dir():
        return
    _make_folder(folder.parent, made)
    folder.mkdir(exist_ok=True)
    made.append(folder)


@contextmanager
def _in_words(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise UserError(Problem(f"This cannot be written: {reason(error)}", str(path))) from error


def reason(error: OSError) -> str:
    """Why a file cannot be written, and what to do."""
    elsewhere = "Choose another place with -o."
    no_room = "Nothing was written; make room and try again."
    reasons = {
        errno.ENOSPC: f"the disk is full. {no_room}",
        errno.EDQUOT: f"the quota of the disk is used up. {no_room}",
        errno.EACCES: f"writing is not permitted there. {elsewhere}",
        errno.EPERM: f"writing is not permitted there. {elsewhere}",
        errno.EROFS: f"the disk can only be read. {elsewhere}",
        errno.ENOTDIR: f"a part of the path is a file, not a folder. {elsewhere}",
        errno.EEXIST: f"a part of the path is a file, not a folder. {elsewhere}",
        errno.EISDIR: f"a folder has this name. {elsewhere}",
        errno.ENAMETOOLONG: "the name is too long. Choose a shorter one.",
    }
    return reasons.get(error.errno or 0, f"{error.strerror or error}. {elsewhere}")
