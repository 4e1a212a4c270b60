"""study.json, the copies of the study's files, and the lock of the folder that a run writes into."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from hashlib import sha256
from pathlib import Path, PurePath
from typing import Any

from filelock import FileLock, Timeout

from diecut_report.errors import Problem, UserError
from diecut_report.files import in_words, write
from diecut_report.given_files import content, refuse_unreadable_name
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.storage.description import (
    Data,
    Description,
    StudySource,
    as_data,
    changes,
    from_data,
    libraries,
)
from diecut_report.study.storage.state_form import MEND, check_form, continuing

STATE, STUDY, BASE, TABLES = "study.json", "study.yaml", "base.yaml", "tables"
MAX_STATE = 100_000_000  # bytes of study.json; ten thousand columns take some two million
LOCK, HOLDER = ".lock", ".lock.json"
SEAL = "seal"


def read_state(folder: Path, *, sealed: bool = True) -> Data:
    """Return study.json of the folder; UserError where there is none, or where it is not what the program has written.

    Without ``sealed`` a file that a hand has changed is read too, as far as each key is possible: for a run that writes
    anew what follows from the study.
    """
    path = folder / STATE
    refuse_unreadable_name(folder)
    if not os.path.lexists(path):
        words = phrase(
            "There are no results of a study here: study.json is missing. Give a folder that batch wrote, "
            "or begin one with -o."
        )
        raise UserError(Problem(words, str(folder)))
    try:
        found = json.loads(
            content(path, MAX_STATE, phrase("the file that batch wrote")).decode("utf-8"), parse_constant=_no_number
        )
    except RecursionError:
        raise UserError(
            Problem(Phrase("The state of the study is nested too deep. {mend}", mend=MEND), str(path))
        ) from None
    except ValueError as error:
        raise UserError(
            Problem(Phrase("The state of the study cannot be read: {error}. {mend}", error=error, mend=MEND), str(path))
        ) from error
    check_form(found, path, is_final=sealed)
    if sealed and not is_sealed(found):
        words = Phrase(
            "This file has been changed since the program wrote it, so that what it says of the results may "
            "be wrong. Put it back as it was, or let the program write it anew: {continued}",
            continued=continuing(folder, found["columns"]),
        )
        raise UserError(Problem(words, str(path)))
    return dict(found)


def _no_number(name: str) -> None:
    raise ValueError(Phrase("{name} is not a number of JSON", name=name))


def write_state(folder: Path, state: Mapping[str, Any]) -> None:
    """Put study.json into the folder, whole and sealed; other programs may read it at any time."""
    content = {key: value for key, value in state.items() if key != SEAL}
    text = json.dumps(content | {SEAL: _seal(content)}, indent=1, ensure_ascii=False, allow_nan=False)
    write(folder / STATE, f"{text}\n".encode())


def is_sealed(state: Data) -> bool:
    """Return whether nothing was changed since the program wrote it."""
    return bool(state[SEAL] == _seal({key: value for key, value in state.items() if key != SEAL}))


def _seal(content: Data) -> str:
    """Return the hash of all other keys, in their order."""
    return sha256(json.dumps(content, allow_nan=False).encode()).hexdigest()


def read_description(folder: Path, *, sealed: bool = True) -> Description:
    """Return the study that the folder holds results of, with the copies of its files where they are as they were."""
    return with_copies(folder, from_data(read_state(folder, sealed=sealed)))


def with_copies(folder: Path, found: Description) -> Description:
    """Return the description with the contents of the study's files, where their copies are as they were."""
    study, base, *tables = (_with_copy(source, path) for path, source in copies(folder, found).items())
    return replace(found, study=study, base=base, tables=tuple(tables))


def copies(folder: Path, description: Description) -> dict[Path, StudySource]:
    """Return where the copies of the study's files are: the study, its base, its tables; numbered, as names may be paths."""
    tables = {f"{TABLES}/{n}-{PurePath(table.file).name}": table for n, table in enumerate(description.tables, 1)}
    files = {STUDY: description.study, BASE: description.base, **tables}
    return {folder / name: source for name, source in files.items()}


