"""Writes files so that none is ever half-written: each is complete beside its place before it takes that place.

A link by that name is replaced, not what it points to. A file that is replaced keeps its mode, owner and attributes. One that was read and is
rewritten (`write` with ``instead_of``) keeps all its names (hard links); an output leaves what has another name as it is.
`write_all` writes the files of a run, all or none; `write` and `replaced` a file of a study's folder, on the disk when they return.
"""

from __future__ import annotations

import errno
import hashlib
import os
import re
import shutil
import signal
import stat
import sys
import tempfile
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from io import BufferedReader
from pathlib import Path
from typing import NoReturn

from diecut_report.errors import Problem, Unwritable, UserError, refusal
from diecut_report.text.phrases import Phrase, phrase

_OPEN = re.compile(r"/proc/(self|thread-self|\d+)(/task/\d+)?/fd")
TEMPORARY = ".*.part"  # what a killed run may leave behind
NOTHING = phrase("Nothing was written; free disk space and try again.")
KEPT = phrase("Finished parts are kept: free disk space, then continue with --resume.")
STORED = ("study.json", "study.yaml", "base.yaml", "tables", "variants")  # in the folder of a study

MISNAMED = {
    errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOTDIR, errno.EEXIST, errno.EISDIR, errno.ENAMETOOLONG, errno.ENOENT, errno.ELOOP,
}  # fmt: skip
"""Faults of the name that was given: another one helps. The others are faults of the disk."""


def write_all(files: Mapping[Path, bytes], keep: Path | Iterable[Path] | None, *, through: bool = False) -> None:
    """Write all files, or none and raise UserError in words; folders that are missing are made.

    ``keep`` is what must not be written over: the files that were given. With ``through`` a device or a pipe that the user
    names is written into; else it is replaced, as a link always is.
    """
    kept = [keep] if isinstance(keep, Path) else [*(keep or ())]
    with _ended_by_system(), ExitStack() as stack:
        ready = []
        for path, content in files.items():
            with in_words(path, NOTHING):
                place = _place(path)
                if path.exists() and any(given.exists() and path.samefile(given) for given in kept):
                    raise refusal("This file was given and would be overwritten. Choose another place with -o.", path)
                _refuse_stored(place)
                _refuse_signed(place, content)
                ready.append((stack.enter_context(_beside(place, content, through)), place, path))
        for temporary, place, path in ready:
            with in_words(path, NOTHING):
                if temporary == place:
                    temporary.write_bytes(files[path])
                else:
                    _take_place(temporary, place)


@contextmanager
def _ended_by_system() -> Iterator[None]:
    """Let the system (SIGTERM) end what runs within as Ctrl-C does, so that no temporary file stays; who has a way of his own keeps it."""
    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:
        yield
        return
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _place(path: Path) -> Path:
    """Where a file is written: the path itself with its folder resolved, so that a link there is replaced."""
    folder = path if path.name in ("", "..") else path.parent
    return Path(os.path.realpath(folder)) / (path.name if folder != path else "")


def _is_stream(place: Path) -> bool:
    """Whether it, or where its links lead, stands for itself: a device, a pipe, or a file that is open already (/dev/stdout, /dev/fd/3)."""
    if not place.exists():
        return False
    while not (opened := _OPEN.fullmatch(str(place.parent))) and place.is_symlink():
        place = _place(place.parent / place.readlink())
    return opened is not None or not (place.is_file() or place.is_dir())


def _refuse_stored(place: Path) -> None:
    """Refuse what a study has stored: its results follow from it, and are lost where it is written over."""
    for folder in place.parents:
        inner = place.relative_to(folder).parts[0]
        if inner in STORED and (folder / "variants").is_dir() and (folder / "study.json").is_file():
            template = (
                "This belongs to the stored results of a study, which would be damaged. Choose another place with -o."
            )
            raise refusal(template, place)


