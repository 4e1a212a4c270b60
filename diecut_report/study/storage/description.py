"""What the results of a study are made of, and study.json, which says so: its form, its seal, what is wrong with one that a hand has changed.

Beside it the copies of the files that the study was read from, and what of them has changed.
"""

from __future__ import annotations

import difflib
import json
import os
import platform
import reprlib
import shlex
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path, PurePath
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from diecut_report import __version__
from diecut_report.config.yaml import MAX_BYTES, printable
from diecut_report.errors import Problem, UserError, nearest, refusal
from diecut_report.files import content, in_words, refuse_unreadable_name, write
from diecut_report.formulas.condition_parts import Name
from diecut_report.text.phrases import Phrase, joined, phrase

SCHEMA_VERSION = 1
CHUNK = 8192  # variants a part file
LINES = 3  # changed lines that a message shows
SHORT_HASH = 12  # digits of a SHA-256 that people read
Kind = Literal["float", "int", "bool", "text", "curve"]
Data = dict[str, Any]
STATUSES = ("pass", "warn", "fail", "error")


@dataclass(frozen=True)
class ResultColumn:
    """Describe a column of the results: values in ``unit`` (SI, ASCII; "1" for pure numbers and for what is not a number).

    ``display``: the unit that people read it in, where it is another. A curve holds a list of numbers for each variant.
    """

    name: str
    kind: Kind = "float"
    unit: str = "1"
    display: str = ""
    symbol: str = ""
    description: str = ""

    @property
    def is_number(self) -> bool:
        """Return whether it has sizes: floats and integers."""
        return self.kind in ("float", "int")

    @property
    def in_condition(self) -> Name:
        """Return what its name stands for in a condition."""
        if self.is_number:
            return Name(self.name, "number", self.unit, self.display)
        return Name(self.name, "truth" if self.kind == "bool" else "text")


@dataclass(frozen=True)
class StudySource:
    """Hold a file that the study was read from. With its content a copy is kept in the folder of the results."""

    file: str
    sha256: str
    content: bytes | None = None


