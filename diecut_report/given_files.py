"""Reads files that a user gives: regular ones only, and of each no more than is bearable.

A pipe would be waited for without end, and a device such as /dev/zero has no end; neither is opened.
"""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path
from typing import NoReturn

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase

KINDS = {
    stat.S_IFREG: "a file",
    stat.S_IFDIR: "a folder",
    stat.S_IFLNK: "a link",
    stat.S_IFIFO: phrase("a pipe and no regular file"),
    stat.S_IFCHR: phrase("a device and no regular file"),
    stat.S_IFBLK: phrase("a device and no regular file"),
    stat.S_IFSOCK: phrase("a socket and no regular file"),
}


def content(path: Path, most: int, wanted: str) -> bytes:
    """Return what a regular file holds; UserError where it is none, is larger than ``most`` bytes, or cannot be read.

    ``wanted`` says what to give instead: "a YAML file".
    """
    with opened(path, most, wanted) as file, _in_words(path):
        found = file.read(most + 1)  # bounded too: a file may grow, and some of the system's state no size
    if len(found) > most:
        _refuse_size(path, len(found), most)
    return found


def standard_input(most: int, name: str) -> bytes:
    """Return what standard input gives until its end; UserError where that is more than ``most`` bytes, or where it is closed.

    ``name`` is what messages call it.
    """
    if sys.stdin is None:
        raise UserError(Problem(phrase("Standard input is closed. Name a file."), name))
    try:
        found = sys.stdin.buffer.read(most + 1)
    except (OSError, ValueError) as error:
        words = Phrase(
            "Standard input cannot be read: {told}. Name a file.", told=getattr(error, "strerror", None) or error
        )
        raise UserError(Problem(words, name)) from error
    if len(found) > most:
        words = Phrase(
            "Standard input holds more than {most} MB, which is the most that is read.", most=f"{most / 1e6:g}"
        )
        raise UserError(Problem(words, name))
    return found


@contextmanager
def opened(path: Path, most: int, wanted: str) -> Iterator[BufferedReader]:
    """Give a regular file, open for reading; UserError where it is none, is larger than ``most`` bytes, or cannot be opened."""
    with _in_words(path):
        _judge(path, path.stat(), most, wanted)
        # it may have been exchanged for a pipe since: that is not waited for, and is judged again
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    with os.fdopen(descriptor, "rb") as file:
        _judge(path, os.fstat(descriptor), most, wanted)
        yield file


def refuse_special(paths: Iterable[Path], words: str, *, folders: bool = False) -> None:
    """Refuse what is there by these names but is no regular file (or, with ``folders``, no folder), with what to do about it."""
    wanted = stat.S_IFDIR if folders else stat.S_IFREG
    problems = []
    for path in paths:
        if not os.path.lexists(path):
            continue
        with _in_words(path):
            mode = path.lstat().st_mode
        if stat.S_IFMT(mode) != wanted:
            problems.append(Problem(Phrase("This is {kind}. {words}", kind=_kind(mode), words=words), str(path)))
    if problems:
        raise UserError(problems)


def refuse_unreadable_name(folder: Path) -> None:
    """Refuse a folder whose name is no UTF-8: Parquet files in it cannot be named."""
    try:
        str(folder.absolute()).encode()
    except UnicodeEncodeError as error:
        words = phrase("The name of this folder, or of one above it, is not UTF-8. Choose another one.")
        raise UserError(Problem(words, str(folder))) from error


def _judge(path: Path, status: os.stat_result, most: int, wanted: str) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise UserError(
            Problem(Phrase("This is {kind}. Give {wanted}.", kind=_kind(status.st_mode), wanted=wanted), str(path))
        )
    if status.st_size > most:
        _refuse_size(path, status.st_size, most)


def _kind(mode: int) -> str:
    return KINDS.get(stat.S_IFMT(mode), phrase("no regular file"))


def _refuse_size(path: Path, size: int, most: int) -> NoReturn:
    words = Phrase(
        "The file is too large: {size} MB; at most {most} MB are allowed.",
        size=f"{size / 1e6:.1f}",
        most=f"{most / 1e6:g}",
    )
    raise UserError(Problem(words, str(path)))


@contextmanager
def _in_words(path: Path) -> Iterator[None]:
    try:
        yield
    except FileNotFoundError as error:
        raise UserError(Problem(phrase("There is no such file. Check the name and the folder."), str(path))) from error
    except (OSError, ValueError) as error:  # a name with a zero byte is a ValueError
        told = getattr(error, "strerror", None) or error
        words = Phrase("The file cannot be read: {told}. Check its name and its permissions.", told=told)
        raise UserError(Problem(words, str(path))) from error