def _refuse_signed(place: Path, content: bytes) -> None:
    """Refuse a PDF that somebody has signed, unless it stays in what is written, as where somebody else signs it too."""
    if not place.is_file() or place.suffix.lower() != ".pdf":
        return
    before = place.read_bytes()
    if before.startswith(b"%PDF-") and b"/ByteRange" in before and not content.startswith(before):
        template = "This report is signed, and would be lost. Choose another place with -o, or move it away."
        raise refusal(template, place)


@contextmanager
def _beside(place: Path, content: bytes, through: bool) -> Iterator[Path]:
    """The content in a temporary file beside ``place``; gone on leaving, with the folders made for it if nothing is in them.

    With ``through``, what is not a regular file (/dev/null, a pipe) stands for itself.
    """
    made: list[Path] = []
    temporary = place
    try:
        _make_folder(place.parent, made)
        if place.is_dir():
            raise IsADirectoryError(errno.EISDIR, phrase("a folder has this name"))
        if not (through and _is_stream(place)):
            temporary = _temporary(place)
            _make(temporary, place)
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


def _take_place(temporary: Path, place: Path, *, under_all_names: bool = False) -> None:
    """Let a complete file take the place of another one, with its mode, owner and attributes."""
    try:
        before = place.lstat()
    except FileNotFoundError:
        temporary.replace(place)
        return
    is_file = stat.S_ISREG(before.st_mode)
    if is_file and under_all_names and before.st_nlink > 1:
        _write_over(place, temporary.read_bytes())
        return
    if is_file:
        _give(temporary, before.st_uid, before.st_gid)
        _give_attributes(temporary, place)
        temporary.chmod(stat.S_IMODE(before.st_mode) & 0o777)
    temporary.replace(place)


def _write_over(place: Path, content: bytes) -> None:
    """Write into a file itself, whose other names then hold it too. It has the room before anything in it changes."""
    with place.open("r+b") as file:
        before = os.fstat(file.fileno()).st_size
        try:
            if sys.platform == "linux":  # elsewhere there is no such call
                os.posix_fallocate(file.fileno(), 0, max(len(content), 1))
        except OSError:
            file.truncate(before)
            raise
        file.write(content)
        file.truncate()
        file.flush()
        os.fsync(file.fileno())


def _give(file: Path, user: int, group: int) -> None:
    """Give a file to its owner where that may be, else to the group: colleagues who share it would lose it."""
    for owner in (user, -1):  # only root gives a file away
        with suppress(PermissionError):
            os.chown(file, owner, group)
            return


def _give_attributes(file: Path, place: Path) -> None:
    """Give a file the access list and the user's attributes of the one in whose place it comes, and none that the folder has given it."""
    if sys.platform != "linux":  # elsewhere Python does not know them
        return
    kept, given = _attributes(place), _attributes(file)
    for name in given.keys() - kept.keys():
        os.removexattr(file, name)
    for name, value in kept.items():
        os.setxattr(file, name, value)


def _attributes(file: Path) -> dict[str, bytes]:
    try:
        names = [name for name in os.listxattr(file) if name.startswith(("user.", "system.posix_acl_access"))]
        return {name: os.getxattr(file, name) for name in names}
    except OSError:  # a disk without them, or a file that may not be read
        return {}


def _temporary(place: Path) -> Path:
    return place.with_name(f".{os.urandom(8).hex()}.part")


def _make(temporary: Path, place: Path) -> None:
    """Make an empty file beside ``place``; where that is there, it may be one that not everybody reads."""
    is_file = place.exists() and not place.is_symlink()  # which hands its mode on, as a link does not
    temporary.touch(0o600 if is_file else 0o666, exist_ok=False)


@contextmanager
def in_words(path: Path, after: str = KEPT) -> Iterator[None]:
    """Turn an OSError into a UserError, or Unwritable, that says what could not be written, why, and what to do."""
    try:
        yield
    except OSError as error:
        kind = UserError if error.errno in MISNAMED else Unwritable
        template = "This cannot be written: {reason}"
        raise kind(Problem(Phrase(template, reason=reason(error, after)), str(path))) from error


