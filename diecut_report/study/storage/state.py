"""study.json, the copies of the study's files, and the lock of the folder that a run writes into."""

from __future__ import annotations

import json
import os
import reprlib
import shlex
import socket
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from hashlib import sha256
from pathlib import Path, PurePath
from typing import Annotated, Any, Literal

from filelock import FileLock, Timeout
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from diecut_report.config.yaml import printable
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.files import content, in_words, refuse_unreadable_name, write
from diecut_report.study.storage.description import (
    VARIANT,
    VERDICT,
    Data,
    Description,
    Kind,
    StudySource,
    as_data,
    changes,
    from_data,
    libraries,
)
from diecut_report.text.phrases import Phrase, joined, phrase

# The form of study.json: what each of its keys may hold, and in words what is wrong with one that a hand has changed.


MOST = 5  # faults that are told
EARLIER = ("source_sha256", "part_files", "seal")  # what an earlier version of the program did not write
MEND = phrase(
    "Only batch writes this file: put it back as it was, or calculate the study anew in another "
    "folder with `diecut-report batch STUDY -o DIR`."
)
Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
Count = Annotated[int, Field(ge=0, le=10**15)]
STATUSES = ("pass", "warn", "fail", "error")


class _Form(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True)


class NotedProgram(_Form):
    """The program that calculated the variants."""

    name: Literal["diecut-report"]
    version: str


class NotedColumn(_Form):
    """A column of the part files; its name is the key."""

    kind: Kind = "float"
    unit: str = "1"
    display: str = ""
    symbol: str = ""
    description: str = ""


class NotedPart(_Form):
    """A part file: the hash of its bytes, and how many variants it holds."""

    sha256: Digest
    variants: Count


class NotedCounts(_Form):
    """How many rows the sample has, how many of them are stored, and of each status."""

    sample: Count
    variants: Count
    dropped: Count
    without_value: Count = 0
    passing: Count = Field(0, alias="pass")
    warn: Count = 0
    fail: Count = 0
    error: Count = 0


class StateForm(_Form):
    """All that stands in study.json."""

    schema_version: Literal[1]  # of the description
    program: NotedProgram
    plugins: dict[str, str]
    source_sha256: dict[str, Digest]
    study: str
    base: str
    tables: list[str]
    sha256: dict[str, Digest]
    rows: Count
    chunk: Annotated[int, Field(ge=1, le=10**6)]
    columns: dict[str, NotedColumn]
    part_files: dict[str, NotedPart]
    state: Literal["running", "complete"]
    seal: Digest
    varied: Annotated[list[str], Field(min_length=1)] | None = None
    objectives: list[dict[Literal["minimise", "maximise"], str]] = []
    design: Literal["saltelli"] | None = None
    n: Count | None = None
    slow: dict[str, str] = {}
    broken: dict[str, str] = {}
    doubtful: dict[str, list[str]] = {}
    seconds: Annotated[float, Field(ge=0)] = 0.0
    libraries: dict[str, list[str]] = {}
    parts: Count | None = None
    counts: NotedCounts | None = None


SEARCHED = "violation"  # the column that only the machines of a search have


def continuing(folder: object, columns: object, study: str = "") -> str:
    """Return the command that goes on with the run of a folder whose results have these columns by name, of a study or of a search."""
    is_search = isinstance(columns, Mapping) and SEARCHED in columns
    return f"diecut-report {'optimise' if is_search else 'batch'} {study}--resume {shlex.quote(printable(f'{folder}'))}"


def check_form(data: Any, file: Path, *, is_final: bool = True) -> None:
    """Refuse what is no study.json: UserError with the file, the key, what was given and what is allowed.

    Without ``is_final`` the keys that a run writes at its end need not agree: it is to be continued.
    """
    if isinstance(data, dict) and not any(key in data for key in EARLIER) and "columns" in data:
        words = phrase(
            "An earlier version of diecut-report wrote these results, without the hashes that prove them "
            "unchanged. Calculate the study anew in another folder with `diecut-report batch STUDY -o DIR`."
        )
        raise UserError(Problem(words, str(file)))
    try:
        found = StateForm.model_validate(data)
    except ValidationError as error:
        raise _told([_of_pydantic(one) for one in error.errors()], file) from None
    if disagreeing := list(_disagreeing(found)):
        raise _told(disagreeing, file)
    if is_final and found.state == "complete" and (faults := list(_incomplete(found))):
        raise _told(
            faults,
            file,
            Phrase("Let the program fix it: {continued}", continued=continuing(file.parent, found.columns)),
        )


def _told(faults: list[tuple[str, str]], file: Path, mend: str = MEND) -> UserError:
    shown = [Problem(joined((words, mend), " "), str(file), path=_short(key)) for key, words in faults[:MOST]]
    more = len(faults) - len(shown)
    return UserError(
        [*shown, *([Problem(Phrase("{more} more keys are wrong.", more=more), str(file))] if more else [])]
    )