def refuse_sources(folder: Path, target: Path) -> None:
    """Refuse to write over what the study was made of: a file with the content of its copy of study, base or table."""
    if not target.is_file():
        return
    for source in copies(folder, read_description(folder, sealed=False)).values():
        if source.content is not None and source.content == target.read_bytes():
            words = (
                "This is {file}, of which the study was made; it would be written over. Choose another place with -o."
            )
            raise UserError(Problem(Phrase(words, file=source.file), str(target)))


def kept(folder: Path) -> dict[str, Path]:
    """The copies of the base and the tables by their names in the study; UserError where a copy is not as it was."""
    description = read_description(folder, sealed=False)  # each copy is proved by its own hash
    found = copies(folder, description)
    for path, source in found.items():
        if source.content is None:
            columns = dict.fromkeys(column.name for column in description.columns)
            words = Phrase(
                "This copy of {file} is missing or has changed. Continue with the study itself: {continued}",
                file=source.file,
                continued=continuing(folder, columns, "STUDY "),
            )
            raise UserError(Problem(words, str(path)))
    return {source.file: path for path, source in found.items() if source is not description.study}


def _with_copy(source: StudySource, path: Path) -> StudySource:
    try:
        content = path.read_bytes() if path.is_file() else b""
    except OSError as error:
        words = Phrase(
            "This copy of {file} cannot be read: {strerror}. Check its permissions.",
            file=source.file,
            strerror=error.strerror or error,
        )
        raise UserError(Problem(words, str(path))) from error
    return replace(source, content=content) if sha256(content).hexdigest() == source.sha256 else source


def write_copies(folder: Path, description: Description) -> None:
    """Keep the files of the study beside the results, where they are not there yet."""
    for path, source in copies(folder, description).items():
        if source.content is not None and not path.exists():
            with in_words(path):
                path.parent.mkdir(exist_ok=True)
            write(path, source.content)


def begin(folder: Path, description: Description) -> None:
    """Make a folder the place of a study's results; it must hold nothing yet."""
    refuse_used(folder)
    write_state(folder, as_data(description) | {"part_files": {}, "state": "running"})
    write_copies(folder, description)


def refuse_used(folder: Path) -> None:
    """Refuse a folder that holds anything."""
    others = sorted(path.name for path in folder.iterdir() if path.name not in (LOCK, HOLDER))
    if STATE in others:
        words = phrase(
            "Results of a study are here already. Continue them with --resume, or choose another folder with -o."
        )
        raise UserError(Problem(words, str(folder)))
    if others:
        words = Phrase(
            "This folder is not empty ({others} is in it). Choose a new one with -o, so that nothing is lost.",
            others=others[0],
        )
        raise UserError(Problem(words, str(folder)))


def with_libraries(state: Data) -> Data:
    """Return the state with the versions of the libraries of this run; where a run continues with others, with both."""
    before = state.get("libraries", {})
    now = {name: [*before.get(name, ()), version] for name, version in libraries().items()}
    return state | {"libraries": {name: list(dict.fromkeys(versions)) for name, versions in now.items()}}


def same_study(folder: Path, before: Description, now: Description) -> None:
    """Refuse to continue the results with another study."""
    if found := list(changes(before, now)):
        words = phrase("These results belong to another study; put it back as it was, or choose a new folder with -o.")
        raise UserError([Problem(words, str(folder)), *found])


@contextmanager
def held(lock: FileLock, folder: Path) -> Iterator[None]:
    """Hold the folder for this run alone; a run that was killed holds nothing. Told in words: who holds it."""
    with in_words(folder):
        try:
            lock.acquire(timeout=0)
        except Timeout:
            raise UserError(
                Problem(Phrase("Another run uses this folder{holder}.", holder=_holder(folder)), str(folder))
            ) from None
    try:
        write(folder / HOLDER, json.dumps({"process": os.getpid(), "host": socket.gethostname()}).encode())
        yield
    finally:
        (folder / HOLDER).unlink(missing_ok=True)
        lock.release()


def _holder(folder: Path) -> str:
    """Who holds it, as far as that is known: the run may just be writing or removing its name."""
    try:
        found = json.loads((folder / HOLDER).read_text("utf-8"))
        return Phrase(
            ": process {process} on {host}. Wait for its end, or choose another folder with -o",
            process=found["process"],
            host=found["host"],
        )
    except (OSError, ValueError, KeyError, TypeError):
        return phrase(", and has not given its name. Wait for its end, or choose another folder with -o")