@dataclass(frozen=True)
class Description:
    """Describe a study as its results see it. ``rows`` counts the sample, before constraints; ``chunk`` of them make one part.

    ``columns`` are those of the varied paths, outputs and checks, in their order; the store adds ``variant`` before
    them and ``status``, ``governing``, ``error`` after them. ``plugins``: the version of each kind of mechanism.
    ``sources``: the SHA-256 of the code of all that calculates, by its name in words (`config.sources`).
    """

    study: StudySource
    base: StudySource
    columns: tuple[ResultColumn, ...]
    rows: int
    chunk: int = CHUNK
    tables: tuple[StudySource, ...] = ()
    plugins: Mapping[str, str] = field(default_factory=dict)
    program: str = __version__
    sources: Mapping[str, str] = field(default_factory=dict)

    @property
    def parts(self) -> int:
        """Return how many part files the whole study has."""
        return -(-self.rows // self.chunk)

    def part_rows(self, index: int) -> range:
        """Return the numbers of the sample's rows that make a part."""
        return range(index * self.chunk, min((index + 1) * self.chunk, self.rows))

    @property
    def all_columns(self) -> tuple[ResultColumn, ...]:
        return (VARIANT, *self.columns, *VERDICT)


def libraries() -> dict[str, str]:
    """Return the versions of what calculates: results may differ between them in the last digits."""
    return {"python": platform.python_version(), **{name: version(name) for name in ("numpy", "scipy")}}


VARIANT = ResultColumn("variant", "int", description="Number of the variant in the sample, from 0")
JUDGED = ResultColumn("verdict", "text", description="Verdict on the variant: pass, conditional or fail")
"""The last of a study's columns; results of before it have none."""
VERDICT = (
    ResultColumn("status", "text", description="Status of the variant: pass, warn, fail or error"),
    ResultColumn("governing", "text", description="Check that governs the variant"),
    ResultColumn("error", "text", description="Why the variant cannot be calculated"),
)


def as_data(description: Description) -> Data:
    """Return it as it stands in study.json, whose form `StateForm` judges."""
    sources = {"study": description.study, "base": description.base}
    sources |= {f"table {number}": table for number, table in enumerate(description.tables, 1)}
    columns = {
        column.name: {key: value for key, value in vars(column).items() if value and key != "name"}
        for column in description.all_columns
    }
    return {
        "schema_version": SCHEMA_VERSION, "program": {"name": "diecut-report", "version": description.program},
        "plugins": dict(description.plugins), "source_sha256": dict(description.sources),
        "study": description.study.file, "base": description.base.file, "tables": [table.file for table in description.tables],
        "sha256": {role: source.sha256 for role, source in sources.items()},
        "rows": description.rows, "chunk": description.chunk, "columns": columns,
    }  # fmt: skip


def from_data(data: Data) -> Description:
    """Return the description that stands in study.json, whose form has been checked."""
    study, base = (StudySource(data[role], data["sha256"][role]) for role in ("study", "base"))
    columns = tuple(ResultColumn(name, **about) for name, about in data["columns"].items())[1 : -len(VERDICT)]
    tables = tuple(StudySource(file, data["sha256"][f"table {n}"]) for n, file in enumerate(data["tables"], 1))
    return Description(
        study, base, columns, data["rows"], data["chunk"], tables, data["plugins"], data["program"]["version"], data["source_sha256"]
    )  # fmt: skip


def changes(before: Description, now: Description) -> Iterator[Problem]:
    """Yield what of a study has changed since its results were begun; the parts' size may differ and is not a change."""
    file = now.study.file
    roles = {phrase("study file"): (before.study, now.study), phrase("base configuration"): (before.base, now.base)}
    for role, (old, new) in roles.items():
        if old.sha256 != new.sha256:
            template = "The {role} has changed since the results were begun.{lines}"
            yield Problem(Phrase(template, role=role, lines=_changed_lines(old, new)), new.file)
    yield from _other_tables(before, now)
    if before.program != now.program:
        template = "The results were begun with version {old} of the program; this is {new}."
        yield Problem(Phrase(template, old=before.program, new=now.program), file)
    for kind in sorted(before.plugins.keys() | now.plugins.keys()):
        was, is_ = (versions.get(kind, phrase("absent")) for versions in (before.plugins, now.plugins))
        if was != is_:
            template = "The plugin {kind} was {old} when the results were begun; it is {new}."
            yield Problem(Phrase(template, kind=repr(kind), old=was, new=is_), file)
    for name in sorted(before.sources.keys() | now.sources.keys()):
        if before.sources.get(name) != now.sources.get(name):  # its version may be the same
            template = (
                "The source of the {name} has changed since the results were begun (SHA-256 {old} then, {new} now): variants "
                "of both would be mixed. Put it back as it was, or calculate all variants anew in another folder."
            )
            hashes = {"old": short_hash(before.sources.get(name)), "new": short_hash(now.sources.get(name))}
            yield Problem(Phrase(template, hashes, name=source_name(name)), file)
    if before.rows != now.rows:
        yield Problem(Phrase("The sample had {old} rows, now it has {new}.", old=before.rows, new=now.rows), file)
    if before.columns != now.columns:
        yield Problem(_other_columns(before, now), file)


def source_name(name: str) -> str:
    """Return what people call a source that has a hash: the program, a plugin, an extension."""
    of, _, own = name.partition(" ")
    if of == "plugin":
        return Phrase("plugin {kind}", kind=own)
    return Phrase("extension {name}", name=own) if of == "extension" else phrase(name)


def short_hash(digest: str | None) -> str:
    """Return as much of a hash as people read."""
    return digest[:SHORT_HASH] if digest else phrase("none")


def _other_tables(before: Description, now: Description) -> Iterator[Problem]:
    old, new = ({table.file: table.sha256 for table in each.tables} for each in (before, now))
    for name in (name for name in (old | new) if old.get(name) != new.get(name)):
        words = phrase("has changed since the results were begun") if name in old else phrase("is new in the study")
        words = words if name in new else phrase("is no longer in the study")
        yield Problem(Phrase("This table {words}.", words=words), name)


def _other_columns(before: Description, now: Description) -> Phrase:
    old, new = ({column.name: column for column in each.columns} for each in (before, now))
    names = [name for name in (old | new) if old.get(name) != new.get(name)] or [phrase("their order")]
    more = " …" * (len(names) > LINES)
    return Phrase("The columns of the results differ: {names}{more}.", names=joined(names[:LINES], ", "), more=more)


def _changed_lines(before: StudySource, now: StudySource) -> str:
    """Return the first lines that differ, marked - (before) and + (now), where both contents are known texts."""
    if before.content is None or now.content is None:
        return ""
    old, new = (content.decode("utf-8", "replace").splitlines() for content in (before.content, now.content))
    both = difflib.unified_diff(old, new, n=0, lineterm="")
    found = [line for line in both if line[:1] in "+-" and line[:3] not in ("+++", "---")]
    shown = found[: 2 * LINES] + ["…"] * (len(found) > 2 * LINES)
    return "".join(f"\n    {line}" for line in shown)


STATE, STUDY, BASE, TABLES = "study.json", "study.yaml", "base.yaml", "tables"
SEAL = "seal"
MAX_STATE = 100_000_000  # bytes of study.json; ten thousand columns take some two million
MAX_REPORTED = 5  # faults that are reported one by one
SEARCHED = "violation"  # the column that only the machines of a search have
REMEDY = phrase(
    "Only batch writes this file: put it back as it was, or calculate the study anew in another "
    "folder with `diecut-report batch STUDY -o DIR`."
)
MISSING_KEY, UNKNOWN_KEY = phrase("This key is missing."), phrase("This key is unknown{nearest}.")
Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
Count = Annotated[int, Field(ge=0, le=10**15)]
Fault = tuple[str, str]  # key, and what is wrong with it


class _Form(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True)


class NotedProgram(_Form):
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


def continuing(folder: object, columns: Collection[str], study: str = "") -> str:
    """Return the command that goes on with the run of a folder whose results have columns of these names, of a study or of a search."""
    return f"diecut-report {'optimise' if SEARCHED in columns else 'batch'} {study}--resume {shlex.quote(printable(f'{folder}'))}"


def check_form(data: Any, file: Path) -> None:
    """Refuse what is no study.json: UserError with the file, the key, what was given and what is allowed."""
    try:
        faults = list(_disagreeing(StateForm.model_validate(data)))
    except ValidationError as error:
        faults = [_of_pydantic(fault) for fault in error.errors()]
    shown = []
    for key, words in faults[:MAX_REPORTED]:
        path = key if key.isprintable() and len(key) < 200 else reprlib.repr(key)  # it may be written by hand too
        shown.append(Problem(joined((words, REMEDY), " "), str(file), path=path))
    if more := len(faults) - len(shown):
        shown.append(Problem(Phrase("{more} more keys are wrong.", more=more), str(file)))
    if shown:
        raise UserError(shown)


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


def _of_pydantic(fault: Mapping[str, Any]) -> Fault:
    key = ".".join(str(part) for part in fault["loc"] if part != "[key]")
    if fault["type"] == "missing":
        return key, MISSING_KEY
    if fault["type"] == "extra_forbidden":
        known = [field.alias or name for name, field in StateForm.model_fields.items()]
        return key, Phrase(UNKNOWN_KEY, nearest=nearest(key, known))
    limits = {"ge": "", "le": "", "expected": "", **fault.get("ctx", {})}
    needed = Phrase(NEEDED.get(fault["type"], fault["msg"]), limits)
    return key, Phrase("{given} is given; {needed}.", given=_given(fault["input"]), needed=needed)


def _given(value: Any) -> str:
    match value:
        case None | bool():
            return json.dumps(value)
        case dict():
            return phrase("a block of keys")
        case list():
            return phrase("a list")
    return reprlib.repr(value)


# --- keys that must agree --------------------------------------------------------------------------------------------


def _disagreeing(form: StateForm) -> Iterator[Fault]:
    names, verdict = list(form.columns), [column.name for column in VERDICT]
    if names[:1] != [VARIANT.name] or names[-len(verdict) :] != verdict:
        yield "columns", Phrase("They begin with variant and end with {verdict}.", verdict=", ".join(verdict))
    sources = {"study", "base", *(f"table {number}" for number in range(1, len(form.tables) + 1))}
    yield from ((f"sha256.{key}", MISSING_KEY) for key in sorted(sources - form.sha256.keys()))
    for key in sorted(form.sha256.keys() - sources):
        yield f"sha256.{key}", Phrase(UNKNOWN_KEY, nearest=nearest(key, sources))
    for name in (name for name in form.varied or () if name not in names):
        template = "{given} is given; the name of a column is needed{nearest}."
        yield "varied", Phrase(template, given=_given(name), nearest=nearest(name, names))


def part_name(index: int) -> str:
    return f"part-{index:05d}.parquet"


# --- read and written ------------------------------------------------------------------------------------------------


def read_state(folder: Path, *, sealed: bool = True) -> Data:
    """Return study.json of the folder; UserError where there is none, or where it is not what the program has written.

    Without ``sealed`` a file that a hand has changed is read too, as far as each key is possible: for a run that writes
    anew what follows from the study.
    """
    path = folder / STATE
    refuse_unreadable_name(folder)
    if not os.path.lexists(path):
        template = "There are no results of a study here: study.json is missing. Give a folder that batch wrote, or begin one with -o."
        raise refusal(template, folder)
    text = content(path, MAX_STATE, phrase("the file that batch wrote"))
    try:
        found = json.loads(text.decode("utf-8"), parse_constant=_refuse_constant)
    except (RecursionError, ValueError) as error:
        template = "The state of the study cannot be read: {error}. {mend}"
        raise refusal(template, path, error=error, mend=REMEDY) from error
    check_form(found, path)
    if sealed and not is_sealed(found):
        template = (
            "This file has been changed since the program wrote it, so that what it says of the results may "
            "be wrong. Put it back as it was, or let the program write it anew: {continued}"
        )
        raise refusal(template, path, continued=continuing(folder, found["columns"]))
    return dict(found)


def _refuse_constant(name: str) -> None:
    raise ValueError(Phrase("{name} is not a number of JSON", name=name))


def write_state(folder: Path, state: Mapping[str, Any]) -> None:
    """Put study.json into the folder, whole and sealed; other programs may read it at any time."""
    sealed = {**state, SEAL: _seal(state)}
    text = json.dumps(sealed, indent=1, ensure_ascii=False, allow_nan=False)
    write(folder / STATE, f"{text}\n".encode())


def is_sealed(state: Data) -> bool:
    """Return whether nothing was changed since the program wrote it."""
    return bool(state[SEAL] == _seal(state))


def _seal(state: Mapping[str, Any]) -> str:
    others = {key: value for key, value in state.items() if key != SEAL}
    return sha256(json.dumps(others, allow_nan=False).encode()).hexdigest()


# --- the copies of the study's files ---------------------------------------------------------------------------------


def read_description(folder: Path, *, sealed: bool = True) -> Description:
    """Return the study that the folder holds results of, with the contents of its files where their copies are as they were."""
    found = from_data(read_state(folder, sealed=sealed))
    study, base, *tables = (_with_copy(source, path) for path, source in copies(folder, found).items())
    return replace(found, study=study, base=base, tables=tuple(tables))


def copies(folder: Path, description: Description) -> dict[Path, StudySource]:
    """Return where the copies of the study's files are: the study, its base, its tables; numbered, as names may be paths."""
    tables = {f"{TABLES}/{n}-{PurePath(table.file).name}": table for n, table in enumerate(description.tables, 1)}
    files = {STUDY: description.study, BASE: description.base, **tables}
    return {folder / name: source for name, source in files.items()}


def _with_copy(source: StudySource, path: Path) -> StudySource:
    found = content(path, MAX_BYTES, Phrase("the copy of {file}", file=source.file)) if path.is_file() else b""
    return replace(source, content=found) if sha256(found).hexdigest() == source.sha256 else source


def refuse_sources(folder: Path, target: Path) -> None:
    """Refuse to write over what the study was made of: a file with the content of its copy of study, base or table."""
    if not target.is_file():
        return
    for source in copies(folder, read_description(folder, sealed=False)).values():
        is_alike = source.content is not None and len(source.content) == target.stat().st_size
        if is_alike and source.content == target.read_bytes():
            template = (
                "This is {file}, of which the study was made, and would be overwritten. Choose another place with -o."
            )
            raise refusal(template, target, file=source.file)


def kept(folder: Path) -> dict[str, Path]:
    """Return the copies of the base and the tables by their names in the study; UserError where a copy is not as it was."""
    description = read_description(folder, sealed=False)  # each copy is proved by its own hash
    found = copies(folder, description)
    for path, source in found.items():
        if source.content is None:
            columns = [column.name for column in description.columns]
            template = "This copy of {file} is missing or has changed. Continue with the study itself: {continued}"
            raise refusal(template, path, file=source.file, continued=continuing(folder, columns, "STUDY "))
    return {source.file: path for path, source in found.items() if source is not description.study}


def write_copies(folder: Path, description: Description) -> None:
    """Keep the files of the study beside the results, where they are not there yet."""
    for path, source in copies(folder, description).items():
        if source.content is not None and not path.exists():
            with in_words(path):
                path.parent.mkdir(exist_ok=True)
            write(path, source.content)