# --- each key by itself ----------------------------------------------------------------------------------------------

NEEDED = {
    "string_type": phrase("a text is needed"),
    "int_type": phrase("a whole number is needed"),
    "int_from_float": phrase("a whole number is needed"),
    "float_type": phrase("a number is needed"),
    "dict_type": phrase("a block of keys is needed"),
    "model_type": phrase("a block of keys is needed"),
    "list_type": phrase("a list is needed"),
    "too_short": phrase("at least one entry is needed"),
    "finite_number": phrase("a finite number is needed"),
    "string_pattern_mismatch": phrase("a SHA-256 is needed, 64 of the digits 0-9 and a-f"),
    "greater_than_equal": phrase("at least {ge} is needed"),
    "less_than_equal": phrase("at most {le} is allowed"),
    "literal_error": phrase("allowed is {expected}"),
}


def _of_pydantic(found: Mapping[str, Any]) -> tuple[str, str]:
    key = ".".join(str(part) for part in found["loc"] if part != "[key]")
    kind, given = found["type"], _given(found["input"])
    if kind == "missing":
        return key, phrase("This key is missing.")
    if kind == "extra_forbidden":
        known = [field.alias or name for name, field in StateForm.model_fields.items()]
        return key, Phrase("This key is unknown{nearest}.", nearest=nearest(key, known))
    needed = Phrase(NEEDED.get(kind, found["msg"]), {"ge": "", "le": "", "expected": "", **found.get("ctx", {})})
    return key, Phrase("{given} is given; {needed}.", given=given, needed=needed)


def _given(value: Any) -> str:
    """A value of the file, shortened."""
    if value is None or isinstance(value, bool):
        return "null" if value is None else str(value).lower()
    if isinstance(value, dict | list):
        return phrase("a block of keys") if isinstance(value, dict) else phrase("a list")
    return reprlib.repr(value)


def _short(key: str) -> str:
    """A key, which a hand may have written too."""
    return key if key.isprintable() and len(key) < 200 else reprlib.repr(key)


# --- keys that must agree --------------------------------------------------------------------------------------------


def _disagreeing(form: StateForm) -> Iterator[tuple[str, str]]:
    """Return the keys that contradict others."""
    names = list(form.columns)
    if names[:1] != [VARIANT.name] or names[-len(VERDICT) :] != [column.name for column in VERDICT]:
        yield (
            "columns",
            Phrase(
                "They begin with variant and end with {verdict}.",
                verdict=", ".join(column.name for column in VERDICT),
            ),
        )
    sources = {"study", "base", *(f"table {number}" for number in range(1, len(form.tables) + 1))}
    yield from _other_keys("sha256", form.sha256, sources)
    for name in (name for name in form.varied or () if name not in form.columns):
        yield (
            "varied",
            Phrase(
                "{given} is given; the name of a column is needed{nearest}.",
                given=_given(name),
                nearest=nearest(name, names),
            ),
        )


def part_name(index: int) -> str:
    """Return the name of a part file."""
    return f"part-{index:05d}.parquet"


def _incomplete(form: StateForm) -> Iterator[tuple[str, str]]:
    """Return what of a study that is called complete does not add up."""
    whole = -(-form.rows // form.chunk)
    first = range(min(whole, len(form.part_files) + 1))  # one that is missing is enough
    yield from _other_keys("part_files", form.part_files, {part_name(index) for index in first})
    if form.parts != whole:
        yield (
            "parts",
            Phrase(
                "{given} is given; {rows} rows in parts of {chunk} make {whole}.",
                given=_given(form.parts),
                rows=form.rows,
                chunk=form.chunk,
                whole=whole,
            ),
        )
    if form.counts is None:
        yield "counts", phrase("This key is missing.")
        return
    stored = sum(part.variants for part in form.part_files.values())
    statuses = form.counts.passing + form.counts.warn + form.counts.fail + form.counts.error
    for name, given, true in (
        ("sample", form.counts.sample, form.rows),
        ("variants", form.counts.variants, stored),
        ("dropped", form.counts.dropped, form.rows - stored),
        (", ".join(STATUSES), statuses, stored),
    ):
        if given != true:
            yield f"counts.{name}", Phrase("{given} is given; the other keys make {true}.", given=given, true=true)


def _other_keys(name: str, given: Mapping[str, Any], needed: set[str]) -> Iterator[tuple[str, str]]:
    for key in sorted(needed - given.keys()):
        yield f"{name}.{key}", phrase("This key is missing.")
    for key in sorted(given.keys() - needed):
        yield f"{name}.{key}", Phrase("This key is unknown{nearest}.", nearest=nearest(key, needed))


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