def reason(error: OSError, after: str = NOTHING) -> str:
    """Return why a file cannot be written, and what to do; ``after`` is that on a full disk."""
    elsewhere = phrase("Choose another place with -o.")
    denied = Phrase("writing is not permitted there. {elsewhere}", elsewhere=elsewhere)
    within_file = Phrase("a part of the path is a file, not a folder. {elsewhere}", elsewhere=elsewhere)
    reasons = {
        errno.ENOSPC: Phrase("the disk is full. {after}", after=after),
        errno.EDQUOT: Phrase("the disk quota is exhausted. {after}", after=after),
        errno.EACCES: denied,
        errno.EPERM: denied,
        errno.EROFS: Phrase("the disk is read-only. {elsewhere}", elsewhere=elsewhere),
        errno.ENOTDIR: within_file,
        errno.EEXIST: within_file,
        errno.EISDIR: Phrase("a folder has this name. {elsewhere}", elsewhere=elsewhere),
        errno.ENAMETOOLONG: phrase("the name is too long. Choose a shorter one."),
    }
    return reasons.get(error.errno or 0, f"{error.strerror or error}. {elsewhere}")


def cache_folder(name: str) -> Path | None:
    """Return the user's folder for what can be made again, of this name; None where the user has no home."""
    given = Path(os.environ.get("XDG_CACHE_HOME", ""))  # by its specification a relative one does not count
    try:
        home = given if given.is_absolute() else Path.home() / ".cache"
    except RuntimeError:  # there is no home
        return None
    return home / "diecut-report" / name


# --- files of a study's folder -----------------------------------------------------------------------------------------


@contextmanager
def replaced(path: Path, *, instead_of: str | None = None) -> Iterator[Path]:
    """Give a temporary name beside ``path``; what was written there takes the place of ``path`` at the end, or is removed.

    ``instead_of`` as in `write`.
    """
    with _ended_by_system(), in_words(path, KEPT if instead_of is None else NOTHING):
        temporary = _temporary(path)
        try:  # from before it is there: a Ctrl-C comes at any time
            _make(temporary, path)
            yield temporary
            _sync(temporary)
            if instead_of is not None:
                _require_same(path, instead_of)
            _take_place(temporary, path, under_all_names=instead_of is not None)
            _sync(path.parent)
        finally:
            temporary.unlink(missing_ok=True)


def _require_same(path: Path, sha256: str) -> None:
    with suppress(FileNotFoundError):
        if hashlib.sha256(path.read_bytes()).hexdigest() == sha256:
            return
    template = "Another program has saved this file meanwhile. Nothing was written; look at it and write again."
    raise refusal(template, path)


def write(path: Path, content: bytes | memoryview, *, instead_of: str | None = None) -> None:
    """Write the content under this name: all of it or, after an error in words, what was there before stays.

    ``instead_of`` is the SHA-256 of what it is to replace: UserError, and nothing is written, where another program has saved the file since.
    """
    with replaced(path, instead_of=instead_of) as temporary:
        temporary.write_bytes(content)


@contextmanager
def room(folder: Path | None = None) -> Iterator[None]:
    """Let temporary files of libraries go into the folder, on whose disk room is wanted; they are removed at the end.

    Without a folder they go where temporary files go.
    """
    nothing = phrase("Nothing was written; free disk space, or name another folder in the variable TMPDIR.")
    after, folder = KEPT if folder else nothing, folder or _for_temporary_files()
    before = tempfile.tempdir
    with (
        _ended_by_system(),
        in_words(folder, after),
        tempfile.TemporaryDirectory(prefix=".", suffix=".part", dir=folder) as place,
    ):
        tempfile.tempdir = place
        try:
            yield
        finally:
            tempfile.tempdir = before


def _for_temporary_files() -> Path:
    try:
        return Path(tempfile.gettempdir())
    except OSError as error:  # none of those that the system names can be written
        template = (
            "No folder for temporary files has enough free space. Free some, or name a folder in the variable TMPDIR."
        )
        raise Unwritable(Problem(phrase(template))) from error


