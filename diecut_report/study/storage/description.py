"""What the results of a study are made of: its files, its columns, its size; and what of it has changed."""

from __future__ import annotations

import difflib
import platform
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from importlib.metadata import version
from typing import Any, Literal

from diecut_report import __version__
from diecut_report.errors import Problem
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
    """Return it as it stands in study.json, whose form `state.StateForm` judges."""
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