def remove_stale(folder: Path) -> None:
    """Remove what a run that was killed has left half-written, here and in the folders below."""
    for path in list(folder.rglob(TEMPORARY)):
        with in_words(path):
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            else:
                path.unlink(missing_ok=True)  # it may have stood in a folder that is gone


def _sync(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


# Reads files that a user gives: regular ones only, and of each no more than is bearable.
#
# A pipe would be waited for without end, and a device such as /dev/zero has no end; neither is opened.


KINDS = {
    stat.S_IFREG: phrase("a file"), stat.S_IFDIR: phrase("a folder"), stat.S_IFLNK: phrase("a link"),
    stat.S_IFIFO: phrase("a pipe and no regular file"), stat.S_IFCHR: phrase("a device and no regular file"),
    stat.S_IFBLK: phrase("a device and no regular file"), stat.S_IFSOCK: phrase("a socket and no regular file"),
}  # fmt: skip


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
        raise refusal("Standard input is closed. Name a file.", name)
    try:
        found = sys.stdin.buffer.read(most + 1)
    except (OSError, ValueError) as error:
        template = "Standard input cannot be read: {told}. Name a file."
        raise refusal(template, name, told=getattr(error, "strerror", None) or error) from error
    if len(found) > most:
        template = "Standard input holds more than {most} MB, which is the most that is read."
        raise refusal(template, name, most=f"{most / 1e6:g}")
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
        template = "The name of this folder, or of one above it, is not UTF-8. Choose another one."
        raise refusal(template, folder) from error


def _judge(path: Path, status: os.stat_result, most: int, wanted: str) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise refusal("This is {kind}. Give {wanted}.", path, kind=_kind(status.st_mode), wanted=wanted)
    if status.st_size > most:
        _refuse_size(path, status.st_size, most)


def _kind(mode: int) -> str:
    return KINDS.get(stat.S_IFMT(mode), phrase("no regular file"))


def _refuse_size(path: Path, size: int, most: int) -> NoReturn:
    template = "The file is too large: {size} MB; at most {most} MB are allowed."
    raise refusal(template, path, size=f"{size / 1e6:.1f}", most=f"{most / 1e6:g}")


@contextmanager
def _in_words(path: Path) -> Iterator[None]:
    try:
        yield
    except FileNotFoundError as error:
        raise refusal("There is no such file. Check the name and the folder.", path) from error
    except (OSError, ValueError) as error:  # a name with a zero byte is a ValueError
        told = getattr(error, "strerror", None) or error
        template = "The file cannot be read: {told}. Check its name and its permissions."
        raise refusal(template, path, told=told) from error


# Which files the code of a plugin or of the program is: its modules and its tables.


DATA = (".json", ".yaml", ".yml", ".csv")  # tables
CODE = (".py", *DATA)


def code_of(module: Path) -> Iterator[tuple[str, str]]:
    """Give the files of a module by their names: a package with all in it, a single file with the tables beside it that it names."""
    if module.name == "__init__.py":
        yield from code_below(str(module.parent))
        return
    yield "module", str(module)
    text = module.read_text("utf-8", "replace")
    tables = (path for path in module.parent.iterdir() if path.suffix in DATA and path.name in text and path.is_file())
    yield from ((path.name, str(path)) for path in tables)


def code_below(folder: str, name: str = "", without: Sequence[str] = ()) -> Iterator[tuple[str, str]]:
    """Give the code and the tables below a folder, by their names in it; what is hidden or compiled is none."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.startswith("."):
                continue
            if entry.name.endswith(CODE) and entry.is_file():  # a pipe would be waited for
                yield name + entry.name, entry.path
            elif entry.is_dir(follow_symlinks=False) and entry.name not in ("__pycache__", *without):
                yield from code_below(entry.path, f"{name}{entry.name}/")
